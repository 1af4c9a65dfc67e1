/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/source.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "system/input.h"

/* ---- Names: a chain of blocks that stay where they are ----------------------------------------------------------- */

typedef struct model_names {
    struct model_names *next;
    char text[];
} model_names;

const char *model_keep_name(model_source *s, const char *name) {
    if (name == NULL || name[0] == '\0')
        return "";
    const size_t size = strlen(name) + 1;
    model_names *block = malloc(sizeof *block + size);
    if (block == NULL) {
        model_fail(s, "there is no memory for its names");
        return NULL;
    }
    char *to = block->text;
    while (*name != '\0') {
        const size_t length = text_character(name);
        memcpy(to, length > 0 ? name : "?", length > 0 ? length : 1);
        to += length > 0 ? length : 1;
        name += length > 0 ? length : 1;
    }
    *to = '\0';
    block->next = s->out->names;
    s->out->names = block;
    return block->text;
}

/* ---- What grows -------------------------------------------------------------------------------------------------- */

bool model_fail(model_source *s, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    if (s->error->text[0] == '\0')
        vsnprintf(s->error->text, sizeof s->error->text, format, arguments);
    va_end(arguments);
    for (char *c = s->error->text; *c != '\0'; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = '?';
    return false;
}

bool model_grow(model_source *s, void **array, size_t *room, size_t count, size_t more, size_t size) {
    if (more <= *room - count)
        return true;
    size_t wanted = *room + *room / 2;
    wanted = wanted - count < more ? count + more : wanted;
    void *grown = realloc(*array, wanted * size);
    if (grown == NULL)
        return model_fail(s, "there is no memory for it");
    *array = grown;
    *room = wanted;
    return true;
}

bool model_room(model_source *s, size_t more) {
    model *m = s->out;
    if (more > MODEL_TRIANGLES_MAX - m->vertices)
        return model_fail(s, "has more than %d vertices", MODEL_TRIANGLES_MAX);
    return model_grow(s, (void **)&m->position, &s->room[0], m->vertices, more, sizeof *m->position);
}

bool model_add_triangle(model_source *s, const uint32_t corner[3], uint32_t surface) {
    model *m = s->out;
    for (int k = 0; k < 3; k++)
        if (corner[k] >= m->vertices)
            return model_fail(s, "a triangle has vertex %lu of %zu", (unsigned long)corner[k], m->vertices);
    if (m->triangles == MODEL_TRIANGLES_MAX)
        return model_fail(s, "has more than %d triangles", MODEL_TRIANGLES_MAX);
    if (!model_grow(s, (void **)&m->triangle, &s->room[1], m->triangles, 1, sizeof *m->triangle) ||
        !model_grow(s, (void **)&m->of, &s->room[2], m->triangles, 1, sizeof *m->of))
        return false;
    memcpy(m->triangle[m->triangles], corner, sizeof *m->triangle);
    m->of[m->triangles++] = surface;
    return true;
}

bool model_add_surface(model_source *s, const model_surface *row, uint32_t *index) {
    model *m = s->out;
    if (row->node == NULL || row->mesh == NULL || row->material == NULL)
        return false;
    if (m->surfaces == MODEL_TRIANGLES_MAX)
        return model_fail(s, "has more than %d surfaces", MODEL_TRIANGLES_MAX);
    if (!model_grow(s, (void **)&m->surface, &s->room[3], m->surfaces, 1, sizeof *m->surface))
        return false;
    *index = (uint32_t)m->surfaces;
    m->surface[m->surfaces++] = *row;
    return true;
}

bool model_add_camera(model_source *s, const model_camera *row) {
    model *m = s->out;
    if (row->name == NULL || !model_grow(s, (void **)&m->camera, &s->room[4], m->cameras, 1, sizeof *m->camera))
        return false;
    m->camera[m->cameras++] = *row;
    return true;
}

void model_free(model *m) {
    for (model_names *n = m->names, *next; n != NULL; n = next) {
        next = n->next;
        free(n);
    }
    free(m->position);
    free(m->triangle);
    free(m->of);
    free(m->surface);
    free(m->camera);
    *m = (model){0};
}

/* ---- Files ------------------------------------------------------------------------------------------------------- */

static bool unreadable(model_error *error) {
    error->unreadable = true;
    snprintf(error->text, sizeof error->text, "%s", strerror(errno));
    return false;
}

static bool read_stream(FILE *in, file_bytes *out) {
    enum { FIRST = 1 << 16, LARGEST = 1 << 30 }; /* bytes: what has no end must have one */
    size_t room = 0;
    *out = (file_bytes){0};
    for (;;) {
        if (out->size + 1 >= room) {
            room = room == 0 ? FIRST : 2 * room;
            unsigned char *grown = realloc(out->at, room);
            if (grown == NULL)
                break;
            out->at = grown;
        }
        const size_t got = fread(out->at + out->size, 1, room - 1 - out->size, in);
        out->size += got;
        if (got == 0 || out->size > LARGEST)
            break;
    }
    if (out->at != NULL && !ferror(in) && feof(in)) {
        out->at[out->size] = '\0';
        return true;
    }
    const int reason = out->size > LARGEST ? EFBIG : ferror(in) && errno != 0 ? errno : ENOMEM;
    free(out->at);
    *out = (file_bytes){0};
    errno = reason;
    return false;
}

bool model_file_read(const char *path, file_bytes *out, model_error *error) {
    FILE *in = input_open(path);
    if (in == NULL)
        return unreadable(error);
    const bool read = read_stream(in, out);
    input_close(in);
    return read || unreadable(error);
}

/* A relative name without "..": a model from anywhere must not make us open anything. */
static bool is_beside(const char *name) {
    if (name[0] == '/' || name[0] == '\0' || strchr(name, '\\') != NULL || strchr(name, ':') != NULL)
        return false;
    for (const char *at = name; at != NULL; at = strchr(at, '/'), at = at == NULL ? NULL : at + 1)
        if (strncmp(at, "..", 2) == 0 && (at[2] == '/' || at[2] == '\0'))
            return false;
    return true;
}

bool model_file_beside(model_source *s, const char *name, file_bytes *out) {
    char path[4096];
    if (s->folder == NULL)
        return model_fail(s, "names the file '%.150s', which cannot be beside it", name);
    if (!is_beside(name))
        return model_fail(s, "names the file '%.150s', which is not in its folder", name);
    if ((size_t)snprintf(path, sizeof path, "%s%s", s->folder, name) >= sizeof path)
        return model_fail(s, "names a file whose path is too long");
    model_error error = {0};
    if (model_file_read(path, out, &error))
        return true;
    s->error->unreadable = true;
    return model_fail(s, "its file '%.150s': %s", name, error.text);
}
