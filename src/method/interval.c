/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The z-fighting interval at a depth. The last three rows speak of the binary32 pipeline and are judged by it. */
#include <math.h>

#include "core/clones.h"
#include "method/truth.h"
#include "zfight/census.h"

/* ---- The lattice ------------------------------------------------------------------------------------------------- */

CLONES static void rule_run(const method_call *c) {
    const double factor = 1 / (c->setup->spec.znear * ldexp(1.0, c->setup->spec.format.bits));
    for (size_t i = 0; i < c->in->count; i++)
        c->out->value[i] = c->in->z[i] * c->in->z[i] * factor;
}

/* dz/dd. */
static double slope_at(const dp_setup *setup, double z) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    return setup->spec.ortho ? f - n : z * z * (1 / n - 1 / f);
}

CLONES static void derivative_run(const method_call *c) {
    const dp_format *f = &c->setup->spec.format;
    const double unorm = 1.0 / f->code_max, least = ldexp(1.0, 1 - f->bias - f->mantissa_bits);
    for (size_t i = 0; i < c->in->count; i++) {
        double step = unorm;
        if (f->kind == DP_FORMAT_FLOAT) {
            double d = dp_window(c->setup, c->in->z[i]);
            step = d > 0 ? fmax(least, ldexp(1.0, ilogb(d) - f->mantissa_bits)) : least;
        }
        c->out->value[i] = slope_at(c->setup, c->in->z[i]) * step;
    }
}

/* Half the way from the code before to the code after, subtracting what a reader of the buffer would see. */
static void neighbours_run(const method_call *c) {
    const uint32_t most = c->setup->spec.format.code_max;
    for (size_t i = 0; i < c->in->count; i++) {
        uint32_t code = dp_code(c->setup, c->in->z[i]), a = code - (code > 0), b = code + (code < most);
        c->out->value[i] = fabs(dp_stored(c->setup, b) - dp_stored(c->setup, a)) / 2;
    }
}

static void neighbours32_run(const method_call *c) {
    const uint32_t most = c->setup->spec.format.code_max;
    for (size_t i = 0; i < c->in->count; i++) {
        uint32_t code = dp_code(c->setup, c->in->z[i]), a = code - (code > 0), b = code + (code < most);
        c->out->value[i] = (double)fabsf((float)dp_stored(c->setup, b) - (float)dp_stored(c->setup, a)) / 2;
    }
}

static void cell_run(const method_call *c) {
    for (size_t i = 0; i < c->in->count; i++)
        c->out->value[i] = dp_cell_of(c->setup, dp_code(c->setup, c->in->z[i])).width;
}

/* ---- The pipeline ------------------------------------------------------------------------------------------------ */

/* The separation of binary32 depths, as what it is held against: without what the surfaces' own depths add. */
static void bound_run(const method_call *c) {
    for (size_t i = 0; i < c->in->count; i++) {
        dp_budget b;
        c->out->value[i] = dp_budget_at(c->setup, c->in->z[i], NULL, &b) == DP_OK
                               ? fmax(b.separation - b.cause[DP_CAUSE_EYE], truth_step(c->in->z[i]))
                               : (double)NAN;
    }
}

static census_request request_of(const dp_setup *setup, double z) {
    census_request r = {.setup = setup, .threads = 1};
    truth_window(setup, z, &r.lo, &r.hi);
    return r;
}

static void simulation_run(const method_call *c) {
    for (size_t i = 0; i < c->in->count; i++) {
        census_result r;
        const census_sample_request q = {.common = request_of(c->setup, c->in->z[i]), .count = 256, .seed = i};
        c->out->value[i] =
            census_sample(&q, &r) == CENSUS_DONE ? fmax(r.all.longest, truth_step(c->in->z[i])) : (double)NAN;
    }
}

static void census_at(const method_call *c) {
    for (size_t i = 0; i < c->in->count; i++) {
        census_result r;
        const census_request q = request_of(c->setup, c->in->z[i]);
        c->out->value[i] =
            census_run(&q, &r) == CENSUS_DONE ? fmax(r.all.longest, truth_step(c->in->z[i])) : (double)NAN;
    }
}

/* ---- Claims: of a UNORM format's standard mapping a is the code of 1, of fp16 reversed the code of 1 that counts in
 * its finest step, 2^-24, whose cells lie at the far plane
 * ------------------------------------------------------------- */

#define STEPS16    65535.0
#define STEPS24    16777215.0
#define STEPS_HALF 0x1p24

/* The farthest whole cell reaches from z1 to z1 (1 + this); 2 where the far plane is infinite. */
static double far_cell(double ratio, double steps) {
    return 1 / (steps / (ratio - 1) + 0.5);
}

static double rule_claim(double ratio, double steps, double b) {
    (void)b;
    return (1 + far_cell(ratio, steps)) / (1 - 1 / ratio) - 1;
}

static double derivative_claim(double ratio, double steps, double b) {
    (void)b;
    return far_cell(ratio, steps);
}

/* At a power of two the step is 4/3 of the cell, or 2/3. */
static double derivative_claim_half(double ratio, double steps, double b) {
    (void)b;
    return fmax(1 / 3.0 + 0x1p-10, far_cell(ratio, steps));
}

static double curved(double ratio, double steps) {
    const double g = (ratio - 1) / steps;
    return 0.75 / (1 / (g * g) + 2 / g);
}

/* The claim from the curve, and `roundings` of depths and of their difference: of the latter, and next to near, where a
 * cell is the smallest part of its depth. */
static double neighbours(double ratio, double steps, double roundings) {
    return curved(ratio, steps) * (1 + 2 * roundings) + roundings * steps / (1 - 1 / ratio);
}

/* At a power of two the steps on either side differ; cells are the smallest part of their depths next to near, and next
 * to the far plane where that is not far. */
static double neighbours_half(double ratio, double steps, double roundings) {
    return fmax(0x1p-12, curved(ratio, steps)) * (1 + 2 * roundings) + roundings * (0x1p11 + steps / (ratio - 1));
}

/* The claim of the guarantee in the binary32 pipeline. */
static double bound_claim(double ratio, double a, double b) {
    (void)a, (void)b;
    return 2 * (2 + 2 / (1 - 1 / ratio)) + 2 / 3.0 - 1;
}

/* ---- Rows, cheapest first ---------------------------------------------------------------------------------------- */

enum { PIPELINE_INPUTS = 48 };
#define EXACT    0x1p-53 /* the difference of two binary32 depths is a double */
#define SIX      (6 * 0x1p-53)
#define CELL     (20 * 0x1p-53)
#define PIPELINE (METHOD_INFINITE | METHOD_PIPELINE)

/* clang-format off */
static const method_row methods[] = {
    {METHOD_INTERVAL, "rule-of-thumb", "z^2/(n 2^b)",
     {FORMULA(rule_claim, STEPS24, 0), NOWHERE, FORMULA(rule_claim, STEPS16, 0)},
     METHOD_INFINITE | METHOD_WHOLE, 1, "1", 0,
     "Baker, Learning to love your z-buffer", .run = rule_run, .coarse = "curvature"},
    {METHOD_INTERVAL, "derivative", "dz/dd times the step of the format at d",
     {FORMULA(derivative_claim, STEPS24, 0), FULL(1 / 3.0 + 0x1p-22), FORMULA(derivative_claim, STEPS16, 0),
      FORMULA(derivative_claim_half, STEPS_HALF, 0)}, METHOD_INFINITE | METHOD_ORTHO | METHOD_WHOLE, 4, "1", 0,
     "first order of z(d + step) - z(d)", .run = derivative_run, .coarse = "curvature"},
    {METHOD_INTERVAL, "cell", "the exact cell of the exact code, no subtraction of depths",
     {FULL(CELL), FULL(CELL), FULL(CELL), FULL(CELL)}, METHOD_INFINITE | METHOD_ORTHO, 50, "1", 0,
     "depthprec(7)", .run = cell_run},
    {METHOD_INTERVAL, "neighbours", "half the difference of the decoded depths of the codes on either side, double",
     {FORMULA(neighbours, STEPS24, SIX), UNCLAIMED, FORMULA(neighbours, STEPS16, SIX),
      FORMULA(neighbours_half, STEPS_HALF, SIX)}, METHOD_ORTHO | METHOD_WHOLE, 55, "1", 0,
     "", .run = neighbours_run, .coarse = "curvature"},
    {METHOD_INTERVAL, "neighbours-binary32", "the same with the depths rounded to binary32, as in a shader",
     {FORMULA(neighbours, STEPS24, DP_UNIT + SIX), UNCLAIMED, FORMULA(neighbours, STEPS16, DP_UNIT + SIX),
      FORMULA(neighbours_half, STEPS_HALF, DP_UNIT + SIX)}, METHOD_WHOLE, 56, "1", 0,
     "", .run = neighbours32_run, .coarse = "curvature"},
    {METHOD_INTERVAL, "bound",
     "the separation that the binary32 pipeline guarantees, compared with the longest interval",
     {FORMULA(bound_claim, 0, 0), FULL(0x1.01p-40)}, PIPELINE, 100, "1", PIPELINE_INPUTS,
     "depthprec(7)", .run = bound_run, .coarse = "margin"},
    {METHOD_INTERVAL, "simulation",
     "the longest interval from 256 seeded depths of the binary32 pipeline near z: never too long",
     {FULL(1), FULL(EXACT)}, PIPELINE | METHOD_BELOW, 50000, "samples", PIPELINE_INPUTS,
     "", .run = simulation_run, .coarse = "samples"},
    {METHOD_INTERVAL, "census", "every depth of the binary32 pipeline near z",
     {FULL(EXACT), FULL(EXACT)}, PIPELINE, 60000, "depths", PIPELINE_INPUTS,
     "depthprec(7)", .run = census_at},
};
/* clang-format on */
static const size_t method_count = sizeof methods / sizeof methods[0];

static bool interval_error_at(const method_call *c, size_t i, method_error *error) {
    const dp_setup *setup = c->setup;
    const double z = c->in->z[i];
    double want, lo, hi;
    bool cut = false;
    if ((c->row->domain & METHOD_PIPELINE) != 0) {
        dp_budget b;
        if (dp_budget_at(setup, z, NULL, &b) != DP_OK || !(z + b.separation <= setup->spec.zfar))
            return false; /* nothing in view lies behind it */
        if (!truth_window(setup, z, &lo, &hi))
            return false; /* too long for a scan */
        want = truth_longest(setup, lo, hi, truth_step(z));
    } else {
        want = truth_width(setup, dp_code(setup, z), &cut);
    }
    if (cut && (c->row->domain & METHOD_WHOLE) != 0)
        return false;
    *error = truth_error(c->row, c->out->value[i], want);
    return true;
}

const method_family_row interval_family = {
    .name = "interval",
    .summary = "z-fighting interval at an eye depth",
    .measure = "relative error",
    .cases = {{"unorm24 d3d", "unorm24", DP_MAPPING_D3D, false},
              {"fp32 reversed", "fp32", DP_MAPPING_REVERSED, false},
              {"unorm16 d3d", "unorm16", DP_MAPPING_D3D, false},
              {"fp16 reversed", "fp16", DP_MAPPING_REVERSED, false}},
    .case_count = 4,
    .inputs = 4096,
    .walked = 256,
    .per_decade = 2,
    .besides = METHOD_BESIDE_ORTHO,
    .methods = methods,
    .method_count = &method_count,
    .fill = method_depths,
    .judge = interval_error_at,
    .limit = limit_depths,
};
