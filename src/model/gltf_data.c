/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/gltf_data.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/bits.h"

enum { FLOAT = 5126 };

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

/* A whole number from 0 on, or `otherwise` where it is missing. */
static bool whole(gltf *g, const json_t *object, const char *key, long long otherwise, long long *out) {
    const json_t *value = json_object_get(object, key);
    const double number = json_is_number(value) ? json_number_value(value) : -1.0;
    *out = otherwise;
    if (value == NULL && otherwise >= -1)
        return true;
    if (!(number >= 0.0 && number <= 0x1p53 && number == (double)(long long)number))
        return model_fail(g->source, "glTF: %s must be a whole number", key);
    *out = (long long)number;
    return true;
}

bool gltf_index(gltf *g, const json_t *object, const char *key, size_t count, long long otherwise, long long *out) {
    if (!whole(g, object, key, otherwise, out))
        return false;
    if (*out >= 0 && (size_t)*out >= count)
        return model_fail(g->source, "glTF: %s is %lld, and there are %zu", key, *out, count);
    return true;
}

const json_t *gltf_rows(const gltf *g, const char *key) {
    return json_object_get(g->root, key);
}

/* ---- Names, each kept once ----------------------------------------------------------------------------------------
 */

static const char *const named[GLTF_NAMED] = {"nodes", "meshes", "materials", "cameras"};

const char *gltf_name(gltf *g, gltf_named kind, long long index) {
    if (index < 0)
        return "";
    const char **kept = &g->names[kind][index];
    const json_t *row = json_array_get(gltf_rows(g, named[kind]), (size_t)index);
    if (*kept == NULL)
        *kept = model_keep_name(g->source, json_string_value(json_object_get(row, "name")));
    return *kept;
}

/* ---- Buffers ----------------------------------------------------------------------------------------------------- */

static int base64(char c) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = c == '\0' ? NULL : strchr(digits, c);
    return at == NULL ? -1 : (int)(at - digits);
}

static bool decode(gltf *g, const char *text, file_bytes *out) {
    const size_t length = strlen(text);
    unsigned bits = 0, held = 0;
    *out = (file_bytes){malloc(length / 4 * 3 + 4), 0};
    if (out->at == NULL)
        return model_fail(g->source, "there is no memory for it");
    for (size_t i = 0; i < length && text[i] != '='; i++) {
        const int digit = base64(text[i]);
        if (digit < 0)
            return model_fail(g->source, "glTF: the base64 of a buffer has a character that is none");
        bits = bits << 6 | (unsigned)digit;
        held += 6;
        if (held >= 8) {
            held -= 8;
            out->at[out->size++] = (unsigned char)(bits >> held & 0xFF);
        }
    }
    return true;
}

/* %20 and the like, in place. */
static void unescape(char *text) {
    char *to = text;
    for (const char *at = text; *at != '\0'; at++) {
        char hex[3] = {at[0] == '%' ? at[1] : '\0', at[0] == '%' && at[1] != '\0' ? at[2] : '\0', '\0'};
        char *end;
        const long code = strtol(hex, &end, 16);
        const bool escaped = end == hex + 2 && code > 0;
        *to++ = escaped ? (char)code : *at;
        at += escaped ? 2 : 0;
    }
    *to = '\0';
}

static bool load(gltf *g, const json_t *row, size_t i) {
    const char *uri = json_string_value(json_object_get(row, "uri"));
    file_bytes *out = &g->buffer[i];
    long long size;
    if (!whole(g, row, "byteLength", -2, &size))
        return false;
    if (uri == NULL) {
        *out = i == 0 ? g->chunk : (file_bytes){0};
    } else if (strncmp(uri, "data:", 5) == 0) {
        const char *comma = strstr(uri, ";base64,");
        if (comma == NULL)
            return model_fail(g->source, "glTF: buffer %zu has a data URI that is not base64", i);
        if (!decode(g, comma + 8, out))
            return false;
    } else {
        char *name = strdup(uri);
        if (name == NULL)
            return model_fail(g->source, "there is no memory for it");
        unescape(name);
        const bool read = model_file_beside(g->source, name, out);
        free(name);
        if (!read)
            return false;
    }
    if ((size_t)size > out->size)
        return model_fail(g->source, "glTF: cut short: buffer %zu has %zu bytes of %lld", i, out->size, size);
    g->bytes += out->size;
    return true;
}

bool gltf_load(gltf *g) {
    const json_t *rows = gltf_rows(g, "buffers");
    bool room = true;
    for (int k = 0; k < GLTF_NAMED; k++) {
        g->names[k] = calloc(json_array_size(gltf_rows(g, named[k])) + 1, sizeof **g->names);
        room = room && g->names[k] != NULL;
    }
    g->buffers = json_array_size(rows);
    g->buffer = calloc(g->buffers + 1, sizeof *g->buffer);
    if (g->buffer == NULL || !room)
        return model_fail(g->source, "there is no memory for it");
    g->bytes = g->source->file.size;
    for (size_t i = 0; i < g->buffers; i++)
        if (!load(g, json_array_get(rows, i), i))
            return false;
    return true;
}

void gltf_unload(gltf *g) {
    for (size_t i = 0; g->buffer != NULL && i < g->buffers; i++)
        if (g->buffer[i].at != g->chunk.at)
            free(g->buffer[i].at);
    free(g->buffer);
    for (int k = 0; k < GLTF_NAMED; k++)
        free(g->names[k]);
}

/* ---- Accessors --------------------------------------------------------------------------------------------------- */

static const struct {
    int component;
    unsigned size;
    bool is_signed;
    double most;
} kinds[] = {{5120, 1, true, 127},    {5121, 1, false, 255},        {5122, 2, true, 32767},
             {5123, 2, false, 65535}, {5125, 4, false, 4294967295}, {FLOAT, 4, false, 1}};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

static size_t kind_of(int component) {
    size_t k = 0;
    while (k < KINDS && kinds[k].component != component)
        k++;
    return k;
}

/* Elements of `components` in a buffer view, from an offset on; all lie within the view, and the view in its buffer. */
static bool run(gltf *g, const json_t *object, int component, size_t count, int components, gltf_run *out) {
    const json_t *views = gltf_rows(g, "bufferViews");
    long long view, offset, buffer, start, length, stride;
    if (!gltf_index(g, object, "bufferView", json_array_size(views), -2, &view) ||
        !whole(g, object, "byteOffset", 0, &offset))
        return false;
    const json_t *row = json_array_get(views, (size_t)view);
    if (!gltf_index(g, row, "buffer", g->buffers, -2, &buffer) || !whole(g, row, "byteOffset", 0, &start) ||
        !whole(g, row, "byteLength", -2, &length) || !whole(g, row, "byteStride", 0, &stride))
        return false;
    const size_t size = kinds[kind_of(component)].size * (size_t)components;
    const size_t step = stride == 0 ? size : (size_t)stride;
    const file_bytes *b = &g->buffer[buffer];
    if ((size_t)start > b->size || (size_t)length > b->size - (size_t)start)
        return model_fail(g->source, "glTF: bufferView %lld reaches beyond its buffer", view);
    const size_t room = (size_t)offset > (size_t)length ? 0 : (size_t)length - (size_t)offset;
    if (count > 0 && (room < size || (count - 1) > (room - size) / step))
        return model_fail(g->source, "glTF: an accessor of %zu elements reaches beyond bufferView %lld", count, view);
    *out = (gltf_run){b->at == NULL ? NULL : b->at + start + offset, step, component};
    return true;
}

static double fetch(const gltf_run *r, size_t element, int component) {
    const size_t kind = kind_of(r->component);
    const unsigned size = kinds[kind].size;
    const unsigned char *at = r->at + element * r->stride + (size_t)component * size;
    uint32_t bits = 0;
    for (unsigned i = 0; i < size; i++)
        bits |= (uint32_t)at[i] << 8 * i;
    if (r->component == FLOAT)
        return (double)dp_float32(bits);
    const double half = ldexp(1.0, (int)(8 * size) - 1);
    return kinds[kind].is_signed && (double)bits >= half ? (double)bits - 2.0 * half : (double)bits;
}

/* The kind of numbers; `is_whole`: for indices. */
static bool read_component(gltf *g, const json_t *object, bool is_whole, int *out) {
    long long component;
    if (!whole(g, object, "componentType", -2, &component))
        return false;
    *out = component > FLOAT ? 0 : (int)component;
    const size_t kind = kind_of(*out);
    if (kind == KINDS || (is_whole && (kinds[kind].is_signed || *out == FLOAT)))
        return model_fail(g->source, "glTF: componentType %lld cannot be %s", component,
                          is_whole ? "that of indices" : "one");
    return true;
}

/* The elements that are others are in rising order. */
static bool open_sparse(gltf *g, const json_t *sparse, int component, gltf_accessor *out) {
    const json_t *indices = json_object_get(sparse, "indices");
    int index;
    long long count;
    if (!whole(g, sparse, "count", -2, &count) || !read_component(g, indices, true, &index) ||
        !run(g, indices, index, (size_t)count, 1, &out->index) ||
        !run(g, json_object_get(sparse, "values"), component, (size_t)count, out->components, &out->value))
        return false;
    double last = -1.0;
    for (size_t i = 0; i < (size_t)count; i++) {
        const double at = fetch(&out->index, i, 0);
        if (!(at > last && at < (double)out->count))
            return model_fail(g->source, "glTF: the indices of a sparse accessor must rise and be below %zu",
                              out->count);
        last = at;
    }
    out->changes = (size_t)count;
    return true;
}

bool gltf_open(gltf *g, long long index, int components, bool is_whole, gltf_accessor *out) {
    static const char *const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    const json_t *row = json_array_get(gltf_rows(g, "accessors"), (size_t)index);
    const char *type = json_string_value(json_object_get(row, "type"));
    const json_t *sparse = json_object_get(row, "sparse");
    long long count;
    int component;
    if (!whole(g, row, "count", -2, &count) || !read_component(g, row, is_whole, &component))
        return false;
    if (type == NULL || strcmp(type, types[components]) != 0)
        return model_fail(g->source, "glTF: accessor %lld must be %s", index, types[components]);
    if ((size_t)count > g->bytes) /* that many cannot be there, even where they are zeros */
        return model_fail(g->source, "glTF: accessor %lld has %lld elements, more than the file has bytes", index,
                          count);
    *out = (gltf_accessor){.count = (size_t)count,
                           .components = components,
                           .base.component = component,
                           .normalized = json_is_true(json_object_get(row, "normalized"))};
    if (json_object_get(row, "bufferView") != NULL && !run(g, row, component, out->count, components, &out->base))
        return false;
    return sparse == NULL || open_sparse(g, sparse, component, out);
}

/* Where element i stands among the others; false when it is none of them. */
static bool changed(const gltf_accessor *a, size_t i, size_t *out) {
    size_t lo = 0, hi = a->changes;
    while (lo < hi) {
        const size_t middle = lo + (hi - lo) / 2;
        if (fetch(&a->index, middle, 0) < (double)i)
            lo = middle + 1;
        else
            hi = middle;
    }
    *out = lo;
    return lo < a->changes && fetch(&a->index, lo, 0) == (double)i;
}

void gltf_get(const gltf_accessor *a, size_t i, double out[4]) {
    const gltf_run *from = &a->base;
    size_t other;
    if (a->changes > 0 && changed(a, i, &other)) {
        from = &a->value;
        i = other;
    }
    const double most = a->normalized ? kinds[kind_of(from->component)].most : 1.0;
    for (int k = 0; k < a->components; k++) {
        const double value = from->at == NULL ? 0.0 : fetch(from, i, k) / most;
        out[k] = a->normalized && value < -1.0 ? -1.0 : value;
    }
}
