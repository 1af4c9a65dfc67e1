/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slanted triangles of real rasterizers: every recorded pixel, its code and whether it is covered. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "raster_named.h"

enum { TRIANGLES = 1024, COLUMNS = 11, WORDS = 12, SIZE = 512 };

/* The recorded columns. */
static const struct column {
    const char *raster, *format;
} columns[COLUMNS] = {{"llvmpipe", "fp32"},       {"lavapipe", "fp32"},    {"swiftshader", "fp32"},
                      {"softpipe", "fp32"},       {"llvmpipe", "unorm24"}, {"lavapipe", "unorm24"},
                      {"softpipe", "unorm24"},    {"llvmpipe", "unorm16"}, {"lavapipe", "unorm16"},
                      {"swiftshader", "unorm16"}, {"softpipe", "unorm16"}};

/* A triangle as each column draws it. */
typedef struct recorded {
    char kind[16];
    raster_vertex vertex[3];
    raster_status status[COLUMNS];
    raster_triangle drawn[COLUMNS];
} recorded;

typedef struct seen {
    raster_target target[COLUMNS];
    recorded at;
    char camera[32];
    tally codes, covered, uncovered;
    unsigned long pixels, clipped, touching;
} seen;

/* The recording's clip coordinates, 12 words of hexadecimal digits. */
static void read_triangle(seen *s, const char *kind, char *const word[WORDS]) {
    recorded *r = &s->at;
    float number[WORDS];
    for (int i = 0; i < WORDS; i++) {
        const uint32_t bits = (uint32_t)strtoul(word[i], NULL, 16);
        memcpy(&number[i], &bits, sizeof bits);
    }
    snprintf(r->kind, sizeof r->kind, "%s", kind);
    memcpy(r->vertex, number, sizeof number);
    for (int i = 0; i < COLUMNS; i++)
        r->status[i] = raster_set_up(&s->target[i], r->vertex, &r->drawn[i]);
}

/* Where a pixel is covered, the code of the last piece that covers it: by itself, and in its row. */
static bool pixel_of(const raster_target *target, const raster_triangle *drawn, int x, int y, uint32_t *code) {
    bool covered = false;
    for (int i = 0; i < drawn->count; i++) {
        uint32_t row[SIZE];
        int from, to;
        if (!raster_span(target, &drawn->piece[i], y, &from, &to) || x < from || x >= to)
            continue;
        raster_codes(target, &drawn->piece[i], y, from, to, row);
        raster_codes(target, &drawn->piece[i], y, x, x + 1, code);
        assert_int_equal(*code, row[x - from]);
        covered = true;
    }
    return covered;
}

/* Kinds of which no pixel is drawn over by another triangle. */
static bool lies_alone(const char *kind) {
    return strcmp(kind, "small") == 0 || strcmp(kind, "steep") == 0;
}

static void read_pixel(seen *s, const char *where, int x, int y, char *const cell[COLUMNS]) {
    const recorded *r = &s->at;
    s->pixels++;
    s->clipped += strcmp(r->kind, "near") == 0 || strcmp(r->kind, "edge") == 0;
    for (int i = 0; i < COLUMNS; i++) {
        const struct column *c = &columns[i];
        uint32_t code = 0;
        const bool covered = pixel_of(&s->target[i], &r->drawn[i], x, y, &code);
        if (*cell[i] == '\0' || *cell[i] == '-') {
            if (lies_alone(r->kind))
                TALLY(&s->uncovered, !covered, "%s, %s: pixel %d %d of %s", s->camera, where, x, y, c->raster);
            else
                s->touching += covered;
            continue;
        }
        const uint32_t stored = (uint32_t)strtoul(cell[i], NULL, 16);
        TALLY(&s->covered, covered, "%s, %s, %s: pixel %d %d of %s, status %d", s->camera, where, r->kind, x, y,
              c->raster, (int)r->status[i]);
        if (covered)
            TALLY(&s->codes, code == stored, "%s, %s, %s: pixel %d %d of %s, %s: %x stored, %x computed", s->camera,
                  where, r->kind, x, y, c->raster, c->format, (unsigned)stored, (unsigned)code);
    }
}

static void begin(seen *s) {
    for (int i = 0; i < COLUMNS; i++)
        s->target[i] = target_of(columns[i].raster, columns[i].format, SIZE, SIZE, dp_path_best());
}

static void end(const seen *s) {
    printf("# %lu pixels, %lu of clipped kinds; %lu not stored, perhaps drawn over\n", s->pixels, s->clipped,
           s->touching);
    tally_end(&s->codes);
    tally_end(&s->covered);
    tally_end(&s->uncovered);
}

/* ---- The files, in the folder that DEPTHPREC_RECORDING names, else in that of the tests ---------------------------
 */

static int split(char *line, char *cell[], int most) {
    int count = 0;
    line[strcspn(line, "\r\n")] = '\0';
    for (char *at = line; at != NULL && count < most; count++) {
        cell[count] = at;
        at = strchr(at, ',');
        if (at != NULL)
            *at++ = '\0';
    }
    return count;
}

static FILE *unpacked(const char *folder, const char *camera, const char *what) {
    char command[512];
    snprintf(command, sizeof command, "gzip -dc %s/%s.s1.%s.csv.gz", folder, camera, what);
    return popen(command, "r");
}

static void read_camera(seen *s, const char *folder, const char *camera) {
    static char lines[TRIANGLES][256];
    char line[256], *cell[2 + WORDS];
    int of = -1;
    FILE *in = unpacked(folder, camera, "tri");
    snprintf(s->camera, sizeof s->camera, "%s", camera);
    for (int i = 0; i < TRIANGLES && fgets(lines[i], sizeof lines[i], in) != NULL;)
        i++;
    assert_int_equal(pclose(in), 0);
    in = unpacked(folder, camera, "px");
    assert_non_null(fgets(line, sizeof line, in));
    while (fgets(line, sizeof line, in) != NULL) {
        char kept[256], *of_triangle[2 + WORDS];
        assert_int_equal(split(line, cell, 3 + COLUMNS), 3 + COLUMNS);
        if (atoi(cell[0]) != of) {
            of = atoi(cell[0]);
            assert_in_range(of, 1, TRIANGLES - 1);
            memcpy(kept, lines[of], sizeof kept);
            assert_int_equal(split(kept, of_triangle, 2 + WORDS), 2 + WORDS);
            assert_int_equal(atoi(of_triangle[0]), of);
            read_triangle(s, of_triangle[1], of_triangle + 2);
        }
        read_pixel(s, cell[0], atoi(cell[1]), atoi(cell[2]), cell + 3);
    }
    assert_int_equal(pclose(in), 0);
}

TEST(all_recorded) {
    static const char *const cameras[] = {"n0.1_f100.d3d", "n0.1_finf.rev", "n1_f10.d3d"};
    const char *other = getenv("DEPTHPREC_RECORDING");
    static seen s = {
        .codes = {.name = "codes"}, .covered = {.name = "covered pixels"}, .uncovered = {.name = "pixels left out"}};
    begin(&s);
    for (size_t i = 0; i < sizeof cameras / sizeof cameras[0]; i++)
        read_camera(&s, other != NULL ? other : "tests/recording", cameras[i]);
    assert_true(other != NULL || s.pixels == 52655);
    end(&s);
}
