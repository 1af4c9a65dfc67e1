/* SPDX-License-Identifier: MIT */
#include "depthprec/budget.h"

#include "core/composition.h"
#include "core/curve.h"
#include "core/demand.h"
#include "core/elementary.h"
#include "core/engine.h"
#include "core/extremes.h"
#include "core/guarantee.h"
#include "core/rounding.h"
#include "core/triangles.h"
#include "depthprec/depth.h"

static const char *const names[DP_CAUSE_COUNT] = {
    [DP_CAUSE_EYE] = "eye",
    [DP_CAUSE_COMPOSITION] = "composition",
    [DP_CAUSE_PROJECTION] = "projection",
    [DP_CAUSE_ARGUMENT] = "argument",
    [DP_CAUSE_LOG2] = "log2",
    [DP_CAUSE_SCALE] = "scale",
    [DP_CAUSE_NDC] = "ndc",
    [DP_CAUSE_SNAPPING] = "snapping",
    [DP_CAUSE_SETUP] = "set-up",
    [DP_CAUSE_INTERPOLATION] = "interpolation",
    [DP_CAUSE_FORMAT] = "format",
    [DP_CAUSE_LINEARIZATION] = "linearization",
};

const char *dp_cause_name(dp_cause cause) {
    return (unsigned)cause < DP_CAUSE_COUNT ? names[cause] : NULL;
}

/*
 * Reading back in binary32, as window depth: z = 1/(zb d + wb), or n + (f - n) d when orthographic; a depth range is
 * undone by the constants. Each constant is
 * rounded once, d is converted once, then product, sum and reciprocal; errors are relative to the terms of the sum.
 */
static double linearization_error(const dp_setup *setup, const dp_chain *c, double z) {
    const double n = setup->spec.znear;
    const double f = setup->spec.zfar;
    if (c->pipeline.ortho) {
        const double start = setup->reversed ? f + setup->kappa * setup->low : n - setup->kappa * setup->low;
        const double scene = DP_UNIT * (3.0 * fabs(z - start) + fabs(start) + fabs(z));
        return larger(scene, 0x1p-126) / setup->kappa * DP_OUTWARD;
    }
    const double start = setup->reversed ? 1.0 / f - setup->kappa * setup->low : 1.0 / n + setup->kappa * setup->low;
    const double relative = DP_UNIT * ((3.0 * fabs(1.0 / z - start) + fabs(start)) * z + 2.0) * DP_OUTWARD;
    return relative * c->half * fabs(c->b) / z;
}

/* The farthest binary32 depth within `longest` behind one. */
static double last_within(double z, double longest) {
    const double end = z + longest;
    return end < 0x1.fffffep127 ? (double)dp_float_down(end) : end;
}

/* A little behind a depth, or before it. */
static double moved(double z, double share) {
    return isinf(z) ? z : z + fabs(z) * share;
}

double dp_with_lattice(const dp_setup *setup, double z, double needs) {
    if (dp_lattice_is_within(dp_lattice_rate(setup, z), z, needs))
        return needs;
    return larger(needs, isinf(z) ? HUGE_VAL : dp_lattice_exact(setup, z));
}

/* The separation of depths that a composition moves: that of any depth which a surface at z may be moved to. */
static double composed_separation(const dp_setup *setup, const dp_chain *c, const dp_composed *m, double z,
                                  double extra) {
    const double n = setup->spec.znear;
    if (!(m->reach < (n > 0.0 ? z : HUGE_VAL))) /* where depths have either sign no eye is in the way */
        return HUGE_VAL;
    const double first = larger(z - m->reach, moved(smaller(n, z), -0x1p-20));
    dp_demand d;
    const double plain = dp_demand_longest(c, (dp_span){first, z + m->reach}, extra, &d) * DP_OUTWARD;
    const double s = dp_composition_separation(m, z, plain, 0);
    const int clamped = z - m->reach <= moved(n, 0x1p-20) || z + m->reach + s >= moved(setup->spec.zfar, -0x1p-20);
    return clamped ? dp_composition_separation(m, z, plain, 1) : s;
}

static dp_composing composing_of(const dp_setup *setup, const dp_chain *c, const dp_budget_terms *terms) {
    const dp_pipeline *p = &c->pipeline;
    return (dp_composing){.composition = terms->composition,
                          .world = terms->world,
                          .a = c->a,
                          .b = c->b,
                          .zfar = setup->spec.zfar,
                          .reach = larger(fabs(setup->spec.znear), fabs(setup->spec.zfar)),
                          .ray_ratio = 2.0,
                          .ortho = p->ortho,
                          .any_sign = setup->spec.znear <= 0.0,
                          .fused = p->arith->fused,
                          .remap = p->ndc_signed && p->arith->remap};
}

/* The error by which a composition moves the vertices of pixels at a depth. */
static dp_composed_vertex composed_vertex(const dp_guarantee *g, double z, double shared,
                                          const dp_budget_terms *terms) {
    const dp_setup *setup = g->setup;
    const dp_chain *c = &g->chain;
    const dp_triangles *t = &setup->spec.triangles;
    const dp_composed_view view = dp_triangles_view(t, &g->slant);
    dp_composing in = composing_of(setup, c, terms);
    in.ray_ratio = larger(in.ray_ratio, dp_hypot(1.0, dp_hypot(view.ray[0], view.ray[1])));
    const double farthest = dp_triangles_depths(c, (dp_span){z, z}, t, NULL).hi + shared;
    const dp_composed_vertex v = dp_composition_vertex(&in, &view, farthest);
    return dp_composition_vertex(&in, &view, farthest + 2.0 * (v.position + v.along)); /* as it is when moved */
}

/*
 * Slanted triangles, moved as said (null: not at all), and by up to `shared` all alike. The nearer one may be read back
 * anywhere between its vertices.
 */
static void add_triangles(const dp_guarantee *g, double z, double shared, const double asked[DP_CAUSE_COUNT],
                          const dp_composed_vertex *moved, dp_budget *out) {
    const dp_chain *c = &g->chain;
    dp_triangles class = g->setup->spec.triangles;
    const dp_triangles *t = &class;
    const dp_span at = {z - shared, z + shared};
    const double vertex = z / t->depth - shared;
    if (!(vertex > 0.0)) {
        *out = (dp_budget){.separation = HUGE_VAL, .window = 1.0};
        return;
    }
    if (shared > 0.0)
        class.depth = at.lo / vertex;
    const double nearest = dp_triangles_depths(c, at, t, moved).lo;
    double part[DP_CAUSE_COUNT] = {0};
    part[DP_CAUSE_INTERPOLATION] = asked[DP_CAUSE_INTERPOLATION];
    part[DP_CAUSE_LINEARIZATION] = asked[DP_CAUSE_LINEARIZATION];
    if (part[DP_CAUSE_LINEARIZATION] > 0.0 && nearest > 0.0)
        part[DP_CAUSE_LINEARIZATION] =
            larger(part[DP_CAUSE_LINEARIZATION], 2.0 * linearization_error(g->setup, c, nearest));
    dp_triangles_add(c, at, t, &g->slant, part, moved, out);
}

/* Do places come from a world. */
static int is_moved(const dp_budget_terms *terms) {
    return terms->world > 0.0 || terms->displaced.own > 0.0 || terms->displaced.shared > 0.0;
}

/* A composition whose errors of view z are known already. */
static dp_composed displaced_by(const dp_displaced *d) {
    return (dp_composed){.own = d->own, .shared = d->shared, .loss = d->turn, .reach = d->own + d->shared};
}

static dp_composed_vertex displaced_vertex(const dp_displaced *d) {
    return (dp_composed_vertex){.position = 1.7320509 * d->own, .turn = 4.0 * d->turn};
}

/* World positions: what their separation is more than without, that of `plain`, is the composition's part. */
static void add_composition(const dp_guarantee *g, double z, const dp_budget_terms *terms,
                            const double asked[DP_CAUSE_COUNT], const dp_budget *plain, dp_budget *out) {
    const dp_setup *setup = g->setup;
    const dp_chain *c = &g->chain;
    const dp_composing in = composing_of(setup, c, terms);
    const double extra = asked[DP_CAUSE_INTERPOLATION] + asked[DP_CAUSE_LINEARIZATION];
    /* As below: first a separation from all that is behind, then from what is nearer than that. */
    double separation = HUGE_VAL;
    double until = HUGE_VAL;
    double shared = 0.0;
    for (double before = HUGE_VAL; isinf(before) || separation < 0.97 * before;) {
        before = separation;
        const dp_composed m = terms->world > 0.0 ? dp_composition_at(&in, z, until) : displaced_by(&terms->displaced);
        separation = smaller(separation, composed_separation(setup, c, &m, z, extra));
        shared = m.shared;
        if (isinf(separation))
            break;
        until = smaller(z + separation, setup->spec.zfar);
    }
    separation = larger(separation, out->separation);
    const double slope = c->half * (c->pipeline.ortho ? fabs(c->a) * separation : fabs(c->b));
    out->window = c->pipeline.ortho ? slope : slope / z * (isinf(separation) ? 1.0 : separation / (z + separation));
    out->separation = separation;
    if (setup->spec.triangles.width != 0) {
        const dp_composed_vertex moved =
            terms->world > 0.0 ? composed_vertex(g, z, shared, terms) : displaced_vertex(&terms->displaced);
        add_triangles(g, z, shared, asked, &moved, out);
    }
    const double part = out->separation - plain->separation;
    for (int i = 0; i < DP_CAUSE_COUNT; i++)
        out->cause[i] = plain->cause[i];
    out->cause[DP_CAUSE_COMPOSITION] = part > 0.0 ? part : 0.0; /* infinity less infinity too */
}

/* Refuses terms that have no budget, or none with this set-up. */
static dp_status check_terms(const dp_setup *setup, const dp_budget_terms *terms) {
    const int logarithmic = setup->curve == DP_CURVE_LOG;
    if (logarithmic && setup->spec.triangles.width != 0)
        return DP_ERROR_MODEL;
    if (terms == NULL)
        return DP_OK;
    if (dp_composition_get(terms->composition) == NULL || dp_log2_get(terms->log2) == NULL)
        return DP_ERROR_MODEL;
    return logarithmic && (is_moved(terms) || terms->linearize) ? DP_ERROR_MODEL : DP_OK;
}

/* A separation of surfaces whose binary32 depths may be `longest` apart and out of order, and its parts, which are
 * shares of the window depth that the pair must differ by. */
static void share_out(const dp_guarantee *g, double z, double longest, double window, const double part[DP_CAUSE_COUNT],
                      dp_budget *out) {
    const double z1 = (double)(float)z;
    const double apart = last_within(z1, longest) - z1;
    const double eye = dp_eye_rounding(z1, z1 + apart);
    const double pipeline_needs = (apart + eye) * DP_OUTWARD;
    out->separation = dp_with_lattice(g->setup, z, pipeline_needs);
    out->window = window;
    for (int i = 0; i < DP_CAUSE_COUNT; i++)
        out->cause[i] = part[i] > 0.0 ? apart * DP_OUTWARD * (part[i] / window) : 0.0;
    out->cause[DP_CAUSE_EYE] = eye * DP_OUTWARD;
    out->cause[DP_CAUSE_FORMAT] += out->separation > pipeline_needs ? out->separation - pipeline_needs : 0.0;
}

/* The budget of a depth that a pipeline computes from its matrix. */
static void matrix_budget(const dp_guarantee *g, double z, const dp_budget_terms *terms, dp_budget *out) {
    const dp_setup *setup = g->setup;
    const dp_chain *c = &g->chain;
    const double z1 = (double)(float)z;
    double part[DP_CAUSE_COUNT] = {0};
    if (terms != NULL) {
        part[DP_CAUSE_INTERPOLATION] = 2.0 * terms->interpolation * DP_UNIT;
        part[DP_CAUSE_LINEARIZATION] = terms->linearize ? 2.0 * linearization_error(setup, c, z1) : 0.0;
    }
    const double extra = part[DP_CAUSE_INTERPOLATION] + part[DP_CAUSE_LINEARIZATION];
    dp_demand d;
    const double longest = dp_demand_longest(c, dp_flushed_span(z1), extra, &d);
    part[DP_CAUSE_PROJECTION] = d.projection;
    part[DP_CAUSE_FORMAT] = d.format;
    part[DP_CAUSE_NDC] = d.window - extra - d.projection - d.format; /* with what clamping takes */
    share_out(g, z, longest, d.window, part, out);
    dp_budget plain = *out;
    if (setup->spec.triangles.width != 0)
        add_triangles(g, z, 0.0, part, NULL, &plain);
    if (terms != NULL && is_moved(terms))
        add_composition(g, z, terms, part, &plain, out);
    else
        *out = plain;
}

/* The budget of a logarithmic depth that a shader writes. */
static void log_budget(const dp_guarantee *g, double z, const dp_budget_terms *terms, dp_budget *out) {
    const double extra = terms != NULL ? 2.0 * terms->interpolation * DP_UNIT : 0.0;
    dp_log_demand d;
    const double longest = dp_log_longest(&g->shader, (dp_span){(double)(float)z, (double)(float)z}, extra, &d);
    const double part[DP_CAUSE_COUNT] = {
        [DP_CAUSE_ARGUMENT] = d.argument, [DP_CAUSE_LOG2] = d.log2,         [DP_CAUSE_SCALE] = d.scale,
        [DP_CAUSE_NDC] = d.ndc,           [DP_CAUSE_INTERPOLATION] = extra, [DP_CAUSE_FORMAT] = d.format};
    share_out(g, z, longest, d.window, part, out);
}

int dp_counts_steps(const dp_setup *setup) {
    dp_pipeline pipeline;
    return setup->curve != DP_CURVE_LOG && dp_pipeline_init(&pipeline, setup) == DP_OK &&
           dp_chain_make(setup, &pipeline).few_steps;
}

/* The guarantee of a mapping whose depth is computed. */
static dp_guarantee guarantee_of(const dp_setup *setup, const dp_log2_row *log2) {
    dp_guarantee g;
    g.setup = setup;
    g.computed = 1;
    if (setup->curve == DP_CURVE_LOG) {
        g.shader = dp_log_shader_make(setup, log2);
        return g;
    }
    dp_pipeline pipeline;
    dp_pipeline_init(&pipeline, setup);
    g.chain = dp_chain_make(setup, &pipeline);
    if (setup->spec.triangles.width != 0)
        g.slant = dp_slant_make(&setup->spec.triangles);
    return g;
}

dp_guarantee dp_guarantee_make(const dp_setup *setup) {
    return dp_is_computed(setup) ? guarantee_of(setup, dp_log2_get(0)) : (dp_guarantee){.setup = setup};
}

/* Normal numbers of one sign, or 0 both of them. */
static int are_alike(float x, float y) {
    return (x == 0.0F && y == 0.0F) || ((x < 0.0F) == (y < 0.0F) && fabsf(x) >= 0x1p-126F && fabsf(y) >= 0x1p-126F);
}

int dp_guarantee_between(const dp_setup *outer, const dp_setup *inner, dp_guarantee *out) {
    dp_pipeline pipeline;
    *out = (dp_guarantee){.setup = outer, .computed = dp_is_computed(outer)};
    if (outer->shader)
        out->shader = dp_log_shader_between(outer, inner, dp_log2_get(0));
    if (outer->shader || !out->computed)
        return 1;
    const int infinite = isinf(outer->spec.zfar);
    if (dp_pipeline_init(&pipeline, outer) != DP_OK || !are_alike(outer->matrix[1], inner->matrix[1]) ||
        outer->matrix[1] == 0.0F || !(infinite || are_alike(outer->matrix[0], inner->matrix[0])))
        return 0;
    out->chain = dp_chain_between(outer, inner, &pipeline);
    if (outer->spec.triangles.width > 0)
        out->slant = dp_slant_make(&outer->spec.triangles);
    return 1;
}

/* `out` is what it is at infinity where there is no binary32 depth. */
static void budget_of(const dp_guarantee *g, double z, const dp_budget_terms *terms, dp_budget *out) {
    *out = (dp_budget){.separation = HUGE_VAL, .window = 1.0};
    if (!isinf((float)z))
        (g->setup->curve == DP_CURVE_LOG ? log_budget : matrix_budget)(g, z, terms, out);
}

double dp_guarantee_at(const dp_guarantee *g, double z) {
    dp_budget budget;
    if (isinf(z))
        return HUGE_VAL;
    if (!g->computed)
        return dp_lattice_separation(g->setup, z);
    if (!(z >= g->setup->spec.znear && z <= g->setup->spec.zfar))
        return HUGE_VAL;
    budget_of(g, z, NULL, &budget);
    return budget.separation;
}

dp_status dp_budget_at(const dp_setup *setup, double z, const dp_budget_terms *terms, dp_budget *out) {
    if (setup == NULL || out == NULL)
        return DP_ERROR_NULL;
    if (!(z >= setup->spec.znear && z <= setup->spec.zfar))
        return DP_ERROR_DEPTH;
    const dp_mapping_row *row = dp_mapping_get(setup->spec.mapping);
    if (check_terms(setup, terms) != DP_OK || row->curve == DP_CURVE_LINEAR)
        return DP_ERROR_MODEL;
    if (isinf((float)z) && !isinf(z))
        return DP_ERROR_BINARY32;
    const dp_guarantee g = guarantee_of(setup, dp_log2_get(terms != NULL ? terms->log2 : 0));
    budget_of(&g, z, terms, out);
    return DP_OK;
}

/*
 * The separation of surfaces whose binary32 depths may be `longest` apart and out of order: of all of a run, and of
 * those behind it, what is apart is apart by whole steps. Towards 0 they shrink.
 */
static double apart_over(dp_span run, double longest) {
    const double nearest_to_0 = larger(larger(run.lo, -(run.hi + longest)), 0.0);
    const double step = 2.0 * dp_half_ulp(nearest_to_0);
    const double steps = longest < 0x1p45 * step ? floor(longest / step) * step : longest;
    const double whole = smaller(steps, last_within(run.hi, longest) - run.lo);
    return dp_apart_with_eye(run.lo, run.hi, whole) * DP_OUTWARD;
}

/*
 * The same for a run of depths at once: every rounding at the largest value that it meets anywhere in it. All that the
 * demands are made of rises with the range that they are taken over, so this is a separation of each depth of the run.
 */
double dp_guarantee_bound(const dp_guarantee *g, float nearest, float farthest) {
    if (isinf(farthest))
        return HUGE_VAL;
    if (g->setup->curve == DP_CURVE_LOG) {
        const dp_span run = {(double)nearest, (double)farthest};
        dp_log_demand d;
        return apart_over(run, dp_log_longest(&g->shader, run, 0.0, &d));
    }
    const dp_span run = {dp_flushed_span((double)nearest).lo, dp_flushed_span((double)farthest).hi};
    dp_demand d;
    static const double asked[DP_CAUSE_COUNT] = {0};
    dp_budget b = {.separation = apart_over(run, dp_demand_longest(&g->chain, run, 0.0, &d))};
    if (g->setup->spec.triangles.width != 0)
        dp_triangles_add(&g->chain, run, &g->setup->spec.triangles, &g->slant, asked, NULL, &b);
    return b.separation;
}

/* The codes of a window depth that is off by so much. */
static void range_of(const dp_pipeline *p, double low, double high, uint32_t *lowest, uint32_t *highest) {
    *lowest = dp_pipeline_convert(p, nextafterf((float)low, -2.0F));
    *highest = dp_pipeline_convert(p, nextafterf((float)high, 2.0F));
}

dp_status dp_code_range(const dp_setup *setup, double z, uint32_t *lowest, uint32_t *highest) {
    if (setup == NULL || lowest == NULL || highest == NULL)
        return DP_ERROR_NULL;
    if (!(z >= setup->spec.znear && z <= setup->spec.zfar) || isinf(z))
        return DP_ERROR_DEPTH;
    if (isinf((float)z))
        return DP_ERROR_BINARY32;
    const dp_span at = {(double)(float)z, (double)(float)z};
    if (setup->curve == DP_CURVE_LOG) {
        const dp_log_shader s = dp_log_shader_make(setup, dp_log2_get(0));
        const dp_log_steps a = dp_log_shader_steps(&s, at);
        const double off = (a.argument + a.log2) * DP_OUTWARD;
        const double rest = (a.scale + a.ndc) * DP_OUTWARD + 0x1p-149;
        range_of(&s.pipeline, (a.lo - off) * s.k_lo - rest, (a.hi + off) * s.k_hi + rest, lowest, highest);
        return DP_OK;
    }
    dp_pipeline pipeline;
    const dp_status status = dp_pipeline_init(&pipeline, setup);
    if (status != DP_OK)
        return status;
    const dp_chain c = dp_chain_make(setup, &pipeline);
    const double error = dp_chain_steps(&c, at).full * DP_OUTWARD + 0x1p-149;
    const double g = dp_chain_window(&c, at.lo);
    range_of(&pipeline, g - error, g + error, lowest, highest);
    return DP_OK;
}
