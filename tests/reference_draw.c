/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Set-ups, places and windows at random, with more weight on the ends of everything. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "reference.h"

/* ---- Depths ------------------------------------------------------------------------------------------------------ */

enum { SIGN = 31 };

double reference_depth(uint32_t rank) {
    const uint32_t zero = 1U << SIGN;
    const uint32_t size = rank < zero ? zero - rank : rank - zero;
    float z;
    memcpy(&z, &size, sizeof z);
    return rank < zero ? -(double)z : (double)z;
}

uint32_t reference_rank(double z) {
    const uint32_t zero = 1U << SIGN;
    const float x = (float)fabs(z);
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return z < 0.0 ? zero - bits : zero + bits;
}

static const double beyond_all = 0x1.ffffffp127; /* here binary32 rounds to infinity */

/* Where far is infinite the library may refuse depths; but none whose reciprocal is a normal number. */
static double last_depth(const dp_setup *setup) {
    double lo = 0x1p126;
    double hi = nextafter(beyond_all, 0.0);
    dp_budget budget;
    if (dp_budget_at(setup, hi, NULL, &budget) == DP_OK)
        return hi;
    while (nextafter(lo, hi) < hi) {
        const double middle = 0.5 * lo + 0.5 * hi;
        if (dp_budget_at(setup, middle, NULL, &budget) == DP_OK)
            lo = middle;
        else
            hi = middle;
    }
    return lo;
}

reference_range reference_range_of(const dp_setup *setup) {
    reference_range range = {.znear = setup->spec.znear, .zfar = setup->spec.zfar};
    if (isinf(range.zfar))
        range.zfar = last_depth(setup);
    range.first = reference_rank(range.znear);
    range.last = reference_rank(range.zfar);
    return range;
}

/* A midpoint belongs to the neighbour whose last bit is 0. */
double reference_cell_lo(const reference_range *range, uint32_t rank) {
    const double middle = 0.5 * (reference_depth(rank - 1) + reference_depth(rank));
    return fmax(range->znear, rank & 1 ? nextafter(middle, HUGE_VAL) : middle);
}

double reference_cell_hi(const reference_range *range, uint32_t rank) {
    const double x = reference_depth(rank);
    const double middle = rank == reference_rank((double)FLT_MAX) ? beyond_all : 0.5 * (x + reference_depth(rank + 1));
    return fmin(range->zfar, rank & 1 ? nextafter(middle, -HUGE_VAL) : middle);
}

/* ---- Set-ups ----------------------------------------------------------------------------------------------------- */

static dp_format draw_format(rng *r) {
    static const char *const named[] = {"fp16", "fp32", "unorm16", "unorm24"};
    char name[64];
    dp_format found[2];
    const uint64_t kind = rng_below(r, 10);
    const int e = 2 + (int)rng_below(r, 7);
    const int m = rng_below(r, 2) ? 20 + (int)rng_below(r, 4) : 1 + (int)rng_below(r, 23);
    const int bias = 1 + (int)rng_below(r, (1U << e) - 1);
    if (kind < 5)
        snprintf(name, sizeof name, "%s", named[rng_below(r, 4)]);
    else if (kind < 7)
        snprintf(name, sizeof name, "unorm%d", 1 + (int)rng_below(r, 32));
    else if (kind < 8)
        snprintf(name, sizeof name, "float%d.%d", e, m);
    else
        snprintf(name, sizeof name, "float%d.%db%d", e, m, bias);
    assert_int_not_equal(dp_format_parse(name, found), 0);
    return found[0];
}

/* Planes as people write them, binary32 numbers, and doubles that are neither. */
static double draw_plane(rng *r, double z) {
    char text[32];
    switch (rng_below(r, 3)) {
    case 0:
        snprintf(text, sizeof text, "%.*g", 1 + (int)rng_below(r, 4), z);
        return strtod(text, NULL);
    case 1:
        return (double)(float)z;
    default:
        return z;
    }
}

static void draw_rest(rng *r, dp_spec *spec) {
    spec->mapping = (dp_mapping)rng_below(r, 4);
    spec->format = draw_format(r);
    spec->rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
    spec->arith = rng_below(r, dp_arith_count());
    spec->model = DP_MODEL_FLOAT;
}

/* Near 0, far 0, planes as far on either side of the camera, both behind it, and any others. */
dp_setup reference_draw_signed(rng *r) {
    for (;;) {
        dp_spec spec = dp_spec_default();
        dp_setup setup;
        const bool usual = rng_below(r, 10) < 7;
        const double behind = draw_plane(r, usual ? rng_log(r, 1e-3, 1e3) : rng_log(r, 1e-12, 1e12));
        const double ahead = draw_plane(r, behind * (rng_below(r, 2) ? rng_log(r, 1e-6, 1e6) : rng_log(r, 0.5, 10.0)));
        const uint64_t kind = rng_below(r, 8);
        spec.znear = kind < 2 ? 0.0 : -behind;
        spec.zfar = kind == 2   ? 0.0
                    : kind == 3 ? behind
                    : kind == 4 ? -draw_plane(r, behind * (1.0 - rng_log(r, 1e-6, 0.9)))
                                : ahead;
        spec.ortho = 1;
        draw_rest(r, &spec);
        if (dp_setup_init(&setup, &spec) == DP_OK)
            return setup;
    }
}

dp_setup reference_draw(rng *r) {
    for (;;) {
        dp_spec spec = dp_spec_default();
        dp_setup setup;
        const bool usual = rng_below(r, 10) < 7;
        spec.znear = draw_plane(r, usual ? rng_log(r, 1e-3, 1e3) : rng_log(r, 1e-12, 1e12));
        const double ratio = rng_below(r, 3) ? rng_log(r, 1.0, 1e12) : 1.0 + rng_log(r, 1e-6, 1.0);
        spec.zfar = rng_below(r, 6) == 0 ? (double)INFINITY : draw_plane(r, spec.znear * ratio);
        spec.ortho = rng_below(r, 4) == 0;
        draw_rest(r, &spec);
        if (dp_setup_init(&setup, &spec) == DP_OK)
            return setup;
    }
}

/* ---- Places ------------------------------------------------------------------------------------------------------ */

/* The nearest depth of the range from which on the window depth is on the far side of `d`, as far as it is monotone. */
static uint32_t where_window(const reference_pipe *p, const reference_range *range, double d) {
    uint32_t lo = range->first;
    uint32_t hi = range->last;
    while (lo < hi) {
        const uint32_t middle = lo + (hi - lo) / 2;
        const double w = (double)reference_window(p, middle);
        if (p->reversed ? w <= d : w >= d)
            hi = middle;
        else
            lo = middle + 1;
    }
    return lo;
}

/* A power of two of the window depth, of its complement, or of NDC in [-1, 1]: the steps change there. */
static double draw_window(rng *r) {
    const double power = exp2(-(double)rng_below(r, 25));
    switch (rng_below(r, 4)) {
    case 0:
        return 1.0 - 0.5 * power;
    case 1:
        return 0.5 - 0.5 * power;
    case 2:
        return 0.5 + 0.5 * power;
    default:
        return rng_below(r, 4) ? power : power * power * power;
    }
}

/* Next to z, where z itself, its product with A or the clip depth is a power of two; or z, where it is nowhere. */
static double draw_power(rng *r, const reference_pipe *p, double z) {
    const double a = (double)p->a;
    const double offset = rng_below(r, 2) ? 0.0 : (double)p->b;
    const double value = rng_below(r, 3) ? a * z + offset : z;
    const double power = copysign(exp2(floor(log2(fabs(value)))), value);
    const double place = value == z || a == 0.0 ? power : (power - offset) / a;
    return place > 0.0 || z <= 0.0 ? place : z;
}

static double of_either_sign(rng *r, double size) {
    return rng_below(r, 2) ? size : -size;
}

/* A range with depths of 0 or less. */
static double place_signed(rng *r, const reference_pipe *p, const reference_range *range) {
    const double extent = range->zfar - range->znear;
    const double most = fmax(fabs(range->znear), fabs(range->zfar));
    const double any = range->znear + extent * rng_unit(r);
    switch (rng_below(r, 10)) {
    case 0:
        return range->znear;
    case 1:
        return range->zfar;
    case 2:
    case 3:
        return draw_power(r, p, -fabs(any));
    case 4:
        return reference_depth(where_window(p, range, draw_window(r)));
    case 5:
        return range->znear + extent * rng_log(r, 1e-9, 1.0);
    case 6:
        return range->zfar - extent * rng_log(r, 1e-9, 1.0);
    case 7: /* about 0, where the steps of z are the finest */
        return of_either_sign(r, rng_below(r, 4) ? most * rng_log(r, 1e-12, 1.0) : rng_log(r, 1e-46, most));
    case 8:
        return rng_below(r, 2) ? 0.0 : of_either_sign(r, exp2(-126.0) * rng_log(r, 1e-3, 1e3));
    default:
        return any;
    }
}

double reference_place(rng *r, const reference_pipe *p, const reference_range *range) {
    const double end = range->zfar;
    if (range->znear <= 0.0)
        return fmin(end, fmax(range->znear, place_signed(r, p, range)));
    const double usual_end = range->znear * 0x1p40 < end && rng_below(r, 4) ? range->znear * 0x1p40 : end;
    double z = rng_log(r, range->znear, usual_end);
    switch (rng_below(r, 8)) {
    case 0:
        return range->znear;
    case 1:
        return end;
    case 2:
        z = draw_power(r, p, z);
        break;
    case 3:
        z = reference_depth(where_window(p, range, draw_window(r)));
        break;
    case 4: /* next to a plane */
        z = range->znear * (1.0 + rng_log(r, 1e-7, 1.0));
        break;
    case 5:
        z = end * (1.0 - rng_log(r, 1e-7, 1.0));
        break;
    default:
        break;
    }
    return fmin(end, fmax(range->znear, z));
}

/* ---- Windows ----------------------------------------------------------------------------------------------------- */

static void add_run(reference_window_plan *plan, const reference_range *range, uint32_t centre, uint32_t count) {
    const uint32_t all = range->last - range->first + 1;
    if (count > all)
        count = all;
    uint32_t first = centre - range->first < count / 2 ? range->first : centre - count / 2;
    if (range->last - first < count - 1)
        first = range->last - (count - 1);
    if (plan->count > 0) { /* behind the run before it */
        const uint32_t behind = plan->run[plan->count - 1].first + plan->run[plan->count - 1].count;
        const uint32_t end = first + count;
        if (end <= behind)
            return;
        first = first < behind ? behind : first;
        count = end - first;
    }
    plan->run[plan->count].first = first;
    plan->run[plan->count++].count = count;
}

/* Where the keys from `first` to `last` begin to be above (or not below) `key`, as far as they are monotone. */
static uint32_t where_key(const reference_pipe *p, uint32_t first, uint32_t last, uint32_t key, bool above) {
    while (first < last) {
        const uint32_t middle = first + (last - first) / 2;
        const uint32_t k = reference_key(p, middle);
        if (above ? k > key : k >= key)
            last = middle;
        else
            first = middle + 1;
    }
    return first;
}

reference_window_plan reference_plan(const dp_setup *setup, const reference_pipe *p, double place, uint32_t depths) {
    const reference_range range = reference_range_of(setup);
    reference_window_plan plan = {.place = place};
    const uint32_t x = reference_rank(place);
    const uint32_t reach = reference_rank(fmin(range.zfar, place + reference_bound(setup, place))) - x;
    if (reach <= depths / 2) {
        add_run(&plan, &range, x + reach / 2, depths);
        return plan;
    }
    const uint32_t key = reference_key(p, x);
    const uint32_t begin = where_key(p, range.first, x, key, false);
    const uint32_t end = where_key(p, x, range.last, key, true);
    const double z = fmax(range.znear, reference_depth(begin));
    const uint32_t behind = reference_rank(fmin(range.zfar, z + reference_bound(setup, z)));
    add_run(&plan, &range, begin, depths / 5 * 2);
    add_run(&plan, &range, end < behind ? end : behind, depths / 5 * 2);
    add_run(&plan, &range, end < behind ? behind : end, depths / 5);
    return plan;
}
