/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/pyramid.h"

#include <math.h>
#include <stdlib.h>

#include "core/engine.h"
#include "texture/image_depths.h"

uint32_t pyramid_levels(uint32_t width, uint32_t height) {
    uint32_t levels = 0;
    for (uint32_t side = width > height ? width : height; side > 1; side /= 2)
        levels++;
    return levels;
}

static uint32_t half(uint32_t side) {
    return side > 1 ? side / 2 : 1;
}

/* Texels below one, from 2i on. */
static uint32_t taps(uint32_t side) {
    return side == 1 ? 1 : side % 2 == 1 ? 3 : 2;
}

/* A level of window depths; its data belong to it. */
typedef struct level {
    uint32_t width, height;
    double *depths;
} level;

/* Window depths as the image stores them, not as codes, which may be coarser. */
static bool bottom_of(const frame *f, pyramid *p, level *out) {
    const dp_setup *setup = &f->camera->setup;
    const dp_format *format = &setup->spec.format;
    const double end = setup->reversed == p->nearest ? 1 : 0;
    *out = (level){f->camera->width, f->camera->height, NULL};
    const size_t width = out->width, count = width * out->height;
    uint32_t *codes = malloc(width * sizeof *codes);
    out->depths = malloc(count * sizeof *out->depths);
    const bool good = codes != NULL && out->depths != NULL;
    for (uint32_t row = 0; row < out->height && good; row++) {
        double *d = out->depths + row * width;
        if (f->image != NULL)
            image_depths(f->image, format, row, 0, out->width, d);
        else
            frame_codes(f, row, codes);
        for (size_t x = 0; x < width; x++) {
            if (f->image == NULL)
                d[x] = dp_format_value(format, codes[x]);
            p->holes += isnan(d[x]) ? 1 : 0;
            d[x] = isnan(d[x]) ? end : d[x];
        }
    }
    free(codes);
    return good;
}

static bool reduce(const level *from, bool largest, level *to) {
    *to = (level){half(from->width), half(from->height), NULL};
    to->depths = malloc((size_t)to->width * to->height * sizeof *to->depths);
    const uint32_t across = taps(from->width), down = taps(from->height);
    for (size_t i = 0; i < (size_t)to->width * to->height && to->depths != NULL; i++) {
        const size_t x = 2 * (i % to->width), y = 2 * (i / to->width);
        double most = from->depths[y * from->width + x];
        for (uint32_t k = 0; k < across * down; k++) {
            const double d = from->depths[(y + k / across) * from->width + x + k % across];
            most = largest ? fmax(most, d) : fmin(most, d);
        }
        to->depths[i] = most;
    }
    return to->depths != NULL;
}

/* The code whose depth is not below d, or not above it. */
static uint32_t outward(const dp_format *format, double d, bool up) {
    const uint32_t code = dp_format_encode(format, DP_ROUND_NEAREST, d);
    const double value = dp_format_value(format, code);
    return up ? code + (value < d) : code - (value > d);
}

static void round_to(const frame *f, const level *top, bool up, pyramid *p) {
    const dp_setup *setup = &f->camera->setup;
    const dp_format *own = &setup->spec.format;
    for (size_t i = 0; i < (size_t)top->width * top->height; i++) {
        const double d = top->depths[i];
        p->codes[i] = outward(&p->format, d, up);
        const double value = dp_format_value(&p->format, p->codes[i]);
        if (value == d)
            continue;
        const uint32_t before = dp_format_encode(own, DP_ROUND_NEAREST, d);
        const uint32_t after = dp_format_encode(own, DP_ROUND_NEAREST, value);
        const dp_point from = dp_point_make(d, 1), to = dp_point_make(value, 1);
        const double off = p->nearest ? dp_curve_span(setup, to, from) : dp_curve_span(setup, from, to);
        const uint64_t steps = before < after ? after - before : before - after;
        p->codes_off = steps > p->codes_off ? steps : p->codes_off;
        if (off > p->off) {
            p->off = off;
            p->off_z = dp_curve_eye(setup, from);
        }
    }
}

bool pyramid_make(const frame *f, pyramid *p) {
    const bool largest = f->camera->setup.reversed == p->nearest;
    level at;
    *p = (pyramid){.level = p->level,
                   .nearest = p->nearest,
                   .format = p->format,
                   .levels = pyramid_levels(f->camera->width, f->camera->height),
                   .off_z = NAN};
    bool good = bottom_of(f, p, &at);
    for (uint32_t i = 0; i < p->level && good; i++) {
        level next;
        good = reduce(&at, largest, &next);
        free(at.depths);
        at = next;
    }
    p->width = at.width;
    p->height = at.height;
    p->codes = good ? malloc((size_t)at.width * at.height * sizeof *p->codes) : NULL;
    if (p->codes != NULL)
        round_to(f, &at, largest, p);
    free(at.depths);
    return p->codes != NULL;
}
