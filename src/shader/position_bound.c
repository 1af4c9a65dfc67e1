/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Each rounding counts one unit of 2^-24 in the term that it rounds, in each of the world's three coordinates by
 * itself. A sum with 0 and a difference of numbers within a factor of two are exact.
 */
#include "shader/position.h"

#include <math.h>

#include "core/bits.h"

static double length(const double x[3]) {
    return sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
}

/* A pixel and its depth: what the bounds are made of. World axes, from the camera but for `world`. */
typedef struct pixel {
    double u, v;                       /* from the left, from the top */
    double right[3], top[3];           /* half extents; per unit of eye depth, as the next, unless orthographic */
    double across[3], up[3], ahead[3]; /* the pixel's ray is their sum; orthographic: the offset is without `ahead` */
    double ray[3];
    double depth[3]; /* what an error of the eye depth moves: the place; orthographic: its part along the view axis */
    double place[3], world[3];
    double scale; /* the ray's factor: eye depth; orthographic: 1 */
} pixel;

static pixel pixel_of(const texture_camera *camera, uint32_t row, uint32_t column, double d) {
    const double sx = camera_slope_x(camera, column), sy = camera_slope_y(camera, row);
    const double z = decode_exact(&camera->setup, DECODE_EYE, d);
    pixel p = {.u = (column + 0.5) / camera->width, .v = (row + 0.5) / camera->height, .scale = camera->ortho ? 1 : z};
    position_exact(camera, row, column, d, p.place, p.world);
    for (int k = 0; k < 3; k++) {
        p.right[k] = camera->axis[0][k] * camera->half[0];
        p.top[k] = camera->axis[1][k] * camera->half[1];
        p.across[k] = camera->axis[0][k] * sx;
        p.up[k] = camera->axis[1][k] * sy;
        p.ahead[k] = camera->ortho ? 0 : camera->axis[2][k];
        p.ray[k] = p.across[k] + p.up[k] + p.ahead[k];
        p.depth[k] = camera->ortho ? camera->axis[2][k] * z : p.place[k];
    }
    return p;
}

/*
 * From the camera, by the eye depth that `row` gives: the ray's roundings but for its last sum, and `more` that its
 * product with the eye depth has. In perspective the ray's last sum is one of these; orthographic it stands by itself.
 */
static void from_camera(const texture_camera *camera, const pixel *p, double d, const decode_row *row, double more,
                        const double ray[3], double off[3]) {
    const double z_off = decode_bound(row, &camera->setup, d) / DP_UNIT;
    for (int k = 0; k < 3; k++) {
        off[k] = ray[k] * p->scale + (z_off + more) * fabs(p->depth[k]);
        if (camera->ortho)
            off[k] += fabs(p->ray[k]) + fabs(p->place[k]);
    }
}

/* The camera's place is rounded, and the sum with it; nothing is where it is 0. */
static double to_world(const texture_camera *camera, const pixel *p, double off[3]) {
    for (int k = 0; k < 3; k++)
        if (camera->origin[k] != 0)
            off[k] += fabs(camera->origin[k]) + fabs(p->world[k]);
    return length(off);
}

double view_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d) {
    const pixel p = pixel_of(camera, row, column, d);
    double ray[3], off[3];
    for (int k = 0; k < 3; k++) /* step and product; base */
        ray[k] = 2 * fabs(p.across[k]) + fabs(p.up[k] + p.ahead[k]);
    from_camera(camera, &p, d, &decode_rows[DECODE_COMPLEMENT], 2, ray, off);
    return to_world(camera, &p, off);
}

static void extents_off(const texture_camera *camera, const pixel *p, double d, double off[3]) {
    double ray[3];
    for (int k = 0; k < 3; k++) { /* top left; extent, product and the two of u; likewise v; the first sum */
        ray[k] =
            fabs(p->ahead[k] - p->right[k] + p->top[k]) + 8 * p->u * fabs(p->right[k]) + 8 * p->v * fabs(p->top[k]);
        ray[k] += fabs(p->across[k] + p->top[k] + p->ahead[k]);
    }
    from_camera(camera, p, d, decode_usual(&camera->setup), 4, ray, off);
}

double extents_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d) {
    const pixel p = pixel_of(camera, row, column, d);
    double off[3];
    extents_off(camera, &p, d, off);
    return to_world(camera, &p, off);
}

double half_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d) {
    const pixel p = pixel_of(camera, row, column, d);
    double off[3];
    extents_off(camera, &p, d, off);
    for (int k = 0; k < 3; k++) {
        const double most = fabs(p.place[k]) + off[k] * DP_UNIT;
        if (most >= 65504)
            return (double)INFINITY;
        off[k] += fmax(most * 0x1p13, 0x1p-1); /* half a step of binary16, or of its subnormals, 2^-25 */
    }
    return to_world(camera, &p, off);
}

double rays_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d) {
    const pixel p = pixel_of(camera, row, column, d);
    double ray[3], off[3];
    for (int k = 0; k < 3; k++) {
        /* difference and product over the height, those of v; difference and product over the width, two of u */
        ray[k] = (p.v <= 0.5 ? 5 : 4) * fabs(p.top[k]) + 8 * p.u * fabs(p.right[k]);
        for (int side = -1; side <= 1; side += 2) { /* of the left and right edge: corners, sum */
            const double edge = p.ahead[k] + side * p.right[k], share = side < 0 ? 1 - p.u : p.u;
            ray[k] +=
                share * ((p.v * fabs(edge - p.top[k]) + (1 - p.v) * fabs(edge + p.top[k])) + fabs(edge + p.up[k]));
        }
    }
    from_camera(camera, &p, d, decode_usual(&camera->setup), 4, ray, off);
    return to_world(camera, &p, off);
}

/* ---- Matrix ------------------------------------------------------------------------------------------------------ */

enum { CLIP_X, CLIP_Y, CLIP_Z, CLIP_W };

typedef struct matrix {
    double forth[16], back[16];
    double ndc[4];     /* of the pixel and its depth */
    double from[3][4]; /* how the place moves with what each row of `forth` gives there, in clip w */
    double clip_w;
} matrix;

static bool matrix_of(matrix *m, const texture_camera *camera, const pixel *p, double d) {
    const bool is_signed = dp_mapping_get(camera->setup.spec.mapping)->ndc_signed != 0;
    const double ndc[4] = {2 * p->u - 1, 1 - 2 * p->v, is_signed ? 2 * d - 1 : d, 1};
    position_matrix(camera, m->forth);
    position_inverse(camera, m->back);
    m->clip_w = p->scale;
    for (int k = 0; k < 3; k++) { /* 1/z = back[14] D + back[15] */
        m->ndc[k] = ndc[k];
        m->from[k][CLIP_X] = p->right[k];
        m->from[k][CLIP_Y] = p->top[k];
        m->from[k][CLIP_Z] = camera->ortho ? m->back[4 * k + 2] : -m->back[14] * p->place[k];
        m->from[k][CLIP_W] = 0; /* orthographic: 0, 0, 0, 1 is not rounded */
        for (int i = 0; i < 3 && !camera->ortho; i++)
            m->from[k][CLIP_W] += m->from[k][i] * ndc[i];
    }
    m->ndc[CLIP_W] = 1;
    return p->scale < (double)INFINITY;
}

/* The error of a row of `forth` times (place, one), where each entry is off by a unit of itself. */
static double row_off(const matrix *m, int row, const double place[3], double one) {
    double sum = fabs(m->forth[4 * row + 3]) * one;
    for (int k = 0; k < 3; k++)
        sum += fabs(m->forth[4 * row + k] * place[k]);
    return sum;
}

/*
 * The error from the rounding of the matrix, which the engine then inverts. The place solves three equations,
 * (M_i - ndc_i M_w) (place, 1) = 0, whose rounding moves it by `from` times what each is off by: by the camera's own
 * place where the place is that of another camera, and not by the product of large numbers in M and its inverse. M_w
 * is in all three, so what it does to them is added with its sign. Orders beyond the first matter where the camera is
 * millions of eye depths away.
 * @return false where the errors could grow without end
 */
static bool rounded_matrix(const matrix *m, const double world[3], double off[3]) {
    double moved[3] = {world[0], world[1], world[2]}, one = 1;
    for (int k = 0; k < 3; k++)
        off[k] = 0;
    for (int times = 0; times < 60; times++) {
        bool small = true;
        double wrong[4];
        for (int i = 0; i < 4; i++)
            wrong[i] = row_off(m, i, moved, one);
        for (int k = 0; k < 3; k++) {
            double term = 0;
            for (int i = 0; i < 4; i++)
                term += fabs(m->from[k][i]) * wrong[i];
            off[k] += term;
            small = small && term <= 1e-6 * off[k];
            moved[k] = term * DP_UNIT;
        }
        if (small)
            return true;
        one = 0;
    }
    return false;
}

/* The inverse's entry and product, and the sums of two and of three terms. Each row is rounded by itself, so what the
 * rows have in common, the camera's place, does not cancel: this is where a matrix loses. */
static double summed(const matrix *m, int row) {
    static const double roundings[4] = {2, 2, 2, 1};
    double sum = 0, partial = 0;
    for (int k = 0; k < 4; k++) {
        const double term = m->back[4 * row + k] * m->ndc[k];
        partial += term;
        sum += roundings[k] * fabs(term) + (k == 1 || k == 2 ? fabs(partial) : 0);
    }
    return sum;
}

/* The error of an NDC coordinate, twice a share less 1: that of the share, and of the difference. */
static double ndc_off(double share, double share_off) {
    return 2 * share_off + (share <= 0.25 ? 0.5 : 0);
}

/*
 * The inversion adds nothing that shows: position_prepare() squares the 2^-53 that elimination loses. `left` is what
 * may be left of the divisor w. It is of second order, as are the later terms of rounded_matrix(): each is h times the
 * bound where a place may be off by h of its distance. To need half of it an error must come within h/2 of the bound,
 * but bounds on bounds are used to form it: the places found take at most 0.43 of the bound where h/2 is 0.08. So the
 * tests hold the share.
 */
double matrix_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d) {
    const pixel p = pixel_of(camera, row, column, d);
    const bool is_signed = dp_mapping_get(camera->setup.spec.mapping)->ndc_signed != 0;
    const double ndc[3] = {ndc_off(p.u, 2 * p.u), ndc_off(p.v, 2 * p.v), is_signed ? ndc_off(d, 0) : 0};
    matrix m;
    double off[3], most[3], w_off = 0, w_sum = 1; /* the sum */
    if (!matrix_of(&m, camera, &p, d) || !rounded_matrix(&m, p.world, off))
        return (double)INFINITY;
    for (int k = 0; k < 3; k++)
        most[k] = fabs(p.world[k]) + off[k];
    if (!camera->ortho) { /* its last sum, the place's and the quotient */
        w_off = row_off(&m, CLIP_W, most, 1) / m.clip_w;
        w_sum = summed(&m, CLIP_W) * m.clip_w + 3;
    }
    const double rounded = 1 - w_off * DP_UNIT, left = rounded * rounded * (1 - w_sum * DP_UNIT);
    if (!(rounded > 0.5 && left > 0.125))
        return (double)INFINITY;
    for (int k = 0; k < 3; k++) {
        off[k] += (summed(&m, k) * m.clip_w + fabs(p.world[k]) * w_sum) / left;
        for (int i = 0; i < 3; i++)
            off[k] += fabs(m.from[k][i]) * m.clip_w * ndc[i];
    }
    return length(off);
}
