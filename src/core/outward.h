/* SPDX-License-Identifier: MIT */
/*
 * For the rooms above too: what roundings may change a number by, and shares of it that outweigh so many of them.
 *
 * Where n roundings to double led to a number, all terms positive and none below the normal numbers, it is at least
 * (1 - u)^n of the exact one, u = 2^-53. Made larger by a share of s units, which is rounded once more, it is not below
 * the exact one for n = s - 2: (1 - u)^(s - 1) (1 + s u) >= (1 - (s - 1) u) (1 + s u) = 1 + u - s (s - 1) u^2 > 1.
 * Made smaller it is not above: (1 + u)^(s - 1) (1 - s u) < 1. The names say n. What a function loses counts as so many
 * roundings as its bound has half units in the last place. For binary32 u is 2^-24; such a share of an error outweighs
 * what is of second order, products of the error with so many others.
 */
#ifndef CORE_OUTWARD_H
#define CORE_OUTWARD_H

/* Half a unit in the last place of binary32 at 1: the most that a rounding changes a number by, relatively. */
#define DP_UNIT 0x1p-24

#define DP_ROUNDINGS_2     0x1p-51
#define DP_ROUNDINGS_6     0x1p-50
#define DP_ROUNDINGS_14    0x1p-49
#define DP_ROUNDINGS_30    0x1p-48
#define DP_ROUNDINGS_126   0x1p-46
#define DP_ROUNDINGS_510   0x1p-44
#define DP_ROUNDINGS_8190  0x1p-40
#define DP_ROUNDINGS32_2   0x1p-22
#define DP_ROUNDINGS32_14  0x1p-20
#define DP_ROUNDINGS32_254 0x1p-16

/* Makes a bound larger than the roundings of any formula here could have made it smaller. */
#define DP_OUTWARD (1.0 + DP_ROUNDINGS_8190)

#endif
