/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/claim.h"

#include <math.h>

#include "method/linearize.h"

static const double unit64 = 0x1p-53;

/* ---- interval ---------------------------------------------------------------------------------------------------- */

static const double steps24 = 0x1p24 - 1;

/* The farthest whole cell reaches from z1 to z1 (1 + this); 2 where the far plane is infinite. */
static double far_cell(double ratio) {
    const double g = (ratio - 1) / steps24;
    return 1 / (1 / g + 0.5);
}

double claim_rule(double ratio) {
    return (1 + far_cell(ratio)) / (1 - 1 / ratio) - 1;
}

double claim_first_order(double ratio) {
    return far_cell(ratio);
}

/* Of the curve, and of `roundings` of depths next to near, where a cell is the smallest part of its depth. */
static double neighbours(double ratio, double roundings) {
    const double g = (ratio - 1) / steps24;
    return 0.75 / (1 / (g * g) + 2 / g) + roundings * steps24 / (1 - 1 / ratio);
}

double claim_neighbours(double ratio) {
    return neighbours(ratio, 6 * unit64);
}

double claim_neighbours32(double ratio) {
    return neighbours(ratio, CLAIM_UNIT + 6 * unit64);
}

double claim_bound(double ratio) {
    return 2 * (2 + 2 / (1 - 1 / ratio)) + 2 / 3.0 - 1;
}

/* ---- linearize --------------------------------------------------------------------------------------------------- */

/* 1/x where x has the relative error e, and what products of roundings add to it. */
static double inverse(double e) {
    e *= 1 + 0x1p-20;
    return e < 1 ? e / (1 - e) : (double)INFINITY;
}

double claim_unity(double ratio) {
    return inverse(3 * ratio * CLAIM_UNIT);
}

/* X and Y are rounded alike and the product by a unit, unless far/near has just passed a power of two: then X and Y are
 * off by 1.5 together and the product by half a unit. */
double claim_linear_01(double ratio) {
    return inverse((2 * ratio + 2) * CLAIM_UNIT);
}

double claim_linear_01_near(double ratio) {
    return inverse((2 * ratio + 4) * CLAIM_UNIT);
}

double claim_textbook(double ratio) {
    return inverse((3 * ratio + 1) * CLAIM_UNIT);
}

double claim_fused(double ratio) {
    return inverse((2 * ratio + 2) * CLAIM_UNIT);
}

double claim_double(double ratio) {
    return inverse((2 * ratio + 1) * unit64) + CLAIM_UNIT;
}

double claim_magic(double ratio) {
    return claim_unity(ratio) + CLAIM_MAGIC * (1 + claim_unity(ratio));
}

/* The roundings of d times 65535 and of the sum with 1/2 move the place by up to 2^-9 of a step. */
double claim_table_nearest(double ratio) {
    return (0.5 + 0x1p-9) * (ratio - 1) / (LINEARIZE_TABLE - 1) + CLAIM_UNIT;
}

double claim_table_linear(double ratio) {
    const double g = (ratio - 1) / (LINEARIZE_TABLE - 1);
    return g / (4 * (1 / g + 1)) + 0x1p-9 * g + 2 * CLAIM_UNIT * (1 + g);
}

double claim_spline(double ratio) {
    const double g = (ratio - 1) / (LINEARIZE_KNOTS - 1);
    return 1.25 * g / (10 / g + 4.9) + CLAIM_UNIT * (1 + g / 4);
}

double claim_chebyshev(double ratio) {
    const double root = sqrt(ratio);
    const double error = 1 / cosh((LINEARIZE_ORDER + 1) * log1p(2 / (root - 1)));
    return error + CLAIM_UNIT * (1 + error) + 0x1p-36;
}

/* ---- position ---------------------------------------------------------------------------------------------------- */

/* LinearEyeDepth, and what the ray and its products lose at the worst pixel and direction; see position_bound(). */
double claim_extents(double ratio) {
    return inverse((3 * ratio + 13.8) * CLAIM_UNIT);
}

double claim_rays(double ratio) {
    return inverse((3 * ratio + 13.2) * CLAIM_UNIT);
}

/* Half a step of binary16, and of its subnormals in two components. */
double claim_extents_half(double ratio) {
    return claim_extents(ratio) + 6e-4;
}

double claim_matrix_d3d(double ratio) {
    return inverse((6 * ratio + 12) * CLAIM_UNIT);
}

double claim_matrix_gl(double ratio) {
    return inverse((3.5 * ratio + 12) * CLAIM_UNIT);
}

/* ---- worst ------------------------------------------------------------------------------------------------------- */

static double sampled(double ratio, double count) {
    return 1 - pow(ratio, -2 * log(100) / count);
}

double claim_sampled_64(double ratio) {
    return sampled(ratio, 64);
}

double claim_sampled_4096(double ratio) {
    return sampled(ratio, 4096);
}
