/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Reading a model and finding what fights in it, from 1e4 to 1e7 triangles: seconds; of all threads together, and as
 * nanoseconds for each triangle and binary logarithm of their number, which hardly grow; and the most memory that the
 * process held. A city made here: blocks of a house on a piece of ground, windows before its walls, a carpet beneath
 * it, and on every fourth house a poster exactly in the wall's plane. The posters are all that fights; a wrong number
 * of them fails.
 *
 *     bench_scene [TRIANGLES]...    other sizes
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "scene/find.h"
#include "timing.h"

enum { THREADS = 2, FACES = 8, BLOCK = 16, BLOCK_TRIANGLES = 2 + 2 + 12 * FACES * FACES + 64 };

/* Bytes that grow. */
typedef struct bytes {
    char *at;
    size_t size, room;
} bytes;

static void append(bytes *b, const void *what, size_t size) {
    if (b->size + size > b->room) {
        b->room = 2 * b->room + size;
        b->at = realloc(b->at, b->room);
        if (b->at == NULL)
            exit(1);
    }
    memcpy(b->at + b->size, what, size);
    b->size += size;
}

static void text(bytes *b, const char *what) {
    append(b, what, strlen(what));
}

/* ---- The city ------------------------------------------------------------------------------------------------------
 */

typedef struct city {
    bytes positions, indices, nodes, meshes, accessors;
    uint32_t vertices, corners; /* of the part at hand */
    int parts;
    size_t triangles, posters;
} city;

/* count x count squares of two triangles, from `at` along u and v, which face u x v. */
static void grid(city *c, const float at[3], const float u[3], const float v[3], int count) {
    const float step = 1.0F / (float)count;
    for (int i = 0; i <= count; i++)
        for (int j = 0; j <= count; j++) {
            float p[3];
            for (int k = 0; k < 3; k++)
                p[k] = at[k] + step * ((float)i * u[k] + (float)j * v[k]);
            append(&c->positions, p, sizeof p);
        }
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++) {
            const uint32_t a = c->vertices + (uint32_t)(i * (count + 1) + j);
            const uint32_t b = a + (uint32_t)count + 1;
            const uint32_t corners[6] = {a, b, b + 1, a, b + 1, a + 1};
            append(&c->indices, corners, sizeof corners);
        }
    c->vertices += (uint32_t)((count + 1) * (count + 1));
    c->corners += (uint32_t)(6 * count * count);
}

static void end_part(city *c, const char *name) {
    char line[256];
    const size_t position = c->positions.size - 12 * (size_t)c->vertices;
    const size_t index = c->indices.size - 4 * (size_t)c->corners;
    const char *comma = c->parts == 0 ? "" : ",";
    snprintf(line, sizeof line, "%s{\"name\":\"%s\",\"mesh\":%d}", comma, name, c->parts);
    text(&c->nodes, line);
    snprintf(line, sizeof line, "%s{\"primitives\":[{\"attributes\":{\"POSITION\":%d},\"indices\":%d}]}", comma,
             2 * c->parts, 2 * c->parts + 1);
    text(&c->meshes, line);
    snprintf(line, sizeof line,
             "%s{\"bufferView\":0,\"byteOffset\":%zu,\"componentType\":5126,\"count\":%u,\"type\":\"VEC3\"},"
             "{\"bufferView\":1,\"byteOffset\":%zu,\"componentType\":5125,\"count\":%u,\"type\":\"SCALAR\"}",
             comma, position, (unsigned)c->vertices, index, (unsigned)c->corners);
    text(&c->accessors, line);
    c->triangles += c->corners / 3;
    c->vertices = c->corners = 0;
    c->parts++;
}

static void box(city *c, const float lo[3], const float size[3], int count) {
    for (int k = 0; k < 3; k++) {
        float u[3] = {0};
        float v[3] = {0};
        float at[3] = {lo[0], lo[1], lo[2]};
        u[(k + 1) % 3] = size[(k + 1) % 3];
        v[(k + 2) % 3] = size[(k + 2) % 3];
        grid(c, at, v, u, count);
        at[k] += size[k];
        grid(c, at, u, v, count);
    }
}

static void block(city *c, int i, int j, bool poster) {
    const float x = (float)(BLOCK * i);
    const float y = (float)(BLOCK * j);
    const float across[3] = {BLOCK, 0, 0};
    const float along[3] = {0, BLOCK, 0};
    grid(c, (const float[3]){x, y, 0}, across, along, 1);
    end_part(c, "ground");
    box(c, (const float[3]){x + 4, y + 4, 0}, (const float[3]){8, 8, 24}, FACES);
    end_part(c, "house");
    for (int w = 0; w < 32; w++)
        grid(c, (const float[3]){x + 4.25F + (float)(w % 4) * 2, y + 4 - 1.0F / 64, 1.5F + 2.5F * (float)(w / 4)},
             (const float[3]){1, 0, 0}, (const float[3]){0, 0, 2}, 1);
    end_part(c, "windows");
    grid(c, (const float[3]){x + 5, y + 6, 0}, (const float[3]){4, 0, 0}, (const float[3]){0, 4, 0}, 1);
    end_part(c, "carpet");
    if (poster) {
        grid(c, (const float[3]){x + 12, y + 6.5F, 3.25F}, (const float[3]){0, 3, 0}, (const float[3]){0, 0, 4}, 1);
        end_part(c, "poster");
        c->posters++;
    }
}

static void chunk(bytes *b, uint32_t kind, const void *what, size_t size) {
    const uint32_t head[2] = {(uint32_t)((size + 3) / 4 * 4), kind};
    append(b, head, sizeof head);
    append(b, what, size);
    append(b, "   ", head[0] - size);
}

static bytes glb(const city *c) {
    enum { JSON = 0x4e4f534a, BIN = 0x004e4942, GLTF = 0x46546c67 };
    bytes json = {0};
    bytes all = {0};
    bytes out = {0};
    char views[256];
    snprintf(
        views, sizeof views,
        "],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu},{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}],"
        "\"buffers\":[{\"byteLength\":%zu}],\"scene\":0,\"scenes\":[{\"nodes\":[",
        c->positions.size, c->positions.size, c->indices.size, c->positions.size + c->indices.size);
    text(&json, "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[");
    append(&json, c->nodes.at, c->nodes.size);
    text(&json, "],\"meshes\":[");
    append(&json, c->meshes.at, c->meshes.size);
    text(&json, "],\"accessors\":[");
    append(&json, c->accessors.at, c->accessors.size);
    text(&json, views);
    for (int i = 0; i < c->parts; i++) {
        char number[16];
        snprintf(number, sizeof number, "%s%d", i == 0 ? "" : ",", i);
        text(&json, number);
    }
    text(&json, "]}]}");
    append(&all, c->positions.at, c->positions.size);
    append(&all, c->indices.at, c->indices.size);
    const uint32_t head[3] = {GLTF, 2, (uint32_t)(12 + 16 + (json.size + 3) / 4 * 4 + all.size)};
    append(&out, head, sizeof head);
    chunk(&out, JSON, json.at, json.size);
    chunk(&out, BIN, all.at, all.size);
    free(json.at);
    free(all.at);
    return out;
}

static bytes make_city(size_t triangles, city *c) {
    const int side = (int)ceil(sqrt((double)triangles / BLOCK_TRIANGLES));
    *c = (city){.parts = 0};
    for (int b = 0; (size_t)b * BLOCK_TRIANGLES < triangles; b++)
        block(c, b % side, b / side, b % 4 == 0);
    bytes out = glb(c);
    bytes *parts[] = {&c->positions, &c->indices, &c->nodes, &c->meshes, &c->accessors};
    for (int i = 0; i < 5; i++)
        free(parts[i]->at);
    return out;
}

/* ---- The measurement -----------------------------------------------------------------------------------------------
 */

/* The posters, each with the wall of its own house; every carpet is hidden; all houses stand on the ground. */
static int judge(const city *c, const finder_found *f) {
    double area = 0.0;
    int right =
        f->findings == c->posters && f->left_out[FINDER_HIDDEN] > 0 && f->left_out[FINDER_FACING] > 0 && !f->cut;
    for (size_t i = 0; i < f->findings; i++) {
        right = right && f->finding[i].gap_max == 0.0;
        area += f->finding[i].area;
    }
    return right && fabs(area - 12.0 * (double)c->posters) <= 1e-9 * area;
}

static int measure(size_t triangles) {
    const char *path = "bench_scene.glb";
    city c;
    bytes file = make_city(triangles, &c);
    const char *folder = getenv("TMPDIR");
    char name[4096];
    snprintf(name, sizeof name, "%s/%s", folder != NULL ? folder : "/tmp", path);
    FILE *out = fopen(name, "wb");
    if (out == NULL || fwrite(file.at, 1, file.size, out) != file.size || fclose(out) != 0)
        return 1;
    free(file.at);
    model m;
    model_error error;
    finder_found f = {0};
    const double start = timing_now();
    const bool read = model_read(name, &(model_asked){0}, &m, &error);
    remove(name);
    if (!read) {
        fprintf(stderr, "bench_scene: %s\n", error.text);
        return 1;
    }
    const double middle = timing_now();
    const double before = timing_cpu();
    const finder_asked asked = {.gap = 0.01, .angle = FINDER_ANGLE, .threads = THREADS};
    const finder_status status = finder_find(&m, &asked, &f);
    const double end = timing_now();
    const double cpu = timing_cpu() - before;
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    const int right = status == FINDER_DONE && judge(&c, &f) && m.triangles == c.triangles;
    printf("%10zu %8.3f %8.3f %8.3f %9.1f %10.0f %8zu%s\n", m.triangles, middle - start, end - middle, cpu,
           1e9 * cpu / ((double)m.triangles * log2((double)m.triangles)),
           1024.0 * (double)usage.ru_maxrss / (double)m.triangles, f.findings, right ? "" : "  WRONG");
    fflush(stdout);
    finder_free(&f);
    model_free(&m);
    return !right;
}

int main(int argc, char **argv) {
    static const double standard[] = {1e4, 1e5, 1e6, 1e7};
    int wrong = 0;
    printf("# scene: %d threads\n#triangles  read s   find s    CPU s  ns/nlogn  bytes each  found\n", THREADS);
    /* `make bench` calls each with the program's path, which is no number */
    if (argc > 1 && strtod(argv[1], NULL) > 0.0)
        for (int i = 1; i < argc; i++)
            wrong |= measure((size_t)strtod(argv[i], NULL));
    else
        for (size_t i = 0; i < sizeof standard / sizeof standard[0]; i++)
            wrong |= measure((size_t)standard[i]);
    return wrong;
}
