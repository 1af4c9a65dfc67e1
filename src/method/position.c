/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places of pixels: the rows of shader/position.h, each with a claim for one camera that stands at the origin. */
#include <math.h>
#include <stdlib.h>

#include "method/truth.h"

/* Places are judged out to the farthest finite far plane that there can be, seen along the longest ray. */
static const double farthest = 2e18;

/* Inputs follow one another along lines of the image; the lines are spread over it, the top one first. */
enum { WIDTH = 1024, HEIGHT = 576, NEXT_LINE = 89 };

static uint32_t line_of(size_t i) {
    return (uint32_t)(i / WIDTH * NEXT_LINE % HEIGHT);
}

/* No axis of it is one of the world's. */
static void synthetic(texture_camera *camera, const dp_setup *setup) {
    camera_spec spec = camera_spec_default();
    spec.width = WIDTH;
    spec.height = HEIGHT;
    spec.yaw = 30;
    spec.pitch = -20;
    spec.half_height = setup->spec.znear;
    camera_init(camera, setup, &spec); /* cannot fail: all of it is in range */
}

static void fill(const dp_setup *setup, method_inputs *in) {
    texture_camera camera;
    synthetic(&camera, setup);
    method_windows(setup, in);
    for (size_t i = 0; i < in->count; i++)
        position_exact(&camera, line_of(i), i % WIDTH, (double)in->d[i], &in->place[3 * i], NULL);
}

typedef struct positioning {
    texture_camera camera;
    position_state state;
} positioning;

static void *prepare(const dp_setup *setup) {
    positioning *p = malloc(sizeof *p);
    if (p == NULL)
        return NULL;
    synthetic(&p->camera, setup);
    position_prepare(&p->state, &p->camera);
    return p;
}

static void run(const method_call *c) {
    const positioning *p = c->state;
    const size_t count = c->in->count;
    for (size_t i = 0; i < count; i += WIDTH)
        c->row->position->run(&p->state, line_of(i), 0, c->in->d + i, count - i < WIDTH ? count - i : WIDTH,
                              c->out->place[0] + i, c->out->place[1] + i, c->out->place[2] + i);
}

static bool position_error_at(const method_call *c, size_t i, method_error *error) {
    const double *exact = &c->in->place[3 * i];
    const double distance = sqrt(exact[0] * exact[0] + exact[1] * exact[1] + exact[2] * exact[2]);
    double sum = 0;
    if (!(distance <= farthest)) /* next to an infinite far plane */
        return false;
    if ((c->row->domain & METHOD_HALF) != 0 && !(distance >= 0x1p-13 && distance <= 32752))
        return false;
    if (c->setup->spec.ortho && !c->row->position->ortho)
        return false;
    for (int k = 0; k < 3; k++)
        sum += ((double)c->out->place[k][i] - exact[k]) * ((double)c->out->place[k][i] - exact[k]);
    const double off = isnan(sum) ? (double)INFINITY : sqrt(sum);
    *error = (method_error){off, off / distance, off / truth_step(distance)};
    return true;
}

/* ---- Claims: a standard mapping, 60 degrees and 16:9 ------------------------------------------------------------- */

/* Half a step of binary16, and of its subnormals in two components. */
static double half_claim(double ratio, double a, double b) {
    return method_cancelled(ratio, a, b) + 6e-4;
}

/* ---- Rows, cheapest first ---------------------------------------------------------------------------------------- */

/* LinearEyeDepth, and what the ray and its products lose at the worst pixel, in units: those of position_bound() at its
 * worst over the image and all directions; near, far and the scene's units do not matter then. Those of the matrix with
 * a standard mapping are measured: 1.6 times the worst of 3000. */
#define UNIT            DP_UNIT
#define CANCELLED(a, b) FORMULA_TO(METHOD_CANCELLED, method_cancelled, a, b)
#define HALF            FORMULA_TO(METHOD_CANCELLED, half_claim, 3, 13.8)

/* clang-format off */
static const method_row methods[] = {
    {METHOD_POSITION, "view", "camera + ray z: the ray from the image's middle, z without cancellation",
     {FULL(8.9 * UNIT), FULL(8 * UNIT), FULL(8.9 * UNIT)}, METHOD_INFINITE | METHOD_ORTHO, 0.4, "1", 0,
     "depthprec(7)", run, prepare, free, .position = &position_rows[POSITION_VIEW]},
    {METHOD_POSITION, "extents", "(top left + x extent u + y extent v) eye/n with LinearEyeDepth",
     {CANCELLED(3, 13.8), FULL(17.8 * UNIT), CANCELLED(3, 13.8)}, METHOD_INFINITE, 0.42, "1", 0,
     "URP, ReconstructViewPos in SSAO.hlsl", run, prepare, free, .position = &position_rows[POSITION_EXTENTS]},
    {METHOD_POSITION, "rays",
     "camera + ray eye/n with LinearEyeDepth, the ray between those of the near plane's corners",
     {CANCELLED(3, 13.2), FULL(17.2 * UNIT), CANCELLED(3, 13.2)}, METHOD_INFINITE, 0.45, "1", 0,
     "image effects with _FrustumCornersRay", run, prepare, free, .position = &position_rows[POSITION_RAYS]},
    {METHOD_POSITION, "matrix", "inverse view-projection matrix times NDC, divided by w",
     {CANCELLED(6, 12), FULL(16.7 * UNIT), CANCELLED(3.5, 12)}, METHOD_INFINITE, 0.48, "1", 0,
     "ComputeWorldSpacePosition, the Core package's Common.hlsl", run, prepare, free,
     .position = &position_rows[POSITION_MATRIX]},
    {METHOD_POSITION, "extents-half",
     "extents in binary16, for distances from 2^-13 to 32752; infinite from 65520 on",
     {HALF, FULL(6e-4), HALF}, METHOD_INFINITE | METHOD_HALF, 0.8, "1", 0,
     "URP, ReconstructViewPos in SSAO.hlsl", run, prepare, free, .position = &position_rows[POSITION_EXTENTS_HALF],
     .coarse = "binary16"},
};
/* clang-format on */
static const size_t method_count = sizeof methods / sizeof methods[0];

const method_family_row position_family = {
    .name = "position",
    .summary = "position of a pixel from its binary32 window depth; 60 degrees, 16:9",
    .measure = "error over distance",
    .cases = {{"fp32 d3d", "fp32", DP_MAPPING_D3D, false},
              {"fp32 reversed", "fp32", DP_MAPPING_REVERSED, false},
              {"fp32 gl", "fp32", DP_MAPPING_GL, false}},
    .case_count = 3,
    .inputs = 65536,
    .walked = 4096,
    .per_decade = 2,
    .windows = true,
    .besides = METHOD_BESIDE_ORTHO,
    .methods = methods,
    .method_count = &method_count,
    .fill = fill,
    .judge = position_error_at,
    .limit = limit_places,
};
