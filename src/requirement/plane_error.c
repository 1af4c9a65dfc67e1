/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "requirement/plane.h"

#include <math.h>

#include "core/bits.h"
#include "core/elementary.h"

bool plane_fails_at_ends(const solve_problem *p, const dp_setup *setup) {
    return p->lo < p->hi && p->kind == MEASURE_SEPARATION &&
           (dp_separation(setup, p->hi) > p->limit || dp_separation(setup, p->lo) > p->limit);
}

bool plane_passes(const solve_problem *p, double value) {
    dp_setup setup;
    return solve_setup(p, value, &setup) == DP_OK && !plane_fails_at_ends(p, &setup) &&
           judge(p->kind, &setup, p->lo, p->hi, p->limit).passed;
}

/* Codes that are walked through at most. */
enum { CODES_MOST = 4096 };

/* Positive doubles as integers in their order: `here` passes, and so does all on its safe side; `end` is the last. */
typedef struct walk {
    const solve_problem *problem;
    uint64_t here, end;
    uint64_t stride, before; /* of the last code and the one before it: they tell about that of the next */
    double z;                /* whose codes are walked through */
} walk;

static uint32_t code_at(const walk *w, uint64_t x) {
    dp_setup setup;
    return solve_setup(w->problem, dp_float64(x), &setup) == DP_OK ? dp_code(&setup, w->z) : 0;
}

static uint64_t towards(uint64_t from, uint64_t to, uint64_t by) {
    const uint64_t room = to < from ? from - to : to - from;
    by = by < room ? by : room;
    return to < from ? from - by : from + by;
}

static uint64_t distance(uint64_t a, uint64_t b) {
    return a < b ? b - a : a - b;
}

/* The next stride, and how far off that may be: strides change little and evenly. */
static uint64_t expect(const walk *w, uint64_t *off) {
    const uint64_t change = distance(w->stride, w->before);
    *off = w->before == 0 ? w->stride / 4 + 1 : change / 64 + 1;
    if (w->before == 0 || change > w->stride / 4)
        return w->stride + 1;
    return w->stride > w->before ? w->stride + change : w->stride - change + 1;
}

/*
 * From *in, where z has its code, towards the end: *in keeps the code and *out does not, `gap` apart at most. False
 * where z keeps it up to the end, which *in then is.
 */
static bool bracket(const walk *w, uint64_t gap, uint64_t *in, uint64_t *out) {
    const uint32_t code = code_at(w, *in);
    uint64_t off;
    *out = towards(*in, w->end, expect(w, &off));
    if (code_at(w, *out) == code) {
        for (*in = *out; *in != w->end; *in = *out, off *= 4) {
            *out = towards(*in, w->end, off);
            if (code_at(w, *out) != code)
                break;
        }
        if (*in == w->end)
            return false;
    } else {
        for (uint64_t back = towards(*out, *in, off); back != *in; back = towards(*out, *in, off *= 4)) {
            if (code_at(w, back) == code)
                *in = back;
            else
                *out = back;
        }
    }
    while (distance(*in, *out) > gap) {
        const uint64_t middle = towards(*in, *out, distance(*in, *out) / 2);
        *(code_at(w, middle) == code ? in : out) = middle;
    }
    return true;
}

static void pass_by(walk *w, uint64_t to) {
    w->before = w->stride;
    w->stride = distance(w->here, to);
    w->here = to;
}

static double error_at(const walk *w, uint64_t x) {
    dp_setup setup;
    return solve_setup(w->problem, dp_float64(x), &setup) == DP_OK ? fabs(dp_error(&setup, dp_code(&setup, w->z), w->z))
                                                                   : (double)HUGE_VAL;
}

/*
 * Past a code without finding its end to the double: a plane that moves by a part in 2^30 moves no stored depth by more
 * than that part of itself, so where both sides keep that much away from the limit all between them pass.
 */
static bool leap(walk *w) {
    const solve_problem *p = w->problem;
    uint64_t in = w->here;
    uint64_t out;
    const double limit = p->limit - (w->z + p->limit) * 0x1p-28;
    if (p->lo < p->hi || !bracket(w, (uint64_t)1 << 22, &in, &out) || error_at(w, in) > limit ||
        error_at(w, out) > limit)
        return false;
    pass_by(w, out);
    return true;
}

/* Between a value that passes and one that does not, of one code: the last that passes. */
static uint64_t last_that_passes(const walk *w, uint64_t passes, uint64_t fails) {
    while (distance(passes, fails) > 1) {
        const uint64_t middle = towards(passes, fails, distance(passes, fails) / 2);
        *(plane_passes(w->problem, dp_float64(middle)) ? &passes : &fails) = middle;
    }
    return passes;
}

/*
 * While z keeps its code the error at z is monotone in the plane, and what the cells before z err changes the other
 * way: so where both ends of a code pass all of it does. True when the next double beyond fails, or there is none.
 */
static bool go(walk *w, int most) {
    for (int i = 0; i < most; i++) {
        uint64_t last = w->here;
        uint64_t beyond;
        if (leap(w))
            continue;
        bracket(w, 1, &last, &beyond);
        if (!plane_passes(w->problem, dp_float64(last))) {
            w->here = last_that_passes(w, w->here, last);
            return true;
        }
        const uint64_t next = towards(last, w->end, 1);
        if (next == last || !plane_passes(w->problem, dp_float64(next))) {
            w->here = last;
            return true;
        }
        pass_by(w, next);
    }
    return false;
}

/* staged: what the lattice needs may not do; then farther in, where the bound of a staged error will. */
static bool aligned_anyhow(const solve_problem *p, double x) {
    dp_setup setup;
    return solve_setup(p, x, &setup) == DP_OK &&
           (setup.shader || measure_over(p->kind, &setup, p->lo, p->hi).value <= p->limit) && plane_passes(p, x);
}

static double start_of(const solve_problem *p, double outer, double inner) {
    if (aligned_anyhow(p, outer))
        return outer;
    if (!aligned_anyhow(p, inner))
        return (double)NAN;
    for (int i = 0; i < 64 && fabs(inner / outer - 1.0) > 0x1p-40; i++) {
        const double middle = isinf(outer) ? inner * 2.0 : sqrt(outer) * sqrt(inner);
        *(aligned_anyhow(p, middle) ? &inner : &outer) = middle;
    }
    return inner;
}

/* staged has jumps of its own: places from the start inwards are tried, and the end is where one fails first. */
static void try_places(const solve_problem *p, plane_answer *a) {
    enum { PLACES = 64 };
    const double from = isinf(a->value) ? 1e18 : a->value;
    double good = from;
    for (int i = 1; i <= PLACES; i++) {
        double x = i == PLACES ? a->until : from * dp_pow(a->until / from, (double)i / PLACES);
        if (!aligned_anyhow(p, x)) {
            for (int k = 0; k < 64 && fabs(x / good - 1.0) > 0x1p-40; k++) {
                const double middle = sqrt(good) * sqrt(x);
                *(aligned_anyhow(p, middle) ? &good : &x) = middle;
            }
            a->until = good;
            break;
        }
        good = x;
        a->tried = a->passed = (uint64_t)i;
    }
}

/*
 * A range is decided by the codes of its worst end where that outweighs the rest: UNORM, and several cells in it. The
 * binades of a FLOAT have their own worst depths inside.
 */
static bool is_decided_at(const solve_problem *p, double x, double *z) {
    enum { CELLS = 16 };
    dp_setup setup;
    if (solve_setup(p, x, &setup) != DP_OK || setup.shader)
        return false;
    *z = measure_governing(&setup, p->lo, p->hi);
    const double cells = fabs((double)dp_code(&setup, p->lo) - (double)dp_code(&setup, p->hi));
    return p->lo == p->hi || (p->spec.format.kind == DP_FORMAT_UNORM && cells >= CELLS);
}

void plane_error_solve(const solve_problem *p, const solve_result *lattice, plane_answer *out) {
    const bool znear = p->unknown == SOLVE_NEAR;
    const double most = isinf(lattice->most) ? 1e18 : lattice->most;
    double start = (double)NAN;
    out->until = znear ? lattice->most : lattice->least;
    if (lattice->possible) {
        out->until = lattice->until;
        start = start_of(p, lattice->value, lattice->until);
    }
    /* Where no alignment is safe this one may be: near or far at the depth itself stores it as it is. */
    if (isnan(start) && plane_passes(p, znear ? lattice->most : lattice->least))
        start = out->until = znear ? lattice->most : lattice->least;
    out->possible = !isnan(start);
    out->value = out->steady = out->possible ? start : lattice->value;
    if (out->possible && p->spec.model != DP_MODEL_EXACT && start != out->until)
        try_places(p, out);
    if (!out->possible || isinf(out->value)) {
        out->until = out->possible ? out->until : out->value;
        out->certain = out->possible; /* an alignment that happens to do may be anywhere */
        return;
    }
    walk w = {.problem = p, .here = dp_bits64(start), .end = dp_bits64(znear ? lattice->least : most)};
    out->certain = is_decided_at(p, start, &w.z) && go(&w, CODES_MOST);
    out->value = out->steady = dp_float64(w.here);
    if (!znear && out->value == most && isinf(lattice->most) && plane_passes(p, (double)HUGE_VAL))
        out->value = out->steady = (double)HUGE_VAL;
}
