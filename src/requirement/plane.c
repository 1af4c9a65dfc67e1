/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "requirement/plane.h"

#include <math.h>

#include "core/elementary.h"
#include "core/engine.h"

/*
 * RUN binary32 values in a row stand for a place: one of them passes where about every RUNth does. REGION of them are
 * a part in a thousand; LOOKS bounds how often it is begun again because a value in it passes.
 */
enum {
    RUN = 32,
    PLACES = 64,
    PLACES_FEW = 12,
    RUN_OF_PLACE = 8,
    RUN_FEW = 4,
    PER_OCTAVE = 16,
    LOOKS = 60000,
    LOOKS_OF_RANGE = 256
};

static const double region = 0x1p-10 + 0x1p-20;
static const double farthest = 1e18; /* of the finite fars */

typedef struct hunt {
    const solve_problem *problem;
    plane_answer *out;
    double outer, inner; /* the ends of the island looked at: the answer is as near to `outer` as can be */
    bool inward_is_up;
    plane_effort effort;
    double failed; /* the innermost value tried that failed; NaN while there is none */
} hunt;

static judgement reached_at(const solve_problem *p, double value) {
    dp_setup setup;
    if (solve_setup(p, value, &setup) != DP_OK)
        return (judgement){.value = HUGE_VAL, .z = p->hi};
    return judge(p->kind, &setup, p->lo, p->hi, p->limit);
}

/* ---- Binary32 values between the ends ---------------------------------------------------------------------------- */

static bool is_inside(const hunt *h, double x) {
    return x >= fmin(h->outer, h->inner) && x <= fmax(h->outer, h->inner);
}

static double step(const hunt *h, double x, bool inward) {
    const bool up = inward == h->inward_is_up;
    const float next = (float)x;
    if (up ? (double)next > x : (double)next < x)
        return (double)next;
    return (double)nextafterf(next, up ? HUGE_VALF : 0.0F);
}

/* The first of `count` values from x inwards that passes, x itself among them; NaN when none does. */
static double first_of_run(const hunt *h, double x, int count) {
    for (int i = 0; i < count && is_inside(h, x); i++, x = step(h, x, true))
        if (plane_passes(h->problem, x))
            return x;
    return (double)NAN;
}

/* ---- A bracket: a place where none passes, and a value farther in that does -------------------------------------- */

/* From the outer end inwards, at distances that grow: 1 %, 2 %, 4 %, ... */
static double gallop(const hunt *h, double *fails) {
    double ratio = 1.01;
    for (double x = h->outer;;) {
        *fails = x;
        x = h->inward_is_up ? fmin(x * ratio, h->inner) : fmax(x / ratio, h->inner);
        const double found = first_of_run(h, x, RUN);
        if (!isnan(found) || x == h->inner)
            return isnan(found) && plane_passes(h->problem, h->inner) ? h->inner : found;
        ratio = fmin(ratio * ratio, 0x1p64);
    }
}

/* What that leapt over: from the inner end outwards, in small steps. */
static double comb(const hunt *h, double *fails) {
    const double ratio = dp_exp2(h->inward_is_up ? -1.0 / PER_OCTAVE : 1.0 / PER_OCTAVE);
    double found = (double)NAN;
    for (double x = h->inner; is_inside(h, x); x *= ratio) {
        const double here = first_of_run(h, x, RUN_OF_PLACE);
        *fails = x;
        if (isnan(here) && !isnan(found))
            return found;
        if (!isnan(here))
            found = here;
    }
    *fails = h->outer;
    return found;
}

/* Between a place where none passes and a value that does: where the passing begin. */
static double narrow(const hunt *h, double fails, double passes, int run) {
    const double least = RUN * 0x1p-23;
    while (fabs(passes / fails - 1.0) > least) {
        const double middle = sqrt(passes) * sqrt(fails);
        const double found = first_of_run(h, (double)(float)middle, run);
        if (isnan(found))
            fails = middle;
        else if (fabs(found - fails) < fabs(passes - fails))
            passes = found;
        else
            break;
    }
    return passes;
}

/* ---- The values beyond the answer, and on its safe side ---------------------------------------------------------- */

/* Every binary32 value for a part in a thousand outwards. One that passes is the better answer: then again from it. */
static void look_beyond(hunt *h) {
    plane_answer *a = h->out;
    double x = a->value;
    double last = x;
    dp_setup setup;
    for (int looks = 0, ranges = 0; looks < LOOKS && ranges < LOOKS_OF_RANGE; looks++) {
        x = step(h, x, false);
        if (h->problem->lo < h->problem->hi && solve_setup(h->problem, x, &setup) == DP_OK)
            ranges += !plane_fails_at_ends(h->problem, &setup); /* decided inside: thousands of these are too many */
        if (!is_inside(h, x)) {                                 /* the lattice fails from there on */
            a->certain = true;
            a->fails_to = last < a->value || last > a->value ? last : (double)NAN;
            return;
        }
        if (plane_passes(h->problem, x)) {
            a->value = x;
        } else if (fabs(x - a->value) >= region * a->value) {
            a->certain = true;
            a->fails_to = x;
            return;
        }
        last = x;
    }
}

/* The passing end of the values around the inner end: where places begin to have none that passes. */
static double other_end(const hunt *h, double passes, double fails) {
    hunt outwards = *h;
    outwards.inward_is_up = !h->inward_is_up;
    return narrow(&outwards, fails, passes, RUN_OF_PLACE);
}

/* @return whether any of them passes */
static bool try_run(hunt *h, double x, int count) {
    plane_answer *a = h->out;
    bool any = false;
    for (int i = 0; i < count && is_inside(h, x); i++, x = step(h, x, true)) {
        const bool good = plane_passes(h->problem, x);
        a->tried++;
        a->passed += good;
        any = any || good;
        if (!good)
            h->failed = x;
        if (!good)
            a->steady = (double)NAN;
        else if (isnan(a->steady))
            a->steady = x;
    }
    return any;
}

/* Between the innermost value that failed and the next one tried that passes, with all beyond it. */
static void refine_steady(const hunt *h, double failed) {
    plane_answer *a = h->out;
    while (fabs(a->steady / failed - 1.0) > 0.001) {
        double x = (double)(float)(sqrt(a->steady) * sqrt(failed));
        const double middle = x;
        int i = 0;
        for (; i < RUN && plane_passes(h->problem, x); i++)
            x = step(h, x, true);
        if (i == RUN)
            a->steady = middle;
        else
            failed = x;
    }
}

/* Places from the answer to the inner end: where the passing values end, and from where on none fails. */
static void survey(hunt *h) {
    plane_answer *a = h->out;
    const bool range = h->problem->lo < h->problem->hi;
    const bool find = h->effort == PLANE_FIND;
    const int places = (find || range ? PLACES_FEW : PLACES) / (find && range ? 2 : 1);
    const int run = find && range ? 1 : find || range ? RUN_FEW : RUN_OF_PLACE;
    const double from = isinf(a->value) ? farthest : a->value;
    a->steady = a->value;
    try_run(h, from, places);
    plane_answer kept = *a;
    double failed = h->failed;
    double good = from;
    double bad = (double)NAN; /* the first place behind `good` where none passes */
    for (int i = 1; i <= places; i++) {
        const double x = i == places ? h->inner : (double)(float)(from * dp_pow(h->inner / from, (double)i / places));
        if (try_run(h, x, i == places ? 1 : run)) {
            kept = *a;
            failed = h->failed;
            good = x;
            bad = (double)NAN;
        } else if (isnan(bad)) {
            bad = x;
        }
    }
    *a = kept;
    if (!find && !isnan(failed) && !isnan(a->steady) && isfinite(a->steady))
        refine_steady(h, failed);
    a->until = isnan(bad) ? h->inner : other_end(h, good, bad);
}

/* ---- The value from which on all pass for certain ---------------------------------------------------------------- */

/* Near has no influence at all: what one value does all do. */
static bool is_inert(const solve_problem *p) {
    const dp_mapping_row *mapping = dp_mapping_get(p->spec.mapping);
    return p->unknown == SOLVE_NEAR && !p->spec.ortho && mapping->curve != DP_CURVE_PERSPECTIVE &&
           !mapping->log_from_near && !mapping->log_over_near;
}

/* Whether all values between two that pass in the lattice do, the outer one first. */
static bool all_pass(const solve_problem *p, double outer, double inner) {
    dp_setup one, other;
    return solve_setup(p, outer, &one) == DP_OK && solve_setup(p, inner, &other) == DP_OK &&
           dp_separation_within(&one, &other, p->lo, p->hi, p->limit);
}

/* A value moved outwards by a ratio, at most to the answer; of fars, past the finite ones. */
static double outwards(const hunt *h, double x, double ratio) {
    const double end = h->out->value;
    if (h->inward_is_up)
        return fmax(x / ratio, end);
    return x * ratio > farthest ? end : fmin(x * ratio, end);
}

/* From a value outwards, in stretches as long as can be shown to pass, to where the shortest cannot. */
static double reach_from(const hunt *h, double start) {
    static const double shortest = 1.0 + 0x1p-13;
    double end = start;
    for (double ratio = 2.0; end != h->out->value && ratio > shortest;) {
        const double x = outwards(h, end, ratio);
        const bool all = all_pass(h->problem, x, end);
        end = all ? x : end;
        ratio = all ? fmin(ratio * ratio, 0x1p64) : sqrt(ratio);
    }
    return end;
}

/* The inner end is where values begin to fail, too, so the bound may begin to hold a little before it. */
static void prove(const hunt *h) {
    enum { HOPS = 12 };
    plane_answer *a = h->out;
    double start = a->until;
    for (int hop = 0; hop < HOPS && !a->proven; hop++) {
        const double end = reach_from(h, start);
        a->proven = end != start || a->until == a->value;
        if (a->proven) {
            a->chosen = end;
            a->until = start;
        }
        start = outwards(h, start, 1.0 + dp_power2(hop - 10));
    }
}

static void choose(const hunt *h) {
    plane_answer *a = h->out;
    a->chosen = isnan(a->steady) ? a->value : a->steady;
    if (is_inert(h->problem))
        a->proven = true;
    else
        prove(h);
    if (a->proven && a->chosen == a->value)
        a->tried = a->passed = 0;
}

/* ---- The model's answer, inside the lattice's -------------------------------------------------------------------- */

static bool hunt_island(hunt *h, const solve_island *island) {
    plane_answer *a = h->out;
    h->outer = h->inward_is_up ? island->lo : island->hi;
    h->inner = h->inward_is_up ? island->hi : island->lo;
    if (plane_passes(h->problem, h->outer)) { /* nothing beyond it passes even in the lattice */
        a->value = h->outer;
        a->certain = true;
    }
    if (isinf(h->outer))
        h->outer = farthest;
    if (!a->certain) {
        double fails;
        double passes = gallop(h, &fails);
        if (isnan(passes))
            passes = comb(h, &fails);
        if (isnan(passes))
            return false;
        a->value = narrow(h, fails, passes, RUN);
        if (h->effort == PLANE_PROVE)
            look_beyond(h);
    }
    a->possible = true;
    a->until = h->inner;
    survey(h);
    choose(h);
    return true;
}

/* The lattice's answer in the model exact: all from `value` to `until` pass, and the next double fails. */
static void answer_of_lattice(const solve_problem *p, const solve_result *lattice, plane_answer *a) {
    a->possible = lattice->possible;
    a->value = a->steady = lattice->value;
    a->until = lattice->until;
    a->certain = lattice->possible;
    const double sign = a->until >= a->value ? 1.0 : -1.0;
    for (double share = 0x1p-52; a->possible && share < 0x1p-36; share *= 2.0) {
        const bool passes = plane_passes(p, a->value);
        if (passes && plane_passes(p, a->until))
            break;
        *(passes ? &a->until : &a->value) *=
            1.0 + (passes ? -sign : sign) * share; /* the bound over a range is outward */
    }
    a->steady = a->value;
}

/* Nothing was found although the lattice has an answer: the inner end of its answer comes near. */
static void nearest_miss(const solve_problem *p, const solve_result *lattice, plane_answer *a) {
    a->value = a->until = a->steady = lattice->possible ? lattice->until : lattice->value;
    a->certain = !lattice->possible || is_inert(p);
}

dp_status plane_solve(const solve_problem *problem, plane_effort effort, solve_result *lattice, plane_answer *out) {
    if (problem == NULL || lattice == NULL || out == NULL)
        return DP_ERROR_NULL;
    if (problem->kind == MEASURE_ERROR && problem->spec.model == DP_MODEL_FLOAT &&
        dp_mapping_get(problem->spec.mapping)->curve != DP_CURVE_LOG)
        return DP_ERROR_MODEL;
    solve_problem exact = *problem;
    exact.spec.model = DP_MODEL_EXACT;
    dp_status status = solve(&exact, lattice);
    if (status != DP_OK)
        return status;
    dp_setup setup;
    status = solve_setup(problem, lattice->value, &setup);
    if (status != DP_OK)
        return status;
    *out = (plane_answer){.fails_to = (double)NAN};
    hunt h = {.problem = problem,
              .out = out,
              .inward_is_up = problem->unknown == SOLVE_NEAR,
              .effort = effort,
              .failed = (double)NAN};
    if (problem->kind == MEASURE_ERROR) {
        plane_error_solve(problem, lattice, out);
    } else if (problem->spec.model == DP_MODEL_EXACT) {
        answer_of_lattice(problem, lattice, out);
    } else {
        for (int i = lattice->island_count; i-- > 0 && !out->possible;)
            hunt_island(&h, &lattice->islands[i]);
        if (!out->possible)
            nearest_miss(problem, lattice, out);
    }
    if (!out->possible || problem->kind == MEASURE_ERROR || problem->spec.model == DP_MODEL_EXACT) {
        out->chosen = out->value;
        out->proven = out->possible && out->tried == 0;
    }
    out->reached = reached_at(problem, out->chosen);
    return DP_OK;
}
