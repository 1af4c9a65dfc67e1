/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A depth image of 3840 x 2160 in memory: eye depths, places and normals, each beside loops that move the same bytes,
 * with plain stores and with stores past the caches; then whole frames as the command makes them. All take turns, on
 * one thread, in time of the processor, and on all; the least counts. The place by "matrix" divides three times a
 * pixel, because engines do, and that alone is two thirds of the floor. Places are judged beside the plain copy: whole
 * frames read them again while they are in the caches, and take twice as long (41 for 23 ns a pixel) when they are
 * stored past them, which alone would spare the reading of the lines that are written.
 *
 * Rows that calculate more than they move are judged beside the row that they extend. With AVX-512 a processor does two
 * operations on 16 numbers in a cycle. Rounding to binary16 and back is 8 operations, 4 cycles, which is what the
 * processors' own conversions take, too; a place has three of them beside 50 operations, a normal twelve beside 60 to
 * 70: 48 of the 66 cycles that twice the floor is, where memory moves 28 bytes in a nanosecond. "projective" compares
 * products of four depths: 92 operations beside the 69 of "high-1".
 */
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "aims.h"
#include "core/clones.h"
#include "named.h"
#include "texture/frame.h"
#include "timing.h"

enum { WIDTH = 3840, HEIGHT = 2160, STRIDE = WIDTH + 16, RUNS = 9, WAYS_MAX = 24 };

static const size_t pixels = (size_t)WIDTH * HEIGHT;

static texture_camera camera;
static position_state position;
static dp_batch decoder;
static float *window, *eyes, *plane[3], *slope;
static uint32_t *codes;
static int threads = 1;

static const float *eye_row(int64_t row) {
    const int64_t inside = row < 0 ? 0 : row >= HEIGHT ? HEIGHT - 1 : row;
    return eyes + (size_t)inside * STRIDE + 8;
}

/* ---- Floors ------------------------------------------------------------------------------------------------------ */

CLONES static void copy_row(const float *restrict from, float *restrict to) {
    for (size_t i = 0; i < WIDTH; i++)
        to[i] = -from[i];
}

static void stream_row(const float *restrict from, float *restrict to) {
#ifdef __SSE2__
    for (size_t i = 0; i < WIDTH; i += 4)
        _mm_stream_ps(to + i, _mm_sub_ps(_mm_setzero_ps(), _mm_loadu_ps(from + i)));
#else
    copy_row(from, to);
#endif
}

typedef struct way way;
struct way {
    const char *name;
    void (*run)(const way *w, uint32_t row);
    int planes;    /* that are written: 1 or 3 */
    int streaming; /* 1: the floor of the others with as many planes */
    const void *method;
};

static void run_copy(const way *w, uint32_t row) {
    for (int k = 0; k < w->planes; k++)
        copy_row(window + (size_t)row * WIDTH, plane[k] + (size_t)row * WIDTH);
}

static void run_stream(const way *w, uint32_t row) {
    for (int k = 0; k < w->planes; k++)
        stream_row(window + (size_t)row * WIDTH, plane[k] + (size_t)row * WIDTH);
}

/* ---- What is measured -------------------------------------------------------------------------------------------- */

static void run_decode(const way *w, uint32_t row) {
    const decode_row *r = w->method;
    decode_run(r, &camera.setup, window + (size_t)row * WIDTH, plane[0] + (size_t)row * WIDTH, WIDTH);
}

static void run_batch(const way *w, uint32_t row) {
    (void)w;
    dp_batch_run(&decoder, codes + (size_t)row * WIDTH, plane[0] + (size_t)row * WIDTH, WIDTH);
}

static void run_position(const way *w, uint32_t row) {
    const position_row *r = w->method;
    const size_t at = (size_t)row * WIDTH;
    r->run(&position, row, 0, window + at, WIDTH, plane[0] + at, plane[1] + at, plane[2] + at);
}

static void run_normal(const way *w, uint32_t row) {
    const normal_row *r = w->method;
    const size_t at = (size_t)row * WIDTH;
    normal_rows in = {.camera = &camera, .row = row, .count = WIDTH, .slope_x = slope + 8};
    for (int k = -NORMAL_REACH; k <= NORMAL_REACH; k++)
        in.rows[NORMAL_REACH + k] = eye_row((int64_t)row + k);
    r->run(&in, plane[0] + at, plane[1] + at, plane[2] + at);
}

static void whole(const way *w, int on) {
#pragma omp parallel for num_threads(on) schedule(static)
    for (uint32_t row = 0; row < HEIGHT; row++)
        w->run(w, row);
}

/* Rows and the one that they extend. */
static const struct {
    const char *name, *beside;
    aim_id aim;
} extended[] = {
    {"extents-half", "extents", AIM_PLACES_HALF}, {"low-half", "low", AIM_NORMALS_HALF},
    {"medium-half", "medium", AIM_NORMALS_HALF},  {"high-half", "high", AIM_NORMALS_HALF},
    {"projective", "high-1", AIM_NORMALS_EXACT},
};

/* @param floor  of as many planes, by the stores that count
 * @param aim    of the methods */
static void judge(const way *ways, size_t count, size_t i, const double *ns, double floor, aim_id aim) {
    for (size_t k = 0; k < sizeof extended / sizeof extended[0]; k++)
        for (size_t j = 0; j < count; j++)
            if (strcmp(ways[i].name, extended[k].name) == 0 && strcmp(ways[j].name, extended[k].beside) == 0) {
                aim_judge(extended[k].aim, ways[i].name, ns[i] / ns[j]);
                return;
            }
    aim_judge(aim, ways[i].name, ns[i] / floor);
}

/* @param ways  the first is the plain copy
 * @param aim   of the methods; AIM_COUNT: none */
static void table(const char *title, const way *ways, size_t count, aim_id aim) {
    static timing taken[2][WAYS_MAX];
    double ns[2][WAYS_MAX], floor_ns[2][4] = {{0}};
    memset(taken, 0, sizeof taken);
    for (int run = -1; run < RUNS; run++)
        for (size_t i = 0; i < count; i++)
            for (int t = 0; t < 2; t++) {
                double (*const now)(void) = t == 0 ? timing_thread : timing_now;
                const double start = now();
                whole(&ways[i], t == 0 ? 1 : threads);
                if (run >= 0)
                    timing_add(&taken[t][i], (now() - start) * 1e9 / (double)pixels);
            }
    for (size_t i = 0; i < count; i++)
        for (int t = 0; t < 2; t++) {
            ns[t][i] = timing_least(&taken[t][i]);
            if (ways[i].streaming)
                floor_ns[t][ways[i].planes] = ns[t][i];
        }
    printf("\n%-24s %9s %9s %7s %9s %9s   aim\n", title, "1 thread", "/floor", "threads", "ns", "/floor");
    for (size_t i = 0; i < count; i++) {
        const double *floor = floor_ns[0] + ways[i].planes;
        printf("%-24s %9.3f %9.2f %7d %9.3f %9.2f", ways[i].name, ns[0][i], ns[0][i] / *floor, threads, ns[1][i],
               ns[1][i] / floor_ns[1][ways[i].planes]);
        if (ways[i].method != NULL && aim != AIM_COUNT)
            judge(ways, count, i, ns[0], aim == AIM_PLACES ? ns[0][0] : *floor, aim);
        printf("\n");
    }
}

/* ---- Whole frames ------------------------------------------------------------------------------------------------ */

static bool drop(void *context, uint32_t row, uint32_t count, const float *values) {
    (void)context;
    (void)row;
    (void)count;
    (void)values;
    return true;
}

static void frames(void) {
    image picture = {.width = WIDTH, .height = HEIGHT, .channels = 1, .type = IMAGE_F32, .data = window};
    const frame_product products[] = {
        {.kind = FRAME_EYE},
        {.kind = FRAME_POSITION, .position = position_find("view")},
        {.kind = FRAME_NORMAL, .normal = normal_find("high")},
        {.kind = FRAME_NORMAL, .normal = normal_find("projective")},
    };
    static const char *const names[] = {"eye depths", "places, view", "normals, high", "normals, projective"};
    printf("\n%-24s %9s %9s %9s\n", "whole frames, ns a pixel", "1 thread", "all", "speed-up");
    for (size_t i = 0; i < sizeof products / sizeof products[0]; i++) {
        timing taken[2] = {{.count = 0}};
        for (int run = -1; run < RUNS; run++)
            for (int t = 0; t < 2; t++) {
                const frame f = {
                    .camera = &camera, .image = &picture, .sky = FRAME_SKY, .threads = t == 0 ? 1 : threads};
                const double start = timing_now();
                if (!frame_run(&f, &products[i], false, drop, NULL))
                    exit(2);
                if (run >= 0)
                    timing_add(&taken[t], (timing_now() - start) * 1e9 / (double)pixels);
            }
        const double one = timing_least(&taken[0]), all = timing_least(&taken[1]);
        printf("%-24s %9.3f %9.3f %9.2f\n", names[i], one, all, one / all);
    }
}

/* ---- Set-up ------------------------------------------------------------------------------------------------------ */

static void *room(size_t bytes) {
    void *p = aligned_alloc((size_t)1 << 21, (bytes / ((size_t)1 << 21) + 1) << 21);
    if (p == NULL)
        exit(2);
    madvise(p, bytes, MADV_HUGEPAGE);
    memset(p, 0, bytes);
    return p;
}

/* Hills with steps between them. */
static double depth_at(uint32_t x, uint32_t y) {
    const double hill = 20.0 + 5.0 * sin(0.004 * x) + 4.0 * cos(0.006 * y);
    return (x / 97 + y / 61) % 5 == 0 ? 0.5 * hill : hill;
}

static void fill(void) {
    dp_format format[2];
    dp_spec spec = dp_spec_default();
    dp_setup setup, integer;
    camera_spec view = camera_spec_default();
    view.width = WIDTH;
    view.height = HEIGHT;
    spec.mapping = DP_MAPPING_D3D;
    if (dp_setup_init(&setup, &spec) != DP_OK || camera_init(&camera, &setup, &view) != NULL ||
        dp_format_parse("unorm24", format) == 0)
        exit(2);
    spec.format = format[0];
    if (dp_setup_init(&integer, &spec) != DP_OK ||
        dp_batch_init(&decoder, &integer, DP_TASK_EYE, DP_REAL_FLOAT, DP_WORD_32, dp_path_best()) != DP_OK)
        exit(2);
    position_prepare(&position, &camera);
    window = room(pixels * sizeof *window);
    codes = room(pixels * sizeof *codes);
    eyes = room((size_t)STRIDE * HEIGHT * sizeof *eyes);
    slope = room(STRIDE * sizeof *slope);
    for (int k = 0; k < 3; k++)
        plane[k] = room(pixels * sizeof *plane[k] + 4096);
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            const double z = depth_at(x, y);
            const double d = dp_window(&setup, z);
            window[(size_t)y * WIDTH + x] = (float)d;
            codes[(size_t)y * WIDTH + x] = (uint32_t)(d * 16777215.0 + 0.5);
            eyes[(size_t)y * STRIDE + 8 + x] = (float)z;
        }
    for (int i = 0; i < STRIDE; i++)
        slope[i] = (float)camera_slope_x(&camera, i - 8);
}

int main(void) {
    way ways[WAYS_MAX];
    size_t count = 0;
    threads = omp_get_max_threads();
    fill();
    printf("\n%d x %d pixels in memory, ns a pixel; the floor streams the same bytes\n", WIDTH, HEIGHT);
    ways[count++] = (way){"plain copy", run_copy, 1, 0, NULL};
    ways[count++] = (way){"streaming copy", run_stream, 1, 1, NULL};
    ways[count++] = (way){"batch, unorm24", run_batch, 1, 0, NULL};
    for (size_t i = 0; decode_get(i) != NULL; i++)
        if (decode_get(i)->quantity == DECODE_EYE && decode_applies(decode_get(i), &camera.setup))
            ways[count++] = (way){decode_get(i)->name, run_decode, 1, 0, decode_get(i)};
    table("eye depths", ways, count, AIM_COUNT);
    count = 0;
    ways[count++] = (way){"plain copy to 3 planes", run_copy, 3, 0, NULL};
    ways[count++] = (way){"streaming copy", run_stream, 3, 1, NULL};
    for (size_t i = 0; position_get(i) != NULL; i++)
        if (position_applies(position_get(i), &camera))
            ways[count++] = (way){position_get(i)->name, run_position, 3, 0, position_get(i)};
    table("places", ways, count, AIM_PLACES);
    count = 2;
    for (size_t i = 0; normal_get(i) != NULL; i++)
        ways[count++] = (way){normal_get(i)->name, run_normal, 3, 0, normal_get(i)};
    table("normals", ways, count, AIM_NORMALS);
    frames();
    return 0;
}
