/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/sandbox.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "system/sandbox.h"

enum { NAME_MOST = 1 << 12 };

/* The head of the file between parent and child. */
typedef struct head {
    size_t vertices, triangles, surfaces;
    double metres;
    model_notes notes;
    char error[MODEL_ERROR_SIZE]; /* "" when it was read */
} head;

/* ---- The child --------------------------------------------------------------------------------------------------- */

static void put_name(FILE *out, const char *name) {
    const size_t whole = strlen(name), length = whole < NAME_MOST ? whole : NAME_MOST - 1;
    fwrite(&length, sizeof length, 1, out);
    fwrite(name, 1, length, out);
}

static void put_model(FILE *out, const model *m, const char *error) {
    head h = {.vertices = m->vertices,
              .triangles = m->triangles,
              .surfaces = m->surfaces,
              .metres = m->metres,
              .notes = m->notes};
    snprintf(h.error, sizeof h.error, "%s", error);
    fwrite(&h, sizeof h, 1, out);
    if (h.error[0] != '\0')
        return;
    fwrite(m->position, sizeof *m->position, m->vertices, out);
    for (size_t i = 0; i < m->surfaces; i++) {
        const model_surface *s = &m->surface[i];
        const bool flags[2] = {s->two_sided, s->blended};
        fwrite(flags, sizeof flags, 1, out);
        put_name(out, s->node);
        put_name(out, s->mesh);
        put_name(out, s->material);
    }
    fwrite(m->triangle, sizeof *m->triangle, m->triangles, out);
    fwrite(m->of, sizeof *m->of, m->triangles, out);
}

/* The task of the child. */
typedef struct reading {
    const model_source *source;
    bool (*read)(model_source *, const char *);
    const char *extension;
} reading;

static bool read_apart(void *of, FILE *out) {
    const reading *r = of;
    model made = {0};
    model_error error = {0};
    model_source own = *r->source;
    own.out = &made;
    own.error = &error;
    const bool done = r->read(&own, r->extension);
    if (!done && error.text[0] == '\0')
        snprintf(error.text, sizeof error.text, "there is no memory for it");
    put_model(out, &made, done ? "" : error.text);
    return true;
}

/* ---- The parent -------------------------------------------------------------------------------------------------- */

static bool lost(model_source *s) {
    return model_fail(s, "could not be read: what libassimp made of it is damaged");
}

static const char *take_name(model_source *s, FILE *in) {
    char name[NAME_MOST];
    size_t length;
    if (fread(&length, sizeof length, 1, in) != 1 || length >= NAME_MOST || fread(name, 1, length, in) != length)
        return NULL;
    name[length] = '\0';
    return model_keep_name(s, name);
}

static bool take_vertices(model_source *s, FILE *in, size_t count) {
    model *m = s->out;
    if (count > MODEL_TRIANGLES_MAX || !model_room(s, count) ||
        fread(m->position, sizeof *m->position, count, in) != count)
        return false;
    for (size_t i = 0; i < 3 * count; i++)
        if (!isfinite(m->position[i / 3][i % 3]))
            return false;
    m->vertices = count;
    return true;
}

static bool take_surfaces(model_source *s, FILE *in, size_t count) {
    for (size_t i = 0; i < count; i++) {
        unsigned char flags[2];
        uint32_t index;
        if (fread(flags, sizeof flags, 1, in) != 1)
            return false;
        const char *node = take_name(s, in), *mesh = take_name(s, in), *material = take_name(s, in);
        const model_surface made = {node, mesh, material, flags[0] != 0, flags[1] != 0};
        if (!model_add_surface(s, &made, &index))
            return false;
    }
    return true;
}

static bool take_triangles(model_source *s, FILE *in, size_t count) {
    model *m = s->out;
    for (size_t i = 0; i < count; i++) {
        uint32_t corner[3];
        if (fread(corner, sizeof corner, 1, in) != 1 || !model_add_triangle(s, corner, 0))
            return false;
    }
    if (fread(m->of, sizeof *m->of, count, in) != count)
        return false;
    for (size_t i = 0; i < count; i++)
        if (m->of[i] >= m->surfaces)
            return false;
    return true;
}

static bool take_model(model_source *s, FILE *in) {
    head h;
    if (fread(&h, sizeof h, 1, in) != 1)
        return lost(s);
    h.error[sizeof h.error - 1] = '\0';
    if (h.error[0] != '\0')
        return model_fail(s, "%s", h.error);
    s->out->metres = h.metres;
    s->out->notes = h.notes;
    return (take_vertices(s, in, h.vertices) && take_surfaces(s, in, h.surfaces) &&
            take_triangles(s, in, h.triangles)) ||
           lost(s);
}

bool model_sandboxed(model_source *s, bool (*read)(model_source *s, const char *extension), const char *extension) {
    reading r = {s, read, extension};
    FILE *between;
    const sandbox_end end = sandbox_run(read_apart, &r, (sandbox_limits){.processor = SANDBOX_SECONDS}, &between);
    bool good = false;
    if (end == SANDBOX_NO_FILE)
        model_fail(s, "needs a file for a while, which cannot be made: %s", strerror(errno));
    else if (end == SANDBOX_NO_PROCESS)
        model_fail(s, "needs a process of its own, which cannot be made: %s", strerror(errno));
    else if (end == SANDBOX_ENDLESS)
        model_fail(s, "could not be read: libassimp does not come to an end in %d s", SANDBOX_SECONDS);
    else if (end == SANDBOX_BROKEN)
        model_fail(s, "could not be read: libassimp broke down");
    else
        good = take_model(s, between);
    sandbox_close(between);
    return good;
}
