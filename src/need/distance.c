/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "need/distance.h"

#include <math.h>

enum { STEPS = 400 };

static const double farthest = 1e18;

typedef struct ruler {
    measure_kind kind;
    const dp_setup *setup;
    double limit;
    bool whole; /* binary32 depths alone are of interest */
    double lo;
    double holds, fails; /* it holds from lo to the one, and does not at the other */
} ruler;

/* A depth between the two ends, or NaN when there is none to try. */
static double between(const ruler *r) {
    const bool far_apart = r->holds > 0.0 && r->holds < 0.5 * r->fails;
    double middle = far_apart ? sqrt(r->holds) * sqrt(r->fails) : 0.5 * r->holds + 0.5 * r->fails;
    if (r->whole) {
        middle = (double)(float)middle;
        if (middle <= r->holds)
            middle = (double)nextafterf((float)r->holds, HUGE_VALF);
        if (middle <= r->holds)
            middle = (double)nextafterf((float)middle, HUGE_VALF);
    } else if (r->fails <= r->holds + fabs(r->holds) * 0x1p-48) {
        return (double)NAN;
    }
    return middle > r->holds && middle < r->fails ? middle : (double)NAN;
}

/*
 * One part more, judged by itself: what was certain before stays so. A separation names the depth that is worst, and
 * where that is too much nothing beyond it counts. Of an error the whole range is judged: cells end where it does.
 */
static void extend(ruler *r, double end) {
    const double begin = r->kind == MEASURE_ERROR ? r->lo : r->holds;
    const judgement j = judge(r->kind, r->setup, begin, end, r->limit);
    if (j.passed)
        r->holds = end;
    else if (r->kind == MEASURE_SEPARATION && j.z > r->holds && dp_separation(r->setup, j.z) > r->limit)
        r->fails = j.z;
    else
        r->fails = end;
}

/* As `check` would judge it, in one piece: where that stops refining too early, a little less. */
static void confirm(ruler *r, distance_answer *out) {
    const double reach = r->holds;
    for (double share = 0x1p-48; share < 1.0; share *= 2.0) {
        out->reached = judge(r->kind, r->setup, r->lo, r->holds, r->limit);
        if (out->reached.passed)
            break;
        r->holds = fmax(reach - fabs(reach) * share, r->lo);
    }
    out->value = r->holds;
}

dp_status distance_solve(measure_kind kind, const dp_setup *setup, double lo, double hi, double limit,
                         distance_answer *out) {
    if (setup == NULL || out == NULL)
        return DP_ERROR_NULL;
    if (kind == MEASURE_ERROR && setup->spec.model == DP_MODEL_FP32)
        return DP_ERROR_MODEL;
    if (!(limit > 0.0 && lo >= setup->spec.znear && lo <= hi && hi <= setup->spec.zfar) || lo > farthest)
        return DP_ERROR_RANGE;
    const double end = fmin(hi, farthest);
    ruler r = {.kind = kind,
               .setup = setup,
               .limit = limit,
               .whole = setup->spec.model == DP_MODEL_FP32,
               .lo = lo,
               .holds = lo,
               .fails = end};
    *out = (distance_answer){.value = lo, .fails = lo};
    out->reached = judge(kind, setup, lo, lo, limit);
    out->possible = out->reached.passed;
    if (!out->possible)
        return DP_OK;
    if (lo < end)
        extend(&r, end);
    for (int i = 0; i < STEPS && r.holds < end; i++) {
        const double middle = between(&r);
        if (isnan(middle))
            break;
        extend(&r, middle);
    }
    confirm(&r, out);
    out->throughout = out->value == end;
    out->fails = out->throughout ? (double)NAN : r.fails;
    return DP_OK;
}
