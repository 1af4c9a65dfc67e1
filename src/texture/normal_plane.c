/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Planes and the bound on the normals found on them: see "NORMALS FROM DEPTH" in depthprec(7). */
#include <math.h>
#include <string.h>

#include "core/engine.h"
#include "texture/clones.h"
#include "texture/normal.h"

enum { NORMAL_BLOCK = 256 };

DP_INLINE double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Of the rhombus whose sides are the unit vectors: half the angle between these is that of its diagonals' lengths. */
DP_INLINE void diagonals(const double a[3], const double b[3], double *apart, double *along) {
    const double la = sqrt(dot(a, a)), lb = sqrt(dot(b, b));
    double sum = 0, difference = 0;
    for (int i = 0; i < 3; i++) {
        const double ua = a[i] / la, ub = b[i] / lb;
        sum += (ua + ub) * (ua + ub);
        difference += (ua - ub) * (ua - ub);
    }
    *apart = sqrt(difference);
    *along = sqrt(sum);
}

double normal_angle(const double a[3], const double b[3]) {
    double apart, along;
    diagonals(a, b, &apart, &along);
    return 2 * atan2(apart, along);
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

static double cell_error(const texture_camera *camera, const grain *g, double z, double reading) {
    const dp_cell cell = dp_cell_of(&camera->setup, dp_code(&camera->setup, z));
    (void)g;
    return grain_range_error(&camera->setup, cell.stored, cell.lo, cell.hi, reading);
}

static double grain_error(const texture_camera *camera, const grain *g, double z, double reading) {
    return grain_error_of(&camera->setup, g, z, reading);
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

/* The planes of a row: a neighbour of each pixel at a time. */
typedef struct plane_block {
    double normal[3][NORMAL_BLOCK], offset[NORMAL_BLOCK];
} plane_block;

/* What multiplies the depth and what does not are constants of a row but for x. */
TEXTURE_CLONES static void depths_beside(const texture_camera *camera, const plane_block *restrict p, double column,
                                         double row, size_t count, double *restrict z) {
    const texture_camera c = *camera;
    const double y = camera_slope_y(&c, row);
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        const double x = camera_slope_x(&c, column + (double)(int32_t)i);
        const double across = p->normal[0][i] * x + p->normal[1][i] * y;
        const double above = c.ortho ? p->offset[i] - across : p->offset[i];
        z[i] = above / (c.ortho ? p->normal[2][i] : across + p->normal[2][i]);
    }
}

TEXTURE_CLONES static void keep_worst(const dp_spec *spec, const double *restrict z, const double *restrict error,
                                      size_t count, double *restrict worst) {
    const double least = spec->znear, most = spec->zfar;
    for (size_t i = 0; i < count; i++) {
        const double larger = error[i] > worst[i] ? error[i] : worst[i];
        worst[i] = z[i] >= least && z[i] <= most ? larger : (double)INFINITY;
    }
}

static void block_errors(const normal_planes *p, const grain *g, const plane_block *b, size_t first, size_t count,
                         double reading, double *worst) {
    const texture_camera *camera = p->camera;
    double z[NORMAL_BLOCK], error[NORMAL_BLOCK];
    memset(worst, 0, count * sizeof *worst);
    for (int k = 0; k < 5; k++) {
        const int dx = (k == 2) - (k == 1), dy = (k == 4) - (k == 3);
        const double column = (double)first + dx, row = (double)p->row + dy;
        if (row < 0 || row >= camera->height)
            continue;
        const size_t skipped = column < 0 ? 1 : 0;
        const size_t some = count - (column + (double)count > camera->width ? 1 : 0) - skipped;
        depths_beside(camera, b, column, row, count, z);
        grain_errors_of(&camera->setup, g, z + skipped, some, reading, p->memo, error + skipped);
        keep_worst(&camera->setup.spec, z + skipped, error + skipped, some, worst + skipped);
    }
}

/* ---- The bound -------------------------------------------------------------------------------------------------- */

/* A pixel of a plane, and what its bound is made of. */
typedef struct bounding {
    double exact[3];     /* the vector that the method would find without errors: away from the camera, or towards an
                            orthographic one */
    double x, y;         /* the pixel's ray, 0 where they are orthographic */
    double apart, along; /* diagonals(), of the corner that is farthest */
    bool turned;         /* could the errors turn the plane round? */
} bounding;

/* The errors of the vector (a, b, c), orthographic (a, b, -1), that errors of the three depths make: the corners of the
 * cube of errors, for each choice of sides. Signs of the pixel's error, of a and of b, each once. */
static const double corners[][3] = {{-1, 0, 0},   {1, 1, 1},  {-1, -1, 0}, {1, 0, 1},   {-1, 0, -1}, {1, 1, 0},
                                    {-1, -1, -1}, {1, 0, 0},  {1, -1, 1},  {-1, 1, 0},  {1, -1, 0},  {-1, 1, -1},
                                    {1, 1, -1},   {1, 0, -1}, {-1, 0, 1},  {-1, -1, 1}, {1, -1, -1}, {-1, 1, 1}};
enum { CORNERS = sizeof corners / sizeof corners[0] };

DP_INLINE double square_of_cross(const double a[3], const double b[3]) {
    const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return dot(c, c);
}

/* The corner whose vector is farthest from the exact one, by the square of its tangent. */
DP_INLINE void find_farthest(bounding *out, bool ortho, double per_x, double per_y, double error) {
    const double a = 2 * error * per_x, b = 2 * error * per_y, *exact = out->exact;
    double worst = -1, farthest[3] = {0, 0, 0};
    bool turned = false;
#pragma GCC unroll 18
    for (int i = 0; i < CORNERS; i++) {
        const double own = corners[i][0] * error, to_a = corners[i][1] * a, to_b = corners[i][2] * b;
        const double found[3] = {exact[0] + to_a, exact[1] + to_b,
                                 exact[2] + (ortho ? 0 : own - out->x * to_a - out->y * to_b)};
        const double along = dot(exact, found), tangent = square_of_cross(exact, found) / (along * along);
        const bool farther = tangent > worst;
        turned |= !(along > 0);
        worst = farther ? tangent : worst;
        for (int k = 0; k < 3; k++)
            farthest[k] = farther ? found[k] : farthest[k];
    }
    diagonals(exact, farthest, &out->apart, &out->along);
    out->turned = turned;
}

DP_INLINE double half_ulp(double x) { /* dp_half_ulp(), which is not compiled for another instruction set */
    return x < 0x1p-126 ? 0x1p-150 : dp_float64(((dp_bits64(x) >> 52) - 24) << 52);
}

/*
 * What the method rounds, in units: each rounding is a vector of either sign that is added to the exact one, and they
 * turn it most where all are whole. Those of a and b pass into c; those of c have one direction and count together.
 * A component of the unit vector, at most `beside` from the exact one, is rounded by half a unit in its last place.
 */
DP_INLINE double rounding(const bounding *p, bool ortho, double beside) {
    const double *exact = p->exact, direction[3] = {p->x, p->y, 1};
    const double a = exact[0], b = exact[1], x = p->x * a, y = p->y * b;
    const double size = sqrt(dot(exact, exact));
    /* difference, 1 over the step and the product with it; in perspective also the product with a depth */
    const double each = ortho ? 3 : 4;
    /* the sum of the slopes' products and the product of depths: no case is known that shows the second without the
     * first; slopes and their products; the last sum */
    const double inner = fabs(x + y) + fabs(dot(exact, direction));
    const double own = 2 * (fabs(x) + fabs(y)) + inner + fabs(exact[2]);
    double last[3], most = 0;
    for (int i = 0; i < 3; i++)
        last[i] = half_ulp(fabs(exact[i]) / size + beside) / DP_UNIT * size;
#pragma GCC unroll 16
    for (int i = 0; i < 16; i++) {
        const double to_a = i & 1 ? each : -each, to_b = i & 2 ? each : -each;
        const double added[3] = {to_a * a + (i & 4 ? last[0] : -last[0]), to_b * b + (i & 8 ? last[1] : -last[1]),
                                 ortho ? 0 : own + last[2] - to_a * x - to_b * y};
        const double turned = square_of_cross(exact, added);
        most = turned > most ? turned : most; /* fmax here crashes gcc 12 when it compiles for aarch64 */
    }
    return sqrt(most) / (size * size);
}

/* Arrays of a block: gathered from and scattered to the struct above, so that a loop over them becomes vectors. */
typedef struct bound_block {
    double exact[3][NORMAL_BLOCK], x[NORMAL_BLOCK], y, apart[NORMAL_BLOCK], along[NORMAL_BLOCK];
    double angle[NORMAL_BLOCK]; /* to that corner */
    double more[NORMAL_BLOCK];  /* the share that roundings turn a vector between by, at most */
    int64_t turned[NORMAL_BLOCK];
} bound_block;

DP_INLINE void begin_bounds(const texture_camera *camera, bool ortho, const plane_block *restrict p, double column,
                            double row, const double *restrict error, size_t count, bound_block *restrict b) {
    const texture_camera c = *camera;
    const double per_x = c.width / (2 * c.half[0]), per_y = c.height / (2 * c.half[1]);
    const double y = ortho ? 0 : camera_slope_y(&c, row);
    b->y = y;
    for (size_t i = 0; i < count; i++) {
        const double by = ortho ? -p->normal[2][i] : p->offset[i];
        bounding one = {.x = ortho ? 0 : camera_slope_x(&c, column + (double)(int32_t)i), .y = y};
        for (int k = 0; k < 3; k++)
            b->exact[k][i] = one.exact[k] = p->normal[k][i] / by;
        find_farthest(&one, ortho, per_x, per_y, error[i]);
        b->x[i] = one.x;
        b->apart[i] = one.apart;
        b->along[i] = one.along;
        b->turned[i] = one.turned;
    }
}

DP_INLINE void end_bounds(bool ortho, const bound_block *restrict b, const double *restrict error, size_t count,
                          double *restrict bound) {
    for (size_t i = 0; i < count; i++) {
        const bounding one = {.exact = {b->exact[0][i], b->exact[1][i], b->exact[2][i]}, .x = b->x[i], .y = b->y};
        const double worst = b->angle[i], more = b->more[i];
        const double all = (worst + DP_UNIT * rounding(&one, ortho, worst + more)) / (1 - more) + 1e-14; /* in double */
        const bool known = error[i] < (double)INFINITY && b->turned[i] == 0 && worst < M_PI / 2 && more < 0.5;
        bound[i] = known && all < M_PI ? all : M_PI;
    }
}

TEXTURE_CLONES static void begin_perspective(const texture_camera *camera, const plane_block *p, double column,
                                             double row, const double *error, size_t count, bound_block *b) {
    begin_bounds(camera, false, p, column, row, error, count, b);
}

TEXTURE_CLONES static void begin_ortho(const texture_camera *camera, const plane_block *p, double column, double row,
                                       const double *error, size_t count, bound_block *b) {
    begin_bounds(camera, true, p, column, row, error, count, b);
}

TEXTURE_CLONES static void end_perspective(const bound_block *b, const double *error, size_t count, double *bound) {
    end_bounds(false, b, error, count, bound);
}

TEXTURE_CLONES static void end_ortho(const bound_block *b, const double *error, size_t count, double *bound) {
    end_bounds(true, b, error, count, bound);
}

static void block_bounds(const texture_camera *camera, const plane_block *p, double column, double row,
                         const double *error, size_t count, double *bound) {
    bound_block b;
    if (camera->ortho)
        begin_ortho(camera, p, column, row, error, count, &b);
    else
        begin_perspective(camera, p, column, row, error, count, &b);
    for (size_t i = 0; i < count; i++) {
        b.angle[i] = 2 * atan2(b.apart[i], b.along[i]);
        /* Vectors less than a right angle from another form a convex cone: the corners speak for all between. The
         * roundings are those of a vector between, which turn it by at most this share of the angle more. */
        b.more[i] = 24 * DP_UNIT * (1 + hypot(b.x[i], b.y));
    }
    (camera->ortho ? end_ortho : end_perspective)(&b, error, count, bound);
}

double normal_plane_bound(const texture_camera *camera, uint32_t column, uint32_t row, const normal_plane *plane,
                          double error) {
    plane_block p;
    double bound;
    for (int k = 0; k < 3; k++)
        p.normal[k][0] = plane->normal[k];
    p.offset[0] = plane->offset;
    block_bounds(camera, &p, column, row, &error, 1, &bound);
    return bound;
}

/* ---- A row of planes --------------------------------------------------------------------------------------------- */

TEXTURE_CLONES static void gather(const normal_planes *in, size_t first, size_t count, plane_block *restrict p) {
    const texture_camera c = *in->camera;
    const double y = camera_slope_y(&c, in->row);
    for (size_t i = 0; i < count; i++) {
        const double z = in->z[first + i], scale = c.ortho ? 1 : z;
        double n[3];
        for (int k = 0; k < 3; k++)
            p->normal[k][i] = n[k] = (double)in->normal[k][first + i];
        const double view[3] = {camera_slope_x(&c, (double)(int32_t)(first + i)) * scale, y * scale, z};
        p->offset[i] = dot(n, view);
    }
}

void normal_planes_bounds(const normal_planes *in, const grain *g, double reading, double *bounds) {
    plane_block p;
    double error[NORMAL_BLOCK];
    for (size_t first = 0; first < in->camera->width; first += NORMAL_BLOCK) {
        const size_t rest = in->camera->width - first, count = rest < NORMAL_BLOCK ? rest : NORMAL_BLOCK;
        gather(in, first, count, &p);
        block_errors(in, g, &p, first, count, reading, error);
        block_bounds(in->camera, &p, (double)first, in->row, error, count, bounds + first);
        for (size_t i = 0; i < count; i++)
            bounds[first + i] = isinf(error[i]) ? (double)NAN : bounds[first + i];
    }
}
