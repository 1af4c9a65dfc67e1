/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "convert/again.h"

#include <math.h>
#include <omp.h>

#include "convert/convert.h"
#include "core/bits.h"
#include "core/engine.h"

enum { PARTS = 64 };
static const uint32_t most_codes = 1U << 24, bits_of_one = 0x3F800000U;

/* ---- Copies ------------------------------------------------------------------------------------------------------ */

bool again_fits(const dp_format *stored) {
    return dp_format_is_fp32(stored) || stored->code_max < most_codes;
}

/* Whether the number of a code of the pass is above c/m, exactly: the product of a float by m is two doubles. */
static bool is_above(const dp_format *drawn, uint32_t code, uint32_t c, uint32_t m) {
    if (drawn->kind == DP_FORMAT_UNORM)
        return (uint64_t)code * m > (uint64_t)c * drawn->code_max;
    const double value = dp_format_value(drawn, code), product = value * (double)m;
    return (product - (double)c) + fma(value, (double)m, -product) > 0;
}

uint32_t again_copy(const again_request *q, uint32_t code) {
    if (q->stored.kind == DP_FORMAT_FLOAT)
        return dp_format_encode(&q->drawn, q->rounding, dp_format_value(&q->stored, code));
    /* The number of an integer code lies in the middle of no two others, so nearest and even are one. */
    const convert_chain chain = {.format = {q->stored, q->drawn},
                                 .count = 2,
                                 .read = {.way = convert_read_find("exact")},
                                 .write = {.way = convert_write_find("nearest")}};
    const uint32_t nearest = convert_code(&chain, code).code[1];
    const bool cut = q->rounding == DP_ROUND_ZERO && is_above(&q->drawn, nearest, code, q->stored.code_max);
    return nearest - cut;
}

/* ---- Which depths are stored as a code --------------------------------------------------------------------------- */

static uint32_t code_of(const again_request *q, const dp_format *f, uint32_t bits) {
    return dp_format_encode(f, q->rounding, (double)dp_float32(bits));
}

/* The bits of the greatest window depth that is stored as a code or one below it. */
static uint32_t last_below(const again_request *q, const dp_format *f, uint32_t code) {
    if (code >= f->code_max)
        return bits_of_one;
    const double next = dp_format_value(f, code + 1);
    const double end = q->rounding == DP_ROUND_ZERO ? next : 0.5 * (dp_format_value(f, code) + next);
    uint32_t bits = dp_bits32((float)end);
    while (code_of(q, f, bits) > code)
        bits--;
    while (code_of(q, f, bits + 1) <= code)
        bits++;
    return bits;
}

/* The least that is stored as it or one above. */
static uint32_t first_above(const again_request *q, const dp_format *f, uint32_t code) {
    return code == 0 ? 0 : last_below(q, f, code - 1) + 1;
}

/* ---- All codes --------------------------------------------------------------------------------------------------- */

/* Below the normal numbers of a format there is one exponent. */
static double in_exponents(const dp_format *f, again_gap gap) {
    const double least = ldexp(1, f->kind == DP_FORMAT_FLOAT ? 1 - f->bias : -126);
    int e;
    (void)frexp(fmax(gap.depth, least), &e);
    return ldexp(gap.bias, -e);
}

void again_take(const dp_format *drawn, again_gap gap, again_found *found) {
    if (gap.bias > found->widest.bias)
        found->widest = gap;
    if (in_exponents(drawn, gap) > in_exponents(drawn, found->steepest))
        found->steepest = gap;
}

static void take_most(again_found *found, uint32_t codes, double at) {
    if (codes > found->most) {
        found->most = codes;
        found->most_at = at;
    }
}

static uint32_t apart(uint32_t a, uint32_t b) {
    return a > b ? a - b : b - a;
}

/* Depths from lo to hi, as their bits, fail with one copy, and `passes` is the one next to them that does not. A bias
 * towards 0 is greatest at hi, and in units of 2^e there or at the end of the binade below it; one away from it at lo,
 * in either. */
static void take_failing(const again_request *q, uint32_t lo, uint32_t hi, uint32_t passes, again_found *found) {
    const double limit = (double)dp_float32(passes);
    const uint32_t below = (hi & 0x7F800000U) - 1; /* of 0 there is none, but nothing fails there */
    const double depth = (double)dp_float32(q->reversed ? lo : hi), other = (double)dp_float32(below);
    again_take(&q->drawn, (again_gap){fabs(limit - depth), depth}, found);
    if (!q->reversed && below >= lo && below < hi && other > limit)
        again_take(&q->drawn, (again_gap){other - limit, other}, found);
}

/* Window depths from lo to hi, as their bits, that the prepass stores as one code. What the pass draws of them rises
 * and the copy is one number, so that all is decided at the ends. */
static void count_code(const again_request *q, uint32_t code, uint32_t lo, uint32_t hi, again_found *found) {
    const uint32_t copy = again_copy(q, code);
    const uint32_t first = code_of(q, &q->drawn, lo), last = code_of(q, &q->drawn, hi);
    found->codes++;
    found->unequal += first != copy || last != copy;
    take_most(found, apart(first, copy), (double)dp_float32(lo));
    take_most(found, apart(last, copy), (double)dp_float32(hi));
    if (q->reversed ? first >= copy : last <= copy)
        return;
    found->fails++;
    take_failing(q, lo, hi, q->reversed ? first_above(q, &q->drawn, copy) : last_below(q, &q->drawn, copy), found);
}

/* Codes of the prepass from first to last; some have no window depth. */
static again_found count_part(const again_request *q, uint32_t first, uint32_t last) {
    again_found found = {.most_at = (double)NAN};
    const uint32_t from = dp_bits32(q->lo), to = dp_bits32(q->hi);
    uint32_t lo = first_above(q, &q->stored, first);
    for (uint32_t code = first; code <= last; code++) {
        const uint32_t hi = last_below(q, &q->stored, code);
        const uint32_t least = lo > from ? lo : from, most = hi < to ? hi : to;
        if (least <= most)
            count_code(q, code, least, most, &found);
        lo = hi + 1;
    }
    return found;
}

/* `more` is of higher codes. */
static void add(const dp_format *drawn, again_found *to, const again_found *more) {
    to->codes += more->codes;
    to->unequal += more->unequal;
    to->fails += more->fails;
    take_most(to, more->most, more->most_at);
    again_take(drawn, more->widest, to);
    again_take(drawn, more->steepest, to);
}

again_found again_all(const again_request *q) {
    if (dp_format_is_fp32(&q->stored))
        return (again_found){.codes = (uint64_t)dp_bits32(q->hi) - dp_bits32(q->lo) + 1, .most_at = (double)NAN};
    const uint32_t first = code_of(q, &q->stored, dp_bits32(q->lo));
    const uint64_t codes = (uint64_t)code_of(q, &q->stored, dp_bits32(q->hi)) - first + 1;
    again_found found[PARTS], all = {.most_at = (double)NAN};
#pragma omp parallel for schedule(dynamic) num_threads(q->threads > 0 ? q->threads : omp_get_max_threads())
    for (uint64_t i = 0; i < PARTS; i++) {
        const uint64_t from = codes * i / PARTS, end = codes * (i + 1) / PARTS;
        found[i] = (again_found){.most_at = (double)NAN};
        if (from < end)
            found[i] = count_part(q, first + (uint32_t)from, first + (uint32_t)(end - 1));
    }
    for (int i = 0; i < PARTS; i++)
        add(&q->drawn, &all, &found[i]);
    return all;
}
