/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/stereo.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/recognise_lattice.h"
#include "texture/image_depths.h"
#include "texture/metric.h"

enum { BITS_LEAST = 8, BITS_MOST = 31, DIGITS = 53, SPARE = 2, VALUES_LEAST = 16 };

static const double FAR_MOST = 1e18; /* of a camera; farther away is infinity */

static bool is_sample(double x) {
    return x != 0 && isfinite(x);
}

/* The largest power of two that all samples are multiples of; 0 where a number makes use of all its digits. */
static double find_step(const image *img) {
    static const int digits_of[] = {[IMAGE_F16] = 11, [IMAGE_F32] = 24, [IMAGE_F64] = 53};
    int lowest = INT_MAX, highest = INT_MIN;
    for (size_t i = 0; i < (size_t)img->width * img->height; i++) {
        int exponent;
        const double x = image_sample(img, i);
        if (!is_sample(x))
            continue;
        const uint64_t digits = (uint64_t)ldexp(fabs(frexp(x, &exponent)), DIGITS);
        const int low = exponent - DIGITS + __builtin_ctzll(digits);
        if (img->type >= IMAGE_F16 && low < 0 && low < exponent - digits_of[img->type] + SPARE)
            return 0;
        lowest = low < lowest ? low : lowest;
        highest = exponent > highest ? exponent : highest;
    }
    return highest - lowest < BITS_MOST ? ldexp(1, lowest) : 0;
}

/* The same, by the common divisor of enough values, which need not be a power of two. */
static double find_divisor(const image *img, double step) {
    const size_t count = (size_t)img->width * img->height;
    uint32_t divisor = 0;
    dp_distinct seen;
    dp_distinct_init(&seen, malloc(DP_RECOGNISE_SLOTS * sizeof(uint64_t)), count);
    for (size_t i = 0; i < count; i++) {
        const double x = image_sample(img, i);
        if (!is_sample(x))
            continue;
        divisor = (uint32_t)dp_common_divisor(divisor, (uint32_t)(fabs(x) / step));
        if (seen.count < VALUES_LEAST)
            dp_distinct_add(&seen, x);
    }
    const bool enough = seen.count >= VALUES_LEAST;
    free(seen.slots);
    return enough ? step * divisor : step;
}

/* How samples become codes, and codes disparities: end + |step| code. */
typedef struct coding {
    double unit;        /* of the samples: of 1 in a code; 0: numbers */
    double sign;        /* -1: larger samples are farther */
    double from;        /* units: the sample of code 0 */
    double step;        /* pixels of 1 in a code, or in a number */
    double end;         /* pixels: the disparity of code 0, at least 0 */
    double least, most; /* codes */
    size_t depths;
} coding;

static double code_of(const coding *c, double x) {
    if (!is_sample(x))
        return 0;
    return c->unit > 0 ? c->sign * (x / c->unit - c->from) : c->sign * x;
}

static bool is_code(const coding *c, double code) {
    return c->unit > 0 ? code >= 1 : code > 0;
}

/* The last sample on the way to infinity whose disparity is not below 0; 0 where all the way there belongs to it. */
static double last_sample(const stereo_spec *given, double step) {
    double last = -given->offset / step;
    last = step > 0 ? ceil(last) : floor(last);
    while (given->offset + step * last < 0)
        last += step > 0 ? 1 : -1;
    return step > 0 && given->offset >= 0 ? 0 : last;
}

static coding coding_of(const image *img, const stereo_spec *given) {
    const double coarse = find_step(img), unit = coarse > 0 ? find_divisor(img, coarse) : 0;
    const double step = given->step * (unit > 0 ? unit : 1);
    coding c = {
        .unit = unit, .sign = step < 0 ? -1 : 1, .step = fabs(step), .end = given->offset, .least = (double)INFINITY};
    if (unit > 0) {
        c.from = last_sample(given, step);
        c.end = given->offset + step * c.from;
    }
    for (size_t i = 0; i < (size_t)img->width * img->height; i++) {
        const double code = code_of(&c, image_sample(img, i));
        c.depths += is_code(&c, code);
        c.least = is_code(&c, code) ? fmin(c.least, code) : c.least;
        c.most = fmax(c.most, code);
    }
    return c;
}

static void describe(const image *img, const stereo_spec *given, const coding *c, metric *out) {
    const double constant = given->focal * given->baseline;
    const double none = (double)NAN;
    const grain_levels levels = c->unit > 0 ? GRAIN_INVERSE : GRAIN_FINE;
    int bits = BITS_LEAST, exponent;
    char name[24];
    dp_format formats[2];
    while (bits < BITS_MOST && ldexp(1, bits) - 1 < 2 * c->most + 2)
        bits++; /* twice as many: a step more is none too many */
    frexp(c->most, &exponent);
    snprintf(name, sizeof name, "unorm%d", bits);
    dp_format_parse(c->unit > 0 ? name : "fp32", formats);
    const double all = c->unit > 0 ? ldexp(1, bits) - 1 : ldexp(1, exponent);
    out->format = formats[0];
    out->mapping = DP_MAPPING_REVERSED;
    out->znear = constant / (c->end + c->step * all);
    out->zfar = constant / c->end < FAR_MOST ? constant / c->end : (double)INFINITY;
    out->sample_from = c->from * c->unit;
    out->sample_per = c->sign * c->unit;
    out->depths = (double)c->depths;
    out->step = c->unit > 0 ? c->step : 0;
    out->sensor = (sensor){.given = c->unit > 0,
                           .step = c->unit > 0 ? c->step / constant : none,
                           .offset = c->end / constant,
                           .step_off = 0,
                           .offset_off = 0,
                           .levels = c->unit > 0 ? c->most - c->least + 1 : none,
                           .bits = none,
                           .off_pixels = 0,
                           .residual = none,
                           .file_step = none};
    for (size_t i = 0; sensor_get(i) != NULL; i++)
        if (sensor_get(i)->levels == levels)
            out->sensor.row = sensor_get(i);
    out->sensor.offset = fmod(out->sensor.offset, out->sensor.step);
    out->seen = out->sensor;
    if (c->unit > 0)
        out->grain = (grain){.kind = GRAIN_STEPS, .steps = all, .mirrored = c->sign < 0};
    else
        out->grain = (grain){.kind = GRAIN_FLOATS,
                             .bits = img->type == IMAGE_F16 ? 11 : 24,
                             .rounding = img->type == IMAGE_F64 ? GRAIN_NEAREST : GRAIN_ANY,
                             .least = img->type == IMAGE_F16 ? ldexp(1, -24 - exponent) : 0x1p-149};
}

static bool replace(image *img, const coding *c) {
    const size_t count = (size_t)img->width * img->height;
    uint32_t *made = malloc(count * sizeof *made);
    int exponent;
    frexp(c->most, &exponent);
    for (size_t i = 0; i < count && made != NULL; i++) {
        const double code = code_of(c, image_sample(img, i));
        if (c->unit > 0)
            made[i] = is_code(c, code) ? (uint32_t)code : UINT32_MAX;
        else
            ((float *)(void *)made)[i] = is_code(c, code) ? (float)ldexp(code, -exponent) : (float)NAN;
    }
    if (made == NULL)
        return false;
    free(img->data);
    img->data = made;
    img->type = c->unit > 0 ? IMAGE_U32 : IMAGE_F32;
    img->channels = 1;
    return true;
}

const char *stereo_convert(image *img, const stereo_spec *given, metric *out) {
    *out = (metric){.top = metric_clear_top(img)};
    const coding c = coding_of(img, given);
    if (c.depths == 0)
        return "no sample has a disparity of a step or more: all are 0 or not finite, or the offset and the sign of "
               "the "
               "step are others";
    if (c.unit == 0 && given->offset < 0)
        return "an offset below 0 is for samples that are multiples of a step, and these are not";
    if (c.most > ldexp(1, BITS_MOST - 2))
        return "its disparities are too many steps";
    describe(img, given, &c, out);
    return replace(img, &c) ? NULL : "no memory";
}
