/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file bias.h  Depth bias: what each API adds to a window depth, what that is in the scene, and how much is enough.
 *
 * Every API adds one number to the window depths of a polygon,
 *
 *     o = clamp(units r + factor m)
 *
 * with m the greatest change of window depth from one pixel to the next, and differs only in r, the worth of one unit.
 * A row of the table says what r is for an integer and for a float buffer:
 *
 *     ONE       1: the bias is a window depth
 *     CODE      the value of code 1, 1/(2^N - 1), rounded to binary32
 *     POWER     2^-N
 *     BOUND     the implementation's choice, at most 2 2^-N; taken to be at least 2^-N
 *     FREE      the implementation's choice; taken to be at least 2^-N
 *     EXPONENT  2^(e - M), e the exponent of the greatest window depth in the primitive, M the mantissa bits (23)
 *               by the row's convention: of a depth in [2^n, 2^(n+1)) it is n, n + 1, or left open
 *     MANTISSA  2^-(M + 1)
 *
 * Bias is applied to the depth that the hardware holds, a binary32 number, and the result is clamped to [0, 1]. Of a
 * depth range Direct3D and WebGPU clamp it to that; others do where depth is clamped in place of clipped. bias_at()
 * clamps to the range, and a verdict holds either way.
 */
#ifndef BIAS_BIAS_H
#define BIAS_BIAS_H

#include <stdbool.h>

#include "core/named.h"
#include "depthprec/depthprec.h"

typedef enum bias_rule {
    BIAS_ONE = 0,
    BIAS_CODE,
    BIAS_POWER,
    BIAS_BOUND,
    BIAS_FREE,
    BIAS_EXPONENT,
    BIAS_MANTISSA
} bias_rule;

/** The exponent of a depth in [2^n, 2^(n+1)), as specifications and drivers count it. */
typedef enum bias_exponent {
    BIAS_EXPONENT_OPEN = 0, /**< n or n + 1: r is at least that of n, and twice that at most */
    BIAS_EXPONENT_N,
    BIAS_EXPONENT_NEXT /**< n + 1 */
} bias_exponent;

typedef struct bias_api {
    NAMED_FIELDS;
    bias_rule unorm;        /**< r of an integer buffer */
    bias_rule real;         /**< r of a float buffer */
    bias_exponent exponent; /**< of EXPONENT */
    bool whole;             /**< units are a 32-bit integer, not a float */
    bool clamps;            /**< has a clamp */
    bool binary32;          /**< the specification says that o is computed in binary32 */
    bool guaranteed;        /**< r is by definition a difference that polygons with the same vertices keep apart */
    const char *call;       /**< how a program sets it: U stands for the units, F for the factor */
    const char *sloped;     /**< what follows where there is a factor, likewise; "" where `call` has it */
    double scale_least, scale_most; /**< what the units are multiplied by on the way, at least and at most; 0, 0: 1 */
    const char *language;           /**< of its shaders, a name of `list languages` */
    const char *mapping;            /**< the one that its clip range has; null where its programs have several */
    const char *format;             /**< what its windows have; null where a program chooses */
    bool rising;                    /**< a viewport's minimum is at most its maximum */
} bias_api;

/** Whether the convention of the exponent is open for that format. */
bool bias_is_open(const bias_api *api, const dp_format *format);

/** The same row where the convention is n + 1. */
bias_api bias_next(const bias_api *api);

NAMED_ROWS(bias_api, bias_api);

/** The worth of one unit, in window depth. */
typedef struct bias_unit {
    double least; /**< the smallest r that is allowed or, for FREE, likely */
    double most;  /**< the greatest; INFINITY when the specification sets no bound. Equal to `least` when r is exact */
} bias_unit;

/**
 * r for a primitive.
 * @param d  the greatest window depth in the primitive, [0, 1]; read for EXPONENT. Depths below the smallest normal
 *           number count as if they had its exponent (the specifications are silent there)
 */
bias_unit bias_unit_at(const bias_api *api, const dp_format *format, double d);

/** The bias as a program sets it. */
typedef struct bias_state {
    const bias_api *api;
    double units;  /**< GL units, D3D DepthBias, Vulkan depthBiasConstantFactor */
    double factor; /**< GL factor, SlopeScaledDepthBias, depthBiasSlopeFactor */
    double clamp;  /**< 0: none; positive: o is at most this; negative: at least this */
} bias_state;

/**
 * The bias o that is added to a window depth.
 * @param r  the worth of one unit
 * @param m  the change of window depth from one pixel to the next, not negative
 */
double bias_offset(const bias_state *state, double r, double m);

/** m of a surface at z whose eye depth changes by `slope` scene units from one pixel to the next. z in [near, far]. */
double bias_window_slope(const dp_setup *setup, double z, double slope);

/** The effect of a bias on a depth. */
typedef struct bias_effect {
    double z;       /**< eye depth, scene units */
    bias_unit r;    /**< of a primitive whose greatest window depth is that of z */
    double m;       /**< window slope */
    double offset;  /**< o, with r.least */
    double depth;   /**< the biased window depth, in [0, 1] */
    uint32_t code;  /**< what is stored without the bias */
    uint32_t moved; /**< what is stored with it */
    double to;      /**< the eye depth of the biased depth; INFINITY at an infinite far plane */
    double shift;   /**< to - z without cancellation: negative is nearer to the camera */
    bool limited;   /**< the biased depth left [0, 1] and was held at a plane */
} bias_effect;

/** `slope` as bias_window_slope(). The set-up's model is taken to be exact. z in [near, far]. */
bias_effect bias_at(const dp_setup *setup, const bias_state *state, double slope, double z);

/** The separation that a bias has to reach. */
typedef struct bias_goal {
    const bias_api *api;
    double factor; /**< of the slope's bias: positive brings the layer nearer, whatever the mapping */
    double slope;  /**< scene units per pixel: the layers may be sampled up to one pixel apart */
    double gap;    /**< the layer must come nearer by at least this, scene units; 0: only be told apart */
    double clamp;  /**< the bias is at most this, window depth; 0: there is no clamp */
    bool judged; /**< of units that somebody has: fractions of them count, they may be on the other side of 0, and what
                      is held at a plane, or may be displaced beyond one, is not told apart */
} bias_goal;

/**
 * The fewest units that bring a layer in front of a coplanar one at z, whatever the depth's alignment to the codes: a
 * magnitude, to be given the sign of bias_sign(). A whole number where the API counts in r; and, where it takes a
 * float, a binary32 number.
 *
 * They must cover the distance in window depth that certainly leads from one code to another (for guaranteed APIs r;
 * for fp32, whose depths are binary32 numbers, one step; else one step of the format and half a step of binary32 for
 * the rounding of the sum), or the gap's where that is larger. A slope adds m and the rounding of two depths, less
 * factor m.
 *
 * @return INFINITY when the gap leads past the near plane or r is so small that 2^31 units are not enough
 */
double bias_needed(const dp_setup *setup, const bias_goal *goal, double z);

/**
 * The fewest units that make an offset of at least `window`, not negative, of a primitive whose greatest window depth
 * is d: a magnitude, rounded as bias_needed() rounds. @return INFINITY when 2^31 units are not enough
 */
double bias_units(const bias_api *api, const dp_format *format, double d, double window);

/** The greatest bias_needed() over a range, a certified bound, and the depth that needs it. lo < hi in [near, far]. */
double bias_needed_over(const dp_setup *setup, const bias_goal *goal, double lo, double hi, double *worst);

/**
 * The part of a range in which so many units are enough, or with INFINITY any number of them: one span, from the near
 * end where that is in it, else up to the far end, else about the first of a few depths between.
 * @param from, to  NaN where there is none. Within 2^-48 of the true ends, inwards
 */
void bias_enough_over(const dp_setup *setup, const bias_goal *goal, double units, double lo, double hi, double *from,
                      double *to);

/**
 * Where the set-up has triangles the layers are one plane drawn twice, as different ones of the class, see
 * dp_coplanar_over(): then what they need is told by bias_needed() and the like. With a slope it is for planes whose
 * depth changes by so much from one pixel to the next, or less. Without, it is for planes at any slant, and only this
 * factor or a larger one makes units enough; triangles are at least a pixel high.
 *
 * @return a binary32 number; 0 without triangles, INFINITY where no factor is enough
 */
double bias_factor_least(const dp_setup *setup);

/** The sign of units and factor that brings a layer nearer to the camera: -1, or 1 for reversed mappings. */
int bias_sign(const dp_setup *setup);

#endif
