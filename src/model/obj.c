/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Wavefront OBJ: v, f, o, g, usemtl and mtllib, of which d and Tr alone are read; polygons are cut into triangles,
 * curves are left out. A surface is what shares its object, its group and its material.
 */
#include <math.h>
#include <search.h>
#include <stdlib.h>
#include <string.h>

#include "model/polygon.h"
#include "model/source.h"
#include "system/posix.h"

/* Names of the parts that come; "" before the first. */
typedef struct obj_names {
    const char *object, *group, *material;
} obj_names;

typedef struct obj_surface {
    obj_names names; /* first: what is compared */
    uint32_t index;
} obj_surface;

/* A material that is see-through, by its name. */
typedef struct obj_blended {
    struct obj_blended *next;
    const char *name;
} obj_blended;

typedef struct obj_reader {
    model_source *source;
    char *line; /* the one being read, cut off at its end */
    size_t number;
    obj_names names;
    void *surfaces; /* a tree of obj_surface */
    obj_surface *current;
    obj_blended *blended;
    bool in_library;  /* what mtllib names is being read: other words mean something there */
    uint32_t *corner; /* of the polygon being read */
    size_t corners, room;
} obj_reader;

typedef bool read_line(obj_reader *r, char *at);

static bool fail(obj_reader *r, const char *what) {
    return model_fail(r->source, "line %zu: %s", r->number, what);
}

/* ---- Words ------------------------------------------------------------------------------------------------------- */

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

static char *skip(char *at) {
    while (is_blank(*at))
        at++;
    return at;
}

static bool read_number(char **at, double *out) {
    char *from = skip(*at);
    *out = strtod(from, at);
    return *at != from && isfinite(*out) && (is_blank(**at) || **at == '\0');
}

/* The rest of the line, without blanks at its end. */
static const char *rest(obj_reader *r, char *at) {
    at = skip(at);
    size_t length = strlen(at);
    while (length > 0 && is_blank(at[length - 1]))
        at[--length] = '\0';
    return model_keep_name(r->source, at);
}

/* ---- Vertices and faces ------------------------------------------------------------------------------------------ */

static bool read_vertex(obj_reader *r, char *at) {
    model *m = r->source->out;
    double p[3];
    for (int k = 0; k < 3; k++)
        if (!read_number(&at, &p[k]))
            return fail(r, "a vertex needs three finite numbers");
    if (!model_room(r->source, 1))
        return false;
    memcpy(m->position[m->vertices++], p, sizeof p);
    return true;
}

static int compare(const void *one, const void *other) {
    const obj_names *a = one, *b = other;
    int order = strcmp(a->object, b->object);
    order = order != 0 ? order : strcmp(a->group, b->group);
    return order != 0 ? order : strcmp(a->material, b->material);
}

static bool is_blended(const obj_reader *r, const char *material) {
    for (const obj_blended *b = r->blended; b != NULL; b = b->next)
        if (strcmp(b->name, material) == 0)
            return true;
    return false;
}

/* The surface of the names in force. */
static bool find_surface(obj_reader *r) {
    obj_surface wanted = {.names = r->names};
    if (r->current != NULL && compare(r->current, &wanted) == 0)
        return true;
    obj_surface **found = (obj_surface **)tfind(&wanted, &r->surfaces, compare);
    if (found != NULL) {
        r->current = *found;
        return true;
    }
    const model_surface row = {.node = r->names.object[0] != '\0' ? r->names.object : r->names.group,
                               .mesh = r->names.group,
                               .material = r->names.material,
                               .blended = is_blended(r, r->names.material)};
    obj_surface *made = malloc(sizeof *made);
    if (made != NULL) {
        *made = wanted;
        if (model_add_surface(r->source, &row, &made->index) && tsearch(made, &r->surfaces, compare) != NULL) {
            r->current = made;
            return true;
        }
    }
    free(made);
    return fail(r, "there is no memory for it");
}

/* One corner: 7, 7/1, 7//2 or 7/1/2, from 1 on, or from -1 backwards. What is behind the slash is left out. */
static bool read_corner(obj_reader *r, char **at) {
    const size_t vertices = r->source->out->vertices;
    char *end;
    const long number = strtol(*at, &end, 10);
    if (end == *at || number == 0 || (number < 0 ? (size_t) - (number + 1) >= vertices : (size_t)number > vertices))
        return fail(r, "a face names a vertex that is not there");
    while (*end != '\0' && !is_blank(*end))
        end++;
    if (!model_grow(r->source, (void **)&r->corner, &r->room, r->corners, 1, sizeof *r->corner))
        return false;
    r->corner[r->corners++] = (uint32_t)(number < 0 ? vertices - (size_t)-number : (size_t)number - 1);
    *at = skip(end);
    return true;
}

static bool read_face(obj_reader *r, char *at) {
    r->corners = 0;
    at = skip(at);
    while (*at != '\0')
        if (!read_corner(r, &at))
            return false;
    if (r->corners < 3)
        return fail(r, "a face needs three corners");
    return find_surface(r) && polygon_cut(r->source, r->corner, r->corners, r->current->index);
}

/* ---- Names and materials ----------------------------------------------------------------------------------------- */

static bool read_object(obj_reader *r, char *at) {
    return (r->names.object = rest(r, at)) != NULL;
}

static bool read_group(obj_reader *r, char *at) {
    return (r->names.group = rest(r, at)) != NULL;
}

static bool read_use(obj_reader *r, char *at) {
    return (r->names.material = rest(r, at)) != NULL;
}

static bool read_lines(obj_reader *r, char *text);
static bool read_elements(obj_reader *r, char *at) {
    (void)at;
    r->source->out->notes.lines++;
    return true;
}

/* mtllib: a library that is not there is no reason to refuse triangles. */
static bool read_library(obj_reader *r, char *at) {
    const char *name = rest(r, at);
    model_error error = {0};
    model_error *kept = r->source->error;
    file_bytes file = {0};
    if (name == NULL)
        return false;
    r->source->error = &error;
    const bool there = model_file_beside(r->source, name, &file);
    r->source->error = kept;
    if (!there)
        return true;
    const obj_names names = r->names;
    const size_t number = r->number;
    r->in_library = true;
    const bool read = read_lines(r, (char *)file.at);
    r->in_library = false;
    r->names = names;
    r->number = number;
    free(file.at);
    return read;
}

static bool blend(obj_reader *r) {
    obj_blended *b = malloc(sizeof *b);
    if (b == NULL)
        return fail(r, "there is no memory for it");
    *b = (obj_blended){.next = r->blended, .name = r->names.material};
    r->blended = b;
    return true;
}

static bool read_dissolve(obj_reader *r, char *at) {
    double opaque;
    return !read_number(&at, &opaque) || opaque >= 1.0 || blend(r);
}

static bool read_transparency(obj_reader *r, char *at) {
    double clear;
    return !read_number(&at, &clear) || clear <= 0.0 || blend(r);
}

static const struct {
    const char *word;
    read_line *read;
    bool in_library;
} words[] = {{"v", read_vertex, false},   {"f", read_face, false},        {"o", read_object, false},
             {"g", read_group, false},    {"usemtl", read_use, false},    {"mtllib", read_library, false},
             {"l", read_elements, false}, {"p", read_elements, false},    {"newmtl", read_use, true},
             {"d", read_dissolve, true},  {"Tr", read_transparency, true}};

/* ---- Lines ------------------------------------------------------------------------------------------------------- */

static bool read_words(obj_reader *r, char *line) {
    char *at = skip(line);
    size_t length = 0;
    while (at[length] != '\0' && !is_blank(at[length]))
        length++;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (words[i].in_library == r->in_library && strlen(words[i].word) == length &&
            strncmp(words[i].word, at, length) == 0)
            return words[i].read(r, at + length);
    return true;
}

/* Cuts the line at a # that begins a word. */
static void cut_comment(char *line) {
    char *at = strchr(line, '#');
    while (at != NULL && at != line && !is_blank(at[-1]))
        at = strchr(at + 1, '#');
    if (at != NULL)
        *at = '\0';
}

/* Line by line; a backslash at its end joins it with the next. */
static bool read_lines(obj_reader *r, char *text) {
    r->number = 0;
    while (*text != '\0') {
        char *end = text;
        r->number++;
        for (end += strcspn(end, "\n"); end > text && *end != '\0' && end[-1] == '\\'; end += strcspn(end, "\n"))
            end[-1] = end[0] = ' ';
        char *next = *end == '\0' ? end : end + 1;
        *end = '\0';
        cut_comment(text);
        if (!read_words(r, text))
            return false;
        text = next;
    }
    return true;
}

bool model_read_obj(model_source *s) {
    obj_reader r = {.source = s, .names = {"", "", ""}};
    const locale_t point = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0); /* in any locale */
    const locale_t before = uselocale(point);
    bool read =
        strlen((const char *)s->file.at) == s->file.size || model_fail(s, "is not OBJ: it holds a null character");
    read = read && point != (locale_t)0 && read_lines(&r, (char *)s->file.at);
    if (read && s->out->triangles == 0)
        read = model_fail(s, "is not OBJ, or has no triangles");
    while (r.surfaces != NULL) {
        obj_surface *first = *(obj_surface **)r.surfaces;
        tdelete(first, &r.surfaces, compare);
        free(first);
    }
    for (obj_blended *b = r.blended, *next; b != NULL; b = next) {
        next = b->next;
        free(b);
    }
    free(r.corner);
    uselocale(before);
    if (point != (locale_t)0)
        freelocale(point);
    return read;
}
