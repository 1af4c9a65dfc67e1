/* SPDX-License-Identifier: GPL-3.0-or-later */
/* glTF 2.0: nodes, meshes, materials and cameras; instances of EXT_mesh_gpu_instancing, KHR_mesh_quantization. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/gltf_data.h"
#include "model/transform.h"

enum { GLB_HEADER = 12, CHUNK_HEADER = 8, CHUNK_JSON = 0x4E4F534A, CHUNK_BINARY = 0x004E4942 };
enum { TRIANGLES = 4, STRIP = 5, FAN = 6 };

/* One surface of every mesh, what its nodes share. */
typedef struct placed {
    gltf *g;
    const json_t *mesh;
    const char *node, *mesh_name;
    transform world;
    size_t *shared; /* null, or the next surface of what all instances of the node share */
} placed;

/* ---- Containers -------------------------------------------------------------------------------------------------- */

static uint32_t word(const unsigned char *at) {
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

/* The chunks of a .glb: JSON, then, it may be, binary data; others are left out. */
static bool read_chunks(gltf *g, file_bytes *json) {
    const file_bytes *file = &g->source->file;
    if (file->size < GLB_HEADER + CHUNK_HEADER || word(file->at + 8) > file->size || word(file->at + 8) < GLB_HEADER)
        return model_fail(g->source, "glTF: cut short: it has %zu bytes", file->size);
    if (word(file->at + 4) != 2)
        return model_fail(g->source, "glTF: is version %lu, and 2 is read", (unsigned long)word(file->at + 4));
    const size_t end = word(file->at + 8);
    *json = (file_bytes){0};
    for (size_t at = GLB_HEADER; at < end;) {
        if (end - at < CHUNK_HEADER || word(file->at + at) > end - at - CHUNK_HEADER)
            return model_fail(g->source, "glTF: cut short: a chunk reaches beyond its %zu bytes", end);
        const file_bytes chunk = {file->at + at + CHUNK_HEADER, word(file->at + at)};
        const uint32_t kind = word(file->at + at + 4);
        if (at == GLB_HEADER && kind == CHUNK_JSON)
            *json = chunk;
        else if (kind == CHUNK_BINARY && g->chunk.at == NULL)
            g->chunk = chunk;
        at += CHUNK_HEADER + chunk.size;
    }
    return json->at != NULL || model_fail(g->source, "glTF: its first chunk is not JSON");
}

/* Some editors put a mark of the order of bytes in front. */
static bool find_json(file_bytes *file) {
    if (file->size >= 3 && memcmp(file->at, "\xef\xbb\xbf", 3) == 0)
        *file = (file_bytes){file->at + 3, file->size - 3};
    return file->at[strspn((const char *)file->at, " \t\r\n")] == '{';
}

/* ---- What is asked of a reader ----------------------------------------------------------------------------------- */

/* Those that leave vertices where they are, or that are read. */
static bool is_known(const char *extension) {
    static const char *const known[] = {"KHR_materials_", "KHR_texture_",          "KHR_lights_",
                                        "EXT_texture_",   "KHR_mesh_quantization", "EXT_mesh_gpu_instancing",
                                        "KHR_xmp"};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strncmp(extension, known[i], strlen(known[i])) == 0)
            return true;
    return false;
}

static bool check_required(gltf *g) {
    const json_t *required = gltf_rows(g, "extensionsRequired");
    const char *version = json_string_value(json_object_get(gltf_rows(g, "asset"), "version"));
    if (version == NULL || strncmp(version, "2.", 2) != 0)
        return model_fail(g->source, "glTF: is version '%.20s', and 2 is read", version == NULL ? "" : version);
    for (size_t i = 0; i < json_array_size(required); i++) {
        const char *extension = json_string_value(json_array_get(required, i));
        if (extension == NULL || !is_known(extension))
            return model_fail(g->source, "glTF: needs %.100s, which is not read%s", extension == NULL ? "?" : extension,
                              extension != NULL && strstr(extension, "compression") != NULL
                                  ? ": unpack its meshes first, with a glTF tool"
                                  : "");
    }
    return true;
}

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

/* The vertices of a piece, where its node puts them. */
static bool place(const placed *p, const gltf_accessor *positions) {
    model *m = p->g->source->out;
    if (!model_room(p->g->source, positions->count))
        return false;
    for (size_t i = 0; i < positions->count; i++) {
        double from[4], *to = m->position[m->vertices];
        gltf_get(positions, i, from);
        transform_point(&p->world, from, to);
        if (!isfinite(to[0]) || !isfinite(to[1]) || !isfinite(to[2]))
            return model_fail(p->g->source, "glTF: vertex %zu of mesh '%.60s' is not finite", i, p->mesh_name);
        m->vertices++;
    }
    return true;
}

/* Triangle i of a strip begins at vertex i, and every other one turns the other way. */
static void corners_of(long long mode, size_t i, size_t of[3]) {
    const size_t first = mode == TRIANGLES ? 3 * i : i;
    const size_t swap = mode == STRIP && i % 2 == 1 ? 1 : 0;
    of[0] = mode == FAN ? 0 : first;
    of[1] = first + 1 + swap;
    of[2] = first + 2 - swap;
}

static bool join(const placed *p, long long mode, size_t first, size_t vertices, const gltf_accessor *indices,
                 uint32_t surface) {
    const bool mirrored = transform_mirrors(&p->world);
    const size_t corners = indices != NULL ? indices->count : vertices;
    const size_t triangles = mode == TRIANGLES ? corners / 3 : corners < 3 ? 0 : corners - 2;
    for (size_t i = 0; i < triangles; i++) {
        size_t of[3];
        uint32_t corner[3];
        corners_of(mode, i, of);
        for (int k = 0; k < 3; k++) {
            double index[4] = {(double)of[k]};
            if (indices != NULL)
                gltf_get(indices, of[k], index);
            if (!(index[0] < (double)vertices))
                return model_fail(p->g->source, "glTF: mesh '%.60s' has vertex %.0f of %zu", p->mesh_name, index[0],
                                  vertices);
            corner[mirrored && k > 0 ? 3 - k : k] = (uint32_t)(first + (size_t)index[0]);
        }
        if (!model_add_triangle(p->g->source, corner, surface))
            return false;
    }
    return true;
}

static bool add_surface(const placed *p, const json_t *primitive, uint32_t *surface) {
    gltf *g = p->g;
    const json_t *materials = gltf_rows(g, "materials");
    long long material;
    if (p->shared != NULL && (*p->shared)++ < g->source->out->surfaces) {
        *surface = (uint32_t)(*p->shared - 1);
        return true;
    }
    if (!gltf_index(g, primitive, "material", json_array_size(materials), -1, &material))
        return false;
    const json_t *row = material < 0 ? NULL : json_array_get(materials, (size_t)material);
    const char *alpha = json_string_value(json_object_get(row, "alphaMode"));
    const model_surface made = {.node = p->node,
                                .mesh = p->mesh_name,
                                .material = gltf_name(g, GLTF_MATERIAL, material),
                                .two_sided = json_is_true(json_object_get(row, "doubleSided")),
                                .blended = alpha != NULL && strcmp(alpha, "BLEND") == 0};
    return model_add_surface(g->source, &made, surface);
}

static bool add_primitive(const placed *p, const json_t *primitive) {
    gltf *g = p->g;
    const size_t accessors = json_array_size(gltf_rows(g, "accessors"));
    long long mode, position, indices;
    uint32_t surface;
    gltf_accessor at, order = {0};
    if (!gltf_index(g, primitive, "mode", FAN + 1, TRIANGLES, &mode) ||
        !gltf_index(g, json_object_get(primitive, "attributes"), "POSITION", accessors, -1, &position) ||
        !gltf_index(g, primitive, "indices", accessors, -1, &indices))
        return false;
    if (mode < TRIANGLES || position < 0) {
        g->source->out->notes.lines += mode < TRIANGLES;
        return true;
    }
    if (!gltf_open(g, position, 3, false, &at) || (indices >= 0 && !gltf_open(g, indices, 1, true, &order)) ||
        !add_surface(p, primitive, &surface))
        return false;
    const size_t first = g->source->out->vertices;
    return place(p, &at) && join(p, mode, first, at.count, indices >= 0 ? &order : NULL, surface);
}

static bool add_mesh(const placed *p) {
    const json_t *primitives = json_object_get(p->mesh, "primitives");
    for (size_t i = 0; i < json_array_size(primitives); i++)
        if (!add_primitive(p, json_array_get(primitives, i)))
            return false;
    return true;
}

/* ---- Instances --------------------------------------------------------------------------------------------------- */

static bool add_instances(const placed *p, const json_t *attributes) {
    static const struct {
        const char *name;
        int components;
    } parts[] = {{"TRANSLATION", 3}, {"ROTATION", 4}, {"SCALE", 3}};
    gltf *g = p->g;
    gltf_accessor of[3];
    bool given[3];
    const size_t first = g->source->out->surfaces;
    size_t count = 0;
    for (int k = 0; k < 3; k++) {
        long long index;
        if (!gltf_index(g, attributes, parts[k].name, json_array_size(gltf_rows(g, "accessors")), -1, &index) ||
            (index >= 0 && !gltf_open(g, index, parts[k].components, false, &of[k])))
            return false;
        given[k] = index >= 0;
        if (given[k] && count > 0 && of[k].count != count)
            return model_fail(g->source, "glTF: the instances of node '%.60s' differ in number", p->node);
        count = given[k] ? of[k].count : count;
    }
    for (size_t i = 0; i < count; i++) {
        double part[3][4] = {{0, 0, 0, 0}, {0, 0, 0, 1}, {1, 1, 1, 0}};
        for (int k = 0; k < 3; k++)
            if (given[k])
                gltf_get(&of[k], i, part[k]);
        const transform own = transform_of_parts(p->world.kind, part[0], part[1], part[2]);
        placed instance = *p;
        size_t surface = first;
        instance.shared = &surface;
        instance.world = transform_times(&p->world, &own);
        if (!add_mesh(&instance))
            return false;
    }
    return true;
}

/* ---- Cameras ----------------------------------------------------------------------------------------------------- */

static double member(const json_t *object, const char *key, double otherwise) {
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : otherwise;
}

/* It looks along -z. What its numbers allow is judged where it is used. */
static bool add_camera(gltf *g, long long node, long long index, const transform *world) {
    static const double origin[3] = {0};
    const json_t *row = json_array_get(gltf_rows(g, "cameras"), (size_t)index);
    const json_t *type = json_object_get(row, "type");
    const bool ortho = json_is_string(type) && strcmp(json_string_value(type), "orthographic") == 0;
    const json_t *lens = json_object_get(row, ortho ? "orthographic" : "perspective");
    model_camera camera = {.name = gltf_name(g, GLTF_NODE, node),
                           .ortho = ortho,
                           .fov_y = member(lens, "yfov", 0.0) * (180.0 / 3.141592653589793),
                           .znear = member(lens, "znear", 0.0),
                           .zfar = member(lens, "zfar", HUGE_VAL)};
    if (camera.name != NULL && camera.name[0] == '\0')
        camera.name = gltf_name(g, GLTF_CAMERA, index);
    transform_point(world, origin, camera.eye);
    transform_axis(world, 2, camera.ahead);
    transform_axis(world, 1, camera.up);
    for (int k = 0; k < 3; k++)
        camera.ahead[k] = -camera.ahead[k];
    return model_add_camera(g->source, &camera);
}

/* ---- Nodes ------------------------------------------------------------------------------------------------------- */

static bool read_numbers(gltf *g, const json_t *node, const char *key, size_t count, double *out) {
    const json_t *array = json_object_get(node, key);
    if (array == NULL)
        return true;
    for (size_t i = 0; i < count; i++) {
        const json_t *value = json_array_get(array, i);
        if (!json_is_number(value) || json_array_size(array) != count)
            return model_fail(g->source, "glTF: %s of a node must be %zu numbers", key, count);
        out[i] = json_number_value(value);
    }
    return true;
}

static bool local_of(gltf *g, const json_t *node, transform *out) {
    double m[16], t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    const model_transforms kind = g->source->asked.transforms;
    if (json_object_get(node, "matrix") != NULL) {
        if (!read_numbers(g, node, "matrix", 16, m))
            return false;
        *out = transform_of_matrix(kind, m);
        return true;
    }
    if (!read_numbers(g, node, "translation", 3, t) || !read_numbers(g, node, "rotation", 4, q) ||
        !read_numbers(g, node, "scale", 3, s))
        return false;
    *out = transform_of_parts(kind, t, q, s);
    return true;
}

static bool is_morphed(const json_t *mesh) {
    return json_array_size(json_object_get(json_array_get(json_object_get(mesh, "primitives"), 0), "targets")) > 0;
}

static bool add_node(gltf *g, long long index, const transform *world) {
    const json_t *node = json_array_get(gltf_rows(g, "nodes"), (size_t)index);
    const json_t *meshes = gltf_rows(g, "meshes"), *cameras = gltf_rows(g, "cameras");
    const json_t *instancing = json_object_get(json_object_get(node, "extensions"), "EXT_mesh_gpu_instancing");
    long long mesh, camera;
    if (!gltf_index(g, node, "mesh", json_array_size(meshes), -1, &mesh) ||
        !gltf_index(g, node, "camera", json_array_size(cameras), -1, &camera))
        return false;
    if (!transform_finite(world))
        return model_fail(g->source, "glTF: the place of a node is not finite");
    if (camera >= 0 && !add_camera(g, index, camera, world))
        return false;
    if (mesh < 0)
        return true;
    placed p = {.g = g,
                .mesh = json_array_get(meshes, (size_t)mesh),
                .node = gltf_name(g, GLTF_NODE, index),
                .mesh_name = gltf_name(g, GLTF_MESH, mesh),
                .world = *world};
    if (p.node == NULL || p.mesh_name == NULL)
        return false;
    g->source->out->notes.skinned += json_object_get(node, "skin") != NULL;
    g->source->out->notes.morphed += is_morphed(p.mesh);
    return instancing != NULL ? add_instances(&p, json_object_get(instancing, "attributes")) : add_mesh(&p);
}

/* ---- The tree: each node has one parent or none, so none is met twice ---------------------------------------------
 */

typedef struct tree {
    long long *parent; /* -1: none */
    long long *stack;
    transform *world;
    size_t nodes, depth;
} tree;

static bool read_parents(gltf *g, tree *t) {
    const json_t *nodes = gltf_rows(g, "nodes");
    for (size_t i = 0; i < t->nodes; i++)
        t->parent[i] = -1;
    for (size_t i = 0; i < t->nodes; i++) {
        const json_t *children = json_object_get(json_array_get(nodes, i), "children");
        for (size_t k = 0; k < json_array_size(children); k++) {
            const json_t *child = json_array_get(children, k);
            const double index = json_is_integer(child) ? (double)json_integer_value(child) : -1.0;
            if (!(index >= 0.0 && index < (double)t->nodes))
                return model_fail(g->source, "glTF: node %zu has a child that is not there", i);
            if (t->parent[(size_t)index] != -1)
                return model_fail(g->source, "glTF: node %.0f has two parents", index);
            t->parent[(size_t)index] = (long long)i;
        }
    }
    return true;
}

/* The roots of the scene that is shown, or of all nodes where the file has none. The first is put on top. */
static bool push_roots(gltf *g, tree *t) {
    const json_t *scenes = gltf_rows(g, "scenes");
    long long scene;
    if (json_array_size(scenes) == 0) {
        for (size_t i = t->nodes; i-- > 0;)
            if (t->parent[i] < 0)
                t->stack[t->depth++] = (long long)i;
        return true;
    }
    if (!gltf_index(g, g->root, "scene", json_array_size(scenes), 0, &scene))
        return false;
    const json_t *roots = json_object_get(json_array_get(scenes, (size_t)scene), "nodes");
    for (size_t k = json_array_size(roots); k-- > 0;) {
        const json_t *root = json_array_get(roots, k);
        const double index = json_is_integer(root) ? (double)json_integer_value(root) : -1.0;
        if (!(index >= 0.0 && index < (double)t->nodes) || t->parent[(size_t)index] != -1)
            return model_fail(g->source, "glTF: the scene has a root that is none");
        t->parent[(size_t)index] = -2; /* not twice */
        t->stack[t->depth++] = (long long)index;
    }
    return true;
}

static bool walk(gltf *g, tree *t) {
    const json_t *nodes = gltf_rows(g, "nodes");
    if (!read_parents(g, t) || !push_roots(g, t))
        return false;
    while (t->depth > 0) {
        const long long i = t->stack[--t->depth];
        const json_t *node = json_array_get(nodes, (size_t)i);
        transform local;
        if (!local_of(g, node, &local))
            return false;
        t->world[i] = t->parent[i] < 0 ? local : transform_times(&t->world[t->parent[i]], &local);
        if (!add_node(g, i, &t->world[i]))
            return false;
        const json_t *children = json_object_get(node, "children");
        for (size_t k = json_array_size(children); k-- > 0;)
            t->stack[t->depth++] = (long long)json_integer_value(json_array_get(children, k));
    }
    return true;
}

static bool add_nodes(gltf *g) {
    tree t = {.nodes = json_array_size(gltf_rows(g, "nodes"))};
    t.parent = calloc(t.nodes + 1, sizeof *t.parent);
    t.stack = calloc(t.nodes + 1, sizeof *t.stack);
    t.world = calloc(t.nodes + 1, sizeof *t.world);
    const bool room = t.parent != NULL && t.stack != NULL && t.world != NULL;
    const bool added = room && walk(g, &t);
    free(t.parent);
    free(t.stack);
    free(t.world);
    return added;
}

/* ---- Animations -------------------------------------------------------------------------------------------------- */

/* How many nodes are moved by some channel of an animation. */
static void count_animated(gltf *g) {
    const json_t *animations = gltf_rows(g, "animations");
    const size_t nodes = json_array_size(gltf_rows(g, "nodes"));
    bool *moved = calloc(nodes + 1, sizeof *moved);
    for (size_t i = 0; moved != NULL && i < json_array_size(animations); i++) {
        const json_t *channels = json_object_get(json_array_get(animations, i), "channels");
        for (size_t k = 0; k < json_array_size(channels); k++) {
            const json_t *target = json_object_get(json_array_get(channels, k), "target");
            const json_t *node = json_object_get(target, "node");
            const json_int_t index = json_is_integer(node) ? json_integer_value(node) : -1;
            if (index >= 0 && (size_t)index < nodes && !moved[index]) {
                moved[index] = true;
                g->source->out->notes.animated++;
            }
        }
    }
    free(moved);
}

static bool read_root(gltf *g) {
    const bool added = check_required(g) && gltf_load(g) && add_nodes(g);
    gltf_unload(g);
    if (added)
        count_animated(g);
    return added && (g->source->out->triangles > 0 || model_fail(g->source, "glTF: has no triangles"));
}

bool model_read_gltf(model_source *s) {
    gltf g = {.source = s};
    s->out->metres = 1.0;
    file_bytes json = s->file;
    json_error_t error;
    if (s->file.size >= 4 && memcmp(s->file.at, "glTF", 4) == 0) {
        if (!read_chunks(&g, &json))
            return false;
    } else if (!find_json(&json)) {
        return model_fail(s, "is neither glTF 2.0 (.glb, .gltf) nor, by its name, OBJ");
    }
    json_t *root = json_loadb((const char *)json.at, json.size, 0, &error);
    if (root == NULL)
        return model_fail(s, "glTF: line %d of its JSON: %.120s", error.line, error.text);
    g.root = root;
    const bool read = read_root(&g);
    json_decref(root);
    return read;
}
