/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file root.h  A root of a function of one unknown, enclosed. */
#ifndef REQUIREMENT_ROOT_H
#define REQUIREMENT_ROOT_H

typedef double root_function(double x, void *context);

/**
 * Chandrupatla's method (Advances in Engineering Software 28 (1997) 145-149): inverse quadratic interpolation where the
 * last three points say that it converges, else the middle; the ends stay around a sign change.
 *
 * @param f        finite on [a, b]
 * @param apart    how close the ends come, positive
 * @return the end with the smaller |f| once the ends are that close or no double is left between them, or f is 0
 *         there, or after 200 steps; a where f has one sign at both ends
 */
double root_find(root_function *f, void *context, double a, double b, double apart);

#endif
