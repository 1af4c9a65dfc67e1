/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Effects that look at pixels around: edges, ambient occlusion, and water that refracts, over images and scenes. What
 * they should be is written out here for every pixel of the picture, from its depths alone.
 */
#include "stage.h"

/* ---- Edges ------------------------------------------------------------------------------------------------------- */

/* Whether the difference of two depths that are stored as these codes can exceed, and must exceed, a threshold. */
static void exceeds(uint32_t a, uint32_t b, double threshold, bool *can, bool *must) {
    const double lo[2] = {eye_of(a - 0.5), eye_of(b - 0.5)};
    const double hi[2] = {eye_of(fmin(a + 0.5, CODE_MAX)), eye_of(fmin(b + 0.5, CODE_MAX))};
    *can = *can || fmax(hi[0] - lo[1], hi[1] - lo[0]) > threshold;
    *must = *must || fmax(lo[0] - hi[1], lo[1] - hi[0]) > threshold;
}

TEST(test_edges) {
    static float got[PIXELS], off[PIXELS];
    rng r = rng_make("edges of images");
    tally t = {.name = "edges"};
    uint64_t doubtful = 0, sky = 0;
    for (uint64_t i = 0; i < test_cases(40, 100, 10000); i++) {
        stage s;
        double at[PARAMETERS_MAX];
        const int away = 1 + (int)rng_below(&r, 4);
        const double threshold = rng_below(&r, 2) == 0 ? 0.2 : rng_uniform(&r, 0.0005, 0.003);
        stage_make(&s);
        stage_draw(&r, &s);
        parameter_defaults(effect_find("edge")->parameters, at);
        stage_set("edge", at, "sample-distance", away);
        stage_set("edge", at, "threshold", threshold);
        stage_effect(&s, "edge", at, 0, false, got);
        stage_effect(&s, "edge", at, 0, true, off);
        for (int k = 0; k < PIXELS; k++) {
            int c[4];
            bool can = false, must = false, hole = s.codes[k] == UINT32_MAX;
            corners_of(k, away, c);
            for (int n = 0; n < 4; n++)
                hole = hole || s.codes[c[n]] == UINT32_MAX;
            if (hole) {
                TALLY(&t, isnan(got[k]) && isnan(off[k]), "pixel %d: %g at a hole", k, (double)got[k]);
                continue;
            }
            const double steps[2] = {fabs(eye_of(s.codes[c[0]]) - eye_of(s.codes[c[3]])) / STAGE_FAR,
                                     fabs(eye_of(s.codes[c[1]]) - eye_of(s.codes[c[2]])) / STAGE_FAR};
            const double largest = fmax(steps[0], steps[1]);
            exceeds(s.codes[c[0]], s.codes[c[3]], threshold * STAGE_FAR, &can, &must);
            exceeds(s.codes[c[1]], s.codes[c[2]], threshold * STAGE_FAR, &can, &must);
            if (fabs(largest - threshold) < 1e-6)
                continue;
            const bool edge = largest > threshold;
            TALLY(&t, (got[k] == 1) == edge, "pixel %d: %g, steps of %g and %g, threshold %g", k, (double)got[k],
                  steps[0], steps[1], threshold);
            TALLY(&t, off[k] == (edge ? !must : can) * 255.0f, "pixel %d: %g levels, can %d, must %d, is %d", k,
                  (double)off[k], can, must, edge);
            doubtful += off[k] > 0;
            sky += edge && s.codes[k] == CODE_MAX;
        }
    }
    assert_true(doubtful > 20 && sky > 20);
    tally_end(&t);
}

/* A wall at 10 before the sky: an edge on both sides of the border, and nowhere else. */
TEST(test_sky) {
    static float got[PIXELS], off[PIXELS];
    stage s;
    double at[PARAMETERS_MAX];
    stage_make(&s);
    parameter_defaults(effect_find("edge")->parameters, at);
    for (int k = 0; k < PIXELS; k++)
        s.codes[k] = k % ACROSS < 9 ? code_of(10) : CODE_MAX;
    stage_effect(&s, "edge", at, 0, false, got);
    stage_effect(&s, "edge", at, 0, true, off);
    for (int k = 0; k < PIXELS; k++) {
        assert_true(got[k] == (k % ACROSS == 8 || k % ACROSS == 9));
        assert_true(off[k] == 0); /* half of the last cell is less than the threshold */
    }
}

/* ---- Ambient occlusion ------------------------------------------------------------------------------------------- */

TEST(test_occlusion) {
    static float got[PIXELS], off[PIXELS];
    const double bias = 0.2, radius = 5;
    rng r = rng_make("occlusion");
    tally t = {.name = "occlusion"};
    uint64_t some = 0;
    for (uint64_t i = 0; i < test_cases(40, 100, 10000); i++) {
        stage s;
        double at[PARAMETERS_MAX];
        const int away = 1 + (int)rng_below(&r, 4);
        stage_make(&s);
        stage_draw(&r, &s);
        parameter_defaults(effect_find("ambient-occlusion")->parameters, at);
        stage_set("ambient-occlusion", at, "sample-distance", away);
        stage_set("ambient-occlusion", at, "bias", bias);
        stage_set("ambient-occlusion", at, "radius", radius);
        stage_effect(&s, "ambient-occlusion", at, 0, false, got);
        stage_effect(&s, "ambient-occlusion", at, 0, true, off);
        for (int k = 0; k < PIXELS; k++) {
            int c[4], hidden = 0, can = 0, must = 0;
            bool close = s.codes[k] == UINT32_MAX;
            corners_of(k, away, c);
            for (int n = 0; n < 4 && !close; n++) {
                const double before = eye_of(s.codes[k]) - eye_of(s.codes[c[n]]);
                const double most = eye_of(fmin(s.codes[k] + 0.5, CODE_MAX)) - eye_of(s.codes[c[n]] - 0.5);
                const double least = eye_of(s.codes[k] - 0.5) - eye_of(fmin(s.codes[c[n]] + 0.5, CODE_MAX));
                hidden += before > bias && before < radius;
                can += most > bias && least < radius;
                must += least > bias && most < radius;
                close =
                    close || s.codes[c[n]] == UINT32_MAX || fabs(before - bias) < 1e-4 || fabs(before - radius) < 1e-4;
            }
            if (close)
                continue;
            TALLY(&t, got[k] == (float)hidden / 4, "pixel %d: %g, not %d", k, (double)got[k], hidden);
            TALLY(&t, off[k] == 255.0f / 4 * (float)(can - hidden > hidden - must ? can - hidden : hidden - must),
                  "pixel %d: %g levels; %d, from %d to %d", k, (double)off[k], hidden, must, can);
            some += hidden > 0 && hidden < 4;
        }
    }
    assert_true(some > 20);
    tally_end(&t);
}

/* ---- Refraction -------------------------------------------------------------------------------------------------- */

/* Water at 20 looks three pixels to the right, unless what is there stands before the water. */
TEST(test_refraction) {
    static float got[PIXELS], off[PIXELS];
    const double surface = 20, density = 0.05;
    stage s;
    double at[PARAMETERS_MAX];
    int shifted = 0;
    stage_make(&s);
    parameter_defaults(effect_find("water-depth")->parameters, at);
    stage_set("water-depth", at, "density", density);
    stage_set("water-depth", at, "refraction", 3);
    for (int k = 0; k < PIXELS; k++)
        s.codes[k] = code_of(k % ACROSS == 10 ? 8 : 25 + k % ACROSS);
    stage_effect(&s, "water-depth", at, surface, false, got);
    stage_effect(&s, "water-depth", at, surface, true, off);
    for (int k = 0; k < PIXELS; k++) {
        const int there = s.codes[beside(k, 3, 0)] == code_of(8) ? k : beside(k, 3, 0);
        double slope[2];
        stage_slopes(k, slope);
        const double ray = sqrt(slope[0] * slope[0] + slope[1] * slope[1] + 1);
        const double z = eye_of(s.codes[there]), hi = eye_of(s.codes[there] + 0.5);
        const double want = 1 - exp(-density * fmax(z - surface, 0) * ray);
        const double change = fabs(1 - exp(-density * fmax(hi - surface, 0) * ray) - want);
        assert_scene((double)got[k], want, 1e-5);
        assert_true((double)off[k] >= 255 * change && (double)off[k] <= 255 * (change * 1.01 + 1e-5));
        shifted += there != k;
    }
    assert_true(shifted > PIXELS / 2);
}

/* A sphere, most of it under water: the truth says where it is seen through, and how far off that is. */
TEST(test_refracted_scene) {
    static float got[PIXELS], off[PIXELS];
    const double surface = 4.2, density = 0.3, distance = 8, radius = 4;
    const double parameters[PARAMETERS_MAX] = {distance, radius, 0};
    double at[PARAMETERS_MAX], z[PIXELS], ray[PIXELS];
    stage s;
    int shifted = 0;
    stage_make(&s);
    s.frame.image = NULL;
    s.frame.synthetic = synthetic_find("sphere");
    s.frame.parameters = parameters;
    for (int k = 0; k < PIXELS; k++) {
        double slope[2];
        stage_slopes(k, slope);
        const double a = slope[0] * slope[0] + slope[1] * slope[1] + 1;
        z[k] = (distance - sqrt(distance * distance - a * (distance * distance - radius * radius))) / a;
        ray[k] = sqrt(a);
    }
    parameter_defaults(effect_find("water-depth")->parameters, at);
    stage_set("water-depth", at, "density", density);
    stage_set("water-depth", at, "refraction", 3);
    stage_effect(&s, "water-depth", at, surface, false, got);
    stage_effect(&s, "water-depth", at, surface, true, off);
    for (int k = 0; k < PIXELS; k++) {
        if (isnan(z[k])) {
            assert_true(isnan(off[k]));
            continue;
        }
        const int there = z[beside(k, 3, 0)] >= surface ? beside(k, 3, 0) : k;
        const double want = 1 - exp(-density * fmax(z[there] - surface, 0) * ray[k]);
        assert_true(fabs((double)off[k] - 255 * fabs((double)got[k] - want)) <= 1e-6);
        assert_scene((double)got[k], want, 1e-3);
        shifted += there != k;
    }
    assert_true(shifted > 20);
}

/* Without sky the cleared far plane is fogged as a surface there is: of an image within half of the last cell, of a
 * scene exactly. With it nothing is, at whatever limit. */
TEST(test_fog_on_sky) {
    static float got[PIXELS], off[PIXELS];
    static const double sky[] = {-1, 0, 1e-4}, parameters[PARAMETERS_MAX] = {8, 4, 0};
    double at[PARAMETERS_MAX];
    stage s;
    stage_make(&s);
    parameter_defaults(effect_find("fog")->parameters, at);
    stage_set("fog", at, "density", 0.6);
    for (int k = 0; k < PIXELS; k++)
        s.codes[k] = k % ACROSS < 9 ? code_of(10) : CODE_MAX;
    for (int i = 0; i < 6; i++) {
        int clear = 0;
        s.frame.sky = sky[i % 3];
        s.frame.synthetic = i < 3 ? NULL : synthetic_find("sphere");
        s.frame.parameters = parameters;
        stage_effect(&s, "fog", at, 0, false, got);
        stage_effect(&s, "fog", at, 0, true, off);
        for (int k = 0; k < PIXELS; k++) {
            double slope[2];
            stage_slopes(k, slope);
            const bool far = i < 3 ? k % ACROSS >= 9 : (slope[0] * slope[0] + slope[1] * slope[1] + 1) * (64 - 16) > 64;
            clear += isnan(got[k]);
            assert_true((isnan(got[k]) != 0) == (far && i % 3 > 0) && isnan(got[k]) == isnan(off[k]));
            if (!far || i % 3 > 0)
                continue;
            const double cell = 255 * 0.6 * (1 - eye_of(CODE_MAX - 0.5) / 100);
            assert_scene((double)got[k], 0.6, 1e-7);
            assert_true(i < 3 ? (double)off[k] >= cell && (double)off[k] < cell + 1e-4 : off[k] < 1e-4f);
        }
        assert_true((clear > 20) == (i % 3 > 0));
    }
}

static double dimmed(double z, double surface, double ray) {
    return 1 - exp(-0.05 * fmax(z - surface, 0) * ray);
}

/* The worst of all that may be, at one surface: the pixel beside anywhere in its cell, or the pixel itself. */
static double worst_through(uint32_t own, uint32_t beside, double surface, double ray) {
    const double seen = dimmed(eye_of(eye_of(beside) >= surface ? beside : own), surface, ray);
    double worst = 0;
    for (int i = 0; i <= 200; i++) {
        const double there = eye_of(beside - 0.5 + i / 200.0), here = eye_of(own - 0.5 + i / 200.0);
        const double one = dimmed(there, surface, ray);
        if (there >= surface)
            worst = fmax(worst, fabs(one - seen));
        if (eye_of(beside - 0.5) < surface)
            worst = fmax(worst, fabs(dimmed(here, surface, ray) - seen));
    }
    return worst;
}

/* A surface inside the cell of the pixel beside, or anywhere: then the effect may look at either. */
TEST(test_refraction_unsure) {
    static float off[PIXELS];
    rng r = rng_make("refraction unsure");
    tally t = {.name = "where it may look at either"};
    double at[PARAMETERS_MAX], largest = 0;
    stage s;
    stage_make(&s);
    parameter_defaults(effect_find("water-depth")->parameters, at);
    stage_set("water-depth", at, "density", 0.05);
    stage_set("water-depth", at, "refraction", 3);
    const uint32_t middle = code_of(20);
    for (uint64_t i = 0; i < test_cases(20, 60, 2000); i++) {
        const bool known = i % 2 == 0;
        const double surface = known ? eye_of(middle + rng_unit(&r) - 0.5) : 0;
        for (int k = 0; k < PIXELS; k++)
            s.codes[k] = rng_below(&r, 2) == 0 ? middle + (uint32_t)rng_below(&r, 3) - 1 : code_of(rng_log(&r, 5, 60));
        stage_effect(&s, "water-depth", at, surface, true, off);
        for (int k = 0; k < PIXELS; k++) {
            const uint32_t own = s.codes[k], beside_it = s.codes[beside(k, 3, 0)];
            double slope[2], want = 0;
            stage_slopes(k, slope);
            const double ray = sqrt(slope[0] * slope[0] + slope[1] * slope[1] + 1);
            if (beside(k, 3, 0) == k)
                continue;
            /* Window depth in binary32, and what is left to 1, are off by 2^-24: z by z^2 2^-23 at near 1. What is seen
             * is so far off, and which of the two it is is not known nearer to the surface. */
            const double z = fmax(eye_of(own), eye_of(beside_it)), lost = z * z * 0x1p-23;
            const double slack = 2e-3 + 255 * 0.05 * ray * lost;
            if (fabs(eye_of(beside_it) - surface) < lost)
                continue;
            for (int n = 0; n <= 40 && !known; n++) {
                want = fmax(want, worst_through(own, beside_it, eye_of(beside_it - 0.5 + n / 40.0), ray));
                want = fmax(want, worst_through(own, beside_it, eye_of(own - 0.5 + n / 40.0), ray));
            }
            for (int n = 0; n < 2 && !known; n++)
                want = fmax(want, worst_through(own, beside_it, eye_of(beside_it + 1e-3 * n), ray));
            if (known)
                want = worst_through(own, beside_it, surface, ray);
            TALLY(&t, (double)off[k] >= 255 * want - slack && (double)off[k] <= 255 * want * 1.02 + slack,
                  "pixel %d: %g levels, not %g; %u beside %u, surface %g", k, (double)off[k], 255 * want, own,
                  beside_it, surface);
            largest = fmax(largest, 255 * want);
        }
    }
    assert_true(largest > 100);
    tally_end(&t);
}
