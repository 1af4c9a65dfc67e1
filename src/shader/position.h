/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file position.h  Ways from a window depth to a place, a row each, in binary32 as shaders do it.
 *
 * Engines are modelled operation by operation, none fused, on constants formed in double and rounded once.
 * u and v run from the left and the top edge here: (i + 1/2) and (j + 1/2) times the rounded 1/width and 1/height.
 */
#ifndef SHADER_POSITION_H
#define SHADER_POSITION_H

#include "core/engine.h"
#include "core/named.h"
#include "shader/camera.h"
#include "shader/decode.h"

/** Constants that an engine would upload, prepared once for a camera. Each row uses what it needs. World axes; the
 *  vectors start at the camera, only `inverse` knows where it stands. */
typedef struct position_state {
    const texture_camera *camera; /**< must live as long */
    decode_constants usual, best; /**< eye depth as engines get it, and without cancellation: see decode.h */
    float inverse[16];            /**< inverse view-projection, row-major; NaN when singular */
    float ndc_scale, ndc_base;    /**< NDC depth = ndc_scale d + ndc_base */
    float corner[4][3];           /**< rays to the near plane's corners: bottom left, bottom right, top left, right */
    float top_left[3], x_extent[3], y_extent[3]; /**< near plane; orthographic: at eye depth 0 */
    float z_extent[3];                           /**< orthographic: forward times far */
    float origin[3];
    float step[3], forward[3];                   /**< world ray (orthographic: offset) from a column to the next */
    float inverse_width, inverse_height, middle; /**< middle: the column between the image's halves */
    float znear, inverse_near, inverse_far;
} position_state;

/** A bound of a row at a pixel, in units of 2^-24. */
typedef double position_bound_of(const texture_camera *camera, uint32_t row, uint32_t column, double d);

typedef struct position_row {
    NAMED_FIELDS;
    bool perspective, ortho; /**< has such a form */
    bool curved;             /**< needs no projection matrix: takes linear and logarithmic depth, too */
    bool by_far;             /**< orthographic: divides by the far plane, which must not be 0 */
    /** Places of `count` pixels of a row from `column` on: three planes, world coordinates. The planes do not overlap
     *  each other or d. NaN depths give NaN. */
    void (*run)(const position_state *s, uint32_t row, uint32_t column, const float *d, size_t count, float *x,
                float *y, float *z);
    position_bound_of *bound; /**< see position_bound() */
} position_row;

position_bound_of matrix_bound, rays_bound, extents_bound, half_bound, view_bound;

enum { POSITION_MATRIX = 0, POSITION_RAYS, POSITION_EXTENTS, POSITION_EXTENTS_HALF, POSITION_VIEW, POSITION_ROWS };
extern const position_row position_rows[POSITION_ROWS];

NAMED_ROWS(position_row, position);

/** Does the row have a form for the camera's projection and mapping? */
bool position_applies(const position_row *row, const texture_camera *camera);

void position_prepare(position_state *s, const texture_camera *camera);

/**
 * The place exactly: from the camera along the world's axes, and in the world. Either may be null.
 *
 * Bound: 1e-14 of the distance from the camera; in the world one rounding to double more.
 */
void position_exact(const texture_camera *camera, uint32_t row, uint32_t column, double d, double relative[3],
                    double world[3]);

/** How far from the exact place (position_exact()) a world place lies, scene units; no digits are lost however far the
 *  camera is from the origin. */
DP_INLINE double position_off(const texture_camera *camera, const double relative[3], const float world[3]) {
    double off[3];
    for (int k = 0; k < 3; k++) {
        const dp_pair from_camera = dp_two_sum((double)world[k], -camera->origin[k]);
        off[k] = (from_camera.hi - relative[k]) + from_camera.lo;
    }
    const double length = sqrt(off[0] * off[0] + off[1] * off[1] + off[2] * off[2]);
    return length == length ? length : (double)INFINITY;
}

/**
 * A bound on how far a row is off at one pixel (position_off()), scene units; INFINITY where nothing can be promised.
 * Derived in depthprec(7): each rounding counts one unit of 2^-24 of the term that it rounds.
 */
double position_bound(const position_row *row, const texture_camera *camera, uint32_t i, uint32_t j, float d);

/** Condition number (2-norm, by SVD) of the view-projection matrix; INFINITY when singular to double precision, NaN
 *  where the mapping has no matrix. */
double position_condition(const texture_camera *camera);

/** The view-projection matrix in double, row-major, before an engine rounds it; meaningless where there is none. */
void position_matrix(const texture_camera *camera, double m[16]);

/** Its inverse, term by term, not by elimination. */
void position_inverse(const texture_camera *camera, double m[16]);

#endif
