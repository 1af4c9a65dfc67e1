/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that zfight --rasterize prints, against the room draw asked for the same pairs; options by hand. */
#include "printed.h"
#include "raster/fight.h"

typedef struct fight_case {
    const char *line;
    const char *raster, *arith;
    dp_triangles view; /* but for its plane */
    double azimuth;
    uint64_t pairs; /* drawn, of all five bands */
} fight_case;

static const fight_case cases[] = {
    {"zfight --rasterize -n 0.25 -f 900 -F fp32,unorm16 -m d3d,reversed --range 0.3:5 --raster swiftshader "
     "--viewport 640x360 --fov 75 --slant 20:70.5 --triangle-class slim=6,pixels=100,depth=1.5 --sample 21 "
     "--seed 8589934597",
     "swiftshader",
     "mesa",
     {640, 360, 75, 4, {0, 0, 0, 0}, 20, 70.5, 1.5, 100, 6},
     NAN,
     25},
    {"zfight --rasterize -n 0.1 -f inf -F unorm24 -m gl-reversed --unit cm --range 700:900 --slant 35,-120",
     "llvmpipe",
     "mesa-remap",
     {1920, 1080, 60, 0, {0, 0, 0, 0}, 35, 35, 2, 512, 16},
     -120,
     500},
    /* Nothing is certain. */
    {"zfight --rasterize -n 0.001 -f 1e9 -F unorm16 -m d3d --range 1e7:1.5e7 --raster lavapipe --sample 9 --seed 4",
     "lavapipe",
     "mesa",
     {1920, 1080, 60, 0, {0, 0, 0, 0}, 0, 90, 2, 512, 16},
     NAN,
     9},
};

static draw_fight_result result_of(const fight_case *c, dp_setup *setup) {
    static draw_camera camera;
    draw_fight_result r;
    dp_spec spec = setup->spec;
    double range[2];
    numbers_behind(c->line, "--range", range, 2);
    spec.triangles = c->view;
    spec.triangles.plane = dp_anchor_get(raster_find(c->raster)->anchor)->plane;
    assert_int_equal(dp_arith_parse(c->arith, &spec.arith), DP_OK);
    assert_int_equal(dp_setup_init(setup, &spec), DP_OK);
    assert_int_equal(draw_camera_init(&camera, raster_find(c->raster), setup), RASTER_OK);
    const draw_fight_request q = {.camera = &camera,
                                  .setup = setup,
                                  .azimuth = c->azimuth,
                                  .lo = range[0],
                                  .hi = range[1],
                                  .count = c->pairs,
                                  .seed = (uint64_t)number_behind(c->line, "--seed", 0)};
    assert_int_equal(draw_fight(&q, &r), DRAW_FIGHT_DONE);
    return r;
}

static void want_band(values *v, const draw_fight_band *b) {
    want(v, "pixels=%lu separation=%f z=%f slant=%f", b->pixels, b->separation, b->z, b->slant);
    want(v, "bound=%f used=%f", b->guaranteed, b->used);
}

static void want_view(values *v, const fight_case *c) {
    const dp_triangles *t = &c->view;
    values_under(v, "triangles.");
    want(v, "width=%u height=%u fov=%f", (unsigned)t->width, (unsigned)t->height, t->fov_y);
    want(v, "raster=%s arith=%s", c->raster, strcmp(c->raster, "softpipe") == 0 ? "softpipe" : "mesa");
    want(v, "subpixel=%u slant_lo=%f slant_hi=%f", (unsigned)t->subpixel, t->slant_lo, t->slant_hi);
    want(v, "depth=%f pixels=%f slim=%f", t->depth, t->pixels, t->slim);
}

/* The bands that were drawn in, then the worst of them. */
static void want_setup_at(values *v, const fight_case *c, dp_setup *setup, size_t i) {
    const draw_fight_result r = result_of(c, setup);
    draw_fight_band worst = {.separation = NAN, .z = NAN, .slant = NAN, .guaranteed = NAN, .used = NAN};
    double range[2];
    int kept = 0;
    numbers_behind(c->line, "--range", range, 2);
    for (int b = 0; b < r.band_count; b++) {
        const draw_fight_band *band = &r.bands[b];
        const uint64_t pixels = worst.pixels + band->pixels;
        if (isnan(worst.used) || band->used > worst.used)
            worst = *band;
        worst.pixels = pixels;
        if (band->pixels == 0)
            continue;
        values_under(v, "setups[%zu].bands[%d].", i, kept++);
        want(v, "lo=%f hi=%f", band->lo, band->hi);
        want_band(v, band);
    }
    values_under(v, "setups[%zu].", i);
    want_setup(v, setup);
    want(v, "method=%s seed=%f pairs=%lu azimuth=%f", "triangles", number_behind(c->line, "--seed", 0), c->pairs,
         c->azimuth);
    want(v, "lo=%f hi=%f", range[0], range[1]);
    want_band(v, &worst);
}

static void check_answer(values *v, const char *text) {
    values_under(v, "setups[0].");
    if (isnan(value_at(v, "setups[0].used")->number)) {
        assert_non_null(strstr(text, "Nothing was drawn"));
    } else {
        check_line(v, text, "A pixel was wrong up to", "used:4");
        check_line(v, text, "there, at z =", "z:4, separation:4, bound:4");
    }
    check_line(v, text, "(wrong: the farther plane is seen;", "pairs:17, seed:17");
}

TEST(each_number) {
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const fight_case *c = &cases[i];
        values v = values_of(c->line);
        dp_setup setups[SETUPS_MAX];
        const size_t n = setups_of(c->line, DP_MODEL_FLOAT, setups);
        for (size_t k = 0; k < n; k++)
            want_setup_at(&v, c, &setups[k], k);
        want_view(&v, c);
        check_forms(&v, 0, c->line, "setups[].bands[]",
                    SETUP_CSV "arith = ^arith, method = ^method, raster = /triangles.raster, seed = ^seed, "
                              "pairs = ^pairs, lo [scene], hi [scene], pixels, separation [scene], z [scene], "
                              "slant [degrees], bound [scene], used");
        char *text = output_of(0, c->line, "--full");
        check_table(&v, text, "setups[].bands[]",
                    "lo:4, hi:4, pixels:12, separation:4, z:4, slant:3, bound:4, used:-3");
        check_answer(&v, text);
        free(text);
        values_free(&v);
    }
}

LIST_TEST(check_apart)
