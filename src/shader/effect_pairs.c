/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Effects that compare two pixels, and what keeps them quiet on a plane. */
#include "shader/effect_rows.h"

/* ---- Edges ------------------------------------------------------------------------------------------------------- */

double edge(const effect_view *view, const double *p, double z, double reference) {
    return fabs(z - reference) / view->setup->spec.zfar > p[EDGE_THRESHOLD];
}

float edge_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    return fabsf(pixel->eye01 - reference->eye01) > p[EDGE_THRESHOLD] ? 1.0f : 0.0f;
}

void edge_critical(const effect_view *view, const double *p, double seen, const double apart[2], double out[2]) {
    (void)p, (void)seen;
    for (int i = 0; i < 2; i++)
        out[i] = apart[i] / view->setup->spec.zfar;
}

/* Two pixels are one where the differences of normals and of depths, times their parameters, stay below this. */
static const double SAME = 0.1;

double outline(const effect_view *view, const double *p, double z, double reference) {
    const double turned =
        fabs(view->normals[0][0] - view->normals[1][0]) + fabs(view->normals[0][1] - view->normals[1][1]);
    return turned * p[OUTLINE_NORMAL] >= SAME || fabs(z - reference) * p[OUTLINE_DEPTH] >= SAME * z;
}

float outline_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    const float x = fabsf(pixel->normal[0] - reference->normal[0]), y = fabsf(pixel->normal[1] - reference->normal[1]);
    const float apart = fabsf(pixel->eye01 - reference->eye01) * p[OUTLINE_DEPTH];
    return (x + y) * p[OUTLINE_NORMAL] >= (float)SAME || apart >= (float)SAME * pixel->eye01 ? 1.0f : 0.0f;
}

/* On a plane all normals are alike: the depths decide. */
void outline_critical(const effect_view *view, const double *p, double seen, const double apart[2], double out[2]) {
    (void)view, (void)p;
    for (int i = 0; i < 2; i++)
        out[i] = SAME * seen / apart[1 - i];
}

/* ---- Ambient occlusion ------------------------------------------------------------------------------------------- */

double occlusion(const effect_view *view, const double *p, double z, double reference) {
    (void)view;
    const double before = minus(z, reference);
    return before > p[OCCLUSION_BIAS] && before < p[OCCLUSION_RADIUS];
}

float occlusion_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    const float before = pixel->eye - reference->eye;
    return before > p[OCCLUSION_BIAS] && before < p[OCCLUSION_RADIUS] ? 1.0f : 0.0f;
}

/* The last difference is the last below the radius. */
void occlusion_critical(const effect_view *view, const double *p, double seen, const double apart[2], double out[2]) {
    (void)view, (void)seen;
    out[0] = 0;
    out[1] = apart[0] < p[OCCLUSION_RADIUS] ? apart[1] : 0;
}

/* ---- Shadows ----------------------------------------------------------------------------------------------------- */

/* The first sample behind the surface is a step and what the surface comes nearer behind it, at most. */
void contact_critical(const effect_view *view, const double *p, double seen, const double apart[2], double out[2]) {
    (void)view, (void)seen;
    for (int i = 0; i < 2; i++)
        out[i] = p[CONTACT_STEP] + apart[i];
}

/* Half a texel beside its middle the plane lies half a slope behind what the texel saw. */
void shadow_critical(const effect_view *view, const double *p, double seen, const double apart[2], double out[2]) {
    (void)view, (void)seen;
    for (int i = 0; i < 2; i++)
        out[i] = apart[i] + p[SHADOW_SLOPE] / 2;
}
