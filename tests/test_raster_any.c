/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rasterizers beyond what was recorded of them: other targets, every path, bad input. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "raster_named.h"

/* ---- Other targets ----------------------------------------------------------------------------------------------- */

/* The plane and the edges of a triangle in long double, from its vertices as they are given. */
typedef struct truth {
    long double x[3], y[3], z[3], area; /* window coordinates, pixels; twice the area, signed */
} truth;

static truth truth_of(const raster_vertex v[3], int width, int height) {
    truth t;
    for (int i = 0; i < 3; i++) {
        t.x[i] = ((long double)v[i].x / (long double)v[i].w + 1) * width / 2;
        t.y[i] = ((long double)v[i].y / (long double)v[i].w + 1) * height / 2;
        t.z[i] = (long double)v[i].z / (long double)v[i].w;
    }
    t.area = (t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) - (t.x[2] - t.x[0]) * (t.y[1] - t.y[0]);
    return t;
}

/* Slopes of depth per pixel. */
static void slopes(const truth *t, double *along_x, double *along_y) {
    const long double z1 = t->z[1] - t->z[0], z2 = t->z[2] - t->z[0];
    *along_x = (double)((z1 * (t->y[2] - t->y[0]) - z2 * (t->y[1] - t->y[0])) / t->area);
    *along_y = (double)((z2 * (t->x[1] - t->x[0]) - z1 * (t->x[2] - t->x[0])) / t->area);
}

/* How far inside all edges a pixel's centre is, pixels; negative outside. */
static double inside(const truth *t, int x, int y) {
    double least = INFINITY;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const long double dx = t->x[j] - t->x[i], dy = t->y[j] - t->y[i];
        const long double cross = dx * (y + 0.5L - t->y[i]) - dy * (x + 0.5L - t->x[i]);
        least = fmin(least, (double)(cross / hypotl(dx, dy) * (t->area < 0 ? -1 : 1)));
    }
    return least;
}

/*
 * The most that snapping and the row's set-up add to unclipped triangles of fp32, see triangles.h: derived for the way
 * in which the row anchors its planes, and taken with the triangle's own M, R and L.
 */
static double allowed(const raster_row *row, const truth *t, int width, int height) {
    const dp_plane_error *e = &dp_anchor_get(row->anchor)->plane;
    const double snap = row->plane_bits > 0 ? ldexp(1, -row->plane_bits - 1) : 0;
    double gx, gy, least[3] = {INFINITY, INFINITY, INFINITY}, most[3] = {-INFINITY, -INFINITY, -INFINITY};
    slopes(t, &gx, &gy);
    for (int i = 0; i < 3; i++) {
        const double at[3] = {(double)t->x[i], (double)t->y[i], (double)t->z[i]};
        for (int k = 0; k < 3; k++) {
            least[k] = fmin(least[k], at[k]);
            most[k] = fmax(most[k], at[k]);
        }
    }
    const double slim = (most[0] - least[0]) * (most[1] - least[1]) / fabs((double)t->area);
    return (fabs(gx) + fabs(gy)) * snap +
           0x1p-24 * (e->value * most[2] + (e->box * slim + e->range) * (most[2] - least[2]) +
                      e->origin * (fabs(gx) * width + fabs(gy) * height));
}

static raster_vertex random_vertex(rng *r, double x, double y) {
    const double w = rng_log(r, 0.5, 2);
    return (raster_vertex){(float)(x * w), (float)(y * w), (float)(rng_uniform(r, 0.1, 0.9) * w), (float)w};
}

/* Every pixel about a triangle: covered where it is clearly inside, left out where clearly outside, the depth right. */
static void judge_triangle(const raster_target *target, const raster_vertex v[3], tally *coverage, tally *depths,
                           double *used) {
    const truth t = truth_of(v, target->width, target->height);
    /* softpipe steps along its edges in binary32. */
    const double margin = ldexp(1, -target->row->subpixel_bits) + 8 * 0x1p-23 * fmax(target->width, target->height);
    const double bound = allowed(target->row, &t, target->width, target->height);
    raster_triangle drawn;
    double gx, gy;
    float depth;
    const raster_status status = raster_set_up(target, v, &drawn);
    slopes(&t, &gx, &gy);
    if (status == RASTER_EMPTY) {
        depths->skipped++;
        return;
    }
    assert_int_equal(status, RASTER_OK);
    const int left = (int)fminl(fminl(t.x[0], t.x[1]), t.x[2]), right = (int)fmaxl(fmaxl(t.x[0], t.x[1]), t.x[2]);
    const int low = (int)fminl(fminl(t.y[0], t.y[1]), t.y[2]), high = (int)fmaxl(fmaxl(t.y[0], t.y[1]), t.y[2]);
    for (int y = low - 1; y <= high + 1; y++)
        for (int x = left - 1; x <= right + 1; x++) {
            int from = 0, to = 0;
            const double at = inside(&t, x, y);
            const bool covered = raster_span(target, &drawn.piece[0], y, &from, &to) && x >= from && x < to;
            if (fabs(at) > margin && x >= 0 && x < target->width && y >= 0 && y < target->height)
                TALLY(coverage, covered == (at > 0), "%s, %d x %d: pixel %d %d is %g inside", target->row->name,
                      target->width, target->height, x, y, at);
            if (!covered || at < 0)
                continue;
            raster_depths(target, &drawn.piece[0], y, x, x + 1, &depth);
            const long double exact =
                t.z[0] + (long double)gx * (x + 0.5L - t.x[0]) + (long double)gy * (y + 0.5L - t.y[0]);
            *used = fmax(*used, fabs((double)depth - (double)exact) / bound);
            TALLY(depths, fabs((double)depth - (double)exact) <= bound,
                  "%s, %d x %d: pixel %d %d is %.9g, not %.9g, %g", target->row->name, target->width, target->height, x,
                  y, (double)depth, (double)exact, bound);
        }
}

/* Targets that are neither square nor a power of two: right within the bound derived for the row. */
static void other_targets(void **state) {
    static const int sizes[][2] = {{1920, 1080}, {333, 77}, {16384, 16384}, {1, 1}, {7, 2048}};
    tally coverage = {.name = "coverage"}, depths = {.name = "depths"};
    rng r = rng_make("other targets");
    double used[4] = {0};
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (size_t row = 0; row < raster_count() && raster_get(row)->model != NULL; row++) {
            const int width = sizes[i][0], height = sizes[i][1];
            const raster_target target = target_of(raster_get(row)->name, "fp32", width, height, dp_path_best());
            for (uint64_t n = test_cases(100, 600, 6000); n > 0; n--) {
                const double x = rng_uniform(&r, -1, 1), y = rng_uniform(&r, -1, 1), span = rng_log(&r, 2, 60);
                raster_vertex v[3];
                for (int k = 0; k < 3; k++)
                    v[k] = random_vertex(&r, fmax(-1, fmin(1, x + span / width * rng_uniform(&r, -1, 1))),
                                         fmax(-1, fmin(1, y + span / height * rng_uniform(&r, -1, 1))));
                if (fabsl(truth_of(v, width, height).area) > 0.5L)
                    judge_triangle(&target, v, &coverage, &depths, &used[row]);
            }
        }
    printf("# %llu pixels' depths, %llu triangles empty\n", (unsigned long long)depths.cases,
           (unsigned long long)depths.skipped);
    for (int row = 0; row < 4; row++) {
        printf("# %s uses %.2f of its bound\n", raster_get((size_t)row)->name, used[row]);
        assert_true(used[row] > 0.2);
    }
    tally_end(&coverage);
    tally_end(&depths);
}

/* ---- Operations and paths ---------------------------------------------------------------------------------------- */

static float clamped(float d) {
    return d < 0.0F ? 0.0F : d > 1.0F ? 1.0F : d;
}

/* A pixel's depth by the operations of the recording's description, the library's fmaf for its fma. */
static float operations(const raster_row *row, const raster_plane *p, int x, int y) {
    if (row->plane_bits > 0)
        return clamped(p->c + ((float)y - p->y) * p->b + ((float)x - p->x) * p->a);
    if (strcmp(row->name, "softpipe") != 0)
        return clamped(fmaf(p->b, (float)y, fmaf(p->a, (float)x, p->c)));
    float d = p->c + p->a * (float)(x & ~1) + p->b * (float)(y & ~1);
    if (x % 2 != 0)
        d += p->a;
    return y % 2 != 0 ? d + p->b : d;
}

/* Planes whose products and sums lie anywhere between two numbers, ties and nearly ties among them. */
static float random_slope(rng *r) {
    const double size = rng_log(r, 1e-12, 1e-2);
    const int bits = (int)rng_below(r, 25);
    return (float)((rng_below(r, 2) ? size : -size) * (1 + ldexp((double)rng_below(r, 4), -bits)));
}

static void every_path(void **state) {
    tally depths = {.name = "depths of each path"};
    rng r = rng_make("paths");
    (void)state;
    for (size_t row = 0; row < raster_count() && raster_get(row)->model != NULL; row++)
        for (int path = 0; path < DP_PATH_COUNT; path++) {
            if (!dp_path_available((dp_path)path))
                continue;
            const raster_target target = target_of(raster_get(row)->name, "fp32", 4096, 4096, (dp_path)path);
            for (uint64_t n = test_cases(2000, 20000, 200000); n > 0; n--) {
                const raster_piece piece = {
                    .plane = {random_slope(&r), random_slope(&r), (float)rng_uniform(&r, -0.2, 1.2),
                              (float)rng_uniform(&r, 0, 4096), (float)rng_uniform(&r, 0, 4096)}};
                const int count = 1 + (int)rng_below(&r, 50);
                const int x = (int)rng_below(&r, 4096 - (uint64_t)count), y = (int)rng_below(&r, 4096);
                float depth[51];
                depth[count] = -7.0F;
                raster_depths(&target, &piece, y, x, x + count, depth);
                assert_true(depth[count] == -7.0F);
                for (int i = 0; i < count; i++) {
                    const float want = operations(target.row, &piece.plane, x + i, y);
                    TALLY(&depths, memcmp(&depth[i], &want, sizeof want) == 0 || (depth[i] == 0.0F && want == 0.0F),
                          "%s, %s: %a %a %a at %d %d is %a, not %a", target.row->name, dp_path_name((dp_path)path),
                          (double)piece.plane.a, (double)piece.plane.b, (double)piece.plane.c, x + i, y,
                          (double)depth[i], (double)want);
                }
            }
        }
    tally_end(&depths);
}

/*
 * Sums that lie next to the middle of two binary32 numbers, closer than double can tell: m x = 2^37 + r with a small r,
 * so a x = 2^-25 + r 2^-62 beside c = 1/2, whose numbers are 2^-24 apart. Of the row, and of the column.
 */
static void next_to_ties(void **state) {
    tally depths = {.name = "depths next to ties"};
    const raster_target target = target_of("llvmpipe", "fp32", RASTER_SIZE_MAX, RASTER_SIZE_MAX, DP_PATH_BASELINE);
    (void)state;
    for (int x = 8193; x < RASTER_SIZE_MAX; x += 2)
        for (int side = -1; side <= 1; side += 2) {
            const int64_t m = (INT64_C(1) << 37) / x + (side > 0);
            const int64_t r = m * x - (INT64_C(1) << 37);
            if (llabs(r) >= 256)
                continue;
            const float slope = (float)ldexp((double)m, -62);
            const raster_piece pieces[] = {{.plane = {slope, 0, 0.5F, 0, 0}},
                                           {.plane = {0, slope, 0.5F, 0, 0}},
                                           {.plane = {slope, 0, 0.5F + 0x1p-24F, 0, 0}},
                                           {.plane = {0, slope, 0.5F + 0x1p-24F, 0, 0}}};
            for (int i = 0; i < 4; i++) {
                const bool along_x = i % 2 == 0;
                const float want = operations(target.row, &pieces[i].plane, along_x ? x : 0, along_x ? 0 : x);
                float depth;
                raster_depths(&target, &pieces[i], along_x ? 0 : x, along_x ? x : 0, along_x ? x + 1 : 1, &depth);
                TALLY(&depths, depth == want, "slope %a at %d: %a, not %a", (double)slope, x, (double)depth,
                      (double)want);
            }
        }
    tally_end(&depths);
}

/* The plane of llvmpipe where half the target is no power of two, so that its fused positions differ from others. */
static void fused_positions(void **state) {
    tally planes = {.name = "planes"};
    rng r = rng_make("fused positions");
    unsigned long differ = 0;
    (void)state;
    for (int n = 0; n < 2000; n++) {
        const raster_target target = target_of("llvmpipe", "fp32", 1914, 1083, dp_path_best());
        raster_vertex v[3];
        raster_triangle drawn;
        float x[3], y[3], z[3];
        for (int k = 0; k < 3; k++)
            v[k] = random_vertex(&r, rng_uniform(&r, -1, 1), rng_uniform(&r, -1, 1));
        if (raster_set_up(&target, v, &drawn) != RASTER_OK)
            continue;
        for (int k = 0; k < 3; k++) {
            const float w = 1.0F / v[k].w, at = v[k].x * w;
            x[k] = fmaf(at, 957.0F, 957.0F);
            y[k] = fmaf(v[k].y * w, 541.5F, 541.5F);
            z[k] = v[k].z * w;
            differ += x[k] != at * 957.0F + 957.0F;
        }
        if ((double)(x[0] - x[1]) * (double)(y[2] - y[0]) < (double)(y[0] - y[1]) * (double)(x[2] - x[0]))
            continue; /* clockwise */
        const float o = 1.0F / ((x[0] - x[1]) * (y[2] - y[0]) - (y[0] - y[1]) * (x[2] - x[0]));
        const float a = (z[0] - z[1]) * ((y[2] - y[0]) * o) - (z[2] - z[0]) * ((y[0] - y[1]) * o);
        const float b = (z[2] - z[0]) * ((x[0] - x[1]) * o) - (z[0] - z[1]) * ((x[2] - x[0]) * o);
        TALLY(&planes, drawn.piece[0].plane.a == a && drawn.piece[0].plane.b == b, "%a %a, not %a %a",
              (double)drawn.piece[0].plane.a, (double)drawn.piece[0].plane.b, (double)a, (double)b);
    }
    assert_true(differ > 100);
    tally_end(&planes);
}

/* ---- What cannot be drawn ---------------------------------------------------------------------------------------- */

enum { SIZE = 512 };

static raster_status status_of(const char *name, const raster_vertex v[3], raster_triangle *drawn) {
    const raster_target target = target_of(name, "fp32", SIZE, SIZE, dp_path_best());
    return raster_set_up(&target, v, drawn);
}

static void what_cannot_be_drawn(void **state) {
    static const raster_vertex fine[3] = {{-0.5F, -0.5F, 0.5F, 1}, {0.5F, -0.5F, 0.5F, 1}, {0, 0.5F, 0.5F, 1}};
    static const struct {
        const char *what;
        raster_vertex v[3];
        raster_status status;
    } cases[] = {
        {"one point", {{0, 0, 0.5F, 1}, {0, 0, 0.5F, 1}, {0, 0, 0.5F, 1}}, RASTER_EMPTY},
        {"edge on", {{-0.5F, -0.5F, 0.1F, 1}, {0, 0, 0.5F, 1}, {0.5F, 0.5F, 0.9F, 1}}, RASTER_EMPTY},
        {"behind the eye", {{0, 0, -1, -1}, {1, 0, -1, -1}, {0, 1, -1, -1}}, RASTER_EMPTY},
        {"beside the frustum", {{3, 0, 0.5F, 1}, {4, 0, 0.5F, 1}, {3, 1, 0.5F, 1}}, RASTER_EMPTY},
        {"between centres", {{0, 0, 0.5F, 1}, {1e-4F, 0, 0.5F, 1}, {0, 1e-4F, 0.5F, 1}}, RASTER_EMPTY},
    };
    raster_triangle drawn;
    (void)state;
    for (size_t row = 0; row < raster_count() && raster_get(row)->model != NULL; row++) {
        const char *name = raster_get(row)->name;
        for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
            const raster_status status = status_of(name, cases[i].v, &drawn);
            if (status != cases[i].status || drawn.count != 0)
                fail_msg("%s, %s: status %d, %d pieces", name, cases[i].what, (int)status, drawn.count);
        }
        static const raster_vertex eye[3] = {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}}; /* 0/0, or nothing */
        assert_true(status_of(name, eye, &drawn) != RASTER_OK && drawn.count == 0);
        assert_int_equal(status_of(name, fine, &drawn), RASTER_OK);
        for (int i = 0; i < 24; i++) { /* each coordinate not a number, then infinite */
            raster_vertex v[3];
            memcpy(v, fine, sizeof v);
            ((float *)(void *)v)[i % 12] = i < 12 ? (float)NAN : (float)-INFINITY;
            assert_int_equal(status_of(name, v, &drawn), RASTER_VERTEX);
            assert_int_equal(drawn.count, 0);
        }
    }
}

static void what_cannot_be_a_target(void **state) {
    raster_target target = {.width = -5};
    dp_format format[4][2];
    static const char *const names[] = {"fp32", "unorm24", "fp16", "unorm8"};
    (void)state;
    for (int i = 0; i < 4; i++)
        assert_int_equal(dp_format_parse(names[i], format[i]), 1);
    for (size_t row = 0; row <= raster_count(); row++) {
        const raster_row *r = raster_get(row);
        if (r == NULL || r->model == NULL) {
            assert_int_equal(raster_target_init(&target, row, 64, 64, format[0], DP_PATH_BASELINE), RASTER_MODEL);
            continue;
        }
        static const int sizes[][2] = {
            {0, 64}, {64, 0}, {-1, 64}, {RASTER_SIZE_MAX + 1, 64}, {64, RASTER_SIZE_MAX + 1}};
        for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
            assert_int_equal(raster_target_init(&target, row, sizes[i][0], sizes[i][1], format[0], DP_PATH_BASELINE),
                             RASTER_TARGET);
        assert_int_equal(raster_target_init(&target, row, 64, 64, format[0], DP_PATH_COUNT), RASTER_TARGET);
        assert_int_equal(raster_target_init(&target, row, 64, 64, NULL, DP_PATH_BASELINE), RASTER_FORMAT);
        for (int i = 2; i < 4; i++)
            assert_int_equal(raster_target_init(&target, row, 64, 64, format[i], DP_PATH_BASELINE), RASTER_FORMAT);
        assert_int_equal(target.width, -5);
        assert_int_equal(raster_target_init(&target, row, 64, 64, format[1], DP_PATH_BASELINE),
                         strcmp(r->name, "swiftshader") == 0 ? RASTER_FORMAT : RASTER_OK);
        target.width = -5;
    }
    for (int i = 0; i < RASTER_STATUS_COUNT; i++)
        assert_true(strlen(raster_status_text((raster_status)i)) > 4);
    assert_string_equal(raster_status_text((raster_status)-1), "not a status");
}

/* Any bits for vertices: what is drawn stays inside the target, and depths are numbers, clamped ones in 0 to 1. */
static void any_bits(void **state) {
    tally spans = {.name = "spans of any bits"};
    rng r = rng_make("any bits");
    unsigned long of[RASTER_STATUS_COUNT] = {0};
    (void)state;
    for (size_t row = 0; row < raster_count() && raster_get(row)->model != NULL; row++) {
        const raster_target target = target_of(raster_get(row)->name, "unorm16", 300, 200, dp_path_best());
        const bool softpipe = strcmp(target.row->name, "softpipe") == 0;
        for (uint64_t n = test_cases(3000, 10000, 100000); n > 0; n--) {
            static raster_triangle drawn;
            raster_vertex v[3];
            float *number = (float *)(void *)v;
            for (int i = 0; i < 12; i++) {
                const uint64_t kind = rng_below(&r, 4);
                const uint32_t bits = (uint32_t)rng_next(&r);
                const double sign = rng_below(&r, 2) ? 1 : -1;
                number[i] = kind == 0   ? (float)(sign * rng_log(&r, 1e-38, 1e38))
                            : kind == 1 ? (float)(sign * (double)rng_below(&r, 3))
                                        : (float)rng_uniform(&r, i % 4 < 2 ? -2 : -0.5, 2);
                if (n % 64 == 0 && kind == 0)
                    memcpy(&number[i], &bits, sizeof bits);
            }
            const raster_status status = raster_set_up(&target, v, &drawn);
            of[status]++;
            assert_int_equal(status == RASTER_OK, drawn.count > 0);
            assert_in_range(drawn.count, 0, RASTER_PIECES);
            for (int i = 0; i < drawn.count; i++)
                for (int y = -3, from, to; y < target.height + 3; y++) {
                    float depth[300];
                    uint32_t code[300];
                    if (!raster_span(&target, &drawn.piece[i], y, &from, &to))
                        continue;
                    TALLY(&spans, from >= 0 && from < to && to <= 300 && y >= 0 && y < 200, "%s: row %d, %d to %d",
                          target.row->name, y, from, to);
                    raster_depths(&target, &drawn.piece[i], y, from, to, depth);
                    raster_codes(&target, &drawn.piece[i], y, from, to, code);
                    for (int x = 0; x < to - from; x++)
                        TALLY(&spans,
                              (softpipe ? isfinite(depth[x]) : depth[x] >= 0 && depth[x] <= 1) && code[x] < 65536,
                              "%s: row %d, pixel %d: %g, %u", target.row->name, y, from + x, (double)depth[x],
                              (unsigned)code[x]);
                }
        }
    }
    printf("# drawn %lu, empty %lu, not numbers %lu, out of range %lu\n", of[RASTER_OK], of[RASTER_EMPTY],
           of[RASTER_VERTEX], of[RASTER_RANGE]);
    assert_true(of[RASTER_OK] > 1000 && of[RASTER_EMPTY] > 1000 && of[RASTER_VERTEX] > 0 && of[RASTER_RANGE] > 10);
    tally_end(&spans);
}

/* A triangle over the target with corners far to both sides: the right depth. SwiftShader's positions wrap where it
 * says so. */
static void far_off(void **state) {
    static const double offs[] = {1e3, 1e5, 1e7, 6.6e7, 6.8e7, 1e8};
    (void)state;
    for (size_t row = 0; row < raster_count() && raster_get(row)->model != NULL; row++)
        for (size_t n = 0; n < sizeof offs / sizeof offs[0]; n++) {
            const raster_target target = target_of(raster_get(row)->name, "fp32", SIZE, SIZE, dp_path_best());
            const float far_x = (float)(offs[n] / (SIZE / 2));
            const raster_vertex v[3] = {{-far_x, -1, 0.25F, 1}, {far_x, -1, 0.75F, 1}, {0, 3, 0.5F, 1}};
            raster_triangle drawn;
            float depth = -1;
            int from, to, covered = 0;
            assert_int_equal(raster_set_up(&target, v, &drawn), RASTER_OK);
            for (int i = 0; i < drawn.count; i++)
                for (int y = 0; y < SIZE; y++)
                    if (raster_span(&target, &drawn.piece[i], y, &from, &to)) {
                        covered += to - from;
                        if (from <= SIZE / 2 && SIZE / 2 < to)
                            raster_depths(&target, &drawn.piece[i], y, SIZE / 2, SIZE / 2 + 1, &depth);
                    }
            assert_true(offs[n] > 1e5 ? covered > 0
                                      : covered == SIZE * SIZE); /* clipping loses columns, as Mesa does */
            const bool wraps = target.row->plane_bits > 0 && offs[n] > 6.7e7;
            const double want = 0.5 + 0.25 * 0.5 / offs[n];
            if ((fabs((double)depth - want) <= 1e-6) == wraps)
                fail_msg("%s: vertices %g pixels off give %g", target.row->name, offs[n], (double)depth);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(other_targets),
        cmocka_unit_test(every_path),
        cmocka_unit_test(next_to_ties),
        cmocka_unit_test(fused_positions),
        cmocka_unit_test(what_cannot_be_drawn),
        cmocka_unit_test(what_cannot_be_a_target),
        cmocka_unit_test(any_bits),
        cmocka_unit_test(far_off),
    };
    return run_tap(tests);
}
