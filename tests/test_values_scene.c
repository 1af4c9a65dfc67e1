/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene: what is printed of models put together here, against what they are and against the library. */
#include <jansson.h>

#include "depthprec/depthprec.h"
#include "printed.h"

#define STREET "tests/models/street.obj"

static double number(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    assert_true(json_is_number(value));
    return json_number_value(value);
}

static const char *word(const json_t *object, const char *part, const char *key) {
    const char *text = json_string_value(json_object_get(json_object_get(object, part), key));
    assert_non_null(text);
    return text;
}

static json_t *object_of(const char *options, int status) {
    printed p = print_of("scene %s %s --json", STREET, options);
    json_error_t error;
    if (p.status != status)
        fail_msg("%s: status %d: %s", options, p.status, p.errors);
    json_t *root = json_loads(p.out, 0, &error);
    assert_non_null(root);
    printed_free(&p);
    return root;
}

static dp_setup setup_of(const char *format, dp_mapping mapping, bool slanted) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_setup setup;
    assert_int_equal(dp_format_parse(format, found), 1);
    spec.format = found[0];
    spec.mapping = mapping;
    spec.model = DP_MODEL_FLOAT;
    if (slanted)
        spec.triangles = dp_triangles_default();
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

static const struct {
    const char *a, *b, *material;
    double gap, area, lo[3], hi[3];
} pairs[] = {{"wall", "sign", "tin", 0x1p-10, 2, {21, 1, 0}, {22, 3, 0}},
             {"road", "paint", "white", 0x1p-6, 16, {-1, 0, -4}, {1, 0, 4}}};

/* One finding: whether it is certain up to `within`. */
static bool check_finding(const json_t *f, size_t k, const dp_setup *setup, double within) {
    const json_t *place = json_object_get(f, "place");
    dp_separation_worst worst;
    assert_string_equal(word(f, "a", "node"), pairs[k].a);
    assert_string_equal(word(f, "b", "node"), pairs[k].b);
    assert_string_equal(word(f, "b", "material"), pairs[k].material);
    assert_true(number(f, "gap_min") == pairs[k].gap && number(f, "gap_max") == pairs[k].gap);
    assert_relative(number(f, "area"), pairs[k].area, 1e-12);
    for (int axis = 0; axis < 3; axis++) {
        const double at = number(place, (const char *const[]){"x", "y", "z"}[axis]);
        assert_true(at >= pairs[k].lo[axis] && at <= pairs[k].hi[axis]);
    }
    const double certain = number(f, "certain_to");
    assert_int_equal(dp_separation_over(setup, 0.1, certain, pairs[k].gap, &worst), DP_OK);
    assert_true(worst.bound <= pairs[k].gap);
    if (certain < 999) {
        dp_separation_over(setup, 0.1, certain * (1 + 2e-5), pairs[k].gap, &worst);
        assert_true(worst.bound > pairs[k].gap);
    }
    dp_separation_over(setup, 0.1, within, 0, &worst);
    assert_relative(number(f, "lift"), fmax(worst.bound - pairs[k].gap, 0.0), 1e-12);
    assert_int_equal(json_is_true(json_object_get(f, "fights")), certain < within);
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
        json_t *root = object_of(rows[i].options, rows[i].within > 0 ? 1 : 0);
        const json_t *list = json_object_get(root, "findings");
        assert_int_equal(json_array_size(list), 2);
        assert_relative(number(root, "extent"), extent, 1e-15);
        assert_relative(number(root, "within"), within, 1e-15);
        assert_true(number(root, "model_triangles") == 10 && number(root, "model_surfaces") == 5);
        assert_true(number(root, "gap") == 0.02 && number(root, "angle") == 1);
        /* wall and sign stand before the back side: four pairs of triangles with each */
        assert_true(number(json_object_get(root, "left_out"), "facing") >= 4);
        bool passed = true;
        double last = 0.0;
        unsigned seen = 0;
        for (size_t n = 0; n < 2; n++) {
            const json_t *f = json_array_get(list, n);
            const size_t k = strcmp(word(f, "a", "node"), "wall") == 0 ? 0 : 1;
            seen |= 1U << k;
            assert_true(number(f, "certain_to") >= last); /* the nearest fight first */
            last = number(f, "certain_to");
            passed = check_finding(f, k, &setup, within) && passed;
        }
        assert_int_equal(seen, 3);
        assert_int_equal(json_is_true(json_object_get(root, "passed")), passed && rows[i].within > 0);
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
        json_t *root = object_of(rows[i].options, 0);
        assert_int_equal(json_array_size(json_object_get(root, "findings")), rows[i].findings);
        if (rows[i].facing >= 0)
            assert_true(number(json_object_get(root, "left_out"), "facing") == rows[i].facing);
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
        printed p = print_of("scene %s %s --json", STREET, rows[i].options);
        json_t *root = json_loads(p.out, 0, NULL);
        assert_non_null(root);
        dp_spec spec = setup_of(rows[i].format, rows[i].mapping, false).spec;
        dp_setup setup;
        spec.zfar = number(json_object_get(root, "setup"), "far");
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const double within = number(root, "within"), gap = number(root, "gap");
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
        assert_int_equal(json_object_get(root, "passed") != NULL, asked);
        assert_true(!asked || json_is_true(json_object_get(root, "passed")) == (p.status == 0));
        char head[64];
        snprintf(head, sizeof head, " across; judged up to %.4g\n", within);
        json_decref(root);
        printed_free(&p);
        p = print_of("scene %s %s", STREET, rows[i].options);
        if (strstr(p.out, head) == NULL || strstr(p.out, head) > strchr(p.out, '\n'))
            fail_msg("'%s' is not in the first line of %s", head, p.out);
        printed_free(&p);
    }
}

/* What is printed to write says of what it holds: what faces the camera, or, where a view is, triangles of the class.
 */
TEST(facing_bias) {
    printed p = print_of("scene %s --separation 0.02 -F d24 -m d3d", STREET);
    assert_non_null(strstr(p.out, "where they face"));
    printed_free(&p);
    p = print_of("scene %s --separation 0.02 -F d24 -m d3d --viewport 1920x1080", STREET);
    assert_non_null(strstr(p.out, "in triangles as above"));
    assert_null(strstr(p.out, "where they face"));
    printed_free(&p);
}

/* The text has the same numbers, rounded to the safe side; CSV those of JSON. */
TEST(other_forms) {
    json_t *root = object_of("--separation 0.02 -F d24 -m d3d --within 50 --unit m", 1);
    const json_t *f = json_array_get(json_object_get(root, "findings"), 0);
    char want[256];
    printed p = print_of("scene %s --separation 0.02 -F d24 -m d3d --within 50 --unit m", STREET);
    assert_int_equal(p.status, 1);
    assert_non_null(strstr(p.out, "10 triangles, 5 surfaces, 36 m across"));
    assert_non_null(strstr(p.out, "2 pairs of surfaces lie within 0.02 m of each other: 1 can fight"));
    assert_non_null(strstr(p.out, "FAIL  surfaces can fight nearer than 50 m."));
    assert_non_null(strstr(p.out, "  1   'wall' (brick) and 'sign' (tin)\n"));
    snprintf(want, sizeof want, "certain up to %.4g m, ties from %.4g m; 9.766e-4 m apart",
             floor(number(f, "certain_to") * 100) / 100, ceil(number(f, "ties_from") * 100) / 100);
    if (strstr(p.out, want) == NULL)
        fail_msg("'%s' is not in %s", want, p.out);
    assert_non_null(strstr(p.out, "area 2, near "));
    printed_free(&p);
    p = print_of("scene %s --separation 0.02 --within 20", STREET);
    assert_int_equal(p.status, 0);
    assert_non_null(strstr(p.out, "of each other: none can fight up to 20."));
    assert_non_null(strstr(p.out, "pass  none fights nearer than 20."));
    assert_null(strstr(p.out, "'wall'"));
    printed_free(&p);
    p = print_of("scene %s --separation 0.02 -F d24 -m d3d --within 50 --unit m --csv", STREET);
    char *line = strtok(p.out, "\r\n");
    assert_non_null(strstr(line, "a_node,a_mesh,a_material,b_node,b_mesh,b_material,gap_min [scene],gap_max [scene]"));
    line = strtok(NULL, "\r\n");
    snprintf(want, sizeof want, "wall,,brick,sign,,tin,0.0009765625,0.0009765625,2,");
    assert_memory_equal(line, want, strlen(want));
    snprintf(want, sizeof want, ",%.17g,%.17g,%.17g,true", number(f, "certain_to"), number(f, "ties_from"),
             number(f, "lift"));
    for (const char *at = strchr(line + 50, ','); at != NULL; at = strchr(at + 1, ',')) {
        double a, b, c;
        char rest[8];
        if (sscanf(at, ",%lf,%lf,%lf,%7[a-z]", &a, &b, &c, rest) == 4 && strcmp(rest, "true") == 0) {
            assert_true(a == number(f, "certain_to") && b == number(f, "ties_from") && c == number(f, "lift"));
            line = NULL;
            break;
        }
    }
    assert_null(line);
    printed_free(&p);
    json_decref(root);
}

/* A vertex that no triangle uses reaches nowhere: neither the extent nor what follows from it changes. */
TEST(stray_vertex) {
    const char *path = scratch_file("stray.obj");
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs("v 0 0 0\nv 3 0 0\nv 0 4 0\nv 1e6 1e6 1e6\nf 1 2 3\n", out);
    assert_int_equal(fclose(out), 0);
    printed p = print_of("scene %s --json", path);
    json_t *root = json_loads(p.out, 0, NULL);
    assert_int_equal(p.status, 0);
    assert_non_null(root);
    assert_true(number(root, "extent") == 5 && number(root, "within") == 50);
    json_decref(root);
    printed_free(&p);
}

TEST(refused) {
    static const struct {
        const char *arguments;
        int status;
        const char *said;
    } rows[] = {
        {"scene", 2, "scene: needs MODEL"},
        {"scene none.obj", 3, "none.obj: No such file or directory"},
        {"scene /dev/null", 2, "/dev/null: is neither glTF 2.0 (.glb, .gltf) nor, by its name, OBJ"},
        {"scene %s -F d24,fp32", 2, "--format: and --mapping must name one camera here, got 2"},
        {"scene %s --separation -1", 2, "--separation: must be"},
        {"scene %s --within 2000", 2, "--within: must lie between near and far, got '2000'"},
        {"scene %s --separation 1e51", 2, "--separation: must be at most 1e+50 here, got '1e+51'"},
        {"scene %s --angle 89.5", 2, "--angle: must be at most 89 degrees here, got '89.5'"},
        {"scene %s --also fcing", 2, "--also: must be"},
        {"scene %s --ortho", 2, "--ortho: is not an option of scene"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char line[1024];
        const char *at = strstr(rows[i].arguments, "%s");
        if (at != NULL)
            snprintf(line, sizeof line, "%.*s%s%s", (int)(at - rows[i].arguments), rows[i].arguments, STREET, at + 2);
        else
            snprintf(line, sizeof line, "%s", rows[i].arguments);
        printed p = print_of("%s", line);
        if (p.status != rows[i].status || strstr(p.errors, rows[i].said) == NULL)
            fail_msg("%s: %d: %s", line, p.status, p.errors);
        printed_free(&p);
    }
}
