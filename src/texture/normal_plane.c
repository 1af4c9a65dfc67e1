/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Planes and the bound on the normals found on them: see "NORMALS FROM DEPTH" in depthprec(7). */
#include <math.h>
#include <string.h>

#include "core/engine.h"
#include "texture/normal.h"

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross_product(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

double normal_angle(const double a[3], const double b[3]) {
    const double la = sqrt(dot(a, a)), lb = sqrt(dot(b, b));
    double sum = 0, difference = 0; /* of the unit vectors: sides of a rhombus, whose angle is that of its diagonals */
    for (int i = 0; i < 3; i++) {
        const double ua = a[i] / la, ub = b[i] / lb;
        sum += (ua + ub) * (ua + ub);
        difference += (ua - ub) * (ua - ub);
    }
    return 2 * atan2(sqrt(difference), sqrt(sum));
}

/* What multiplies the eye depth and what does not: a pixel's place is direction z + place. */
static void ray(const texture_camera *camera, double column, double row, double direction[3], double place[3]) {
    const double x = camera_slope_x(camera, column), y = camera_slope_y(camera, row);
    const bool ortho = camera->ortho;
    direction[0] = ortho ? 0 : x;
    direction[1] = ortho ? 0 : y;
    direction[2] = 1;
    place[0] = ortho ? x : 0;
    place[1] = ortho ? y : 0;
    place[2] = 0;
}

normal_plane normal_plane_at(const texture_camera *camera, double column, double row, double z,
                             const double normal[3]) {
    double view[3];
    camera_view(camera, column, row, z, view);
    return (normal_plane){{normal[0], normal[1], normal[2]}, dot(normal, view)};
}

double normal_plane_depth(const texture_camera *camera, const normal_plane *plane, double column, double row) {
    double direction[3], place[3];
    ray(camera, column, row, direction, place);
    return (plane->offset - dot(plane->normal, place)) / dot(plane->normal, direction);
}

/* ---- The error of the stored depths ----------------------------------------------------------------------------- */

static double range_error(const texture_camera *camera, double stored, double lo, double hi, double reading) {
    if (camera->ortho)
        return fmax(stored - lo, hi - stored) + reading * stored;
    const double w = 1 / stored; /* 0 at an infinite far plane */
    return fmax(1 / lo - w, w - 1 / hi) + reading * w;
}

static double cell_error(const texture_camera *camera, const grain *g, double z, double reading) {
    const dp_cell cell = dp_cell_of(&camera->setup, dp_code(&camera->setup, z));
    (void)g;
    return range_error(camera, cell.stored, cell.lo, cell.hi, reading);
}

/* What the image holds of a depth at z may be any sample whose range has z: that of z's code, or one at its ends. */
static double grain_error(const texture_camera *camera, const grain *g, double z, double reading) {
    const dp_setup *setup = &camera->setup;
    const grain_range own = grain_range_of(setup, g, dp_code(setup, z));
    const double at[3] = {z, own.lo, own.hi};
    double worst = 0;
    for (int i = 0; i < 3; i++) {
        const uint32_t code = dp_code(setup, at[i]);
        const grain_range range = grain_range_of(setup, g, code);
        worst = fmax(worst, range_error(camera, dp_stored(setup, code), range.lo, range.hi, reading));
    }
    return worst;
}

typedef double error_at(const texture_camera *camera, const grain *g, double z, double reading);

static double worst_error(const texture_camera *camera, error_at *error, const grain *g, uint32_t column, uint32_t row,
                          const normal_plane *plane, double reading) {
    const dp_spec *spec = &camera->setup.spec;
    double worst = 0;
    for (int i = 0; i < 5; i++) {
        const int x = (i == 2) - (i == 1), y = (i == 4) - (i == 3);
        const double c = (double)column + x, r = (double)row + y;
        if (!(c >= 0 && c < camera->width && r >= 0 && r < camera->height))
            continue;
        const double z = normal_plane_depth(camera, plane, c, r);
        worst = z >= spec->znear && z <= spec->zfar ? fmax(worst, error(camera, g, z, reading)) : (double)INFINITY;
    }
    return worst;
}

double normal_plane_error(const texture_camera *camera, uint32_t column, uint32_t row, const normal_plane *plane,
                          double reading) {
    return worst_error(camera, cell_error, NULL, column, row, plane, reading);
}

double normal_plane_error_of(const texture_camera *camera, const grain *g, uint32_t column, uint32_t row,
                             const normal_plane *plane, double reading) {
    return worst_error(camera, grain_error, g, column, row, plane, reading);
}

/* ---- The bound -------------------------------------------------------------------------------------------------- */

/* The error of the vector (a, b, c), orthographic (a, b, -1), that errors of the three depths make. */
typedef struct mistake {
    const texture_camera *camera;
    double direction[3]; /* of the pixel */
    double per_x, per_y; /* 1 over the step of sx and of sy to the neighbour, with its sign */
} mistake;

static void mistaken(const mistake *m, const double exact[3], double own, double beside, double over, double out[3]) {
    const double a = (beside - own) * m->per_x, b = (over - own) * m->per_y;
    out[0] = exact[0] + a;
    out[1] = exact[1] + b;
    out[2] = exact[2] + (m->camera->ortho ? 0 : own - m->direction[0] * a - m->direction[1] * b);
}

/* The vector that the method would find without errors: away from the camera; orthographic: towards it. */
static void exact_vector(const texture_camera *camera, const normal_plane *plane, double out[3]) {
    const double by = camera->ortho ? -plane->normal[2] : plane->offset;
    for (int i = 0; i < 3; i++)
        out[i] = plane->normal[i] / by;
}

/*
 * What the method rounds, in units: each rounding is a vector of either sign that is added to the exact one, and they
 * turn it most where all are whole. Those of a and b pass into c; those of c have one direction and count together.
 * A component of the unit vector, at most `beside` from the exact one, is rounded by half a unit in its last place.
 */
static double rounding(const texture_camera *camera, const double exact[3], const double direction[3], double beside) {
    const double a = exact[0], b = exact[1], x = direction[0] * a, y = direction[1] * b;
    const double size = sqrt(dot(exact, exact));
    /* difference, 1 over the step and the product with it; in perspective also the product with a depth */
    const double each = camera->ortho ? 3 : 4;
    /* the sum of the slopes' products and the product of depths: no case is known that shows the second without the
     * first; slopes and their products; the last sum */
    const double inner = fabs(x + y) + fabs(dot(exact, direction));
    const double own = 2 * (fabs(x) + fabs(y)) + inner + fabs(exact[2]);
    double last[3], most = 0;
    for (int i = 0; i < 3; i++)
        last[i] = dp_half_ulp(fabs(exact[i]) / size + beside) / DP_UNIT * size;
    for (int i = 0; i < 16; i++) {
        const double to_a = i & 1 ? each : -each, to_b = i & 2 ? each : -each;
        const double added[3] = {to_a * a + (i & 4 ? last[0] : -last[0]), to_b * b + (i & 8 ? last[1] : -last[1]),
                                 camera->ortho ? 0 : own + last[2] - to_a * x - to_b * y};
        double cross[3];
        cross_product(exact, added, cross);
        const double turned = dot(cross, cross);
        most = turned > most ? turned : most; /* fmax here crashes gcc 12 when it compiles for aarch64 */
    }
    return sqrt(most) / (size * size);
}

double normal_plane_bound(const texture_camera *camera, uint32_t column, uint32_t row, const normal_plane *plane,
                          double error) {
    double exact[3], place[3], farthest[3] = {0}, worst = -1; /* tan^2 of the angle, for comparing */
    mistake m = {.camera = camera};
    if (!(error < (double)INFINITY))
        return M_PI;
    exact_vector(camera, plane, exact);
    ray(camera, column, row, m.direction, place);
    for (int i = 0; i < 32; i++) { /* the corners of the cube of errors, for each choice of sides */
        const double own = i & 1 ? error : -error, beside = i & 2 ? error : -error, over = i & 4 ? error : -error;
        double found[3];
        m.per_x = camera->width / (2 * camera->half[0]) * (i & 8 ? 1 : -1);
        m.per_y = camera->height / (2 * camera->half[1]) * (i & 16 ? 1 : -1);
        mistaken(&m, exact, own, beside, over, found);
        double cross[3];
        cross_product(exact, found, cross);
        const double along = dot(exact, found), tangent = dot(cross, cross) / (along * along);
        if (!(along > 0))
            return M_PI;
        if (tangent > worst) {
            worst = tangent;
            memcpy(farthest, found, sizeof farthest);
        }
    }
    worst = normal_angle(exact, farthest);
    /* Vectors less than a right angle from another form a convex cone: the corners speak for all between. The roundings
     * are those of a vector between, which turn it by at most this share of `worst` more. */
    const double more = 24 * DP_UNIT * (1 + hypot(m.direction[0], m.direction[1]));
    if (!(worst < M_PI / 2 && more < 0.5))
        return M_PI;
    return fmin((worst + DP_UNIT * rounding(camera, exact, m.direction, worst + more)) / (1 - more) + 1e-14,
                M_PI); /* in double */
}
