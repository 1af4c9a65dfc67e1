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

/* @return whether it is a finite number */
static bool add(frame_summary *out, double value, uint32_t column, uint32_t row) {
    out->infinite += isinf(value) ? 1 : 0;
    if (!isfinite(value))
        return false;
    if (out->count++ == 0 || value > out->hi) {
        out->hi = value;
        out->hi_column = column;
        out->hi_row = row;
    }
    out->lo = fmin(out->lo, value);
    return true;
}

/* Sums go row by row, from the top: so they are the same in every run. */
static bool take(void *context, uint32_t row, uint32_t count, const float *values) {
    summing *s = context;
    for (uint32_t i = 0; i < count; i++) {
        double sum = 0;
        for (size_t x = 0; x < s->row_values; x++) {
            const double value = (double)values[i * s->row_values + x];
            if (!add(s->out, value, (uint32_t)(x / s->channels), row + i))
                continue;
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

bool frame_summarise_decoding(const frame *f, const decode_row *row, frame_summary *out) {
    const dp_setup *setup = &f->camera->setup;
    const uint32_t width = f->camera->width, sky = frame_sky_rank(f);
    double sum = 0;
    uint32_t *codes = calloc(width, sizeof *codes);
    float *d = calloc(width, sizeof *d), *got = calloc(width, sizeof *got);
    const bool good = codes != NULL && d != NULL && got != NULL;
    *out = (frame_summary){.lo = INFINITY, .hi = NAN, .p99 = NAN};
    for (uint32_t y = 0; good && y < f->camera->height; y++) {
        frame_codes(f, y, codes);
        for (uint32_t x = 0; x < width; x++)
            d[x] = codes[x] == UINT32_MAX ? NAN : (float)dp_format_value(&setup->spec.format, codes[x]);
        decode_run(row, setup, d, got, width);
        for (uint32_t x = 0; x < width; x++) {
            if (codes[x] == UINT32_MAX || frame_rank(setup, codes[x]) >= sky)
                continue;
            const double want = decode_exact(setup, row->quantity, (double)d[x]);
            const double off = want == (double)got[x] ? 0 : fabs((double)got[x] - want) / fabs(want);
            if (add(out, isfinite(off) ? off : (double)INFINITY, x, y))
                sum += off;
        }
    }
    out->mean = out->count > 0 ? sum / (double)out->count : (double)NAN;
    free(codes);
    free(d);
    free(got);
    return good;
}
