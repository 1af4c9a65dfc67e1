/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file gpu.h  The browser's GPU, as gpu.js draws with it. */
#ifndef WEB_GPU_H
#define WEB_GPU_H

#include <stdbool.h>
#include <stdint.h>

#include "probe/shot.h"

enum { GPU_TEXT_SIZE = 512 };

typedef enum gpu_what { GPU_OPEN = 0, GPU_DRAW, GPU_COMPILE, GPU_VALUES, GPU_PICTURE } gpu_what;

/** 4 bytes each, in this order in gpu.js, too. */
typedef struct gpu_request {
    gpu_what what;
    char *text;         /**< of GPU_TEXT_SIZE: why it failed, else what is said of the device, or of the camera */
    const char *source; /**< GLSL */
    float a, b;         /**< of a program; near and far */
    uint32_t format;    /**< 0 to 2: 16 and 24 bits, float */
    uint32_t program, other, triangles; /**< as a shot has them */
    float constant, slope;
    uint32_t count;
    const void *in, *second; /**< what is drawn, or what goes into a function; likewise, or who draws each triangle */
    uint32_t *out;           /**< what was stored, what comes out of a function, who is seen */
    uint32_t passed;
} gpu_request;

/** WebGL's names of the formats of a shot. */
extern const char *const gpu_formats[SHOT_FORMATS];

/** Does what is asked. @return false with a sentence in `text` */
bool gpu_ask(gpu_request *r, char text[GPU_TEXT_SIZE]);

#endif
