/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Effects that look at pixels around: edges, outlines, ambient occlusion, and water that refracts, over images and
 * scenes. What they should be is written out here for every pixel of the picture, from its depths alone.
 */
#include <string.h>

#include "named.h"
#include "support.h"
#include "texture/frame.h"

enum { ACROSS = 23, DOWN = 17, PIXELS = ACROSS * DOWN, CODE_MAX = 65535 };

static const double NEAR = 1, FAR = 100;

typedef struct stage {
    dp_setup setup;
    texture_camera camera;
    uint32_t codes[PIXELS];
    image image;
    frame frame;
} stage;

static double eye_of(double code) {
    const double d = code / CODE_MAX;
    return 1 / ((1 - d) / NEAR + d / FAR);
}

static uint32_t code_of(double z) {
    return (uint32_t)((z - NEAR) / z * FAR / (FAR - NEAR) * CODE_MAX + 0.5);
}

static void stage_make(stage *s) {
    dp_format formats[2];
    dp_spec spec = dp_spec_default();
    camera_spec view = camera_spec_default();
    memset(s, 0, sizeof *s);
    assert_true(dp_format_parse("unorm16", formats) >= 1);
    spec.format = formats[0];
    spec.mapping = DP_MAPPING_D3D;
    spec.znear = NEAR;
    spec.zfar = FAR;
    assert_int_equal(dp_setup_init(&s->setup, &spec), DP_OK);
    view.width = ACROSS;
    view.height = DOWN;
    assert_null(camera_init(&s->camera, &s->setup, &view));
    s->image =
        (image){.width = ACROSS, .height = DOWN, .channels = 1, .type = IMAGE_U32, .file = IMAGE_NPY, .data = s->codes};
    s->frame = (frame){.camera = &s->camera, .image = &s->image, .sky = FRAME_SKY, .threads = 1};
}

static bool keep(void *context, uint32_t row, uint32_t count, const float *values) {
    memcpy((float *)context + (size_t)row * ACROSS, values, (size_t)count * ACROSS * sizeof *values);
    return true;
}

static void make(const stage *s, const char *effect, const double *at, double reference, bool error,
                 float out[PIXELS]) {
    const frame_product p = {.kind = FRAME_EFFECT,
                             .effect = effect_find(effect),
                             .effect_settings = at,
                             .error = error,
                             .reference = reference};
    assert_null(frame_refuses(&s->frame, &p));
    assert_true(frame_run(&s->frame, &p, false, keep, out));
}

static void set(const char *effect, double *at, const char *name, double value) {
    const int index = parameter_find(effect_find(effect)->parameters, name);
    assert_true(index >= 0);
    at[index] = value;
}

/* The pixel a few columns and rows away; the outermost go on beyond the border. */
static int beside(int pixel, int columns, int rows) {
    const int x = pixel % ACROSS + columns, y = pixel / ACROSS + rows;
    return (y < 0 ? 0 : y < DOWN ? y : DOWN - 1) * ACROSS + (x < 0 ? 0 : x < ACROSS ? x : ACROSS - 1);
}

static void corners_of(int pixel, int away, int out[4]) {
    out[0] = beside(pixel, -away, -away);
    out[1] = beside(pixel, away, -away);
    out[2] = beside(pixel, -away, away);
    out[3] = beside(pixel, away, away);
}

/* ---- Edges ------------------------------------------------------------------------------------------------------- */

/* A few depths side by side, sky among them, and a hole. */
static void draw(rng *r, stage *s) {
    static const double depths[] = {10, 10.4, 30, 55};
    for (int k = 0; k < PIXELS; k++) {
        const uint64_t which = rng_below(r, 6);
        s->codes[k] = rng_below(r, 3) > 0 && k > 0 ? s->codes[k - 1]
                      : which == 0                 ? CODE_MAX
                                                   : code_of(depths[which % 4] + rng_uniform(r, 0, 0.3));
    }
    s->codes[200] = UINT32_MAX;
}

/* Whether the difference of two depths that are stored as these codes can exceed, and must exceed, a threshold. */
static void exceeds(uint32_t a, uint32_t b, double threshold, bool *can, bool *must) {
    const double lo[2] = {eye_of(a - 0.5), eye_of(b - 0.5)};
    const double hi[2] = {eye_of(fmin(a + 0.5, CODE_MAX)), eye_of(fmin(b + 0.5, CODE_MAX))};
    *can = *can || fmax(hi[0] - lo[1], hi[1] - lo[0]) > threshold;
    *must = *must || fmax(lo[0] - hi[1], lo[1] - hi[0]) > threshold;
}

static void test_edges(void **state) {
    static float got[PIXELS], off[PIXELS];
    rng r = rng_make("edges of images");
    tally t = {.name = "edges"};
    uint64_t doubtful = 0, sky = 0;
    (void)state;
    for (uint64_t i = 0; i < test_cases(40, 400, 10000); i++) {
        stage s;
        double at[TEXTURE_PARAMETERS];
        const int away = 1 + (int)rng_below(&r, 4);
        const double threshold = rng_below(&r, 2) == 0 ? 0.2 : rng_uniform(&r, 0.0005, 0.003);
        stage_make(&s);
        draw(&r, &s);
        parameter_defaults(effect_find("edge")->parameters, at);
        set("edge", at, "sample-distance", away);
        set("edge", at, "threshold", threshold);
        make(&s, "edge", at, 0, false, got);
        make(&s, "edge", at, 0, true, off);
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
            const double steps[2] = {fabs(eye_of(s.codes[c[0]]) - eye_of(s.codes[c[3]])) / FAR,
                                     fabs(eye_of(s.codes[c[1]]) - eye_of(s.codes[c[2]])) / FAR};
            const double largest = fmax(steps[0], steps[1]);
            exceeds(s.codes[c[0]], s.codes[c[3]], threshold * FAR, &can, &must);
            exceeds(s.codes[c[1]], s.codes[c[2]], threshold * FAR, &can, &must);
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
static void test_sky(void **state) {
    static float got[PIXELS], off[PIXELS];
    stage s;
    double at[TEXTURE_PARAMETERS];
    (void)state;
    stage_make(&s);
    parameter_defaults(effect_find("edge")->parameters, at);
    for (int k = 0; k < PIXELS; k++)
        s.codes[k] = k % ACROSS < 9 ? code_of(10) : CODE_MAX;
    make(&s, "edge", at, 0, false, got);
    make(&s, "edge", at, 0, true, off);
    for (int k = 0; k < PIXELS; k++) {
        assert_true(got[k] == (k % ACROSS == 8 || k % ACROSS == 9));
        assert_true(off[k] == 0); /* half of the last cell is less than the threshold */
    }
}

/* ---- Ambient occlusion ------------------------------------------------------------------------------------------- */

static void test_occlusion(void **state) {
    static float got[PIXELS], off[PIXELS];
    const double bias = 0.2, radius = 5;
    rng r = rng_make("occlusion");
    tally t = {.name = "occlusion"};
    uint64_t some = 0;
    (void)state;
    for (uint64_t i = 0; i < test_cases(40, 400, 10000); i++) {
        stage s;
        double at[TEXTURE_PARAMETERS];
        const int away = 1 + (int)rng_below(&r, 4);
        stage_make(&s);
        draw(&r, &s);
        parameter_defaults(effect_find("ambient-occlusion")->parameters, at);
        set("ambient-occlusion", at, "sample-distance", away);
        set("ambient-occlusion", at, "bias", bias);
        set("ambient-occlusion", at, "radius", radius);
        make(&s, "ambient-occlusion", at, 0, false, got);
        make(&s, "ambient-occlusion", at, 0, true, off);
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

/* ---- Outlines ---------------------------------------------------------------------------------------------------- */

/* Of a sphere before the sky: depth and normal are known. Packed normals are off by a degree, of edges near the limit
 * nothing is said; sky faces the camera. */
static void test_outlines(void **state) {
    static float got[PIXELS], off[PIXELS];
    const double distance = 8, radius = 4, depth_sensitivity = 2, normal_sensitivity = 0.25;
    const double parameters[TEXTURE_PARAMETERS] = {distance, radius, 0};
    stage s;
    double at[TEXTURE_PARAMETERS], normal[PIXELS][2], z[PIXELS];
    int edges = 0, by_normals = 0;
    (void)state;
    stage_make(&s);
    s.frame.image = NULL;
    s.frame.scene = scene_find("sphere");
    s.frame.parameters = parameters;
    for (int k = 0; k < PIXELS; k++) {
        const double half = tan(30 * M_PI / 180), x = (2 * (k % ACROSS + 0.5) / ACROSS - 1) * half * ACROSS / DOWN;
        const double y = (1 - 2 * (k / ACROSS + 0.5) / DOWN) * half, a = x * x + y * y + 1;
        const double root = distance * distance - a * (distance * distance - radius * radius);
        z[k] = root < 0 ? FAR : (distance - sqrt(root)) / a;
        normal[k][0] = root < 0 ? 0 : x * z[k] / radius;
        normal[k][1] = root < 0 ? 0 : y * z[k] / radius;
    }
    parameter_defaults(effect_find("outline")->parameters, at);
    set("outline", at, "depth-sensitivity", depth_sensitivity);
    set("outline", at, "normal-sensitivity", normal_sensitivity);
    make(&s, "outline", at, 0, false, got);
    make(&s, "outline", at, 0, true, off);
    for (int k = 0; k < PIXELS; k++) {
        int c[4];
        bool edge = false, turned = false, close = false;
        corners_of(k, 1, c);
        for (int n = 0; n < 2; n++) {
            const int a = c[n], b = c[3 - n];
            const double bend = fabs(normal[a][0] - normal[b][0]) + fabs(normal[a][1] - normal[b][1]);
            const double step = fabs(z[a] - z[b]) / z[a];
            edge = edge || bend * normal_sensitivity >= 0.1 || step * depth_sensitivity >= 0.1;
            turned = turned || bend * normal_sensitivity >= 0.1;
            close =
                close || fabs(bend * normal_sensitivity - 0.1) < 0.02 || fabs(step * depth_sensitivity - 0.1) < 1e-3;
        }
        assert_true(off[k] == ((got[k] == 1) != edge) * 255.0f);
        assert_true(close || (got[k] == 1) == edge);
        edges += edge && !close;
        by_normals += turned && !close;
    }
    print_message("# %d edges, %d by normals\n", edges, by_normals);
    assert_true(edges > 10 && edges < PIXELS / 2 + 60 && by_normals > 5);
    /* An image of depths has no normals. */
    const frame_product p = {.kind = FRAME_EFFECT, .effect = effect_find("outline"), .effect_settings = at};
    s.frame.image = &s.image;
    s.frame.scene = NULL;
    assert_non_null(frame_refuses(&s.frame, &p));
}

/* ---- Refraction -------------------------------------------------------------------------------------------------- */

/* Water at 20 looks three pixels to the right, unless what is there stands before the water. */
static void test_refraction(void **state) {
    static float got[PIXELS], off[PIXELS];
    const double surface = 20, density = 0.05, half = tan(30 * M_PI / 180);
    stage s;
    double at[TEXTURE_PARAMETERS];
    int shifted = 0;
    (void)state;
    stage_make(&s);
    parameter_defaults(effect_find("water-depth")->parameters, at);
    set("water-depth", at, "density", density);
    set("water-depth", at, "refraction", 3);
    for (int k = 0; k < PIXELS; k++)
        s.codes[k] = code_of(k % ACROSS == 10 ? 8 : 25 + k % ACROSS);
    make(&s, "water-depth", at, surface, false, got);
    make(&s, "water-depth", at, surface, true, off);
    for (int k = 0; k < PIXELS; k++) {
        const int there = s.codes[beside(k, 3, 0)] == code_of(8) ? k : beside(k, 3, 0);
        const double x = (2 * (k % ACROSS + 0.5) / ACROSS - 1) * half * ACROSS / DOWN;
        const double y = (1 - 2 * (k / ACROSS + 0.5) / DOWN) * half, ray = sqrt(x * x + y * y + 1);
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
static void test_refracted_scene(void **state) {
    static float got[PIXELS], off[PIXELS];
    const double surface = 4.2, density = 0.3, distance = 8, radius = 4, half = tan(30 * M_PI / 180);
    const double parameters[TEXTURE_PARAMETERS] = {distance, radius, 0};
    double at[TEXTURE_PARAMETERS], z[PIXELS], ray[PIXELS];
    stage s;
    int shifted = 0;
    (void)state;
    stage_make(&s);
    s.frame.image = NULL;
    s.frame.scene = scene_find("sphere");
    s.frame.parameters = parameters;
    for (int k = 0; k < PIXELS; k++) {
        const double x = (2 * (k % ACROSS + 0.5) / ACROSS - 1) * half * ACROSS / DOWN;
        const double y = (1 - 2 * (k / ACROSS + 0.5) / DOWN) * half, a = x * x + y * y + 1;
        z[k] = (distance - sqrt(distance * distance - a * (distance * distance - radius * radius))) / a;
        ray[k] = sqrt(a);
    }
    parameter_defaults(effect_find("water-depth")->parameters, at);
    set("water-depth", at, "density", density);
    set("water-depth", at, "refraction", 3);
    make(&s, "water-depth", at, surface, false, got);
    make(&s, "water-depth", at, surface, true, off);
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

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_edges),      cmocka_unit_test(test_sky),
                                       cmocka_unit_test(test_occlusion),  cmocka_unit_test(test_outlines),
                                       cmocka_unit_test(test_refraction), cmocka_unit_test(test_refracted_scene)};
    return run_tap(tests);
}
