/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>

#include "core/bits.h"
#include "texture/frame.h"

/* Magnitudes by their leading 20 bits below the sign: 8 of the exponent, 12 of the significand, so an upper end of a
   bin is at most 2^-11 above what lies in it (subnormals aside). */
enum { BIN_SHIFT = 11, BINS = 1 << 20 };

typedef struct summing {
    frame_summary *out;
    size_t row_values; /* numbers in a row */
    uint32_t channels;
    double sum;
    uint64_t *bins;
} summing;

/* Sums go row by row, from the top: so they are the same in every run. */
static bool take(void *context, uint32_t row, uint32_t count, const float *values) {
    summing *s = context;
    frame_summary *out = s->out;
    for (uint32_t i = 0; i < count; i++) {
        double sum = 0;
        for (size_t x = 0; x < s->row_values; x++) {
            const double value = (double)values[i * s->row_values + x];
            if (isnan(value))
                continue;
            if (isinf(value)) {
                out->infinite++;
                continue;
            }
            if (out->count++ == 0 || value > out->hi) {
                out->hi = value;
                out->hi_column = (uint32_t)(x / s->channels);
                out->hi_row = row + i;
            }
            out->lo = fmin(out->lo, value);
            sum += value;
            s->bins[dp_bits32(fabsf((float)value)) >> BIN_SHIFT]++;
        }
        s->sum += sum;
    }
    return true;
}

static double quantile(const summing *s, double share) {
    const uint64_t wanted = (uint64_t)ceil(share * (double)s->out->count);
    uint64_t below = 0;
    for (uint32_t bin = 0; bin < BINS; bin++) {
        below += s->bins[bin];
        if (below >= wanted) {
            const float top = dp_float32(((bin + 1) << BIN_SHIFT) - 1);
            return fmin((double)top, fmax(fabs(s->out->lo), fabs(s->out->hi)));
        }
    }
    return NAN;
}

bool frame_summarise(const frame *f, const frame_product *product, frame_summary *out) {
    const uint32_t channels = (uint32_t)frame_channels(product);
    *out = (frame_summary){.lo = INFINITY, .hi = -INFINITY, .mean = NAN, .p99 = NAN};
    summing s = {.out = out,
                 .row_values = (size_t)f->camera->width * channels,
                 .channels = channels,
                 .bins = calloc(BINS, sizeof *s.bins)};
    const bool good = s.bins != NULL && frame_run(f, product, false, take, &s);
    if (good && out->count > 0) {
        out->mean = s.sum / (double)out->count;
        out->p99 = quantile(&s, 0.99);
    }
    free(s.bins);
    return good;
}
