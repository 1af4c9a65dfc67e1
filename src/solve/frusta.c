/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/frusta.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/search.h"

enum { HALVINGS = 48, DIGITS = 6, DIGITS_MOST = 17, TEXT_SIZE = 32 };

static quantity_worst judged(const dp_spec *whole, double znear, double zfar, double limit) {
    dp_spec spec = *whole;
    dp_setup setup;
    spec.znear = znear;
    spec.zfar = zfar;
    if (quantity_setup(&spec, &setup) != DP_OK)
        return (quantity_worst){.value = HUGE_VAL, .z = zfar};
    return quantity_over(QUANTITY_SEPARATION, &setup, znear, zfar, limit);
}

static bool passes(const dp_spec *whole, double znear, double zfar, double limit) {
    return judged(whole, znear, zfar, limit).passed;
}

/* The way from `fails` to zfar, shortened by 2^-k: of the distance, or of its logarithm. */
static double nearer(const dp_spec *whole, double zfar, int k) {
    const double share = ldexp(1.0, -k);
    return whole->ortho ? zfar - (zfar - whole->znear) * share : zfar * dp_pow(whole->znear / zfar, share);
}

/* The least near with that far that a bisection finds to pass; NaN where none is found. */
static double least_near(const dp_spec *whole, double zfar, double limit) {
    if (passes(whole, whole->znear, zfar, limit))
        return whole->znear;
    dp_edge e = {.holds = (double)NAN, .fails = whole->znear, .straight = (double)INFINITY};
    for (int k = 1; k <= HALVINGS && isnan(e.holds); k++) {
        const double x = nearer(whole, zfar, k);
        *(passes(whole, x, zfar, limit) ? &e.holds : &e.fails) = x;
    }
    for (double x; dp_edge_between(&e, &x);)
        *(passes(whole, x, zfar, limit) ? &e.holds : &e.fails) = x;
    return e.holds;
}

/* The plane with the fewest digits, six or more, not nearer than `least`, that still passes. */
static double shortened(const dp_spec *whole, double least, double zfar, double limit) {
    char text[TEXT_SIZE];
    for (int digits = DIGITS; digits < DIGITS_MOST && least != 0.0 && least != whole->znear; digits++) {
        const double unit = dp_pow(10.0, floor(dp_log10(fabs(least))) - (digits - 1));
        for (int i = 0; i < 2; i++) {
            snprintf(text, sizeof text, "%.*e", digits - 1, least + i * unit);
            const double x = strtod(text, NULL);
            if (x >= least && x < zfar && passes(whole, x, zfar, limit))
                return x;
        }
    }
    return least;
}

static dp_status check(const dp_spec *spec, double limit) {
    dp_setup setup;
    if (spec == NULL)
        return DP_ERROR_NULL;
    if (!(limit > 0.0) || isinf(spec->zfar))
        return DP_ERROR_RANGE;
    return quantity_setup(spec, &setup);
}

static void find_worst(frusta_plan *plan) {
    plan->worst = 0;
    for (size_t i = 1; i < plan->count; i++)
        if (plan->frusta[i].reached.value > plan->frusta[plan->worst].reached.value)
            plan->worst = i;
}

/* The farthest was found first. */
static void reverse(frusta_plan *plan) {
    for (size_t i = 0; i < plan->count / 2; i++) {
        const frustum kept = plan->frusta[i];
        plan->frusta[i] = plan->frusta[plan->count - 1 - i];
        plan->frusta[plan->count - 1 - i] = kept;
    }
}

dp_status frusta_solve(const dp_spec *spec, double limit, frusta_plan *out) {
    const dp_status status = out == NULL ? DP_ERROR_NULL : check(spec, limit);
    if (status != DP_OK)
        return status;
    *out = (frusta_plan){.stuck = (double)NAN};
    double zfar = spec->zfar;
    while (zfar > spec->znear && out->count < FRUSTA_MAX) {
        const double least = least_near(spec, zfar, limit);
        if (isnan(least))
            break;
        const double znear = shortened(spec, least, zfar, limit);
        out->frusta[out->count++] = (frustum){znear, zfar, judged(spec, znear, zfar, limit)};
        zfar = znear;
    }
    out->possible = zfar == spec->znear;
    if (!out->possible)
        out->stuck = zfar;
    reverse(out);
    find_worst(out);
    return DP_OK;
}

static dp_spec in_exact(const dp_spec *spec) {
    dp_spec exact = *spec;
    exact.model = DP_MODEL_EXACT;
    return exact;
}

quantity_worst frusta_lattice(const dp_spec *spec, double limit) {
    const dp_spec exact = in_exact(spec);
    return judged(&exact, spec->znear, spec->zfar, limit);
}

double frusta_lattice_near(const dp_spec *spec, double zfar, double limit) {
    const dp_spec exact = in_exact(spec);
    return least_near(&exact, zfar, limit);
}

size_t frusta_at_least(const dp_spec *spec, double limit) {
    if (check(spec, limit) != DP_OK || spec->format.kind != DP_FORMAT_UNORM)
        return 1;
    const dp_spec exact = in_exact(spec);
    size_t count = 0;
    for (double zfar = spec->zfar; zfar > spec->znear && count < FRUSTA_MAX; count++) {
        zfar = least_near(&exact, zfar, limit * (1.0 + 1e-9)); /* a bound is within 1e-12 of what it bounds */
        if (isnan(zfar))
            return count + 1;
    }
    return count;
}

dp_status frusta_by_ratio(const dp_spec *spec, double ratio, frusta_plan *out) {
    const dp_status status = out == NULL ? DP_ERROR_NULL : check(spec, 1.0);
    if (status != DP_OK)
        return status;
    if (!(ratio > 1.0) || !(spec->znear > 0.0))
        return DP_ERROR_RANGE;
    const double count = ceil(dp_log(spec->zfar / spec->znear) / dp_log(ratio));
    if (!(count <= FRUSTA_MAX))
        return DP_ERROR_RANGE;
    *out = (frusta_plan){.possible = true, .count = (size_t)fmax(count, 1.0), .stuck = (double)NAN};
    double znear = spec->znear;
    for (size_t i = 0; i < out->count; i++) {
        const double zfar = i + 1 == out->count ? spec->zfar : znear * ratio;
        out->frusta[i] = (frustum){znear, zfar, judged(spec, znear, zfar, (double)NAN)};
        znear = zfar;
    }
    find_worst(out);
    return DP_OK;
}
