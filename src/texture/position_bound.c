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
    double z, far_off;
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

/*
 * With x the homogeneous place and G = |inverse| |matrix|: rounding the matrix by one unit moves x by at most
 * G|x| + units G^2|x| + ...; then the inverse is rounded and the sums are.
 */
static bool rounded_matrix(const texture_camera *camera, const double inverse[16], const double x[4], double off[4]) {
    double matrix[16], term[4];
    position_matrix(camera, matrix);
    for (int i = 0; i < 4; i++) {
        term[i] = fabs(x[i]);
        off[i] = 0;
    }
    for (int times = 0; times < 100; times++) {
        double next[4] = {0}, product[4] = {0};
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 4; k++)
                product[i] += fabs(matrix[4 * i + k]) * term[k];
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 4; k++)
                next[i] += fabs(inverse[4 * i + k]) * product[k];
        bool small = true;
        for (int i = 0; i < 4; i++) {
            off[i] += next[i];
            small = small && next[i] <= 1e-6 * off[i];
            term[i] = next[i] * 0x1p-24;
        }
        if (small)
            return true;
    }
    return false;
}

double matrix_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d) {
    const pixel p = pixel_of(camera, row, column, d);
    const bool is_signed = dp_mapping_get(camera->setup.spec.mapping)->ndc_signed != 0;
    const double ndc = is_signed ? 2 * d - 1 : d;
    const double v[4] = {2 * p.u - 1, 1 - 2 * p.v, ndc, 1};
    const double v_off[4] = {4 * p.u + fabs(v[0]), 4 * p.v + fabs(v[1]), is_signed ? fabs(ndc) : 0, 0};
    double inverse[16], x[4], off[4], sum = 0;
    position_inverse(camera, inverse);
    for (int i = 0; i < 4; i++) {
        x[i] = 0;
        for (int k = 0; k < 4; k++)
            x[i] += inverse[4 * i + k] * v[k];
    }
    if (!camera->ortho)
        x[3] = 1 / p.z; /* without cancellation */
    if (!rounded_matrix(camera, inverse, x, off))
        return (double)INFINITY;
    static const double roundings[4] = {5, 5, 4, 2}; /* entry, product, the sums that the term passes through */
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            off[i] += fabs(inverse[4 * i + k]) * (v_off[k] + roundings[k] * fabs(v[k]));
    const double w = x[3], left = 1 - off[3] / w * 0x1p-24;
    if (!(left > 0.5))
        return (double)INFINITY;
    for (int i = 0; i < 3; i++) {
        const double place = fabs(x[i] / w), part = (off[i] + place * off[3]) / w / left + place;
        sum += part * part;
    }
    return sqrt(sum);
}
