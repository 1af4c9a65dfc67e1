/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/compose.h"

#include <math.h>

enum { COLOURS = 3 };

static double most(const image *p) {
    return p->type == IMAGE_U8 ? UINT8_MAX : UINT16_MAX;
}

static double stored(const image *p, uint32_t x, uint32_t y, uint32_t k) {
    const size_t at = ((size_t)y * p->width + x) * p->channels + k;
    return p->type == IMAGE_U8 ? ((const uint8_t *)p->data)[at] : ((const uint16_t *)p->data)[at];
}

/* Middles of pixels are whole numbers. */
static double seen(const image *p, double x, double y, uint32_t k) {
    x = fmin(fmax(x, 0), p->width - 1.0);
    y = fmin(fmax(y, 0), p->height - 1.0);
    const uint32_t x0 = (uint32_t)x, y0 = (uint32_t)y, x1 = x0 + (x > x0), y1 = y0 + (y > y0);
    const double right = x - x0, down = y - y0;
    const double above = (1 - right) * stored(p, x0, y0, k) + right * stored(p, x1, y0, k);
    const double below = (1 - right) * stored(p, x0, y1, k) + right * stored(p, x1, y1, k);
    return ((1 - down) * above + down * below) / most(p);
}

static double setting(const compose *c, const char *name) {
    return c->parameters[parameter_find(c->row->parameters, name)];
}

/* The mean of nine pixels. */
static double blurred(const compose *c, uint32_t x, uint32_t y, uint32_t k) {
    const double step = setting(c, "blur");
    double sum = 0;
    for (int i = 0; i < 9; i++)
        sum += seen(c->picture, x + (i % 3 - 1) * step, y + (double)(i / 3 - 1) * step, k);
    return sum / 9;
}

/* The mean of what lies on the way from the pixel, a vector from one to the next. */
static double smeared(const compose *c, uint32_t x, uint32_t y, uint32_t k, const float way[2]) {
    const int samples = (int)setting(c, "samples");
    double sum = 0;
    for (int i = 0; i < samples; i++)
        sum += seen(c->picture, x + i * (double)way[0] * c->picture->width, y - i * (double)way[1] * c->picture->height,
                    k);
    return sum / samples;
}

static double composed(const compose *c, uint32_t x, uint32_t y, uint32_t k, const float *value) {
    const double own = stored(c->picture, x, y, k) / most(c->picture), v = fmin(fmax((double)*value, 0), 1);
    switch (c->row->mix) {
    case EFFECT_SMEARS:
        return smeared(c, x, y, k, value);
    case EFFECT_BLURS:
        return own + v * (blurred(c, x, y, k) - own);
    case EFFECT_SPARES:
        return own + (1 - v) * c->tint[COLOURS] * (c->tint[k] - own);
    default:
        return own + v * c->tint[COLOURS] * (c->tint[k] - own);
    }
}

void compose_row(const compose *c, uint32_t row, const float *values, void *out) {
    const image *p = c->picture;
    const size_t step = c->row->mix == EFFECT_SMEARS ? 3 : 1;
    for (size_t i = 0; i < (size_t)p->width * p->channels; i++) {
        const uint32_t x = (uint32_t)(i / p->channels), k = (uint32_t)(i % p->channels);
        const float *value = values + step * x;
        const double sample =
            isnan(*value) || k == COLOURS ? stored(p, x, row, k) : rint(most(p) * composed(c, x, row, k, value));
        if (p->type == IMAGE_U8)
            ((uint8_t *)out)[i] = (uint8_t)sample;
        else
            ((uint16_t *)out)[i] = (uint16_t)sample;
    }
}
