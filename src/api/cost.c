/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "api/cost.h"

#include <string.h>

typedef struct format_cost {
    const char *name;
    int bytes;
    int rank;
    const char *available;
    const char *caution;
} format_cost;

enum { NO_BUFFER = 100 };

/*
 * Vulkan: D16_UNORM is mandatory, and one of X8_D24 and D32_SFLOAT (specification, required format support). Metal:
 * Depth24Unorm_Stencil8 is not on Apple silicon (isDepth24Stencil8PixelFormatSupported).
 */
static const format_cost formats[] = {
    {"unorm16", 2, 0, "every API", ""},
    {"fp32", 4, 0, "every API", "fp32 needs OpenGL 3.0, OpenGL ES 3.0 or WebGL 2"},
    {"unorm24", 4, 2, "optional in Vulkan, none on Apple silicon",
     "unorm24 is missing on many GPUs; depth24plus of WebGPU means it or fp32"},
    {"fp16", 2, NO_BUFFER, "colour targets only", "fp16 is no depth buffer in any API"},
};

static const struct {
    int rank;
    const char *effort;
} mappings[DP_MAPPING_COUNT] = {
    [DP_MAPPING_D3D] = {0, ""},
    [DP_MAPPING_GL] = {0, ""},
    [DP_MAPPING_REVERSED] = {1, "clear to 0, compare greater; OpenGL: glClipControl"},
    [DP_MAPPING_GL_REVERSED] = {1, "clear to 0, compare greater; NDC rounding spoils it"},
    [DP_MAPPING_LINEAR] = {4, "the fragment shader writes depth"},
    [DP_MAPPING_LOG] = {4, "the fragment shader writes depth"},
};

cost cost_of(const dp_format *format, dp_mapping mapping) {
    cost c = {.bytes = (format->bits + 7) / 8,
              .rank = NO_BUFFER,
              .available = "no API: for study",
              .caution = "",
              .effort = ""};
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++)
        if (strcmp(formats[i].name, format->name) == 0) {
            c.bytes = formats[i].bytes;
            c.rank = formats[i].rank;
            c.available = formats[i].available;
            c.caution = formats[i].caution;
        }
    if ((unsigned)mapping < DP_MAPPING_COUNT) {
        c.rank += mappings[mapping].rank;
        c.effort = mappings[mapping].effort;
    }
    return c;
}

int cost_compare(const cost *a, const cost *b) {
    const int buffers = (a->rank >= NO_BUFFER) - (b->rank >= NO_BUFFER);
    return buffers != 0 ? buffers : a->bytes != b->bytes ? a->bytes - b->bytes : a->rank - b->rank;
}
