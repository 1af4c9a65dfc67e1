/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The z-fighting interval at a depth. The last three rows speak of the binary32 pipeline and are judged by it. */
#include <math.h>

#include "census/census.h"
#include "method/claim.h"
#include "method/method.h"
#include "method/truth.h"

/* ---- The lattice ------------------------------------------------------------------------------------------------- */

static void rule_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const double factor = 1 / (setup->spec.znear * ldexp(1.0, setup->spec.format.bits));
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->value[i] = in->z[i] * in->z[i] * factor;
}

/* dz/dd. */
static double slope_at(const dp_setup *setup, double z) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    return setup->spec.ortho ? f - n : z * z * (1 / n - 1 / f);
}

static void derivative_run(const dp_setup *setup, const void *state, const method_inputs *in,
                           const method_outputs *out) {
    const dp_format *f = &setup->spec.format;
    const double unorm = 1.0 / f->code_max, least = ldexp(1.0, 1 - f->bias - f->mantissa_bits);
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        double step = unorm;
        if (f->kind == DP_FORMAT_FLOAT) {
            double d = dp_window(setup, in->z[i]);
            step = d > 0 ? fmax(least, ldexp(1.0, ilogb(d) - f->mantissa_bits)) : least;
        }
        out->value[i] = slope_at(setup, in->z[i]) * step;
    }
}

/* Half the way from the code before to the code after, subtracting what a reader of the buffer would see. */
static void neighbours_run(const dp_setup *setup, const void *state, const method_inputs *in,
                           const method_outputs *out) {
    const uint32_t most = setup->spec.format.code_max;
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        uint32_t code = dp_code(setup, in->z[i]), a = code - (code > 0), b = code + (code < most);
        out->value[i] = fabs(dp_stored(setup, b) - dp_stored(setup, a)) / 2;
    }
}

static void neighbours32_run(const dp_setup *setup, const void *state, const method_inputs *in,
                             const method_outputs *out) {
    const uint32_t most = setup->spec.format.code_max;
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        uint32_t code = dp_code(setup, in->z[i]), a = code - (code > 0), b = code + (code < most);
        out->value[i] = (double)fabsf((float)dp_stored(setup, b) - (float)dp_stored(setup, a)) / 2;
    }
}

static void cell_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    (void)state;
    for (size_t i = 0; i < in->count; i++)
        out->value[i] = dp_cell_of(setup, dp_code(setup, in->z[i])).width;
}

/* ---- The pipeline ------------------------------------------------------------------------------------------------ */

/* Of binary32 depths, like what it is held against: without what the surfaces' own depths add. */
static void bound_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        dp_budget b;
        out->value[i] = dp_budget_at(setup, in->z[i], NULL, &b) == DP_OK
                            ? fmax(b.separation - b.cause[DP_CAUSE_EYE], truth_step(in->z[i]))
                            : (double)NAN;
    }
}

static census_request request_of(const dp_setup *setup, double z) {
    census_request r = {.setup = setup, .threads = 1};
    truth_window(setup, z, &r.lo, &r.hi);
    return r;
}

static void simulation_run(const dp_setup *setup, const void *state, const method_inputs *in,
                           const method_outputs *out) {
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        census_result r;
        const census_sample_request q = {.common = request_of(setup, in->z[i]), .count = 256, .seed = i};
        out->value[i] = census_sample(&q, &r) == CENSUS_DONE ? fmax(r.all.longest, truth_step(in->z[i])) : (double)NAN;
    }
}

static void census_at(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        census_result r;
        const census_request q = request_of(setup, in->z[i]);
        out->value[i] = census_run(&q, &r) == CENSUS_DONE ? fmax(r.all.longest, truth_step(in->z[i])) : (double)NAN;
    }
}

/* ---- Rows, cheapest first ---------------------------------------------------------------------------------------- */

enum { PIPELINE_INPUTS = 48 };
#define EXACT 0x1p-53 /* the difference of two binary32 depths is a double */

/* clang-format off */
const method_row interval_methods[] = {
    {METHOD_INTERVAL, "rule-of-thumb", "z^2/(n 2^b)",
     {FORMULA(claim_rule), NOWHERE}, METHOD_INFINITE | METHOD_WHOLE, 1, "1", 0,
     "Baker, Learning to love your z-buffer", NULL, NULL, rule_run, NULL},
    {METHOD_INTERVAL, "derivative", "dz/dd times the step of the format at d",
     {FORMULA(claim_first_order), FULL(1 / 3.0 + 0x1p-22)}, METHOD_INFINITE | METHOD_ORTHO | METHOD_WHOLE, 4, "1", 0,
     "first order of z(d + step) - z(d)", NULL, NULL, derivative_run, NULL},
    {METHOD_INTERVAL, "cell", "the exact cell of the exact code, no subtraction of depths",
     {FULL(20 * 0x1p-53), FULL(20 * 0x1p-53)}, METHOD_INFINITE | METHOD_ORTHO, 50, "1", 0,
     "depthprec(7)", NULL, NULL, cell_run, NULL},
    {METHOD_INTERVAL, "neighbours", "half the difference of the depths that the codes on either side give back, double",
     {FORMULA(claim_neighbours), UNCLAIMED}, METHOD_ORTHO | METHOD_WHOLE, 55, "1", 0,
     "", NULL, NULL, neighbours_run, NULL},
    {METHOD_INTERVAL, "neighbours-binary32", "the same with the depths rounded to binary32, as in a shader",
     {FORMULA(claim_neighbours32), UNCLAIMED}, METHOD_ORTHO | METHOD_WHOLE, 56, "1", 0,
     "", NULL, NULL, neighbours32_run, NULL},
    {METHOD_INTERVAL, "bound", "the separation that the binary32 pipeline guarantees, next to the longest interval that is there",
     {FORMULA(claim_bound), FULL(0x1.01p-40)}, METHOD_INFINITE | METHOD_PIPELINE, 100, "1", PIPELINE_INPUTS,
     "depthprec(7)", NULL, NULL, bound_run, NULL},
    {METHOD_INTERVAL, "simulation", "the longest interval from 256 seeded depths of the binary32 pipeline near z: never more than there is",
     {FULL(1), FULL(EXACT)}, METHOD_INFINITE | METHOD_PIPELINE | METHOD_BELOW, 50000, "samples", PIPELINE_INPUTS,
     "", NULL, NULL, simulation_run, NULL},
    {METHOD_INTERVAL, "census", "every depth of the binary32 pipeline near z",
     {FULL(EXACT), FULL(EXACT)}, METHOD_INFINITE | METHOD_PIPELINE, 60000, "depths", PIPELINE_INPUTS,
     "depthprec(7)", NULL, NULL, census_at, NULL},
};
/* clang-format on */
const size_t interval_method_count = sizeof interval_methods / sizeof interval_methods[0];

bool interval_judge(const method_row *row, const dp_setup *setup, const method_inputs *in, const method_outputs *out,
                    size_t i, method_error *error) {
    double got = out->value[i], want, lo, hi;
    bool cut = false;
    if ((row->domain & METHOD_PIPELINE) != 0) {
        dp_budget b;
        if (dp_budget_at(setup, in->z[i], NULL, &b) != DP_OK || !(in->z[i] + b.separation <= setup->spec.zfar))
            return false; /* nothing in view lies behind it */
        if (!truth_window(setup, in->z[i], &lo, &hi))
            return false; /* too long for a scan */
        want = truth_longest(setup, lo, hi, truth_step(in->z[i]));
    } else {
        want = truth_width(setup, dp_code(setup, in->z[i]), &cut);
    }
    if (cut && (row->domain & METHOD_WHOLE) != 0)
        return false;
    *error = truth_error(row, got, want);
    return true;
}
