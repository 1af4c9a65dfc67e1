/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file composed.h  World positions through view and projection in binary32, from the definitions, and a search for
 * the farthest two surfaces of one ray that the codes tie or swap. Nothing of the library's arithmetic is used but its
 * separation, which the search is judged by.
 */
#ifndef TESTS_COMPOSED_H
#define TESTS_COMPOSED_H

#include <stdbool.h>

#include "depthprec/depthprec.h"
#include "support.h"

typedef struct set_up {
    dp_setup setup;
    const dp_arith_row *arith;
    double a, b; /* the projection, in double */
    bool reversed, is_signed, ortho;
    dp_budget_terms terms;
} set_up;

typedef struct camera {
    double axis[3], eye[3];
    double from[3], ray[3]; /* the point at eye depth z is from + z ray */
    float clip[4], w[4];
    int order[4];
    bool paired;
} camera;

/* The parts of a camera; each number in [-1, 1]. */
typedef struct pose {
    double axis[3], eye[3], side[3], wide;
    int order[4];
    bool paired;
} pose;

typedef struct found {
    double ratio, z, gap, bound; /* the pair that takes most of its separation */
} found;

/** False: there is no such set-up. */
bool composed_make(set_up *s, double n, double f, dp_mapping mapping, const char *format, dp_arith arith, bool ortho,
                   dp_budget_terms terms);
/** A row times a position, in the order of the camera. */
float composed_dot(const camera *c, const float row[4], const float p[4], bool fused);
/** The binary32 position that stands for the surface at z. False: outside the box. */
bool composed_place(const set_up *s, const camera *c, double z, float p[4]);
pose composed_pose(rng *r);
/** The camera of a pose, with room in the box for a point at z. */
void composed_aim(const set_up *s, double z, const pose *p, camera *c);
double composed_separation_at(const set_up *s, double z);
/** Searches from anew at least `times` times, and more often where less than `wanted` of the bound was found. */
found composed_search(rng *r, const set_up *s, double z, double wanted, uint64_t times);

#endif
