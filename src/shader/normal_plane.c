/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Planes and the bound on the normals found on them: see "NORMALS FROM DEPTH" in depthprec(7). */
#include <math.h>
#include <string.h>

#include "core/clones.h"
#include "core/elementary.h"
#include "core/engine.h"
#include "shader/normal.h"

enum { NORMAL_BLOCK = 256 };

DP_INLINE double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The diagonals of the rhombus of the unit vectors: their lengths give half the angle between the two. */
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
    return 2 * dp_atan2(apart, along);
}

/* The ray of a pixel, whose place at eye depth z is direction z + place. */
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

/* The planes of a row: a neighbour of each pixel at a time. */
typedef struct plane_block {
    double normal[3][NORMAL_BLOCK], offset[NORMAL_BLOCK];
} plane_block;

/* Direction and place of the ray are constants of a row but for x. */
CLONES static void depths_beside(const texture_camera *camera, const plane_block *restrict p, double column, double row,
                                 size_t count, double *restrict z) {
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

CLONES static void keep_worst(const dp_spec *spec, const double *restrict z, const double *restrict error, size_t count,
                              double *restrict worst) {
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

/* ---- Planes in blocks -------------------------------------------------------------------------------------------- */

/* The terms of a block's bounds, an array each, so that loops over it become vectors. */
typedef struct bound_block {
    double exact[3][NORMAL_BLOCK]; /* the vector that the method would find without errors: away from the camera, or
                                      towards an orthographic one */
    double x[NORMAL_BLOCK], y;     /* the pixels' rays, 0 where they are orthographic */
    double z[NORMAL_BLOCK];        /* orthographic: the plane's depth */
    double error[NORMAL_BLOCK];
    double apart[NORMAL_BLOCK], along[NORMAL_BLOCK]; /* of the corner that is farthest: its angle's sine and cosine */
    int64_t turned[NORMAL_BLOCK];                    /* could the errors turn the plane round? */
} bound_block;

DP_INLINE void begin(const texture_camera *camera, bool ortho, const plane_block *restrict p, double column, double row,
                     size_t count, bound_block *restrict b) {
    const texture_camera c = *camera;
    const double y = camera_slope_y(&c, row);
    b->y = ortho ? 0 : y;
    for (size_t i = 0; i < count; i++) {
        const double x = camera_slope_x(&c, column + (double)(int32_t)i);
        const double by = 1 / (ortho ? -p->normal[2][i] : p->offset[i]);
        for (int k = 0; k < 3; k++)
            b->exact[k][i] = p->normal[k][i] * by;
        b->x[i] = ortho ? 0 : x;
        b->z[i] = b->exact[0][i] * x + b->exact[1][i] * y - p->offset[i] * by;
    }
}

/* Along a row 1/z, or z where the camera is orthographic, changes by as much from pixel to pixel. */
DP_INLINE void errors_in_closed_form(const texture_camera *camera, bool ortho, const grain_bound *bound, double column,
                                     double row, size_t count, bound_block *restrict b) {
    const double width = camera->width, step_x = 2 * camera->half[0] / width;
    const double step_y = 2 * camera->half[1] / camera->height, y = b->y;
    const double above = row > 0 ? step_y : 0, below = row + 1 < camera->height ? step_y : 0;
    for (size_t i = 0; i < count; i++) {
        const double at = column + (double)(int32_t)i, ahead = b->exact[1][i] * above, behind = -b->exact[1][i] * below;
        const double left = -b->exact[0][i] * (at > 0 ? step_x : 0);
        const double right = b->exact[0][i] * (at + 1 < width ? step_x : 0);
        const double least_x = left < right ? left : right, most_x = left < right ? right : left;
        const double least_y = ahead < behind ? ahead : behind, most_y = ahead < behind ? behind : ahead;
        const double own = ortho ? b->z[i] : b->exact[0][i] * b->x[i] + b->exact[1][i] * y + b->exact[2][i];
        b->error[i] = grain_bound_of(bound, own + (least_x < least_y ? least_x : least_y),
                                     own + (most_x > most_y ? most_x : most_y));
    }
}

/* ---- The bound -------------------------------------------------------------------------------------------------- */

/* The errors of the vector (a, b, c), orthographic (a, b, -1), that errors of the three depths make: the corners of the
 * cube of errors, for each choice of sides. Signs of a and of b where the pixel's own is positive; the other corners
 * are opposite to these. */
static const double corners[][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
enum { CORNERS = sizeof corners / sizeof corners[0] };

/*
 * The corner whose vector is farthest from the exact one e. A corner adds E d to it, E being the error, with
 * d = own + s alpha + t beta; so the tangent of the angle is E |e x d| / (e . e +- E e . d), which is the larger of
 * the two where e . d counts against it. Fractions are compared without dividing.
 */
DP_INLINE void find_farthest(bool ortho, double alpha, double beta, double y, size_t count, bound_block *restrict b) {
    const double own = ortho ? 0 : 1;
    for (size_t i = 0; i < count; i++) {
        const double e0 = b->exact[0][i], e1 = b->exact[1][i], e2 = b->exact[2][i], x = b->x[i], error = b->error[i];
        const double of_own[3] = {own * e1, -own * e0, 0};
        const double of_a[3] = {-alpha * (x * e1), alpha * (e2 + x * e0), -alpha * e1};
        const double of_b[3] = {-beta * (e2 + y * e1), beta * (y * e0), beta * e0};
        const double on_own = own * e2, on_a = alpha * (e0 - x * e2), on_b = beta * (e1 - y * e2);
        const double length = e0 * e0 + e1 * e1 + e2 * e2;
        double apart = 0, along = 1;
        int64_t turned = 0;
#pragma GCC unroll 9
        for (int k = 0; k < CORNERS; k++) {
            const double s = corners[k][0], t = corners[k][1];
            const double c0 = of_own[0] + s * of_a[0] + t * of_b[0], c1 = of_own[1] + s * of_a[1] + t * of_b[1];
            const double c2 = s * of_a[2] + t * of_b[2], square = c0 * c0 + c1 * c1 + c2 * c2;
            const double left = length - error * fabs(on_own + s * on_a + t * on_b);
            const bool farther = square * (along * along) > apart * (left * left);
            turned |= !(left > 0);
            apart = farther ? square : apart;
            along = farther ? left : along;
        }
        b->apart[i] = error * sqrt(apart);
        b->along[i] = along;
        b->turned[i] = turned;
    }
}

/* The angle whose tangent is sine/cosine, which are not negative, within 1e-15. The polynomial meets
 * (atan(u) - u)/u^3 at the nodes of Chebyshev for u^2 up to 0.1716, the square of tan(pi/8), within 8e-18/u^2. */
DP_INLINE double angle_of(double sine, double cosine) {
    static const double c[] = {-0x1.5555555555555p-2, 0x1.9999999999349p-3, -0x1.2492492436016p-3, 0x1.c71c71852a359p-4,
                               -0x1.745d0b25982f3p-4, 0x1.3b1262bf324fdp-4, -0x1.10fa73c8057afp-4, 0x1.dfe60585956a5p-5,
                               -0x1.a09838b71a7cfp-5, 0x1.415ebcba15fd3p-5, -0x1.3a27dd63af0a7p-6};
    const bool flat = sine<0.41421356 * cosine, steep = sine> 2.41421357 * cosine;
    const double above = flat ? sine : steep ? -cosine : sine - cosine;
    const double below = flat ? cosine : steep ? sine : sine + cosine;
    const double u = above / below, z = u * u;
    double sum = c[10];
#pragma GCC unroll 10
    for (int k = 9; k >= 0; k--)
        sum = sum * z + c[k];
    return (flat ? 0 : steep ? M_PI / 2 : M_PI / 4) + (u + u * z * sum);
}

DP_INLINE double square_of_cross(const double a[3], const double b[3]) {
    const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return dot(c, c);
}

DP_INLINE double half_ulp(double x) { /* dp_half_ulp(), which is not compiled for another instruction set */
    return x < 0x1p-126 ? 0x1p-150 : dp_float64(((dp_bits64(x) >> 52) - 24) << 52);
}

/*
 * The roundings of a method, in units: each is a vector of either sign that is added to the exact one, and they
 * turn it most where all are whole. Those of a and b pass into c; those of c have one direction and count together.
 * A component of the unit vector, at most `beside` from the exact one, is rounded by half a unit in its last place.
 */
DP_INLINE double rounding(const double exact[3], double ray_x, double ray_y, bool ortho, double beside) {
    const double direction[3] = {ray_x, ray_y, 1}, a = exact[0], b = exact[1], x = ray_x * a, y = ray_y * b;
    const double size = sqrt(dot(exact, exact)), share = 1 / size;
    /* difference, 1 over the step and the product with it; in perspective also the product with a depth */
    const double each = ortho ? 3 : 4;
    /* the sum of the slopes' products and the product of depths: no case is known that shows the second without the
     * first; slopes and their products; the last sum */
    const double inner = fabs(x + y) + fabs(dot(exact, direction));
    const double own = 2 * (fabs(x) + fabs(y)) + inner + fabs(exact[2]);
    double last[3], most = 0;
    for (int i = 0; i < 3; i++)
        last[i] = half_ulp(fabs(exact[i]) * share + beside) * (size / DP_UNIT);
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

/*
 * Vectors less than a right angle from another form a convex cone: the corners speak for all between. The roundings are
 * those of a vector between, which turn it by at most the share `more` of the angle more.
 */
DP_INLINE void finish(bool ortho, double y, const bound_block *restrict b, size_t count, double *restrict bound) {
    for (size_t i = 0; i < count; i++) {
        const double exact[3] = {b->exact[0][i], b->exact[1][i], b->exact[2][i]}, x = b->x[i];
        const double worst = angle_of(b->apart[i], b->along[i]), more = 24 * DP_UNIT * (1 + sqrt(x * x + y * y));
        const double rounded = DP_UNIT * rounding(exact, x, y, ortho, worst + more);
        const double all = (worst + rounded) / (1 - more) + 1e-14; /* in double */
        const bool known = b->error[i] < (double)INFINITY && b->turned[i] == 0 && worst < M_PI / 2 && more < 0.5;
        bound[i] = known && all < M_PI ? all : M_PI;
    }
}

/* Bounds from errors that are known, or, where these are null, from those of a closed form. */
DP_INLINE void bounds_of(const texture_camera *camera, bool ortho, const grain_bound *form, const double *error,
                         const plane_block *p, double column, double row, size_t count, double *bound) {
    bound_block b;
    begin(camera, ortho, p, column, row, count, &b);
    if (error != NULL)
        memcpy(b.error, error, count * sizeof *error);
    else
        errors_in_closed_form(camera, ortho, form, column, row, count, &b);
    find_farthest(ortho, camera->width / camera->half[0], camera->height / camera->half[1], b.y, count, &b);
    finish(ortho, b.y, &b, count, bound);
    for (size_t i = 0; i < count; i++)
        bound[i] = b.error[i] < (double)INFINITY ? bound[i] : (double)NAN;
}

CLONES static void bounds_perspective(const texture_camera *camera, const grain_bound *form, const double *error,
                                      const plane_block *p, double column, double row, size_t count, double *bound) {
    bounds_of(camera, false, form, error, p, column, row, count, bound);
}

CLONES static void bounds_ortho(const texture_camera *camera, const grain_bound *form, const double *error,
                                const plane_block *p, double column, double row, size_t count, double *bound) {
    bounds_of(camera, true, form, error, p, column, row, count, bound);
}

static void block_bounds(const texture_camera *camera, const grain_bound *form, const double *error,
                         const plane_block *p, double column, double row, size_t count, double *bound) {
    (camera->ortho ? bounds_ortho : bounds_perspective)(camera, form, error, p, column, row, count, bound);
}

static plane_block block_of(const normal_plane *plane) {
    plane_block p;
    for (int k = 0; k < 3; k++)
        p.normal[k][0] = plane->normal[k];
    p.offset[0] = plane->offset;
    return p;
}

double normal_plane_bound(const texture_camera *camera, uint32_t column, uint32_t row, const normal_plane *plane,
                          double error) {
    const plane_block p = block_of(plane);
    double bound;
    block_bounds(camera, NULL, &error, &p, column, row, 1, &bound);
    return isnan(bound) ? M_PI : bound;
}

double normal_plane_error_of(const texture_camera *camera, const grain *g, uint32_t column, uint32_t row,
                             const normal_plane *plane, double reading) {
    grain_bound form;
    if (!grain_bound_init(&form, &camera->setup, g, reading))
        return worst_error(camera, grain_error, g, column, row, plane, reading);
    const plane_block p = block_of(plane);
    bound_block b;
    begin(camera, camera->ortho, &p, column, row, 1, &b);
    errors_in_closed_form(camera, camera->ortho, &form, column, row, 1, &b);
    return b.error[0];
}

/* ---- A row of planes --------------------------------------------------------------------------------------------- */

CLONES static void gather(const normal_planes *in, size_t first, size_t count, plane_block *restrict p) {
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
    grain_bound form;
    double error[NORMAL_BLOCK];
    const bool known = grain_bound_init(&form, &in->camera->setup, g, reading);
    for (size_t first = 0; first < in->camera->width; first += NORMAL_BLOCK) {
        const size_t rest = in->camera->width - first, count = rest < NORMAL_BLOCK ? rest : NORMAL_BLOCK;
        gather(in, first, count, &p);
        if (!known)
            block_errors(in, g, &p, first, count, reading, error);
        block_bounds(in->camera, &form, known ? NULL : error, &p, (double)first, in->row, count, bounds + first);
    }
}
