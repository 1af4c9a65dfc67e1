/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file scene_truth.h  Two triangles in exact rationals, from the words of src/scene/find.h alone: do they overlap
 * where they are at most a gap apart, how far apart are they there, and on how large an area.
 */
#ifndef TESTS_SCENE_TRUTH_H
#define TESTS_SCENE_TRUTH_H

#include <stdbool.h>

typedef struct scene_truth {
    bool degenerate; /**< one of them has no area */
    bool overlap;    /**< whatever their distance: their planes are within the angle and they overlap */
    bool touch;      /**< within the angle, and they have points in common, seen along the normal, but no area */
    bool plane;      /**< in one plane */
    bool pair;
    double whole;                  /**< area of the overlap, whatever the distance */
    double lo, hi, area, place[3]; /**< of a pair, each rounded at the end */
} scene_truth;

/** cosine2: the square of the cosine of the largest angle, taken as it stands. */
scene_truth scene_truth_of(const double a[3][3], const double b[3][3], double gap, double cosine2);

#endif
