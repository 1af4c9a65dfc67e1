/* SPDX-License-Identifier: MIT */
/* The distance from which on two surfaces' codes differ, however they meet the lattice: exact and staged. */
#include "core/boundary.h"
#include "core/curve.h"
#include "core/engine.h"
#include "core/expansion.h"
#include "core/extremes.h"
#include "core/rounding.h"
#include "depthprec/depth.h"

/* The sign of d(z) - v, decided exactly where the computed d is too near to v. */
static int compare_window(const dp_setup *setup, double z, double d, double v) {
    if (fabs(d - v) > v * DP_WINDOW_ERROR)
        return d > v ? 1 : -1;
    const double gap = dp_curve_gap(setup, dp_point_make(v, 1.0), z);
    return gap == 0.0 ? 0 : (gap < 0.0) != setup->reversed ? 1 : -1;
}

/* The step of a FLOAT that certainly leads from the cell of z to another, towards far: see dp_separation(). */
static double float_step(const dp_setup *setup, double z) {
    const dp_format *format = &setup->spec.format;
    const double d = dp_window(setup, z);
    int e = dp_binade(format, d);
    const int lowest = 1 - format->bias;
    if (e > lowest && compare_window(setup, z, d, dp_power2(e)) < 0)
        e--;
    else if (compare_window(setup, z, d, dp_power2(e + 1)) >= 0)
        e++;
    const double step = dp_step_num(format, e);
    if (!setup->reversed && compare_window(setup, z, d, dp_power2(e + 1) - step) > 0)
        return 2.0 * step;
    return step;
}

static double exact_step(const dp_setup *setup, double z) {
    return setup->spec.format.kind == DP_FORMAT_UNORM ? 2.0 : float_step(setup, z);
}

/*
 * The stages widen a step of the format by at most one binary32 step each: a cell is what rounds into one run of
 * window depths, and that run into one run of NDC depths. Each step is taken where it is larger, at z or behind it.
 */
static double staged_step(const dp_setup *setup, double z) {
    const dp_format *format = &setup->spec.format;
    const double here = dp_window(setup, z) * (1.0 + DP_WINDOW_ERROR);
    const double code = exact_step(setup, z) / setup->den;
    const double first = code + dp_staged_window_step(setup, here) + dp_staged_ndc_step(setup, here);
    const double there = setup->reversed ? here - 4.0 * first : here + 4.0 * first;
    const double wide = setup->reversed || format->kind == DP_FORMAT_UNORM
                            ? code
                            : larger(code, dp_step_num(format, dp_binade(format, there)));
    const double ndc = larger(dp_staged_ndc_step(setup, here), dp_staged_ndc_step(setup, there));
    const double window = larger(dp_staged_window_step(setup, here), dp_staged_window_step(setup, fabs(there)));
    return wide + ndc + (dp_staged_twice(setup) ? window : 0.0);
}

/* The step of the format where d is at most `d`, or, at a binade end, the larger one that lies ahead. */
static double largest_code_step(const dp_setup *setup, double d) {
    const dp_format *format = &setup->spec.format;
    if (format->kind == DP_FORMAT_UNORM)
        return 2.0 / setup->den;
    const double step = dp_step_num(format, dp_binade(format, d));
    return setup->reversed ? step : dp_step_num(format, dp_binade(format, d + step));
}

/* The least and the greatest window depth of any depth of a range in any camera of a run: at two of the corners. */
static void window_range(const dp_setup *one, const dp_setup *other, double nearest, double farthest, double *low,
                         double *high) {
    const double a = dp_window(one, nearest), b = dp_window(one, farthest);
    *low = smaller(a, b);
    *high = larger(a, b);
    if (other != one) {
        const double c = dp_window(other, nearest), d = dp_window(other, farthest);
        *low = smaller(*low, smaller(c, d));
        *high = larger(*high, larger(c, d));
    }
    *low *= 1.0 - 2.0 * DP_WINDOW_ERROR;
    *high *= 1.0 + 2.0 * DP_WINDOW_ERROR;
}

/*
 * Every term of staged_step() at the end of the range where it is largest: of one camera by exact_step(), which knows
 * the side of a binade's end on which a depth lies even where the computed d does not.
 */
double dp_separation_step(const dp_setup *setup, const dp_setup *other, double nearest, double farthest, int half) {
    double low, high;
    window_range(setup, other, nearest, farthest, &low, &high);
    const double code = other == setup ? exact_step(setup, setup->reversed ? nearest : farthest) / setup->den
                                       : largest_code_step(setup, high);
    if (setup->spec.model == DP_MODEL_EXACT || dp_staged_is_exact(setup))
        return code;
    const double first = code + dp_staged_window_step(setup, high) +
                         larger(dp_staged_ndc_step(setup, low), dp_staged_ndc_step(setup, high));
    if (setup->reversed)
        low -= 4.0 * first;
    else
        high = half ? smaller(high + 4.0 * first, 1.0 - 0x1p-24) : high + 4.0 * first; /* no stored depth is beyond */
    const dp_format *format = &setup->spec.format;
    const double wide = setup->reversed || format->kind == DP_FORMAT_UNORM
                            ? code
                            : larger(code, dp_step_num(format, dp_binade(format, high)));
    const double ndc = larger(dp_staged_ndc_step(setup, low), dp_staged_ndc_step(setup, high));
    const double window = larger(dp_staged_window_step(setup, fabs(low)), dp_staged_window_step(setup, high));
    const double finest = smaller(dp_staged_ndc_step(setup, low), dp_staged_ndc_step(setup, high));
    const int whole = half && window <= finest; /* all below 1/2, where x/2 + 1/2 is exact */
    return wide + ndc + (dp_staged_twice(setup) && !whole ? window : 0.0);
}

double dp_lattice_least(const dp_setup *outer, const dp_setup *inner, double z, int half) {
    double low, high;
    window_range(outer, inner, z, z, &low, &high);
    const double step = dp_step_num(&outer->spec.format, dp_binade(&outer->spec.format, low)) / outer->den;
    return fabs(dp_curve_ahead(inner, half ? step * dp_error_share(outer) : step, 1.0, z)) * (1.0 - DP_ROUNDINGS_8190);
}

double dp_lattice_exact(const dp_setup *setup, double z) {
    return dp_curve_ahead(setup, exact_step(setup, z), setup->den, z) * dp_curve_outward(setup);
}

double dp_lattice_rate(const dp_setup *setup, double z) {
    if (setup->curve != DP_CURVE_PERSPECTIVE)
        return HUGE_VAL;
    return largest_code_step(setup, dp_window(setup, z) * (1.0 + 2.0 * DP_WINDOW_ERROR)) * setup->kappa * DP_OUTWARD;
}

double dp_lattice_separation(const dp_setup *setup, double z) {
    if (setup->spec.model == DP_MODEL_EXACT)
        return dp_lattice_exact(setup, z);
    const double s = dp_staged_is_exact(setup) ? dp_curve_ahead(setup, exact_step(setup, z), setup->den, z)
                                               : dp_curve_ahead(setup, staged_step(setup, z), 1.0, z);
    return (s + dp_eye_rounding(z, z + s)) * dp_curve_outward(setup);
}

int dp_is_certain(const dp_setup *setup, double z, double separation) {
    const dp_pair left = dp_two_sum(setup->spec.zfar, -z);
    return separation < left.hi || (separation == left.hi && left.lo >= 0.0);
}
