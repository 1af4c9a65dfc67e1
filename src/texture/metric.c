/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/metric.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/recognise_lattice.h"
#include "texture/device.h"
#include "texture/image_depths.h"
#include "texture/sensor_find.h"

enum { BITS_MAX = 31, VALUES_LEAST = 16, TOP = 65535, FAR = 30000 /* of sensors, in millimetres */, BEYOND = 100 };

static bool is_depth(double x) {
    return x > 0 && isfinite(x);
}

/* Properties of the samples, found before anything is changed. */
typedef struct look {
    double least, most;
    uint32_t divisor;      /* integers: of all */
    size_t depths, single; /* single: are binary32 */
    dp_distinct seen;
} look;

/* Where nothing was seen some sensors write 65535 and some programs 1e10 or the like: the largest sample is that where
 * all others end long before. @return NaN where it is not */
double metric_find_top(const image *img) {
    const size_t count = (size_t)img->width * img->height;
    double most = 0, next = 0;
    for (size_t i = 0; i < count; i++) {
        const double x = image_sample(img, i);
        if (x <= next || !is_depth(x) || x == most)
            continue;
        next = fmax(next, fmin(x, most));
        most = fmax(most, x);
    }
    const bool top =
        img->type == IMAGE_U16 ? most == TOP && next <= FAR : img->type != IMAGE_U8 && most > BEYOND * next;
    return top && next > 0 ? most : (double)NAN;
}

static void clear_between(image *img, double lo, double hi) {
    const size_t size = image_type_size(img->type), count = (size_t)img->width * img->height;
    for (size_t i = 0; i < count; i++)
        if (image_sample(img, i) >= lo && image_sample(img, i) <= hi)
            memset((char *)img->data + i * img->channels * size, 0, size);
}

double metric_clear_top(image *img) {
    const double top = metric_find_top(img);
    if (!isnan(top))
        clear_between(img, top, top);
    return top;
}

static void look_at(const image *img, look *l) {
    const size_t count = (size_t)img->width * img->height;
    *l = (look){.least = (double)INFINITY};
    dp_distinct_init(&l->seen, malloc(DP_RECOGNISE_SLOTS * sizeof(uint64_t)), count);
    for (size_t i = 0; i < count; i++) {
        const double x = image_sample(img, i);
        if (!is_depth(x))
            continue;
        l->depths++;
        l->least = fmin(l->least, x);
        l->most = fmax(l->most, x);
        l->single += (double)(float)x == x;
        if (img->type < IMAGE_F16)
            l->divisor = (uint32_t)dp_common_divisor(l->divisor, (uint32_t)x);
    }
}

static void look_through(const image *img, const sensor_file *file, const sensor *given, const look *l, metric *out) {
    sensor_find(img, file, &out->seen);
    out->seen.like = device_like(out->seen.row->levels, out->seen.step);
    out->depths = (double)l->depths;
    out->sensor = out->seen;
    if (given != NULL) {
        out->sensor = *given;
        const double ends[2] = {l->least * file->scale, l->most * file->scale};
        sensor_complete(img, file, ends, &out->seen, &out->sensor);
    }
}

/* ---- Integers ---------------------------------------------------------------------------------------------------- */

static void add_all(const image *img, look *l, double scale) {
    for (size_t i = 0; i < (size_t)img->width * img->height && l->seen.count < DP_RECOGNISE_DISTINCT; i++)
        if (is_depth(image_sample(img, i)))
            dp_distinct_add(&l->seen, image_sample(img, i) * scale);
}

/* How many bits hold the largest sample. */
static int bits_for(double most, int bits) {
    while (bits <= BITS_MAX && ldexp(1, bits) - 1 < most)
        bits++;
    return bits;
}

static const char *of_integers(const image *img, double scale, look *l, const sensor *given, metric *out) {
    static const int bits_of[] = {[IMAGE_U8] = 8, [IMAGE_U16] = 16, [IMAGE_U32] = 16};
    int bits = bits_for(l->most, bits_of[img->type]);
    if (bits > BITS_MAX)
        return "an integer is larger than 2147483647";
    add_all(img, l, 1);
    /* A few values have a divisor by chance. */
    const double divisor = l->seen.count >= VALUES_LEAST ? l->divisor : 1;
    const sensor_file file = {.step = divisor * scale, .unit = scale, .scale = scale};
    look_through(img, &file, given, l, out);
    const double end = sensor_end(&out->sensor, (l->most + divisor) * scale + out->sensor.again) / scale;
    bits = bits_for(fmin(end, ldexp(1, BITS_MAX) - 1), bits);
    const double top = ldexp(1, bits) - 1;
    dp_format formats[2];
    char name[24];
    snprintf(name, sizeof name, "unorm%d", bits);
    dp_format_parse(name, formats);
    out->format = formats[0];
    out->znear = 0.5 * l->least * scale;
    out->zfar = top * scale;
    out->step = divisor * scale;
    out->grain = (grain){.kind = GRAIN_STEPS, .steps = top * scale / out->sensor.file_step};
    return NULL;
}

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

/* Numbers that were integers once: millimetres in metres and the like. */
static double find_step(const image *img, look *l, int exponent) {
    static const double steps[] = {1, 0.1, 0.01, 0.001, 0.0002, 0.0001, 0.00390625};
    static const int bits[] = {[IMAGE_F16] = 11, [IMAGE_F32] = 24, [IMAGE_F64] = 53};
    const dp_grid_source source = {.bits = bits[img->type], .finest = (double)INFINITY};
    add_all(img, l, ldexp(1, -exponent - 1)); /* below 1, which says nothing on a grid */
    if (l->seen.count >= DP_RECOGNISE_DISTINCT || l->seen.count < VALUES_LEAST)
        return 0;
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++)
        if (dp_grid_agreement(&l->seen, &source, ldexp(1, exponent + 1) / steps[i]) >= DP_RECOGNISE_BITS)
            return steps[i];
    return 0;
}

double metric_step(const image *img) {
    look l;
    int exponent;
    look_at(img, &l);
    frexp(l.most, &exponent);
    const double step = l.depths > 0 ? find_step(img, &l, exponent) : 0;
    free(l.seen.slots);
    return step;
}

static const char *of_numbers(const image *img, double scale, look *l, const sensor *given, metric *out) {
    const int own = img->type == IMAGE_F16 ? 11 : 24;
    int exponent;
    dp_format formats[2];
    if (frexp(l->most, &exponent) == 0.5)
        exponent--; /* the least power of two that is not below */
    if (!(ldexp(scale, exponent) >= 1e-9 && ldexp(scale, exponent) <= 1e18))
        return "its depths leave the possible range, 1e-9 to 1e18 scene units";
    dp_format_parse("fp32", formats);
    const double step = find_step(img, l, exponent);
    const bool single = (double)l->single >= SENSOR_SHARE * (double)l->depths;
    const sensor_file file = {.step = step * scale, .digits = single ? own : 53, .scale = scale};
    look_through(img, &file, given, l, out);
    const double end = sensor_end(&out->sensor, (l->most * (1 + 0x1p-10) + step) * scale + out->sensor.again);
    while (out->sensor.row->levels != GRAIN_FINE && ldexp(scale, exponent) < fmin(end, 5e17))
        exponent++;
    const bool alone = step == 0 && out->sensor.row->levels == GRAIN_FINE;
    out->format = formats[0];
    out->znear = fmax(0.5 * l->least * scale, 1e-12);
    out->zfar = ldexp(scale, exponent);
    out->step = step * scale;
    const double rounded = out->sensor.file_step / scale;
    out->grain = (grain){.kind = rounded > 0 ? GRAIN_STEPS : GRAIN_FLOATS,
                         .steps = rounded > 0 ? ldexp(1, exponent) / rounded : 0,
                         .rounding = img->type == IMAGE_F64 && alone ? GRAIN_NEAREST : GRAIN_ANY,
                         .bits = own,
                         .least = img->type == IMAGE_F16 ? ldexp(1, -24 - exponent) : 0x1p-149};
    return NULL;
}

/* ---- Together ---------------------------------------------------------------------------------------------------- */

static bool replace(image *img, const metric *m, double scale) {
    const size_t count = (size_t)img->width * img->height;
    const bool integers = img->type < IMAGE_F16;
    uint32_t *made = malloc(count * sizeof *made);
    for (size_t i = 0; i < count && made != NULL; i++) {
        const double x = image_sample(img, i);
        if (integers)
            made[i] = is_depth(x) ? (uint32_t)x : UINT32_MAX;
        else
            ((float *)(void *)made)[i] = is_depth(x) ? (float)(x * scale / m->zfar) : (float)NAN;
    }
    if (made == NULL)
        return false;
    free(img->data);
    img->data = made;
    img->type = integers ? IMAGE_U32 : IMAGE_F32;
    img->channels = 1;
    return true;
}

const char *metric_convert(image *img, double scale, double zfar, const sensor *given, metric *out) {
    const double end = zfar / scale, off = img->type == IMAGE_F16 ? 0x1p-10 : 0x1p-20;
    look l;
    clear_between(img, end * (1 - off), end * (1 + off));
    *out = (metric){.mapping = DP_MAPPING_LINEAR, .top = metric_clear_top(img)};
    look_at(img, &l);
    const char *wrong = l.depths == 0           ? "no sample is a depth: all are 0, below 0 or not finite"
                        : img->type < IMAGE_F16 ? of_integers(img, scale, &l, given, out)
                                                : of_numbers(img, scale, &l, given, out);
    free(l.seen.slots);
    if (wrong == NULL)
        sensor_into(&out->sensor, out->zfar, &out->grain);
    if (wrong == NULL && !replace(img, out, scale))
        wrong = "no memory";
    return wrong;
}
