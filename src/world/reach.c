/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "world/reach.h"

#include <math.h>

#include "core/outward.h"

static world_error error_at(const world_scheme *s, const world_asked *a, double distance, double z) {
    const world_where at = {distance, a->ray_ratio * z, z};
    return world_bound(s, &at);
}

double world_off(const world_scheme *s, const world_asked *a, double distance) {
    const world_error e = error_at(s, a, distance, a->z);
    return world_all(&e);
}

/* The errors of view z of surfaces up to z. */
static dp_displaced displaced(const world_scheme *s, const world_asked *a, double distance, double z) {
    const world_error e = error_at(s, a, distance, z);
    const double own = world_own(&e, a->shared_origin);
    return (dp_displaced){own, world_all(&e) - own, WORLD_TURN * a->ray_ratio};
}

dp_status world_budget(const world_scheme *s, const world_asked *a, double distance, dp_budget_terms *terms,
                       dp_budget *out) {
    const double settled = 1.0 + 0x1p-40;
    const dp_triangles *t = &a->setup->spec.triangles;
    const double vertices = t->width > 0 ? t->depth : 1.0; /* those of a triangle are farther away than its pixels */
    double end = a->z * vertices;
    terms->world = 0.0;
    for (;;) { /* what is behind is farther away: until it no longer makes the separation larger */
        terms->displaced = displaced(s, a, distance, end);
        const dp_status status = dp_budget_at(a->setup, a->z, terms, out);
        if (status != DP_OK || (a->z + out->separation) * vertices <= end * settled || isinf(out->separation))
            return status;
        end = (a->z + out->separation) * vertices * settled;
    }
}

double world_separation(const world_scheme *s, const world_asked *a, double distance) {
    dp_budget_terms terms = {0};
    dp_budget b;
    return world_budget(s, a, distance, &terms, &b) == DP_OK ? b.separation : (double)INFINITY;
}

/* The loss at the farthest, and the buffer's need wherever places may be moved to. */
double world_separation_over(const world_scheme *s, const world_asked *a, double distance, double lo, double hi) {
    const double settled = 1.0 + 0x1p-40, outward = 1.0 + DP_ROUNDINGS32_254;
    const dp_spec *spec = &a->setup->spec;
    for (double end = hi;;) {
        const dp_displaced d = displaced(s, a, distance, end);
        const double reach = d.own + d.shared;
        dp_separation_worst worst;
        if (!(reach < lo) || dp_separation_over(a->setup, fmax(lo - reach, spec->znear), fmin(hi + reach, spec->zfar),
                                                0.0, &worst) != DP_OK)
            return (double)INFINITY;
        const double need = d.own + fmax(d.own, d.shared) + worst.bound;
        const double separation = need / (1.0 - d.turn) * outward;
        if (isinf(separation) || hi + separation <= end * settled)
            return separation;
        end = (hi + separation) * settled;
    }
}

double world_jitter(const world_scheme *s, const world_asked *a, double distance) {
    const world_where ahead = {distance, a->z, a->z}, beside = {distance, a->z, 0.0};
    const world_error along = world_bound(s, &ahead), across = world_bound(s, &beside);
    const double left = a->z - world_all(&along);
    return left > 0.0 ? world_all(&across) / left * a->pixels : (double)INFINITY;
}

double world_reach(world_loss *loss, const world_scheme *s, const world_asked *a, double limit) {
    double lo = 1e-3, hi = WORLD_FARTHEST;
    if (!(loss(s, a, 0.0) <= limit))
        return 0.0;
    if (loss(s, a, hi) <= limit)
        return hi;
    if (!(loss(s, a, lo) <= limit))
        return 0.0;
    while (hi > lo * (1.0 + 1e-10)) {
        const double middle = sqrt(lo * hi);
        *(loss(s, a, middle) <= limit ? &lo : &hi) = middle;
    }
    return lo;
}
