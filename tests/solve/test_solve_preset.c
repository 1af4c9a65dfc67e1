/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The number of a preset that keeps a separation, by planes of the test's own formula and dp_separation(): the ends
 * pass, and next beyond them is one that fails; of those between fewer than one in a thousand fail, since they are
 * tried and not proven; where there is no answer, none passes. The answer as printed passes.
 */
#include "solve/preset.h"

#include "printed.h"
#include "support.h"

static const double pi = 3.14159265358979323846;

/* The globe of MapLibre, metres: near half a pixel, far behind the globe, the middle 1.5 heights away. */
static dp_setup globe_at(double zoom, double latitude, int height, double *focus) {
    const double radius = 6371008.8, pixel = 2 * pi * radius * cos(latitude * pi / 180) / (512 * pow(2, zoom));
    dp_spec spec = dp_spec_default();
    dp_format formats[2];
    dp_setup setup;
    dp_format_parse("unorm24", formats);
    spec.format = formats[0];
    spec.mapping = DP_MAPPING_GL;
    spec.model = DP_MODEL_FLOAT;
    *focus = 1.5 * height * pixel;
    spec.znear = .5 * pixel;
    spec.zfar = *focus + 2 * radius;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

static preset_problem problem_of(const char *text, double limit, double z) {
    preset_problem p = {.spec = dp_spec_default(), .limit = limit, .lo = z, .hi = z, .unit = unit_find("m")};
    char error[PRESET_ERROR_SIZE];
    dp_format formats[2];
    assert_true(preset_read(text, &p.row, &p.values, error));
    dp_format_parse(p.row->format, formats);
    p.spec.format = formats[0];
    p.spec.mapping = p.row->mapping;
    p.spec.model = DP_MODEL_FLOAT;
    return p;
}

/* Within a part in 10^9 of the limit the test's planes and the preset's are off by rounding. */
static bool keeps(double zoom, double latitude, int height, double limit, double z, bool surely) {
    double focus;
    const dp_setup setup = globe_at(zoom, latitude, height, &focus);
    const double at = isnan(z) ? focus : z;
    return at >= setup.spec.znear && at <= setup.spec.zfar &&
           dp_separation(&setup, at) <= limit * (surely ? 1 + 1e-9 : 1 - 1e-9);
}

/* Whether the planes just beyond an end leave the depth out, or the middle. */
static bool is_left_out(double zoom, double latitude, int height, double z) {
    double focus;
    const dp_setup setup = globe_at(zoom, latitude, height, &focus);
    const double at = isnan(z) ? focus : z;
    return at < setup.spec.znear || at > setup.spec.zfar;
}

static bool fails_beside(const preset_problem *p, double end, int side) {
    for (double apart = 1e-13; apart < 1e-9; apart *= 2)
        if (!preset_passes(p, end * (1 + side * apart)))
            return true;
    return false;
}

TEST(test_zoom) {
    rng r = rng_make("zooms");
    tally t = {.name = "zooms that keep a separation"};
    int ends = 0, inside = 0, failing = 0, outside[2] = {0};
    for (int i = 0; i < 60; i++) {
        const double latitude = floor(rng_uniform(&r, -80, 80)), limit = rng_log(&r, 0.01, 1e4);
        const int height = 200 + (int)rng_below(&r, 1500);
        const double z = i % 2 == 0 ? (double)NAN : rng_log(&r, 100, 1e6);
        char text[96];
        snprintf(text, sizeof text, "maplibre-globe:latitude=%g,height=%d", latitude, height);
        const preset_problem p = problem_of(text, limit, z);
        preset_answer a;
        preset_solve(&p, &a);
        for (int k = 0; k <= 200 && a.possible; k++, inside++)
            failing += !keeps(a.from + (a.to - a.from) * k / 200, latitude, height, limit, z, true);
        for (int k = 0; k < 2 && a.possible; k++) {
            const double end = k == 0 ? a.from : a.to;
            const bool turns = k == 0 ? a.below : a.above;
            ends += turns;
            TALLY(&t, keeps(end, latitude, height, limit, z, true), "%s %g %g: fails at %.17g", text, limit, z, end);
            TALLY(&t, !turns || fails_beside(&p, end, k == 0 ? -1 : 1), "%s %g %g: passes beside %.17g", text, limit, z,
                  end);
            const bool out = is_left_out(end * (k == 0 ? 1 - 1e-9 : 1 + 1e-9), latitude, height, z);
            outside[out] += turns;
            TALLY(&t, !turns || out == (k == 0 ? a.below_outside : a.above_outside), "%s %g %g: %sleft out at %.17g",
                  text, limit, z, out ? "" : "not ", end);
        }
        for (int k = 0; k <= 260 && !a.possible; k++)
            TALLY(&t, !keeps(k / 10., latitude, height, limit, z, false), "%s %g %g: %g", text, limit, z, k / 10.);
    }
    assert_true(outside[0] > 10 && outside[1] > 3);
    assert_true(ends > 40 && inside > 5000 && 1000 * failing < inside);
    tally_end(&t);
}

/* The larger a model, the farther off is the near plane of its viewer, a hundredth of its diagonal, at last behind z.
 */
TEST(test_left_out_above) {
    const preset_problem p = problem_of("gltf-viewer", 0.01, 40);
    preset_answer a;
    preset_solve(&p, &a);
    assert_true(a.above && a.above_outside && fabs(a.to - 4000) < 1e-8 && a.below && !a.below_outside);
    printed text = print_of("solve --preset gltf-viewer --separation 1cm --at 40m");
    assert_true(strstr(text.out, "above  ") != NULL && strstr(text.out, "below  ") == NULL);
    printed_free(&text);
}

/* The program says the same number, rounded to the side on which it holds. */
TEST(test_printed) {
    printed text = print_of("solve --preset maplibre-globe:height=800 --separation 100m");
    const preset_problem p = problem_of("maplibre-globe:height=800", 100, (double)NAN);
    preset_answer a;
    preset_solve(&p, &a);
    assert_int_equal(text.status, 0);
    const char *zoom = strstr(text.out, "zoom ");
    assert_non_null(zoom);
    const double said = strtod(zoom + strlen("zoom "), NULL);
    assert_true(said >= a.from && said < a.from + 1e-3 && preset_passes(&p, said) && a.below && !a.above);
    assert_true(strspn(zoom + strlen("zoom "), "0123456789.") <= 8); /* no more digits than that takes */
    assert_true(keeps(said, 0, 800, 100, (double)NAN, true));
    assert_false(keeps(said - 1, 0, 800, 100, (double)NAN, false)); /* steps come and go by less than a level */
    printed_free(&text);
}

/* The depths that are given, by --at and as a range, are those at which it holds, not where the camera looks. */
TEST(test_depths_given) {
    static const struct {
        const char *options;
        double lo, hi;
    } rows[] = {{"--at 1000km", 1e6, 1e6}, {"--at 3km", 3e3, 3e3}, {"--range 2km:50km", 2e3, 5e4}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        json_t *root =
            json_printed(0, "solve --preset maplibre-globe:height=800 --separation 100m %s", rows[i].options);
        const double from = number_at(root, "from"), to = number_at(root, "to");
        assert_true(number_at(root, "lo") == rows[i].lo && number_at(root, "hi") == rows[i].hi && from <= to);
        for (int k = 0; k < 2; k++) {
            assert_true(keeps(k == 0 ? from : to, 0, 800, 100, rows[i].lo, true));
            assert_true(keeps(k == 0 ? from : to, 0, 800, 100, rows[i].hi, true));
        }
        json_decref(root);
    }
}

/* In the middle of the globe, 700 pixels high, the near plane in place of the preset's. */
static double behind_near(double zoom, double znear) {
    double focus;
    dp_spec spec = globe_at(zoom, 40, 700, &focus).spec;
    dp_setup setup;
    spec.znear = znear;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return dp_separation(&setup, focus);
}

/* table says it of three separations, beside whatever zoom is given; rounded to three digits. */
TEST(test_in_table) {
    printed text = print_of("table --preset maplibre-globe:zoom=3,height=700,latitude=40 -n 50m --at 1km");
    const char *const names[] = {" 1 mm from zoom ", " 1 cm from zoom ", " 10 cm from zoom "};
    const double limits[] = {0.001, 0.01, 0.1};
    assert_int_equal(text.status, 0);
    for (char *c = text.out; (c = strstr(c, "\n  ")) != NULL;)
        memmove(c, c + 2, strlen(c + 2) + 1), *c = ' ';
    for (int i = 0; i < 3; i++) {
        const char *at = strstr(text.out, names[i]);
        assert_non_null(at);
        const double zoom = strtod(at + strlen(names[i]), NULL);
        assert_true(behind_near(zoom, 50) <= limits[i]);
        assert_true(behind_near(zoom - 0.2, 50) > limits[i]);
    }
    printed_free(&text);
}
