/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rasterizers beyond what was recorded of them: other targets, every path. */
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
TEST(other_targets) {
    static const int sizes[][2] = {{1920, 1080}, {333, 77}, {16384, 16384}, {1, 1}, {7, 2048}};
    tally coverage = {.name = "coverage"}, depths = {.name = "depths"};
    rng r = rng_make("other targets");
    double used[4] = {0};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (size_t row = 0; row < raster_table.count && raster_get(row)->model != NULL; row++) {
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

TEST(every_path) {
    tally depths = {.name = "depths of each path"};
    rng r = rng_make("paths");
    for (size_t row = 0; row < raster_table.count && raster_get(row)->model != NULL; row++)
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
TEST(next_to_ties) {
    tally depths = {.name = "depths next to ties"};
    const raster_target target = target_of("llvmpipe", "fp32", RASTER_SIZE_MAX, RASTER_SIZE_MAX, DP_PATH_BASELINE);
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
TEST(fused_positions) {
    tally planes = {.name = "planes"};
    rng r = rng_make("fused positions");
    unsigned long differ = 0;
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
        const double left = (double)(x[0] - x[1]) * (double)(y[2] - y[0]);
        if (left - (double)(y[0] - y[1]) * (double)(x[2] - x[0]) < 10.0)
            continue; /* clockwise, or it may be so when it is snapped */
        const float o = 1.0F / ((x[0] - x[1]) * (y[2] - y[0]) - (y[0] - y[1]) * (x[2] - x[0]));
        const float a = (z[0] - z[1]) * ((y[2] - y[0]) * o) - (z[2] - z[0]) * ((y[0] - y[1]) * o);
        const float b = (z[2] - z[0]) * ((x[0] - x[1]) * o) - (z[0] - z[1]) * ((x[2] - x[0]) * o);
        TALLY(&planes, drawn.piece[0].plane.a == a && drawn.piece[0].plane.b == b, "%a %a, not %a %a",
              (double)drawn.piece[0].plane.a, (double)drawn.piece[0].plane.b, (double)a, (double)b);
    }
    assert_true(differ > 100);
    tally_end(&planes);
}
