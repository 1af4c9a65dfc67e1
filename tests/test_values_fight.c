/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that zfight --rasterize prints, against the room draw asked for the same pairs; options by hand. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "printed.h"
#include "raster/fight.h"

typedef struct fight_case {
    camera_case camera; /* its arithmetic is that of the rasterizer */
    const char *options;
    const char *raster, *arith;
    dp_triangles view; /* but for its plane */
    double azimuth, lo, hi;
    uint64_t pairs, seed;
} fight_case;

static const fight_case cases[] = {
    {{0.25, 900, {"fp32", "unorm16"}, {"d3d", "reversed"}, .implied = true, .model = DP_MODEL_FLOAT},
     "--raster swiftshader --viewport 640x360 --fov 75 --slant 20:70.5 --triangle-class slim=6,pixels=100,depth=1.5 "
     "--sample 21 --seed 8589934597",
     "swiftshader",
     "mesa",
     {640, 360, 75, 4, {0, 0, 0, 0}, 20, 70.5, 1.5, 100, 6},
     NAN,
     0.3,
     5,
     25, /* five bands */
     UINT64_C(8589934597)},
    {{0.1, INFINITY, {"unorm24"}, {"gl-reversed"}, .implied = true, .model = DP_MODEL_FLOAT, .unit = "cm"},
     "--slant 35,-120",
     "llvmpipe",
     "mesa-remap",
     {1920, 1080, 60, 0, {0, 0, 0, 0}, 35, 35, 2, 512, 16},
     -120,
     700,
     900,
     500,
     0},
    /* Nothing is certain. */
    {{0.001, 1e9, {"unorm16"}, {"d3d"}, .implied = true, .model = DP_MODEL_FLOAT},
     "--raster lavapipe --sample 9 --seed 4",
     "lavapipe",
     "mesa",
     {1920, 1080, 60, 0, {0, 0, 0, 0}, 0, 90, 2, 512, 16},
     NAN,
     1e7,
     1.5e7,
     9,
     4},
};

static draw_fight_result result_of(const fight_case *c, dp_setup *setup) {
    static draw_camera camera;
    draw_fight_result r;
    dp_spec spec = setup->spec;
    spec.triangles = c->view;
    spec.triangles.plane = dp_anchor_get(raster_find(c->raster)->anchor)->plane;
    assert_int_equal(dp_arith_parse(c->arith, &spec.arith), DP_OK);
    assert_int_equal(dp_setup_init(setup, &spec), DP_OK);
    assert_int_equal(draw_camera_init(&camera, raster_find(c->raster), setup), RASTER_OK);
    const draw_fight_request q = {.camera = &camera,
                                  .setup = setup,
                                  .azimuth = c->azimuth,
                                  .lo = c->lo,
                                  .hi = c->hi,
                                  .count = c->pairs,
                                  .seed = c->seed};
    assert_int_equal(draw_fight(&q, &r), DRAW_FIGHT_DONE);
    return r;
}

static void want_band(values *v, const draw_fight_band *b) {
    want_count(v, "pixels", b->pixels);
    want_number(v, "separation", b->separation);
    want_number(v, "z", b->z);
    want_number(v, "slant", b->slant);
    want_number(v, "bound", b->guaranteed);
    want_number(v, "used", b->used);
}

static void want_view(values *v, const fight_case *c) {
    want_number(v, "triangles.width", c->view.width);
    want_number(v, "triangles.height", c->view.height);
    want_number(v, "triangles.fov", c->view.fov_y);
    want_text(v, "triangles.raster", c->raster);
    want_text(v, "triangles.arith", strcmp(c->raster, "softpipe") == 0 ? "softpipe" : "mesa");
    want_number(v, "triangles.subpixel", c->view.subpixel);
    want_number(v, "triangles.slant_lo", c->view.slant_lo);
    want_number(v, "triangles.slant_hi", c->view.slant_hi);
    want_number(v, "triangles.depth", c->view.depth);
    want_number(v, "triangles.pixels", c->view.pixels);
    want_number(v, "triangles.slim", c->view.slim);
}

/* The bands that were drawn in, then the worst of them. */
static void want_setup_at(values *v, const fight_case *c, dp_setup *setup, size_t i, line_places *lines) {
    const draw_fight_result r = result_of(c, setup);
    draw_fight_band worst = {.separation = NAN, .z = NAN, .slant = NAN, .guaranteed = NAN, .used = NAN};
    int kept = 0;
    for (int b = 0; b < r.band_count; b++) {
        const draw_fight_band *band = &r.bands[b];
        const uint64_t pixels = worst.pixels + band->pixels;
        char inner[32];
        if (isnan(worst.used) || band->used > worst.used)
            worst = *band;
        worst.pixels = pixels;
        if (band->pixels == 0)
            continue;
        snprintf(inner, sizeof inner, "bands[%d].", kept);
        values_under(v, "setups[%zu].bands[%d].", i, kept++);
        want_number(v, "lo", band->lo);
        want_number(v, "hi", band->hi);
        want_band(v, band);
        place_add(lines, inner, "setups[%zu].", i);
    }
    values_under(v, "setups[%zu].", i);
    want_setup(v, setup);
    want_text(v, "method", "triangles");
    want_number(v, "seed", (double)c->seed);
    want_number(v, "pairs", (double)c->pairs);
    want_number(v, "azimuth", c->azimuth);
    want_number(v, "lo", c->lo);
    want_number(v, "hi", c->hi);
    want_band(v, &worst);
}

static void check_answer(const values *v, const char *text) {
    static const char *const used[] = {"setups[0].used", NULL};
    static const char *const place[] = {"setups[0].z", "setups[0].separation", "setups[0].bound", NULL};
    static const char *const drawn[] = {"setups[0].pairs", "setups[0].seed", NULL};
    if (isnan(value_at(v, "setups[0].used")->number)) {
        assert_non_null(strstr(text, "Nothing was drawn"));
    } else {
        check_text_numbers(v, text, "A pixel was wrong up to", 4, used);
        check_text_numbers(v, text, "there, at z =", 4, place);
    }
    check_text_numbers(v, text, "(wrong: the farther plane is seen;", 17, drawn);
}

static void test_fight(void **state) {
    static const csv_column columns[] = {SETUP_COLUMNS,
                                         {"arith", "^arith"},
                                         {"method", "^method"},
                                         {"raster", "/triangles.raster"},
                                         {"seed", "^seed"},
                                         {"pairs", "^pairs"},
                                         {"lo [scene]", "lo"},
                                         {"hi [scene]", "hi"},
                                         {"pixels", "pixels"},
                                         {"separation [scene]", "separation"},
                                         {"z [scene]", "z"},
                                         {"slant [degrees]", "slant"},
                                         {"bound [scene]", "bound"},
                                         {"used", "used"}};
    static const text_column shown[] = {{"lo", 4}, {"hi", 4},    {"pixels", 12}, {"separation", 4},
                                        {"z", 4},  {"slant", 3}, {"bound", 4},   {"used", -3}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const fight_case *c = &cases[i];
        values v = values_of("zfight");
        v.unit = c->camera.unit;
        line_places lines = {0};
        dp_setup setups[CAMERA_SETUPS];
        char options[512], arguments[1024];
        snprintf(arguments, sizeof arguments, "zfight --rasterize %s --range %.17g:%.17g %s",
                 camera_options(&c->camera, options), c->lo, c->hi, c->options);
        const size_t n = camera_setups(&c->camera, setups);
        for (size_t k = 0; k < n; k++)
            want_setup_at(&v, c, &setups[k], k, &lines);
        values_under(&v, "%s", "");
        want_view(&v, c);
        check_json(&v, 0, arguments);
        check_csv(&v, 0, arguments, columns, sizeof columns / sizeof columns[0], &lines);
        printed p = print_of("%s --full", arguments);
        check_text_table(&v, p.out, shown, sizeof shown / sizeof shown[0], &lines);
        check_answer(&v, p.out);
        printed_free(&p);
        values_free(&v);
        places_free(&lines);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_fight), cmocka_unit_test(check_apart)};
    return run_tap(tests);
}
