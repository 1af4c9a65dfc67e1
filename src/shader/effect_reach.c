/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far an effect stays within a level, and what parameter does so at all depths: steps of the depth grow with it. */
#include <math.h>

#include "core/elementary.h"
#include "core/search.h"
#include "shader/effect.h"

typedef struct search {
    const effect_row *row;
    const effect_view *view;
    const double *parameters;
    double levels;
    bool steps; /* of the stored depth, in place of its rounding */
} search;

static bool holds(const search *s, double z) {
    return (s->steps ? effect_step : effect_error)(s->row, s->view, s->parameters, z) <= s->levels;
}

/* Between a depth where it holds and one where it does not. */
static double last_between(const search *s, double good, double bad) {
    dp_edge e = {.holds = good, .fails = bad, .apart = 0x1p-40};
    for (double z; dp_edge_between(&e, &z);)
        *(holds(s, z) ? &e.holds : &e.fails) = z;
    return e.holds;
}

/* Part `i` of so many, even on the scale on which the search halves. */
static double part_of(double lo, double hi, int i, int count) {
    const double share = (double)i / count;
    return i == count ? hi : lo > 0.0 ? lo * dp_pow(hi / lo, share) : lo + (hi - lo) * share;
}

bool effect_is_steady(const effect_row *row) {
    return row->behind == 0 && (row->kind != EFFECT_STEP || row->alone) && (row->needs & EFFECT_LAST_FRAME) == 0;
}

/* The ends of runs of depths whose steps grow with the depth: where a float's step is halved, and `hi`. Of the last
 * cell before one a part alone may lie before it, so the place that is tried is in the one before that. */
static double run_end(const dp_setup *setup, int k, double hi) {
    enum { BINADES = 64 };
    const bool falls = setup->reversed && setup->spec.format.kind == DP_FORMAT_FLOAT;
    const double d = ldexp(1.0, -k);
    return falls && k < BINADES ? fmin(dp_eye(setup, d, 1.0 - d) * (1.0 - 0x1p-40), hi) : hi;
}

static double before_last_cell(const dp_setup *setup, double lo, double end) {
    const double edge = dp_cell_of(setup, dp_code(setup, end)).lo;
    return fmax(edge - 0x1p-40 * fabs(edge), lo);
}

enum { PARTS = 64 };

double effect_reach(const effect_row *row, const effect_view *view, const double *parameters, bool steps, double lo,
                    double hi, double levels) {
    const search s = {row, view, parameters, levels, steps};
    double from = lo;
    if (!holds(&s, lo))
        return (double)NAN;
    for (int k = 1; from < hi; k++) {
        const double to = run_end(view->setup, k, hi);
        double good = from;
        for (int i = 1; i <= PARTS + 1 && to > from; i++) {
            const double z = i < PARTS    ? part_of(from, to, i, PARTS)
                             : i == PARTS ? fmax(good, before_last_cell(view->setup, from, to))
                                          : to;
            if (!holds(&s, z))
                return last_between(&s, good, z);
            good = z;
        }
        from = fmax(from, to);
    }
    return hi;
}

double effect_usable_over(const effect_row *row, const effect_view *view, const double *parameters, bool steps,
                          double lo, double hi, double levels) {
    double (*const usable_at)(const effect_row *, const effect_view *, const double *, double, double) =
        steps ? effect_step_usable : effect_usable;
    double from = lo, worst = usable_at(row, view, parameters, lo, levels);
    for (int k = 1; from < hi && !isnan(worst); k++) {
        const double to = run_end(view->setup, k, hi);
        for (int i = 1; i <= PARTS + 1 && to > from && !isnan(worst); i++) {
            const double z = i <= PARTS ? part_of(from, to, i, PARTS) : before_last_cell(view->setup, from, to);
            const double usable = usable_at(row, view, parameters, z, levels);
            worst = isnan(usable) ? usable : row->smallest ? fmax(worst, usable) : fmin(worst, usable);
        }
        from = fmax(from, to);
    }
    return worst;
}
