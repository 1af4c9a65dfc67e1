/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Each rounding counts one unit of 2^-24 in the term that it rounds, in the term's magnitude; a vector whose components
 * are each off by a unit is off by a unit of its length. Lengths of rays are per unit of eye depth.
 */
#include "texture/position_bound.h"

#include <math.h>

#include "texture/decode.h"
#include "texture/position.h"

static double length(double x, double y, double z) {
    return sqrt(x * x + y * y + z * z);
}

/* A pixel and its depth: what the bounds are made of. */
typedef struct pixel {
    double u, v;   /* from the left, from the top */
    double sx, sy; /* slopes or offsets */
    double z;
    double ray;      /* the ray's length; orthographic: the offset's */
    double distance; /* from the camera */
    double origin;
} pixel;

static pixel pixel_of(const texture_camera *camera, uint32_t row, uint32_t column, double d) {
    pixel p = {.u = (column + 0.5) / camera->width,
               .v = (row + 0.5) / camera->height,
               .sx = camera_slope_x(camera, column),
               .sy = camera_slope_y(camera, row),
               .z = decode_exact(&camera->setup, DECODE_EYE, d),
               .origin = length(camera->origin[0], camera->origin[1], camera->origin[2])};
    p.ray = length(p.sx, p.sy, camera->ortho ? 0 : 1);
    p.distance = camera->ortho ? length(p.ray, p.z, 0) : p.ray * p.z;
    return p;
}

/* The units that an eye depth is off by. */
static double decoded(const decode_row *row, const texture_camera *camera, double d) {
    return decode_bound(row, &camera->setup, d) * 0x1p24;
}

/* The camera's place is rounded, and the sum with it; nothing is where it is the origin. */
static double moved(const pixel *p) {
    return p->origin > 0 ? 2 * p->origin + p->distance : 0;
}

double view_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d) {
    const pixel p = pixel_of(camera, row, column, d);
    const double z_off = decoded(decode_best(), camera, d);
    /* step and product, base, sum */
    const double ray_off = 2 * fabs(p.sx) + length(p.sy, camera->ortho ? 0 : 1, 0) + p.ray;
    if (camera->ortho)
        return ray_off + (z_off + 2) * p.z + p.distance + moved(&p);
    return ray_off * p.z + (z_off + 1) * p.distance + moved(&p);
}

double extents_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d) {
    const pixel p = pixel_of(camera, row, column, d);
    const double z_off = decoded(decode_usual(&camera->setup), camera, d);
    const double hx = camera->half[0], hy = camera->half[1], ahead = camera->ortho ? 0 : 1;
    /* top left; extent, product and the two of u; likewise v; the two sums */
    const double ray_off = length(hx, hy, ahead) + 8 * hx * p.u + 8 * hy * p.v + length(p.sx, hy, ahead) + p.ray;
    if (camera->ortho)
        return ray_off + (z_off + 4) * p.z + p.distance + moved(&p);
    return ray_off * p.z + (z_off + 3) * p.distance + moved(&p);
}

double half_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d) {
    const pixel p = pixel_of(camera, row, column, d);
    const double before = extents_bound(camera, row, column, d) - moved(&p);
    double relative[3], half = 0;
    position_exact(camera, row, column, d, relative, NULL);
    for (int k = 0; k < 3; k++) {
        const double most = fabs(relative[k]) + before * 0x1p-24, part = fmax(most * 0x1p13, 0x1p-1);
        if (most >= 65504)
            return (double)INFINITY;
        half += part * part; /* half a step of binary16, or of its subnormals, 2^-25 */
    }
    half = sqrt(half);
    return before + half + (p.origin > 0 ? 2 * p.origin + p.distance + half * 0x1p-24 : 0);
}

double rays_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d) {
    const pixel p = pixel_of(camera, row, column, d);
    const double z_off = decoded(decode_usual(&camera->setup), camera, d);
    const double hx = camera->half[0], hy = camera->half[1];
    /* corners; difference and product over the height, v; sum; difference and product over the width, u; sum */
    const double ray_off = length(hx, hy, 1) + 4 * hy * (1 - p.v) + 4 * hy + length(hx, p.sy, 1) + 8 * hx * p.u + p.ray;
    return ray_off * p.z + (z_off + 3) * p.distance + moved(&p);
}

/* ---- Matrix ------------------------------------------------------------------------------------------------------ */

enum { CLIP_X, CLIP_Y, CLIP_Z, CLIP_W };

typedef struct matrix {
    double forth[16], back[16];
    double ndc[4];     /* of the pixel and its depth */
    double world[3];   /* the place */
    double from[3][3]; /* from the camera: how the place moves with each of the three NDC coordinates */
} matrix;

static bool matrix_of(matrix *m, const texture_camera *camera, const pixel *p, uint32_t row, uint32_t column,
                      double d) {
    const bool is_signed = dp_mapping_get(camera->setup.spec.mapping)->ndc_signed != 0;
    double relative[3], along = 0;
    position_matrix(camera, m->forth);
    position_inverse(camera, m->back);
    position_exact(camera, row, column, d, relative, m->world);
    m->ndc[CLIP_X] = 2 * p->u - 1;
    m->ndc[CLIP_Y] = 1 - 2 * p->v;
    m->ndc[CLIP_Z] = is_signed ? 2 * d - 1 : d;
    m->ndc[CLIP_W] = 1;
    for (int k = 0; k < 3; k++)
        along += camera->axis[2][k] * m->back[4 * k + 2];
    for (int k = 0; k < 3; k++) { /* 1/z = back[14] D + back[15] */
        m->from[k][CLIP_X] = camera->half[0] * fabs(camera->axis[0][k]) * (camera->ortho ? 1 : p->z);
        m->from[k][CLIP_Y] = camera->half[1] * fabs(camera->axis[1][k]) * (camera->ortho ? 1 : p->z);
        m->from[k][CLIP_Z] = camera->ortho ? fabs(camera->axis[2][k] * along) : fabs(m->back[14] * relative[k]) * p->z;
    }
    return p->z < (double)INFINITY;
}

/*
 * Of the rounding of the matrix, which the engine then inverts. The place solves three equations,
 * (M_i - ndc_i M_w) (place, 1) = 0, whose rounding moves it by `from` times what each is off by: by the camera's own
 * place where the place is that of another camera, and not by the product of large numbers in M and its inverse.
 * @return false where the errors could grow without end
 */
static bool rounded_matrix(const matrix *m, double clip_w, double off[3]) {
    double term[3] = {0}, wrong[3];
    for (int i = 0; i < 3; i++) {
        wrong[i] = fabs(m->forth[4 * i + 3]) + fabs(m->ndc[i] * m->forth[15]);
        for (int k = 0; k < 3; k++)
            wrong[i] += (fabs(m->forth[4 * i + k]) + fabs(m->ndc[i] * m->forth[12 + k])) * fabs(m->world[k]);
    }
    for (int times = 0; times < 60; times++) {
        bool small = true;
        for (int k = 0; k < 3; k++) {
            term[k] = 0;
            for (int i = 0; i < 3; i++)
                term[k] += m->from[k][i] * wrong[i] / clip_w;
            off[k] = times == 0 ? term[k] : off[k] + term[k];
            small = small && term[k] <= 1e-6 * off[k];
        }
        if (small)
            return true;
        for (int i = 0; i < 3; i++) {
            wrong[i] = 0;
            for (int k = 0; k < 3; k++)
                wrong[i] += (fabs(m->forth[4 * i + k]) + fabs(m->ndc[i] * m->forth[12 + k])) * term[k] * 0x1p-24;
        }
    }
    return false;
}

/* The inverse's entry, the product and the sums that a term passes through are rounded in each row by itself, so what
 * the rows have in common, the camera's place, does not cancel: this is where a matrix loses. */
static double summed(const matrix *m, int row) {
    static const double roundings[4] = {5, 5, 4, 2};
    double sum = 0;
    for (int k = 0; k < 4; k++)
        sum += roundings[k] * fabs(m->back[4 * row + k] * m->ndc[k]);
    return sum;
}

/*
 * What the inversion in double adds, twelve roundings and pivots of up to four times the entries: 2^-23 units. Cameras
 * do not come near, so no test would notice half of it; it is kept because it is proven, and too small to be seen.
 */
static double inverted(const matrix *m, int row) {
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        double product = fabs(m->forth[4 * i + 3]);
        for (int k = 0; k < 3; k++)
            product += fabs(m->forth[4 * i + k] * m->world[k]);
        sum += fabs(m->back[4 * row + i]) * product;
    }
    return 0x1p-23 * sum;
}

double matrix_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d) {
    const pixel p = pixel_of(camera, row, column, d);
    const bool is_signed = dp_mapping_get(camera->setup.spec.mapping)->ndc_signed != 0;
    matrix m;
    double off[3], sum = 0;
    if (!matrix_of(&m, camera, &p, row, column, d))
        return (double)INFINITY;
    const double clip_w = camera->ortho ? 1 : p.z;
    if (!rounded_matrix(&m, clip_w, off))
        return (double)INFINITY;
    const double ndc_off[3] = {4 * p.u + fabs(m.ndc[CLIP_X]), 4 * p.v + fabs(m.ndc[CLIP_Y]),
                               is_signed ? fabs(m.ndc[CLIP_Z]) : 0};
    /* w of the rounded matrix; of the sum */
    double w_off = fabs(m.forth[15]) / clip_w;
    for (int k = 0; k < 3; k++)
        w_off += fabs(m.forth[12 + k]) * (fabs(m.world[k]) + off[k]) / clip_w;
    const double w_sum = summed(&m, CLIP_W) * clip_w + inverted(&m, CLIP_W);
    const double rounded = 1 - w_off * 0x1p-24, left = rounded * rounded * (1 - w_sum * 0x1p-24);
    if (!(rounded > 0.5 && left > 0.125))
        return (double)INFINITY;
    for (int k = 0; k < 3; k++) {
        const double place = fabs(m.world[k]);
        double part = off[k] + place + (summed(&m, k) * clip_w + inverted(&m, k) + place * w_sum) / left;
        for (int i = 0; i < 3; i++)
            part += m.from[k][i] * ndc_off[i];
        sum += part * part;
    }
    return sqrt(sum);
}
