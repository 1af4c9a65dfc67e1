/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/distance.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/engine.h"
#include "core/search.h"

static const double farthest = 1e18;

typedef struct ruler {
    quantity_kind kind;
    const dp_setup *setup;
    dp_guarantee guarantee;
    double limit;
    double lo;
    dp_edge edge; /* it holds from lo to the one, and does not at the other */
} ruler;

/* Where depths are computed, binary32 depths alone are of interest. */
static dp_edge edge_of(const dp_setup *setup, double holds, double fails) {
    return (dp_edge){holds, fails, .straight = 2.0, .single = dp_is_computed(setup)};
}

/* Other depths are not told apart as finely as doubles are. */
static bool between(const dp_edge *e, double *z) {
    const double lo = fmin(e->holds, e->fails), hi = fmax(e->holds, e->fails);
    return (e->single || hi > lo + fabs(lo) * 0x1p-48) && dp_edge_between(e, z);
}

/*
 * One part more, judged by itself: what was certain before stays so. A separation names the depth that is worst, and
 * where that is too much nothing beyond it counts. Of an error the whole range is judged: cells end where it does.
 */
static void extend(ruler *r, double end) {
    dp_edge *e = &r->edge;
    const double begin = r->kind == QUANTITY_ERROR ? r->lo : e->holds;
    if (r->kind == QUANTITY_SEPARATION &&
        dp_guarantee_at(&r->guarantee, end) > r->limit) { /* cheaper than to judge them all */
        e->fails = end;
        return;
    }
    if (r->kind == QUANTITY_SEPARATION && begin < end && dp_separation_soon(r->setup, begin, end, r->limit)) {
        e->holds = end;
        return;
    }
    const quantity_worst j = quantity_over(r->kind, r->setup, begin, end, r->limit);
    if (j.passed)
        e->holds = end;
    else if (r->kind == QUANTITY_SEPARATION && j.z > e->holds && dp_guarantee_at(&r->guarantee, j.z) > r->limit)
        e->fails = j.z;
    else
        e->fails = end;
}

/* Whether every depth from the one to just before the other is the same, rounded down to that many digits. */
static bool is_settled(const dp_edge *e, int digits) {
    const double unit = dp_pow(10.0, floor(dp_log10(fmin(fabs(e->holds), fabs(e->fails)))) + 1.0 - digits);
    return floor(e->holds / unit) == ceil(e->fails / unit) - 1.0;
}

/*
 * The ends by depths one by one, which are cheap, then one judgement of all before: where the separation rises with
 * depth nothing else is left to judge.
 */
static void aim(ruler *r, int digits) {
    dp_edge e = r->edge;
    for (double z; !is_settled(&e, digits) && between(&e, &z);)
        *(dp_guarantee_at(&r->guarantee, z) > r->limit ? &e.fails : &e.holds) = z;
    r->edge.fails = e.fails;
    if (e.holds > r->edge.holds)
        extend(r, e.holds);
}

/* Until the ends are neighbours, or agree in so many digits if that is not 0. */
static void search(ruler *r, int digits) {
    dp_edge *e = &r->edge;
    if (r->lo < e->fails)
        extend(r, e->fails);
    if (digits > 0 && e->holds < e->fails)
        aim(r, digits);
    for (double z; !(digits > 0 && is_settled(e, digits)) && between(e, &z);)
        extend(r, z);
}

static ruler ruler_of(quantity_kind kind, const dp_setup *setup, double lo, double hi, double limit) {
    return (ruler){.kind = kind,
                   .setup = setup,
                   .guarantee = dp_guarantee_make(setup),
                   .limit = limit,
                   .lo = lo,
                   .edge = edge_of(setup, lo, fmin(hi, farthest))};
}

double distance_about(const dp_setup *setup, double lo, double hi, double limit, int digits) {
    ruler r = ruler_of(QUANTITY_SEPARATION, setup, lo, hi, limit);
    if (!(dp_guarantee_at(&r.guarantee, lo) <= limit))
        return (double)NAN;
    search(&r, digits);
    return r.edge.holds;
}

/* Takes what `check` accepts, in one piece: where that stops refining too early, a little less, at last the beginning,
 * which holds. */
static void confirm(const ruler *r, distance_answer *out) {
    const double reach = r->edge.holds;
    out->value = reach;
    for (double share = 0x1p-48;; share *= 2.0) {
        out->reached = quantity_over(r->kind, r->setup, r->lo, out->value, r->limit);
        if (out->reached.passed || out->value == r->lo)
            return;
        out->value = share < 1.0 ? fmax(reach - fabs(reach) * share, r->lo) : r->lo;
    }
}

dp_status distance_solve(quantity_kind kind, const dp_setup *setup, double lo, double hi, double limit,
                         distance_answer *out) {
    if (setup == NULL || out == NULL)
        return DP_ERROR_NULL;
    if (!quantity_has_model(kind, setup->spec.model, setup->spec.mapping))
        return DP_ERROR_MODEL;
    if (!(limit > 0.0 && lo >= setup->spec.znear && lo <= hi && hi <= setup->spec.zfar) || lo > farthest)
        return DP_ERROR_RANGE;
    ruler r = ruler_of(kind, setup, lo, hi, limit);
    const double end = r.edge.fails;
    *out = (distance_answer){.value = lo, .fails = lo};
    out->reached = quantity_over(kind, setup, lo, lo, limit);
    out->possible = out->reached.passed;
    if (!out->possible)
        return DP_OK;
    search(&r, 0);
    confirm(&r, out);
    out->throughout = out->value == end;
    out->fails = out->throughout ? (double)NAN : r.edge.fails;
    return DP_OK;
}

/* ---- Beyond ------------------------------------------------------------------------------------------------------ */

/* So many depths in a row that pass by themselves are a region whose depths cannot be told apart. */
enum { OCTAVES = 16, EACH = 64, NEXT_TO = 24, TRIED = 2 * OCTAVES * EACH, POINTS_MOST = 16 };
static const double SHORTEST = 0x1p-24;

typedef struct trials {
    const dp_setup *setup;
    double after, end;
    double z[TRIED];
    size_t count;
} trials;

static void try_depth(trials *t, double z) {
    if (dp_is_computed(t->setup))
        z = (double)(float)z;
    if (t->count < TRIED && z > t->after && z <= t->end)
        t->z[t->count++] = z;
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void choose_depths(trials *t) {
    for (int i = 1; i <= OCTAVES * EACH; i++)
        try_depth(t, t->after * dp_exp2((double)i / EACH));
    const double d = dp_window(t->setup, t->after);
    for (int i = 0; i < OCTAVES && d > 0.0; i++) {
        const double edge = ldexp(1.0, ilogb(d) + (t->setup->reversed ? -i : i + 1));
        const double z = edge <= 1.0 ? dp_eye(t->setup, edge, 1.0 - edge) : (double)NAN;
        for (int k = 0; k <= NEXT_TO; k++)
            try_depth(t, z * (1.0 + ldexp(1.0, -k)));
    }
    qsort(t->z, t->count, sizeof t->z[0], ascending);
}

size_t distance_again(const dp_setup *setup, double after, double hi, double limit, distance_span *out, size_t room) {
    trials t = {.setup = setup, .after = after, .end = fmin(hi, farthest)};
    double fails = after;
    size_t count = 0, points = 0;
    if (!(after > 0.0)) /* an orthographic range about the camera: a step is a step */
        return 0;
    choose_depths(&t);
    for (size_t i = 0; i < t.count && count < room && points < POINTS_MOST; i++) {
        if (count > 0 && t.z[i] <= out[count - 1].hi)
            continue;
        if (!quantity_over(QUANTITY_SEPARATION, setup, t.z[i], t.z[i], limit).passed) {
            fails = t.z[i];
            continue;
        }
        dp_edge e = edge_of(setup, t.z[i], fails);
        for (double z; between(&e, &z);)
            *(quantity_over(QUANTITY_SEPARATION, setup, z, z, limit).passed ? &e.holds : &e.fails) = z;
        distance_answer answer;
        fails = e.holds;
        if (distance_solve(QUANTITY_SEPARATION, setup, e.holds, t.end, limit, &answer) != DP_OK || !answer.possible)
            continue;
        fails = answer.value;
        const bool is_point = answer.value <= e.holds * (1.0 + SHORTEST); /* which passes by how it was rounded */
        points = is_point ? points + 1 : 0;
        if (!is_point)
            out[count++] = (distance_span){e.holds, answer.value};
    }
    return count;
}
