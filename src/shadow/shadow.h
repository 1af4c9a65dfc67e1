/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file shadow.h  Shadow maps: the bias that keeps a lit surface free of acne, and the gap that it opens.
 *
 *     shadow_light light = shadow_light_default();
 *     shadow_need need;
 *     if (shadow_light_check(&light) == SHADOW_OK) {
 *         shadow_need_of(&light, &need);
 *         for (int way = 0; way < SHADOW_WAY_COUNT; way++)
 *             show(&need.bias[way]);
 *     }
 *
 * A point of a surface is lit where its window depth, seen from the light, is at most the depth stored in each texel
 * that the lookup reads (at least, where the mapping is reversed): LESS_EQUAL, GREATER_EQUAL. The texels were drawn
 * somewhere else, up to a filter radius away on each axis, and everything on the way was rounded. Each of three biases
 * is enough by itself, for planes at any slant up to the given one and any azimuth:
 *
 *     constant       o, added to the window depths of the map
 *     slope-scaled   F m + o, m the greater change of window depth from one texel to the next, on x or y
 *     normal offset  the point is moved along its surface's unit normal by sin(slant) times a length, and looked up
 *                    from there; o is added to the map besides
 *
 * Sizes are magnitudes: o and F are added with shadow_sign(). A bias in the shader that is taken off the point's depth
 * is the same as one added to the map.
 *
 * The promise: the surface, or its triangles, enters as binary32 positions; triangles are of the class
 * light->triangles, not slimmer or larger, and not clipped; the point's position is rounded to binary32, or is off by
 * light->position; map and lookup use one matrix in binary32. depthprec(7), "Shadow maps", derives every term.
 */
#ifndef SHADOW_SHADOW_H
#define SHADOW_SHADOW_H

#include <stdbool.h>

#include "bias/bias.h"
#include "depthprec/depthprec.h"

typedef enum shadow_status {
    SHADOW_OK = 0,
    SHADOW_SETUP,     /**< the set-up is not orthographic, as a directional light's is; or of a light that has a place
                           neither a perspective nor, of distances, orthographic from a near plane above 0 */
    SHADOW_BOX,       /**< width or height is not from 1e-12 to 1e12 scene units */
    SHADOW_CONE,      /**< the angle of a map is not from 0.001 to 170 degrees, or its sides are of different sizes */
    SHADOW_TRIANGLES, /**< dp_triangles_check() refuses them, or the slant reaches beyond SHADOW_SLANT_MAX */
    SHADOW_KERNEL,    /**< the radius is not from 0.5 to 64 texels, or subtexel bits not from 0 to 24 */
    SHADOW_SMALL,     /**< the least height of triangles is not from 2^-8 to 65536 texels */
    SHADOW_POSITION,  /**< the world or the error of positions is negative, beyond 1e18, or no number */
    SHADOW_ROUND,     /**< the radius of curvature is not positive, or the facets' size not from 0 to 1e18 */
    SHADOW_RECEIVERS, /**< the receivers do not lie between the planes, the nearer first; or so far that no number says
                           where */
    SHADOW_COARSE,    /**< the filter and all errors together are half as wide as half the map, or wider */
    SHADOW_CASCADES,  /**< see shadow_split_check() */
    SHADOW_STATUS_COUNT
} shadow_status;

/** One sentence without a full stop that says what is allowed; any value is accepted. */
const char *shadow_status_text(shadow_status status);

#define SHADOW_SLANT_MAX 89.9 /**< degrees */

/** Where the light stands, and with it the shape of its map. */
typedef enum shadow_kind {
    SHADOW_SUN = 0, /**< infinitely far: a box */
    SHADOW_SPOT,    /**< a place: one square map in perspective */
    SHADOW_POINT    /**< a place: the six faces of a cube, 90 degrees each */
} shadow_kind;

/** A light's map and what is known of its use. Start from shadow_light_default(). */
typedef struct shadow_light {
    shadow_kind kind;
    double fov;           /**< of a light that has a place: the angle across its map, degrees; of a point light 90 */
    dp_setup setup;       /**< planes along the light, mapping, format, arithmetic. Any model. Of the sun orthographic;
                               of a light that has a place a perspective, or orthographic where a fragment shader
                               writes the distance, (|P| - near)/(far - near), in place of the depth */
    double width, height; /**< of the sun's box across, scene units */
    dp_triangles triangles; /**< width x height texels; subpixel bits, plane, pixels and slim; slant_hi, the angle from
                                 the surface's normal to the light, 0 to SHADOW_SLANT_MAX. The rest is not read */
    double small;           /**< no triangle is lower than this: its least height, texels; read for slope-scaled */
    double kernel;          /**< how far beside the point on each axis texel centres may be read, texels: 0.5 one texel,
                                 1 bilinear, n/2 a square of n, (n + 1)/2 n bilinear ones */
    int subtexel;           /**< bits to which coordinates are rounded before texels are chosen; 0: not rounded */
    double world;           /**< the largest |coordinate| of positions; 0: positions are given about the box's middle */
    double position;        /**< how far the shader's position of a point may be off the surface, scene units, besides
                                 the rounding to binary32: shadow_rebuilt(); 0: not at all */
    double radius;          /**< the smallest radius of curvature of surfaces, which bend away from the light as spheres
                                 do, scene units; INFINITY: planes */
    double facet;       /**< curved surfaces are drawn as triangles in circles of at most this radius, scene units */
    double receiver_lo; /**< surfaces that are lit lie from here to receiver_hi along the light, within its planes: of
                             depths, or of distances where the map holds these */
    double receiver_hi;
} shadow_light;

/** Whether the map of a light that has a place holds distances. */
static inline bool shadow_holds_distance(const shadow_light *light) {
    return light->kind != SHADOW_SUN && light->setup.spec.ortho != 0;
}

/**
 * A box 20 x 20 and 100 deep, 2048 x 2048 texels in fp32, d3d, 8 subpixel bits, anchored at a vertex, triangles as
 * dp_triangles_default(), at least a texel high, up to 75 degrees; one texel is read (0.5), at 8 bits; planes in all of
 * the box, about its middle.
 */
shadow_light shadow_light_default(void);

shadow_status shadow_light_check(const shadow_light *light);

/** The causes that the bias has to cover. */
typedef enum shadow_cause {
    SHADOW_CAUSE_TEXEL = 0, /**< half a texel from where it was drawn */
    SHADOW_CAUSE_KERNEL,    /**< the rest of the filter's radius */
    SHADOW_CAUSE_LOOKUP,    /**< texture coordinates rounded */
    SHADOW_CAUSE_SNAPPING,  /**< vertices moved to the subpixel grid */
    SHADOW_CAUSE_SETUP,     /**< the plane of a triangle set up and evaluated */
    SHADOW_CAUSE_POSITION,  /**< positions, and the light's matrix: of the map and of the point */
    SHADOW_CAUSE_RECEIVER,  /**< the receiver rebuilt from the camera's depth: light->position */
    SHADOW_CAUSE_FORMAT,    /**< the bias added, the format, and what is read back of it */
    SHADOW_CAUSE_COUNT
} shadow_cause;

/** "texel", ...; null when out of range. */
const char *shadow_cause_name(shadow_cause cause);

/** A part of what is needed: `texels` on each axis, which cost the slope, and window depth at any slope. */
typedef struct shadow_part {
    double texels, window;
} shadow_part;

typedef enum shadow_way { SHADOW_CONSTANT = 0, SHADOW_SLOPE, SHADOW_NORMAL, SHADOW_WAY_COUNT } shadow_way;

/** "constant", "slope-scaled", "normal offset"; null when out of range. */
const char *shadow_way_name(shadow_way way);

/** One of the three biases. */
typedef struct shadow_bias {
    double window;     /**< o, window depth */
    double factor;     /**< F; 0 but for slope-scaled. INFINITY where triangles may be too small for their slope */
    double offset;     /**< 0 but for the normal offset. Of the sun scene units, times sin(slant); of a light that has a
                            place a multiple of the point's depth, at any slant, or of its distance, times sin(slant).
                            INFINITY where none is enough */
    double gap_light;  /**< the widest gap along the light that it opens at the greatest slant, scene units */
    double gap_normal; /**< the same along the normal */
    double gap_facing; /**< either, of surfaces that face the light */
    double share;      /**< slope times filter radius over the bias, at the greatest slant and the azimuth that needs
                            most: no bias below that share of this one is enough */
    bool limited;      /**< the gap reaches beyond the planes behind receiver_hi: depths there are clamped */
} shadow_bias;

/**
 * How far a position that a shader rebuilds from the camera's depth texture may be off the surface, scene units: of
 * receivers at eye depths from lo to hi, in triangles of the set-up's class, by the rays to the corners of the picture
 * in binary32.
 * @param camera  in perspective, of the model exact, with triangles: planes, format and view
 * @param world   as shadow_light has it
 * @return INFINITY where nothing is left of the depth
 */
double shadow_rebuilt(const dp_setup *camera, double lo, double hi, double world);

/** The bias that a light's map needs, and its parts. */
typedef struct shadow_need {
    double texel_x, texel_y; /**< scene units; of a light that has a place where most is needed */
    double texel;            /**< the larger of the two */
    double per_offset;       /**< what an offset of one texel is: that; of a light that has a place at depth 1 */
    double slope;            /**< tangent of the greatest slant */
    shadow_part part[SHADOW_CAUSE_COUNT];
    double texels; /**< sums of the parts */
    double window;
    double curvature;   /**< window depth: what a curved surface adds, slope-scaled alone */
    double offset_only; /**< scene units: a normal offset that is not scaled by the sine and needs no constant */
    shadow_bias bias[SHADOW_WAY_COUNT];
} shadow_need;

/**
 * Fills in *need: of a light that has a place, where receivers need most; gaps are where they are widest. The light has
 * been checked. A fragment shader's distances take no slope-scaled bias: its factor is INFINITY.
 */
void shadow_need_of(const shadow_light *light, shadow_need *need);

/**
 * The least window depth that a constant bias must be for the filter alone, of one plane that a light with a place
 * sees: exactly what its depth changes by over the filter's radius, towards the worst corner.
 * @param normal    of any length, in the light's space: right, up, along the axis
 * @param distance  normal . X of its points, positive
 */
double shadow_plane_needs(const shadow_light *light, const double normal[3], double distance);

/** The cost of a part at a slant (degrees), in window depth, at the worst azimuth: for figures. */
double shadow_part_at(const shadow_light *light, const shadow_part *part, double slant);

/**
 * How far a bias moves a surface towards the light, at a slant from 0 to the greatest, degrees, at the azimuth where
 * that is most. A thin caster parallel to the surface and closer to it casts no shadow on it, or but in places; one
 * that is farther by as much as the constant bias is certain to. INFINITY where the factor is.
 */
void shadow_gap_at(const shadow_light *light, const shadow_bias *bias, double slant, double *along_light,
                   double *along_normal);

/** 1 where a bias of the map is added (d grows away from the light), -1 where it is subtracted: reversed mappings. */
int shadow_sign(const shadow_light *light);

/** A bias as a program sets it. */
typedef struct shadow_state {
    double units;     /**< magnitude; a whole number where the API counts in r. INFINITY: no such number is enough */
    double factor;    /**< magnitude */
    double gap_light; /**< as of the bias, with the units that it came to, where they are worth most */
    double gap_normal;
    double gap_facing; /**< either, of surfaces that face the light */
} shadow_state;

/**
 * The fewest units that are worth bias->window or more wherever receivers lie. Where a unit's worth follows the depth's
 * exponent (float buffers of most APIs), that is decided by the smallest depth of receivers, and the gap by casters
 * that have the greatest: see shadow_casters_window().
 */
shadow_state shadow_state_of(const shadow_light *light, const shadow_bias *bias, const bias_api *api);

/**
 * The most window depth that so many units are worth, of casters that may not yet be in front of receivers of that
 * light. Where a unit's worth follows the exponent of a primitive's greatest depth it is the caster's that counts: in a
 * reversed map casters have greater depths than what they shade, and their triangles reach nearer still, as the class
 * has them. In another map no triangle of a caster is taken to lie beyond receiver_hi.
 * @param rest  what is added besides: window, factor and offset
 */
double shadow_casters_window(const shadow_light *light, const shadow_bias *rest, const bias_api *api, double units);

/** A bias as the API's units make it of casters, where a unit's worth follows the depth; else, and where no number of
 * units is enough, itself. */
shadow_bias shadow_as_added(const shadow_light *light, const shadow_bias *bias, const bias_api *api);

/** The gaps that a state opens on receivers of that light, where units of casters are worth most: *state has the widest
 * of both. */
void shadow_state_widen(const shadow_light *light, const shadow_bias *bias, const bias_api *api, shadow_state *state);

/* ---- Cascades ---------------------------------------------------------------------------------------------------- */

enum { SHADOW_CASCADES_MAX = 16 };

/** A view frustum, and how it is split. */
typedef struct shadow_split {
    double znear, zfar;   /**< eye depths of the view that have shadows, 1e-12 <= znear < zfar <= 1e12 */
    double fov_y, aspect; /**< vertical angle, degrees, 0.001 to 179.9; width over height, 0.001 to 1000 */
    int count;            /**< cascades, 1 to SHADOW_CASCADES_MAX */
    double lambda;        /**< 0 uniform to 1 logarithmic */
    double casters;       /**< how far before a cascade's sphere, towards the light, things cast shadows; 0 or more */
    bool stable;          /**< the box moves in whole texels with the view */
    const dp_setup
        *camera; /**< receivers are rebuilt from its depth texture: see shadow_rebuilt(); null: they are not */
} shadow_split;

/** Near 0.1, far 100, 60 degrees, 16:9, 4 cascades, lambda 0.5, casters 100 before, stable. */
shadow_split shadow_split_default(void);

/** @return SHADOW_OK or SHADOW_CASCADES */
shadow_status shadow_split_check(const shadow_split *split);

/** One cascade: the part of the view and its light's box. */
typedef struct shadow_cascade {
    double from, to; /**< eye depths of the view */
    double radius;   /**< of the smallest sphere about that part of the frustum, scene units */
    double centre;   /**< eye depth of its centre, on the axis */
    shadow_light light;
} shadow_cascade;

/**
 * Cascade `index`, from 0. The box is square and stands about the bounding sphere, so its size depends neither on where
 * view nor light look; it is wider by the filter's radius, and by half a texel if stable, and deeper by `casters`
 * before and by the largest gap behind.
 *
 * Formula: from and to by the practical split scheme, lambda n (f/n)^(i/N) + (1 - lambda) (n + (f - n) i/N).
 * Source: Zhang, Sun, Xu and Lun, Parallel-split shadow maps for large-scale virtual environments, VRCIA 2006.
 *
 * @param model  what all cascades share: map, format, mapping, triangles, filter, positions. Its box is not read
 * @return SHADOW_OK, or what is wrong with split or model; or SHADOW_BOX where the box cannot be made
 */
shadow_status shadow_cascade_of(const shadow_split *split, const shadow_light *model, int index, shadow_cascade *out);

#endif
