/* SPDX-License-Identifier: MIT */
/*
 * World positions through a view and a projection in binary32: what that adds to the separation of two surfaces.
 *
 * Whatever the composition, a point reaches the divide as a pair (clip z, clip w) that lies beside the line
 * (A z + B, z) of the projection. Divided, it is the pair of another depth: w off by e, clip z by c is, exactly, the
 * point at (z + e)/(1 + (c - A e)/B). So the composition is an error of the eye depth and of nothing else. It has two
 * parts, because entries of the matrix are alike for all points, and products and sums are not.
 */
#ifndef CORE_COMPOSITION_H
#define CORE_COMPOSITION_H

#include "depthprec/budget.h"

/* How matrices are composed, and how far places and camera reach. */
typedef struct dp_composing {
    dp_composition composition;
    double world;     /* largest |coordinate| of positions and camera; positive */
    double a, b;      /* the projection's entries in binary32: clip z = a z + b */
    double zfar;      /* may be INFINITY */
    double reach;     /* the larger of |near| and |far| */
    double ray_ratio; /* no surface is farther from the camera than this times its eye depth, at least 2: 60 degrees */
    int ortho;        /* clip w is 1 */
    int any_sign;     /* there are depths of 0 or less: a z and b may have one sign */
    int fused;        /* products but the first are fused into the sums */
    int remap;        /* (clip z + w)/2 in the shader */
} dp_composing;

/* The largest errors of one row of the matrix at an eye depth, in units of the row's value. */
typedef struct dp_row_off {
    double position, products, sums; /* one point's own: its coordinates rounded, four products, three sums */
    double entries, constant;        /* of the matrix: alike for all points, but for `turn` */
    double grow;                     /* by which a point's own rise a unit of eye depth farther */
    double turn;                     /* by which the entries' may differ for points a unit of eye depth apart */
    double late;                     /* the share of `sums` that the constant takes part in */
} dp_row_off;

/* The largest error of the eye depth of a point at z: e + E moves it, t + T stretches it. */
typedef struct dp_composed {
    dp_row_off clip, w;
    double own, shared;           /* e and E, scene units */
    double own_tilt, shared_tilt; /* t and T, shares of the eye depth */
    double loss;                  /* by which e and E part two points a unit of eye depth apart */
    double loss_tilt;             /* the same for t and T, a unit of eye depth */
    double reach; /* the depth that reaches the divide lies within this of z; INFINITY: behind the eye */
} dp_composed;

/*
 * The errors of a point at z and of those behind it up to the depth `until`; INFINITY: of all in the box. They rise
 * with `until`.
 */
dp_composed dp_composition_at(const dp_composing *in, double z, double until);

/*
 * The separation that is left: surfaces of z and beyond z + this are at least `plain` apart when they reach the divide.
 *
 * @param plain    separation without a composition, never below that of any depth within m->reach of z
 * @param clamped  nonzero: one of the two may lie beyond a plane by what the composition moves it
 * @return scene units, at least `plain`; INFINITY where there is none
 */
double dp_composition_separation(const dp_composed *m, double z, double plain, int clamped);

/* The rows of clip x and y: their factors, and how far beside the axis the rays of vertices lie at z = 1. */
typedef struct dp_composed_view {
    double scale[2], ray[2];
} dp_composed_view;

/* The error of one vertex up to some depth, beside that of the matrix, which all share. */
typedef struct dp_composed_vertex {
    double position;  /* in any direction, scene units: its place in the world */
    double across[2]; /* along x and y, scene units */
    double along;     /* along the axis */
    double tilt;      /* share of the eye depth */
    double shared;    /* the same, by the entries of the matrix: all depths are stretched alike */
    double turn;      /* by which the distance of two planes may change, a share of it */
} dp_composed_vertex;

dp_composed_vertex dp_composition_vertex(const dp_composing *in, const dp_composed_view *view, double farthest);

#endif
