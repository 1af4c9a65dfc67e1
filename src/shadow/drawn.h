/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file drawn.h  Biases of shadow maps on trial: a plane and its casters drawn into a map by a rasterizer of
 * src/raster, and points of the plane looked up in it.
 *
 * Each plane has a random slant and lies at a random depth; it is drawn about a random texel as a mesh of random
 * triangles of the light's class, none lower than BIAS_DRAWN_LOWEST texels, with the bias that is tried. Two casters
 * are parallel to it and stand before half of it: one beyond the gap, whose shadow is certain, and one within it.
 * Points of the plane lie SHADOW_DRAWN_POINTS to a texel on either axis; each is rounded to binary32, transformed by
 * the map's own matrix, and compared with every texel whose centre the filter may read.
 */
#ifndef SHADOW_DRAWN_H
#define SHADOW_DRAWN_H

#include "raster/mesh.h"
#include "shadow/engine.h"

enum { SHADOW_DRAWN_POINTS = 3, SHADOW_DRAWN_SIDE = 48 }; /* on an axis: points of a texel, texels */

/** The bias that is tried: one of the API and an offset, or an engine's. */
typedef struct shadow_worn {
    bias_state state;            /**< signed; units and factor 0: none */
    double offset;               /**< as shadow_bias has it */
    const shadow_engine *engine; /**< null: that above; else its numbers, of what it may give the most */
    double bias, normal;
} shadow_worn;

/** A plane, its triangles and its casters. */
typedef struct shadow_scene {
    draw_plane plane;
    draw_mesh mesh;
    draw_area area;
    double slant; /**< at the texel it was made for, degrees */
    double z;     /**< and its depth there */
} shadow_scene;

typedef struct shadow_drawing {
    const shadow_light *light;
    const bias_api *api;   /**< what engines' units are of */
    double beyond, within; /**< how far the casters stand before the plane, scene units along the light; 0: none */
    draw_camera camera;
    draw_buffer layer[3]; /**< the plane, and both casters */
    shadow_worn worn;     /**< of what was drawn */
    bias_state state;     /**< likewise: what is added to the map */
} shadow_drawing;

typedef enum shadow_seen {
    SHADOW_SEEN_NONE = 0, /**< not judged: off the map or the plane, steeper than the light's class, or no receiver */
    SHADOW_SEEN_LIT,
    SHADOW_SEEN_ACNE, /**< some texel that is read darkens the lit plane */
    SHADOW_SEEN_EDGE, /**< of the texels that are read some have a caster and some none */
    SHADOW_SEEN_DARK,
    SHADOW_SEEN_LEAK,  /**< behind the caster that is far enough, and some texel lets light pass */
    SHADOW_SEEN_SHORT, /**< dark behind the caster within the gap */
    SHADOW_SEEN_LOST,  /**< and not dark there */
    SHADOW_SEEN_COUNT
} shadow_seen;

/** A point, and which share of the texels that are read lets light pass. */
typedef struct shadow_point {
    shadow_seen seen;
    double lit;
} shadow_point;

/** How many points were what. */
typedef struct shadow_drawn {
    uint64_t of[SHADOW_SEEN_COUNT];
} shadow_drawn;

/**
 * Makes room, and a camera that draws the map; a point light's is one face.
 * @return RASTER_OK, or why the rasterizer does not draw it; to be closed in any case
 */
raster_status shadow_drawing_open(shadow_drawing *d, const raster_row *row, const shadow_light *light);
void shadow_drawing_close(shadow_drawing *d);

/** A random plane. @return false where it is not seen */
bool shadow_scene_random(const shadow_drawing *d, uint64_t *state, shadow_scene *out);

/**
 * Puts casters before it: one farther than any of the biases' gaps wherever it is asked about, and than what the
 * constant one covers besides; one half as far as the constant bias reaches where that is least.
 * @param need  of the light
 */
void shadow_scene_stand(shadow_drawing *d, const shadow_scene *scene, const shadow_need *need);

/** Draws it with a bias, for the points that are asked about. */
void shadow_scene_draw(shadow_drawing *d, const shadow_scene *scene, const shadow_worn *worn);

/** The point of the plane that is seen from the light at (u, v), texels from the lower left. */
shadow_point shadow_point_at(const shadow_drawing *d, const shadow_scene *scene, double u, double v);

/** Adds all of its points, as they are with the bias drawn last. */
void shadow_scene_count(const shadow_drawing *d, const shadow_scene *scene, shadow_drawn *out);

#endif
