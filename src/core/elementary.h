/* SPDX-License-Identifier: MIT */
/*
 * Logarithms, exponentials, angles and lengths: the same bits with every compiler, C library and processor.
 *
 * They stand in for the functions of math.h whose last bits differ between C libraries. No number that is shown comes
 * from those: only from sums, products, quotients, square roots and functions without a choice, such as floor and fma.
 * Arguments, infinities, NaN and zeros: as in math.h, but where it is said.
 *
 * Bounds are in units in the last place; a correctly rounded function has 0.5. Results below 2^-1022 are rounded twice:
 * half a unit more. Derived in depthprec(7), "The elementary functions".
 */
#ifndef CORE_ELEMENTARY_H
#define CORE_ELEMENTARY_H

/* 0.51 units */
double dp_log(double x);
double dp_log1p(double x);
double dp_log2(double x);
double dp_log10(double x);
double dp_exp(double x);
double dp_expm1(double x);
double dp_exp2(double x);

/* x^y for x >= 0, NaN below: 0.51 + |y log x|/256 units, so powers of ten are exact from 1 to 1e22. */
double dp_pow(double x, double y);

/* Angles in radians, up to 1e6 of either sign; beyond, NaN. 0.54 units */
double dp_sin(double x);
double dp_cos(double x);
double dp_tan(double x);

#define DP_DEGREE 0x1.1df46a2529d39p-6 /* in radians */

/* tan(fov/2) of a field of view in degrees: half of what a picture spans, at a depth of 1. */
double dp_half_tangent(double fov);

/* 0.54 units; dp_asin() 3.1 */
double dp_atan(double x);
double dp_atan2(double y, double x);
double dp_asin(double x);

/* 0.51 units */
double dp_hypot(double x, double y);

/* In binary32, within 0.501 units: */
float dp_expf(float x);
float dp_expm1f(float x);
float dp_exp2f(float x);

#endif
