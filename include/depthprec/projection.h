/* SPDX-License-Identifier: MIT */
/**
 * @file projection.h  A 4x4 projection matrix, taken apart: what it says of pixels and their rays, and of depth.
 *
 * Vectors are columns: clip = M (x, y, z, 1) with x to the right and y up. The row of w says which way z runs: 0 0 1 0
 * has it grow ahead, 0 0 -1 0 is for cameras that look along -z, as those of OpenGL and Unity do. Eye depth is positive
 * ahead in each. With a, b, c, e the row of z, made to grow ahead, and u = x/z and v = y/z of a pixel's ray
 *
 *     perspective    d = a u + b v + c + e/z         affine in 1/z for each pixel
 *     orthographic   d = c z + e                     rows of w: 0 0 0 1; a and b must be 0
 *
 * NDC depth from -1 to 1 becomes (NDC + 1)/2. A frustum need not be centred. The near plane of a perspective may be
 * oblique, a and b not 0: then each pixel has planes of its own. The same is said of one whose window depth never gets
 * to the far end, because its far plane lies beyond infinity.
 */
#ifndef DEPTHPREC_PROJECTION_H
#define DEPTHPREC_PROJECTION_H

#include "depthprec/mapping.h"
#include "depthprec/status.h"

DP_BEGIN

/** A matrix, taken apart. */
typedef struct dp_projection {
    int ortho;
    int reversed;       /**< window depth falls with distance */
    int backwards;      /**< the camera looks along -z */
    int oblique;        /**< the planes differ from pixel to pixel: see above */
    dp_mapping mapping; /**< d3d, gl, reversed or gl-reversed */
    double scale[2];    /**< of u and v, or x and y, to NDC; positive */
    double half[2];     /**< 1/scale: half the width and the height, of u and v or of x and y */
    double centre[2];   /**< NDC of the view axis: u = (NDC - centre) half. 0 where the frustum is centred */
    double znear, zfar; /**< oblique: the nearest and the farthest over the picture; zfar may be INFINITY */
    double tilt[2];     /**< perspective: a, b, */
    double base[2];     /**< c, the sum of the two, */
    double pull;        /**< and e, of window depth in [0, 1] */
} dp_projection;

/** Why a matrix is refused. */
typedef struct dp_matrix_fault {
    const char *rule; /**< one sentence without a full stop, what must be; static */
    double got[4];    /**< the row that is not so */
} dp_matrix_fault;

/**
 * Takes a matrix apart, row by row. A negative second diagonal element, y down in NDC as Vulkan has it, is taken for
 * what it is. The planes are rounded thrice, from the entries as they are; whether a set-up can have them
 * dp_setup_init() says.
 *
 * @param ndc_signed  nonzero: NDC depth runs from -1 to 1
 * @param reversed    orthographic: whether window depth falls with distance, which tells which way z runs there
 * @param fault       filled in where the matrix is none; or null
 * @return DP_OK, DP_ERROR_NULL or DP_ERROR_MATRIX; *out is then left as it was
 */
DP_API dp_status dp_projection_init(dp_projection *out, const double m[16], int ndc_signed, int reversed,
                                    dp_matrix_fault *fault);

/** How the 16 numbers of a matrix lie in memory; FOUND: as its fourth row tells. */
typedef enum dp_layout { DP_LAYOUT_FOUND = 0, DP_LAYOUT_ROWS, DP_LAYOUT_COLUMNS, DP_LAYOUT_COUNT } dp_layout;

/**
 * The camera of a matrix whose convention need not be known. Whether depth is reversed stands in the matrix of a
 * perspective, and which of the two layouts it has nearly always. Whether NDC depth begins at 0 or at -1 does not,
 * except that of a reversed perspective with far >= 2 near, or infinite, from 0 on only one is possible: read the
 * other way a standard one is a camera with half or twice the near plane. An orthographic matrix tells neither.
 *
 * @param mapping  d3d, gl, reversed or gl-reversed; DP_MAPPING_COUNT where it is to be found
 * @return DP_OK; DP_ERROR_NULL; DP_ERROR_MAPPING for another one; DP_ERROR_CONVENTION where more than one camera fits;
 *         DP_ERROR_MATRIX where none does, also for planes that differ from pixel to pixel. *out is left as it was then
 */
DP_API dp_status dp_projection_find(dp_projection *out, const double m[16], dp_layout layout, dp_mapping mapping,
                                    dp_matrix_fault *fault);

/** Between what the planes of a matrix lie, which was rounded. */
typedef struct dp_planes {
    double near_least, near_most, far_least, far_most; /**< far_most may be INFINITY */
    int near_digits, far_digits; /**< the fewest to which znear and zfar may be rounded and lie there; 17: all */
} dp_planes;

/**
 * What the entries say of the planes: those of any matrix whose entries were rounded to these. Near far/near = 10^6 the
 * entries of binary32 leave a digit or two of far.
 *
 * @param p      what dp_projection_init() or dp_projection_find() made of m, in the layout that it was in
 * @param least  of each entry, what it was before it was rounded, at least, and
 * @param most   at most. Both null: by its bits. If all entries are numbers of binary32, one of them with more than 20
 *               bits, those that are not 0 were rounded to binary32; else those of more than 20 bits to doubles, for
 *               which a unit in the last place is taken. What has fewer bits was typed
 * @return DP_OK, DP_ERROR_NULL, or DP_ERROR_MATRIX where p is not of m; *out is then left as it was
 */
DP_API dp_status dp_projection_planes(dp_planes *out, const dp_projection *p, const double m[16],
                                      const double least[16], const double most[16]);

DP_END
#endif
