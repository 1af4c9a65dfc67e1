/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The methods of shader/normal.h on slanted planes, stored in the format of a case and read back. Inputs come in
 * strips of METHOD_STRIP pixels of a 1920 x 1080 image with a vertical field of view of 60 degrees, each strip with a
 * plane and a place in the image of its own, and with the pixels around it. Planes are slanted by up to 70 degrees from
 * the line of sight and lie between near and far as far as the methods look. Errors are angles: relative is in radians,
 * which is the relative error of the unit vector, absolute in degrees, ulp in units of 2^-24.
 */
#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "method/method.h"

enum { WIDTH = 1920, HEIGHT = 1080, LINE = METHOD_STRIP_LINE, LINES = METHOD_STRIP_EYES / LINE };

static const double STEEPEST = 70; /* degrees */

/* ---- Planes ------------------------------------------------------------------------------------------------------ */

typedef struct strip {
    uint32_t column, row;
} strip;

static void view_of(const dp_setup *setup, texture_camera *camera) {
    camera_spec spec = camera_spec_default();
    spec.width = WIDTH;
    spec.height = HEIGHT;
    camera_init(camera, setup, &spec);
}

/* Two corners of the image in turn with places by chance. */
static strip strip_of(size_t index) {
    const bool corner = index % 5 < 2;
    const double x = corner ? (double)(index % 5) : method_unit(21, index), y = corner ? x : method_unit(22, index);
    return (strip){.column = NORMAL_REACH + (uint32_t)((WIDTH - METHOD_STRIP - 2 * NORMAL_REACH) * x),
                   .row = NORMAL_REACH + (uint32_t)((HEIGHT - 1 - 2 * NORMAL_REACH) * y)};
}

/* Planes that face the line of sight in turn with slanted ones. */
static void normal_of(const texture_camera *camera, const strip *s, size_t index, double normal[3]) {
    const double tilt = index % 3 == 0 ? 0 : STEEPEST * DP_DEGREE * method_unit(23, index);
    const double turn = 2 * M_PI * method_unit(24, index);
    const double x = camera_slope_x(camera, s->column + METHOD_STRIP / 2), y = camera_slope_y(camera, s->row);
    /* The line of sight (x, y, 1) and two directions across it. */
    const double length = sqrt(x * x + y * y + 1), aside = sqrt(x * x + 1);
    const double sight[3] = {x / length, y / length, 1 / length}, right[3] = {1 / aside, 0, -x / aside};
    const double up[3] = {-x * y / length / aside, aside / length, -y / length / aside};
    for (int i = 0; i < 3; i++)
        normal[i] = dp_sin(tilt) * (dp_cos(turn) * right[i] + dp_sin(turn) * up[i]) - dp_cos(tilt) * sight[i];
}

/* A depth for the middle of a strip with which all of it is between the planes: at far, at near, or by chance. */
static double depth_of(const dp_setup *setup, const texture_camera *camera, const strip *s, const double normal[3],
                       size_t index) {
    const double n = setup->spec.znear, f = isinf(setup->spec.zfar) ? n * METHOD_INFINITE_FAR : setup->spec.zfar;
    const double column = s->column + METHOD_STRIP / 2;
    const normal_plane plane = normal_plane_at(camera, column, s->row, 1, normal);
    double nearest = 1, farthest = 1; /* at the corners, as 1/z is linear */
    for (int i = 0; i < 4; i++) {
        const double z = normal_plane_depth(
            camera, &plane, (double)s->column + (i % 2 ? -NORMAL_REACH : METHOD_STRIP - 1 + NORMAL_REACH),
            (double)s->row + (i / 2 ? -NORMAL_REACH : NORMAL_REACH));
        nearest = fmin(nearest, z);
        farthest = fmax(farthest, z);
    }
    const double lo = n / nearest, hi = f / farthest, share = method_unit(25, index);
    return index % 4 == 0 ? hi : index % 4 == 1 ? lo : lo * dp_pow(hi / lo, share);
}

static void fill(const dp_setup *setup, method_inputs *in) {
    texture_camera camera;
    view_of(setup, &camera);
    for (size_t k = 0; k * METHOD_STRIP < in->count; k++) {
        const strip s = strip_of(k);
        double normal[3];
        normal_of(&camera, &s, k, normal);
        const double depth = depth_of(setup, &camera, &s, normal, k);
        const normal_plane plane = normal_plane_at(&camera, s.column + METHOD_STRIP / 2, s.row, depth, normal);
        for (int j = 0; j < LINES; j++)
            for (int i = 0; i < LINE; i++) {
                const double at = normal_plane_depth(&camera, &plane, (double)s.column + i - NORMAL_REACH,
                                                     (double)s.row + j - NORMAL_REACH);
                const double z = fmin(fmax(at, setup->spec.znear), setup->spec.zfar);
                const size_t pixel = k * METHOD_STRIP + (size_t)(i - NORMAL_REACH);
                in->eye[k * METHOD_STRIP_EYES + (size_t)(j * LINE + i)] = (float)dp_stored(setup, dp_code(setup, z));
                if (j == NORMAL_REACH && i >= NORMAL_REACH && i < NORMAL_REACH + METHOD_STRIP && pixel < in->count)
                    in->z[pixel] = z;
            }
    }
}

static bool normal_error_at(const method_call *c, size_t i, method_error *error) {
    texture_camera camera;
    view_of(c->setup, &camera);
    const strip s = strip_of(i / METHOD_STRIP);
    double normal[3];
    normal_of(&camera, &s, i / METHOD_STRIP, normal);
    float *const *place = c->out->place;
    const double got[3] = {(double)place[0][i], (double)place[1][i], (double)place[2][i]};
    const double angle = normal_angle(normal, got);
    *error = (method_error){angle / DP_DEGREE, angle, angle / DP_UNIT};
    return true;
}

/* ---- The methods ------------------------------------------------------------------------------------------------- */

typedef struct prepared {
    texture_camera camera;
    float slope[WIDTH];
} prepared;

static void *open_view(const dp_setup *setup) {
    prepared *p = malloc(sizeof *p);
    if (p == NULL)
        return NULL;
    view_of(setup, &p->camera);
    for (int i = 0; i < WIDTH; i++)
        p->slope[i] = (float)camera_slope_x(&p->camera, i);
    return p;
}

static void run(const method_call *c) {
    const prepared *p = c->state;
    for (size_t k = 0; k * METHOD_STRIP < c->in->count; k++) {
        const strip s = strip_of(k);
        const size_t first = k * METHOD_STRIP, left = c->in->count - first;
        normal_rows rows = {.camera = &p->camera,
                            .row = s.row,
                            .column = s.column,
                            .count = left < METHOD_STRIP ? (uint32_t)left : METHOD_STRIP,
                            .slope_x = p->slope + s.column};
        for (int j = 0; j < LINES; j++)
            rows.rows[j] = c->in->eye + k * METHOD_STRIP_EYES + (size_t)(j * LINE + NORMAL_REACH);
        c->row->normal->run(&rows, c->out->place[0] + first, c->out->place[1] + first, c->out->place[2] + first);
    }
}

/* ---- Claims: see "NORMALS FROM DEPTH" in depthprec(7) ------------------------------------------------------------ */

/* The angle that errors of depth can make next to each other, `off` of the depth itself, pixels `step` apart. */
static double angle_of(double step, double off) {
    const double y = dp_tan(M_PI / 6), x = y * WIDTH / HEIGHT, apart = 2 * step * y / HEIGHT;
    const double most = 1.01 * (2 * (dp_hypot(1, x) + dp_hypot(1, y)) / apart + 1) * sqrt(1 + x * x + y * y) * off;
    return most < 1 ? dp_asin(most) + 1e-6 : M_PI;
}

/* Half a step of 24 bits, and reading; depths at far are the worst. */
static double unorm_claim(double ratio, double step, double places) {
    return angle_of(step, (ratio - 1) / 2 / 0xffffff + DP_UNIT + places);
}

static double float_claim(double ratio, double step, double places) {
    (void)ratio;
    return angle_of(step, 2 * DP_UNIT + places);
}

/* The error that rounded places add to methods that subtract them, as one of depth. */
#define PLACES (1.6 * DP_UNIT)
#define CLAIMS(to, step, places)                                                                                       \
    { FORMULA_TO(to, unorm_claim, step, places), FORMULA(float_claim, step, places), UNCLAIMED, UNCLAIMED }

/* clang-format off */
static const method_row methods[] = {
    {METHOD_NORMAL, "low", "the 2 x 2 quad of a pixel", CLAIMS(1e3, 1, PLACES), METHOD_INFINITE, 1.0, "1", 0,
     "Universal RP, SSAO.hlsl", run, open_view, free, .normal = &normal_methods[NORMAL_LOW], .coarse = "format"},
    {METHOD_NORMAL, "medium-1", "the farther of the neighbours, next to it",
     CLAIMS(1e3, 1, PLACES), METHOD_INFINITE, 1.05, "1", 0,
     "", run, open_view, free, .normal = &normal_methods[NORMAL_MEDIUM_1], .coarse = "format"},
    {METHOD_NORMAL, "medium", "the farther of the neighbours, 2 pixels away",
     CLAIMS(2e3, 2, PLACES), METHOD_INFINITE, 1.1, "1", 0,
     "Universal RP, SSAO.hlsl", run, open_view, free, .normal = &normal_methods[NORMAL_MEDIUM], .coarse = "format"},
    {METHOD_NORMAL, "projective", "lines in 1/z, next to it; on a plane the differences of 1/z are its normal",
     CLAIMS(1e3, 1, 0), METHOD_INFINITE, 1.3, "1", 0,
     "depthprec(7)", run, open_view, free, .normal = &normal_methods[NORMAL_PROJECTIVE], .coarse = "format"},
    {METHOD_NORMAL, "high-1", "lines in z, next to it", CLAIMS(1e3, 1, PLACES), METHOD_INFINITE, 1.35, "1", 0,
     "", run, open_view, free, .normal = &normal_methods[NORMAL_HIGH_1], .coarse = "format"},
    {METHOD_NORMAL, "high", "lines in z, 2 pixels away", CLAIMS(2e3, 2, PLACES), METHOD_INFINITE, 1.36, "1", 0,
     "Universal RP, SSAO.hlsl", run, open_view, free, .normal = &normal_methods[NORMAL_HIGH], .coarse = "format"},
};
/* clang-format on */
static const size_t method_count = sizeof methods / sizeof methods[0];

const method_family_row normal_family = {
    .name = "normal",
    .summary = "normal of a plane from the stored depths around a pixel",
    .measure = "radians",
    .cases = {{"unorm24 d3d", "unorm24", DP_MAPPING_D3D, false},
              {"fp32 reversed", "fp32", DP_MAPPING_REVERSED, false},
              {"unorm16 d3d", "unorm16", DP_MAPPING_D3D, false},
              {"fp16 reversed", "fp16", DP_MAPPING_REVERSED, false}},
    .case_count = 4,
    .inputs = 16384,
    .walked = 2048,
    .per_decade = 2,
    .methods = methods,
    .method_count = &method_count,
    .fill = fill,
    .judge = normal_error_at,
    .limit = limit_eyes,
};
