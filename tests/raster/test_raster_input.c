/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rasterizers and input that cannot be drawn, or only in part: an error or a right answer. */
#include <stdio.h>
#include <string.h>

#include "raster_named.h"

/* ---- What cannot be drawn ---------------------------------------------------------------------------------------- */

enum { SIZE = 512 };

static raster_status status_of(const char *name, const raster_vertex v[3], raster_triangle *drawn) {
    const raster_target target = target_of(name, "fp32", SIZE, SIZE, dp_path_best());
    return raster_set_up(&target, v, drawn);
}

TEST(what_cannot_be_drawn) {
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
    for (size_t row = 0; row < raster_table.count && raster_get(row)->model != NULL; row++) {
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

TEST(what_cannot_be_a_target) {
    raster_target target = {.width = -5};
    dp_format format[4][2];
    static const char *const names[] = {"fp32", "unorm24", "fp16", "unorm8"};
    for (int i = 0; i < 4; i++)
        assert_int_equal(dp_format_parse(names[i], format[i]), 1);
    for (size_t row = 0; row <= raster_table.count; row++) {
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

/* Who steps codes from pixel to pixel does so in 16 bits of UNORM alone: nobody steps floating-point depth. */
TEST(formats_without_a_bound) {
    static const char *const names[] = {"unorm16", "unorm8",    "unorm15",   "unorm17",   "unorm24",
                                        "fp32",    "float5.10", "float5.11", "float6.10", "float8.8"};
    for (size_t row = 0; row < raster_table.count; row++)
        for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
            const bool stepped = i == 0 && strcmp(raster_get(row)->name, "softpipe") == 0;
            dp_format format[2];
            assert_int_equal(dp_format_parse(names[i], format), 1);
            if (raster_bounded(raster_get(row), &format[0]) == stepped)
                fail_msg("%s, %s: %s", raster_get(row)->name, names[i], stepped ? "bounded" : "not bounded");
        }
}

/* Any bits for vertices: what is drawn stays inside the target, and depths are numbers, clamped ones in 0 to 1. */
TEST(any_bits) {
    tally spans = {.name = "spans of any bits"};
    rng r = rng_make("any bits");
    unsigned long of[RASTER_STATUS_COUNT] = {0};
    for (size_t row = 0; row < raster_table.count && raster_get(row)->model != NULL; row++) {
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
                if (n % 16 == 0 && kind == 0)
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

/* A triangle whose vertices all lie beyond one plane, if only by the last bit, is not drawn, although the vertices that
 * other planes cut it at are rounded: those of a triangle around the whole target all are. */
TEST(beyond_one_plane) {
    rng r = rng_make("beyond one plane");
    tally t = {.name = "triangles beyond one plane"};
    for (size_t row = 0; row < raster_table.count && raster_get(row)->model != NULL; row++)
        for (uint64_t n = test_cases(500, 2000, 8000); n > 0; n--) {
            const int plane = (int)rng_below(&r, 6);
            raster_triangle drawn;
            raster_vertex v[3];
            for (int i = 0; i < 3; i++) {
                const float w = (float)rng_log(&r, 0.5, 8), beyond = nextafterf(w, 9);
                const float x = (float)((i == 0 ? 0.0 : i == 1 ? -1.0 : 1.0) * rng_uniform(&r, 4, 9)) * w;
                const float y = (float)((i == 0 ? 1.0 : -1.0) * rng_uniform(&r, 4, 9)) * w;
                const float z = (float)rng_uniform(&r, -2, 3) * w;
                v[i] = (raster_vertex){plane == 0   ? beyond
                                       : plane == 1 ? -beyond
                                                    : x,
                                       plane == 2   ? beyond
                                       : plane == 3 ? -beyond
                                                    : y,
                                       plane == 4   ? -0x1p-149F
                                       : plane == 5 ? beyond
                                                    : z,
                                       w};
            }
            const raster_status status = status_of(raster_get(row)->name, v, &drawn);
            TALLY(&t, status == RASTER_EMPTY, "%s, plane %d: status %d, %a %a %a", raster_get(row)->name, plane,
                  (int)status, (double)v[0].w, (double)v[1].w, (double)v[2].w);
        }
    tally_end(&t);
}

/* ---- Behind the eye ---------------------------------------------------------------------------------------------- */

static long double det3(const long double m[3][3]) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* A plane as it is seen at a place: its depth, and of the weights of vertices the least, and the sum of their sizes.
 */
typedef struct sight {
    double depth, least, sum;
} sight;

/*
 * At a place of the viewport, -1 to 1: the weights b with sum b (x, y, w) = (x, y, 1), all positive inside the triangle
 * and in front of the eye. The depth is sum b z; on the screen b w weighs the vertices.
 */
static sight seen_at(const raster_vertex v[3], long double x, long double y) {
    const long double of[3][3] = {{v[0].x, v[1].x, v[2].x}, {v[0].y, v[1].y, v[2].y}, {v[0].w, v[1].w, v[2].w}};
    const long double at[3] = {x, y, 1}, whole = det3(of);
    sight seen = {.least = INFINITY};
    for (int i = 0; i < 3; i++) {
        long double one[3][3];
        memcpy(one, of, sizeof one);
        for (int k = 0; k < 3; k++)
            one[k][i] = at[k];
        const double b = (double)(det3(one) / whole);
        seen.least = fmin(seen.least, b);
        seen.sum += fabs(b * (double)v[i].w);
        seen.depth += b * (double)v[i].z;
    }
    return seen;
}

typedef struct judged {
    unsigned long pixels, covered, misplaced, off;
} judged;

/*
 * Every pixel of a target: how many are clearly where the triangle is seen between near and far and left out, or the
 * reverse; and how many depths are off by more than what snapping does to them, with the sizes of the weights, and
 * little more.
 */
static void judge_all(const raster_target *target, const raster_vertex v[3], judged *j) {
    const long double wide = 2.0L / target->width, high = 2.0L / target->height;
    const double snap = target->row->plane_bits > 0 ? ldexp(1, -target->row->plane_bits - 1) : 0;
    const double corner = seen_at(v, 0, 0).depth;
    const double slope = fabs(seen_at(v, wide, 0).depth - corner) + fabs(seen_at(v, 0, high).depth - corner);
    raster_triangle drawn;
    if (raster_set_up(target, v, &drawn) != RASTER_OK)
        drawn.count = 0;
    for (int y = 0; y < target->height; y++)
        for (int x = 0; x < target->width; x++) {
            const sight want = seen_at(v, (x + 0.5L) * wide - 1, (y + 0.5L) * high - 1);
            const double inside = fmin(want.least, fmin(want.depth, 1.0 - want.depth));
            float depth = -1.0F;
            for (int i = 0, from, to; i < drawn.count; i++)
                if (raster_span(target, &drawn.piece[i], y, &from, &to) && x >= from && x < to)
                    raster_depths(target, &drawn.piece[i], y, x, x + 1, &depth);
            j->pixels++;
            j->misplaced += fabs(inside) > 0.02 && (depth >= 0.0F) != (inside > 0);
            if (depth < 0.0F || inside <= 0)
                continue;
            j->covered++;
            j->off += fabs((double)depth - want.depth) > slope * snap * want.sum + 2e-5;
        }
}

/*
 * Near 1, far 10: one or two vertices behind the eye or before near, each in turn, both ways round. SwiftShader snaps
 * those too. Few pixels are in triangles like needles, or in such pieces of Mesa's, of which no bound is that small.
 */
TEST(behind_the_eye) {
    rng r = rng_make("behind the eye");
    for (size_t row = 0; row < raster_table.count && raster_get(row)->model != NULL; row++) {
        const raster_target target = target_of(raster_get(row)->name, "fp32", 128, 96, dp_path_best());
        judged j = {0};
        for (uint64_t n = test_cases(12, 60, 6000); n > 0; n--) {
            raster_vertex v[3];
            for (uint64_t k = 0; k < 3; k++) {
                const double z = (n / 3 % 2 == 0) == (k == n % 3) ? rng_uniform(&r, -4, 1) : rng_uniform(&r, 2, 9);
                const double x = z * rng_uniform(&r, -1.5, 1.5), y = z * rng_uniform(&r, -1.5, 1.5);
                v[k] = (raster_vertex){(float)x, (float)y, (float)((z - 1) * 10 / 9), (float)z};
            }
            judge_all(&target, v, &j);
        }
        if (j.covered < j.pixels / 200 || j.misplaced > 20 + j.pixels / 100000 || j.off > 50 + j.covered / 1000)
            fail_msg("%s: of %lu pixels %lu are covered, %lu of them off, and %lu misplaced", target.row->name,
                     j.pixels, j.covered, j.off, j.misplaced);
    }
}

/* ---- Far off the screen ----------------------------------------------------------------------------------------- */

/* A triangle over the target with corners far to both sides: the right depth. SwiftShader's positions wrap where it
 * says so. */
TEST(far_off) {
    static const double offs[] = {1e3, 1e5, 1e7, 6.6e7, 6.8e7, 1e8};
    for (size_t row = 0; row < raster_table.count && raster_get(row)->model != NULL; row++)
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
