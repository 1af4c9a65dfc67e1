/* SPDX-License-Identifier: MIT */
#include "core/curve.h"

#include "core/elementary.h"
#include "core/expansion.h"
#include "core/logarithm.h"

/* A point's shares S and T of the near and the far end, S + T = whole. */
typedef struct shares {
    double near, far, whole;
} shares;

/* From the nearer one of 0 and 1, which is exact: one rounding each. */
static shares ranged_shares(const dp_setup *setup, dp_point p) {
    const int upper = p.comp < p.num;
    const double num = upper ? p.comp : p.num;
    const double near = upper ? 1.0 - setup->ends[0] : setup->ends[0];
    const double far = upper ? 1.0 - setup->ends[1] : setup->ends[1];
    const double sign = upper != setup->reversed ? -1.0 : 1.0;
    shares s = {sign * fma(far, p.den, -num), -sign * fma(near, p.den, -num), setup->span * p.den};
    if (s.near <= 0.0)
        s = (shares){0.0, s.whole, s.whole};
    if (s.far <= 0.0)
        s = (shares){s.whole, 0.0, s.whole};
    return s;
}

static shares shares_of(const dp_setup *setup, dp_point p) {
    if (setup->ranged)
        return ranged_shares(setup, p);
    return setup->reversed ? (shares){p.num, p.comp, p.den} : (shares){p.comp, p.num, p.den};
}

/* The divisor that every perspective formula shares: f S + n T, or S when f is infinite. */
static double divisor(const dp_setup *setup, shares s) {
    return isinf(setup->spec.zfar) ? s.near : setup->spec.zfar * s.near + setup->spec.znear * s.far;
}

/* LOG: how far behind its anchor a point lies; the sum with a far anchor loses bits that a distance needs. */
static double beyond_anchor(const dp_setup *setup, dp_point p) {
    return dp_expm1(p.num / p.den * setup->kappa) / setup->log_c;
}

double dp_curve_eye(const dp_setup *setup, dp_point p) {
    const double n = setup->spec.znear;
    const double f = setup->spec.zfar;
    const shares s = shares_of(setup, p);
    if (setup->ranged && (s.near == 0.0 || s.far == 0.0)) /* what lies beyond an end is that plane */
        return s.far == 0.0 ? n : f;
    if (setup->curve == DP_CURVE_PERSPECTIVE)
        return (isinf(f) ? n : n * f) * s.whole / divisor(setup, s);
    if (setup->spans_zero)
        return dp_curve_gap(setup, p, 0.0); /* the two terms cancel about depth 0, and comp may be rounded */
    if (setup->curve == DP_CURVE_LINEAR)
        return (setup->anchor * s.near + f * s.far) / s.whole;
    return setup->anchor + beyond_anchor(setup, p);
}

/* sign (end den - num), exactly; times 2^150, so that no product with a depth underflows. */
static void exact_share(const dp_setup *setup, dp_point p, int end, double out[DP_SUM_TERMS]) {
    const double up = (end == 1) == !setup->reversed ? 0x1p150 : -0x1p150;
    const dp_pair product = dp_two_product(setup->ends[end] * up, p.den);
    const dp_pair rest = dp_two_sum(product.hi, -p.num * up);
    out[0] = product.lo;
    out[1] = rest.lo;
    out[2] = rest.hi;
}

/* The gap of a point between the ends of a viewport's range; what lies beyond them is an end itself. */
static double ranged_gap(const dp_setup *setup, dp_point p, double z) {
    const double n = setup->curve == DP_CURVE_LINEAR ? setup->anchor : setup->spec.znear;
    const double f = setup->spec.zfar;
    const shares s = shares_of(setup, p);
    const double below = setup->curve == DP_CURVE_LINEAR ? s.whole : divisor(setup, s);
    if (s.far == 0.0 || s.near == 0.0 || z > 0x1p600)
        return dp_curve_eye(setup, p) - z;
    double near[DP_SUM_TERMS], far[DP_SUM_TERMS];
    exact_share(setup, p, 1, near);
    exact_share(setup, p, 0, far);
    const double gap = setup->curve == DP_CURVE_LINEAR ? dp_exact_sums(1.0, near, n, z, 1.0, far, f, z)
                       : isinf(f)                      ? dp_exact_sums(1.0, near, n, z, n, far, 1.0, 0.0)
                                                       : dp_exact_sums(f, near, n, z, n, far, f, z);
    return gap * 0x1p-150 / below;
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
    if (setup->ranged)
        return ranged_gap(setup, p, z);
    if (setup->curve == DP_CURVE_LINEAR) {
        const double a = setup->anchor;
        const double end = setup->reversed ? f : a;
        return dp_exact_residual(1.0, p.den, end, z, sign, p.num, f, a) / p.den;
    }
    const double below = divisor(setup, shares_of(setup, p));
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
    if (setup->ranged && shares_of(setup, b).near == 0.0)
        return isinf(setup->spec.zfar) ? HUGE_VAL : -ranged_gap(setup, a, setup->spec.zfar);
    if (setup->ranged && shares_of(setup, a).far == 0.0)
        return ranged_gap(setup, b, setup->spec.znear);
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
    if (setup->ranged) {
        const dp_pair whole = dp_two_product(den, setup->span);
        const double wholes[DP_SUM_TERMS] = {whole.lo, whole.hi}, nums[DP_SUM_TERMS] = {num};
        const double rest = isinf(f) ? dp_exact_sums(1.0, wholes, n, 0.0, -z, nums, 1.0, 0.0)
                                     : dp_exact_sums(f, wholes, n, 0.0, -z, nums, f, n);
        return rest > 0.0 ? z * (isinf(f) ? z * num : z * num * (f - n)) / rest : HUGE_VAL;
    }
    const double rest = isinf(f) ? dp_exact_residual(1.0, den, n, 0.0, -z, num, 1.0, 0.0)
                                 : dp_exact_residual(f, den, n, 0.0, -z, num, f, n);
    const double reach = isinf(f) ? z * num : z * num * (f - n);
    return rest > 0.0 ? z * reach / rest : HUGE_VAL;
}
