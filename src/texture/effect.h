/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file effect.h  Effects that consume depth, a row each: what an error of the depth does to them.
 *
 * An effect sees the stored depth in place of the true one, which may be anywhere in the same cell. Its error at z is
 * the largest difference that makes to the output, over all depths of z's cell, in levels of 1/255.
 *
 * Some effects compare the depth with something of their own: the eye depth of a surface, the height of the water, the
 * focus. Wherever that is, the error is no larger than when it lies in the cell as well, so there it is put: in the
 * worst of three places, the stored depth and the two ends of the cell.
 *
 * Depths enter as doubles, each within 2^-50 of itself, which errors inherit.
 */
#ifndef TEXTURE_EFFECT_H
#define TEXTURE_EFFECT_H

#include "depthprec/depthprec.h"
#include "texture/parameter.h"

/** How the wanted parameter p and the row's quantity v, with v' where it is compared, make the output. */
typedef enum effect_kind {
    EFFECT_FADE = 0, /**< a ramp of (v - v')/p from 0 to 1: the error falls as p grows */
    EFFECT_GAIN,     /**< p (v - v') and a constant: the error grows with p */
    EFFECT_CLAMPED,  /**< saturate(p v): the error grows with p until the output saturates */
    EFFECT_STEP      /**< |v - v'| > p for two pixels */
} effect_kind;

typedef struct effect_row {
    const char *name; /**< "intersection", "force-field", "fog", "scan-line", "water-line", "height-fog", "edge",
                           "motion-blur", "depth-of-field" */
    const char *note; /**< the formula */
    texture_parameter parameters[TEXTURE_PARAMETERS + 1];
    int wanted;            /**< the parameter whose usable values are looked for */
    bool smallest;         /**< it is usable from some value up; else from some value down */
    bool eye01;            /**< uses z/far, so far must be finite */
    const char *reference; /**< what the depth is compared with; null when with nothing */
    const char *source;
    effect_kind kind;
    double (*quantity)(const dp_setup *setup, const double *parameters, double z);
    /** The output, before it is stored in 8 bits, where the effect sees eye depth z; `reference` is the eye depth of
     *  what it is compared with, if anything. */
    double (*output)(const dp_setup *setup, const double *parameters, double z, double reference);
} effect_row;

/** The rows in order; null beyond the last. */
const effect_row *effect_get(size_t index);

/** Can the effect be had? Not when it needs a finite far plane and there is none. */
bool effect_applies(const effect_row *row, const dp_setup *setup);

/**
 * The error of the output at z, in levels of 1/255.
 *
 * Every quantity is monotone in the depth, so the largest difference lies at an end of the cell. An output of 8 bits
 * cannot be more than 255 levels off. "edge" has the output 0 or 1: its error is 255 where the stored depths of two
 * pixels of a plane, the one at a depth of z's cell and the other `slope` behind it, give another answer than the plane
 * does, and 0 elsewhere.
 *
 * @param parameters  TEXTURE_PARAMETERS numbers, in the order of the row, within their ranges
 * @param z           in [near, far]
 * @return from 0 to 255; NaN where the effect cannot be had, and in the model fp32, which has no cells
 */
double effect_error(const effect_row *row, const dp_setup *setup, const double *parameters, double z);

/** What is known of the depth behind a pixel, in place of a cell. */
typedef struct effect_depths {
    double seen;   /**< what the effect gets */
    double lo, hi; /**< between which it truly lies */
    double beside; /**< EFFECT_STEP: how far the other pixel's depth can be off, that of a plane `slope` behind */
} effect_depths;

/**
 * As effect_error(), over these depths. EFFECT_STEP: 255 wherever the two pixels could give another answer than the
 * plane does.
 * @param setup  for its planes alone
 */
double effect_error_within(const effect_row *row, const dp_setup *setup, const double *parameters,
                           const effect_depths *depths);

/**
 * The end of the usable values of the wanted parameter: the smallest (row->smallest) from which on, or the largest up
 * to which, every value of the range keeps the error at z at most `levels`. Found in closed form, then settled to the
 * last bit by effect_error().
 *
 * @param parameters  as above; the wanted one is not read
 * @param levels      above 0 and below 255
 * @return within the range of the parameter; NaN when no value of the range is usable, and where the error is NaN
 */
double effect_usable(const effect_row *row, const dp_setup *setup, const double *parameters, double z, double levels);

#endif
