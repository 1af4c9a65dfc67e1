/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Buffers and accessors of glTF 2.0: numbers out of bytes, nothing read that is not there. */
#ifndef MODEL_GLTF_DATA_H
#define MODEL_GLTF_DATA_H

#include <jansson.h>

#include "model/source.h"

/* Kinds of things that have names. */
typedef enum gltf_named { GLTF_NODE = 0, GLTF_MESH, GLTF_MATERIAL, GLTF_CAMERA, GLTF_NAMED } gltf_named;

typedef struct gltf {
    model_source *source;
    const json_t *root;
    file_bytes chunk;   /* binary data within a .glb */
    file_bytes *buffer; /* of each index; those with a uri were allocated */
    size_t buffers, bytes;
    const char **names[GLTF_NAMED]; /* by index; null: not asked for yet */
} gltf;

/* Bytes of elements of one kind. */
typedef struct gltf_run {
    const unsigned char *at;
    size_t stride;
    int component; /* 5120 to 5126: as the format numbers them */
} gltf_run;

/* `count` elements of up to four components. */
typedef struct gltf_accessor {
    size_t count;
    int components;
    bool normalized;
    gltf_run base;  /* at null: zeros */
    size_t changes; /* of a sparse one: which elements are others, and what */
    gltf_run index, value;
} gltf_accessor;

/* Member `key` of an object as an index below `count`; `otherwise` where it is missing, -1 for none. */
bool gltf_index(gltf *g, const json_t *object, const char *key, size_t count, long long otherwise, long long *out);

/* The array `key` of the root; its size is 0 where there is none. */
const json_t *gltf_rows(const gltf *g, const char *key);

/* The name of a row, "" where it has none and for index -1; null when there is no memory. */
const char *gltf_name(gltf *g, gltf_named kind, long long index);

/* Reads all buffers: beside the file, within it, or as base64 in their uri. */
bool gltf_load(gltf *g);
void gltf_unload(gltf *g);

/* An accessor by its index, of so many components. Whole numbers where `whole`, for indices. */
bool gltf_open(gltf *g, long long index, int components, bool whole, gltf_accessor *out);

/* Element i, below count. Numbers may be NaN or infinite where they are binary32. */
void gltf_get(const gltf_accessor *a, size_t i, double out[4]);

#endif
