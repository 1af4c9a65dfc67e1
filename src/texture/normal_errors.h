/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file normal_errors.h  Normals of a whole image, and how far those of a synthetic one are from its own. */
#ifndef TEXTURE_NORMAL_ERRORS_H
#define TEXTURE_NORMAL_ERRORS_H

#include "shader/normal.h"
#include "texture/synthetic.h"

/** Writes the eye depths of a row, camera->width of them; NaN for sky. */
typedef void (*normal_source)(void *context, uint32_t row, float *eye);
/** Takes the normals of a row, or rather of in->row, and may look at what they were made from. */
typedef void (*normal_sink)(void *context, const normal_rows *in, const float *const normal[3]);

/**
 * The normals of `count` rows from `first` on, in that order. The source is asked for each row once, and for those
 * within reach of them.
 * @return false when out of memory
 */
bool normal_run(const normal_row *method, const texture_camera *camera, uint32_t first, uint32_t count,
                normal_source source, normal_sink sink, void *context);

/** Angular errors of some pixels, radians; NaN where there are none. */
typedef struct normal_spread {
    uint64_t count;
    double mean;
    double p99;           /**< 99 of 100 are no larger */
    double max;           /**< reached at: */
    uint32_t column, row; /**< the first such pixel */
} normal_spread;

typedef struct normal_measured {
    uint64_t drawn, sky; /**< pixels that show a surface, and others */
    uint64_t missing;    /**< drawn pixels without a normal: no neighbour, or a sum of differences of zero */
    /** Drawn pixels with a normal for which a neighbour of another surface was taken although the one on the other side
     *  is of their own. */
    uint64_t wrong;
    normal_spread inside; /**< pixels with nothing but their own surface, or the border, where the method looks */
    normal_spread edges;  /**< pixels next to another surface or the sky */
} normal_measured;

/**
 * Stores `count` rows of a synthetic image from `first` on in the format of the camera's set-up, reads them back into
 * binary32, rounded once, and compares. Surfaces that are flat give noise alone, curved ones what the method makes of
 * them too.
 * @return false when out of memory
 */
bool normal_measure(const normal_row *method, const texture_camera *camera, const synthetic_row *synthetic,
                    const double *parameters, uint32_t first, uint32_t count, normal_measured *out);

#endif
