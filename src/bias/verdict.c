/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bias/verdict.h"

#include <math.h>

#include "core/bits.h"
#include "core/elementary.h"
#include "core/search.h"

const char *bias_answer_name(bias_answer answer) {
    static const char *const names[] = {
        [BIAS_NOT_PROVEN] = "not proven", [BIAS_ENOUGH] = "enough", [BIAS_NOT_ENOUGH] = "not enough"};
    return names[answer];
}

/* ---- What is proven ---------------------------------------------------------------------------------------------- */

/* The goal, with the factor and the clamp of a bias, both towards the camera. */
static bias_goal goal_with(const dp_setup *setup, const bias_state *state, const bias_goal *asked) {
    const double sign = bias_sign(setup), clamp = sign * state->clamp;
    return (bias_goal){.api = state->api,
                       .factor = sign * state->factor,
                       .slope = asked->slope,
                       .gap = asked->gap,
                       .clamp = fmax(clamp, 0.0),
                       .judged = true};
}

/* Where so many units are enough. A constant that leads away from the camera is not judged: r may be as large as the
 * implementation likes. */
static void proven(const dp_setup *setup, const bias_state *state, const bias_goal *asked, bias_verdict *v) {
    const bias_goal goal = goal_with(setup, state, asked);
    const double units = bias_sign(setup) * state->units;
    v->from = v->to = (double)NAN;
    if (units >= 0.0)
        bias_enough_over(setup, &goal, units, v->lo, v->hi, &v->from, &v->to);
}

static bool is_proven(const dp_setup *setup, bias_state state, const bias_goal *asked, bias_verdict v) {
    proven(setup, &state, asked, &v);
    return v.from == v.lo && v.to == v.hi;
}

static const double units_most = 0x1p31; /* beyond what an integer bias can hold */

/* Where some bias is enough, and the least that is. */
static void find_least(const dp_setup *setup, const bias_state *state, const bias_goal *asked, bias_verdict *v,
                       double lo, double hi) {
    const double sign = bias_sign(setup);
    bias_goal goal = goal_with(setup, state, asked);
    double worst;
    goal.clamp = 0.0;
    goal.factor = asked->slope == 0.0 ? bias_factor_least(setup) : fmax(goal.factor, 0.0);
    v->lo = v->hi = v->units = v->factor = (double)NAN;
    if (isinf(goal.factor))
        return;
    bias_enough_over(setup, &goal, units_most, lo, hi, &v->lo, &v->hi);
    if (isnan(v->lo))
        return;
    goal.judged = false;
    const double units =
        v->lo < v->hi ? bias_needed_over(setup, &goal, v->lo, v->hi, &worst) : bias_needed(setup, &goal, v->lo);
    v->units = isfinite(units) ? sign * units + 0.0 : (double)NAN; /* no -0 */
    v->factor = sign * goal.factor + 0.0;
}

/* ---- A witness --------------------------------------------------------------------------------------------------- */

/* A search for a depth at which a bias fails. */
typedef struct search {
    const dp_setup *setup; /* that of surfaces that face the camera, or have one slope */
    const bias_state *state;
    const bias_goal *asked;
    bool apart; /* the layers may be sampled a pixel apart */
    double lo, hi;
    float nearest, farthest; /* window depths of lo and hi, as the hardware has them */
    bias_verdict *found;
} search;

/* Whether the layer, biased in binary32 as it leaves the rasterizer, is stored no nearer than one of depth d; or is
 * brought nearer by less than the gap. */
static bool fails_at(const search *s, float d) {
    const dp_setup *setup = s->setup;
    const dp_format *format = &setup->spec.format;
    const double z = fmin(fmax(dp_eye(setup, (double)d, 1.0 - (double)d), s->lo), s->hi);
    if (setup->reversed ? !(d <= s->nearest && d >= s->farthest) : !(d >= s->nearest && d <= s->farthest))
        return false;
    const double m = bias_window_slope(setup, z, s->asked->slope);
    const double below = (double)(float)((double)d - (s->apart ? m * bias_sign(setup) : 0.0));
    if (!(below >= setup->low && below <= setup->low + setup->span))
        return false;
    const double r = bias_unit_at(s->state->api, format, fmax((double)d, below)).least;
    const double o = bias_offset(s->state, r, m);
    const double sum = fmin(fmax((double)(float)(below + o), 0.0), 1.0); /* some APIs hold it to a depth range, too */
    const uint32_t code = dp_format_encode(format, setup->spec.rounding, (double)d);
    const uint32_t moved = dp_format_encode(format, setup->spec.rounding, sum);
    const bool apart = setup->reversed ? moved > code : moved < code;
    const double gap = s->asked->gap;
    if (apart && !(gap > 0.0 && !(-bias_at(setup, s->state, s->asked->slope, z).shift >= gap * (1.0 - 0x1p-40))))
        return false;
    s->found->z = z;
    s->found->code = (double)code;
    s->found->moved = (double)moved;
    s->found->short_of_gap = apart;
    return true;
}

/* The last depth, away from the camera, that is stored as that of z is: from there the way to another code is longest.
 */
static float end_of_code(const dp_setup *setup, float d) {
    const dp_format *format = &setup->spec.format;
    const uint32_t code = dp_format_encode(format, setup->spec.rounding, (double)d);
    const uint32_t next = setup->reversed ? code - (code > 0) : code + (code < format->code_max);
    dp_edge e = {.holds = (double)d, .fails = (double)(float)dp_format_value(format, next), .single = true};
    for (double x; code != next && dp_edge_between(&e, &x);)
        *(dp_format_encode(format, setup->spec.rounding, x) == code ? &e.holds : &e.fails) = x;
    return (float)e.holds;
}

static bool fails_about(const search *s, double d) {
    const float tried[2] = {(float)d, end_of_code(s->setup, (float)d)};
    for (int i = 0; i < 2; i++)
        for (int off = -2; off <= 2; off++)
            if (fails_at(s, dp_ranked32(dp_rank32(tried[i]) + (uint32_t)off)))
                return true;
    return false;
}

/* Depths between two, evenly by their logarithms. */
static bool fails_between(const search *s, double lo, double hi) {
    enum { TRIED = 256 };
    for (int i = 0; i <= TRIED; i++) {
        const double part = (double)i / TRIED, z = lo > 0.0 ? lo * dp_pow(hi / lo, part) : lo + (hi - lo) * part;
        if (fails_about(s, dp_window(s->setup, fmin(fmax(z, lo), hi))))
            return true;
    }
    return false;
}

/* Where exponents change binary32 numbers are as sparse, for their size, as they come. */
static bool fails_at_powers(const search *s) {
    for (int e = 0; e >= -126; e--)
        if (fails_about(s, ldexp(1.0, e)))
            return true;
    return false;
}

static bool find_witness(const dp_setup *setup, const bias_state *state, const bias_goal *asked, bias_verdict *v,
                         double lo, double hi) {
    const dp_setup facing = dp_setup_facing(setup);
    const bool judged = !isnan(v->lo);
    search s = {.setup = &facing,
                .state = state,
                .asked = asked,
                .apart = setup->spec.triangles.width == 0,
                .lo = judged ? v->lo : fmin(fmax(lo, setup->spec.znear + asked->gap), hi), /* no layer lies nearer */
                .hi = judged ? v->hi : hi,
                .found = v};
    s.nearest = (float)dp_window(setup, s.lo);
    s.farthest = (float)dp_window(setup, s.hi);
    if (isnan(v->from))
        return fails_between(&s, s.lo, s.hi) || fails_at_powers(&s);
    return (v->from > v->lo && fails_between(&s, v->lo, v->from)) ||
           (v->to < v->hi && fails_between(&s, v->to, v->hi)) || fails_at_powers(&s);
}

/* ---- The verdict ------------------------------------------------------------------------------------------------- */

bias_verdict bias_judge(const dp_setup *setup, const bias_state *given, const bias_goal *goal, double lo, double hi) {
    const double none = (double)NAN;
    bias_verdict v = {.z = none, .code = none, .moved = none, .from = none, .to = none};
    /* As a program hands them over: floats, and an integer that no float need hold. */
    const double units = given->api->whole ? given->units : (double)(float)given->units;
    const bias_state held = {given->api, units, (double)(float)given->factor, (double)(float)given->clamp};
    const bias_state *state = &held;
    find_least(setup, state, goal, &v, lo, hi);
    if (!isnan(v.lo))
        proven(setup, state, goal, &v);
    if (!isnan(v.lo) && v.from == v.lo && v.to == v.hi) {
        v.answer = BIAS_ENOUGH;
        return v;
    }
    v.answer = find_witness(setup, state, goal, &v, lo, hi) ? BIAS_NOT_ENOUGH : BIAS_NOT_PROVEN;
    if (isnan(v.lo))
        return v;
    const bias_api next = bias_next(state->api);
    bias_state other = *state;
    other.api = bias_is_open(state->api, &setup->spec.format) ? &next : state->api;
    v.next = is_proven(setup, other, goal, v);
    v.turned = is_proven(setup, (bias_state){state->api, -state->units, -state->factor, -state->clamp}, goal, v);
    v.clamped = is_proven(setup, (bias_state){state->api, state->units, state->factor, 0.0}, goal, v);
    return v;
}

static bias_push pushed_at(const dp_setup *setup, const bias_state *state, double z, bias_push most) {
    const double shift = -bias_at(setup, state, 0.0, z).shift;
    return fabs(shift) > fabs(most.shift) ? (bias_push){shift, z} : most;
}

/* Between two changes of the exponent the shift grows with z: the most is at the end of a binade, from its side. */
bias_push bias_push_over(const dp_setup *setup, const bias_state *state, double lo, double hi) {
    const double inside = setup->reversed ? 1.0 + 0x1p-40 : 1.0 - 0x1p-40; /* times a depth: within the binade below */
    bias_push most = pushed_at(setup, state, lo, (bias_push){.shift = 0.0, .z = lo});
    most = pushed_at(setup, state, hi, most);
    for (int e = -128; e <= 0; e++) {
        const double d = ldexp(1.0, e), z = dp_eye(setup, d, 1.0 - d);
        most = pushed_at(setup, state, fmin(fmax(z, lo), hi), most);
        most = pushed_at(setup, state, fmin(fmax(z * inside, lo), hi), most);
    }
    return most;
}
