/* SPDX-License-Identifier: GPL-3.0-or-later */
/* glTF written: what our reader reads of it, its layout by the format's rules, and `scene --annotate`. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/gltf_write.h"
#include "printed.h"
#include "support.h"

enum { PER_SIDE = 40, TRIANGLES = 3 * PER_SIDE * PER_SIDE, SURFACES = 4, VERTEX = 12 };

static const gltf_mark marks[] = {{"red", {1.0, 0.0, 0.0}}, {"blue", {0.0, 0.0, 1.0}}};

/* ---- A model, and bytes ------------------------------------------------------------------------------------------ */

typedef struct made_model {
    model m;
    double position[3 * TRIANGLES][3];
    uint32_t triangle[TRIANGLES][3], of[TRIANGLES];
    unsigned char mark[TRIANGLES];
} made_model;

static model_surface surfaces[SURFACES] = {{"n\"1\\", "mesh", "stone", false, false},
                                           {"\xc3\xa4 2", "", "glass", true, true},
                                           {"empty", "none", "nothing", false, false},
                                           {"", "m4", "stone", true, false}};
static model_camera cameras[] = {{"street", false, {1, 2, 3}, {0, 0.6, -0.8}, {0, 0.8, 0.6}, 40.0, 0.0, 0.25, INFINITY},
                                 {"plan", true, {0, 9, 0}, {0, -1, 0}, {0, 0, -1}, 0.0, 12.5, 0.5, 80.0}};

/* Surface 2 has no triangles; coordinates need rounding. */
static made_model *make(void) {
    made_model *f = calloc(1, sizeof *f);
    assert_non_null(f);
    f->m = (model){.vertices = 3 * TRIANGLES, .triangles = TRIANGLES, .surfaces = SURFACES, .cameras = 2};
    f->m.position = f->position;
    f->m.triangle = f->triangle;
    f->m.of = f->of;
    f->m.surface = surfaces;
    f->m.camera = cameras;
    for (uint32_t t = 0; t < TRIANGLES; t++) {
        static const uint32_t used[] = {0, 1, 3};
        f->of[t] = used[t % 7 % 3];
        f->mark[t] = (unsigned char)(t % 5 < 3 ? t % 5 : 0);
        for (uint32_t k = 0; k < 3; k++) {
            f->triangle[t][k] = 3 * t + (k + t) % 3; /* not in order */
            f->position[3 * t + k][0] = (k == 1 ? 0.7 : 0.1) + t / PER_SIDE;
            f->position[3 * t + k][1] = (k == 2 ? 0.7 : 0.1) + t % PER_SIDE;
            f->position[3 * t + k][2] = -1.0 / (3.0 + t);
        }
    }
    return f;
}

typedef struct bytes {
    unsigned char *at;
    size_t used, calls, stop_at; /* stop_at: the call that refuses, from 1 */
} bytes;

static bool take(void *context, const void *more, size_t size) {
    bytes *b = context;
    if (++b->calls == b->stop_at)
        return false;
    b->at = realloc(b->at, b->used + size + 1);
    assert_non_null(b->at);
    memcpy(b->at + b->used, more, size);
    b->used += size;
    return true;
}

static gltf_status write_into(const made_model *f, bytes *b) {
    const gltf_written out = {.marks = marks, .count = 2, .mark = f->mark, .write = take, .context = b};
    return gltf_write(&f->m, &out);
}

static uint32_t word(const bytes *b, size_t at) {
    assert_true(at + 4 <= b->used);
    return b->at[at] | (uint32_t)b->at[at + 1] << 8 | (uint32_t)b->at[at + 2] << 16 | (uint32_t)b->at[at + 3] << 24;
}

/* ---- What is read again ------------------------------------------------------------------------------------------ */

static const char *material_of(const made_model *f, size_t t) {
    return f->mark[t] > 0 ? marks[f->mark[t] - 1].name : surfaces[f->of[t]].material;
}

/* Each triangle, found by its third coordinate, which no other one has: corners, names, sides. */
static void again(void **state) {
    made_model *f = make();
    bytes b = {.used = 0};
    model m;
    model_error error;
    static const model_asked asked = {.transforms = MODEL_EXACT};
    unsigned char *seen = calloc(TRIANGLES, 1);
    (void)state;
    assert_int_equal(write_into(f, &b), GLTF_WRITTEN);
    if (!model_parse(b.at, b.used, false, NULL, &asked, &m, &error))
        fail_msg("%s", error.text);
    assert_int_equal(m.triangles, TRIANGLES);
    for (size_t i = 0; i < m.triangles; i++) {
        const double z = m.position[m.triangle[i][0]][2];
        const size_t t = (size_t)rint(-1.0 / z - 3.0);
        const model_surface *got = &m.surface[m.of[i]], *want = &surfaces[f->of[t]];
        assert_true(t < TRIANGLES && !seen[t]);
        seen[t] = 1;
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 3; c++)
                assert_true(m.position[m.triangle[i][k]][c] == (double)(float)f->position[f->triangle[t][k]][c]);
        assert_string_equal(got->node, want->node);
        assert_string_equal(got->mesh, want->mesh);
        assert_string_equal(got->material, material_of(f, t));
        assert_int_equal(got->two_sided, f->mark[t] > 0 || want->two_sided);
        assert_int_equal(got->blended, f->mark[t] == 0 && want->blended);
    }
    assert_int_equal(m.surfaces, 9); /* three with triangles, of three kinds each */
    assert_int_equal(m.cameras, 2);
    for (size_t i = 0; i < 2; i++) {
        const model_camera *got = &m.camera[i], *want = &cameras[i];
        assert_string_equal(got->name, want->name);
        for (int k = 0; k < 3; k++)
            assert_true(got->eye[k] == want->eye[k] && fabs(got->ahead[k] - want->ahead[k]) < 1e-15 &&
                        fabs(got->up[k] - want->up[k]) < 1e-15);
        assert_true(got->ortho == want->ortho && got->znear == want->znear && got->zfar == want->zfar);
        assert_true(want->ortho ? got->height == want->height : fabs(got->fov_y - want->fov_y) < 1e-13);
    }
    model_free(&m);
    free(seen);
    free(b.at);
    free(f);
}

/* Chunks of whole words, lengths that add up, extremes that are those of the numbers. */
static void layout(void **state) {
    made_model *f = make();
    bytes b = {.used = 0};
    (void)state;
    assert_int_equal(write_into(f, &b), GLTF_WRITTEN);
    const size_t length = word(&b, 12), data = 20 + length;
    assert_true(word(&b, 0) == 0x46546c67 && word(&b, 4) == 2 && word(&b, 8) == b.used);
    assert_true(length % 4 == 0 && memcmp(b.at + 16, "JSON", 4) == 0);
    assert_memory_equal(b.at + data + 4, "BIN\0", 4);
    assert_true(word(&b, data) == 3 * VERTEX * TRIANGLES && b.used == data + 8 + 3 * VERTEX * TRIANGLES);
    json_t *root = json_loadb((const char *)b.at + 20, length, 0, NULL);
    assert_non_null(root);
    const json_t *accessors = json_object_get(root, "accessors");
    assert_int_equal(json_array_size(accessors), 9);
    assert_int_equal(json_array_size(json_object_get(root, "materials")), 5); /* stone from one side and from two */
    for (size_t i = 0; i < 9; i++) {
        const json_t *row = json_array_get(accessors, i);
        const size_t first = (size_t)json_integer_value(json_object_get(row, "byteOffset")) + data + 8;
        const size_t count = (size_t)json_integer_value(json_object_get(row, "count"));
        double lo[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, hi[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        for (size_t k = 0; k < 3 * count; k++) {
            const uint32_t bits = word(&b, first + 4 * k);
            float x;
            memcpy(&x, &bits, sizeof x);
            lo[k % 3] = fmin(lo[k % 3], (double)x);
            hi[k % 3] = fmax(hi[k % 3], (double)x);
        }
        for (size_t k = 0; k < 3; k++) {
            assert_true(json_real_value(json_array_get(json_object_get(row, "min"), k)) == lo[k]);
            assert_true(json_real_value(json_array_get(json_object_get(row, "max"), k)) == hi[k]);
        }
    }
    json_decref(root);
    free(b.at);
    free(f);
}

static void ends(void **state) {
    made_model *f = make();
    bytes b = {.used = 0};
    (void)state;
    for (size_t i = 1; i <= 7; i++) {
        bytes stopped = {.stop_at = i};
        assert_int_equal(write_into(f, &stopped), GLTF_STOPPED);
        assert_int_equal(stopped.calls, i); /* and nothing after it */
        free(stopped.at);
    }
    f->position[5][1] = 3.5e38;
    assert_int_equal(write_into(f, &b), GLTF_RANGE);
    assert_int_equal(b.calls, 0);
    f->m.triangles = f->m.surfaces = f->m.cameras = 0;
    assert_int_equal(write_into(f, &b), GLTF_WRITTEN);
    assert_int_equal(word(&b, 8), b.used);
    assert_int_equal(b.used, 20 + word(&b, 12)); /* no data */
    free(b.at);
    free(f);
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

/* A wall of two triangles with a poster before its lower one, a shelf 5 cm before another wall, and a tree. */
static const char town[] = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 2.5 .5 .001\nv 3.5 .5 .001\nv 3.5 1.2 .001\n"
                           "v 10 0 0\nv 14 0 0\nv 14 4 0\nv 10.5 .5 .05\nv 13.5 .5 .05\nv 13.5 3 .05\n"
                           "v 20 0 0\nv 24 0 0\nv 24 4 0\n"
                           "g wall\nf 1 2 3\nf 1 3 4\ng poster\nf 5 6 7\ng wall2\nf 8 9 10\ng shelf\nf 11 12 13\n"
                           "g tree\nf 14 15 16\n";

static void annotated(void **state) {
    static const struct {
        const char *node, *material;
        size_t triangles;
    } want[] = {{"wall", "", 1},
                {"wall", "depthprec: fights", 1},
                {"poster", "depthprec: fights", 1},
                {"wall2", "depthprec: fights farther off", 1},
                {"shelf", "depthprec: fights farther off", 1},
                {"tree", "", 1}};
    const model_asked asked = {.transforms = MODEL_EXACT};
    char from[512], to[512];
    model m;
    model_error error;
    (void)state;
    snprintf(from, sizeof from, "%s", scratch_file("town.obj"));
    snprintf(to, sizeof to, "%s", scratch_file("town.glb"));
    FILE *file = fopen(from, "w");
    assert_non_null(file);
    assert_true(fputs(town, file) >= 0 && fclose(file) == 0);
    /* Steps of d24 at z are near z^2 / (n 2^24): 1 mm is lost before 60, and 5 cm between there and 1000. */
    printed p = print_of("scene %s -F d24 -m d3d -n 0.1 -f 1000 --separation 0.1 --within 60 --annotate %s", from, to);
    assert_int_equal(p.status, 1);
    printed_free(&p);
    if (!model_read(to, &asked, &m, &error))
        fail_msg("%s", error.text);
    assert_int_equal(m.surfaces, sizeof want / sizeof want[0]);
    for (size_t i = 0; i < m.surfaces; i++) {
        size_t count = 0;
        for (size_t t = 0; t < m.triangles; t++)
            count += m.of[t] == i;
        if (strcmp(m.surface[i].node, want[i].node) != 0 || strcmp(m.surface[i].material, want[i].material) != 0 ||
            count != want[i].triangles)
            fail_msg("%zu: %s (%s): %zu triangles", i, m.surface[i].node, m.surface[i].material, count);
    }
    model_free(&m);
}

static void refused(void **state) {
    static const struct {
        const char *options;
        int status;
        const char *said;
    } rows[] = {
        {"--annotate ''", 2, "--annotate: must be a file name, got ''"},
        {"--annotate none/x.glb", 3, "cannot write 'none/x.glb': No such file or directory"},
        {"--annotate tests/models/street.obj", 2, "--annotate: must not be a file that is read, got 'tests/mod"},
        {"--annotate x.png --render x.png", 2, "--annotate: must not be the file of --render, got 'x.png'"},
        {"--annotate x.glb -o x.glb", 2, "--annotate: must not be the file of --output, got 'x.glb'"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        printed p = print_of("scene tests/models/street.obj %s", rows[i].options);
        if (p.status != rows[i].status || strstr(p.errors, rows[i].said) == NULL)
            fail_msg("%s: %d: %s", rows[i].options, p.status, p.errors);
        printed_free(&p);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(again), cmocka_unit_test(layout), cmocka_unit_test(ends),
                                       cmocka_unit_test(annotated), cmocka_unit_test(refused)};
    return run_tap(tests);
}
