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
 * Each row has its formula twice: exactly, in double, and in binary32, operation by operation, as a shader evaluates it
 * on the depth that it decodes and the place that it reconstructs.
 *
 * Depths enter as doubles, each within 2^-50 of itself, which errors inherit.
 */
#ifndef SHADER_EFFECT_H
#define SHADER_EFFECT_H

#include "core/named.h"
#include "shader/camera.h"
#include "shader/parameter.h"

/** How the wanted parameter p and the row's quantity v, with v' where it is compared, make the output. */
typedef enum effect_kind {
    EFFECT_FADE = 0, /**< a ramp of (v - v')/p from 0 to 1: the error falls as p grows */
    EFFECT_GAIN,     /**< p (v - v') and a constant: the error grows with p */
    EFFECT_CLAMPED,  /**< saturate(p v): the error grows with p until the output saturates */
    EFFECT_DECAY,    /**< 1 - exp(-p (v - v')): the error grows with p */
    EFFECT_STEP      /**< 0 or 1: which, a comparison with p says */
} effect_kind;

/** Bits for the inputs of an effect besides the depth of its pixel. */
enum {
    EFFECT_POSITION = 1,     /**< the world position of the pixel, so the camera */
    EFFECT_LAST_FRAME = 2,   /**< last frame's view-projection */
    EFFECT_SECOND_DEPTH = 4, /**< another depth: of a surface that is drawn, or of other pixels */
    EFFECT_NORMALS = 8       /**< normals: of a synthetic image, or packed, or made of the depths */
};

/** Which pixels an effect looks at besides its own: corners of a square, `sample-distance` away on both axes. */
typedef enum effect_taps {
    EFFECT_ALONE = 0,
    EFFECT_DIAGONALS, /**< opposite corners are compared; the larger of two outputs */
    EFFECT_AROUND     /**< its own with each corner; the mean of four outputs */
} effect_taps;

/** How an effect changes a picture of colours. */
typedef enum effect_mix {
    EFFECT_TINTS = 0, /**< where it is 1 there is its tint */
    EFFECT_SPARES,    /**< where it is 0 */
    EFFECT_BLURS,     /**< where it is 1 there is the mean of nine pixels, `blur` apart */
    EFFECT_SMEARS     /**< the mean of `samples` pixels, its vector apart */
} effect_mix;

/** The exact inputs of an effect at a pixel. */
typedef struct effect_view {
    const dp_setup *setup;    /**< planes; cells, where none are given */
    double base[3], along[3]; /**< at eye depth z it shows the place base + along z, world coordinates */
    double stretch;           /**< length of its ray per unit of eye depth */
    double normals[2][3];     /**< EFFECT_NORMALS: of two pixels, view space */
    double ndc[2];            /**< where it lies in this frame: from -1 to 1, to the right and up */
    /** Where its place lay in last frame's picture: (from + per z)/(w + w_per z). */
    struct {
        double from[2], per[2], w, w_per;
    } last;
} effect_view;

/**
 * The view of a pixel. The camera must live as long, or `setup` be set to one that does.
 * @param last  last frame's camera; null: it was this one
 */
effect_view effect_view_of(const texture_camera *camera, const texture_camera *last, double column, double row);

/** The same in a shader. Of a depth that it only compares with, eye and eye01. */
typedef struct effect_pixel {
    float eye, eye01; /**< eye depth; the same over far */
    float world[3];
    float ndc[2], stretch;
    float normal[3];
    const float (*last)[4]; /**< rows x, y and w of last frame's view-projection */
} effect_pixel;

/** |v - v'| of two depths; the farther they are from each other the larger. */
typedef double effect_apart(const effect_view *view, const double *parameters, double z, double other);
/** EFFECT_CLAMPED: v, monotone in z. EFFECT_FADE: null, or v - v', which may be concave in place of monotone. */
typedef double effect_quantity(const effect_view *view, const double *parameters, double z);
/** The largest v - v' of the depths from lo to hi. */
typedef double effect_most(const effect_view *view, const double *parameters, double lo, double hi);
/** The output, before it is stored in 8 bits, where the effect sees eye depth z; `reference` is the eye depth of what
 *  it is compared with, if that is `given` or another pixel. */
typedef double effect_output(const effect_view *view, const double *parameters, double z, double reference);
typedef float effect_shader(const effect_pixel *pixel, const float *parameters, const effect_pixel *reference);
/** The vector whose length the output is: to the right and up, in widths and heights of the picture. */
typedef void effect_vector(const effect_pixel *pixel, const float *parameters, float out[2]);
typedef void effect_exact_vector(const effect_view *view, const double *parameters, double z, double out[2]);
/**
 * EFFECT_STEP: below which values of the wanted parameter the output on a plane is 1, the least and the most of them.
 * @param seen   the depth of the pixel
 * @param apart  between which differences of two depths, scene units
 */
typedef void effect_critical(const effect_view *view, const double *parameters, double seen, const double apart[2],
                             double out[2]);

typedef struct effect_row {
    NAMED_FIELDS; /**< the note is the formula, the aliases what articles and shaders call it */
    texture_parameter parameters[PARAMETERS_MAX + 1];
    int wanted;     /**< the parameter whose usable values are looked for */
    bool smallest;  /**< it is usable from some value up; else from some value down */
    int ceiling;    /**< EFFECT_STEP: another parameter, beyond which differences count for nothing; 0: none */
    int behind;     /**< EFFECT_FADE: another parameter, how far behind it the other end of an eye depth lies, which is
                         stored too; 0: none */
    bool eye01;     /**< uses z/far, so far must be finite */
    unsigned needs; /**< EFFECT_POSITION and the like */
    const char *reference; /**< what the depth is compared with; null when with nothing */
    bool given;            /**< the reference is a parameter, which the user gives with an image */
    effect_kind kind;
    effect_taps taps;
    bool alone; /**< EFFECT_STEP: the difference is that of a depth to the stored one of its own cell, else that of the
                     stored depths of two pixels of a plane, the one `slope` behind the other */
    bool quiet; /**< EFFECT_STEP: on a plane the output should be 0; else what it would be without rounding */
    effect_quantity *quantity;
    effect_most *most;         /**< EFFECT_FADE with a quantity */
    effect_apart *apart;       /**< null for EFFECT_CLAMPED and EFFECT_STEP */
    effect_critical *critical; /**< EFFECT_STEP */
    effect_output *output;
    effect_shader *shader;
    effect_vector *vector; /**< null: it has none */
    effect_exact_vector *exact_vector;
    bool wide; /**< it is shown, besides its length */
    effect_mix mix;
    bool surface;   /**< a depth test hides it where the scene is before its reference, not its value */
    double tint[4]; /**< by default: red, green, blue, alpha */
} effect_row;

NAMED_ROWS(effect_row, effect);

/** The eye depth of a row that is `given`, by its parameters `reference`, or `reference01` times far; NaN where neither
 *  is. */
double effect_reference(const effect_row *row, const double *parameters, double zfar);

/** Can the effect be had? Not when it needs a finite far plane and there is none. */
bool effect_applies(const effect_row *row, const dp_setup *setup);

/**
 * How far the error stays within so many levels, from `lo` on: the last such depth before the first that was found
 * beyond; `hi` where none is beyond, NaN where `lo` is. Depths are tried at 64 places of each run of them whose steps
 * grow with the depth, and at its end: with the step grows the error, but for effects of two depths, pixels or
 * frames, which effect_is_steady() tells.
 *
 * @param steps  of effect_step() instead, for all but EFFECT_STEP: so far a step of the stored depth shows in no band
 */
bool effect_is_steady(const effect_row *row);
double effect_reach(const effect_row *row, const effect_view *view, const double *parameters, bool steps, double lo,
                    double hi, double levels);

/** effect_usable(), or effect_step_usable(), of all depths from lo to hi, tried at the same places; NaN where nothing
 * is usable at one of them. */
double effect_usable_over(const effect_row *row, const effect_view *view, const double *parameters, bool steps,
                          double lo, double hi, double levels);

/**
 * The error of the output at z, in levels of 1/255.
 *
 * Every quantity is monotone in the depth, so the largest difference lies at an end of the cell. An output of 8 bits
 * cannot be more than 255 levels off. EFFECT_STEP has the output 0 or 1: its error is 255 where a place of a plane, at
 * a depth of z's cell, gets another answer than the plane should, and 0 elsewhere. Of a vector it is the length of
 * the difference of two velocities.
 *
 * @param parameters  PARAMETERS_MAX numbers, in the order of the row, within their ranges
 * @param z           in [near, far]
 * @return from 0 to 255; NaN where the effect cannot be had, and in the model float, which has no cells
 */
double effect_error(const effect_row *row, const effect_view *view, const double *parameters, double z);

/**
 * How far the outputs of what is stored of z, and of what is stored of the depths right beyond its cell, lie apart at
 * most, in levels: the edge of a band, about twice the error. 0 beyond the last code; NaN for EFFECT_STEP, for effects
 * of two stored depths, and where the error is NaN.
 */
double effect_step(const effect_row *row, const effect_view *view, const double *parameters, double z);

/** The span of depths that a pixel may have, in place of a cell. */
typedef struct effect_depths {
    double seen;   /**< what the effect gets */
    double lo, hi; /**< between which it truly lies */
} effect_depths;

/** As effect_error(), over these depths; NaN for EFFECT_STEP that is not `alone`. */
double effect_error_within(const effect_row *row, const effect_view *view, const double *parameters,
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
double effect_usable(const effect_row *row, const effect_view *view, const double *parameters, double z, double levels);

/** The same of effect_step(). */
double effect_step_usable(const effect_row *row, const effect_view *view, const double *parameters, double z,
                          double levels);

/** Slopes from which on a plane at z's cell shows as an edge: itself, and as it is stored the first with which it does
 * at one of its places, and the first with which it does at all of them. Between the two an edge comes and goes. */
typedef struct effect_slopes {
    double plane, first, last;
} effect_slopes;

/** For EFFECT_STEP on planes of a `slope` that need not be quiet, with a `smallest` parameter; all NaN for other rows
 * and in the model float, each NaN where none up to far does. */
effect_slopes effect_slopes_at(const effect_row *row, const effect_view *view, const double *parameters, double z);

/** The largest value of the parameter `ceiling` with which no place of a plane, at a depth of z's cell, gets another
 *  answer than it should, the others being what they are: every smaller one has none either. NaN for other rows, in the
 *  model float, and where there is none. */
double effect_ceiling(const effect_row *row, const effect_view *view, const double *parameters, double z);

/** EFFECT_STEP that is `alone`: the share of the places of a plane, all over z's cell and all over a texel, that get
 *  another answer than they should; eye depths in the cell count alike. NaN for other rows. */
double effect_share(const effect_row *row, const effect_view *view, const double *parameters, double z);

#endif
