/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Limits that no method beats: loops that read a family's inputs, write its outputs and do next to nothing between. */
#include "method/method.h"

#include "core/clones.h"

enum { BLOCK = 1024 };

CLONES void limit_depths(const method_call *c) {
    const size_t count = c->in->count;
    const double *restrict z = c->in->z;
    double *restrict value = c->out->value;
    for (size_t i = 0; i < count; i++)
        value[i] = -z[i];
}

CLONES void limit_ranges(const method_call *c) {
    const size_t count = c->in->count;
    const double *restrict z = c->in->z, *restrict hi = c->in->hi;
    double *restrict value = c->out->value;
    for (size_t i = 0; i < count; i++)
        value[i] = hi[i] - z[i];
}

CLONES static void negate(const float *restrict from, float *restrict to, size_t count) {
    for (size_t i = 0; i < count; i++)
        to[i] = -from[i];
}

void limit_windows(const method_call *c) {
    negate(c->in->d, c->out->eye, c->in->count);
}

CLONES void limit_codes(const method_call *c) {
    const size_t count = c->in->count;
    const float *restrict d = c->in->d;
    uint32_t *restrict code = c->out->code;
    for (size_t i = 0; i < count; i++)
        code[i] = (uint32_t)(int32_t)d[i];
}

/* One plane in, three out: by blocks, because three streams at the same distance from a page get in each other's way.
 */
static void planes(const float *from, const method_call *c) {
    const size_t count = c->in->count;
    for (size_t at = 0; at < count; at += BLOCK)
        for (int k = 0; k < 3; k++)
            negate(from + at, c->out->place[k] + at, count - at < BLOCK ? count - at : BLOCK);
}

void limit_places(const method_call *c) {
    planes(c->in->d, c);
}

void limit_eyes(const method_call *c) {
    planes(c->in->eye, c);
}
