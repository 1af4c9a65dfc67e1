/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Places of pixels: the rows of texture/position.h, each with a claim for one camera that stands at the origin. */
#include "texture/position.h"

#include <math.h>
#include <stdlib.h>

#include "method/claim.h"
#include "method/method.h"

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

void position_fill(const dp_setup *setup, method_inputs *in) {
    texture_camera camera;
    synthetic(&camera, setup);
    method_windows(setup, in->d, in->count);
    for (size_t i = 0; i < in->count; i++)
        position_exact(&camera, line_of(i), i % WIDTH, (double)in->d[i], &in->place[3 * i], NULL);
}

typedef struct positioning {
    const position_row *row;
    texture_camera camera;
    position_state state;
} positioning;

static void *start(const dp_setup *setup, const char *name) {
    positioning *p = malloc(sizeof *p);
    if (p == NULL)
        return NULL;
    p->row = position_find(name);
    synthetic(&p->camera, setup);
    position_prepare(&p->state, &p->camera);
    return p;
}

static void run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const positioning *p = state;
    (void)setup;
    for (size_t i = 0; i < in->count; i += WIDTH)
        p->row->run(&p->state, line_of(i), 0, in->d + i, in->count - i < WIDTH ? in->count - i : WIDTH,
                    out->place[0] + i, out->place[1] + i, out->place[2] + i);
}

bool position_judge(const method_row *row, const dp_setup *setup, const method_inputs *in, const method_outputs *out,
                    size_t i, method_error *error) {
    const double *exact = &in->place[3 * i];
    const double distance = sqrt(exact[0] * exact[0] + exact[1] * exact[1] + exact[2] * exact[2]);
    double sum = 0;
    if (!(distance <= farthest)) /* next to an infinite far plane */
        return false;
    if ((row->domain & METHOD_HALF) != 0 && !(distance >= 0x1p-13 && distance <= 32752))
        return false;
    if (setup->spec.ortho && !position_find(row->name)->ortho)
        return false;
    for (int k = 0; k < 3; k++)
        sum += ((double)out->place[k][i] - exact[k]) * ((double)out->place[k][i] - exact[k]);
    const float nearest = (float)distance;
    const double off = isnan(sum) ? (double)INFINITY : sqrt(sum),
                 unit = (double)nextafterf(nearest, INFINITY) - (double)nearest;
    *error = (method_error){off, off / distance, off / unit};
    return true;
}

/* ---- Rows, cheapest first ---------------------------------------------------------------------------------------- */

/* clang-format off */
#define OPEN(name, text) static void *name(const dp_setup *setup) { return start(setup, text); }
OPEN(matrix_open, "matrix") OPEN(rays_open, "rays") OPEN(extents_open, "extents") OPEN(half_open, "extents-half")
OPEN(view_open, "view")

/* Claims in units are those of position_bound() at its worst over the image and all directions; near, far and the scene's units do not
 * matter then. */
#define UNIT CLAIM_UNIT
const method_row position_methods[] = {
    {METHOD_POSITION, "view", "camera + ray z: the ray counted from the image's middle, z without cancellation",
     {FULL(8.9 * UNIT), FULL(8 * UNIT), FULL(8.9 * UNIT)}, METHOD_INFINITE | METHOD_ORTHO, 0.4, "1", 0,
     "depthprec(7)", NULL, view_open, run, free},
    {METHOD_POSITION, "extents", "(top left + x extent u + y extent v) eye/n with LinearEyeDepth",
     {FORMULA_TO(claim_extents, CLAIM_CANCELLED), FULL(17.8 * UNIT), FORMULA_TO(claim_extents, CLAIM_CANCELLED)}, METHOD_INFINITE, 0.42, "1", 0,
     "URP, ReconstructViewPos in SSAO.hlsl", NULL, extents_open, run, free},
    {METHOD_POSITION, "rays", "camera + ray eye/n with LinearEyeDepth, the ray between those of the near plane's corners",
     {FORMULA_TO(claim_rays, CLAIM_CANCELLED), FULL(17.2 * UNIT), FORMULA_TO(claim_rays, CLAIM_CANCELLED)}, METHOD_INFINITE, 0.45, "1", 0,
     "image effects with _FrustumCornersRay", NULL, rays_open, run, free},
    {METHOD_POSITION, "matrix", "inverse view-projection matrix times NDC, divided by w",
     {FORMULA_TO(claim_matrix_d3d, CLAIM_CANCELLED), FULL(16.7 * UNIT), FORMULA_TO(claim_matrix_gl, CLAIM_CANCELLED)}, METHOD_INFINITE, 0.48, "1", 0,
     "ComputeWorldSpacePosition, the Core package's Common.hlsl", NULL, matrix_open, run, free},
    {METHOD_POSITION, "extents-half", "extents in binary16, for distances from 2^-13 to 32752; infinite from 65520 on",
     {FORMULA_TO(claim_extents_half, CLAIM_CANCELLED), FULL(6e-4), FORMULA_TO(claim_extents_half, CLAIM_CANCELLED)}, METHOD_INFINITE | METHOD_HALF, 0.8, "1", 0,
     "URP, ReconstructViewPos in SSAO.hlsl", NULL, half_open, run, free},
};
/* clang-format on */
const size_t position_method_count = sizeof position_methods / sizeof position_methods[0];
