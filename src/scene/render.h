/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file render.h  What a camera sees of a model, as a rasterizer of src/raster draws it, and which pixels are wrong.
 *
 *     render_picture p;
 *     if (render_draw(&asked, &p) == RENDER_DONE)
 *         ... p.shown[i], p.nearer[i] ...
 *     render_free(&p);
 *
 * Triangles are drawn in the order of the file, opaque, with the depth test LESS (of reversed mappings GREATER); those
 * that are seen from the front alone are left out where they show their back. Places are turned into eye space in
 * double, and each coordinate is rounded once to binary32, as draw.h has it.
 *
 * A pixel is *wrong* where it shows a triangle, and another one that was drawn there is in truth nearer to the eye, or
 * just as near: then the order of drawing decides. Where the planes of the two cross within the pixel, so that each is
 * in front in a part of it, either is right. The truth is what the ray through the pixel's centre meets, in
 * double, of the model as it was read; two depths are the same where they differ by less than the rounding errors of
 * their computation, some 2^-46 of the largest coordinate over the cosine of the slant, at most 2^-30 of the depth. A
 * triangle that the ray passes by, though the rasterizer's grid gave it the pixel, is neither right nor wrong.
 *
 * Cost: O(triangles + pixels covered), 24 bytes a pixel.
 */
#ifndef SCENE_RENDER_H
#define SCENE_RENDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "model/model.h"
#include "raster/draw.h"
#include "scene/eye.h"

enum { RENDER_PIXELS_MAX = 1 << 25 };
#define RENDER_NOTHING UINT32_MAX
#define RENDER_REACH   1e30 /**< scene units: no coordinate may be greater */

typedef struct render_asked {
    const model *m;
    const draw_camera *camera; /**< of at most RENDER_PIXELS_MAX pixels */
    scene_eye eye;
    bool any_side; /**< triangles are drawn whichever way they face */
    bool blended;  /**< blended materials are drawn, too, as if they were opaque */
    /** Told now and then the share that is done; nonzero stops. May be null. */
    int (*progress)(void *context, double share);
    void *context;
} render_asked;

/** Row by row from the lowest, as draw.h has them. */
typedef struct render_picture {
    int width, height;
    uint32_t *shown;  /**< the triangle that each pixel shows, or RENDER_NOTHING */
    uint32_t *nearer; /**< where that is wrong the one that should be seen, else RENDER_NOTHING */
    size_t wrong;     /**< pixels */
} render_picture;

typedef enum render_status {
    RENDER_DONE = 0,
    RENDER_STOPPED, /**< progress asked for it */
    RENDER_RANGE,   /**< too many pixels, or a coordinate beyond RENDER_REACH */
    RENDER_NO_MEMORY
} render_status;

/** Draws. On anything but RENDER_DONE *out holds nothing. */
render_status render_draw(const render_asked *asked, render_picture *out);
void render_free(render_picture *p);

/**
 * Opaque colours 0xFFRRGGBB, row by row from the top: red (255, 0, 0) where a pixel is wrong, else grey by the angle of
 * the triangle to a light beside the camera, a little lighter or darker from surface to surface.
 */
void render_colours(const render_asked *asked, const render_picture *p, uint32_t *pixel);

/**
 * A view of all of a model from above one of the four corners of its box, y upwards, as far off as the field of view
 * asks for: of the corner from which the most of the wanted directions is seen.
 * @param towards  directions, each as long as it weighs; may be null where count is 0
 */
scene_eye render_overview(const model *m, const draw_camera *camera, size_t count, const double (*towards)[3]);

#endif
