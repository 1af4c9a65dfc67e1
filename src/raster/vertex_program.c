/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "raster/vertex_program.h"

#include <math.h>

/* clang-format off */
static const vertex_program rows[] = {
    {"once", NULL, "(P V) x: one matrix, formed in double and rounded; multiply and add from x to the constant",
     "engines that upload view-projection", VERTEX_ONCE, VERTEX_LEFT, false},
    {"products", NULL, "(P V) x: as once, the matrix formed in binary32",
     "shaders and math libraries that multiply float matrices", VERTEX_PRODUCTS, VERTEX_LEFT, false},
    {"separate", NULL, "P (V x): two matrices, multiply and add from x to the constant",
     "shaders that need the view position too", VERTEX_SEPARATE, VERTEX_LEFT, false},
    {"right", NULL, "as once, summed from the constant to x", "order left to the compiler", VERTEX_ONCE,
     VERTEX_RIGHT, false},
    {"pairs", NULL, "as once, summed in pairs: x and y, z and the constant", "vector units with a horizontal add",
     VERTEX_ONCE, VERTEX_PAIRS, false},
    {"fma", NULL, "as once, by fused multiply-add", "GLSL without precise; HLSL mad", VERTEX_ONCE, VERTEX_LEFT, true},
    {"fma-right", NULL, "as right, by fused multiply-add", "a sum of columns, the constant first", VERTEX_ONCE,
     VERTEX_RIGHT, true},
    {"fma-pairs", NULL, "as pairs, by fused multiply-add", "order left to the compiler", VERTEX_ONCE, VERTEX_PAIRS,
     true},
    {"separate-fma", NULL, "as separate, by fused multiply-add", "GLSL without precise; HLSL mad", VERTEX_SEPARATE,
     VERTEX_LEFT, true},
};
/* clang-format on */

NAMED_TABLE(vertex_program, rows);

/* ---- A camera ---------------------------------------------------------------------------------------------------- */

/* The projection in double: clip z is a z + b, from the NDC depths of the planes. */
static void entries_of(const dp_setup *setup, const dp_pipeline *p, double *a, double *b) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    const double zero = p->ndc_signed ? -1.0 : 0.0;
    const double at_near = p->clip_reversed ? 1.0 : zero;
    const double at_far = p->clip_reversed ? zero : 1.0;
    if (p->ortho) {
        *a = (at_far - at_near) / (f - n);
        *b = at_near - *a * n;
    } else {
        *b = (at_near - at_far) * (isinf(f) ? n : n * f / (f - n));
        *a = isinf(f) ? at_far : at_far - *b / f;
    }
}

vertex_camera vertex_camera_of(const dp_setup *setup, const dp_pipeline *pipeline, const double axis[3],
                               const double place[3]) {
    vertex_camera c = {.a = pipeline->a, .b = pipeline->b, .ortho = pipeline->ortho != 0};
    const double view[4] = {axis[0], axis[1], axis[2], -(axis[0] * place[0] + axis[1] * place[1] + axis[2] * place[2])};
    double a, b;
    entries_of(setup, pipeline, &a, &b);
    for (int i = 0; i < 4; i++) {
        const double constant = i == 3 ? b : 0.0;
        c.view[i] = (float)view[i];
        c.once[i] = (float)(a * view[i] + constant);
        c.products[i] = c.a * c.view[i];
    }
    c.products[3] += c.b;
    return c;
}

/* ---- A vertex ---------------------------------------------------------------------------------------------------- */

static float add_product(bool fused, float a, float x, float sum) {
    const float product = a * x;
    return fused ? fmaf(a, x, sum) : product + sum;
}

static float dot(const vertex_program *p, const float row[4], const float x[3]) {
    const bool fused = p->fused;
    float sum;
    if (p->order == VERTEX_RIGHT) {
        sum = add_product(fused, row[2], x[2], row[3]);
        sum = add_product(fused, row[1], x[1], sum);
        return add_product(fused, row[0], x[0], sum);
    }
    const float first = row[0] * x[0];
    sum = add_product(fused, row[1], x[1], first);
    if (p->order == VERTEX_PAIRS)
        return sum + add_product(fused, row[2], x[2], row[3]);
    return add_product(fused, row[2], x[2], sum) + row[3];
}

vertex_clip vertex_run(const vertex_program *p, const vertex_camera *c, const float x[3]) {
    const float eye = dot(p, c->view, x);
    vertex_clip out = {.w = c->ortho ? 1.0f : eye};
    if (p->matrices == VERTEX_SEPARATE)
        out.z = add_product(p->fused, c->a, eye, c->b);
    else
        out.z = dot(p, p->matrices == VERTEX_ONCE ? c->once : c->products, x);
    return out;
}
