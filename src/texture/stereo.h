/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file stereo.h  Images of disparity, as cameras with two eyes, or an eye and a projector, measure it.
 *
 *     disparity = offset + step x sample, in pixels;    depth = focal x baseline / disparity
 *
 * 1/z is affine in the sample, as it is in the codes of a reversed depth buffer, which the image becomes without loss:
 * code 0 is where the disparity ends, at `zfar`, and a code more is a step of disparity more. A step is the greatest
 * that all samples are multiples of; numbers of no step become numbers of fp32, and keep their precision.
 */
#ifndef TEXTURE_STEREO_H
#define TEXTURE_STEREO_H

#include "image/image.h"

struct metric;

typedef struct stereo_spec {
    double focal;    /**< pixels */
    double baseline; /**< scene units */
    double offset;   /**< pixels, added to what the samples say: doffs of Middlebury */
    double step;     /**< pixels of 1 in a sample; below 0 where larger samples are farther, as OpenNI has them */
} stereo_spec;

/** The depth of a sample, scene units: infinite where it is no disparity, below 0 where that is beyond infinity. */
static inline double stereo_depth(const stereo_spec *of, double sample) {
    return of->focal * of->baseline / (of->offset + of->step * sample);
}

/**
 * Converts the image, as metric_convert() does. Holes are samples of 0, those that are not finite, what `top` is of
 * metric depth, and those whose disparity is less than a step: they lie at infinity, or beyond.
 * @return null, or why not: one sentence; the image is then as it was, but for `top`
 */
const char *stereo_convert(image *img, const stereo_spec *given, struct metric *out);

#endif
