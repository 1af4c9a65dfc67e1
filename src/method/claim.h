/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file claim.h  Claims that are formulas of far/near, 1 < ratio <= INFINITY; each is derived in depthprec(7),
 * "Methods".
 *
 * They are bounds on the relative error over all inputs of the family, for any near plane.
 */
#ifndef METHOD_CLAIM_H
#define METHOD_CLAIM_H

/** Half the distance of binary32 numbers around 1: the largest relative error of one rounding. */
#define CLAIM_UNIT 0x1p-24

/** The square of the error, at most 0.05051, of a reciprocal from the bits of x. */
#define CLAIM_MAGIC 2.552e-3

/* interval, unorm24 with a standard mapping */
double claim_rule(double ratio);
double claim_first_order(double ratio);
double claim_neighbours(double ratio);
double claim_neighbours32(double ratio);
double claim_bound(double ratio); /**< in the binary32 pipeline */

/* linearize, a standard mapping: what the cancellation of f against d (f - n) leaves; INFINITY where nothing is left */
double claim_unity(double ratio);
double claim_linear_01(double ratio);
double claim_linear_01_near(double ratio);
double claim_textbook(double ratio);
double claim_fused(double ratio);
double claim_double(double ratio);
double claim_magic(double ratio);
/** Where half of the divisor may be error, and the claims on binary32 arithmetic have grown to 1. */
#define CLAIM_CANCELLED       (0x1p24 / 6)
#define CLAIM_CANCELLED_FUSED (0x1p24 / 4)

/* linearize, either mapping: interpolation of a curve with a pole */
double claim_table_nearest(double ratio);
double claim_table_linear(double ratio);
double claim_spline(double ratio);
double claim_chebyshev(double ratio);

/* position, a standard mapping, 60 degrees and 16:9; those of the matrix are measured: 1.6 times the worst of 3000
 */
double claim_extents(double ratio);
double claim_rays(double ratio);
double claim_extents_half(double ratio);
double claim_matrix_d3d(double ratio);
double claim_matrix_gl(double ratio);

/* worst: one range in a hundred may exceed it */
double claim_sampled_64(double ratio);
double claim_sampled_4096(double ratio);

#endif
