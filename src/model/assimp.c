/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Every other kind of model, by libassimp: IFC2X3, FBX, Collada, STL, PLY and more. It holds coordinates and matrices
 * of nodes in binary32, whatever the file has; matrices are multiplied here, as those of glTF are. Vertices are neither
 * joined nor moved. What it says is not trusted: a count or an index may be anything.
 *
 * Units: IFC and Collada come in metres, y up; FBX says its unit and its axes and is turned into that. The others say
 * nothing.
 */
#include "model/source.h"

#if __has_include(<assimp/cimport.h>)

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <math.h>
#include <search.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "model/sandbox.h"
#include "model/transform.h"
#include "system/dynload.h"

/* The functions of the library that are called. */
#define FUNCTIONS(X)                                                                                                   \
    X(aiImportFileFromMemory)                                                                                          \
    X(aiReleaseImport)                                                                                                 \
    X(aiGetErrorString)                                                                                                \
    X(aiIsExtensionSupported)                                                                                          \
    X(aiGetMaterialString)                                                                                             \
    X(aiGetMaterialFloatArray)                                                                                         \
    X(aiGetMaterialIntegerArray)
DYNLOAD_FUNCTIONS(FUNCTIONS)

enum { DEPTH_MAX = 256 /* of nodes within nodes */ };

/* Nodes of one name that place one mesh are one surface: the rafters of a roof, the bolts of an engine. */
typedef struct placed {
    unsigned mesh;
    const char *node;
    uint32_t surface;
} placed;

typedef struct reading {
    functions call;
    void *known; /* tree of placed */
    model_source *source;
    const struct aiScene *scene;
} reading;

static int compare(const void *one, const void *other) {
    const placed *a = one, *b = other;
    return a->mesh != b->mesh ? (a->mesh < b->mesh ? -1 : 1) : strcmp(a->node, b->node);
}

/* ---- Meshes ------------------------------------------------------------------------------------------------------ */

static model_surface surface_of(const reading *r, const struct aiNode *node, const struct aiMesh *mesh) {
    model_surface s = {.node = model_keep_name(r->source, node->mName.data),
                       .mesh = model_keep_name(r->source, mesh->mName.data),
                       .material = ""};
    if (mesh->mMaterialIndex >= r->scene->mNumMaterials)
        return s;
    const struct aiMaterial *material = r->scene->mMaterials[mesh->mMaterialIndex];
    struct aiString name;
    ai_real opacity;
    int two_sided;
    if (r->call.aiGetMaterialString(material, AI_MATKEY_NAME, &name) == AI_SUCCESS)
        s.material = model_keep_name(r->source, name.data);
    if (r->call.aiGetMaterialFloatArray(material, AI_MATKEY_OPACITY, &opacity, NULL) == AI_SUCCESS)
        s.blended = opacity < (ai_real)1;
    if (r->call.aiGetMaterialIntegerArray(material, AI_MATKEY_TWOSIDED, &two_sided, NULL) == AI_SUCCESS)
        s.two_sided = two_sided != 0;
    return s;
}

static bool add_surface(reading *r, const struct aiNode *node, unsigned mesh, uint32_t *surface) {
    placed *p = malloc(sizeof *p);
    if (p == NULL)
        return model_fail(r->source, "there is no memory for it");
    *p = (placed){.mesh = mesh, .node = node->mName.data};
    placed **found = tsearch(p, &r->known, compare);
    if (found != NULL && *found != p) {
        *surface = (*found)->surface;
        free(p);
        return true;
    }
    const model_surface made = surface_of(r, node, r->scene->mMeshes[mesh]);
    if (found == NULL) {
        free(p);
        return model_fail(r->source, "there is no memory for it");
    }
    const bool added = model_add_surface(r->source, &made, &p->surface);
    *surface = p->surface;
    return added;
}

static bool add_vertices(const reading *r, const struct aiMesh *mesh, const transform *world) {
    model *m = r->source->out;
    if (!model_room(r->source, mesh->mNumVertices))
        return false;
    for (unsigned i = 0; i < mesh->mNumVertices; i++) {
        const struct aiVector3D *v = &mesh->mVertices[i];
        const double from[3] = {(double)v->x, (double)v->y, (double)v->z};
        double *to = m->position[m->vertices];
        transform_point(world, from, to);
        if (!isfinite(to[0] + to[1] + to[2]))
            return model_fail(r->source, "mesh '%.60s': a coordinate is not a finite number", mesh->mName.data);
        m->vertices++;
    }
    return true;
}

static bool add_mesh(reading *r, const struct aiNode *node, unsigned index, const transform *world) {
    const struct aiMesh *mesh = r->scene->mMeshes[index];
    const size_t first = r->source->out->vertices;
    const bool mirrored = transform_mirrors(world);
    uint32_t surface = 0;
    r->source->out->notes.skinned += mesh->mNumBones > 0;
    r->source->out->notes.morphed += mesh->mNumAnimMeshes > 0;
    if (mesh->mVertices == NULL || mesh->mFaces == NULL)
        return true;
    if (!add_vertices(r, mesh, world) || !add_surface(r, node, index, &surface))
        return false;
    bool lines = false;
    for (unsigned i = 0; i < mesh->mNumFaces; i++) {
        const struct aiFace *face = &mesh->mFaces[i];
        uint32_t corner[3];
        if (face->mNumIndices != 3) {
            lines = true;
            continue;
        }
        for (int k = 0; k < 3; k++) {
            if (face->mIndices[k] >= mesh->mNumVertices)
                return model_fail(r->source, "mesh '%.60s' has vertex %u of %u", mesh->mName.data, face->mIndices[k],
                                  mesh->mNumVertices);
            corner[mirrored && k > 0 ? 3 - k : k] = (uint32_t)(first + face->mIndices[k]);
        }
        if (!model_add_triangle(r->source, corner, surface))
            return false;
    }
    r->source->out->notes.lines += lines;
    return true;
}

/* ---- Nodes ------------------------------------------------------------------------------------------------------- */

static transform transform_of(const reading *r, const struct aiMatrix4x4 *m) {
    const double columns[16] = {
        (double)m->a1, (double)m->b1, (double)m->c1, 0, (double)m->a2, (double)m->b2, (double)m->c2, 0,
        (double)m->a3, (double)m->b3, (double)m->c3, 0, (double)m->a4, (double)m->b4, (double)m->c4, 1};
    return transform_of_matrix(r->source->asked.transforms, columns);
}

static bool add_node(reading *r, const struct aiNode *node, const transform *outer, int depth) {
    const transform local = transform_of(r, &node->mTransformation), world = transform_times(outer, &local);
    if (depth == DEPTH_MAX)
        return model_fail(r->source, "has more than %d nodes within each other", DEPTH_MAX);
    if (!transform_finite(&world))
        return model_fail(r->source, "node '%.60s' is placed at no finite place", node->mName.data);
    for (unsigned i = 0; i < node->mNumMeshes; i++) {
        if (node->mMeshes[i] >= r->scene->mNumMeshes)
            return model_fail(r->source, "node '%.60s' has mesh %u of %u", node->mName.data, node->mMeshes[i],
                              r->scene->mNumMeshes);
        if (!add_mesh(r, node, node->mMeshes[i], &world))
            return false;
    }
    for (unsigned i = 0; i < node->mNumChildren; i++)
        if (!add_node(r, node->mChildren[i], &world, depth + 1))
            return false;
    return true;
}

/* As qsort() wants it. */
static int by_name(const void *one, const void *other) {
    return strcmp(*(const char *const *)one, *(const char *const *)other);
}

/* Nodes are known by their names. */
static bool count_animated(const reading *r) {
    size_t count = 0, at = 0;
    for (unsigned i = 0; i < r->scene->mNumAnimations; i++)
        count += r->scene->mAnimations[i]->mNumChannels;
    const char **names = malloc((count + 1) * sizeof *names);
    if (names == NULL)
        return model_fail(r->source, "there is no memory for it");
    for (unsigned i = 0; i < r->scene->mNumAnimations; i++)
        for (unsigned k = 0; k < r->scene->mAnimations[i]->mNumChannels; k++)
            names[at++] = r->scene->mAnimations[i]->mChannels[k]->mNodeName.data;
    qsort(names, count, sizeof *names, by_name);
    for (size_t i = 0; i < count; i++)
        r->source->out->notes.animated += i == 0 || strcmp(names[i], names[i - 1]) != 0;
    free(names);
    return true;
}

/* ---- Units and axes ---------------------------------------------------------------------------------------------- */

/* A number that a file gives of itself by a name; `without` where it gives none. */
static double said(const struct aiScene *scene, const char *name, double without) {
    const struct aiMetadata *all = scene->mMetaData;
    for (unsigned i = 0; all != NULL && i < all->mNumProperties; i++) {
        const struct aiMetadataEntry *e = &all->mValues[i];
        if (strcmp(all->mKeys[i].data, name) != 0 || e->mData == NULL)
            continue;
        return e->mType == AI_DOUBLE  ? *(const double *)e->mData
               : e->mType == AI_FLOAT ? (double)*(const float *)e->mData
               : e->mType == AI_INT32 ? (double)*(const int32_t *)e->mData
                                      : without;
    }
    return without;
}

/*
 * FBX says which of its axes points to the right, upwards and to the one who looks, and how many centimetres its unit
 * has. Where the three are not different ones, upwards alone counts, and the others follow by a turn.
 */
static bool root_of(const struct aiScene *scene, double root[16]) {
    static const char *const names[3][2] = {
        {"CoordAxis", "CoordAxisSign"}, {"UpAxis", "UpAxisSign"}, {"FrontAxis", "FrontAxisSign"}};
    const double unit = said(scene, "UnitScaleFactor", 0.0) / 100.0;
    double sign[3];
    int axis[3];
    for (int k = 0; k < 3; k++) {
        const double at = said(scene, names[k][0], k);
        axis[k] = at == 0.0 || at == 1.0 || at == 2.0 ? (int)at : k;
        sign[k] = said(scene, names[k][1], 1.0) < 0.0 ? -1.0 : 1.0;
    }
    if (axis[0] == axis[1] || axis[1] == axis[2] || axis[2] == axis[0]) {
        axis[2] = (axis[1] + 1) % 3;
        axis[0] = (axis[1] + 2) % 3;
        sign[0] = 1.0;
        sign[2] = sign[1];
    }
    memset(root, 0, 16 * sizeof *root);
    for (int k = 0; k < 3; k++)
        root[4 * axis[k] + k] = sign[k] * unit;
    root[15] = 1.0;
    return unit > 0.0 && isfinite(unit);
}

/* ---- Files ------------------------------------------------------------------------------------------------------- */

static bool read_scene(reading *r, const char *extension) {
    static const char *const in_metres[] = {".ifc", ".ifczip", ".dae", NULL};
    transform root = transform_identity(r->source->asked.transforms);
    double columns[16];
    model *m = r->source->out;
    for (size_t i = 0; in_metres[i] != NULL; i++)
        if (strcasecmp(extension, in_metres[i]) == 0)
            m->metres = 1.0;
    if (root_of(r->scene, columns)) {
        root = transform_of_matrix(r->source->asked.transforms, columns);
        m->metres = 1.0;
    }
    if (r->scene->mRootNode == NULL || r->scene->mNumMeshes == 0)
        return model_fail(r->source, "has no triangles");
    return add_node(r, r->scene->mRootNode, &root, 0) && count_animated(r) &&
           (m->triangles > 0 || model_fail(r->source, "has no triangles"));
}

static bool read_by_library(model_source *s, const char *extension) {
    static const library assimp = {"this kind of model", {"libassimp.so.5", NULL}, "libassimp5", symbols};
    reading r = {.source = s};
    char error[DYNLOAD_ERROR_SIZE];
    if (!dynload_open(&assimp, r.call.all, error))
        return model_fail(s, "%s", error);
    if (!r.call.aiIsExtensionSupported(extension))
        return model_fail(s, "must be glTF, OBJ or a kind that libassimp reads, got '%.20s'", extension);
    if (s->file.size == 0 || s->file.size > UINT32_MAX)
        return model_fail(s, s->file.size == 0 ? "is empty" : "is larger than 4 GiB");
    r.scene = r.call.aiImportFileFromMemory((const char *)s->file.at, (unsigned)s->file.size, aiProcess_Triangulate,
                                            extension + 1);
    if (r.scene == NULL) {
        const char *said = r.call.aiGetErrorString();
        return model_fail(s, "libassimp does not read it: %.150s", said[0] != '\0' ? said : "it says no more");
    }
    const bool read = read_scene(&r, extension);
    while (r.known != NULL) {
        placed *first = *(placed **)r.known;
        tdelete(first, &r.known, compare);
        free(first);
    }
    r.call.aiReleaseImport(r.scene);
    return read;
}

/* It has been seen to crash and to loop on damaged files. */
bool model_read_other(model_source *s, const char *extension) {
    return model_sandboxed(s, read_by_library, extension);
}

#else

bool model_read_other(model_source *s, const char *extension) {
    return model_fail(s, "'%.20s' is read by libassimp, whose headers were not there when this was built", extension);
}

#endif
