/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Effects that need the world position of the pixel. */
#include "core/elementary.h"
#include "shader/effect_rows.h"

/* ---- Height ------------------------------------------------------------------------------------------------------ */

static double height(const effect_view *view, double z) {
    return view->base[1] + times(view->along[1], z);
}

double height_apart(const effect_view *view, const double *p, double z, double other) {
    (void)p;
    return fabs(times(view->along[1], minus(z, other)));
}

double water_line(const effect_view *view, const double *p, double z, double reference) {
    (void)reference;
    const double below = p[WATER_LEVEL] - height(view, z);
    return p[WATER_BAND] > 0 ? saturate(below / p[WATER_BAND]) : below > 0;
}

float water_line_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    (void)reference;
    const float below = p[WATER_LEVEL] - pixel->world[1];
    return p[WATER_BAND] > 0 ? saturatef(below / p[WATER_BAND]) : pixel->world[1] < p[WATER_LEVEL] ? 1.0f : 0.0f;
}

/* Where end is start, all is before or behind it. */
double height_share(const effect_view *view, const double *p, double z) {
    const double above = minus(height(view, z), p[HEIGHT_START]);
    return above == 0 ? 0 : above / (p[HEIGHT_END] - p[HEIGHT_START]);
}

double height_fog(const effect_view *view, const double *p, double z, double reference) {
    (void)reference;
    return saturate(height_share(view, p, z) * p[HEIGHT_DENSITY]);
}

float height_fog_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    (void)reference;
    const float above = pixel->world[1] - p[HEIGHT_START];
    const float share = above == 0.0f ? 0.0f : above / (p[HEIGHT_END] - p[HEIGHT_START]);
    return saturatef(share * p[HEIGHT_DENSITY]);
}

/* ---- Last frame -------------------------------------------------------------------------------------------------- */

/* Where the camera of last frame saw the place; infinite where that was behind it. */
static double last_ndc(const effect_view *view, int k, double z) {
    const double w = view->last.w + times(view->last.w_per, z);
    if (!(w > 0))
        return (double)INFINITY;
    if (isinf(z))
        return view->last.w_per != 0 ? view->last.per[k] / view->last.w_per
                                     : (view->last.from[k] + times(view->last.per[k], z)) / w;
    return (view->last.from[k] + view->last.per[k] * z) / w;
}

void velocity_exact(const effect_view *view, const double *p, double z, double out[2]) {
    for (int k = 0; k < 2; k++)
        out[k] = p[0] / 2 * (view->ndc[k] - last_ndc(view, k, z));
}

double velocity(const effect_view *view, const double *p, double z, double reference) {
    double way[2];
    (void)reference;
    velocity_exact(view, p, z, way);
    return dp_hypot(way[0], way[1]);
}

/* A quotient of two linear functions moves by (from w_per - per w)(z' - z)/(w(z) w(z')): nothing cancels. */
double velocity_apart(const effect_view *view, const double *p, double z, double other) {
    (void)p;
    const double near = fmin(z, other), far = fmax(z, other);
    const double w[2] = {view->last.w + view->last.w_per * near, view->last.w + times(view->last.w_per, far)};
    double moved[2];
    if (!(w[0] > 0 && w[1] > 0))
        return z == other ? 0 : (double)INFINITY;
    const double way =
        isinf(far) && view->last.w_per != 0 ? 1 / (w[0] * view->last.w_per) : minus(far, near) / (w[0] * w[1]);
    for (int k = 0; k < 2; k++)
        moved[k] = times(view->last.from[k] * view->last.w_per - view->last.per[k] * view->last.w, way);
    return dp_hypot(moved[0], moved[1]) / 2;
}

static void halfway(const effect_pixel *pixel, float out[2]) {
    float clip[3];
    for (int k = 0; k < 3; k++) {
        const float *m = pixel->last[k];
        clip[k] = m[0] * pixel->world[0] + m[1] * pixel->world[1] + m[2] * pixel->world[2] + m[3];
    }
    for (int k = 0; k < 2; k++)
        out[k] = (pixel->ndc[k] - clip[k] / clip[2]) / 2.0f;
}

float velocity_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    float way[2];
    (void)reference;
    halfway(pixel, way);
    return sqrtf(way[0] * way[0] + way[1] * way[1]) * p[0];
}

void velocity_vector(const effect_pixel *pixel, const float *p, float out[2]) {
    halfway(pixel, out);
    out[0] *= p[0];
    out[1] *= p[0];
}

/* ---- Decals ------------------------------------------------------------------------------------------------------ */

/* The decal's matrix: from world places to its unit box. Row k is its axis over its size there. */
static void decal_matrix(const double p[PARAMETERS_MAX], double m[3][4]) {
    const double turn = p[DECAL_YAW] * DP_DEGREE, c = dp_cos(turn), s = dp_sin(turn);
    const double axes[3][3] = {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
    for (int k = 0; k < 3; k++) {
        m[k][3] = 0;
        for (int i = 0; i < 3; i++) {
            m[k][i] = axes[k][i] / p[DECAL_WIDTH + k];
            m[k][3] -= m[k][i] * p[DECAL_X + i];
        }
    }
}

/* How deep a place lies inside the box, scene units; negative outside. */
double decal_inside(const effect_view *view, const double *p, double z) {
    double m[3][4], inside = HUGE_VAL;
    decal_matrix(p, m);
    for (int k = 0; k < 3; k++) {
        double at = m[k][3];
        for (int i = 0; i < 3; i++)
            at += m[k][i] * (view->base[i] + times(view->along[i], z));
        inside = fmin(inside, (0.5 - fabs(at)) * p[DECAL_WIDTH + k]);
    }
    return inside;
}

/* That is the least of six linear functions, each the way to a face, so it is largest at an end or where one that rises
 * meets one that falls: the lowest such place. */
double decal_most(const effect_view *view, const double *p, double lo, double hi) {
    double m[3][4], from[6], per[6], peak = (double)NAN, lowest = HUGE_VAL;
    decal_matrix(p, m);
    for (int k = 0; k < 6; k++) {
        const double *row = m[k / 2], side = (k % 2 == 0 ? 1 : -1) * p[DECAL_WIDTH + k / 2];
        const double *b = view->base, *a = view->along;
        from[k] = p[DECAL_WIDTH + k / 2] / 2 + side * (row[0] * b[0] + row[1] * b[1] + row[2] * b[2] + row[3]);
        per[k] = side * (row[0] * a[0] + row[1] * a[1] + row[2] * a[2]);
    }
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            const double z = (from[j] - from[i]) / (per[i] - per[j]);
            if (per[i] > 0 && per[j] < 0 && from[i] + per[i] * z < lowest) {
                lowest = from[i] + per[i] * z;
                peak = z;
            }
        }
    const double ends = fmax(decal_inside(view, p, lo), decal_inside(view, p, hi));
    return peak > lo && peak < hi ? fmax(ends, decal_inside(view, p, peak)) : ends;
}

/* Towards or away from a face, on the axis on which the pixel's ray runs fastest. */
double decal_apart(const effect_view *view, const double *p, double z, double other) {
    double m[3][4], fastest = 0;
    decal_matrix(p, m);
    for (int k = 0; k < 3; k++) {
        const double along = m[k][0] * view->along[0] + m[k][1] * view->along[1] + m[k][2] * view->along[2];
        fastest = fmax(fastest, fabs(along) * p[DECAL_WIDTH + k]);
    }
    return times(fastest, fabs(minus(z, other)));
}

double decal(const effect_view *view, const double *p, double z, double reference) {
    (void)reference;
    const double inside = decal_inside(view, p, z);
    return p[DECAL_FEATHER] > 0 ? saturate(inside / p[DECAL_FEATHER]) : inside >= 0;
}

float decal_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    double given[PARAMETERS_MAX], m[3][4];
    float inside = INFINITY;
    (void)reference;
    for (int i = 0; i < PARAMETERS_MAX; i++)
        given[i] = (double)p[i];
    decal_matrix(given, m);
    for (int k = 0; k < 3; k++) {
        const float at = (float)m[k][0] * pixel->world[0] + (float)m[k][1] * pixel->world[1] +
                         (float)m[k][2] * pixel->world[2] + (float)m[k][3];
        inside = fminf(inside, (0.5f - fabsf(at)) * p[DECAL_WIDTH + k]);
    }
    if (p[DECAL_FEATHER] > 0)
        return saturatef(inside / p[DECAL_FEATHER]);
    return inside >= 0 ? 1.0f : 0.0f;
}
