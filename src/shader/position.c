/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The constants that an engine prepares for a camera; the exact place; the matrix and its condition. */
#include "shader/position.h"

#include <float.h>
#include <math.h>

#include "core/engine.h"

static bool has_matrix(const dp_setup *setup) {
    return dp_mapping_get(setup->spec.mapping)->curve == DP_CURVE_PERSPECTIVE;
}

bool position_applies(const position_row *row, const texture_camera *camera) {
    const bool divides = !(camera->ortho && row->by_far) || camera->setup.spec.zfar != 0;
    return (camera->ortho ? row->ortho : row->perspective) && (row->curved || has_matrix(&camera->setup)) && divides;
}

/* ---- Matrices ---------------------------------------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Clip depth = a z + b and NDC depth = (a z + b)/z (perspective) or a z + b, for window depth d: from d's own a and b,
 * doubled and moved by w where NDC is signed. */
static void clip_row(const dp_setup *s, double *a, double *b) {
    const double n = s->spec.znear, f = s->spec.zfar, sign = s->reversed ? -1 : 1;
    if (s->spec.ortho) {
        *a = sign / (f - n);
        *b = (s->reversed ? f : -n) / (f - n);
    } else if (isinf(f)) {
        *a = s->reversed ? 0 : 1;
        *b = -sign * n;
    } else {
        *a = sign * (s->reversed ? n : f) / (f - n);
        *b = -sign * n * (f / (f - n));
    }
    if (dp_mapping_get(s->spec.mapping)->ndc_signed) {
        const double moved = s->spec.ortho || isinf(f) ? 2 * *a - 1 : sign * ((f + n) / (f - n));
        *a = s->spec.ortho ? 2 * *a : moved;
        *b = s->spec.ortho ? -sign * ((f + n) / (f - n)) : 2 * *b;
    }
}

void position_matrix(const texture_camera *camera, double m[16]) {
    double a, b;
    clip_row(&camera->setup, &a, &b);
    const double scale[4] = {1 / camera->half[0], 1 / camera->half[1], a, camera->ortho ? 0 : 1};
    const double base[4] = {0, 0, b, camera->ortho ? 1 : 0};
    for (int r = 0; r < 4; r++) {
        const double *axis = camera->axis[r < 2 ? r : 2];
        for (int k = 0; k < 3; k++)
            m[4 * r + k] = scale[r] * axis[k];
        m[4 * r + 3] = base[r] - scale[r] * dot(axis, camera->origin);
    }
}

/* The homogeneous place is right hx X + up hy Y + forward + origin t with t = 1/z = a D + b (orthographic: eye depth
 * a D + b along forward, t = 1), D being NDC depth. */
void position_inverse(const texture_camera *camera, double m[16]) {
    const dp_setup *s = &camera->setup;
    const double n = s->spec.znear, f = s->spec.zfar, sign = s->reversed ? 1 : -1;
    double a, b;
    if (camera->ortho) {
        a = -sign * (f - n);
        b = s->reversed ? f : n;
    } else {
        a = sign * (isinf(f) ? 1 / n : (f - n) / n / f);
        b = 1 / (s->reversed ? f : n);
    }
    if (dp_mapping_get(s->spec.mapping)->ndc_signed) {
        a /= 2;
        b = camera->ortho ? (n + f) / 2 : (1 / n + 1 / f) / 2;
    }
    for (int k = 0; k < 3; k++) {
        const double along = camera->ortho ? camera->axis[2][k] : camera->origin[k];
        const double rest = camera->ortho ? camera->origin[k] : camera->axis[2][k];
        m[4 * k] = camera->axis[0][k] * camera->half[0];
        m[4 * k + 1] = camera->axis[1][k] * camera->half[1];
        m[4 * k + 2] = along * a;
        m[4 * k + 3] = rest + along * b;
    }
    m[12] = m[13] = 0;
    m[14] = camera->ortho ? 0 : a;
    m[15] = camera->ortho ? 1 : b;
}

/*
 * One step of Newton's, X + X (1 - M X), the difference formed with twice the digits: what the elimination lost is
 * squared, so that the rounding to binary32 is the one that shows.
 */
static void refine(const double m[16], double inverse[16]) {
    double rest[16], more[16];
    for (int i = 0; i < 16; i++) {
        double sum = i % 5 == 0 ? 1 : 0, lost = 0;
        for (int k = 0; k < 4; k++) {
            const dp_pair product = dp_two_product(-m[i - i % 4 + k], inverse[4 * k + i % 4]);
            const dp_pair added = dp_two_sum(sum, product.hi);
            sum = added.hi;
            lost += added.lo + product.lo;
        }
        rest[i] = sum + lost;
    }
    for (int i = 0; i < 16; i++) {
        more[i] = 0;
        for (int k = 0; k < 4; k++)
            more[i] += inverse[i - i % 4 + k] * rest[4 * k + i % 4];
    }
    for (int i = 0; i < 16; i++)
        inverse[i] += more[i];
}

/* By elimination, with the largest pivot of each column. @return false of a singular one */
static bool eliminate(const double m[16], double inverse[16]) {
    double rows[4][8] = {{0}};
    for (int i = 0; i < 16; i++) {
        rows[i / 4][i % 4] = m[i];
        rows[i / 4][4 + i % 4] = i % 5 == 0 ? 1 : 0;
    }
    for (int c = 0; c < 4; c++) {
        int pivot = c;
        for (int i = c + 1; i < 4; i++)
            pivot = fabs(rows[i][c]) > fabs(rows[pivot][c]) ? i : pivot;
        for (int k = 0; k < 8; k++) {
            const double above = rows[c][k];
            rows[c][k] = rows[pivot][k];
            rows[pivot][k] = above;
        }
        for (int i = 0; i < 4 && rows[c][c] != 0; i++) {
            const double share = rows[i][c] / rows[c][c];
            for (int k = c; k < 8 && i != c; k++)
                rows[i][k] -= share * rows[c][k];
        }
        if (rows[c][c] == 0)
            return false;
    }
    for (int i = 0; i < 16; i++)
        inverse[i] = rows[i / 4][4 + i % 4] / rows[i / 4][i / 4];
    return true;
}

/* As an engine does: the matrix in binary32, inverted with care, the inverse in binary32 again. */
static void invert(const texture_camera *camera, float out[16]) {
    double m[16], inverse[16];
    position_matrix(camera, m);
    for (int i = 0; i < 16; i++)
        m[i] = (double)(float)m[i];
    const bool regular = eliminate(m, inverse);
    if (regular)
        refine(m, inverse);
    for (int i = 0; i < 16; i++)
        out[i] = regular ? (float)inverse[i] : (float)NAN;
}

static double of_columns(const double m[16], int j, int k) {
    return m[j] * m[k] + m[4 + j] * m[4 + k] + m[8 + j] * m[8 + k] + m[12 + j] * m[12 + k];
}

/* Rotates two columns until they are orthogonal. @return false where they were */
static bool rotate(double m[16], int j, int k) {
    const double a = of_columns(m, j, j), b = of_columns(m, k, k), both = of_columns(m, j, k);
    if (fabs(both) <= 4 * DBL_EPSILON * sqrt(a) * sqrt(b))
        return false;
    const double half = (b - a) / (2 * both);
    const double tangent = (half < 0 ? -1 : 1) / (fabs(half) + sqrt(1 + half * half));
    const double cosine = 1 / sqrt(1 + tangent * tangent), sine = cosine * tangent;
    for (int i = 0; i < 16; i += 4) {
        const double x = m[i + j], y = m[i + k];
        m[i + j] = cosine * x - sine * y;
        m[i + k] = sine * x + cosine * y;
    }
    return true;
}

/* Singular values are the lengths of columns that were made orthogonal (Jacobi's method, which converges fast). */
double position_condition(const texture_camera *camera) {
    double m[16], least = (double)INFINITY, most = 0;
    if (!has_matrix(&camera->setup))
        return (double)NAN;
    position_matrix(camera, m);
    bool turned = true;
    for (int sweep = 0; turned && sweep < 32; sweep++) {
        turned = false;
        for (int j = 0; j < 4; j++)
            for (int k = j + 1; k < 4; k++)
                turned = rotate(m, j, k) || turned;
    }
    for (int j = 0; j < 4; j++) {
        least = fmin(least, sqrt(of_columns(m, j, j)));
        most = fmax(most, sqrt(of_columns(m, j, j)));
    }
    return least > most * DBL_EPSILON ? most / least : (double)INFINITY;
}

/* ---- Constants --------------------------------------------------------------------------------------------------- */

void position_prepare(position_state *s, const texture_camera *camera) {
    const dp_setup *setup = &camera->setup;
    const double n = setup->spec.znear, f = setup->spec.zfar, hx = camera->half[0], hy = camera->half[1];
    const double plane = camera->ortho ? 1 : n; /* how much larger the half extents are on the near plane */
    *s = (position_state){.camera = camera,
                          .usual = decode_usual(setup)->constants(setup),
                          .best = decode_rows[DECODE_COMPLEMENT].constants(setup),
                          .ndc_scale = 1,
                          .inverse_width = (float)(1.0 / camera->width),
                          .inverse_height = (float)(1.0 / camera->height),
                          .middle = (float)((camera->width - 1.0) / 2),
                          .znear = (float)n,
                          .inverse_near = (float)(1 / n),
                          .inverse_far = (float)(1 / f)};
    if (dp_mapping_get(setup->spec.mapping)->ndc_signed) {
        s->ndc_scale = 2;
        s->ndc_base = -1;
    }
    for (int k = 0; k < 3; k++) {
        const double right = camera->axis[0][k] * hx * plane, up = camera->axis[1][k] * hy * plane;
        const double ahead = camera->ortho ? 0 : camera->axis[2][k] * n;
        for (int c = 0; c < 4; c++)
            s->corner[c][k] = (float)(ahead + (c % 2 != 0 ? right : -right) + (c >= 2 ? up : -up));
        s->top_left[k] = (float)(ahead - right + up);
        s->x_extent[k] = (float)(2 * right);
        s->y_extent[k] = (float)(-2 * up);
        s->z_extent[k] = camera->ortho ? (float)(camera->axis[2][k] * f) : 0;
        s->origin[k] = (float)camera->origin[k];
        s->step[k] = (float)(camera->axis[0][k] * (2 * hx / camera->width));
        s->forward[k] = (float)camera->axis[2][k];
    }
    if (has_matrix(setup))
        invert(camera, s->inverse);
}

/* ---- Exactly ----------------------------------------------------------------------------------------------------- */

void position_exact(const texture_camera *camera, uint32_t row, uint32_t column, double d, double relative[3],
                    double world[3]) {
    double view[3], place[3];
    camera_view(camera, column, row, decode_exact(&camera->setup, DECODE_EYE, d), view);
    camera_turn(camera, view, place);
    for (int k = 0; k < 3; k++) {
        if (relative != NULL)
            relative[k] = place[k];
        if (world != NULL)
            world[k] = camera->origin[k] + place[k];
    }
}

double position_bound(const position_row *row, const texture_camera *camera, uint32_t i, uint32_t j, float d) {
    const double units = row->bound(camera, j, i, (double)d);
    return isnan(units) ? (double)INFINITY : units * DP_UNIT * (1 + 0x1p-18); /* products of small errors */
}
