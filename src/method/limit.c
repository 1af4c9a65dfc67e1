/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What no method can beat: loops that read a family's inputs, write its outputs and do next to nothing in between. */
#include "method/limit.h"

#include "texture/clones.h"

enum { BLOCK = 1024 };

#define LIMIT(NAME, BODY)                                                                                              \
    TEXTURE_CLONES void limit_##NAME(const dp_setup *setup, const void *state, const method_inputs *in,                \
                                     const method_outputs *out) {                                                      \
        const size_t count = in->count;                                                                                \
        (void)setup;                                                                                                   \
        (void)state;                                                                                                   \
        BODY                                                                                                           \
    }

LIMIT(depths, {
    const double *restrict z = in->z;
    double *restrict value = out->value;
    for (size_t i = 0; i < count; i++)
        value[i] = -z[i];
})

LIMIT(ranges, {
    const double *restrict z = in->z;
    const double *restrict hi = in->hi;
    double *restrict value = out->value;
    for (size_t i = 0; i < count; i++)
        value[i] = hi[i] - z[i];
})

LIMIT(windows, {
    const float *restrict d = in->d;
    float *restrict eye = out->eye;
    for (size_t i = 0; i < count; i++)
        eye[i] = -d[i];
})

LIMIT(codes, {
    const float *restrict d = in->d;
    uint32_t *restrict code = out->code;
    for (size_t i = 0; i < count; i++)
        code[i] = (uint32_t)(int32_t)d[i];
})

/* One plane in, three out: by blocks, because three streams at the same distance from a page get in each other's way.
 */
#define PLANES(FROM)                                                                                                   \
    for (size_t block = 0; block < count; block += BLOCK)                                                              \
        for (int k = 0; k < 3; k++) {                                                                                  \
            const float *restrict from = (FROM) + block;                                                               \
            float *restrict to = out->place[k] + block;                                                                \
            const size_t some = count - block < BLOCK ? count - block : BLOCK;                                         \
            for (size_t i = 0; i < some; i++)                                                                          \
                to[i] = -from[i];                                                                                      \
        }

LIMIT(places, {PLANES(in->d)})
LIMIT(eyes, {PLANES(in->eye)})
