/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/sensor_surface.h"

#include <math.h>

#include "texture/image_depths.h"
#include "texture/sensor_sample.h"

enum {
    RUN = 5, /* neighbours that tell a surface from a lattice */
    RUNS_LEAST = 16
};

/*
 * Depths that were never rounded may be even, too: of a level plane 1/z is, from row to row. But what was rounded
 * jumps, and so its fourth differences are not 0, where those of a smooth surface are.
 */
static void run_of(const image *img, const sensor *s, size_t pixel, size_t step, size_t counts[2]) {
    double k[RUN];
    bool flat = true;
    for (size_t i = 0; i < RUN; i++) {
        const double x = image_sample(img, pixel + i * step);
        if (!sensor_is_depth(x))
            return;
        k[i] = rint(sensor_level(s, x));
        flat = flat && k[i] == k[0];
    }
    if (!flat)
        counts[k[0] - 4 * k[1] + 6 * k[2] - 4 * k[3] + k[4] == 0]++;
}

bool sensor_is_surface(const image *img, const sensor *s, double scale) {
    const size_t all = (size_t)img->width * img->height, stride = sensor_stride(img);
    sensor in_samples = *s;
    size_t counts[2] = {0, 0};
    sensor_scale(&in_samples, 1 / scale);
    for (size_t i = 0; i < all && s->row->levels != GRAIN_HALF; i += stride) {
        if (i % img->width + RUN <= img->width)
            run_of(img, &in_samples, i, 1, counts);
        if (i / img->width + RUN <= img->height)
            run_of(img, &in_samples, i, img->width, counts);
    }
    return counts[1] >= RUNS_LEAST && counts[1] >= counts[0];
}

/*
 * Pictures of several lattices that were put together lie on a finer one. But most neighbours are of the same picture,
 * and so the same number of its levels, or a multiple of that, lies between them.
 */
bool sensor_is_put_together(const image *img, const sensor_file *file, const sensor *s) {
    enum { MOST = 8 };
    const size_t all = (size_t)img->width * img->height, stride = sensor_stride(img);
    size_t apart = 0, multiples[MOST + 1] = {0};
    for (size_t i = 0; i + 1 < all && s->row->levels != GRAIN_HALF; i += stride) {
        const double x = image_sample(img, i), next = image_sample(img, i + 1);
        if (!sensor_tells(s, file, x) || !sensor_tells(s, file, next))
            continue;
        const double between = rint(sensor_level(s, x * file->scale)) - rint(sensor_level(s, next * file->scale));
        apart += between != 0;
        for (int q = 2; q <= MOST; q++)
            multiples[q] += between != 0 && fmod(between, q) == 0;
    }
    for (int q = 2; q <= MOST; q++)
        if (apart >= RUNS_LEAST && (double)multiples[q] >= SENSOR_SHARE * (double)apart)
            return true;
    return false;
}
