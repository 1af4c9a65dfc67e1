/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file vertex_compare.h  The same vertices through two vertex programs: how many get different codes, and how
 * far apart.
 *
 * The differences depend on where vertices and cameras are, so the distribution is part of the answer. Vertices are
 * drawn at random: vertex i depends on the seed and i alone, and results do not depend on the number of threads.
 */
#ifndef RASTER_VERTEX_COMPARE_H
#define RASTER_VERTEX_COMPARE_H

#include <stdint.h>

#include "raster/vertex_program.h"

/** How vertices are drawn. Each has a camera of its own: a coordinate is uniform in [-world, world], an axis uniform on
 * the sphere. */
typedef enum vertex_spread {
    VERTEX_EYE_LOG = 0, /**< eye depth log-uniform over the range, anywhere in a round view of 90 degrees */
    VERTEX_BOX,         /**< uniform in the box of the camera; those outside the range are not counted */
    VERTEX_SPREAD_COUNT
} vertex_spread;

/** "eye-log", and what it is; null when out of range. */
const char *vertex_spread_name(vertex_spread spread);
const char *vertex_spread_note(vertex_spread spread);

enum { VERTEX_OTHERS = 16 };

typedef struct vertex_request {
    const dp_setup *setup; /**< with a pipeline, in the arithmetic of spec.arith from the divide on */
    vertex_spread spread;
    double lo, hi; /**< eye depths, scene units; positive and finite for VERTEX_EYE_LOG */
    double world;  /**< largest |coordinate| of a camera, scene units, not negative */
    uint64_t count, seed;
    int threads; /**< 0: as many as OpenMP would take */
    const vertex_program *base;
    const vertex_program *other[VERTEX_OTHERS]; /**< each is compared with the base */
    size_t others;
    /** Told now and then, by one thread at a time, how many vertices are done. May be null. */
    void (*progress)(void *context, uint64_t done);
    void *context;
} vertex_request;

/** A vertex that the programs part, by the bias that brings one in front of the other, or level with it. */
typedef struct vertex_gap {
    double bias; /**< their difference in window depth: both are binary32, so the sum is not rounded back past either */
    double depth; /**< window depth of the pass that is farther, which is the one that needs it */
} vertex_gap;

/** The differences between the codes of two programs. */
typedef struct vertex_difference {
    uint64_t vertices;   /**< counted */
    uint64_t differ;     /**< those whose codes differ */
    uint32_t percentile; /**< 99 % of all differ by no more codes, 0 included; at most 2^-11 above the least such */
    uint32_t most;       /**< codes */
    double most_z;       /**< eye depth of the nearest vertex that differs most; NaN where none does */
    vertex_gap widest;   /**< that with the greatest bias; 0 where none differs */
    vertex_gap steepest; /**< that with the greatest one in units of 2^e, e the exponent of its depth in the format */
} vertex_difference;

/** Draws the vertices and compares the programs; out[i] is that of other[i]. @return false where there is no memory */
bool vertex_compare(const vertex_request *request, vertex_difference out[VERTEX_OTHERS]);

/** A vertex that was drawn. */
typedef struct vertex_drawn {
    double axis[3], place[3]; /**< of its camera */
    float position[3];
    double z; /**< eye depth before the position is rounded */
} vertex_drawn;

/** Draws vertex i. @return false where it is not counted */
bool vertex_draw(const vertex_request *request, uint64_t i, vertex_drawn *out);

#endif
