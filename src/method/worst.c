/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The worst z-fighting interval over a range of depths. */
#include <math.h>

#include "method/claim.h"
#include "method/method.h"
#include "method/truth.h"

/* Log-spaced by chance: a sample never finds more than there is. */
static double sampled(const dp_setup *setup, double lo, double hi, size_t count, uint64_t seed) {
    double worst = 0;
    for (size_t k = 0; k < count; k++) {
        double z = fmin(fmax(lo * pow(hi / lo, method_unit(seed, k)), lo), hi);
        worst = fmax(worst, dp_cell_of(setup, dp_code(setup, z)).width);
    }
    return worst;
}

static void few_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->value[i] = sampled(setup, in->z[i], in->hi[i], 64, i);
}

static void many_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->value[i] = sampled(setup, in->z[i], in->hi[i], 4096, i);
}

static void codes_of(const dp_setup *setup, double lo, double hi, uint32_t *first, uint32_t *last) {
    uint32_t a = dp_code(setup, lo), b = dp_code(setup, hi);
    *first = a < b ? a : b;
    *last = a < b ? b : a;
}

static void exhaustive_run(const dp_setup *setup, const void *state, const method_inputs *in,
                           const method_outputs *out) {
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        uint32_t first, last;
        codes_of(setup, in->z[i], in->hi[i], &first, &last);
        out->value[i] = 0;
        for (uint32_t code = first; code <= last; code++)
            out->value[i] = fmax(out->value[i], dp_cell_of(setup, code).width);
    }
}

static void certified_run(const dp_setup *setup, const void *state, const method_inputs *in,
                          const method_outputs *out) {
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        dp_worst w;
        out->value[i] = dp_worst_over(setup, in->z[i], in->hi[i], &w) == DP_OK ? w.interval : (double)NAN;
    }
}

#define ANY (METHOD_INFINITE | METHOD_ORTHO)

/* clang-format off */
const method_row worst_methods[] = {
    {METHOD_WORST, "certified", "the ends of the uniform pieces of the format alone, rounded outward",
     {FULL(52 * 0x1p-53), FULL(52 * 0x1p-53)}, ANY | METHOD_ABOVE, 500, "pieces", 0, "depthprec(7)", NULL, NULL, certified_run, NULL},
    {METHOD_WORST, "sampled-64", "the widest cell of 64 seeded depths: never more than there is; one range in a hundred may miss its claim",
     {FORMULA(claim_sampled_64), FORMULA(claim_sampled_64)}, ANY | METHOD_BELOW, 5e3, "samples", 0, "", NULL, NULL, few_run, NULL},
    {METHOD_WORST, "sampled-4096", "the widest cell of 4096 seeded depths; likewise",
     {FORMULA(claim_sampled_4096), FORMULA(claim_sampled_4096)}, ANY | METHOD_BELOW, 3e5, "samples", 0, "", NULL, NULL, many_run, NULL},
    {METHOD_WORST, "exhaustive", "the cell of every code",
     {FULL(20 * 0x1p-53), FULL(20 * 0x1p-53)}, ANY, 1e6, "codes", 0, "depthprec(3)", NULL, NULL, exhaustive_run, NULL},
};
/* clang-format on */
const size_t worst_method_count = sizeof worst_methods / sizeof worst_methods[0];

bool worst_judge(const method_row *row, const dp_setup *setup, const method_inputs *in, const method_outputs *out,
                 size_t i, method_error *error) {
    uint32_t first, last;
    double got = out->value[i], want = 0;
    codes_of(setup, in->z[i], in->hi[i], &first, &last);
    for (uint32_t code = first; code <= last; code++) {
        bool cut;
        want = fmax(want, truth_width(setup, code, &cut));
    }
    *error = truth_error(row, got, want);
    return true;
}
