/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "transform.h"

#include <math.h>

#include "core/clip.h"

/* clang-format off */
static const view_row rows[] = {
    {"origin", {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, "the identity: nothing is lost before the projection"},
    {"street", {12.5, 1.75, -40.25}, {0.6, -0.1, 0.79}, "a person in a town, tens of units from the origin"},
    {"aerial", {310.7, 120.3, -95.4}, {-0.37, -0.41, 0.83}, "an aircraft, hundreds of units from the origin"},
};

/* Which products are added first: ((a + b) + c) + d, then (a + b) + (c + d). */
static const unsigned char orders[ORDER_COUNT][4] = {
    {0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 1, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {0, 3, 2, 1},
    {1, 2, 0, 3}, {1, 2, 3, 0}, {1, 3, 0, 2}, {1, 3, 2, 0}, {2, 3, 0, 1}, {2, 3, 1, 0},
    {0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2},
};
/* clang-format on */

enum { ROW_COUNT = sizeof rows / sizeof rows[0], FIRST_PAIRED = 12 };

size_t view_count(void) {
    return ROW_COUNT;
}

const view_row *view_get(size_t index) {
    return index < ROW_COUNT ? &rows[index] : NULL;
}

static void normalize(double v[3]) {
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

static void unit_forward(const view_row *view, double forward[3]) {
    for (int i = 0; i < 3; i++)
        forward[i] = view->forward[i];
    normalize(forward);
}

dp_status transform_init(transform *t, const dp_setup *setup, const view_row *view, int precomposed, unsigned order) {
    if (t == NULL || setup == NULL || view == NULL)
        return DP_ERROR_NULL;
    dp_pipeline pipeline;
    if (order >= ORDER_COUNT || setup->spec.ortho || dp_pipeline_init(&pipeline, setup) != DP_OK)
        return DP_ERROR_MODEL;
    double forward[3];
    unit_forward(view, forward);
    *t = (transform){.pipeline = pipeline, .precomposed = precomposed != 0, .order = order};
    for (int i = 0; i < 3; i++)
        t->view[i] = (float)forward[i];
    t->view[3] = (float)-(forward[0] * view->eye[0] + forward[1] * view->eye[1] + forward[2] * view->eye[2]);
    for (int i = 0; i < 4; i++)
        t->clip[i] = pipeline.a * t->view[i];
    t->clip[3] += pipeline.b;
    return DP_OK;
}

/* value + x y, fused or not */
static float add_product(const transform *t, float value, float x, float y) {
    if (t->pipeline.arith->fused)
        return fmaf(x, y, value);
    const float product = x * y;
    return value + product;
}

static float dot(const transform *t, const float row[4], const float point[4]) {
    const unsigned char *o = orders[t->order];
    const float first = add_product(t, row[o[0]] * point[o[0]], row[o[1]], point[o[1]]);
    if (t->order >= FIRST_PAIRED) {
        const float second = add_product(t, row[o[2]] * point[o[2]], row[o[3]], point[o[3]]);
        return first + second;
    }
    const float sum = add_product(t, first, row[o[2]], point[o[2]]);
    return add_product(t, sum, row[o[3]], point[o[3]]);
}

void transform_vertex(const transform *t, const float world[3], float *clip, float *w) {
    const float point[4] = {world[0], world[1], world[2], 1.0f};
    *w = dot(t, t->view, point);
    const float value = t->precomposed ? dot(t, t->clip, point) : dp_clip_project(&t->pipeline, *w);
    *clip = dp_clip_remap(&t->pipeline, value, *w);
}

uint32_t transform_code(const transform *t, const float world[3]) {
    float clip, w;
    transform_vertex(t, world, &clip, &w);
    return dp_pipeline_convert(&t->pipeline, dp_clip_window(&t->pipeline, clip, w));
}

void view_point(const view_row *view, double right, double up, double z, float world[3], double *depth) {
    double f[3];
    unit_forward(view, f);
    /* Any frame about the axis will do: start from the world axis that lies least along it. */
    double x[3] = {f[2], 0.0, -f[0]};
    if (fabs(f[1]) > fmax(fabs(f[0]), fabs(f[2])))
        x[0] = 0.0, x[1] = f[2], x[2] = -f[1];
    normalize(x);
    const double y[3] = {f[1] * x[2] - f[2] * x[1], f[2] * x[0] - f[0] * x[2], f[0] * x[1] - f[1] * x[0]};
    double ahead = 0.0;
    for (int i = 0; i < 3; i++) {
        world[i] = (float)(view->eye[i] + right * x[i] + up * y[i] + z * f[i]);
        ahead += f[i] * ((double)world[i] - view->eye[i]);
    }
    if (depth != NULL)
        *depth = ahead;
}
