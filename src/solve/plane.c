/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/plane.h"

#include <math.h>

#include "core/engine.h"

enum { BOXES_MOST = 4000, STRETCHES_MOST = 1 << 17, STRETCHES_OF_RANGE = 1 << 12 };

static const double near_least = 1e-12, near_most = 1e12, far_most = 1e18, planes_apart = 1e-6;

/* Shares: of boxes that are not divided, in the model exact, in others and there next to the inner end. */
static const double finest = 0x1p-24, coarsest = 0x1p-4, fine = 0x1p-10;
/* Where a bisection ends: next to the end of a code an error moves fast. */
static const double settled[] = {[QUANTITY_SEPARATION] = 1.0 + 0x1p-32, [QUANTITY_ERROR] = 1.0 + 0x1p-38};

typedef struct search {
    const solve_problem *problem;
    plane_answer *out;
    double outer, inner; /* the ends of the values looked at: the answer is as near to `outer` as can be */
    double shortest;     /* share of a box that is not divided */
    int boxes;           /* looked at */
    bool open;           /* of some of them it is not certain that none passes */
    bool met;            /* out->value passes, though the bound shows nothing about others beside it */
    bool aligned;        /* errors as the depths are aligned; else however they are */
} search;

/* ---- One camera -------------------------------------------------------------------------------------------------- */

dp_status solve_setup(const solve_problem *p, double value, dp_setup *out) {
    dp_spec spec = p->spec;
    *(p->unknown == SOLVE_NEAR ? &spec.znear : &spec.zfar) = value;
    return quantity_setup(&spec, out);
}

static quantity_worst reached_at(const solve_problem *p, double value) {
    dp_setup setup;
    if (solve_setup(p, value, &setup) != DP_OK)
        return (quantity_worst){.value = HUGE_VAL, .z = p->hi};
    return quantity_over(p->kind, &setup, p->lo, p->hi, p->limit);
}

/* Over a range the ends are judged first: they are looked at anyhow, and where one fails so does the range. */
bool plane_passes(const solve_problem *p, double value) {
    dp_setup setup;
    if (solve_setup(p, value, &setup) != DP_OK)
        return false;
    if (p->lo < p->hi && p->kind == QUANTITY_SEPARATION &&
        (dp_separation(&setup, p->hi) > p->limit || dp_separation(&setup, p->lo) > p->limit))
        return false;
    return quantity_over(p->kind, &setup, p->lo, p->hi, p->limit).passed;
}

/* ---- All cameras between two ------------------------------------------------------------------------------------- */

/* The largest of the errors that one code has at a depth in any camera of a run: a stored depth moves one way. */
static double error_of_code(const dp_setup *outer, const dp_setup *inner, uint32_t code, double z) {
    const double a = fabs(dp_error(outer, code, z)), b = fabs(dp_error(inner, code, z));
    return fmax(a, b) * (1.0 + DP_ROUNDINGS_510);
}

/*
 * As the depths are aligned: where the last depth has one code in all of the run, or two. Its cell and those in front
 * of it are looked at one by one, each at most from where it begins to where it ends in any camera; in front of them
 * any alignment may be met.
 */
static bool is_aligned(const solve_problem *p, const dp_setup *outer, const dp_setup *inner) {
    enum { CELLS = 4 };
    const double rounding = p->hi * DP_ROUNDINGS_30;
    const uint32_t one = dp_code(outer, p->hi), other = dp_code(inner, p->hi);
    uint32_t code = (one > other) == outer->reversed ? other : one; /* the farther one */
    double end = p->hi;
    if ((one < other ? other - one : one - other) > 1 || error_of_code(outer, inner, one, end) > p->limit ||
        error_of_code(outer, inner, other, end) > p->limit)
        return false;
    for (int i = 0; i < CELLS && p->lo < p->hi; i++) {
        const dp_cell a = dp_cell_of(outer, code), b = dp_cell_of(inner, code);
        if (i > 0 && end - fmin(a.stored, b.stored) + rounding > p->limit)
            return false;
        end = fmin(fmax(a.lo, b.lo), p->hi);
        if (end > p->lo && dp_error_within(outer, inner, p->lo, end, p->limit))
            return true;
        if (fmax(a.stored, b.stored) - fmax(fmin(a.lo, b.lo), p->lo) + rounding > p->limit)
            return false;
        code = dp_code(outer, a.lo * (1.0 - DP_ROUNDINGS_6));
        if (end <= p->lo || dp_code(inner, b.lo * (1.0 - DP_ROUNDINGS_6)) != code)
            return end <= p->lo;
    }
    return p->lo == p->hi;
}

static bool all_pass(const search *s, const dp_setup *outer, const dp_setup *inner) {
    const solve_problem *p = s->problem;
    return s->aligned ? is_aligned(p, outer, inner)
                      : quantity_get(p->kind)->within(outer, inner, p->lo, p->hi, p->limit);
}

/* The same question in the model exact, of surfaces that face the camera: no model has a separation below that. */
static solve_problem in_lattice(const solve_problem *p) {
    solve_problem exact = *p;
    exact.spec.model = DP_MODEL_EXACT;
    exact.spec.triangles.width = 0;
    return exact;
}

/* Whether no plane can pass, by the far end of the range or just before the middle's worst depth: there binades end. */
static bool none_passes(const solve_problem *p, double outer, double inner, double middle) {
    const solve_problem exact = in_lattice(p);
    const int half = p->kind == QUANTITY_ERROR;
    dp_setup one, other;
    if (solve_setup(&exact, outer, &one) != DP_OK || solve_setup(&exact, inner, &other) != DP_OK)
        return false;
    if (dp_lattice_least(&one, &other, p->hi, half) > p->limit)
        return true;
    const double wide = isinf(outer) ? 2.0 : fmax(outer, inner) / fmin(outer, inner);
    return p->lo < p->hi &&
           dp_lattice_least(&one, &other, fmax(reached_at(&exact, middle).z / wide, p->lo), half) > p->limit;
}

/* ---- The uppermost interval -------------------------------------------------------------------------------------- */

static double ratio_of(double a, double b) {
    return fmax(a, b) / fmin(a, b);
}

/* Next to the inner end finer than elsewhere; infinity is not divided from the greatest far. */
static bool is_smallest(const search *s, double outer, double inner) {
    const double distance = 0.25 * (ratio_of(inner, s->inner) - 1.0);
    return ratio_of(outer, inner) - 1.0 <= fmin(s->shortest, fmax(distance, fine)) ||
           (isinf(outer) && inner > 0.5 * far_most);
}

/* Keeps, in case nothing is found, the outermost plane that passes alone, or what comes near. */
static void offer(search *s, double value) {
    const bool by_chance = s->problem->kind == QUANTITY_ERROR && value != s->inner;
    const quantity_worst j = reached_at(s->problem, value);
    if ((j.passed && by_chance) ||
        (s->met ? !j.passed || s->outer > s->inner : !(j.passed || j.value < s->out->reached.value)))
        return;
    s->met = j.passed;
    s->out->value = value;
    s->out->reached = j;
}

/* Between two values the uppermost box of which all pass. One of which none passes is left, others are divided. */
static bool find(search *s, double outer, double inner, double box[2]) {
    const double middle = isinf(outer) ? 2.0 * inner : sqrt(outer) * sqrt(inner);
    dp_setup one, other;
    box[0] = outer;
    box[1] = inner;
    if (s->boxes++ < BOXES_MOST && none_passes(s->problem, outer, inner, middle))
        return false;
    if (s->boxes < BOXES_MOST && solve_setup(s->problem, outer, &one) == DP_OK &&
        solve_setup(s->problem, inner, &other) == DP_OK && all_pass(s, &one, &other))
        return true;
    if (s->boxes < BOXES_MOST && !is_smallest(s, outer, inner))
        return s->outer > s->inner ? find(s, outer, middle, box) || find(s, middle, inner, box)
                                   : find(s, middle, inner, box) || find(s, outer, middle, box);
    s->open = true;
    offer(s, inner);
    return false;
}

/* Goes from a value that passes towards an end, in stretches as long as can be shown to pass. */
static double reach_from(const search *s, double start, double end) {
    const bool up = end > start, outwards = (end == s->outer);
    const int most = s->problem->lo < s->problem->hi ? STRETCHES_OF_RANGE : STRETCHES_MOST;
    double at = start, ratio = 2.0;
    dp_setup here, there;
    if (solve_setup(s->problem, at, &here) != DP_OK)
        return at;
    for (int i = 0; i < most && at != end && ratio > settled[s->problem->kind]; i++) {
        const double step = up ? fmin(at * ratio, end) : fmax(isinf(at) ? far_most : at / ratio, end);
        const double x = up && step > far_most ? end : step;
        const bool all = solve_setup(s->problem, x, &there) == DP_OK &&
                         (outwards ? all_pass(s, &there, &here) : all_pass(s, &here, &there));
        at = all ? x : at;
        if (all)
            here = there;
        ratio = all ? fmin(ratio * ratio, 0x1p64) : sqrt(ratio);
        if (s->aligned) /* the end of each code is a narrow pass between wide ones */
            ratio = all ? fmin(ratio * ratio * ratio * ratio, 0x1p64) : sqrt(ratio);
    }
    return at;
}

/* The answer moved until it passes as `check` judges, whose bound over a range may be a little larger. */
static double judged(const search *s, double value, double towards) {
    for (double share = 0x1p-52; share < 0.5 && !plane_passes(s->problem, value); share *= 2.0)
        value = isinf(value) ? far_most : value + (towards - value) * share;
    return value;
}

/* Whether none passes next beyond the answer. Of a separation the lattice tells; an error jumps with its code. */
static bool none_beyond(const search *s) {
    const double value = s->out->value;
    const double x = s->inner > s->outer ? value * (1.0 - 1e-9) : value * (1.0 + 1e-9);
    const solve_problem p = s->problem->kind == QUANTITY_SEPARATION ? in_lattice(s->problem) : *s->problem;
    return value == s->outer || ratio_of(value, s->outer) <= 1.0 + 1e-9 || !plane_passes(&p, x);
}

/* Near has no influence at all: what one value does all do. */
static bool is_inert(const solve_problem *p) {
    const dp_mapping_row *mapping = dp_mapping_get(p->spec.mapping);
    return p->unknown == SOLVE_NEAR && !p->spec.ortho && mapping->curve != DP_CURVE_PERSPECTIVE &&
           !mapping->log_from_near;
}

static void search_planes(search *s) {
    plane_answer *a = s->out;
    const bool inert = is_inert(s->problem);
    double box[2];
    a->reached.value = HUGE_VAL;
    a->value = s->inner;
    if (isinf(s->outer))
        offer(s, s->outer);
    const bool found = !s->met && !inert && find(s, s->outer, s->inner, box);
    if (!found && !s->met)
        offer(s, s->inner);
    a->possible = found || s->met;
    a->until = a->value;
    a->certain = inert || (!s->open && s->problem->kind == QUANTITY_SEPARATION);
    if (!a->possible) {
        a->reached = reached_at(s->problem, a->value);
        return;
    }
    if (!found)
        box[0] = box[1] = a->value;
    a->until = inert ? s->inner : reach_from(s, box[1], s->inner);
    a->value = inert ? s->outer : reach_from(s, box[0], s->outer);
    s->aligned = s->problem->kind == QUANTITY_ERROR && s->problem->spec.model != DP_MODEL_FLOAT;
    if (s->aligned && !inert) {
        a->until = reach_from(s, a->until, s->inner);
        a->value = reach_from(s, a->value, s->outer);
    }
    a->until = judged(s, a->until, a->value);
    a->value = judged(s, a->value, a->until);
    a->certain = none_beyond(s);
    a->reached = reached_at(s->problem, a->value);
}

/* ---- The door ---------------------------------------------------------------------------------------------------- */

/* The least and the greatest value that make a set-up and leave the depths inside it. */
static dp_status limits(const solve_problem *p, double *least, double *most) {
    dp_setup setup;
    const bool znear = p->unknown == SOLVE_NEAR;
    /* A far plane beyond 1e18 leaves less to near: see setup.h. */
    const double large = isinf(p->spec.zfar) ? 1.0 : fmax(p->spec.zfar / 1e18, 1.0);
    *least = znear ? near_least * large : fmax(fmax(p->hi, p->spec.znear * (1.0 + planes_apart)), near_least);
    *most = znear ? fmin(fmin(p->lo, near_most / large), p->spec.zfar / (1.0 + planes_apart)) : far_most;
    if (!(*least <= *most) || (znear ? p->hi > p->spec.zfar : p->lo < p->spec.znear))
        return DP_ERROR_RANGE;
    double *inner = znear ? most : least;
    for (int i = 0; i < 8 && solve_setup(p, *inner, &setup) == DP_ERROR_PLANES; i++)
        *inner = nextafter(*inner, znear ? 0.0 : HUGE_VAL);
    const dp_status status = solve_setup(p, *inner, &setup);
    if (!znear && solve_setup(p, HUGE_VAL, &setup) == DP_OK)
        *most = HUGE_VAL;
    return status;
}

dp_status plane_solve(const solve_problem *p, plane_answer *out) {
    if (p == NULL || out == NULL)
        return DP_ERROR_NULL;
    if (!quantity_has_model(p->kind, p->spec.model, p->spec.mapping))
        return DP_ERROR_MODEL;
    /* A near plane is looked for among the positive ones; a far one behind the depths, which may begin anywhere. */
    const double first = p->unknown == SOLVE_FAR && p->spec.ortho ? p->hi : p->lo;
    if (!(p->limit > 0.0 && first > 0.0 && p->lo <= p->hi && p->hi < HUGE_VAL))
        return DP_ERROR_RANGE;
    double least, most;
    const dp_status status = limits(p, &least, &most);
    if (status != DP_OK)
        return status;
    const bool znear = p->unknown == SOLVE_NEAR;
    *out = (plane_answer){.least = least, .most = most};
    search s = {.problem = p,
                .out = out,
                .outer = znear ? least : most,
                .inner = znear ? most : least,
                .shortest = p->spec.model == DP_MODEL_EXACT ? finest : coarsest};
    search_planes(&s);
    return DP_OK;
}
