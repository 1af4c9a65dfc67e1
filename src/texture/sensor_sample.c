/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/sensor_sample.h"

#include <math.h>
#include <stdlib.h>

#include "texture/image_depths.h"

enum {
    LOOKED_AT = 1 << 19, /* pixels that lattices are looked for in; on the one that is found all are counted */
    DIGITS_MOST = 40     /* of a number: the fit itself is made of doubles */
};

static const double RARE = 0.1, RARER = 0.125;

static sensor_interval stored_of(const sensor_file *file, double x) {
    int exponent;
    const double z = x * file->scale;
    if (file->step > 0)
        return (sensor_interval){z - 0.5 * file->step, z + file->step};
    frexp(z, &exponent);
    const double unit = ldexp(1, exponent - (file->digits < DIGITS_MOST ? file->digits : DIGITS_MOST));
    /* a product, a sum and a quotient in numbers of so many bits; of binary16 itself it was only stored */
    return file->digits == 11 ? (sensor_interval){z - 0.5 * unit, z + unit}
                              : (sensor_interval){z - 3 * unit, z + 3 * unit};
}

sensor_interval sensor_interval_of(const sensor_file *file, double x) {
    const sensor_interval z = stored_of(file, x);
    return (sensor_interval){z.lo - 0.5 * file->again, z.hi + file->again};
}

fit_value sensor_value_of(grain_levels levels, sensor_interval z) {
    if (levels == GRAIN_INVERSE)
        z = (sensor_interval){1 / z.hi, 1 / z.lo};
    return (fit_value){0.5 * (z.lo + z.hi), 0.5 * (z.hi - z.lo), 1};
}

bool sensor_is_depth(double x) {
    return x > 0 && isfinite(x);
}

int sensor_compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

static size_t keep(sensor_depths *d, size_t to, size_t i) {
    d->samples[to] = d->samples[i];
    d->pixels[to] = d->pixels[i];
    return to + 1;
}

/* Averages of neighbours lie between levels, and few pixels have them: the rarest values say nothing, as long as no
 * more than a tenth of the pixels has them, nor do those that are much rarer than the values on both sides. */
static void drop_rare(sensor_depths *d, size_t pixels) {
    enum { MOST = 256 };
    double with[MOST] = {0}, dropped = 0, before = 0;
    size_t count = 0, rare = 1;
    for (size_t i = 0; i < d->count; i++)
        if (d->pixels[i] < MOST)
            with[(size_t)d->pixels[i]] += d->pixels[i];
    while (rare < MOST && dropped + with[rare] <= RARE * (double)pixels)
        dropped += with[rare++];
    for (size_t i = 0; i < d->count; i++)
        if (d->pixels[i] >= (double)rare)
            count = keep(d, count, i);
    d->count = count;
    count = 0;
    for (size_t i = 0; i < d->count; i++) {
        const double own = d->pixels[i], after = i + 1 < d->count ? d->pixels[i + 1] : 0;
        if (own >= RARER * fmin(before, after))
            count = keep(d, count, i);
        before = own;
    }
    d->count = count;
}

size_t sensor_stride(const image *img) {
    return (1 + ((size_t)img->width * img->height - 1) / LOOKED_AT) | 1U;
}

bool sensor_gather(const image *img, sensor_depths *d) {
    const size_t all = (size_t)img->width * img->height;
    const size_t stride = sensor_stride(img), some = (all - 1) / stride + 1;
    *d = (sensor_depths){malloc(some * sizeof(double)), malloc(some * sizeof(double)), 0};
    if (d->samples == NULL || d->pixels == NULL)
        return false;
    size_t count = 0;
    for (size_t i = 0; i < all; i += stride)
        if (sensor_is_depth(image_sample(img, i)))
            d->samples[count++] = image_sample(img, i);
    qsort(d->samples, count, sizeof *d->samples, sensor_compare);
    for (size_t i = 0; i < count; i++) {
        if (d->count == 0 || d->samples[d->count - 1] != d->samples[i]) {
            d->samples[d->count] = d->samples[i];
            d->pixels[d->count++] = 0;
        }
        d->pixels[d->count - 1]++;
    }
    drop_rare(d, count);
    return true;
}

void sensor_depths_free(sensor_depths *d) {
    free(d->samples);
    free(d->pixels);
}

bool sensor_holds_half(sensor_interval z) {
    const double gap = sensor_half_gap(z.hi);
    return floor(z.hi / gap) * gap >= z.lo;
}

bool sensor_holds(const sensor *s, const sensor_file *file, double x) {
    const sensor_interval z = sensor_interval_of(file, x);
    if (s->row->levels == GRAIN_HALF)
        return sensor_holds_half(z);
    const fit f = {.step = s->step, .offset = s->offset};
    const fit_value v = sensor_value_of(s->row->levels, z);
    return fit_holds(&f, &v);
}

bool sensor_tells(const sensor *s, const sensor_file *file, double x) {
    return sensor_is_depth(x) && sensor_holds(s, file, x) &&
           sensor_value_of(s->row->levels, sensor_interval_of(file, x)).off < 0.5 * s->step;
}
