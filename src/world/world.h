/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file world.h  How far from the origin a world may reach: ways to bring a vertex from the world before the camera in
 * binary32, a row each: what each does, step by step, and a bound of what it is off by.
 *
 * Lengths are scene units. A mesh is a translated one: its vertices are an origin in the world and, beside it, places
 * of the mesh. Which of an error two vertices share decides whether their order is kept, so a bound has three parts.
 * depthprec(7), "Large worlds", derives each.
 */
#ifndef WORLD_WORLD_H
#define WORLD_WORLD_H

#include <stdbool.h>
#include <stddef.h>

#include "core/named.h"

typedef struct world_row world_row;

/** A scheme and its size. */
typedef struct world_scheme {
    const world_row *row;
    double size; /**< of a split, tile or cell; 0 where the row has none */
} world_scheme;

/** A camera in the world. */
typedef struct world_camera {
    double eye[3];
    double axis[3][3]; /**< right, up and ahead: orthonormal but for 2^-50 */
    unsigned order;    /**< of the sums: below WORLD_ORDERS; the others have the terms in other orders, or in pairs */
    double lag;        /**< of a cell: from -1 to 1, which of two it is in still, where those are that it may be in */
    bool fused;        /**< products but the first are fused into the sums */
} world_camera;

/** A place on a surface: origin + local, exactly. */
typedef struct world_place {
    double origin[3], local[3];
} world_place;

enum { WORLD_ORDERS = 48 };

/** The largest errors of a coordinate of view space. */
typedef struct world_error {
    double vertex; /**< each vertex by itself */
    double mesh;   /**< shared by all vertices about one origin */
    double camera; /**< shared by all that the camera sees, but for `turn` of what lies between them */
} world_error;

/** Where a place lies. Positive numbers; the origin of its mesh is no farther from it than `length`. */
typedef struct world_where {
    double distance; /**< from the world's origin to the camera, at most */
    double length;   /**< from the camera to the place, at most */
    double result;   /**< magnitude of the coordinate in view space, at most; not above `length` */
} world_where;

struct world_row {
    NAMED_FIELDS;
    const char *size; /**< what the number behind the name is; null where there is none */
    double standard;  /**< the size where none is given */
    bool power2;      /**< the size is a power of two */
    bool metres;      /**< `standard` is of metres; else of scene units, whatever they are */
    bool meshes;      /**< meshes have origins, whose rounding all their vertices share: world_error.mesh */
    void (*view)(const world_scheme *s, const world_camera *camera, const world_place *place, float out[3]);
    world_error (*bound)(const world_scheme *s, const world_where *at);
};

enum { WORLD_ROWS = 8 };

/** By how much less than what lies between two places their part of `camera` may differ, as a share of it. */
#define WORLD_TURN 0x1.bb68p-25 /* sqrt(3)/2 2^-24, rounded up */

/** The rows, those that suffice least first. */
NAMED_ROWS(world_row, world);

/** Is it a size of the row: from 1e-3 to 1e12, a power of two where it must be. */
bool world_size_fits(const world_row *row, double size);

/** NAME, or NAME:SIZE, scene units. @return false, and *out as it was, where it is none */
bool world_parse(const char *text, world_scheme *out);

/** The place in view space (right, up, ahead), in binary32 as the scheme does it. Coordinates at most 1e12. */
void world_view(const world_scheme *s, const world_camera *camera, const world_place *place, float out[3]);

/** The same exactly, to 1e-18 of the largest coordinate in the world. */
void world_exact(const world_camera *camera, const world_place *place, long double out[3]);

/** The bound, whatever the order of the sums, and fused or not. It rises with all that it is asked about. */
world_error world_bound(const world_scheme *s, const world_where *at);

/**
 * How far behind a surface at eye depth z another one, on a ray from the camera, surely has the larger view z: at this
 * or more. Before anything else is rounded. @param lean  no surface is farther than this times its eye depth, at most
 * 1e7
 */
double world_gap(const world_scheme *s, double distance, double z, double ray_ratio, bool shared_origin);

/** The error of one vertex, all parts together. */
static inline double world_all(const world_error *e) {
    return e->vertex + e->mesh + e->camera;
}

/** The error that two vertices do not share, by whether their meshes share an origin. */
static inline double world_own(const world_error *e, bool shared_origin) {
    return shared_origin ? e->vertex : e->vertex + e->mesh;
}

#endif
