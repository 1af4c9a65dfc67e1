/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file find.h  The surfaces of a model that are nearly in one plane and overlap, so that their depths may fight.
 *
 * Two triangles are a *pair* when the angle between their planes is at most `angle`, and the part of their overlap
 * where they are at most `gap` apart has an area above 0. Overlap and distance are measured along their common normal:
 * the sum of their two normals, each as long as its triangle is large, so that the larger triangle decides; one of them
 * is turned round where they face opposite ways. What touches along an edge or at a point has no area. With a gap of
 * 0 the pairs are those exactly in one plane.
 *
 * Whether triangles overlap, and whether they lie in one plane, is decided exactly for the coordinates of the model
 * (up to FINDER_COORDINATE_MAX, and none but 0 below its inverse). The angle is decided to 1e-9 degrees; a gap above 0
 * is measured to 1e-12 of the model's extent, an area to 1e-12 of its square. Two planes that cross at an angle of t
 * radians are a gap apart along a line that is certain to 1e-15 / t of the extent, and so is an area that ends there.
 * An overlap whose area is below 2^-46 of the product of both triangles' longest sides counts as thin, asked for or
 * not: that is what rounding makes of edges that meet. Of one hardly larger the gap and the place are less certain.
 *
 * Pairs that nobody can see are left out and counted, by filters that can be switched off. The rest is grouped by the
 * two surfaces that the triangles belong to: a *finding*. The result does not depend on the number of threads.
 *
 * Cost: O(n log n) for n triangles of which each is near few; at most 110 bytes a triangle, 220 where there are pairs
 * that bodies might hide, and 56 a pair.
 */
#ifndef SCENE_FIND_H
#define SCENE_FIND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "core/named.h"
#include "model/model.h"

/**
 * Degrees: what a caller asks for without a wish of its own. Planes that meet at a larger angle are at most a gap apart
 * only in a band of less than 2 / sin(1 degree) = 115 gaps beside the line where they cross: the seam that any two
 * bodies have where they intersect, not two surfaces in one place.
 */
#define FINDER_ANGLE          1.0
#define FINDER_ANGLE_MAX      89.0
#define FINDER_COORDINATE_MAX 1e50 /**< scene units */

enum {
    FINDER_PAIRS_MAX = 1 << 20,
    FINDER_CORNERS = 8 /**< of an overlap, at most: two triangles, and the two planes that are a gap apart */
};

/** Why a pair is left out, in the order in which it is asked: a pair counts where it is left out first. */
typedef enum finder_filter {
    FINDER_FACING = 0, /**< front sides to opposite sides, both seen from the front alone: never seen together */
    FINDER_BLENDED,    /**< a material is blended: drawn in an order, without writing depths */
    FINDER_THIN,       /**< the overlap's area over its longest diagonal is below `width`: edges that meet, rounded */
    FINDER_HIDDEN,     /**< within a closed body or against one: hidden.h says how it is told */
    FINDER_FILTERS
} finder_filter;

typedef struct finder_filter_row {
    NAMED_FIELDS; /**< of pairs: "that are never seen from one side" */
} finder_filter_row;

/** Index: finder_filter. */
NAMED_ROWS(finder_filter_row, finder_filter);

typedef struct finder_asked {
    double gap;       /**< scene units, from 0, finite */
    double angle;     /**< degrees, from 0 to FINDER_ANGLE_MAX */
    double width;     /**< scene units, from 0, finite: see FINDER_THIN */
    unsigned off;     /**< filters not to apply: 1 << finder_filter, or-ed */
    size_t pairs_max; /**< pairs to keep; 0: FINDER_PAIRS_MAX */
    int threads;      /**< 0: as many as OpenMP would take */
    /** Told now and then, by one thread at a time, the share that is done; nonzero stops the search. May be null. */
    int (*progress)(void *context, double share);
    void *context;
} finder_asked;

/** Two triangles of the model. */
typedef struct finder_pair {
    uint32_t triangle[2]; /**< of the finding's surface a, and of b; within one surface the lesser first */
    double gap_lo,
        gap_hi;      /**< scene units: distance of the second over the overlap, positive on the first's front side */
    double area;     /**< scene units squared, of the overlap where they are at most a gap apart */
    double place[3]; /**< the centroid of that overlap, on the first triangle */
} finder_pair;

/** Two surfaces of the model, or one that overlaps itself. */
typedef struct finder_finding {
    uint32_t a, b;           /**< a <= b */
    double gap_min, gap_max; /**< scene units: least and greatest distance over all overlaps */
    double area;         /**< the sum over the pairs: where several triangles lie in one place, more than is there */
    double place[3];     /**< of the pair with the largest overlap */
    double normal[3];    /**< there: the front side of a, length 1 */
    double lo[3], hi[3]; /**< box of the overlaps, on surface a */
    size_t first, pairs; /**< its pairs, the largest overlap first: pair[first .. first + pairs - 1] */
} finder_finding;

typedef struct finder_found {
    double extent;          /**< scene units: the diagonal of the model's box */
    size_t findings, pairs; /**< the smallest gap first, then the largest area, then by surface */
    finder_finding *finding;
    finder_pair *pair;
    size_t left_out[FINDER_FILTERS]; /**< pairs */
    size_t degenerate;               /**< triangles without area, which take no part */
    /**
     * The search was cut short: pairs_max pairs are kept, or too many triangles lie in one place: more work than some
     * 2^21 + 32 n pairs of triangles looked at closely. What was found by then is right; left_out counts that part.
     */
    bool cut;
} finder_found;

typedef enum finder_status {
    FINDER_DONE = 0,
    FINDER_STOPPED, /**< progress asked for it */
    FINDER_RANGE,   /**< something asked, or a coordinate, is out of its range */
    FINDER_NO_MEMORY
} finder_status;

/** Searches a model. On anything but FINDER_DONE *out holds nothing. */
finder_status finder_find(const model *m, const finder_asked *asked, finder_found *out);

void finder_free(finder_found *found);

/** The corners of a pair's overlap where it is at most `gap` apart, in order, on its first triangle: how many. */
int finder_corners(const model *m, const uint32_t triangle[2], double gap, double corner[FINDER_CORNERS][3]);

#endif
