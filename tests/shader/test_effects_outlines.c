/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Outlines, which compare normals too: a scene's own, those that came with an image, and those made of its depths. Each
 * pixel is judged by formulas of this file.
 */
#include "stage.h"
#include "synthetic_stage.h"
#include "texture/normals.h"

/* ---- Outlines ---------------------------------------------------------------------------------------------------- */

/* A sphere stands before the sky: its depth and normal are known. Packed normals are off by a degree, of edges near the
 * limit nothing is said; sky faces the camera. */
TEST(test_outlines) {
    static float got[PIXELS], off[PIXELS];
    const double distance = 8, radius = 4, depth_sensitivity = 2, normal_sensitivity = 0.25;
    const double parameters[PARAMETERS_MAX] = {distance, radius, 0};
    stage s;
    double at[PARAMETERS_MAX], normal[PIXELS][2], z[PIXELS];
    int edges = 0, by_normals = 0;
    stage_make(&s);
    s.frame.image = NULL;
    s.frame.synthetic = synthetic_find("sphere");
    s.frame.parameters = parameters;
    for (int k = 0; k < PIXELS; k++) {
        double slope[2];
        stage_slopes(k, slope);
        const double x = slope[0], y = slope[1], a = x * x + y * y + 1;
        const double root = distance * distance - a * (distance * distance - radius * radius);
        z[k] = root < 0 ? STAGE_FAR : (distance - sqrt(root)) / a;
        normal[k][0] = root < 0 ? 0 : x * z[k] / radius;
        normal[k][1] = root < 0 ? 0 : y * z[k] / radius;
    }
    parameter_defaults(effect_find("outline")->parameters, at);
    stage_set("outline", at, "depth-sensitivity", depth_sensitivity);
    stage_set("outline", at, "normal-sensitivity", normal_sensitivity);
    stage_effect(&s, "outline", at, 0, false, got);
    stage_effect(&s, "outline", at, 0, true, off);
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
    s.frame.synthetic = NULL;
    assert_non_null(frame_refuses(&s.frame, &p));
}

static const double DEPTH_SENSITIVITY = 1.5;

/* x and y of a normal whose channels hold so much, from 0 to 255. */
static void unpacked_of(double red, double green, double out[2]) {
    const double scale = 1.7777, x = scale * (2 * red / 255 - 1), y = scale * (2 * green / 255 - 1);
    out[0] = 2 * x / (1 + x * x + y * y);
    out[1] = 2 * y / (1 + x * x + y * y);
}

static double bend_of(const uint8_t *a, const uint8_t *b) {
    double one[2], two[2];
    unpacked_of(a[0], a[1], one);
    unpacked_of(b[0], b[1], two);
    return fabs(one[0] - two[0]) + fabs(one[1] - two[1]);
}

/* The least and the most that normals behind two texels can differ, as far as corners and middles of the squares of
 * their channels tell. */
static void bends_of(const uint8_t *a, const uint8_t *b, bool zero, double out[2]) {
    out[0] = 9;
    out[1] = 0;
    for (int i = 0; i < 81; i++) {
        const int steps[4] = {i % 3, i / 3 % 3, i / 9 % 3, i / 27};
        double off[4], one[2], two[2];
        for (int k = 0; k < 4; k++)
            off[k] = zero ? steps[k] * 0.4999 : steps[k] * 0.4999 - 0.4999;
        unpacked_of(a[0] + off[0], a[1] + off[1], one);
        unpacked_of(b[0] + off[2], b[1] + off[3], two);
        const double bend = fabs(one[0] - two[0]) + fabs(one[1] - two[1]);
        out[0] = fmin(out[0], bend);
        out[1] = fmax(out[1], bend);
    }
}

typedef struct verdict {
    bool edge, can, must; /* is one; could, and has to, be one as far as channels and depths are known */
    bool close, clear;    /* next to the limit; no doubt even if channels stood for squares twice as large */
} verdict;

/* The sum that two opposite corners add to it. */
static void judge(const stage *s, const uint8_t *texels, const frame_normals *normals, double sensitivity, int a, int b,
                  verdict *v) {
    const double square = (normals->truncated ? 4 : 2) * 1.7777 / 255;
    const double za = eye_of(s->codes[a]), zb = eye_of(s->codes[b]);
    const double lo[2] = {eye_of(s->codes[a] - 0.5), eye_of(s->codes[b] - 0.5)};
    const double hi[2] = {eye_of(fmin(s->codes[a] + 0.5, CODE_MAX)), eye_of(fmin(s->codes[b] + 0.5, CODE_MAX))};
    const double ratios[2] = {lo[1] / hi[0], hi[1] / lo[0]};
    const double most = DEPTH_SENSITIVITY * fmax(1 - ratios[0], ratios[1] - 1);
    const double least = DEPTH_SENSITIVITY * fmax(1 - ratios[1], ratios[0] - 1);
    const double bend = bend_of(texels + 2 * a, texels + 2 * b);
    double bends[2];
    bends_of(texels + 2 * a, texels + 2 * b, normals->truncated, bends);
    v->edge = v->edge || bend * sensitivity >= 0.1 || fabs(za - zb) / za * DEPTH_SENSITIVITY >= 0.1;
    v->can = v->can || bends[1] * sensitivity >= 0.1 || most >= 0.1;
    v->must = v->must || bends[0] * sensitivity >= 0.1 || least >= 0.1;
    v->close = v->close || fabs(bend * sensitivity - 0.1) < 1e-6;
    v->clear = v->clear && fabs(bend - 0.1 / sensitivity) > 4 * square && (most < 0.1) == (least < 0.1);
}

/* The normals came with the image: none that its channels and depths allow makes another outline where the map
 * says that there is none, and it says so wherever two squares, twice as large, leave no doubt. */
TEST(test_outlines_of_images) {
    static float got[PIXELS], off[PIXELS];
    static uint8_t texels[2 * PIXELS];
    rng r = rng_make("outlines of images");
    tally t = {.name = "outlines"};
    uint64_t edges = 0, sure = 0, doubtful = 0;
    for (uint64_t i = 0; i < test_cases(40, 200, 4000); i++) {
        const frame_normals normals = {.texels = texels, .truncated = rng_below(&r, 3) == 0};
        stage s;
        double at[PARAMETERS_MAX];
        stage_make(&s);
        stage_draw(&r, &s);
        s.frame.normals = &normals;
        const double slopes[2] = {rng_uniform(&r, -5, 5), rng_uniform(&r, -5, 5)};
        const bool flat = rng_below(&r, 2) == 0, apart = rng_below(&r, 2) == 0;
        const double normal_sensitivity = apart ? 0.1 : 0.5;
        for (int k = 0; k < PIXELS; k++) {
            for (int n = 0; n < 2; n++)
                texels[2 * k + n] =
                    apart ? (uint8_t)(78 + rng_below(&r, 100))
                          : (uint8_t)(128 + slopes[n] * (k % ACROSS - ACROSS / 2.0) + rng_uniform(&r, 0, 3));
            s.codes[k] = flat && s.codes[k] != UINT32_MAX ? code_of(10) : s.codes[k];
        }
        parameter_defaults(effect_find("outline")->parameters, at);
        stage_set("outline", at, "depth-sensitivity", DEPTH_SENSITIVITY);
        stage_set("outline", at, "normal-sensitivity", normal_sensitivity);
        stage_effect(&s, "outline", at, 0, false, got);
        stage_effect(&s, "outline", at, 0, true, off);
        for (int k = 0; k < PIXELS; k++) {
            int c[4];
            verdict v = {.clear = true};
            bool hole = s.codes[k] == UINT32_MAX;
            corners_of(k, 1, c);
            for (int n = 0; n < 4; n++)
                hole = hole || s.codes[c[n]] == UINT32_MAX;
            for (int n = 0; n < 2 && !hole; n++)
                judge(&s, texels, &normals, normal_sensitivity, c[n], c[3 - n], &v);
            if (hole || v.close) {
                TALLY(&t, !hole || (isnan(got[k]) && isnan(off[k])), "pixel %d: %g at a hole", k, (double)got[k]);
                continue;
            }
            TALLY(&t, (got[k] == 1) == v.edge, "pixel %d: %g, is %d", k, (double)got[k], v.edge);
            TALLY(&t, off[k] == 255 || (off[k] == 0 && !(v.edge ? !v.must : v.can)),
                  "pixel %d: %g levels; can %d, must %d, is %d", k, (double)off[k], v.can, v.must, v.edge);
            TALLY(&t, !v.clear || off[k] == 0, "pixel %d: %g levels, in doubt", k, (double)off[k]);
            edges += v.edge;
            sure += v.clear;
            doubtful += off[k] > 0;
        }
    }
    print_message("# %llu edges, %llu without doubt, %llu in doubt\n", (unsigned long long)edges,
                  (unsigned long long)sure, (unsigned long long)doubtful);
    assert_true(edges > 1000 && sure > 1000 && doubtful > 1000);
    tally_end(&t);
}

/* Normals that are made of the depths: of a plane that leans all are alike but at the sky, which faces the camera. */
TEST(test_outlines_by_depth) {
    static float got[PIXELS], off[PIXELS];
    const double lean = 0.6;
    double at[PARAMETERS_MAX];
    frame_normals normals;
    stage s;
    stage_make(&s);
    parameter_defaults(effect_find("outline")->parameters, at);
    stage_set("outline", at, "depth-sensitivity", 1e-6);
    for (int k = 0; k < PIXELS; k++) {
        double slope[2];
        stage_slopes(k, slope);
        s.codes[k] = k % ACROSS < 6 ? CODE_MAX : code_of(3 / (1 + lean * slope[0]));
    }
    for (int m = 0; m < NORMAL_METHODS; m++) {
        assert_true(frame_normals_make(&s.frame, normal_get((size_t)m), true, &normals));
        s.frame.normals = &normals;
        stage_effect(&s, "outline", at, 0, false, got);
        stage_effect(&s, "outline", at, 0, true, off);
        const frame_product bound = {.kind = FRAME_NORMAL, .normal = normal_get((size_t)m), .error = true};
        float *most = frame_made(&s.frame, &bound, false);
        for (int k = 0; k < PIXELS; k++)
            assert_true(isnan(most[k]) || (normals.off[k] >= (double)most[k] * FRAME_NORMAL_DEGREE &&
                                           normals.off[k] < (double)most[k] * FRAME_NORMAL_DEGREE + 1));
        free(most);
        for (int k = 0; k < PIXELS; k++) {
            const int x = k % ACROSS;
            double n[2];
            if (x >= ACROSS - 2 || k / ACROSS >= DOWN - 2) /* the quad that "low" takes may be cut off */
                continue;
            if (normal_get((size_t)m)->sees_sky && x >= 6 && x < 10) /* they lean towards it */
                continue;
            unpacked_of(normals.texels[2 * k], normals.texels[2 * k + 1], n);
            const double length = sqrt(1 + lean * lean);
            assert_scene(n[0], x < 6 ? 0 : -lean / length, 0.03);
            assert_scene(n[1], 0, 0.03);
            assert_true(got[k] == (x == 5 || x == 6));
            assert_true(off[k] == 0 || strcmp(normal_get((size_t)m)->name, "projective") != 0);
        }
        frame_normals_free(&normals);
        s.frame.normals = NULL;
    }
}

/* Normals that face the camera, off by so many degrees before they were packed: towards a corner, and away from it. */
TEST(test_outlines_of_doubtful_normals) {
    static float got[PIXELS], off[PIXELS];
    static uint16_t degrees[PIXELS];
    static uint8_t texels[2 * PIXELS];
    const frame_normals normals = {.texels = texels, .off = degrees};
    double at[PARAMETERS_MAX];
    stage s;
    stage_make(&s);
    s.frame.normals = &normals;
    parameter_defaults(effect_find("outline")->parameters, at);
    stage_set("outline", at, "normal-sensitivity", 0.5);
    for (int k = 0; k < PIXELS; k++) {
        s.codes[k] = code_of(10);
        texels[2 * k] = texels[2 * k + 1] = 127;
        degrees[k] = (k < PIXELS / 2 ? 2 : 5) * FRAME_NORMAL_DEGREE; /* 2 sqrt(2) sin 5 is 0.247, above 0.2 */
    }
    stage_effect(&s, "outline", at, 0, false, got);
    stage_effect(&s, "outline", at, 0, true, off);
    for (int k = 0; k < PIXELS; k++) {
        assert_true(got[k] == 0);
        if (k < PIXELS / 2 - 2 * ACROSS || k > PIXELS / 2 + 2 * ACROSS)
            assert_true(off[k] == (k < PIXELS / 2 ? 0 : 255));
    }
}
