/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Triangles as rasterizers draw them, set-up and coverage included, beside a loop that fills the same pixels with one
 * depth. All take turns within one run; the least counts.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "aims.h"
#include "core/clones.h"
#include "raster/raster.h"
#include "timing.h"

enum { SIZE = 512, TRIANGLES = 400, RUNS = 31 };

static float image[SIZE][SIZE] __attribute__((aligned(4096)));
static raster_vertex triangles[TRIANGLES][3];

/* The spans of all triangles, for the loop that fills them. */
static struct span { int y, from, to; } spans[TRIANGLES * SIZE];
static size_t span_count;

static double unit(uint64_t *state) {
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    return (double)(*state >> 11) * 0x1p-53;
}

/* Equilateral triangles of `pixels` pixels, turned at random, all on the target; slanted in depth. */
static void make(double pixels) {
    const double radius = sqrt(pixels * 4 / (3 * sqrt(3.0)));
    uint64_t state = 1;
    for (int i = 0; i < TRIANGLES; i++) {
        const double room = SIZE - 2 * radius;
        const double x = radius + room * unit(&state), y = radius + room * unit(&state), turn = unit(&state) * 6.28;
        for (int k = 0; k < 3; k++) {
            const double w = 1 + unit(&state);
            triangles[i][k] = (raster_vertex){(float)(w * ((x + radius * cos(turn + k * 2.0944)) / (SIZE / 2) - 1)),
                                              (float)(w * ((y + radius * sin(turn + k * 2.0944)) / (SIZE / 2) - 1)),
                                              (float)(w * unit(&state)), (float)w};
        }
    }
}

/* Draws all, or notes their spans; returns the number of pixels. */
static double draw(const raster_target *target, bool note) {
    long pixels = 0;
    span_count = note ? 0 : span_count;
    for (int i = 0; i < TRIANGLES; i++) {
        raster_triangle drawn;
        int from, to;
        if (raster_set_up(target, triangles[i], &drawn) != RASTER_OK)
            continue;
        const raster_piece *piece = &drawn.piece[0];
        for (int y = piece->y0; y < piece->y1; y++) {
            if (!raster_span(target, piece, y, &from, &to))
                continue;
            pixels += to - from;
            if (note)
                spans[span_count++] = (struct span){y, from, to};
            else
                raster_depths(target, piece, y, from, to, &image[y][from]);
        }
    }
    return (double)pixels;
}

CLONES static void fill(float depth) {
    for (size_t i = 0; i < span_count; i++) {
        float *row = image[spans[i].y];
        for (int x = spans[i].from; x < spans[i].to; x++)
            row[x] = depth;
    }
}

/* Seconds per run of the loop and of the target on its path and on the baseline. */
static void measure(const raster_target way[2], double seconds[3]) {
    timing taken[3] = {{.count = 0}};
    for (int run = -2; run < RUNS; run++)
        for (int w = 0; w < 3; w++) {
            const double start = timing_cpu();
            if (w == 0)
                fill((float)run);
            else
                draw(&way[w - 1], false);
            if (run >= 0)
                timing_add(&taken[w], timing_cpu() - start);
        }
    for (int w = 0; w < 3; w++)
        seconds[w] = timing_least(&taken[w]);
}

static void row(size_t index, double pixels, const dp_format *format) {
    const bool small = pixels < 1000;
    raster_target way[2];
    double seconds[3];
    char what[64];
    for (int w = 0; w < 2; w++)
        if (raster_target_init(&way[w], index, SIZE, SIZE, format, w == 0 ? dp_path_best() : DP_PATH_BASELINE) !=
            RASTER_OK)
            exit(2);
    make(pixels);
    const double drawn = draw(&way[0], true);
    measure(way, seconds);
    const double million = TRIANGLES / seconds[1] * 1e-6;
    printf("%-12s %8.0f %9.0f %9.0f %9.0f %7.2f %9.2f", way[0].row->name, drawn / TRIANGLES, drawn / seconds[0] * 1e-6,
           drawn / seconds[1] * 1e-6, drawn / seconds[2] * 1e-6, seconds[0] / seconds[1], million);
    snprintf(what, sizeof what, "%s %.0f", way[0].row->name, drawn / TRIANGLES);
    if (small)
        aim_judge(AIM_SMALL_TRIANGLES, what, million);
    else {
        aim_judge(AIM_TRIANGLES, what, seconds[0] / seconds[1]);
        aim_judge(AIM_TRIANGLES_BASELINE, what, drawn / seconds[2] * 1e-6);
    }
    printf("\n");
}

int main(void) {
    static const double sizes[] = {20, 1500, 20000};
    dp_format format[2];
    if (dp_format_parse("fp32", format) == 0)
        return 2;
    printf("\n%-12s %8s %9s %9s %9s %7s %9s\n", "triangles", "pixels", "L, M px/s", dp_path_name(dp_path_best()),
           "baseline", "of L", "M tri/s");
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++)
        for (size_t i = 0; i < raster_table.count; i++)
            if (raster_get(i)->model != NULL)
                row(i, sizes[s], format);
    return 0;
}
