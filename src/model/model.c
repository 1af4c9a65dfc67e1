/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/elementary.h"
#include "model/source.h"
#include "system/posix.h"

static bool no_memory(model_error *error) {
    snprintf(error->text, sizeof error->text, "there is no memory for it");
    return false;
}

/* The schema that a STEP file names in its header. libassimp reads the IFC of 2x3: of newer ones it loses shapes
 * without a word, where it does not break down. */
static bool check_schema(model_source *s) {
    const char *text = (const char *)s->file.at, *name = strstr(text, "FILE_SCHEMA");
    const char *quote = name != NULL && strncmp(text, "ISO-10303-21", 12) == 0 ? strchr(name, '\'') : NULL;
    if (quote == NULL || strncasecmp(quote + 1, "IFC", 3) != 0 || strncasecmp(quote + 1, "IFC2X", 5) == 0)
        return true;
    return model_fail(s,
                      "is of %.*s, and of IFC only IFC2X3 is read: make glTF of it, with IfcConvert (IfcConvert a.ifc "
                      "a.glb) or with Blender and Bonsai",
                      (int)(strcspn(quote + 1, "' \t\r\n") < 20 ? strcspn(quote + 1, "' \t\r\n") : 20), quote + 1);
}

/* A file, and what its name ends in, from the dot on; "" where it has none. */
static bool parse(file_bytes file, const char *extension, const char *folder, const model_asked *asked, model *out,
                  model_error *error) {
    model made = {0};
    model_source s = {.file = file, .folder = folder, .asked = *asked, .out = &made, .error = error};
    const size_t blanks = strspn((const char *)file.at, " \t\r\n");
    const bool gltf = memcmp(file.at, "glTF", file.size < 4 ? file.size : 4) == 0 || file.at[blanks] == '{' ||
                      strcasecmp(extension, ".gltf") == 0 || strcasecmp(extension, ".glb") == 0 || *extension == '\0';
    *error = (model_error){0};
    const bool read = strcasecmp(extension, ".obj") == 0 ? model_read_obj(&s)
                      : gltf                             ? model_read_gltf(&s)
                                                         : check_schema(&s) && model_read_other(&s, extension);
    if (read) {
        *out = made;
        return true;
    }
    model_free(&made);
    return error->text[0] == '\0' && no_memory(error);
}

bool model_parse(const void *bytes, size_t size, bool obj, const char *folder, const model_asked *asked, model *out,
                 model_error *error) {
    file_bytes file = {malloc(size + 1), size};
    *error = (model_error){0};
    if (file.at == NULL)
        return no_memory(error);
    memcpy(file.at, bytes, size);
    file.at[size] = '\0';
    const bool parsed = parse(file, obj ? ".obj" : "", folder, asked, out, error);
    free(file.at);
    return parsed;
}

bool model_read(const char *path, const model_asked *asked, model *out, model_error *error) {
    const char *name = path_name(path), *dot = strrchr(name, '.');
    char *folder = strndup(path, (size_t)(name - path));
    file_bytes file;
    *error = (model_error){0};
    if (folder == NULL)
        return no_memory(error);
    bool read = model_file_read(path, &file, error);
    if (read) {
        read = parse(file, dot != NULL ? dot : "", folder, asked, out, error);
        free(file.at);
    }
    free(folder);
    return read;
}

void model_scale(model *m, double factor) {
    if (factor == 1.0)
        return;
    for (size_t i = 0; i < m->vertices; i++)
        for (int k = 0; k < 3; k++)
            m->position[i][k] *= factor;
    for (size_t i = 0; i < m->cameras; i++) {
        model_camera *c = &m->camera[i];
        for (int k = 0; k < 3; k++)
            c->eye[k] *= factor;
        c->znear *= factor;
        c->zfar *= factor;
    }
    m->metres /= factor;
}

model_box model_box_of(const model *m) {
    model_box box = {{0.0}, {0.0}};
    for (size_t i = 0; i < 3 * m->triangles; i++) {
        const double *x = m->position[m->triangle[i / 3][i % 3]];
        for (int k = 0; k < 3; k++) {
            box.lo[k] = i == 0 || x[k] < box.lo[k] ? x[k] : box.lo[k];
            box.hi[k] = i == 0 || x[k] > box.hi[k] ? x[k] : box.hi[k];
        }
    }
    return box;
}

double model_box_diagonal(const model_box *box) {
    return dp_hypot(dp_hypot(box->hi[0] - box->lo[0], box->hi[1] - box->lo[1]), box->hi[2] - box->lo[2]);
}
