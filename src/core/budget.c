/* SPDX-License-Identifier: MIT */
#include "depthprec/budget.h"

#include "core/curve.h"
#include "core/demand.h"
#include "core/engine.h"
#include "core/extremes.h"
#include "core/rounding.h"
#include "depthprec/depth.h"

/* Outward by more than the rounding of this file's own arithmetic. */
static const double outward = 1.0 + 0x1p-40;

static const char *const names[DP_CAUSE_COUNT] = {
    [DP_CAUSE_EYE] = "eye",
    [DP_CAUSE_COMPOSITION] = "composition",
    [DP_CAUSE_PROJECTION] = "projection",
    [DP_CAUSE_NDC] = "ndc",
    [DP_CAUSE_INTERPOLATION] = "interpolation",
    [DP_CAUSE_FORMAT] = "format",
    [DP_CAUSE_LINEARIZATION] = "linearization",
};

const char *dp_cause_name(dp_cause cause) {
    return (unsigned)cause < DP_CAUSE_COUNT ? names[cause] : NULL;
}

/*
 * World positions through one binary32 matrix, whose rows of clip z and clip w are A and 1 times the view axis. Each
 * entry is rounded, each product, and three sums in any order: so the products count five times and the constant four.
 * The axis has length 1, so neither |axis . position| nor |axis . camera| exceeds sqrt(3) world.
 */
static double composition_error(const dp_chain *c, double z, double world) {
    if (world <= 0.0)
        return 0.0;
    const double along = 1.7321 * world;
    const double clip = DP_UNIT * (5.0 * fabs(c->a) * along + 4.0 * (fabs(c->a) * along + fabs(c->b)));
    const double w = c->pipeline.ortho ? 0.0 : DP_UNIT * 9.0 * along; /* times |ndc|, at most 1 */
    return c->half * (clip + w) / (c->pipeline.ortho ? 1.0 : z) * (1.0 + 0x1p-16);
}

/*
 * Reading back in binary32, as window depth: z = 1/(zb d + wb), or n + (f - n) d when orthographic. Each constant is
 * rounded once, d is converted once, then product, sum and reciprocal; errors are relative to the terms of the sum.
 */
static double linearization_error(const dp_setup *setup, const dp_chain *c, double z) {
    const double n = setup->spec.znear;
    const double f = setup->spec.zfar;
    if (c->pipeline.ortho) {
        const double start = setup->reversed ? f : n;
        return DP_UNIT * (3.0 * fabs(z - start) + start + z) / (f - n) * outward;
    }
    const double start = setup->reversed ? 1.0 / f : 1.0 / n;
    const double relative = DP_UNIT * ((3.0 * fabs(1.0 / z - start) + start) * z + 2.0) * outward;
    return relative * c->half * fabs(c->b) / z;
}

/* The longest interval of binary32 depths, in whole steps of the nearer one: they lie on no other distances. */
static double whole_steps(double longest, double z) {
    const double step = 2.0 * dp_half_ulp(z);
    const double steps = floor(longest / step);
    return steps < 0x1p20 ? steps * step : longest;
}

/* Surfaces are real: each is up to half a step of binary32 away from the depth that enters the pipeline. */
static double eye_rounding(double z, double longest) {
    return isinf(longest) ? 0.0 : dp_half_ulp(z) + dp_half_ulp(z + longest);
}

/* What the lattice alone asks for: no arithmetic before it makes two surfaces easier to tell apart. */
static double lattice_separation(const dp_setup *setup, double z) {
    dp_setup exact = *setup;
    exact.spec.model = DP_MODEL_EXACT;
    return dp_separation(&exact, z);
}

dp_status dp_budget_at(const dp_setup *setup, double z, const dp_budget_terms *terms, dp_budget *out) {
    if (setup == NULL || out == NULL)
        return DP_ERROR_NULL;
    if (!(z >= setup->spec.znear && z <= setup->spec.zfar))
        return DP_ERROR_DEPTH;
    dp_pipeline pipeline;
    const dp_status status = dp_pipeline_init(&pipeline, setup);
    if (status != DP_OK)
        return status;
    *out = (dp_budget){.separation = HUGE_VAL, .window = 1.0};
    const double z1 = (double)(float)z;
    if (isinf(z1))
        return DP_OK;
    const dp_chain c = dp_chain_make(setup, &pipeline);
    double part[DP_CAUSE_COUNT] = {0};
    if (terms != NULL) {
        part[DP_CAUSE_COMPOSITION] = 2.0 * composition_error(&c, z1, terms->world);
        part[DP_CAUSE_INTERPOLATION] = 2.0 * terms->interpolation * DP_UNIT;
        part[DP_CAUSE_LINEARIZATION] = terms->linearize ? 2.0 * linearization_error(setup, &c, z1) : 0.0;
    }
    const double extra = part[DP_CAUSE_COMPOSITION] + part[DP_CAUSE_INTERPOLATION] + part[DP_CAUSE_LINEARIZATION];
    dp_demand d;
    const double longest = whole_steps(dp_demand_longest(&c, (dp_span){z1, z1}, extra, &d), z1);
    const double eye = eye_rounding(z1, longest);
    const double pipeline_needs = (longest + eye) * outward;
    out->separation = larger(pipeline_needs, lattice_separation(setup, z));
    out->window = d.window;
    part[DP_CAUSE_PROJECTION] = d.projection;
    part[DP_CAUSE_FORMAT] = d.format;
    part[DP_CAUSE_NDC] = d.window - extra - d.projection - d.format; /* with what clamping takes */
    for (int i = 0; i < DP_CAUSE_COUNT; i++)
        out->cause[i] = part[i] > 0.0 ? longest * outward * (part[i] / d.window) : 0.0;
    out->cause[DP_CAUSE_EYE] = eye * outward;
    out->cause[DP_CAUSE_FORMAT] += out->separation - pipeline_needs;
    return DP_OK;
}

/*
 * The same for a run of depths at once: every rounding at the largest value that it meets anywhere in it. All that the
 * demands are made of rises with the range that they are taken over, so this is a separation of each depth of the run.
 */
double dp_budget_bound(const dp_setup *setup, float nearest, float farthest) {
    dp_pipeline pipeline;
    if (dp_pipeline_init(&pipeline, setup) != DP_OK || isinf(farthest))
        return HUGE_VAL;
    const dp_chain c = dp_chain_make(setup, &pipeline);
    const dp_span run = {(double)nearest, (double)farthest};
    dp_demand d;
    const double longest = whole_steps(dp_demand_longest(&c, run, 0.0, &d), run.hi);
    return (longest + eye_rounding(run.hi, longest)) * outward;
}

dp_status dp_code_range(const dp_setup *setup, double z, uint32_t *lowest, uint32_t *highest) {
    if (setup == NULL || lowest == NULL || highest == NULL)
        return DP_ERROR_NULL;
    if (!(z >= setup->spec.znear && z <= setup->spec.zfar) || isinf(z))
        return DP_ERROR_DEPTH;
    dp_pipeline pipeline;
    const dp_status status = dp_pipeline_init(&pipeline, setup);
    if (status != DP_OK)
        return status;
    const dp_chain c = dp_chain_make(setup, &pipeline);
    const dp_span at = {(double)(float)z, (double)(float)z};
    const double error = dp_chain_steps(&c, at).full * outward + 0x1p-149;
    const double g = dp_chain_window(&c, at.lo);
    *lowest = dp_pipeline_convert(&pipeline, nextafterf((float)(g - error), -2.0F));
    *highest = dp_pipeline_convert(&pipeline, nextafterf((float)(g + error), 2.0F));
    return DP_OK;
}
