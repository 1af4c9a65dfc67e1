/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What `world` prints: every value, against the library; how far is far enough, from both sides. */
#include "printed.h"
#include "world/reach.h"

static const double distances[] = {2e3, 3e5, 5e7};
static const char *const schemes[] = {"camera-float", "split", "two-sum"};
static const double sizes[] = {NAN, 1024.0, NAN};

static world_scheme scheme_of(size_t k) {
    size_t row = 0;
    while (strcmp(world_get(row)->name, schemes[k]) != 0)
        row++;
    return (world_scheme){world_get(row), isnan(sizes[k]) ? 0.0 : sizes[k]};
}

/* The largest distance up to which it holds, to 1e-8: it does there, and not a little beyond. */
static double farthest(world_loss *loss, const world_scheme *s, const world_asked *a, double limit) {
    const double to = world_reach(loss, s, a, limit);
    if (to >= WORLD_FARTHEST)
        return INFINITY;
    assert_true(to == 0.0 || loss(s, a, to) <= limit);
    assert_true(loss(s, a, to * (1.0 + 1e-8) + 1e-3 * (to == 0.0)) > limit);
    return to;
}

/* Long: one report, read from the outside in. */
TEST(test_world) {
    static const double gaps[] = {0.02, 0.02, 1e-5,
                                  30.0}; /* the third fights where it stands still, the last jitters */
    for (int run = 0; run < 4; run++) {
        const bool shared = run == 1;
        dp_spec spec = dp_spec_default();
        dp_setup setup;
        dp_format formats[2];
        spec.znear = 0.25;
        spec.zfar = 4000.0;
        dp_format_parse("unorm24", formats);
        spec.format = formats[0];
        spec.mapping = DP_MAPPING_D3D;
        spec.model = DP_MODEL_FLOAT;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        const double half = tan(25.0 * 3.14159265358979323846 / 180.0), z = 7.0, gap = gaps[run];
        const world_asked a = {.setup = &setup,
                               .z = z,
                               .ray_ratio = hypot(1.0, half * hypot(1.0, 800.0 / 600.0)),
                               .pixels = 300.0 / half,
                               .shared_origin = shared};
        const world_asked nearly = {
            .setup = &setup, .z = z, .ray_ratio = a.ray_ratio * (1.0 + 1e-12), .pixels = a.pixels};
        for (size_t k = 0; k < 3; k++) { /* view and depth reach the numbers */
            const world_scheme s = scheme_of(k);
            assert_relative(world_off(&s, &a, 2e3), world_off(&s, &nearly, 2e3), 1e-9);
        }
        printed p = print_of("world -n 0.25 -f 4000 -F d24 -m d3d --at 7 --separation %g --viewport 800x600 --fov 50 "
                             "--from-origin 2000,3e5,5e7 --scheme camera-float,split:1024,two-sum --json%s",
                             gap, shared ? " --share" : "");
        assert_int_equal(p.status, 0);
        json_error_t error;
        json_t *root = json_loads(p.out, JSON_REJECT_DUPLICATES, &error);
        assert_non_null(root);
        json_t *at = json_object_get(json_array_get(json_object_get(root, "setups"), 0), "distances");
        assert_int_equal(json_array_size(at), 3);
        assert_scene(json_number_value(json_object_get(root, "gap")), gap, 0);
        assert_scene(json_number_value(json_object_get(root, "z")), z, 0);
        assert_int_equal(json_is_true(json_object_get(root, "share")), shared);
        for (size_t d = 0; d < 3; d++) {
            json_t *one = json_array_get(at, d), *lines = json_object_get(one, "schemes");
            const char *enough = NULL;
            assert_int_equal(json_array_size(lines), 3);
            assert_scene(json_number_value(json_object_get(one, "distance")), distances[d], 0);
            for (size_t k = 0; k < 3; k++) {
                const world_scheme s = scheme_of(k);
                json_t *line = json_array_get(lines, k);
                const struct {
                    const char *key;
                    double want;
                } numbers[] = {{"size", sizes[k]},
                               {"view_z_error", world_off(&s, &a, distances[d])},
                               {"safe_gap", world_separation(&s, &a, distances[d])},
                               {"jitter", world_jitter(&s, &a, distances[d])},
                               {"safe_to", farthest(world_separation, &s, &a, gap)},
                               {"still_to", farthest(world_jitter, &s, &a, 1.0)}};
                for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
                    json_t *got = json_object_get(line, numbers[i].key);
                    if (isfinite(numbers[i].want))
                        assert_relative(json_number_value(got), numbers[i].want, 1e-8);
                    else
                        assert_true(json_is_null(got));
                }
                const bool safe = numbers[2].want <= gap, still = numbers[3].want < 1.0;
                enough = enough == NULL && safe && still ? schemes[k] : enough;
                assert_string_equal(json_string_value(json_object_get(line, "scheme")), schemes[k]);
                assert_string_equal(json_string_value(json_object_get(line, "verdict")), safe && still ? "holds"
                                                                                         : safe        ? "jitters"
                                                                                         : still       ? "fights"
                                                                                                 : "fights, jitters");
            }
            json_t *first = json_object_get(one, "enough");
            if (enough == NULL)
                assert_true(json_is_null(first));
            else
                assert_int_equal(strncmp(json_string_value(first), enough, strlen(enough)), 0);
        }
        json_decref(root);
        printed_free(&p);
    }
}

/* budget --scheme: the room's own budget at a corner of the box; absolute is what --from-origin means without. */
TEST(test_budget) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    dp_format formats[2];
    dp_budget b;
    dp_budget_terms terms = {0};
    spec.znear = 0.1;
    spec.zfar = INFINITY;
    dp_format_parse("fp32", formats);
    spec.format = formats[0];
    spec.mapping = DP_MAPPING_REVERSED;
    spec.model = DP_MODEL_FLOAT;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    const world_scheme s = {scheme_of(1).row, 65536.0};
    const world_asked a = {.setup = &setup, .z = 30.0, .ray_ratio = 2.0};
    assert_int_equal(world_budget(&s, &a, sqrt(3.0) * 1e5, &terms, &b), DP_OK);
    printed p = print_of("budget -n 0.1 -f inf -F fp32 -m reversed --from-origin 1e5 --scheme split --at 30 --json");
    json_error_t error;
    json_t *root = json_loads(p.out, JSON_REJECT_DUPLICATES, &error);
    json_t *row = json_array_get(json_object_get(json_array_get(json_object_get(root, "setups"), 0), "rows"), 0);
    assert_relative(json_number_value(json_object_get(row, "separation")), b.separation, 1e-12);
    json_t *causes = json_object_get(row, "causes");
    assert_relative(json_number_value(json_object_get(causes, "position")), b.cause[DP_CAUSE_COMPOSITION], 1e-9);
    assert_null(json_object_get(causes, "composition"));
    json_decref(root);
    printed_free(&p);
    printed plain = print_of("budget -n 0.1 -f inf -F fp32 -m reversed --from-origin 1e5 --at 30");
    printed named = print_of("budget -n 0.1 -f inf -F fp32 -m reversed --from-origin 1e5 --at 30 --scheme absolute");
    assert_string_equal(plain.out, named.out);
    printed_free(&plain);
    printed_free(&named);
}

/* check: the same of a camera in a file. */
TEST(test_check) {
    static const char *const wrong[] = {"from_origin = 5.0;",
                                        "scheme = \"split\";",
                                        "from_origin = 5.0; scheme = \"splt\";",
                                        "from_origin = 5.0; scheme = \"split:3\";",
                                        "from_origin = -5.0; scheme = \"split\";",
                                        "from_origin = 5.0; scheme = \"tile\"; model = \"exact\";"};
    static const char head[] = "unit = \"m\"; cameras = { a = { near = 0.1; far = \"inf\"; mapping = \"reversed\"; "
                               "format = \"fp32\"; ";
    static const char tail[] =
        "}; }; requirements = { r = { camera = \"a\"; at = \"30 m\"; separation = \"1 cm\"; }; };";
    char path[512];
    snprintf(path, sizeof path, "%s", scratch_file("world.need"));
    printed shown =
        print_of("budget -n 0.1 -f inf -F fp32 -m reversed --from-origin 1e5 --scheme split --at 30 --json");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "%sfrom_origin = \"100 km\"; scheme = \"split\"; %s", head, tail);
    fclose(file);
    printed p = print_of("check --report json %s", path);
    assert_int_equal(p.status, 1); /* 1.4 cm, not 1 */
    json_error_t error;
    json_t *root = json_loads(p.out, 0, &error), *asked = json_loads(shown.out, 0, &error);
    json_t *row = json_array_get(json_object_get(json_array_get(json_object_get(asked, "setups"), 0), "rows"), 0);
    json_t *verdict = json_array_get(json_object_get(root, "requirements"), 0);
    assert_relative(json_number_value(json_object_get(verdict, "value")),
                    json_number_value(json_object_get(row, "separation")), 1e-12);
    json_decref(root);
    json_decref(asked);
    printed_free(&p);
    printed_free(&shown);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        file = fopen(path, "w");
        assert_non_null(file);
        fprintf(file, "%s%s%s", head, wrong[i], tail);
        fclose(file);
        p = print_of("check %s", path);
        assert_int_equal(p.status, 2);
        assert_non_null(strstr(p.errors, "world.need"));
        printed_free(&p);
    }
}

/* A view so wide that its corners are 47 times as far away as its middle: they are seen, too. */
TEST(test_wide) {
    const double pi = 3.14159265358979323846, half = tan(87.5 * pi / 180.0);
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    const world_asked a = {.setup = &setup, .z = 10.0, .ray_ratio = hypot(1.0, half * hypot(1.0, 1920.0 / 1080.0))};
    const world_scheme s = scheme_of(2);
    printed p = print_of("world --fov 175 --at 10 --from-origin 1e3 --scheme two-sum --json");
    json_error_t error;
    json_t *root = json_loads(p.out, 0, &error);
    json_t *distance =
        json_array_get(json_object_get(json_array_get(json_object_get(root, "setups"), 0), "distances"), 0);
    json_t *line = json_array_get(json_object_get(distance, "schemes"), 0);
    assert_relative(json_number_value(json_object_get(line, "view_z_error")), world_off(&s, &a, 1e3), 1e-9);
    json_decref(root);
    printed_free(&p);
}

/* Unreal's tile is 2097152 of its units, which are centimetres; what others count in is not said. */
TEST(test_sizes) {
    static const struct {
        const char *arguments, *first, *second;
    } rows[] = {{"--preset unreal", "tile:2097152", "split:65536"},
                {"--unit mm", "tile:20971520", "cell:2000"},
                {"--unit m --scheme tile", "tile:20971.52", "tile:20971.52"},
                {"--unit cm --scheme tile:20971.52,tile", "tile:20971.52 ", "tile:2097152"},
                {"", "tile:20971.52", "split:65536"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        printed p = print_of("world %s", rows[i].arguments);
        assert_int_equal(p.status, 0);
        assert_non_null(strstr(p.out, rows[i].first));
        assert_non_null(strstr(p.out, rows[i].second));
        printed_free(&p);
    }
    static const char *const written[] = {"", ":2097152"};
    double value[2];
    for (int i = 0; i < 2; i++) {
        char path[512];
        snprintf(path, sizeof path, "%s", scratch_file("tile.need"));
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fprintf(file,
                "unit = \"cm\"; cameras = { a = { near = 10.0; far = \"inf\"; mapping = \"reversed\"; format = "
                "\"fp32\"; from_origin = \"100 km\"; scheme = \"tile%s\"; }; }; requirements = { r = { camera = \"a\"; "
                "at = \"30 m\"; separation = \"1 cm\"; }; };",
                written[i]);
        fclose(file);
        printed p = print_of("check --report json %s", path);
        json_error_t error;
        json_t *root = json_loads(p.out, 0, &error);
        value[i] =
            json_number_value(json_object_get(json_array_get(json_object_get(root, "requirements"), 0), "value"));
        json_decref(root);
        printed_free(&p);
    }
    assert_true(value[0] > 0.1); /* not of a tile of 210 m, 100 times smaller */
    assert_relative(value[0], value[1], 1e-12);
}
