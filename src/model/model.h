/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file model.h  The triangles of a model, in the world, in double: glTF 2.0 (.glb, .gltf) and OBJ; others by
 * libassimp, see assimp.c.
 *
 * Nodes are placed in their rest pose: skins, animations and morph targets do not move anything, and are counted.
 *
 * Files are not trusted: every offset, count and size is checked before memory is asked for, and what is damaged, cut
 * short or not supported gives one sentence and nothing else.
 */
#ifndef MODEL_MODEL_H
#define MODEL_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    MODEL_TRIANGLES_MAX = 1 << 26, /**< and as many vertices */
    MODEL_ERROR_SIZE = 256
};

/** How nodes are placed in the world. */
typedef enum model_transforms {
    MODEL_EXACT = 0, /**< matrices multiplied to 2^-100, each world coordinate rounded once to double */
    MODEL_BINARY32,  /**< every product and sum in binary32, as engines have it: parent times local, columns in turn */
    MODEL_TRANSFORMS_COUNT
} model_transforms;

/** Triangles that share a node, a mesh and a material. Names are "" where the file has none. */
typedef struct model_surface {
    const char *node, *mesh, *material;
    bool two_sided, blended;
} model_surface;

/** A camera of the file, in the world. */
typedef struct model_camera {
    const char *name; /**< of its node, else its own */
    bool ortho;
    double eye[3], ahead[3], up[3]; /**< the directions have length 1 */
    double fov_y;                   /**< degrees; of a perspective one */
    double znear, zfar;             /**< zfar INFINITY where the file has none */
} model_camera;

/** Counts of what was left out or stands still. */
typedef struct model_notes {
    size_t skinned, morphed; /**< nodes whose mesh is */
    size_t animated;         /**< nodes that an animation moves */
    size_t lines;            /**< pieces of meshes that are points or lines */
} model_notes;

typedef struct model {
    size_t vertices, triangles, surfaces, cameras;
    double metres;           /**< in a unit of the coordinates; 0 where the file does not say */
    double (*position)[3];   /**< units, finite */
    uint32_t (*triangle)[3]; /**< of `position`, counter-clockwise seen from the front */
    uint32_t *of;            /**< the surface of each triangle */
    model_surface *surface;
    model_camera *camera;
    model_notes notes;
    struct model_names *names; /**< what the names point into */
} model;

/** Options of reading a model. */
typedef struct model_asked {
    model_transforms transforms;
} model_asked;

/** Why a model was refused. */
typedef struct model_error {
    bool unreadable;             /**< the system could not open or read a file; otherwise its content is at fault */
    char text[MODEL_ERROR_SIZE]; /**< one sentence without the path */
} model_error;

/**
 * Reads a file. glTF is told from its first bytes or its name, OBJ from its name; any other name that ends in a kind is
 * left to libassimp, which is opened then. *out is untouched on failure.
 */
bool model_read(const char *path, const model_asked *asked, model *out, model_error *error);

/** The same from memory; `obj` says that it is OBJ. Files beside it are refused where `folder` is null. */
bool model_parse(const void *bytes, size_t size, bool obj, const char *folder, const model_asked *asked, model *out,
                 model_error *error);

/** Multiplies all lengths, each rounded once. @param factor  positive */
void model_scale(model *m, double factor);

void model_free(model *m);

/** The box of the triangles, scene units: vertices that none of them uses do not count. All 0 where there are none. */
typedef struct model_box {
    double lo[3], hi[3];
} model_box;

model_box model_box_of(const model *m);

double model_box_diagonal(const model_box *box);

#endif
