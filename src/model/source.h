/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bytes that are read, and the model that grows from them: shared by the kinds of files. */
#ifndef MODEL_SOURCE_H
#define MODEL_SOURCE_H

#include "model/model.h"

/* A file in memory, with a null behind it. */
typedef struct file_bytes {
    unsigned char *at;
    size_t size;
} file_bytes;

typedef struct model_source {
    file_bytes file;
    const char *folder; /* of the files beside it, "" or ending in a slash; null: there are none */
    model_asked asked;
    model *out;
    size_t room[5]; /* of the arrays of *out: vertices, triangles, their surfaces, surfaces, cameras */
    model_error *error;
} model_source;

/* Sets the error, once; returns false. */
__attribute__((format(printf, 2, 3))) bool model_fail(model_source *s, const char *format, ...);

/* Reads a file that lies beside the model; a name that leads elsewhere is refused. free() what is in *out. */
bool model_file_beside(model_source *s, const char *name, file_bytes *out);

/* Reads a file; "-" is stdin. */
bool model_file_read(const char *path, file_bytes *out, model_error *error);

/* Makes room for `more` elements behind the `count` of an array. */
bool model_grow(model_source *s, void **array, size_t *room, size_t count, size_t more, size_t size);

/* Keeps a name; what is no UTF-8, and control characters become '?'. Null when there is no memory. */
const char *model_keep_name(model_source *s, const char *name);

/* Each adds to the model. A vertex must be finite, a triangle's corners vertices. */
bool model_room(model_source *s, size_t more); /* room for them; *s->out counts them when they are filled in */
bool model_add_triangle(model_source *s, const uint32_t corner[3], uint32_t surface);
bool model_add_surface(model_source *s, const model_surface *row, uint32_t *index);
bool model_add_camera(model_source *s, const model_camera *row);

/* The kinds. */
bool model_read_gltf(model_source *s);
bool model_read_obj(model_source *s);
bool model_read_other(model_source *s, const char *extension); /* by libassimp; ".ifc" */

#endif
