/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/synthetic.h"

#include <math.h>

#include "core/elementary.h"

#define LENGTH "scene units", 1e-9, 1e15

static const synthetic_hit SKY = {.z = INFINITY};

static bool drawn(const texture_camera *c, double z) {
    return z >= c->setup.spec.znear && z <= c->setup.spec.zfar; /* false for NaN */
}

/* A surface that faces the camera, where it is drawn and nearer than what is there. */
static void face(const texture_camera *camera, double z, int surface, synthetic_hit *out) {
    if (drawn(camera, z) && z < out->z)
        *out = (synthetic_hit){z, {0, 0, -1}, surface};
}

/* Depth `index` of `count` from lo to hi, both exact, at equal distances or in equal ratios. */
static double spaced(double lo, double hi, double index, double count, bool even) {
    const double share = index / (count - 1);
    return index <= 0 ? lo : index >= count - 1 ? hi : even ? lo + (hi - lo) * share : lo * dp_pow(hi / lo, share);
}

/* Which of `count` equal parts of `length` pixels a place lies in. */
static double part(double place, uint32_t length, double count, double *within) {
    const double at = (place + 0.5) / length * count, whole = fmin(fmax(floor(at), 0), count - 1);
    *within = at - whole;
    return whole;
}

enum { PLANE_DISTANCE, PLANE_TILT, PLANE_TURN };

/* The plane goes through (0, 0, distance): n . p = n_z distance. */
static void plane_hit(const texture_camera *c, const double *p, double column, double row, synthetic_hit *out) {
    const double tilt = p[PLANE_TILT] * DP_DEGREE, turn = p[PLANE_TURN] * DP_DEGREE;
    const double n[3] = {dp_cos(tilt) * dp_sin(turn), dp_sin(tilt), -dp_cos(tilt) * dp_cos(turn)};
    const double side = n[0] * camera_slope_x(c, column) + n[1] * camera_slope_y(c, row);
    const double z = c->ortho ? p[PLANE_DISTANCE] - side / n[2] : n[2] * p[PLANE_DISTANCE] / (side + n[2]);
    *out = SKY;
    if ((c->ortho || side + n[2] < 0) && drawn(c, z))
        *out = (synthetic_hit){z, {n[0], n[1], n[2]}, 1};
}

enum { SPHERE_DISTANCE, SPHERE_RADIUS, SPHERE_WALL };

static void sphere_hit(const texture_camera *c, const double *p, double column, double row, synthetic_hit *out) {
    const double x = camera_slope_x(c, column), y = camera_slope_y(c, row), across = x * x + y * y;
    const double d = p[SPHERE_DISTANCE], r = p[SPHERE_RADIUS];
    /* Perspective: |z (x, y, 1) - (0, 0, d)| = r, the nearer root written so that nothing cancels. */
    const double outside = (d - r) * (d + r);
    const double root = sqrt(c->ortho ? r * r - across : r * r - across * outside);
    const double z = c->ortho ? d - root : outside / (d + root);
    *out = SKY;
    if (drawn(c, z) && d > r) {
        double view[3];
        camera_view(c, column, row, z, view);
        *out = (synthetic_hit){z, {view[0] / r, view[1] / r, (view[2] - d) / r}, 1};
    }
    if (p[SPHERE_WALL] > 0)
        face(c, p[SPHERE_WALL], 2, out);
}

enum { STEPS_FROM, STEPS_TO, STEPS_COUNT, STEPS_EVEN };

static double step_depth(const double *p, double index) {
    return spaced(p[STEPS_FROM], p[STEPS_TO], index, p[STEPS_COUNT], p[STEPS_EVEN] > 0);
}

static void steps_hit(const texture_camera *c, const double *p, double column, double row, synthetic_hit *out) {
    double within;
    const double step = part(column, c->width, p[STEPS_COUNT], &within);
    (void)row;
    *out = SKY;
    face(c, step_depth(p, step), 1 + (int)step, out);
}

static bool steps_pair(const double *p, size_t index, synthetic_pair *out) {
    const double a = step_depth(p, (double)index), b = step_depth(p, (double)index + 1);
    *out = (synthetic_pair){fmin(a, b), fmax(a, b), {((double)index + 1) / p[STEPS_COUNT], 0.5}};
    return (double)index + 1 < p[STEPS_COUNT];
}

enum { DECALS_GAP, DECALS_FROM, DECALS_TO, DECALS_COUNT };

static double wall_depth(const double *p, double index) {
    return spaced(p[DECALS_FROM], p[DECALS_TO], index, p[DECALS_COUNT] * p[DECALS_COUNT], false);
}

/* Tiles of wall, row by row ever farther, and a decal in the middle half of each. */
static void decals_hit(const texture_camera *c, const double *p, double column, double row, synthetic_hit *out) {
    double x, y;
    const double i = part(column, c->width, p[DECALS_COUNT], &x), j = part(row, c->height, p[DECALS_COUNT], &y);
    const double index = j * p[DECALS_COUNT] + i, wall = wall_depth(p, index);
    *out = SKY;
    face(c, wall, 1 + 2 * (int)index, out);
    if (fabs(x - 0.5) < 0.25 && fabs(y - 0.5) < 0.25)
        face(c, wall - p[DECALS_GAP], 2 + 2 * (int)index, out);
}

static bool decals_pair(const double *p, size_t index, synthetic_pair *out) {
    const double wall = wall_depth(p, (double)index), n = p[DECALS_COUNT];
    *out = (synthetic_pair){
        wall - p[DECALS_GAP], wall, {(fmod((double)index, n) + 0.5) / n, (floor((double)index / n) + 0.5) / n}};
    return (double)index < n * n;
}

/* clang-format off */
const synthetic_row synthetic_rows[] = {
    [SYNTHETIC_PLANE] = {"plane", NULL, "a plane, seen head-on or slanted", NULL, plane_hit, NULL, {
     {"distance", "eye depth in the middle of the image", LENGTH, 10, .whole = false},
     {"tilt", "the upper side leans back; 90 would be a floor", "degrees", -89.9, 89.9, 0, .whole = false},
     {"turn", "the right side leans back", "degrees", -89.9, 89.9, 0, .whole = false}}},
    [SYNTHETIC_SPHERE] = {"sphere", NULL, "a sphere on the view axis, in front of a wall or the sky", NULL, sphere_hit,
     NULL, {
     {"distance", "eye depth of the centre, more than the radius", LENGTH, 10, .whole = false},
     {"radius", "of the sphere", LENGTH, 3, .whole = false},
     {"wall", "eye depth of the wall; 0: sky", "scene units", 0, 1e15, 0, .whole = false}}},
    [SYNTHETIC_STEPS] = {"steps", NULL, "upright stairs that face the camera", NULL, steps_hit, steps_pair, {
     {"from", "eye depth of the leftmost", LENGTH, 1, .whole = false},
     {"to", "eye depth of the rightmost", LENGTH, 300, .whole = false},
     {"count", "how many", "steps", 2, 65536, 16, .whole = true},
     {"even", "0: in equal ratios of depth; 1: at equal distances", "", 0, 1, 0, .whole = true}}},
    [SYNTHETIC_DECALS] = {"decals", NULL, "a decal in front of each tile of a wall, the tiles in equal ratios of depth",
     NULL, decals_hit, decals_pair, {
     {"gap", "from a decal to the wall behind it", LENGTH, 0.01, .whole = false},
     {"from", "eye depth of the first tile, top left", LENGTH, 1, .whole = false},
     {"to", "eye depth of the last tile, bottom right", LENGTH, 300, .whole = false},
     {"count", "in a row, and rows", "decals", 2, 1024, 8, .whole = true}}},
};
/* clang-format on */

NAMED_TABLE(synthetic, synthetic_rows);

void synthetic_codes(const synthetic_row *synthetic, const texture_camera *camera, const double *parameters,
                     uint32_t row, uint32_t *codes) {
    enum { SOME = 512 };
    double z[SOME];
    dp_batch batch;
    const bool good =
        dp_batch_init(&batch, &camera->setup, DP_TASK_CODE, DP_REAL_DOUBLE, DP_WORD_32, dp_path_best()) == DP_OK;
    for (uint32_t first = 0; first < camera->width && good; first += SOME) {
        const uint32_t count = camera->width - first < SOME ? camera->width - first : SOME;
        for (uint32_t i = 0; i < count; i++) {
            synthetic_hit hit;
            synthetic->hit(camera, parameters, first + i, row, &hit);
            z[i] = hit.z;
        }
        dp_batch_run(&batch, z, codes + first, count);
    }
}
