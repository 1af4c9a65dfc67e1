/* SPDX-License-Identifier: MIT */
#include "core/curve.h"

#include "core/elementary.h"
#include "core/expansion.h"
#include "core/logarithm.h"

/*
 * The divisor that every perspective formula shares: f S + n T with S + T = den, or S when f is infinite, where S and
 * T are the point's shares of the near and the far end.
 */
static double divisor(const dp_setup *setup, dp_point p) {
    const double to_near = setup->reversed ? p.num : p.comp;
    const double to_far = setup->reversed ? p.comp : p.num;
    return isinf(setup->spec.zfar) ? to_near : setup->spec.zfar * to_near + setup->spec.znear * to_far;
}

/* LOG: how far behind its anchor a point lies; the sum with a far anchor loses bits that a distance needs. */
static double beyond_anchor(const dp_setup *setup, dp_point p) {
    return dp_expm1(p.num / p.den * setup->kappa) / setup->log_c;
}

double dp_curve_eye(const dp_setup *setup, dp_point p) {
    const double n = setup->spec.znear;
    const double f = setup->spec.zfar;
    if (setup->curve == DP_CURVE_PERSPECTIVE)
        return (isinf(f) ? n : n * f) * p.den / divisor(setup, p);
    if (setup->spans_zero)
        return dp_curve_gap(setup, p, 0.0); /* the two terms cancel about depth 0, and comp may be rounded */
    if (setup->curve == DP_CURVE_LINEAR) {
        const double to_near = setup->reversed ? p.num : p.comp;
        const double to_far = setup->reversed ? p.comp : p.num;
        return (setup->anchor * to_near + f * to_far) / p.den;
    }
    return setup->anchor + beyond_anchor(setup, p);
}

double dp_curve_gap(const dp_setup *setup, dp_point p, double z) {
    const double n = setup->spec.znear;
    const double f = setup->spec.zfar;
    const double sign = setup->reversed ? -1.0 : 1.0;
    if (setup->curve == DP_CURVE_LOG) {
        const dp_pair top = {setup->log_hi, setup->log_lo};
        return (z - setup->anchor + 1.0 / setup->log_c) *
               dp_expm1(dp_scaled_difference(p.num, p.den, top, dp_log1p_excess(z, setup->anchor, setup->log_by)));
    }
    if (setup->curve == DP_CURVE_LINEAR) {
        const double a = setup->anchor;
        const double end = setup->reversed ? f : a;
        return dp_exact_residual(1.0, p.den, end, z, sign, p.num, f, a) / p.den;
    }
    const double below = divisor(setup, p);
    if (below == 0.0)
        return HUGE_VAL;
    if (z > 0x1p600) /* products would overflow; no point of a format is anywhere near */
        return dp_curve_eye(setup, p) - z;
    if (isinf(f))
        return (setup->reversed ? dp_exact_residual(n, p.den, 1.0, 0.0, -z, p.num, 1.0, 0.0)
                                : dp_exact_residual(1.0, p.den, n, z, z, p.num, 1.0, 0.0)) /
               below;
    return (setup->reversed ? dp_exact_residual(n, p.den, f, z, -z, p.num, f, n)
                            : dp_exact_residual(f, p.den, n, z, z, p.num, f, n)) /
           below;
}

/* b - a along d, to full accuracy: numerators over one denominator differ exactly. */
static double distance(dp_point a, dp_point b) {
    if (a.den == b.den)
        return fabs(b.num - a.num) / a.den;
    const dp_pair p = dp_two_product(b.num, a.den);
    const dp_pair q = dp_two_product(a.num, b.den);
    return fabs((p.hi - q.hi) + (p.lo - q.lo)) / a.den / b.den;
}

double dp_curve_span(const dp_setup *setup, dp_point a, dp_point b) {
    const double step = distance(a, b);
    if (setup->curve == DP_CURVE_PERSPECTIVE)
        return step == 0.0 ? 0.0 : dp_curve_eye(setup, a) * dp_curve_eye(setup, b) * (step * setup->kappa);
    if (setup->curve == DP_CURVE_LINEAR)
        return step * setup->kappa;
    return (beyond_anchor(setup, a) + 1.0 / setup->log_c) * dp_expm1(step * setup->kappa);
}

double dp_curve_reach(const dp_setup *setup, double z, double step) {
    const double change = step * setup->kappa;
    if (setup->curve == DP_CURVE_PERSPECTIVE)
        return z * z * change;
    if (setup->curve == DP_CURVE_LINEAR)
        return change;
    const double lost = 0x1p-52 * setup->anchor; /* at most, of what lies behind the anchor, when z was rounded */
    return (z - setup->anchor + lost + 1.0 / setup->log_c) * dp_expm1(change);
}

double dp_curve_ahead(const dp_setup *setup, double num, double den, double z) {
    if (setup->curve == DP_CURVE_LINEAR)
        return num / den * setup->kappa;
    if (setup->curve == DP_CURVE_LOG)
        return (z - setup->anchor + 1.0 / setup->log_c) * dp_expm1(num / den * setup->kappa);
    /* z h / (1 - h) with h = z kappa num/den; 1 - h cancels where one step reaches far beyond z */
    const double n = setup->spec.znear;
    const double f = setup->spec.zfar;
    const double rest = isinf(f) ? dp_exact_residual(1.0, den, n, 0.0, -z, num, 1.0, 0.0)
                                 : dp_exact_residual(f, den, n, 0.0, -z, num, f, n);
    const double reach = isinf(f) ? z * num : z * num * (f - n);
    return rest > 0.0 ? z * reach / rest : HUGE_VAL;
}
