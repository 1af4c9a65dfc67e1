/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How much is enough: the fewest units that reach a goal, at a depth and over a range of them. */
#include <math.h>

#include "bias/bias.h"
#include "bias/unit.h"
#include "core/bits.h"
#include "core/elementary.h"
#include "core/search.h"

enum { BINARY32_MANTISSA = 23 };
static const double units_most = 0x1p31; /* beyond what an integer bias can hold */

/* The window distance from z to z - gap; INFINITY when that lies before the near plane. */
static double window_of_gap(const dp_setup *setup, double z, double gap) {
    const double c = setup->log_c;
    const double to = fmax(z - gap, setup->spec.znear);
    if (gap == 0.0)
        return 0.0;
    if (z < setup->spec.znear + gap) /* near + gap itself, as rounded, leads to the near plane */
        return (double)INFINITY;
    return setup->curve == DP_CURVE_PERSPECTIVE ? gap / (setup->kappa * z * to)
           : setup->curve == DP_CURVE_LINEAR    ? gap / setup->kappa
                                                : -dp_log1p(-c * gap / (c * (z - setup->anchor) + 1.0)) / setup->kappa;
}

/*
 * The window distance that certainly leads from one code to another, for depths below 2^(e+1) that are binary32
 * numbers. In a format other than binary32 the sum d + o is rounded to binary32 and then to a code that it may meet at
 * any alignment; layers that are sampled apart have, besides m, two depths that were rounded by themselves.
 */
static double certain_step(const bias_goal *goal, const dp_format *format, int e, double r, double m) {
    const bool is_unorm = format->kind == DP_FORMAT_UNORM;
    const bool is_binary32 = !is_unorm && format->mantissa_bits == BINARY32_MANTISSA;
    const double step = is_unorm ? 1.0 / (double)format->code_max : ldexp(1.0, e - format->mantissa_bits);
    const double half = fmin(0x1p-25, 0x1p-24 * (ldexp(2.0, e) + step + m)); /* half a step of binary32 below 1 */
    const double apart = m > 0.0 ? m + 2.0 * half : 0.0;
    if (goal->api->guaranteed)
        return r + apart;
    return (is_binary32 ? step : is_unorm ? step + half : 2.0 * step + half) + apart;
}

/* The least that a program can set: whole where the API counts in r, a binary32 number where it takes a float. */
static double round_up(const bias_api *api, const dp_format *format, double units) {
    const bias_rule rule = format->kind == DP_FORMAT_FLOAT ? api->real : api->unorm;
    const double counted = rule == BIAS_ONE ? units : ceil(units);
    const double rounded = api->whole ? counted : (double)dp_float_up(counted);
    return rounded <= units_most ? rounded : (double)INFINITY;
}

/* How many units reach a window distance. One that is no normal binary32 number may be flushed to 0: none suffice. */
static double units_to(double window, double r) {
    return r >= 0x1p-126 ? window / r : window > 0.0 ? (double)INFINITY : 0.0;
}

double bias_units(const bias_api *api, const dp_format *format, double d, double window) {
    const double outward = api->binary32 ? DP_ROUNDINGS32_2 : DP_ROUNDINGS_30;
    return round_up(api, format, units_to((1.0 + outward) * window, bias_unit_at(api, format, d).least));
}

/* The goal asks this of units that make an offset of `window`. */
static double asked_of(const bias_goal *goal, const dp_format *format, double window, double r) {
    return goal->judged ? units_to(window, r) : round_up(goal->api, format, units_to(fmax(window, 0.0), r));
}

/*
 * Whether the clamp, or the planes, leave a layer no room to move by `window` at z, its depth having been displaced by
 * `off`: beyond a plane both depths are clamped to it.
 */
static bool is_held(const dp_setup *setup, const bias_goal *goal, double z, double window, double off) {
    const dp_format *format = &setup->spec.format;
    const double code = format->kind == DP_FORMAT_UNORM ? 1.0 / (double)format->code_max : 0.0; /* r may be less */
    const double d = dp_window(setup, z), whole = (fmax(window, code) + off) * (1.0 + 0x1p-20);
    if (goal->clamp > 0.0 && whole > goal->clamp)
        return true;
    return goal->judged &&
           (whole > fabs(d - setup->ends[0]) || (setup->spec.triangles.width > 0 && whole > fabs(setup->ends[1] - d)));
}

/* bias_needed() at z for a primitive whose greatest window depth has the exponent e. */
static double needed_with(const dp_setup *setup, const bias_goal *goal, double z, int e) {
    const dp_format *format = &setup->spec.format;
    const double r = bias_unit_least(goal->api, format, e);
    const double m = bias_window_slope(setup, z, goal->slope);
    const double step = certain_step(goal, format, e, bias_worth(goal->api, format, e), m);
    const double gap = window_of_gap(setup, z, goal->gap);
    const double window = fmax(step, gap) - goal->factor * m;
    /* Covers the roundings above and, where o itself is rounded to binary32, those; a single step is exact. */
    const double outward = gap <= step && m == 0.0 ? 0.0 : goal->api->binary32 ? DP_ROUNDINGS32_2 : DP_ROUNDINGS_30;
    if (is_held(setup, goal, z, fmax(step, gap), 0.0))
        return (double)INFINITY;
    return asked_of(goal, format, window + (fmax(step, gap) + fabs(goal->factor) * m) * outward, r);
}

double bias_factor_least(const dp_setup *setup) {
    static const double spare = 1.0 + 0x1p-9; /* for the roundings of products and sums, see needed_slanted() */
    dp_coplanar apart = {0};
    if (setup->spec.triangles.width == 0)
        return 0.0;
    if (dp_coplanar_over(setup, setup->spec.znear, setup->spec.znear, &apart) != DP_OK || !(apart.lost < 0.5))
        return (double)INFINITY;
    return ceil(apart.pixels / (1.0 - apart.lost) * spare * 0x1p12) * 0x1p-12;
}

/*
 * The part of the need that the slope adds, in window depth: at m and below, or at any. The rasterizer's own slope, at
 * least (1 - lost) m - lost_window, is never below 0: the factor takes nothing, and a larger one takes no more.
 */
static double taken_by_slope(const dp_setup *setup, const bias_goal *goal, const dp_coplanar *apart, double m) {
    const double unseen = apart->lost < 1.0 ? apart->lost_window / (1.0 - apart->lost) : (double)INFINITY;
    const double paid =
        (apart->pixels - goal->factor) * m + fabs(goal->factor) * (apart->lost * m + apart->lost_window);
    if (goal->slope == 0.0)
        return bias_factor_least(setup) * apart->lost_window;
    if (goal->factor > 0.0 && m <= unseen)
        return apart->pixels * m;
    return goal->factor > 0.0 ? fmax(paid, apart->pixels * unseen) : paid;
}

/* By how much the slope displaces two drawings at z: at any slant a triangle, at least a pixel high, has no steeper one
 * than its range of depths. */
static double off_by_slope(const dp_setup *setup, const bias_goal *goal, const dp_coplanar *apart, double z) {
    const double nearest = fmax(z / setup->spec.triangles.depth, setup->spec.znear);
    const double farthest = fmin(z * setup->spec.triangles.depth, setup->spec.zfar);
    const double range = fabs(dp_window(setup, nearest) - dp_window(setup, farthest)) + apart->window;
    const bool any = goal->slope == 0.0;
    return any && goal->clamp > 0.0 ? (double)INFINITY
                                    : apart->pixels * (any ? range : bias_window_slope(setup, z, goal->slope));
}

/*
 * bias_needed() for one plane drawn twice, at every depth of a range. A primitive's greatest depth is at least the
 * pixel's, which is displaced: r is that of the binade below where it is near the end of one, and the step that of the
 * binade above. At any slant a displacement by more than `beyond` of the depth is paid for by what the factor has to
 * spare, 2^-9 of it.
 */
static double needed_slanted(const dp_setup *setup, const bias_goal *goal, double lo, double hi, double *worst) {
    const dp_format *format = &setup->spec.format;
    const double ends[2] = {lo, hi};
    const double d_lo = fmin(dp_window(setup, lo), dp_window(setup, hi));
    const double d_hi = fmax(dp_window(setup, lo), dp_window(setup, hi));
    const double steepest = fmax(bias_window_slope(setup, lo, goal->slope), bias_window_slope(setup, hi, goal->slope));
    dp_coplanar apart;
    *worst = lo;
    if (dp_coplanar_over(setup, lo, hi, &apart) != DP_OK ||
        (goal->slope == 0.0 && (isinf(goal->factor) || goal->factor < bias_factor_least(setup))))
        return (double)INFINITY;
    const double off = apart.window + apart.pixels * steepest;
    const int here = bias_exponent_of(format, fmin(d_hi + off, 1.0));
    const double least_step = certain_step(goal, format, here, bias_worth(goal->api, format, here), 0.0);
    const double beyond = goal->slope == 0.0 ? fmin(256.0 * (least_step + apart.window) / d_lo, 1.0) : 0.0;
    const int below = bias_exponent_of(format, fmax(d_lo * (1.0 - beyond) - off, 0.0));
    const double r = bias_unit_least(goal->api, format, below);
    const int above = bias_exponent_of(format, fmin(d_hi * (1.0 + beyond) + off, 1.0));
    const double step = certain_step(goal, format, above, bias_worth(goal->api, format, below), 0.0) + apart.window;
    double needed = 0.0;
    for (int i = 0; i < 2; i++) {
        const double m = bias_window_slope(setup, ends[i], goal->slope);
        const double whole = fmax(step, window_of_gap(setup, ends[i], goal->gap));
        const double window = whole + taken_by_slope(setup, goal, &apart, m);
        const double outward = 0x1p-20 * (fabs(window) + (apart.pixels + fabs(goal->factor)) * m);
        const bool held = is_held(setup, goal, ends[i], whole, off_by_slope(setup, goal, &apart, ends[i]));
        const double units = held ? (double)INFINITY : asked_of(goal, format, window + outward, r);
        if (i == 0 || units > needed) {
            needed = units;
            *worst = ends[i];
        }
    }
    return needed;
}

/* Binade by binade of d, from the camera outwards, each in three parts: only those at its ends are near another one. */
static double needed_over_slanted(const dp_setup *setup, const bias_goal *goal, double lo, double hi, double *worst) {
    static const double parts[4] = {1.0, 1.0 + 0x1p-6, 2.0 - 0x1p-5, 2.0};
    const dp_format *format = &setup->spec.format;
    const double d_lo = dp_window(setup, lo), d_hi = dp_window(setup, hi);
    const int first = bias_exponent_of(format, fmin(d_lo, d_hi));
    const int last = bias_exponent_of(format, fmax(d_lo, d_hi));
    double most = -(double)INFINITY;
    for (int i = 0; i < 3 * (last - first + 1); i++) {
        const int at = setup->reversed ? 3 * (last - first + 1) - 1 - i : i;
        double ends[2], z;
        for (int end = 0; end < 2; end++) {
            const double d = fmin(ldexp(parts[at % 3 + end], first + at / 3), 1.0);
            ends[end] = fmin(fmax(dp_eye(setup, d, 1.0 - d), lo), hi);
        }
        if (at == 0) /* depths below the least exponent's */
            ends[0] = d_lo < d_hi ? lo : hi;
        const double needed = needed_slanted(setup, goal, fmin(ends[0], ends[1]), fmax(ends[0], ends[1]), &z);
        if (needed > most) {
            most = needed;
            *worst = z;
        }
    }
    return most;
}

double bias_needed(const dp_setup *setup, const bias_goal *goal, double z) {
    double worst;
    if (setup->spec.triangles.width > 0)
        return needed_slanted(setup, goal, z, z, &worst);
    return needed_with(setup, goal, z, bias_exponent_of(&setup->spec.format, dp_window(setup, z)));
}

/*
 * r and the steps change only where the exponent of d does, and between two such places the need is monotone in z, or
 * was 0 before it rises: the greatest is at an end of the range or of a binade of d, seen from either side.
 */
double bias_needed_over(const dp_setup *setup, const bias_goal *goal, double lo, double hi, double *worst) {
    if (setup->spec.triangles.width > 0)
        return needed_over_slanted(setup, goal, lo, hi, worst);
    const dp_format *format = &setup->spec.format;
    const double d_lo = dp_window(setup, lo);
    const double d_hi = isinf(hi) ? setup->ends[1] : dp_window(setup, hi);
    const int first = bias_exponent_of(format, fmin(d_lo, d_hi));
    const int last = bias_exponent_of(format, fmax(d_lo, d_hi));
    double most = -(double)INFINITY;
    for (int i = 0; i <= last - first; i++) {
        const int e = setup->reversed ? last - i : first + i; /* from the camera outwards */
        const double least = e == first ? fmin(ldexp(1.0, e), fmin(d_lo, d_hi)) : ldexp(1.0, e); /* below all binades */
        const double ends[2] = {setup->reversed ? ldexp(1.0, e + 1) : least,
                                setup->reversed ? least : ldexp(1.0, e + 1)};
        for (int end = 0; end < 2; end++) {
            const double d = fmin(ends[end], 1.0);
            const double z = fmin(fmax(dp_eye(setup, d, 1.0 - d), lo), hi);
            const double needed = needed_with(setup, goal, z, e);
            if (needed > most) {
                most = needed;
                *worst = z;
            }
        }
    }
    return most;
}

static bool enough_between(const dp_setup *setup, const bias_goal *goal, double units, double a, double b) {
    double worst;
    const double needed =
        a == b ? bias_needed(setup, goal, a) : bias_needed_over(setup, goal, fmin(a, b), fmax(a, b), &worst);
    return isfinite(needed) && needed <= units;
}

/* The depth farthest from `start` towards `end` up to which a bias is enough. */
static double enough_towards(const dp_setup *setup, const bias_goal *goal, double units, double start, double end) {
    if (start == end || enough_between(setup, goal, units, start, end))
        return end;
    dp_edge e = {.holds = start, .fails = isinf(end) ? 1e300 : end, .apart = 0x1p-48};
    for (double z; dp_edge_between(&e, &z);)
        *(enough_between(setup, goal, units, start, z) ? &e.holds : &e.fails) = z;
    return e.holds;
}

void bias_enough_over(const dp_setup *setup, const bias_goal *goal, double units, double lo, double hi, double *from,
                      double *to) {
    enum { TRIED = 64 };
    const double last = isinf(hi) ? 0x1p64 * lo : hi; /* an infinite far is that of a perspective: lo is positive */
    double start = enough_between(setup, goal, units, lo, lo) ? lo : fmin(last, hi);
    for (int i = 1; i < TRIED && !enough_between(setup, goal, units, start, start); i++)
        start = lo > 0.0 ? lo * dp_pow(last / lo, (double)i / TRIED) : lo + (last - lo) * i / TRIED;
    *from = *to = (double)NAN;
    if (!enough_between(setup, goal, units, start, start))
        return;
    *from = enough_towards(setup, goal, units, start, lo);
    *to = enough_towards(setup, goal, units, start, hi);
}
