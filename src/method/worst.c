/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The worst z-fighting interval over a range of depths. */
#include <math.h>

#include "core/elementary.h"
#include "method/truth.h"

/* Log-spaced by chance: a sample never finds more than there is. */
static double sampled(const dp_setup *setup, double lo, double hi, size_t count, uint64_t seed) {
    double worst = 0;
    for (size_t k = 0; k < count; k++) {
        double z = fmin(fmax(lo * dp_pow(hi / lo, method_unit(seed, k)), lo), hi);
        worst = fmax(worst, dp_cell_of(setup, dp_code(setup, z)).width);
    }
    return worst;
}

static void few_run(const method_call *c) {
    for (size_t i = 0; i < c->in->count; i++)
        c->out->value[i] = sampled(c->setup, c->in->z[i], c->in->hi[i], 64, i);
}

static void many_run(const method_call *c) {
    for (size_t i = 0; i < c->in->count; i++)
        c->out->value[i] = sampled(c->setup, c->in->z[i], c->in->hi[i], 4096, i);
}

static void codes_of(const dp_setup *setup, double lo, double hi, uint32_t *first, uint32_t *last) {
    uint32_t a = dp_code(setup, lo), b = dp_code(setup, hi);
    *first = a < b ? a : b;
    *last = a < b ? b : a;
}

static void exhaustive_run(const method_call *c) {
    for (size_t i = 0; i < c->in->count; i++) {
        uint32_t first, last;
        codes_of(c->setup, c->in->z[i], c->in->hi[i], &first, &last);
        c->out->value[i] = 0;
        for (uint32_t code = first; code <= last; code++)
            c->out->value[i] = fmax(c->out->value[i], dp_cell_of(c->setup, code).width);
    }
}

static void certified_run(const method_call *c) {
    for (size_t i = 0; i < c->in->count; i++) {
        dp_worst w;
        c->out->value[i] = dp_worst_over(c->setup, c->in->z[i], c->in->hi[i], &w) == DP_OK ? w.interval : (double)NAN;
    }
}

/* The claim for `count` sampled depths: one range in a hundred may exceed it. */
static double sampled_claim(double ratio, double count, double b) {
    (void)b;
    return 1 - dp_pow(ratio, -2 * dp_log(100) / count);
}

#define ANY (METHOD_INFINITE | METHOD_ORTHO)

/* clang-format off */
static const method_row methods[] = {
    {METHOD_WORST, "certified", "the ends of the uniform pieces of the format alone, rounded outward",
     {FULL(52 * 0x1p-53), FULL(52 * 0x1p-53), FULL(52 * 0x1p-53), FULL(52 * 0x1p-53)},
     ANY | METHOD_ABOVE, 500, "pieces", 0,
     "depthprec(7)", .run = certified_run},
    {METHOD_WORST, "sampled-64",
     "the widest cell of 64 seeded depths: never too wide; one range in a hundred may miss its claim",
     {FORMULA(sampled_claim, 64, 0), FORMULA(sampled_claim, 64, 0), FORMULA(sampled_claim, 64, 0),
      FORMULA(sampled_claim, 64, 0)}, ANY | METHOD_BELOW, 5e3, "samples", 0,
     "", .run = few_run, .coarse = "samples"},
    {METHOD_WORST, "sampled-4096", "the widest cell of 4096 seeded depths; likewise",
     {FORMULA(sampled_claim, 4096, 0), FORMULA(sampled_claim, 4096, 0), FORMULA(sampled_claim, 4096, 0),
      FORMULA(sampled_claim, 4096, 0)}, ANY | METHOD_BELOW, 3e5, "samples", 0,
     "", .run = many_run, .coarse = "samples"},
    {METHOD_WORST, "exhaustive", "the cell of every code",
     {FULL(20 * 0x1p-53), FULL(20 * 0x1p-53)}, ANY, 1e6, "codes", 0,
     "depthprec(3)", .run = exhaustive_run},
};
/* clang-format on */
static const size_t method_count = sizeof methods / sizeof methods[0];

/* The whole of the view, its halves and its ends, then ranges between two depths. */
static void fill(const dp_setup *setup, method_inputs *in) {
    const double n = setup->spec.znear;
    const double f = isinf(setup->spec.zfar) ? n * METHOD_INFINITE_FAR : setup->spec.zfar;
    method_depths(setup, in);
    for (size_t i = 0; i < in->count; i++) {
        double other = n * dp_pow(f / n, method_unit(11, i));
        double lo = i % 4 == 0 ? n : fmin(in->z[i], other), hi = i % 4 <= 1 ? f : fmax(in->z[i], other);
        in->z[i] = fmin(fmax(lo, n), f);
        in->hi[i] = fmin(fmax(hi, in->z[i]), f);
    }
}

static bool worst_error_at(const method_call *c, size_t i, method_error *error) {
    uint32_t first, last;
    codes_of(c->setup, c->in->z[i], c->in->hi[i], &first, &last);
    *error = truth_error(c->row, c->out->value[i], truth_worst(c->setup, first, last));
    return true;
}

const method_family_row worst_family = {
    .name = "worst",
    .summary = "worst z-fighting interval over a range of depths",
    .measure = "relative error",
    .cases = {{"unorm16 d3d", "unorm16", DP_MAPPING_D3D, false},
              {"fp16 reversed", "fp16", DP_MAPPING_REVERSED, false},
              {"unorm24 d3d", "unorm24", DP_MAPPING_D3D, false},
              {"fp32 reversed", "fp32", DP_MAPPING_REVERSED, false}},
    .case_count = 4,
    .inputs = 16,
    .walked = 8,
    .per_decade = 1,
    .besides = METHOD_BESIDE_ORTHO,
    .methods = methods,
    .method_count = &method_count,
    .fill = fill,
    .judge = worst_error_at,
    .limit = limit_ranges,
};
