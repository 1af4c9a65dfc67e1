/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file gltf_write.h  A model written as binary glTF 2.0 (.glb), with some of its triangles in materials of their own.
 *
 * Each surface is a node with a mesh, under the names that it has; its triangles stand in the world as they are, each
 * coordinate rounded to the nearest binary32, with three vertices of their own and no normals, so that viewers shade
 * them flat. Materials keep name, sides and blending and are grey. Cameras keep all that model.h has of them.
 */
#ifndef MODEL_GLTF_WRITE_H
#define MODEL_GLTF_WRITE_H

#include "model/model.h"

enum { GLTF_MARKS_MAX = 4 };

/** A material that stands for a triangle's own; it is seen from both sides. */
typedef struct gltf_mark {
    const char *name;
    double colour[3]; /**< linear red, green, blue, from 0 to 1 */
} gltf_mark;

typedef struct gltf_written {
    const gltf_mark *marks; /**< at most GLTF_MARKS_MAX */
    size_t count;
    const unsigned char *mark; /**< of each triangle: 0 for none, else 1 + index of its mark */
    /** Takes bytes in order; false stops. */
    bool (*write)(void *context, const void *bytes, size_t size);
    void *context;
} gltf_written;

typedef enum gltf_status {
    GLTF_WRITTEN = 0,
    GLTF_STOPPED, /**< `write` asked for it */
    GLTF_RANGE,   /**< a coordinate is beyond binary32, or the file would be larger than 4 GiB */
    GLTF_NO_MEMORY
} gltf_status;

/** Nothing is written on GLTF_RANGE and GLTF_NO_MEMORY. Takes 5 bytes a triangle. */
gltf_status gltf_write(const model *m, const gltf_written *out);

#endif
