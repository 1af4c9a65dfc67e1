/* SPDX-License-Identifier: MIT */
/*
 * The door of the library's module: what camera.js asks of it. It keeps no camera: whoever asks lays the bytes of a
 * set-up into `setup` before. Numbers, words and elements go through memory that is always there, so that nothing is
 * allocated, nothing is freed, and the memory never moves.
 */
#include <string.h>

#include "depthprec/depthprec.h"

#define EXPORT(name) __attribute__((export_name(#name)))

enum { BLOCK = 1 << 16, NUMBERS = 17, TEXT = 512 };

_Static_assert(DP_TASK_CODE == 0 && DP_TASK_EYE == 1 && DP_TASK_LO == 5 && DP_TASK_HI == 6 && DP_TASK_WINDOW == 7 &&
                   DP_TASK_SEPARATION == 8 && DP_TASK_INTERVAL == 9 && DP_REAL_DOUBLE == 1 && DP_WORD_32 == 1 &&
                   DP_LAYOUT_ROWS == 1 && DP_LAYOUT_COLUMNS == 2 && DP_ERROR_DEPTH == 13 && DP_ERROR_MATRIX == 20 &&
                   DP_ERROR_CONVENTION == 21 && DP_ERROR_TRIANGLES == 19,
               "camera.js has these numbers");

static dp_setup setup;
static dp_batch batch;
static double numbers[NUMBERS];
static char text[TEXT]; /* words, each ended by 0 */
static _Alignas(16) unsigned char blocks[4][BLOCK];

/** Where the set-up, the numbers, the words and the blocks of elements (one read, three written) lie. */
EXPORT(at) const void *door_at(int what) {
    const void *const all[] = {&setup, numbers, text, blocks};
    return all[what];
}

EXPORT(size) size_t door_size(void) {
    return sizeof setup;
}

EXPORT(version) const char *door_version(void) {
    return dp_version();
}

EXPORT(status) const char *door_status(int status) {
    return dp_status_text((dp_status)status);
}

EXPORT(mapping) const char *door_mapping(int index) {
    return index < DP_MAPPING_COUNT ? dp_mapping_get((dp_mapping)index)->name : NULL;
}

static const char *word(int index) {
    const char *at = text;
    while (index-- > 0)
        at += strlen(at) + 1;
    return at;
}

static void answer(const char *a, const char *b, const char *c) {
    char *at = text;
    const char *const all[] = {a, b, c};
    for (int i = 0; i < 3; i++, at += strlen(at) + 1)
        strcpy(at, all[i]);
}

static int named_rounding(const char *name) {
    int i = 0;
    while (dp_rounding_name((dp_rounding)i) != NULL && strcmp(dp_rounding_name((dp_rounding)i), name) != 0)
        i++;
    return i;
}

static int named_model(const char *name) {
    int i = 0;
    while (i < DP_MODEL_COUNT && strcmp(dp_model_name((dp_model)i), name) != 0)
        i++;
    return i;
}

/** How many formats the word names, two where the implementation chooses; their names become the words. */
EXPORT(formats) size_t door_formats(void) {
    dp_format formats[2];
    const size_t count = dp_format_parse(text, formats);
    if (count == 2)
        answer(formats[0].name, formats[1].name, "");
    return count;
}

/* The error of a plane, however a rasterizer anchors it. */
static dp_plane_error any_plane(void) {
    dp_plane_error worst = {0};
    for (int i = 0; i < DP_ANCHOR_COUNT; i++) {
        const dp_plane_error *plane = &dp_anchor_get((dp_anchor)i)->plane;
        worst.value = plane->value > worst.value ? plane->value : worst.value;
        worst.box = plane->box > worst.box ? plane->box : worst.box;
        worst.range = plane->range > worst.range ? plane->range : worst.range;
        worst.origin = plane->origin > worst.origin ? plane->origin : worst.origin;
    }
    return worst;
}

/* Numbers 4 on: whether there are triangles, their fields, and of which planes. @return what is wrong, or null */
static const char *read_triangles(dp_triangles *out) {
    const double *n = numbers + 7;
    *out = dp_triangles_default();
    out->width = (int)n[0];
    out->height = (int)n[1];
    out->fov_y = n[2];
    out->subpixel = (int)n[3];
    out->slant_lo = n[4];
    out->slant_hi = n[5];
    out->depth = n[6];
    out->pixels = n[7];
    out->slim = n[8];
    if (n[9] != 0)
        out->plane = any_plane();
    return dp_triangles_fault(out);
}

/**
 * A set-up of numbers (near, far, ortho, log_c, depth_range, triangles) and words (format, mapping, arith, rounding,
 * model). The answer is in numbers (code_max, bits) and words (format, mapping, arith), or of triangles that cannot be
 * a sentence.
 */
EXPORT(camera) dp_status door_camera(void) {
    dp_spec spec = dp_spec_default();
    dp_format formats[2];
    spec.znear = numbers[0];
    spec.zfar = numbers[1];
    spec.ortho = numbers[2] != 0;
    spec.log_c = numbers[3];
    memcpy(spec.depth_range, numbers + 4, sizeof spec.depth_range);
    if (dp_format_parse(word(0), formats) == 0)
        return DP_ERROR_FORMAT;
    spec.format = formats[0];
    spec.rounding = (dp_rounding)named_rounding(word(3));
    spec.model = (dp_model)named_model(word(4));
    dp_status status = dp_mapping_parse(word(1), &spec.mapping);
    if (status == DP_OK)
        status = dp_arith_parse(word(2), &spec.arith);
    const char *fault = NULL;
    if (status == DP_OK && spec.depth_range[0] == spec.depth_range[1])
        status = DP_ERROR_WINDOW;
    if (status == DP_OK && numbers[6] != 0)
        fault = read_triangles(&spec.triangles);
    if (status == DP_OK)
        status = fault != NULL ? DP_ERROR_TRIANGLES : dp_setup_init(&setup, &spec);
    if (fault != NULL)
        answer(fault, "", "");
    if (status == DP_OK) {
        numbers[0] = spec.format.code_max;
        numbers[1] = spec.format.bits;
        answer(spec.format.name, dp_mapping_get(spec.mapping)->name, dp_arith_get(spec.arith)->name);
    }
    return status;
}

/** Makes the set-up that of the guarantee. */
EXPORT(guaranteed) void door_guaranteed(void) {
    setup = dp_setup_guaranteed(&setup);
}

/** Makes the set-up that of the lattice, which knows of no triangles. */
EXPORT(lattice) dp_status door_lattice(void) {
    dp_spec spec = setup.spec;
    spec.model = DP_MODEL_EXACT;
    spec.triangles.width = 0;
    return dp_setup_init(&setup, &spec);
}

/** Prepares the set-up for a task, which stays prepared until the next. */
EXPORT(prepare) dp_status door_prepare(int task, int real, int word_size) {
    return dp_batch_init(&batch, &setup, (dp_task)task, (dp_real)real, (dp_word)word_size, dp_path_best());
}

/** Converts so many elements of the first block into the second. */
EXPORT(run) void door_run(size_t count) {
    dp_batch_run(&batch, blocks[0], blocks[1], count);
}

/** Window depths in the first block to eye depths in the second, with `bounds` the ends of cells in the others. */
EXPORT(windows) dp_status door_windows(int real, int bounds, size_t count) {
    return dp_batch_windows(&setup, (dp_real)real, blocks[0], blocks[1], bounds ? blocks[2] : NULL,
                            bounds ? blocks[3] : NULL, count);
}

/** The worst over the range in the first two numbers; the answer in the numbers, as camera.js names them. */
EXPORT(worst) dp_status door_worst(void) {
    const dp_setup guaranteed = dp_setup_guaranteed(&setup);
    dp_worst cells;
    dp_separation_worst apart;
    dp_status status = dp_worst_over(&setup, numbers[0], numbers[1], &cells);
    if (status == DP_OK)
        status = dp_separation_over(&guaranteed, numbers[0], numbers[1], 0.0, &apart);
    if (status == DP_OK) {
        const double all[] = {cells.lo,          cells.hi,          cells.error,
                              cells.error_z,     cells.error_code,  cells.interval,
                              cells.interval_lo, cells.interval_hi, cells.interval_code,
                              cells.blind_from,  apart.bound,       apart.z};
        memcpy(numbers, all, sizeof all);
    }
    return status;
}

/**
 * The camera of the matrix in the numbers, its mapping the first word, "" where it is to be found. The answer is in the
 * numbers (near, far, ortho, dp_planes) and the first word (mapping); what is wrong with the matrix: four numbers and a
 * sentence.
 */
EXPORT(matrix) dp_status door_matrix(int layout) {
    dp_mapping mapping = DP_MAPPING_COUNT;
    dp_projection found;
    dp_planes planes;
    dp_matrix_fault fault;
    dp_status status = *text != '\0' ? dp_mapping_parse(text, &mapping) : DP_OK;
    if (status == DP_OK)
        status = dp_projection_find(&found, numbers, (dp_layout)layout, mapping, &fault);
    if (status == DP_OK && dp_projection_planes(&planes, &found, numbers, NULL, NULL) == DP_OK) {
        const double all[] = {found.znear,       found.zfar,         found.ortho,
                              planes.near_least, planes.near_most,   planes.far_least,
                              planes.far_most,   planes.near_digits, planes.far_digits};
        memcpy(numbers, all, sizeof all);
        answer(dp_mapping_get(found.mapping)->name, "", "");
    } else if (status == DP_ERROR_MATRIX) {
        memcpy(numbers, fault.got, sizeof fault.got);
        answer(fault.rule, "", "");
    }
    return status;
}
