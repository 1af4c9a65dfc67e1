/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file shot.h  One draw into a depth buffer of 256 x 256, and what was stored: what a back end does, and all it does.
 *
 * A plan of shots is made before any driver is called; a child process draws them and hands back raw codes.
 */
#ifndef PROBE_SHOT_H
#define PROBE_SHOT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum {
    SHOT_SIZE = 256, /**< pixels, width and height */
    SHOT_PIXELS = SHOT_SIZE * SHOT_SIZE,
    SHOT_NAME_SIZE = 256,
    SHOT_DEVICES_MAX = 32,
    SHOT_ERROR_SIZE = 192
};

/** The depth to which the buffer is cleared: no tie in any format, and rounded as it is truncated. */
#define SHOT_CLEAR 0.75F

/** The format of the depth buffer that is asked for. */
typedef enum shot_format { SHOT_D16 = 0, SHOT_D24, SHOT_D32F, SHOT_FORMATS } shot_format;

/** The vertex shader's use of its four numbers (x, y, z, w): the constant of shaders.glsl. */
typedef enum shot_program {
    SHOT_PASS = 0,     /**< clip coordinates as they are */
    SHOT_PROJECT,      /**< clip z = a z + b, clip w = w */
    SHOT_PROJECT_MORE, /**< the same expression in a longer shader */
    SHOT_LOG2,         /**< clip z = log2(z) a, clip w = 1 */
    SHOT_QUOTIENT      /**< clip z = z / w, clip w = 1 */
} shot_program;

typedef struct shot {
    const char *name; /**< of the measurement, "rounding" */
    shot_format format;
    shot_program program;
    float a, b;            /**< of the program */
    bool triangles;        /**< else points */
    bool ndc_signed;       /**< clip z is drawn from -w to w, as OpenGL has it */
    float range[2];        /**< depths of the viewport; both 0: 0 and 1 */
    float constant, slope; /**< of a depth bias; 0: none */
    uint32_t count;        /**< vertices */
    float (*vertex)[4];    /**< x and y are clip coordinates, those of a point at the centre of its pixel */
    bool again;            /**< draw `second` over it where it is equal to what is stored, and count in `passed` */
    float (*second)[4];    /**< as many vertices */
    shot_program other;    /**< their program */
    /* The results. */
    bool drawn;
    uint64_t passed; /**< samples; 0: none; else some, where the device cannot count */
    uint32_t
        *code; /**< SHOT_PIXELS, row 0 at clip y = -1; fp32 as its bits. A pixel that is not drawn has SHOT_CLEAR */
} shot;

/** The upper end of the viewport's depths, of either order. */
static inline float shot_range_end(const shot *s) {
    return s->range[0] != s->range[1] ? s->range[1] : 1.0F;
}

typedef struct shot_plan {
    size_t count;
    shot *shot;
} shot_plan;

/** A device, as its driver describes it. */
typedef struct shot_device {
    char name[SHOT_NAME_SIZE], driver[3 * SHOT_NAME_SIZE], api[SHOT_NAME_SIZE];
    bool software;     /**< it says that it is a processor */
    int subpixel_bits; /**< as it reports them */
    bool has[SHOT_FORMATS];
    char format[SHOT_FORMATS][SHOT_NAME_SIZE]; /**< what stands for each, as the API names it */
} shot_device;

/** The devices that a back end finds, and the chosen one. */
typedef struct shot_machine {
    size_t count; /**< devices */
    shot_device device[SHOT_DEVICES_MAX];
    size_t chosen;               /**< index; count where none was */
    bool counts;                 /**< samples that pass are counted, not only told from none */
    char error[SHOT_ERROR_SIZE]; /**< "" when all went well */
} shot_machine;

/**
 * Lists the devices, and draws the plan on the one of that name or number (null: the first that is no processor, else
 * the first); formats that it lacks are left out. Never returns where a driver hangs: see probe.h.
 * @return false with machine->error
 */
bool shot_vulkan(const char *wanted, shot_plan *plan, shot_machine *machine);

/** The same on the one device that OpenGL finds without a window, with clip z from 0 to w. */
bool shot_opengl(shot_plan *plan, shot_machine *machine);

#endif
