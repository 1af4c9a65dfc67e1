/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The z-fighting interval at a depth. The last three rows speak of the binary32 pipeline and are judged by it. */
#include <math.h>

#include "method/census.h"
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

static void bound_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        dp_budget b;
        out->value[i] = dp_budget_at(setup, in->z[i], NULL, &b) == DP_OK ? b.separation : (double)NAN;
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
        out->value[i] =
            census_sample(&q, &r) == CENSUS_DONE ? fmax(r.all.longest, truth_step(q.common.lo)) : (double)NAN;
    }
}

static void census_at(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    (void)state;
    for (size_t i = 0; i < in->count; i++) {
        census_result r;
        const census_request q = request_of(setup, in->z[i]);
        out->value[i] = census_run(&q, &r) == CENSUS_DONE ? fmax(r.all.longest, truth_step(q.lo)) : (double)NAN;
    }
}

/* ---- Rows, cheapest first ---------------------------------------------------------------------------------------- */

enum { PIPELINE_INPUTS = 48 };

/* clang-format off */
const method_row interval_methods[] = {
    {METHOD_INTERVAL, "rule-of-thumb", "z^2/(n 2^b)",
     {UP_TO(0.12, 1e6), NOWHERE}, METHOD_INFINITE | METHOD_WHOLE, 1, "1", 0,
     "Baker, Learning to love your z-buffer", NULL, NULL, rule_run, NULL},
    {METHOD_INTERVAL, "derivative", "dz/dd times the step of the format at d",
     {UP_TO(1e-3, 1e4), FULL(0.34)}, METHOD_INFINITE | METHOD_ORTHO | METHOD_WHOLE, 4, "1", 0,
     "first order of z(d + step) - z(d)", NULL, NULL, derivative_run, NULL},
    {METHOD_INTERVAL, "cell", "the exact cell of the exact code, no subtraction of depths",
     {FULL(1e-15), FULL(1e-15)}, METHOD_INFINITE | METHOD_ORTHO, 50, "1", 0,
     "depthprec(7)", NULL, NULL, cell_run, NULL},
    {METHOD_INTERVAL, "neighbours", "half the difference of the depths that the codes on either side give back, double",
     {UP_TO(1e-6, 1e4), UNCLAIMED}, METHOD_INFINITE | METHOD_ORTHO | METHOD_WHOLE, 55, "1", 0,
     "", NULL, NULL, neighbours_run, NULL},
    {METHOD_INTERVAL, "neighbours-binary32", "the same with the depths rounded to binary32, as in a shader",
     {UP_TO(0.9, 3e7), UNCLAIMED}, METHOD_INFINITE | METHOD_ORTHO | METHOD_WHOLE, 56, "1", 0,
     "", NULL, NULL, neighbours32_run, NULL},
    {METHOD_INTERVAL, "bound", "the separation that the binary32 pipeline guarantees",
     {UP_TO(6, 2e5), FULL(0.6)}, METHOD_INFINITE | METHOD_PIPELINE, 100, "1", PIPELINE_INPUTS,
     "depthprec(7)", NULL, NULL, bound_run, NULL},
    {METHOD_INTERVAL, "simulation", "256 seeded depths of the binary32 pipeline near z and the longest interval from them",
     {FULL(0.8), FULL(1e-15)}, METHOD_INFINITE | METHOD_PIPELINE, 50000, "samples", PIPELINE_INPUTS,
     "", NULL, NULL, simulation_run, NULL},
    {METHOD_INTERVAL, "census", "every depth of the binary32 pipeline near z",
     {FULL(1e-15), FULL(1e-15)}, METHOD_INFINITE | METHOD_PIPELINE, 60000, "depths", PIPELINE_INPUTS,
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
        truth_window(setup, in->z[i], &lo, &hi);
        want = truth_longest(setup, lo, hi);
    } else {
        want = truth_width(setup, dp_code(setup, in->z[i]), &cut);
    }
    if (cut && (row->domain & METHOD_WHOLE) != 0)
        return false;
    *error = truth_error(got, want);
    return true;
}
