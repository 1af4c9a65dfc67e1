/* SPDX-License-Identifier: MIT */
/**
 * @file triangles.h  Slanted triangles: what a rasterizer adds to a depth between a triangle's vertices.
 *
 * A rasterizer moves the vertices of a triangle to a subpixel grid, sets up a plane of window depth in binary32 and
 * evaluates it at each pixel. A surface that faces the camera pays nothing for that, a slanted one does. With these in
 * its specification the guarantee of a set-up, DP_MODEL_FLOAT, is one of parallel planes at any slant of a range.
 * depthprec(7), "Slanted triangles", derives it.
 *
 * The promise: two parallel planes are drawn as any triangles of the class below, their normal n (|n| = 1) at an
 * angle of slant_lo to slant_hi to the view axis; in a pixel inside a triangle of each, z is the eye depth of the
 * farther plane. If they are `separation` or more apart along n, their codes are strictly in order there. That holds up
 * to edge-on. It covers a perspective with square pixels, eye space given in real numbers and rounded to binary32, and
 * triangles that are not clipped.
 *
 * It covers clipped triangles too, if their vertices lie within [near, far]. Where the rasterizer keeps the plane of
 * the unclipped vertices, as it stands. Where it makes new vertices, as Mesa does, with 6 more in plane.value and 3
 * more in plane.origin for each side of the screen that cuts; each piece has to be in the class, a pixel wide and high
 * or more.
 */
#ifndef DEPTHPREC_TRIANGLES_H
#define DEPTHPREC_TRIANGLES_H

#include "depthprec/status.h"

DP_BEGIN

/**
 * The most that setting up and evaluating a plane adds, in units of 2^-24:
 *
 *     value M + (box L + range) R + origin (|gx| X + |gy| Y)
 *
 * M is the largest window depth of a vertex, R the range of the three, L the area of the box around the triangle over
 * twice its own, gx and gy the change of window depth from pixel to pixel, X and Y the largest |window coordinates| in
 * pixels of target and vertices. Derived for each way of dp_anchor; or whatever is known of a rasterizer, not negative.
 */
typedef struct dp_plane_error {
    double value, box, range, origin;
} dp_plane_error;

/** Where a plane is anchored, and how it is evaluated from there. */
typedef enum dp_anchor {
    DP_ANCHOR_VERTEX = 0,     /**< z0 + gy (y - y0) + gx (x - x0) */
    DP_ANCHOR_ORIGIN,         /**< fma(gy, y, fma(gx, x, c)) */
    DP_ANCHOR_ORIGIN_UNFUSED, /**< the same by multiply and add */
    DP_ANCHOR_ORIGIN_STEPPED, /**< c + gx x + gy y at every other pixel, gx and gy added for those between */
    DP_ANCHOR_COUNT
} dp_anchor;

typedef struct dp_anchor_row {
    const char *name; /**< "vertex" */
    dp_plane_error plane;
    const char *note;
} dp_anchor_row;

/**
 * The error that a way of setting up a triangle's plane adds to its depth; null when out of range. Anchored at a
 * vertex: for vertices on a grid, `subpixel` 1 to 8; at the origin: for boxes at least a pixel wide and high.
 */
DP_API const dp_anchor_row *dp_anchor_get(dp_anchor anchor);

/** The least and the most vertical field of view, degrees: beyond them tangents are no numbers that a view has. */
#define DP_FOV_LEAST 0.001
#define DP_FOV_MOST  179.9

/** A view, a rasterizer and a class of triangles. Start from dp_triangles_default() and change what differs. */
typedef struct dp_triangles {
    int width, height;         /**< of the viewport, pixels, 1 to 32768 */
    double fov_y;              /**< vertical field of view, degrees, DP_FOV_LEAST to DP_FOV_MOST */
    int subpixel;              /**< bits of the grid to which vertices move, 1 to 8; 0: those of the plane do not */
    dp_plane_error plane;      /**< of the rasterizer */
    double slant_lo, slant_hi; /**< angles of the normal to the view axis, degrees, 0 <= lo <= hi <= 90 */
    double depth;              /**< all vertices lie at eye depths from z/depth to z depth; 1 to 1e6 */
    double pixels;             /**< no triangle is wider or higher than this, pixels, 1 to 65536 */
    double slim;               /**< its longest edge is at most this times the height upon it, in pixels; 2 to 1024 */
} dp_triangles;

/** The triangles to start from: a view of 1920 x 1080, 60 degrees, 8 bits, anchored at a vertex, any slant; from z/2 to
 * 2 z, 512 pixels, 1:16. */
DP_API dp_triangles dp_triangles_default(void);

/** The vertical field of view of a horizontal one, both in degrees: square pixels. */
DP_API double dp_fov_vertical(double fov_x, int width, int height);

/** Whether triangles can be counted. @return DP_OK, DP_ERROR_NULL, or DP_ERROR_TRIANGLES where a field is out of its
 *  range or no number */
DP_API dp_status dp_triangles_check(const dp_triangles *triangles);

/** The first field that is out of its range, or no number, as a sentence that begins with what people call it, "fov
 * must be from 0.001 to 179.9 degrees"; null where dp_triangles_check() finds nothing. Valid forever. */
DP_API const char *dp_triangles_fault(const dp_triangles *triangles);

DP_END
#endif
