/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/gltf_write.h"

#include <float.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER = 12, CHUNK = 8, VERTEX = 12, BATCH = 1024, KINDS = 1 + GLTF_MARKS_MAX };

/* Triangles of a surface with one mark: a primitive. */
typedef struct group {
    size_t first, count; /* in `order` */
    float lo[3], hi[3];
} group;

typedef struct writer {
    const model *m;
    const gltf_written *out;
    group *groups;                    /* of each surface, KINDS in turn */
    uint32_t *order;                  /* triangles, group by group */
    json_t *root, *materials, *index; /* index: of each material by what it is */
    bool failed;                      /* no memory */
} writer;

/* ---- Groups ------------------------------------------------------------------------------------------------------ */

static size_t group_of(const writer *w, size_t triangle) {
    return (size_t)w->m->of[triangle] * KINDS + w->out->mark[triangle];
}

static bool in_binary32(const model *m) {
    for (size_t i = 0; i < 3 * m->triangles; i++)
        for (int k = 0; k < 3; k++)
            if (!isfinite((float)m->position[m->triangle[i / 3][i % 3]][k]))
                return false;
    return true;
}

static void bound(group *g, const double place[3]) {
    for (int k = 0; k < 3; k++) {
        g->lo[k] = fminf(g->lo[k], (float)place[k]);
        g->hi[k] = fmaxf(g->hi[k], (float)place[k]);
    }
}

static bool sort_triangles(writer *w) {
    const model *m = w->m;
    const size_t count = m->surfaces * KINDS;
    w->groups = calloc(count + 1, sizeof *w->groups);
    w->order = malloc((m->triangles + 1) * sizeof *w->order);
    if (w->groups == NULL || w->order == NULL)
        return false;
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            w->groups[i].lo[k] = FLT_MAX;
            w->groups[i].hi[k] = -FLT_MAX;
        }
    for (size_t t = 0; t < m->triangles; t++)
        w->groups[group_of(w, t)].count++;
    for (size_t i = 1; i < count; i++)
        w->groups[i].first = w->groups[i - 1].first + w->groups[i - 1].count;
    for (size_t i = 0; i < count; i++)
        w->groups[i].count = 0;
    for (size_t t = 0; t < m->triangles; t++) {
        group *g = &w->groups[group_of(w, t)];
        w->order[g->first + g->count++] = (uint32_t)t;
        for (int k = 0; k < 3; k++)
            bound(g, m->position[m->triangle[t][k]]);
    }
    return true;
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

/* Takes `value`, as all below; a null one is memory that was missing. */
static void set(writer *w, json_t *object, const char *key, json_t *value) {
    if (json_object_set_new(object, key, value) != 0)
        w->failed = true;
}

/* Adds to the root's array `key`, which begins with the first. @return the index */
static json_int_t add(writer *w, const char *key, json_t *value) {
    json_t *rows = json_object_get(w->root, key);
    if (rows == NULL) {
        set(w, w->root, key, json_array());
        rows = json_object_get(w->root, key);
    }
    if (json_array_append_new(rows, value) != 0)
        w->failed = true;
    return (json_int_t)json_array_size(rows) - 1;
}

static json_t *numbers(const float *x, int count) {
    json_t *out = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(out, json_real((double)x[i]));
    return out;
}

static json_t *named(const char *name) {
    return name[0] != '\0' ? json_pack("{s:s}", "name", name) : json_object();
}

static json_t *material(const char *name, const double colour[3], double alpha, bool two_sided) {
    json_t *out = named(name);
    json_t *look = json_pack("{s:[f,f,f,f], s:f, s:f}", "baseColorFactor", colour[0], colour[1], colour[2], alpha,
                             "metallicFactor", 0.0, "roughnessFactor", 1.0);
    if (alpha < 1.0)
        json_object_set_new(out, "alphaMode", json_string("BLEND"));
    if (two_sided)
        json_object_set_new(out, "doubleSided", json_true());
    return json_object_set_new(out, "pbrMetallicRoughness", look) == 0 ? out : NULL;
}

/* The index of a material that may be there already: `key` tells them apart. */
static json_int_t material_once(writer *w, const char *key, json_t *row) {
    const json_t *known = json_object_get(w->index, key);
    if (known != NULL) {
        json_decref(row);
        return json_integer_value(known);
    }
    const json_int_t at = add(w, "materials", row);
    set(w, w->index, key, json_integer(at));
    return at;
}

static json_int_t material_of(writer *w, const model_surface *s, size_t kind) {
    static const double grey[3] = {0.6, 0.6, 0.6};
    const gltf_mark *mark = kind > 0 ? &w->out->marks[kind - 1] : NULL;
    const size_t size = strlen(s->material) + 4;
    char *key = malloc(size);
    if (key == NULL) {
        w->failed = true;
        return 0;
    }
    if (mark != NULL)
        snprintf(key, size, "%zu", kind);
    else
        snprintf(key, size, "%c%c:%s", s->two_sided ? '2' : '1', s->blended ? 'b' : 'o', s->material);
    const json_int_t at =
        material_once(w, key,
                      mark != NULL ? material(mark->name, mark->colour, 1.0, true)
                                   : material(s->material, grey, s->blended ? 0.5 : 1.0, s->two_sided));
    free(key);
    return at;
}

static json_t *primitive(writer *w, const model_surface *s, const group *g, size_t kind) {
    const json_int_t vertices = (json_int_t)(3 * g->count);
    const json_int_t accessor =
        add(w, "accessors",
            json_pack("{s:i, s:I, s:i, s:I, s:s, s:o, s:o}", "bufferView", 0, "byteOffset",
                      (json_int_t)(3 * VERTEX * g->first), "componentType", 5126, "count", vertices, "type", "VEC3",
                      "min", numbers(g->lo, 3), "max", numbers(g->hi, 3)));
    return json_pack("{s:{s:I}, s:I}", "attributes", "POSITION", accessor, "material", material_of(w, s, kind));
}

static void add_surface(writer *w, size_t i, json_t *roots) {
    const model_surface *s = &w->m->surface[i];
    json_t *primitives = json_array(), *mesh = named(s->mesh), *node = named(s->node);
    for (size_t kind = 0; kind < KINDS; kind++) {
        const group *g = &w->groups[i * KINDS + kind];
        if (g->count > 0 && json_array_append_new(primitives, primitive(w, s, g, kind)) != 0)
            w->failed = true;
    }
    if (json_array_size(primitives) == 0) {
        json_decref(primitives);
        json_decref(mesh);
        json_decref(node);
        return;
    }
    set(w, mesh, "primitives", primitives);
    set(w, node, "mesh", json_integer(add(w, "meshes", mesh)));
    json_array_append_new(roots, json_integer(add(w, "nodes", node)));
}

static void add_camera(writer *w, const model_camera *c, json_t *roots) {
    const double *a = c->ahead, *u = c->up, *e = c->eye;
    const double right[3] = {a[1] * u[2] - a[2] * u[1], a[2] * u[0] - a[0] * u[2], a[0] * u[1] - a[1] * u[0]};
    json_t *lens = json_pack("{s:f}", "znear", c->znear), *camera = named(c->name), *node = named(c->name);
    if (isfinite(c->zfar))
        set(w, lens, "zfar", json_real(c->zfar));
    if (c->ortho) {
        set(w, lens, "xmag", json_real(0.5 * c->height));
        set(w, lens, "ymag", json_real(0.5 * c->height));
    } else {
        set(w, lens, "yfov", json_real(c->fov_y * (M_PI / 180.0)));
    }
    set(w, camera, "type", json_string(c->ortho ? "orthographic" : "perspective"));
    set(w, camera, c->ortho ? "orthographic" : "perspective", lens);
    set(w, node, "camera", json_integer(add(w, "cameras", camera)));
    set(w, node, "matrix",
        json_pack("[f,f,f,f, f,f,f,f, f,f,f,f, f,f,f,f]", right[0], right[1], right[2], 0.0, u[0], u[1], u[2], 0.0,
                  -a[0], -a[1], -a[2], 0.0, e[0], e[1], e[2], 1.0));
    json_array_append_new(roots, json_integer(add(w, "nodes", node)));
}

/* The whole description as text; null when there is no memory. */
static char *describe(writer *w) {
    const size_t bytes = 3 * VERTEX * w->m->triangles;
    json_t *roots = json_array();
    w->root = json_pack("{s:{s:s, s:s}, s:i}", "asset", "version", "2.0", "generator", "depthprec", "scene", 0);
    w->index = json_object();
    for (size_t i = 0; i < w->m->surfaces; i++)
        add_surface(w, i, roots);
    for (size_t i = 0; i < w->m->cameras; i++)
        add_camera(w, &w->m->camera[i], roots);
    if (bytes > 0) {
        add(w, "buffers", json_pack("{s:I}", "byteLength", (json_int_t)bytes));
        add(w, "bufferViews",
            json_pack("{s:i, s:I, s:i, s:i}", "buffer", 0, "byteLength", (json_int_t)bytes, "byteStride", VERTEX,
                      "target", 34962));
    }
    const size_t count = json_array_size(roots);
    add(w, "scenes", count > 0 ? json_pack("{s:O}", "nodes", roots) : json_object());
    json_decref(roots);
    char *text = w->failed ? NULL : json_dumps(w->root, JSON_COMPACT);
    json_decref(w->index);
    json_decref(w->root);
    return text;
}

/* ---- Bytes ------------------------------------------------------------------------------------------------------- */

static void put(unsigned char *at, uint32_t x) {
    for (int i = 0; i < 4; i++)
        at[i] = (unsigned char)(x >> 8 * i);
}

static bool words(const gltf_written *out, const uint32_t *word, int count) {
    unsigned char bytes[HEADER];
    for (int i = 0; i < count; i++)
        put(bytes + 4 * i, word[i]);
    return out->write(out->context, bytes, (size_t)(4 * count));
}

static bool write_places(const writer *w) {
    unsigned char bytes[BATCH * 3 * VERTEX], *at = bytes;
    const model *m = w->m;
    for (size_t i = 0; i < m->triangles; i++) {
        for (int k = 0; k < 9; k++, at += 4) {
            const float x = (float)m->position[m->triangle[w->order[i]][k / 3]][k % 3];
            uint32_t bits;
            memcpy(&bits, &x, sizeof bits);
            put(at, bits);
        }
        if (at == bytes + sizeof bytes || i + 1 == m->triangles) {
            if (!w->out->write(w->out->context, bytes, (size_t)(at - bytes)))
                return false;
            at = bytes;
        }
    }
    return true;
}

static gltf_status write_chunks(const writer *w, const char *text) {
    static const char spaces[] = "   ";
    const gltf_written *out = w->out;
    const uint64_t length = strlen(text), padding = -length & 3, bytes = 3 * VERTEX * (uint64_t)w->m->triangles;
    const uint64_t total = HEADER + CHUNK + length + padding + (bytes > 0 ? CHUNK + bytes : 0);
    if (total > UINT32_MAX)
        return GLTF_RANGE;
    const uint32_t head[] = {0x46546c67, 2, (uint32_t)total}, json[] = {(uint32_t)(length + padding), 0x4e4f534a},
                   data[] = {(uint32_t)bytes, 0x004e4942};
    bool good = words(out, head, 3) && words(out, json, 2) && out->write(out->context, text, length) &&
                out->write(out->context, spaces, padding);
    if (bytes > 0)
        good = good && words(out, data, 2) && write_places(w);
    return good ? GLTF_WRITTEN : GLTF_STOPPED;
}

gltf_status gltf_write(const model *m, const gltf_written *out) {
    writer w = {.m = m, .out = out};
    if (!in_binary32(m))
        return GLTF_RANGE;
    char *text = sort_triangles(&w) ? describe(&w) : NULL;
    const gltf_status status = text != NULL ? write_chunks(&w, text) : GLTF_NO_MEMORY;
    free(text);
    free(w.groups);
    free(w.order);
    return status;
}
