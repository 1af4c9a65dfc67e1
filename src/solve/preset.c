/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/preset.h"

#include <math.h>

#include "core/elementary.h"
#include "core/search.h"

enum { TRIED = 512, TRIED_BEHIND = 4096, STEPS_BEHIND = 32, ENDS_MOST = 16 };

const preset_parameter *preset_sought(const preset *row) {
    return row->function != NULL && isnan(row->function->parameters[0].standard) ? &row->function->parameters[0] : NULL;
}

bool preset_setup(const preset_problem *p, double number, dp_setup *out, double *lo, double *hi) {
    char error[PRESET_ERROR_SIZE];
    preset_values values = p->values;
    preset_camera made;
    dp_spec spec = p->spec;
    double znear, zfar, log_c;
    values.given[0] = number;
    if (!preset_make(p->row, &values, &made, error))
        return false;
    preset_planes(p->row, &made, p->unit, &znear, &zfar, &log_c);
    spec.znear = p->near_given ? spec.znear : znear;
    spec.zfar = p->far_given ? spec.zfar : zfar;
    *lo = isnan(p->lo) ? unit_convert(made.focus, unit_find(p->row->unit), p->unit) : p->lo;
    *hi = isnan(p->lo) ? *lo : p->hi;
    return *lo >= spec.znear && *hi <= spec.zfar && quantity_setup(&spec, out) == DP_OK;
}

bool preset_passes(const preset_problem *p, double number) {
    dp_setup setup;
    double lo, hi;
    return preset_setup(p, number, &setup, &lo, &hi) &&
           quantity_over(QUANTITY_SEPARATION, &setup, lo, hi, p->limit).passed;
}

static bool is_outside(const preset_problem *p, double number) {
    dp_setup setup;
    double lo, hi;
    return !preset_setup(p, number, &setup, &lo, &hi);
}

/* Number `i` of those that are tried: sizes on a logarithmic scale. */
static double tried(const preset_parameter *x, int i) {
    if (i == 0 || i == TRIED)
        return i == 0 ? x->least : x->most;
    const double share = (double)i / TRIED;
    return x->least > 0.0 && x->most > 1e3 * x->least ? x->least * dp_pow(x->most / x->least, share)
                                                      : x->least + (x->most - x->least) * share;
}

static dp_edge turn(const preset_problem *p, double holds, double fails) {
    dp_edge e = {.holds = holds, .fails = fails, .apart = 1e-12, .straight = 2.0};
    for (double x; dp_edge_between(&e, &x);)
        *(preset_passes(p, x) ? &e.holds : &e.fails) = x;
    return e;
}

/*
 * The end of a run next to a number that fails. A guarantee rises in steps, and as each plane is rounded in its own way
 * they come and go next to the end: it is moved inwards until all that are tried behind it pass, densest next to it.
 */
static dp_edge end_of(const preset_problem *p, double holds, double fails, double inner, size_t *count) {
    dp_edge e = turn(p, holds, fails);
    const size_t begun = *count;
    for (int again = 0; again < ENDS_MOST; again++) {
        double last = inner;
        int i = 1;
        *count = begun;
        for (; i < TRIED_BEHIND; i++) {
            const double x = e.holds + (inner - e.holds) * dp_exp2(-30.0 * i / TRIED_BEHIND);
            ++*count;
            if (!preset_passes(p, x)) {
                e = turn(p, last, x);
                break;
            }
            last = x;
        }
        if (i == TRIED_BEHIND)
            break;
    }
    return e;
}

void preset_solve(const preset_problem *p, preset_answer *out) {
    const preset_parameter *x = preset_sought(p->row);
    int first = 0, last = -1, start = -1;
    for (int i = 0; i <= TRIED + 1; i++) {
        const bool passes = i <= TRIED && preset_passes(p, tried(x, i));
        if (passes && start < 0)
            start = i;
        if (!passes && start >= 0 && i - 1 - start > last - first) {
            first = start;
            last = i - 1;
        }
        start = passes ? start : -1;
    }
    *out =
        (preset_answer){.possible = last >= first, .from = x->least, .to = x->most, .least = x->least, .most = x->most};
    if (!out->possible)
        return;
    out->tried = (size_t)(last - first + 1);
    const int inner = last - first < STEPS_BEHIND ? last - first : STEPS_BEHIND;
    if (first > 0) {
        const dp_edge e = end_of(p, tried(x, first), tried(x, first - 1), tried(x, first + inner), &out->tried);
        out->from = e.holds;
        out->below = true;
        out->below_outside = is_outside(p, e.fails);
    }
    if (last < TRIED) {
        const dp_edge e = end_of(p, tried(x, last), tried(x, last + 1), tried(x, last - inner), &out->tried);
        out->to = e.holds;
        out->above = true;
        out->above_outside = is_outside(p, e.fails);
    }
}
