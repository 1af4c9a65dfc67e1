/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>

#include "core/bits.h"
#include "core/clones.h"
#include "texture/frame.h"
#include "texture/strips.h"

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
static bool count_value(frame_summary *out, double value, uint32_t column, uint32_t row) {
    out->infinite += isinf(value) ? 1 : 0;
    if (!isfinite(value))
        return false;
    if (out->count++ == 0 || value > out->hi) {
        out->hi = value;
        out->hi_column = column;
        out->hi_row = row;
    }
    out->lo = value < out->lo ? value : out->lo;
    return true;
}

/* Sums go row by row, from the top: so they are the same in every run. */
static bool sum_rows(void *context, uint32_t row, uint32_t count, const float *values) {
    summing *s = context;
    for (uint32_t i = 0; i < count; i++) {
        double sum = 0;
        for (size_t x = 0; x < s->row_values; x++) {
            const double value = (double)values[i * s->row_values + x];
            if (!count_value(s->out, value, (uint32_t)(x / s->channels), row + i))
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
    const bool good = s.bins != NULL && frame_run(f, product, false, sum_rows, &s);
    if (good && out->count > 0) {
        out->mean = s.sum / (double)out->count;
        out->p99 = quantile(&s, 0.99);
    } else
        out->lo = out->hi = NAN;
    free(s.bins);
    return good;
}

/* ---- A decoding -------------------------------------------------------------------------------------------------- */

enum { ROWS = 16 };

typedef struct decoding {
    const frame *f;
    const decode_row *row;
    dp_setup plain; /* as the shader has its constants: of the depth range 0 to 1 */
    bool undone;
    frame_summary *out;
    dp_batch window;
    uint32_t width, sky;
    double sum;
    struct row_summary {
        frame_summary found;
        double sum;
    } * rows; /* ROWS in each slot */
    struct {
        uint32_t *codes;
        float *d, *got;
        double *off; /* NaN where nothing is decoded */
    } * desks;       /* of a thread */
} decoding;

CLONES static void relative(const float *restrict got, const uint32_t *restrict codes, uint32_t flip, uint32_t sky,
                            double *restrict off, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const double want = off[i], found = (double)got[i];
        const double away = want == found ? 0 : fabs(found - want) / fabs(want);
        const uint32_t rank = flip != 0 ? flip - codes[i] : codes[i];
        const double number = fabs(away) < (double)INFINITY ? away : (double)INFINITY;
        off[i] = codes[i] == UINT32_MAX || rank >= sky ? (double)NAN : number;
    }
}

static struct row_summary summary_of(const double *off, uint32_t width, uint32_t row) {
    frame_summary found = {.lo = INFINITY};
    double sum = 0;
    for (uint32_t x = 0; x < width; x++)
        if (!isnan(off[x]) && count_value(&found, off[x], x, row))
            sum += off[x];
    return (struct row_summary){found, sum};
}

/* (d - LO)/(HI - LO) in binary32, as a shader undoes a depth range. */
static void undo(const double range[2], const float *d, float *out, size_t count) {
    const float lo = (float)range[0], by = (float)range[1] - lo;
    for (size_t i = 0; i < count; i++)
        out[i] = (d[i] - lo) / by;
}

static void decode_strip(void *context, size_t index, size_t slot, int thread) {
    const decoding *s = context;
    const dp_setup *setup = &s->f->camera->setup;
    uint32_t *const codes = s->desks[thread].codes;
    float *const d = s->desks[thread].d, *const got = s->desks[thread].got;
    double *const off = s->desks[thread].off;
    for (uint32_t y = (uint32_t)index * ROWS; y < s->f->camera->height && y / ROWS == index; y++) {
        frame_codes(s->f, y, codes);
        dp_batch_run(&s->window, codes, d, s->width);
        if (s->undone)
            undo(setup->spec.depth_range, d, got, s->width);
        decode_run(s->row, &s->plain, s->undone ? got : d, got, s->width);
        decode_exact_run(setup, s->row->quantity, d, off, s->width);
        relative(got, codes, setup->reversed ? setup->spec.format.code_max : 0, s->sky, off, s->width);
        s->rows[slot * ROWS + y % ROWS] = summary_of(off, s->width, y);
    }
}

/* Rows come from the top: sums are the same in every run. */
static bool add_strip(void *context, size_t index, size_t slot) {
    decoding *s = context;
    frame_summary *out = s->out;
    for (uint32_t y = (uint32_t)index * ROWS; y < s->f->camera->height && y / ROWS == index; y++) {
        const struct row_summary *row = &s->rows[slot * ROWS + y % ROWS];
        const frame_summary *found = &row->found;
        out->infinite += found->infinite;
        if (found->count == 0)
            continue;
        if (out->count == 0 || found->hi > out->hi) {
            out->hi = found->hi;
            out->hi_column = found->hi_column;
            out->hi_row = found->hi_row;
        }
        out->lo = fmin(out->lo, found->lo);
        out->count += found->count;
        s->sum += row->sum;
    }
    return true;
}

bool frame_summarise_decoding(const frame *f, const decode_row *row, bool undone, frame_summary *out) {
    const int threads = frame_threads(f);
    const size_t width = f->camera->width, slots = 4 * (size_t)threads;
    decoding s = {.f = f, .row = row, .out = out, .width = f->camera->width, .sky = frame_sky_rank(f)};
    dp_spec spec = f->camera->setup.spec;
    spec.depth_range[0] = 0;
    spec.depth_range[1] = 1;
    dp_setup_init(&s.plain, &spec); /* a checked set-up with another range */
    s.undone = undone;
    s.rows = malloc(slots * ROWS * sizeof *s.rows);
    s.desks = calloc((size_t)threads, sizeof *s.desks);
    bool good =
        s.rows != NULL && s.desks != NULL &&
        dp_batch_init(&s.window, &f->camera->setup, DP_TASK_DECODE, DP_REAL_FLOAT, DP_WORD_32, dp_path_best()) == DP_OK;
    for (int i = 0; i < threads && good; i++) {
        s.desks[i].codes = malloc(width * sizeof *s.desks[i].codes);
        s.desks[i].d = malloc(width * sizeof *s.desks[i].d);
        s.desks[i].got = malloc(width * sizeof *s.desks[i].got);
        s.desks[i].off = malloc(width * sizeof *s.desks[i].off);
        good = s.desks[i].codes != NULL && s.desks[i].d != NULL && s.desks[i].got != NULL && s.desks[i].off != NULL;
    }
    *out = (frame_summary){.lo = INFINITY, .hi = NAN, .p99 = NAN};
    const size_t count = (f->camera->height + ROWS - 1) / ROWS;
    good = good && strips_run(&(strips){count, threads, slots, decode_strip, add_strip, &s});
    out->mean = out->count > 0 ? s.sum / (double)out->count : (double)NAN;
    for (int i = 0; i < threads && s.desks != NULL; i++) {
        free(s.desks[i].codes);
        free(s.desks[i].d);
        free(s.desks[i].got);
        free(s.desks[i].off);
    }
    free(s.desks);
    free(s.rows);
    return good;
}
