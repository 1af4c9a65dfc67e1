/* SPDX-License-Identifier: GPL-3.0-or-later */
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
#ifndef SHADER_PROJECTION_H
#define SHADER_PROJECTION_H

#include <stdbool.h>

#include "core/engine.h"

enum { PROJECTION_WHY = 256 };

typedef struct projection {
    bool ortho;
    bool reversed;      /**< window depth falls with distance */
    bool backwards;     /**< the camera looks along -z */
    bool oblique;       /**< the planes differ from pixel to pixel: see above */
    double scale[2];    /**< of u and v, or x and y, to NDC; positive */
    double half[2];     /**< 1/scale: half the width and the height, of u and v or of x and y */
    double centre[2];   /**< NDC of the view axis: u = (NDC - centre) half. 0 where the frustum is centred */
    double znear, zfar; /**< oblique: the nearest and the farthest over the picture; zfar may be INFINITY */
    double tilt[2];     /**< perspective: a, b, */
    dp_pair base;       /**< c, */
    double pull;        /**< and e, of window depth in [0, 1] */
} projection;

/**
 * Takes a matrix apart, row by row. A negative second diagonal element, y down in NDC as Vulkan has it, is taken for
 * what it is: row 0 of an image is the top one all the same.
 *
 * @param ndc_signed  NDC depth runs from -1 to 1
 * @param reversed    orthographic: whether window depth falls with distance, which tells which way z runs there
 * @param why         one sentence, what is wrong and what was given, where it returns false
 */
bool projection_init(projection *out, const double m[16], bool ndc_signed, bool reversed, char why[PROJECTION_WHY]);

#endif
