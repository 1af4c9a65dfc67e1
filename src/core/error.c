/* SPDX-License-Identifier: MIT */
/* The largest error of a depth that is computed in binary32, stored and decoded. */
#include "core/demand.h"
#include "core/engine.h"
#include "core/extremes.h"
#include "core/rounding.h"

/* Errors of a span of depths, by the shader of a logarithm or by a pipeline. */
typedef struct computed {
    const dp_setup *setup;
    union {
        dp_chain chain;
        dp_log_shader shader;
    };
    double a, b; /* what rounding A and B changed them by */
} computed;

static computed computed_of(const dp_setup *setup) {
    computed c = {.setup = setup};
    dp_pipeline pipeline;
    if (setup->curve == DP_CURVE_LOG) {
        c.shader = dp_log_shader_make(setup, dp_log2_get(0));
        return c;
    }
    dp_pipeline_init(&pipeline, setup);
    c.chain = dp_chain_make(setup, &pipeline);
    dp_pipeline_rounded(setup, &c.a, &c.b);
    return c;
}

/* How far the stored value may be from d. Clamped to [0, 1] a window depth only comes nearer to it. */
static double window_error(const computed *m, dp_span r) {
    const dp_chain *c = &m->chain;
    const double w1 = c->pipeline.ortho ? 1.0 : r.lo;
    const double w2 = c->pipeline.ortho ? 1.0 : r.hi;
    const double size = larger(fabs(r.lo), fabs(r.hi));
    const double unknown =
        0x1p-50 * larger(fabs(c->a) * fabs(r.lo) / w1, fabs(c->a) * size / w2) + 0x1p-50 * fabs(c->b) / w1;
    const double entries = larger(fabs(m->a * r.lo + m->b) / w1, fabs(m->a * r.hi + m->b) / w2);
    const double full = dp_chain_steps(c, r).full;
    const double high = larger(dp_chain_window(c, r.lo), dp_chain_window(c, r.hi)) + full;
    return (full + c->half * (entries + unknown) + c->ends_off + dp_stored_error(&c->pipeline, high)) * DP_OUTWARD;
}

/* The decoded depth lies between the planes, and is nearer to the eye by no more than it may lie behind. */
static double pipeline_error(const computed *m, dp_span r) {
    const double error = window_error(m, r);
    const double ahead = dp_curve_ahead(m->setup, error, 1.0, r.hi);
    const double before = fabs(dp_curve_ahead(m->setup, -error, 1.0, r.hi));
    const double behind = smaller(ahead, m->setup->spec.zfar - r.lo);
    const double moved = larger(behind, smaller(before, r.hi - m->setup->spec.znear));
    return moved * DP_OUTWARD + dp_depth_rounding(larger(fabs(r.lo), fabs(r.hi)));
}

/* Outward from what enters: GCC 12 forgets to round a pair of ends to nearest where it makes one vector of them. */
static double error_in(const computed *m, double lo, double hi) {
    const dp_span r = {(double)dp_float_down(lo), (double)dp_float_up(hi)};
    if (m->setup->curve == DP_CURVE_LOG)
        return dp_log_shader_error(&m->shader, r);
    return isinf(r.hi) ? HUGE_VAL : pipeline_error(m, (dp_span){dp_flushed_span(r.lo).lo, dp_flushed_span(r.hi).hi});
}

/* Errors grow with z but for steps in what rounds, so the search goes down from hi until nothing nearer can be worse.
 */
static double error_over(const computed *m, double lo, double hi, double *z) {
    static const double stretch = 1.0 + 0x1p-5;
    double worst = 0.0;
    *z = hi;
    for (double top = hi;;) {
        const double next = lo > 0.0 ? top / stretch : top - (hi - lo) * 0x1p-5;
        const double bottom = next > lo && next < top ? next : lo;
        const double error = error_in(m, bottom, top);
        if (error > worst) {
            worst = error;
            *z = top;
        }
        if (bottom <= lo || error_in(m, lo, bottom) <= worst)
            return worst;
        top = bottom;
    }
}

double dp_computed_error_over(const dp_setup *setup, double lo, double hi, double *z) {
    const computed m = computed_of(setup);
    return error_over(&m, lo, hi, z);
}

double dp_shader_error_between(const dp_setup *outer, const dp_setup *inner, double lo, double hi) {
    const computed m = {.setup = outer, .shader = dp_log_shader_between(outer, inner, dp_log2_get(0))};
    double z;
    return error_over(&m, lo, hi, &z);
}
