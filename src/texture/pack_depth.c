/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The error of depth packings: in doubles by the intervals of all codes, in binary32 by its numbers. */
#include <math.h>
#include <string.h>

#include "core/bits.h"
#include "texture/pack_parts.h"

typedef struct tally {
    double sum, bias, weight, max, at;
    uint64_t codes;
} tally;

static void tally_end(const tally *t, pack_error *out) {
    out->depth = (pack_bound){t->sum / t->weight, t->max};
    out->depth_bias = t->bias / t->weight;
    out->depth_at = t->at;
    out->depth_codes = t->codes;
}

/* ---- Exact arithmetic -------------------------------------------------------------------------------------------- */

static uint32_t code_of(const pack_row *row, double v, double *decoded) {
    uint32_t codes[PACK_CHANNELS_MAX];
    row->encode(row, &v, codes);
    row->decode(row, codes, decoded);
    return codes[0] << row->bits | codes[1];
}

/* The greatest number that is stored as `from` is: intervals are shorter than `span`, and codes never come back. */
static double last_alike(const pack_row *row, double from, uint32_t code, double span) {
    double in = from, out = fmin(from + span, 1), decoded;
    for (double mid = (in + out) / 2; mid > in && mid < out; mid = (in + out) / 2)
        *(code_of(row, mid, &decoded) == code ? &in : &out) = mid;
    return in;
}

/* Inside an interval the error is linear, so its ends and the integral of |x| and x say all. */
static void add_interval(tally *t, double from, double to, double decoded) {
    const double a = decoded - from, b = decoded - to;
    const double width = to - from;
    t->weight += width;
    t->bias += width * (a + b) / 2;
    t->sum += a > 0 && b < 0 ? (a * a + b * b) / 2 : width * fabs(a + b) / 2;
    if (fmax(fabs(a), fabs(b)) > t->max) {
        t->max = fmax(fabs(a), fabs(b));
        t->at = fabs(a) > fabs(b) ? from : to;
    }
    t->codes++;
}

static void measure_exact(const pack_row *row, pack_error *out) {
    const double span = 1.5 / (double)(((1U << row->bits) - 1) * ((1U << row->bits) - 1));
    tally t = {0};
    for (double from = 0; from < 1;) {
        double decoded;
        const uint32_t code = code_of(row, from, &decoded);
        const double to = last_alike(row, from, code, span);
        const double next = nextafter(to, 1);
        add_interval(&t, from, next, decoded);
        if (next >= 1)
            break;
        from = next;
    }
    tally_end(&t, out);
}

/* ---- Binary32 ---------------------------------------------------------------------------------------------------- */

/*
 * A number stands for the reals from it to the next, so each binade has its weight. From 2^-9 up all are visited;
 * below, where the coarse channel is 0, every 61st, down to 2^-24, under which all decode to 0 or nearly.
 */
enum { EXPONENT_ALL = -9, EXPONENT_LAST = -24, STRIDE = 61 };

/* The errors of a block, in loops that a compiler can make vectors of: the reduction has LANES sums of its own. */
enum { BLOCK = 512, LANES = 8 };

typedef struct lanes {
    double sum[LANES], bias[LANES];
    float max[LANES];
} lanes;

static void add_block(const pack_row *row, uint32_t first, uint32_t stride, uint8_t used[], lanes *l) {
    const double half = row->truncates ? 0 : 0.5;
    uint32_t code[BLOCK];
    float error[BLOCK];
    for (uint32_t i = 0; i < BLOCK; i++) {
        const float v = dp_float32(first + i * stride);
        code[i] = pack_rg32_encode(v, half);
        error[i] = pack_rg32_decode(code[i]) - v;
    }
    for (uint32_t i = 0; i < BLOCK; i += LANES)
        for (uint32_t k = 0; k < LANES; k++) {
            const float e = error[i + k], size = fabsf(e);
            l->sum[k] += (double)size;
            l->bias[k] += (double)e;
            l->max[k] = size > l->max[k] ? size : l->max[k];
        }
    for (uint32_t i = 0; i < BLOCK; i++)
        used[code[i]] = 1;
}

/* A number that reaches the largest error of its binade, which is known to be there. */
static double find(const pack_row *row, uint32_t first, uint32_t stride, float max) {
    const double half = row->truncates ? 0 : 0.5;
    for (;; first += stride) {
        const float v = dp_float32(first);
        if (fabsf(pack_rg32_decode(pack_rg32_encode(v, half)) - v) == max)
            return (double)v;
    }
}

static void add_binade(const pack_row *row, int exponent, uint8_t used[], tally *t) {
    const uint32_t stride = exponent < EXPONENT_ALL ? STRIDE : 1;
    const uint32_t first = (uint32_t)(exponent + 127) << 23;
    const uint32_t blocks = (1U << 23) / (BLOCK * stride);
    lanes l = {.max = {0}};
    for (uint32_t b = 0; b < blocks; b++)
        add_block(row, first + b * BLOCK * stride, stride, used, &l);
    const double weight = ldexp(1, exponent), share = weight / ((double)blocks * BLOCK);
    float max = 0;
    for (int k = 0; k < LANES; k++) {
        t->sum += l.sum[k] * share;
        t->bias += l.bias[k] * share;
        max = l.max[k] > max ? l.max[k] : max;
    }
    t->weight += weight;
    if ((double)max > t->max) {
        t->max = (double)max;
        t->at = find(row, first, stride, max);
    }
}

static void measure_binary32(const pack_row *row, pack_error *out) {
    uint8_t used[1 << 16];
    tally t = {0};
    memset(used, 0, sizeof used);
    for (int exponent = -1; exponent >= EXPONENT_LAST; exponent--)
        add_binade(row, exponent, used, &t);
    for (uint32_t i = 0; i < 1U << 16; i++)
        t.codes += used[i];
    tally_end(&t, out);
}

void pack_measure_depth(const pack_row *row, pack_error *out) {
    if (row->binary32)
        measure_binary32(row, out);
    else
        measure_exact(row, out);
}
