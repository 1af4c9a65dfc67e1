/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene: what is printed of models put together here, against what they are and against the library. */
#include <jansson.h>

#include "depthprec/depthprec.h"
#include "printed.h"

#define STREET "tests/models/street.obj"

static dp_setup setup_of(const char *format, dp_mapping mapping, bool slanted) {
    const dp_triangles none = {0};
    return SETUP(format, .mapping = mapping, .model = DP_MODEL_FLOAT,
                 .triangles = slanted ? dp_triangles_default() : none);
}

static const struct {
    const char *a, *b, *material;
    double gap, area, lo[3], hi[3];
} pairs[] = {{"wall", "sign", "tin", 0x1p-10, 2, {21, 1, 0}, {22, 3, 0}},
             {"road", "paint", "white", 0x1p-6, 16, {-1, 0, -4}, {1, 0, 4}}};

/* One finding: whether it is certain up to `within`. */
static bool check_finding(const json_t *f, size_t k, const dp_setup *setup, double within) {
    dp_separation_worst worst;
    assert_string_equal(text_at(f, "a.node"), pairs[k].a);
    assert_string_equal(text_at(f, "b.node"), pairs[k].b);
    assert_string_equal(text_at(f, "b.material"), pairs[k].material);
    assert_true(number_at(f, "gap_min") == pairs[k].gap && number_at(f, "gap_max") == pairs[k].gap);
    assert_relative(number_at(f, "area"), pairs[k].area, 1e-12);
    for (int axis = 0; axis < 3; axis++) {
        const double at = number_at(f, "place.%c", "xyz"[axis]);
        assert_true(at >= pairs[k].lo[axis] && at <= pairs[k].hi[axis]);
    }
    const double certain = number_at(f, "certain_to");
    assert_int_equal(dp_separation_over(setup, 0.1, certain, pairs[k].gap, &worst), DP_OK);
    assert_true(worst.bound <= pairs[k].gap);
    if (certain < 999) {
        dp_separation_over(setup, 0.1, certain * (1 + 2e-5), pairs[k].gap, &worst);
        assert_true(worst.bound > pairs[k].gap);
    }
    dp_separation_over(setup, 0.1, within, 0, &worst);
    assert_relative(number_at(f, "lift"), fmax(worst.bound - pairs[k].gap, 0.0), 1e-12);
    assert_int_equal(flag_at(f, "fights"), certain < within);
    return certain >= within;
}

TEST(findings) {
    static const struct {
        const char *options, *format;
        dp_mapping mapping;
        bool slanted;
        double within;
    } rows[] = {
        {"--separation 0.02", "fp32", DP_MAPPING_REVERSED, false, 0},
        {"--separation 0.02 -F d24 -m d3d --within 50", "unorm24", DP_MAPPING_D3D, false, 50},
        {"--separation 0.02 --viewport 1920x1080 --within 200", "fp32", DP_MAPPING_REVERSED, true, 200},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const dp_setup setup = setup_of(rows[i].format, rows[i].mapping, rows[i].slanted);
        const double extent = sqrt(32.0 * 32 + 16 * 16 + 4 * 4);
        const double within = rows[i].within > 0 ? rows[i].within : 10 * extent;
        json_t *root = json_printed(rows[i].within > 0, "scene " STREET " %s", rows[i].options);
        const json_t *list = node_at(root, "findings");
        assert_int_equal(json_array_size(list), 2);
        assert_relative(number_at(root, "extent"), extent, 1e-15);
        assert_relative(number_at(root, "within"), within, 1e-15);
        assert_true(number_at(root, "model_triangles") == 10 && number_at(root, "model_surfaces") == 5);
        assert_true(number_at(root, "gap") == 0.02 && number_at(root, "angle") == 1);
        /* wall and sign stand before the back side: four pairs of triangles with each */
        assert_true(number_at(root, "left_out.facing") >= 4);
        bool passed = true;
        double last = 0.0;
        unsigned seen = 0;
        for (size_t n = 0; n < 2; n++) {
            const json_t *f = json_array_get(list, n);
            const size_t k = strcmp(text_at(f, "a.node"), "wall") == 0 ? 0 : 1;
            seen |= 1U << k;
            assert_true(number_at(f, "certain_to") >= last); /* the nearest fight first */
            last = number_at(f, "certain_to");
            passed = check_finding(f, k, &setup, within) && passed;
        }
        assert_int_equal(seen, 3);
        assert_int_equal(node_at(root, "passed") != NULL && flag_at(root, "passed"), passed && rows[i].within > 0);
        json_decref(root);
    }
}

/* Filters that are off bring back what they left out; a gap of 0 asks for one plane alone; a narrow angle for
 * parallels. */
TEST(what_is_asked) {
    static const struct {
        const char *options;
        size_t findings;
        double facing;
    } rows[] = {{"--separation 0.001", 1, -1},
                {"--separation 0", 0, 0},
                {"--separation 0.02 --also facing", 4, 0},
                {"--separation 0.02 --also all", 4, 0},
                {"--separation 0.02 --also thin,facing --angle 0", 4, 0},
                {"--separation 0.02 --transforms binary32 --threads 1", 2, -1}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        json_t *root = json_printed(0, "scene " STREET " %s", rows[i].options);
        assert_int_equal(json_array_size(node_at(root, "findings")), rows[i].findings);
        if (rows[i].facing >= 0)
            assert_true(number_at(root, "left_out.facing") == rows[i].facing);
        json_decref(root);
    }
}

/* Unasked, a model is judged up to ten times its size, or as far as a hundredth of it is told apart; what is asked for
 * is judged, whatever it takes. All that may fight up to there is looked at. */
TEST(default_gap) {
    static const struct {
        const char *options, *format;
        dp_mapping mapping;
        double within; /* 0: less than 360 */
    } rows[] = {{"", "fp32", DP_MAPPING_REVERSED, 360},
                {"-f 300", "fp32", DP_MAPPING_REVERSED, 300},
                {"-F d24 -m d3d --within 100", "unorm24", DP_MAPPING_D3D, 100},
                {"-F d16 -m d3d --within 100", "unorm16", DP_MAPPING_D3D, 100},
                {"-F d16 -m d3d", "unorm16", DP_MAPPING_D3D, 0}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        dp_separation_worst worst;
        json_t *root = json_printed(-1, "scene " STREET " %s", rows[i].options);
        dp_spec spec = setup_of(rows[i].format, rows[i].mapping, false).spec;
        dp_setup setup;
        spec.zfar = number_at(root, "setup.far");
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const double within = number_at(root, "within"), gap = number_at(root, "gap");
        assert_int_equal(dp_separation_over(&setup, 0.1, within, 0, &worst), DP_OK);
        if (rows[i].within > 0) {
            assert_true(within == rows[i].within);
            assert_relative(gap, worst.bound, 1e-12);
        } else {
            assert_true(gap == 0.36 && within > 0.1 && within < 360);
            assert_int_equal(dp_separation_over(&setup, 0.1, within, gap, &worst), DP_OK);
            assert_true(worst.bound <= gap);
            assert_int_equal(dp_separation_over(&setup, 0.1, within * (1 + 1e-5), gap, &worst), DP_OK);
            assert_true(worst.bound > gap);
        }
        const bool asked = strstr(rows[i].options, "--within") != NULL; /* else nothing was to pass */
        printed p = print_of("scene " STREET " %s", rows[i].options);
        assert_int_equal(node_at(root, "passed") != NULL, asked);
        assert_true(!asked || flag_at(root, "passed") == (p.status == 0));
        char head[64];
        snprintf(head, sizeof head, " across; judged up to %.4g\n", within);
        if (strstr(p.out, head) == NULL || strstr(p.out, head) > strchr(p.out, '\n'))
            fail_msg("'%s' is not in the first line of %s", head, p.out);
        json_decref(root);
        printed_free(&p);
    }
}

/* A printed requirement says of what it holds: what faces the camera, or, where a view is, triangles of the class.
 */
TEST(facing_bias) {
    static const char line[] = "scene " STREET " --separation 0.02 -F d24 -m d3d";
    check_says(0, "where they face", "%s", line);
    check_says(0, "in triangles as", "%s --viewport 1920x1080", line);
    check_says(0, "!where they face", "%s --viewport 1920x1080", line);
}

/* The text has the same numbers, rounded to the safe side; CSV those of JSON. */
TEST(other_forms) {
    static const char line_of[] = "scene " STREET " --separation 0.02 -F d24 -m d3d --within 50 --unit m";
    static const char passing[] = "scene " STREET " --separation 0.02 --within 20";
    static const char *const said[] = {"10 triangles, 5 surfaces, 36 m across",
                                       "2 pairs of surfaces lie within 0.02 m of each other: 1 may z-fight",
                                       "FAIL  surfaces may z-fight nearer than 50 m.",
                                       "  1   'wall' (brick) and 'sign' (tin)\n",
                                       "area 2, near ",
                                       NULL};
    json_t *root = json_printed(1, "%s", line_of);
    const json_t *f = node_at(root, "findings[0]");
    char want[256];
    check_says_all(1, line_of, said);
    snprintf(want, sizeof want, "safe up to %.4g m, z-fights from %.4g m on; 9.766e-4 m apart",
             floor(number_at(f, "certain_to") * 100) / 100, ceil(number_at(f, "ties_from") * 100) / 100);
    check_says(1, want, "%s", line_of);
    check_says_all(0, passing,
                   SAID("of each other: none may z-fight facing the\n  camera up to 20, none of them at any slant ",
                        "pass  no surfaces z-fight nearer than 20.", "!'wall'"));
    printed p = print_of("%s --csv", line_of);
    char *line = strtok(p.out, "\r\n");
    assert_non_null(strstr(line, "a_node,a_mesh,a_material,b_node,b_mesh,b_material,gap_min [scene],gap_max [scene]"));
    line = strtok(NULL, "\r\n");
    snprintf(want, sizeof want, "wall,,brick,sign,,tin,0.0009765625,0.0009765625,2,"); /* the file names no mesh */
    assert_memory_equal(line, want, strlen(want));
    snprintf(want, sizeof want, ",%.17g,%.17g,%.17g,true", number_at(f, "certain_to"), number_at(f, "ties_from"),
             number_at(f, "lift"));
    for (const char *at = strchr(line + 50, ','); at != NULL; at = strchr(at + 1, ',')) {
        double a, b, c;
        char rest[8];
        if (sscanf(at, ",%lf,%lf,%lf,%7[a-z]", &a, &b, &c, rest) == 4 && strcmp(rest, "true") == 0) {
            assert_true(a == number_at(f, "certain_to") && b == number_at(f, "ties_from") && c == number_at(f, "lift"));
            line = NULL;
            break;
        }
    }
    assert_null(line);
    printed_free(&p);
    json_decref(root);
}

/* Surfaces have the same names in CSV as in JSON. */
TEST(named_in_csv) {
    static const char line_of[] = "scene tests/models/house.gltf --separation 0.05";
    static const char *const names[] = {"node", "mesh", "material"};
    json_t *root = json_printed(-1, "%s", line_of);
    printed p = print_of("%s --csv", line_of);
    char *at = p.out;
    const size_t count = json_array_size(node_at(root, "findings"));
    for (size_t i = 0; i < count; i++) {
        char want[512] = "";
        at = strchr(at, '\n') + 1;
        for (int k = 0; k < 6; k++)
            snprintf(want + strlen(want), sizeof want - strlen(want), "%s,",
                     text_at(root, "findings[%zu].%c.%s", i, "ab"[k / 3], names[k % 3]));
        if (strncmp(at, want, strlen(want)) != 0)
            fail_msg("%s, and not %.*s", want, (int)strcspn(at, "\n"), at);
    }
    assert_true(count > 5 && *(strchr(at, '\n') + 1) == '\0');
    printed_free(&p);
    json_decref(root);
}

/* A vertex that no triangle uses reaches nowhere: neither the extent nor what follows from it changes. */
TEST(stray_vertex) {
    json_t *root =
        json_printed(0, "scene %s", scratch_text("stray.obj", "v 0 0 0\nv 3 0 0\nv 0 4 0\nv 1e6 1e6 1e6\nf 1 2 3\n"));
    assert_true(number_at(root, "extent") == 5 && number_at(root, "within") == 50);
    json_decref(root);
}

/* Surfaces less apart than the worst separation of a model at the depths that are judged, or seen. */
static bool fights(const json_t *root, const json_t *f, const dp_setup *setup) {
    dp_separation_worst worst;
    const bool eyes = node_at(root, "eyes") != NULL;
    const double lo = eyes ? fmax(number_at(f, "seen_from"), setup->spec.znear) : setup->spec.znear,
                 hi = eyes ? fmin(number_at(f, "seen_to"), setup->spec.zfar) : number_at(root, "within");
    assert_int_equal(dp_separation_over(setup, lo, hi, 0, &worst), DP_OK);
    return number_at(f, "gap_min") < worst.bound;
}

/* How many findings a simpler model takes for fights, and how many otherwise than was decided. */
static void check_model(tally *t, const char *line, const json_t *root, const json_t *m, const dp_setup *setup) {
    const json_t *findings = node_at(root, "findings");
    const bool eyes = node_at(root, "eyes") != NULL;
    size_t count = 0, differ = 0;
    for (size_t i = 0; i < json_array_size(findings); i++) {
        const json_t *f = json_array_get(findings, i);
        if (eyes && isnan(number_at(f, "seen_from")))
            continue;
        const bool own = fights(root, f, setup),
                   decided = eyes ? !isnan(number_at(f, "fights_from")) : flag_at(f, "fights");
        count += own;
        differ += own != decided;
    }
    TALLY(t, number_at(m, "fights") == (double)count && number_at(m, "differs") == (double)differ,
          "%s: %s: %g fight, %g differ, not %zu, %zu", line, text_at(m, "model"), number_at(m, "fights"),
          number_at(m, "differs"), count, differ);
}

/* Below what was found stands whether a simpler model would have decided alike, and in how many pairs not. */
TEST(simpler_models) {
    static const struct {
        const char *options, *format, *said;
        dp_mapping mapping;
        size_t models;
    } rows[] = {
        {"house.gltf -F d24 -m d3d", "unorm24", "Decided in float, facing the camera; staged decides alike.\n",
         DP_MAPPING_D3D, 2},
        {"house.gltf -F fp32 -m gl --within 300", "fp32", "Decided in float, facing the camera; ", DP_MAPPING_GL, 2},
        {"house.gltf -F fp32 -m reversed --viewport 1920x1080", "fp32",
         "Decided in float, at any slant; exact differs in 15, staged in 15, float facing\n  the camera in 15.\n",
         DP_MAPPING_REVERSED, 3},
        {"house.gltf -F d24 -m reversed -n 0.1 -f 1000 --camera street --within 60", "unorm24",
         "Decided in float, at any slant; ", DP_MAPPING_REVERSED, 3},
        {"street.obj --separation 0.02 -F d24 -m d3d --within 50", "unorm24", "Decided in float, facing the camera; ",
         DP_MAPPING_D3D, 2},
        {"street.obj --separation 0.02 -F d16 -m linear", "unorm16",
         "Decided in staged, facing the camera; exact decides alike.\n", DP_MAPPING_LINEAR, 1},
    };
    tally t = {.name = "models"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const char *const line = rows[i].options;
        printed p = print_of("scene tests/models/%s", line);
        json_t *root = json_printed(p.status, "scene tests/models/%s", line);
        const dp_setup setup = SETUP(rows[i].format, .mapping = rows[i].mapping);
        const json_t *any = node_at(root, "any_slant");
        TALLY(&t, strstr(p.out, rows[i].said) != NULL, "%s: '%s' is not said: %s", line, rows[i].said, p.out);
        TALLY(&t, json_array_size(node_at(root, "models")) == rows[i].models, "%s: models", line);
        for (size_t k = 0; k < rows[i].models; k++) {
            const json_t *m = node_at(root, "models[%zu]", k);
            const dp_setup own = setup_in(&setup, (dp_model)k);
            TALLY(&t, strcmp(text_at(m, "model"), dp_model_name((dp_model)k)) == 0, "%s: %s", line,
                  text_at(m, "model"));
            check_model(&t, line, root, m, &own);
        }
        TALLY(&t, (any != NULL) == (rows[i].models == 2), "%s: at any slant", line);
        if (any != NULL) {
            const dp_setup slanted = setup_of(rows[i].format, rows[i].mapping, true);
            check_model(&t, line, root, any, &slanted);
        }
        json_decref(root);
        printed_free(&p);
    }
    tally_end(&t);
}

/* Only with --full: each model's time stands behind it, in text and in JSON, within what the program took. */
TEST(times_of_models) {
    static const char *const lines[] = {"house.gltf -F d24 -m d3d", "house.gltf -F d24 -m d3d --viewport 1920x1080",
                                        "house.gltf -F d24 -m reversed -n 0.1 -f 1000 --camera street --within 60",
                                        "street.obj --separation 0.02 -F d16 -m log"};
    tally t = {.name = "times"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        printed plain = print_of("scene tests/models/%s", lines[i]);
        printed p = print_of("scene tests/models/%s --full", lines[i]);
        json_t *root = json_printed(p.status, "scene tests/models/%s --full", lines[i]);
        json_t *without = json_printed(p.status, "scene tests/models/%s", lines[i]);
        TALLY(&t, strstr(plain.out, " ms)") == NULL && node_at(without, "decided") == NULL, "%s: unasked", lines[i]);
        TALLY(&t, strstr(plain.out, "Decided in ") != NULL && strstr(p.out, "Decided in ") != NULL, "%s", lines[i]);
        const char *said = strstr(p.out, "Decided in ");
        double ms = (double)NAN;
        TALLY(&t, sscanf(said + strcspn(said, "("), "(%lf ms)", &ms) == 1, "%s: no time: %s", lines[i], said);
        TALLY(&t, ms > 0 && ms < 1e4, "%s: %g ms in: %s", lines[i], ms, said);
        TALLY(&t, number_at(root, "decided.seconds") > 0, "%s: decided", lines[i]);
        for (size_t k = 0; k < json_array_size(node_at(root, "models")); k++) {
            const json_t *m = node_at(root, "models[%zu]", k);
            TALLY(&t, number_at(m, "seconds") > 0 && number_at(m, "seconds") < 10, "%s: %zu", lines[i], k);
            TALLY(&t, node_at(node_at(without, "models[%zu]", k), "seconds") == NULL, "%s: unasked", lines[i]);
        }
        json_decref(root);
        json_decref(without);
        printed_free(&plain);
        printed_free(&p);
    }
    tally_end(&t);
}

TEST(refused) {
    static const refused_row models[] = {
        {"", "scene: needs MODEL", 2},
        {"none.obj", "none.obj: No such file or directory", 3},
        {"/dev/null", "/dev/null: is neither glTF 2.0 (.glb, .gltf) nor, by its name, OBJ", 2},
    };
    static const refused_row rows[] = {
        {"-F d24,fp32", "--format: and --mapping must name one camera here, got 2", 2},
        {"--separation -1", "--separation: must be", 2},
        {"--within 2000", "--within: must lie between near and far, got '2000'", 2},
        {"--separation 1e51", "--separation: must be at most 1e+50 here, got '1e+51'", 2},
        {"--angle 89.5", "--angle: must be at most 89 degrees here, got '89.5'", 2},
        {"--also fcing", "--also: must be", 2},
        {"--ortho", "--ortho: is not an option of scene", 2},
    };
    CHECK_REFUSED("scene", models);
    CHECK_REFUSED("scene " STREET, rows);
}

/* How far apart surfaces are is a length, on whichever side of the first the second lies. */
TEST(a_gap_behind_the_first) {
    for (int behind = 0; behind < 2; behind++) {
        const char *path = scratch_text("pair.obj",
                                        "o first\nv 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\n"
                                        "o second\nv 0 0 %s\nv 4 0 %s\nv 0 4 %s\nf 4 5 6\n",
                                        behind ? "-0.0078125" : "0.0078125", behind ? "-0.0078125" : "0.0078125",
                                        behind ? "-0.0078125" : "0.0078125");
        json_t *root = json_printed(0, "scene %s --separation 0.02", path);
        const json_t *found = node_at(root, "findings[0]");
        assert_int_equal(json_array_size(node_at(root, "findings")), 1);
        assert_true(number_at(found, "gap_min") == 0x1p-7 && number_at(found, "gap_max") == 0x1p-7);
        json_decref(root);
    }
}
