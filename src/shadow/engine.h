/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file engine.h  The biases of shadow maps as engines have them: what their numbers do to a map, whether that is
 * enough, and which numbers do the same in another engine.
 *
 * A number is a window depth, a length, so many texels, or units of the API, and moves the compared depth along the ray
 * to the light; a normal bias moves point or caster along the normal, by the same at any angle, or times the sine of
 * the angle, or times one less its cosine. Some engines set units and a slope factor besides.
 */
#ifndef SHADOW_ENGINE_H
#define SHADOW_ENGINE_H

#include "shadow/shadow.h"

typedef enum shadow_measure {
    SHADOW_IN_NOTHING = 0, /**< the engine has no such number, or not for that light */
    SHADOW_IN_WINDOW,      /**< window depth */
    SHADOW_IN_SCENE,       /**< scene units */
    SHADOW_IN_TEXELS,      /**< texels at the point's depth */
    SHADOW_IN_FAR_TEXELS,  /**< texels, of a spot or point light half of one at the far plane */
    SHADOW_IN_SHARES,      /**< of a spot or point light: the point's distance over the texels of a side of the map */
    SHADOW_IN_CLIP,        /**< of a spot light's depth: clip z for each range of the light over the point's distance */
    SHADOW_IN_UNITS        /**< units of the API, and as large a slope factor */
} shadow_measure;

typedef enum shadow_growth {
    SHADOW_AT_ANY_ANGLE = 0,
    SHADOW_BY_SINE,
    SHADOW_BY_VERSINE, /**< 1 - cos */
    SHADOW_ASIDE /**< the same, and only what of that is square to the ray: as much as (1 - cos) sin^2 along the normal
                  */
} shadow_growth;

typedef struct shadow_engine {
    NAMED_FIELDS;
    const char *bias, *normal; /**< what it calls them; null where it has none */
    /** For each shadow_kind: what both numbers measure, what 1 of each is (negative where negative numbers keep
     * surfaces lit), and how the second grows. */
    shadow_measure bias_in[3], normal_in[3];
    double bias_scale[3], normal_scale[3];
    shadow_growth growth[3];
    double standard[3][2];   /**< the defaults of both, for each shadow_kind */
    bool soft;               /**< both are multiplied by the filter's radius where that reads more than 2 x 2 texels */
    double units, factor;    /**< set besides, whatever the numbers */
    const char *unconfirmed; /**< what of the row is not; "" when all is */
    const char *instead;     /**< why no bias follows from its numbers; "" where one does */
} shadow_engine;

NAMED_ROWS(shadow_engine, shadow_engine);

/** What an engine's two numbers do at one depth. */
typedef struct shadow_given {
    double window_most; /**< along the ray on the axis, window depth */
    double factor;
    double offset;       /**< along the normal at 90 degrees, or at any angle, scene units; where that is least */
    double offset_most;  /**< and where it is most */
    double units;        /**< of the API, which are part of the window depths; their worth is that of receivers there */
    double added;        /**< window depth that is added as it is: no units, no lengths */
    double level;        /**< window depth that all rays are given alike, units included */
    double ray_share;    /**< the length along the ray that is given besides, over the depth of the point; of the sun
                              scene units: the least of all receivers, */
    double ray_most;     /**< and the longest, scene units */
    double offset_share; /**< l/(z + l) of the offset l, of the sun l: the least of all receivers */
    const bias_api *api;
    shadow_growth growth;
} shadow_given;

/**
 * @param light  checked; what is given where receivers are nearest
 * @param api    what units are of
 */
shadow_given shadow_engine_gives(const shadow_engine *engine, const shadow_light *light, const bias_api *api,
                                 double bias, double normal);

/** How far it moves a point along its normal at an angle, degrees; scene units. */
double shadow_given_offset(const shadow_given *given, double angle);

/** The engine's bias that is that window depth on the axis where receivers are nearest, what it sets besides included;
 * and its normal bias that moves as far at the greatest angle. NaN: it has no such number there. */
double shadow_bias_as(const shadow_engine *engine, const shadow_light *light, const bias_api *api, double window);
double shadow_normal_as(const shadow_engine *engine, const shadow_light *light, double offset);

/** Whether that is enough. */
typedef struct shadow_verdict {
    double free; /**< no surface has acne up to that angle, degrees, in steps of a tenth; -1: facing ones may */
    double acne; /**< a surface on the axis has acne at that angle, by the filter alone; NaN: none up to the greatest */
    double gap;  /**< the widest along the light, at the greatest angle, of casters wherever they are, scene units */
} shadow_verdict;

/** The length along the light that lacks at an angle, degrees, where most lacks; below 0 so much is left. Above 0 the
 * verdict's `free` is less. */
double shadow_lacking(const shadow_light *light, const shadow_given *given, double angle);

/** Of receivers of that light from receiver_lo to receiver_hi, at most an eighth of an octave. */
shadow_verdict shadow_judge(const shadow_light *light, const shadow_given *given);

/** The same of all receivers, of any extent: the worst of each. */
shadow_verdict shadow_judge_all(const shadow_engine *engine, const shadow_light *light, const bias_api *api,
                                double bias, double normal);

/**
 * The least magnitude of the bias, with its sign, that is enough up to the greatest angle beside that normal bias; or
 * of the normal bias beside that bias. NaN: none is, up to 1e6 times the largest length or depth of the map.
 */
double shadow_least_bias(const shadow_engine *engine, const shadow_light *light, const bias_api *api, double normal);
double shadow_least_normal(const shadow_engine *engine, const shadow_light *light, const bias_api *api, double bias);

#endif
