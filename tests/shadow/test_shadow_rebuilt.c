/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Receivers of a shadow that are rebuilt from the camera's depth texture: planes at any slant, drawn as triangles whose
 * vertices go through matrix, viewport and subpixel grid in binary32; the depth of one pixel in a format, read back by
 * LinearEyeDepth and put on the ray between the corners, all in binary32. How far that is off the plane is never more
 * than src/shadow says, and comes close.
 */
#include "shadow/shadow.h"
#include "support.h"

static const double pi = 3.14159265358979323846;

typedef struct view {
    dp_setup setup;
    double n, f, half[2]; /* planes; tangents of half the angles */
    bool reversed, gl;
} view;

static view random_view(rng *r, const char *format) {
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_GL, DP_MAPPING_REVERSED};
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    view v = {.n = rng_log(r, 0.01, 1)};
    assert_int_equal(dp_format_parse(format, found), 1);
    spec.format = found[0];
    spec.mapping = mappings[rng_below(r, 3)];
    spec.znear = v.n;
    spec.zfar = v.f = v.n * rng_log(r, 100, 3000);
    spec.triangles = dp_triangles_default();
    spec.triangles.width = (int)rng_log(r, 200, 4000);
    spec.triangles.height = (int)rng_log(r, 200, 2000);
    spec.triangles.fov_y = rng_uniform(r, 20, 100);
    assert_int_equal(dp_setup_init(&v.setup, &spec), DP_OK);
    v.half[1] = tan(spec.triangles.fov_y * pi / 360);
    v.half[0] = v.half[1] * spec.triangles.width / spec.triangles.height;
    v.reversed = spec.mapping == DP_MAPPING_REVERSED;
    v.gl = spec.mapping == DP_MAPPING_GL;
    return v;
}

/* z_clip = a z + b, entries rounded to binary32. */
static float window_of(const view *v, float z) {
    const double n = v->n, f = v->f;
    const float a = (float)(v->reversed ? -n / (f - n) : v->gl ? (f + n) / (f - n) : f / (f - n));
    const float b = (float)(v->reversed ? n * f / (f - n) : v->gl ? -2 * f * n / (f - n) : -f * n / (f - n));
    volatile float product = a * z;
    const float ndc = (product + b) / z;
    return v->gl ? 0.5F * ndc + 0.5F : ndc;
}

/* LinearEyeDepth by _ZBufferParams. */
static float eye_of(const view *v, float d) {
    const double x = v->reversed ? v->f / v->n - 1 : 1 - v->f / v->n, y = v->reversed ? 1 : v->f / v->n;
    volatile float product = (float)(x / v->f) * d;
    return 1 / (product + (float)(y / v->f));
}

/* The ray of a pixel, between the corners, as a vertex shader hands them on. */
static void ray_of(const view *v, float u, float w, float out[3]) {
    const float corner[3] = {(float)v->half[0], (float)v->half[1], 1};
    for (int k = 0; k < 3; k++) {
        const float x = k == 0 ? corner[0] : 0, y = k == 1 ? corner[1] : 0, z = k == 2 ? 1 : 0;
        const float left[2] = {z - x - y, z - x + y}, right[2] = {z + x - y, z + x + y};
        volatile float rise = w * (left[1] - left[0]), rise_right = w * (right[1] - right[0]);
        const float a = left[0] + rise, b = right[0] + rise_right;
        volatile float across = u * (b - a);
        out[k] = a + across;
    }
}

/* A vertex of the plane through a pixel: where it is drawn and its depth; false where it is beyond the class. */
static bool vertex_of(const view *v, const double n[3], double c, double z, const double at[2], double drawn[3]) {
    const dp_triangles *t = &v->setup.spec.triangles;
    const double slope[2] = {(2 * at[0] / t->width - 1) * v->half[0], (2 * at[1] / t->height - 1) * v->half[1]};
    const double eye = c / (n[0] * slope[0] + n[1] * slope[1] + n[2]);
    if (!(eye > fmax(z / 2, v->n) && eye < fmin(2 * z, v->f)))
        return false;
    const float place[3] = {(float)(slope[0] * eye), (float)(slope[1] * eye), (float)eye};
    for (int k = 0; k < 2; k++) {
        const float side = (float)(k == 0 ? t->width : t->height);
        const float ndc = (float)(1 / v->half[k]) * place[k] / place[2];
        const float window = (0.5F * ndc + 0.5F) * side;
        drawn[k] = ldexp(rint(ldexp((double)window, t->subpixel)), -t->subpixel);
    }
    drawn[2] = (double)window_of(v, place[2]);
    return true;
}

/* The depth of the drawn triangle at a place of the picture. */
static double depth_at(const double v[3][3], const double at[2]) {
    const double ax = v[1][0] - v[0][0], ay = v[1][1] - v[0][1], bx = v[2][0] - v[0][0], by = v[2][1] - v[0][1];
    const double x = at[0] - v[0][0], y = at[1] - v[0][1], area = ax * by - ay * bx;
    return v[0][2] + ((v[1][2] - v[0][2]) * (x * by - y * bx) + (v[2][2] - v[0][2]) * (ax * y - ay * x)) / area;
}

/* How far off the plane one rebuilt pixel is; NaN where no triangle of the class is found. */
static double off_plane(rng *r, const view *v, double z) {
    const dp_triangles *t = &v->setup.spec.triangles;
    const bool corner = rng_below(r, 2), facing = rng_below(r, 2);
    const double pixel[2] = {corner ? t->width - 0.5 : 0.5 + (double)rng_below(r, (uint64_t)t->width),
                             corner ? t->height - 0.5 : 0.5 + (double)rng_below(r, (uint64_t)t->height)};
    const double slope[2] = {(2 * pixel[0] / t->width - 1) * v->half[0], (2 * pixel[1] / t->height - 1) * v->half[1]};
    const double tilt = facing ? 0 : rng_log(r, 0.01, 20), turn = rng_uniform(r, 0, 2 * pi);
    const double n[3] = {slope[0] + tilt * cos(turn), slope[1] + tilt * sin(turn), 1};
    const double c = (n[0] * slope[0] + n[1] * slope[1] + n[2]) * z, size = rng_log(r, 2, 100);
    double drawn[3][3];
    for (int k = 0; k < 3; k++) {
        const double angle = turn + 2 * pi * k / 3;
        if (!vertex_of(v, n, c, z, (const double[]){pixel[0] + size * cos(angle), pixel[1] + size * sin(angle)},
                       drawn[k]))
            return (double)NAN;
    }
    const float d = (float)fmin(fmax(depth_at((const double(*)[3])drawn, pixel), 0), 1);
    const dp_format *format = &v->setup.spec.format;
    const float stored = (float)dp_format_value(format, dp_format_encode(format, DP_ROUND_NEAREST, (double)d));
    float ray[3];
    ray_of(v, (float)(pixel[0] / t->width), (float)(pixel[1] / t->height), ray);
    double off = -c;
    for (int k = 0; k < 3; k++)
        off += n[k] * (double)(ray[k] * eye_of(v, stored));
    return fabs(off) / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

TEST(rebuilt_receivers) {
    static const struct {
        const char *format;
        double least; /* of the bound that is reached */
    } rows[] = {{"unorm16", 0.9}, {"unorm24", 0.5}, {"fp32", 0.2}};
    rng r = rng_make("rebuilt receivers");
    tally t = {.name = "rebuilt"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double most = 0;
        for (uint64_t round = test_cases(100, 1000, 20000); round > 0; round--) {
            const view v = random_view(&r, rows[i].format);
            const double lo = v.n * rng_log(&r, 2.5, v.f / v.n / 3), hi = fmin(lo * rng_log(&r, 1.001, 4), v.f / 2.1);
            const double bound = shadow_rebuilt(&v.setup, lo, hi, 0);
            for (int k = 0; k < 400; k++) {
                const double z = k % 2 ? hi : rng_uniform(&r, lo, hi), off = off_plane(&r, &v, z);
                TALLY(&t, !(off > bound), "%s, n %g, f %g, z %g: %g off, %g said", rows[i].format, v.n, v.f, z, off,
                      bound);
                most = off / bound > most ? off / bound : most;
            }
        }
        print_message("# %s: %.3f of the bound\n", rows[i].format, most);
        assert_true(most > rows[i].least);
    }
    tally_end(&t);
}

/* Positions in a large world: the camera's place and matrix are rounded there, which is some units of its size. */
TEST(in_a_world) {
    rng r = rng_make("rebuilt in a world");
    const view v = random_view(&r, "fp32");
    const double near_by = shadow_rebuilt(&v.setup, 2 * v.n, v.f / 3, 0), world = 1e5;
    const double more = shadow_rebuilt(&v.setup, 2 * v.n, v.f / 3, world) - near_by;
    assert_relative(more, (1 + 8 * sqrt(3)) * sqrt(3) * world / 16777216, 1e-4);
}

/* A cascade's receivers lie at its own depths; nothing is added without a camera. */
TEST(cascades) {
    rng r = rng_make("rebuilt cascades");
    const view v = random_view(&r, "unorm24");
    shadow_split split = shadow_split_default();
    const shadow_light model = shadow_light_default();
    split.znear = v.n;
    split.zfar = v.f;
    for (int i = 0; i < split.count; i++) {
        shadow_cascade with, without;
        shadow_need need;
        split.camera = NULL;
        assert_int_equal(shadow_cascade_of(&split, &model, i, &without), SHADOW_OK);
        assert_true(without.light.position == 0);
        split.camera = &v.setup;
        assert_int_equal(shadow_cascade_of(&split, &model, i, &with), SHADOW_OK);
        const double off = shadow_rebuilt(&v.setup, with.from, with.to, 0);
        shadow_need_of(&with.light, &need);
        assert_relative(with.light.position, off, 1e-12);
        assert_relative(need.part[SHADOW_CAUSE_RECEIVER].window * (with.light.setup.spec.zfar), off, 1e-9);
    }
}
