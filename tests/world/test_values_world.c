/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The output of `world`: every value, against the library; how far is far enough, from both sides. */
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

/* By its definition: what lies across the view, at the depth that is left in the worst case, in pixels. */
static double jitter_of(const world_scheme *s, const world_asked *a, double distance) {
    const world_where ahead = {distance, a->z, a->z}, beside = {distance, a->z, 0.0};
    const world_error along = world_bound(s, &ahead), across = world_bound(s, &beside);
    const double nearest = a->z - world_all(&along);
    return nearest > 0.0 ? a->pixels * world_all(&across) / nearest : INFINITY;
}

static void check_scheme(const json_t *line, const world_asked *a, size_t k, double distance, double gap) {
    const world_scheme s = scheme_of(k);
    const double safe_gap = world_separation(&s, a, distance), jitter = jitter_of(&s, a, distance);
    const struct {
        const char *key;
        double want;
    } numbers[] = {{"size", sizes[k]},
                   {"view_z_error", world_off(&s, a, distance)},
                   {"safe_gap", safe_gap},
                   {"jitter", jitter},
                   {"safe_to", farthest(world_separation, &s, a, gap)},
                   {"still_to", farthest(world_jitter, &s, a, 1.0)}};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        const double got = number_at(line, "%s", numbers[i].key);
        if (isfinite(numbers[i].want))
            assert_relative(got, numbers[i].want, 1e-8);
        else
            assert_true(isnan(got));
    }
    const bool safe = safe_gap <= gap, still = jitter < 1.0;
    assert_string_equal(text_at(line, "scheme"), schemes[k]);
    assert_string_equal(text_at(line, "verdict"), safe && still ? "holds"
                                                  : safe        ? "jitters"
                                                  : still       ? "z-fights"
                                                                : "z-fights, jitters");
}

/* The third gap fights where it stands still, the last jitters. */
TEST(each_number) {
    static const double gaps[] = {0.02, 0.02, 1e-5, 30.0};
    const dp_setup setup = SETUP("unorm24", .znear = 0.25, .zfar = 4000.0, .model = DP_MODEL_FLOAT);
    for (int run = 0; run < 4; run++) {
        const bool shared = run == 1;
        const double half = tan(25.0 * 3.14159265358979323846 / 180.0), z = 7.0, gap = gaps[run];
        const world_asked a = {.setup = &setup,
                               .z = z,
                               .ray_ratio = hypot(1.0, half * hypot(1.0, 800.0 / 600.0)),
                               .pixels = 300.0 / half,
                               .shared_origin = shared};
        world_asked nearly = a;
        nearly.ray_ratio *= 1.0 + 1e-12;
        nearly.shared_origin = false;
        for (size_t k = 0; k < 3; k++) { /* view and depth reach the numbers */
            const world_scheme s = scheme_of(k);
            assert_relative(world_off(&s, &a, 2e3), world_off(&s, &nearly, 2e3), 1e-9);
        }
        json_t *root =
            json_printed(0,
                         "world -n 0.25 -f 4000 -F d24 -m d3d --at 7 --separation %g --viewport 800x600 --fov 50 "
                         "--from-origin 2000,3e5,5e7 --scheme camera-float,split:1024,two-sum%s",
                         gap, shared ? " --share" : "");
        assert_int_equal(json_array_size(node_at(root, "setups[0].distances")), 3);
        assert_true(number_at(root, "gap") == gap && number_at(root, "z") == z && flag_at(root, "share") == shared);
        for (size_t d = 0; d < 3; d++) {
            const json_t *one = node_at(root, "setups[0].distances[%zu]", d);
            const char *enough = NULL, *said = text_at(one, "enough");
            assert_int_equal(json_array_size(node_at(one, "schemes")), 3);
            assert_true(number_at(one, "distance") == distances[d]);
            for (size_t k = 0; k < 3; k++) {
                const json_t *line = node_at(one, "schemes[%zu]", k);
                check_scheme(line, &a, k, distances[d], gap);
                enough = enough == NULL && strcmp(text_at(line, "verdict"), "holds") == 0 ? schemes[k] : enough;
            }
            assert_true((enough == NULL) == (said == NULL));
            assert_true(enough == NULL || strncmp(said, enough, strlen(enough)) == 0);
        }
        json_decref(root);
    }
}

/* budget --scheme: the room's own budget at a corner of the box; absolute is what --from-origin means without. */
TEST(budget) {
    static const char line[] = "budget -n 0.1 -f inf -F fp32 -m reversed --from-origin 1e5 --at 30";
    const dp_setup setup = SETUP("fp32", .zfar = INFINITY, .mapping = DP_MAPPING_REVERSED, .model = DP_MODEL_FLOAT);
    const world_scheme s = {scheme_of(1).row, 65536.0};
    const world_asked a = {.setup = &setup, .z = 30.0, .ray_ratio = 2.0};
    dp_budget_terms terms = {0};
    dp_budget b;
    assert_int_equal(world_budget(&s, &a, sqrt(3.0) * 1e5, &terms, &b), DP_OK);
    json_t *root = json_printed(0, "%s --scheme split", line);
    const json_t *row = node_at(root, "setups[0].rows[0]");
    assert_relative(number_at(row, "separation"), b.separation, 1e-12);
    assert_relative(number_at(row, "causes.position"), b.cause[DP_CAUSE_COMPOSITION], 1e-9);
    assert_null(node_at(row, "causes.composition"));
    json_decref(root);
    char *plain = output_of(0, line, ""), *named = output_of(0, line, "--scheme absolute");
    assert_string_equal(plain, named);
    free(plain);
    free(named);
}

/* The same with triangles on a screen: what a place is farther from the eye than deep is that of the screen's corner,
 * and of as many pixels beyond it as a triangle may reach, both ways; at least 2. */
TEST(budget_of_a_screen) {
    static const struct {
        int width, height;
        double fov, pixels;
    } rows[] = {{1920, 1080, 120, 4096}, {1920, 1080, 120, 16}, {1080, 1920, 150, 512},
                {640, 480, 30, 512},     {640, 480, 30, 8192},  {4096, 256, 100, 64}};
    const world_scheme s = {scheme_of(1).row, 65536.0};
    bool wider = false, usual = false;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        dp_triangles t = dp_triangles_default();
        t.width = rows[i].width;
        t.height = rows[i].height;
        t.fov_y = rows[i].fov;
        t.pixels = rows[i].pixels;
        const dp_setup setup =
            SETUP("fp32", .zfar = INFINITY, .mapping = DP_MAPPING_REVERSED, .model = DP_MODEL_FLOAT, .triangles = t);
        const double pixel = 2 * tan(rows[i].fov / 2 * M_PI / 180) / rows[i].height;
        const double x = pixel * (rows[i].width / 2.0 + rows[i].pixels);
        const double y = pixel * (rows[i].height / 2.0 + rows[i].pixels), ray = sqrt(1 + x * x + y * y);
        const world_asked a = {.setup = &setup, .z = 30.0, .ray_ratio = fmax(ray, 2)};
        dp_budget_terms terms = {0};
        dp_budget b;
        wider = wider || ray > 2;
        usual = usual || ray < 2;
        assert_int_equal(world_budget(&s, &a, sqrt(3.0) * 1e5, &terms, &b), DP_OK);
        json_t *root = json_printed(0,
                                    "budget -n 0.1 -f inf -F fp32 -m reversed --from-origin 1e5 --at 30 --scheme split "
                                    "--viewport %ux%u --fov %g --triangle-class pixels=%g",
                                    rows[i].width, rows[i].height, rows[i].fov, rows[i].pixels);
        assert_relative(number_at(node_at(root, "setups[0].rows[0]"), "separation"), b.separation, 1e-12);
        json_decref(root);
    }
    assert_true(wider && usual);
}

/* check: the same of a camera in a file. */
TEST(check) {
    static const char *const wrong[] = {"from_origin = 5.0;",
                                        "scheme = \"split\";",
                                        "from_origin = 5.0; scheme = \"splt\";",
                                        "from_origin = 5.0; scheme = \"split:3\";",
                                        "from_origin = -5.0; scheme = \"split\";",
                                        "from_origin = 5.0; scheme = \"tile\"; model = \"exact\";"};
    static const char file[] = "unit = \"m\"; cameras = { a = { near = 0.1; far = \"inf\"; mapping = \"reversed\"; "
                               "format = \"fp32\"; %s }; }; requirements = { r = { camera = \"a\"; at = \"30 m\"; "
                               "separation = \"1 cm\"; }; };";
    const char *path = scratch_text("world.need", file, "from_origin = \"100 km\"; scheme = \"split\";");
    json_t *root = json_printed(1, "check %s", path); /* 1.4 cm, not 1 */
    json_t *asked =
        json_printed(0, "budget -n 0.1 -f inf -F fp32 -m reversed --from-origin 1e5 --scheme split --at 30");
    assert_relative(number_at(root, "requirements[0].value"), number_at(asked, "setups[0].rows[0].separation"), 1e-12);
    json_decref(root);
    json_decref(asked);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        check_says(2, "world.need", "check %s", scratch_text("world.need", file, wrong[i]));
}

/* A view so wide that its corners are 47 times as far away as its middle: they are seen, too. */
TEST(wide) {
    const double pi = 3.14159265358979323846, half = tan(87.5 * pi / 180.0);
    const dp_setup setup = SETUP("fp32", .mapping = DP_MAPPING_D3D);
    const world_asked a = {.setup = &setup, .z = 10.0, .ray_ratio = hypot(1.0, half * hypot(1.0, 1920.0 / 1080.0))};
    const world_scheme s = scheme_of(2);
    json_t *root = json_printed(0, "world --fov 175 --at 10 --from-origin 1e3 --scheme two-sum");
    assert_relative(number_at(root, "setups[0].distances[0].schemes[0].view_z_error"), world_off(&s, &a, 1e3), 1e-9);
    json_decref(root);
}

/* Unreal's tile is 2097152 of its units, which are centimetres; what others count in is not said. */
TEST(sizes_of_tiles) {
    static const struct {
        const char *arguments, *first, *second;
    } rows[] = {{"--preset unreal", "tile:2097152", "split:65536"},
                {"--unit mm", "tile:20971520", "cell:2000"},
                {"--unit m --scheme tile", "tile:20971.52", "tile:20971.52"},
                {"--unit cm --scheme tile:20971.52,tile", "tile:20971.52 ", "tile:2097152"},
                {"", "tile:20971.52", "split:65536"}};
    static const char *const written[] = {"", ":2097152"};
    double value[2];
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        check_says(0, rows[i].first, "world %s", rows[i].arguments);
        check_says(0, rows[i].second, "world %s", rows[i].arguments);
    }
    for (int i = 0; i < 2; i++) {
        json_t *root = json_printed(
            -1, "check %s",
            scratch_text(
                "tile.need",
                "unit = \"cm\"; cameras = { a = { near = 10.0; far = \"inf\"; mapping = \"reversed\"; format = "
                "\"fp32\"; from_origin = \"100 km\"; scheme = \"tile%s\"; }; }; requirements = { r = { camera "
                "= \"a\"; at = \"30 m\"; separation = \"1 cm\"; }; };",
                written[i]));
        value[i] = number_at(root, "requirements[0].value");
        json_decref(root);
    }
    assert_true(value[0] > 0.1); /* not of a tile of 210 m, 100 times smaller */
    assert_relative(value[0], value[1], 1e-12);
}

/* A step of binary32 numbers from 2^19 on is 2^-4, from 2^14 on 2^-9. */
TEST(why) {
    check_says(0, "0.0625 apart, 6.25 times", "world --from-origin 1e6");
    check_says(0, "30 km from the origin are 0.00195 m apart; matrices and", "world --unit m --from-origin 30km");
    check_says(0, "!why", "world --from-origin 10");
}

/* The advice of budget where positions take most is at most a twentieth worse than all places in double, which is tried
 * here by itself. */
TEST(advice) {
    static const char *const names[] = {"local", "camera-float", "split", "tile", "cell", "two-sum"};
    rng r = rng_make("advice");
    tally t = {.name = "advice"};
    uint64_t closer = 0; /* by less than half */
    for (uint64_t i = test_cases(40, 200, 2000); i > 0; i--) {
        char line[256];
        snprintf(line, sizeof line, "budget -n 0.1 -f %.4g -F %s -m %s --from-origin %.4g --at %.4g --scheme",
                 rng_log(&r, 1e3, 1e5), rng_below(&r, 2) ? "d24" : "fp32", rng_below(&r, 2) ? "d3d" : "reversed",
                 rng_log(&r, 1, 1e5), rng_log(&r, 1, 500));
        json_t *one = json_printed(0, "%s %s", line, names[rng_below(&r, 6)]);
        json_t *best = json_printed(0, "%s camera-double", line);
        const double own = number_at(one, "setups[0].worst.separation"),
                     least = number_at(best, "setups[0].worst.separation"),
                     advised = number_at(one, "setups[0].worst.remedy_separation");
        if (!isnan(own) && strcmp(text_at(one, "setups[0].worst.cause"), "position") == 0) {
            TALLY(&t, fmin(own, advised) <= least / 0.95 * (1 + 1e-9), "%s: %g, advised %g, but %g", line, own, advised,
                  least);
            closer += least > 0.5 * own && least < 0.95 * own;
        }
        json_decref(one);
        json_decref(best);
    }
    print_message("# %lu of %lu by less than half\n", (unsigned long)closer, (unsigned long)t.cases);
    assert_true(closer > 0);
    tally_end(&t);
}
