/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * How near drawn planes come before a pixel is wrong: never to the guarantee, and as near as the lattice of codes and
 * the subpixel grid alone say, by formulas of the test. The same for any number of threads.
 */
#include "raster/fight.h"
#include "support.h"

static const double pi = 3.14159265358979323846;

typedef struct stage {
    const raster_row *row;
    dp_setup setup;
    draw_camera camera;
    draw_fight_request request;
    draw_fight_result result;
} stage;

static bool set_stage(stage *s, const char *raster, const char *format, dp_mapping mapping, double zfar) {
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    const raster_row *row = s->row = raster_find(raster);
    assert_int_equal(dp_format_parse(format, found), 1);
    spec.format = found[0];
    spec.mapping = mapping;
    spec.model = DP_MODEL_FLOAT;
    spec.zfar = zfar;
    spec.triangles = dp_triangles_default();
    raster_describe(row, &spec.triangles);
    if (!raster_draws(row, found) || !raster_arith(row, dp_mapping_get(mapping)->ndc_signed, &spec.arith))
        return false;
    assert_int_equal(dp_setup_init(&s->setup, &spec), DP_OK);
    s->request = (draw_fight_request){.camera = &s->camera, .setup = &s->setup, .azimuth = NAN, .seed = 1};
    return true;
}

static void slant(stage *s, double lo, double hi) {
    s->setup.spec.triangles.slant_lo = lo;
    s->setup.spec.triangles.slant_hi = hi;
}

static draw_fight_status fight(stage *s, double lo, double hi, uint64_t count) {
    s->request.lo = lo;
    s->request.hi = hi;
    s->request.count = count;
    assert_int_equal(draw_camera_init(&s->camera, s->row, &s->setup), RASTER_OK);
    return draw_fight(&s->request, &s->result);
}

/* ---- The promise ------------------------------------------------------------------------------------------------- */

/* A band says one place, where the guarantee at that slant is what it says and is not reached. */
static void judge(tally *t, const stage *s, const draw_fight_band *b, const char *name) {
    const dp_triangles *asked = &s->setup.spec.triangles;
    dp_setup at_slant = s->setup;
    dp_budget budget;
    if (isnan(b->used))
        return;
    at_slant.spec.triangles.slant_lo = at_slant.spec.triangles.slant_hi = b->slant;
    assert_int_equal(dp_budget_at(&at_slant, b->z, NULL, &budget), DP_OK);
    TALLY(t, b->pixels > 0 && b->z >= b->lo && b->z < b->hi, "%s: %g lies not from %g to %g", name, b->z, b->lo, b->hi);
    TALLY(t, b->slant >= asked->slant_lo && b->slant <= asked->slant_hi, "%s: slant %g", name, b->slant);
    TALLY(t, b->guaranteed == budget.separation && b->used == b->separation / budget.separation,
          "%s: at %.17g %.17g is guaranteed, not %.17g", name, b->z, budget.separation, b->guaranteed);
    TALLY(t, b->used > 0.0 && b->used <= 1.0, "%s: %.17g of the guarantee at %.17g, slant %.17g", name, b->used, b->z,
          b->slant);
}

TEST(never_reached) {
    static const char *const names[] = {"llvmpipe", "lavapipe", "softpipe", "swiftshader"};
    static const char *const formats[] = {"fp32", "unorm24", "unorm16"};
    tally t = {.name = "at the guarantee"};
    stage s;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++)
            for (dp_mapping m = DP_MAPPING_D3D; m <= DP_MAPPING_GL_REVERSED; m++) {
                char name[64];
                if (!set_stage(&s, names[i], formats[f], m, 500.0))
                    continue;
                s.setup.spec.triangles.slim = 4.0 + 4.0 * (double)m;
                snprintf(name, sizeof name, "%s %s %s", names[i], formats[f], dp_mapping_get(m)->name);
                assert_int_equal(fight(&s, 0.1, 400.0, test_cases(13, 39, 13000)), DRAW_FIGHT_DONE);
                assert_int_equal(s.result.band_count, 13);
                for (int b = 0; b < s.result.band_count; b++)
                    judge(&t, &s, &s.result.bands[b], name);
                const draw_fight_band worst = draw_fight_worst(&s.result);
                judge(&t, &s, &worst, name);
                print_message("# %s: %.3f used, %lu pixels\n", name, worst.used, (unsigned long)worst.pixels);
            }
    tally_end(&t);
}

/* Pairs slant by what was asked, from its least to its greatest. */
TEST(slants) {
    static const double asked[][2] = {{0.0, 12.0}, {30.0, 33.0}, {50.0, 70.0}, {72.0, 75.0}};
    tally t = {.name = "slants"};
    stage s;
    for (size_t i = 0; i < sizeof asked / sizeof asked[0]; i++) {
        const double lo = asked[i][0], hi = asked[i][1];
        double least = INFINITY, most = 0.0;
        assert_true(set_stage(&s, "llvmpipe", "unorm24", DP_MAPPING_D3D, 500.0));
        slant(&s, lo, hi);
        for (s.request.seed = 1; s.request.seed <= 4; s.request.seed++) {
            assert_int_equal(fight(&s, 0.2, 200.0, 10), DRAW_FIGHT_DONE); /* one pair a binade, whose slant is told */
            for (int b = 0; b < s.result.band_count; b++) {
                const double one = s.result.bands[b].slant;
                TALLY(&t, isnan(one) || (one >= lo && one <= hi), "%g to %g: %g", lo, hi, one);
                least = fmin(least, one);
                most = fmax(most, one);
            }
        }
        TALLY(&t, least < lo + 0.3 * (hi - lo) && most > hi - 0.3 * (hi - lo), "%g to %g: %g to %g alone", lo, hi,
              least, most);
    }
    tally_end(&t);
}

/* Planes that face the camera are told apart by the codes alone: wrong up to one step of 1/65535. */
TEST(one_code) {
    stage s;
    assert_true(set_stage(&s, "llvmpipe", "unorm16", DP_MAPPING_REVERSED, 500.0));
    slant(&s, 0.0, 0.0);
    assert_int_equal(fight(&s, 8.0, 64.0, 150), DRAW_FIGHT_DONE);
    assert_int_equal(s.result.band_count, 3);
    for (int b = 0; b < 3; b++) {
        const draw_fight_band *band = &s.result.bands[b];
        const double step = (1.0 / 0.1 - 1.0 / 500.0) / 65535.0; /* of 1/z */
        const double most = band->z - 1.0 / (1.0 / band->z + step);
        print_message("# %.3f of a code at %g\n", band->separation / most, band->z);
        assert_true(band->slant == 0.0);
        assert_in_range((int)(1000.0 * band->separation / most), 850, 1010);
    }
}

/* SwiftShader's grid, 1/16 pixel: vertices are moved by half of it along x and y, towards each other;
 * where the plane rises along one of them alone, the other does nothing. */
TEST(moved_vertices) {
    static const double slants[] = {20.0, 45.0, 70.0, 70.0, 70.0, 70.0};
    static const double azimuths[] = {45.0, 45.0, 45.0, 0.0, -90.0, 180.0};
    double found[6];
    stage s;
    for (int i = 0; i < 6; i++) {
        assert_true(set_stage(&s, "swiftshader", "fp32", DP_MAPPING_REVERSED, INFINITY));
        slant(&s, slants[i], slants[i]);
        s.request.azimuth = azimuths[i];
        assert_int_equal(fight(&s, 16.0, 32.0, 100), DRAW_FIGHT_DONE);
        const draw_fight_band *band = &s.result.bands[0];
        const double pixel = 2.0 * tan(30.0 * pi / 180.0) / 1080.0 * band->z;
        const double most = 2.0 * pixel / 32.0 * (i < 3 ? sqrt(2.0) : 1.0) * sin(slants[i] * pi / 180.0);
        print_message("# slant %g: %.3f of what snapping takes\n", slants[i], band->separation / most);
        assert_in_range((int)(1000.0 * band->separation / most), 500, 1050);
        found[i] = band->separation;
    }
    assert_true(found[3] != found[4]); /* of the same pairs of meshes: the azimuth decides */
}

/* ---- Work -------------------------------------------------------------------------------------------------------- */

static bool same(const draw_fight_band *a, const draw_fight_band *b) {
    return a->pixels == b->pixels && a->separation == b->separation && a->z == b->z && a->slant == b->slant;
}

TEST(threads_and_seeds) {
    stage s;
    draw_fight_result first;
    assert_true(set_stage(&s, "softpipe", "fp32", DP_MAPPING_D3D, 500.0));
    s.request.threads = 1;
    assert_int_equal(fight(&s, 3.0, 20.0, 160), DRAW_FIGHT_DONE);
    assert_int_equal(draw_fight_count(&s.request), 160);
    first = s.result;
    assert_int_equal(first.band_count, 4); /* 3, 4, 8, 16, 20 */
    for (int threads = 2; threads <= 5; threads += 3) {
        s.request.threads = threads;
        assert_int_equal(fight(&s, 3.0, 20.0, 160), DRAW_FIGHT_DONE);
        for (int b = 0; b < 4; b++)
            assert_true(same(&s.result.bands[b], &first.bands[b]));
    }
    s.request.seed = 2;
    assert_int_equal(fight(&s, 3.0, 20.0, 160), DRAW_FIGHT_DONE);
    for (int b = 0; b < 4; b++)
        assert_false(same(&s.result.bands[b], &first.bands[b]));
    s.request.seed = 1;
    assert_int_equal(fight(&s, 3.0, 20.0, 4 * 96 + 1), DRAW_FIGHT_DONE);
    assert_int_equal(draw_fight_count(&s.request), 4 * 97);
    bool found_more = false;
    for (int b = 0; b < 4; b++)
        found_more |= s.result.bands[b].used > first.bands[b].used;
    assert_true(found_more);
    for (int b = 0; b < 4; b++)
        assert_true(s.result.bands[b].used >= first.bands[b].used && s.result.bands[b].pixels > first.bands[b].pixels);
}

static uint64_t told;

static int stop_after_two(void *context, uint64_t done) {
    told++;
    *(uint64_t *)context = done;
    return told == 2;
}

static int never_stop(void *context, uint64_t done) {
    *(uint64_t *)context = done;
    return 0;
}

TEST(stopped) {
    uint64_t done = 0;
    stage s;
    assert_true(set_stage(&s, "llvmpipe", "fp32", DP_MAPPING_D3D, 500.0));
    s.request.context = &done;
    s.request.progress = never_stop;
    assert_int_equal(fight(&s, 4.0, 8.0, 70), DRAW_FIGHT_DONE);
    assert_int_equal(done, 70);
    s.request.progress = stop_after_two;
    assert_int_equal(fight(&s, 4.0, 8.0, UINT64_C(1000000000000)), DRAW_FIGHT_STOPPED);
    assert_true(told >= 2 && done < 1000);
}

/* Where nothing is certain nothing is drawn. */
TEST(nothing_certain) {
    stage s;
    assert_true(set_stage(&s, "llvmpipe", "unorm16", DP_MAPPING_D3D, 1e9));
    assert_int_equal(fight(&s, 1e7, 3e7, 40), DRAW_FIGHT_DONE);
    const draw_fight_band worst = draw_fight_worst(&s.result);
    assert_true(worst.pixels == 0 && isnan(worst.used) && isnan(worst.separation) && isnan(worst.z));
    assert_true(worst.lo == 1e7 && worst.hi == 3e7);
}
