/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Effects that need the eye depth, and another one to compare it with. */
#include "core/elementary.h"
#include "shader/effect_rows.h"

double eye_apart(const effect_view *view, const double *p, double z, double other) {
    (void)view, (void)p;
    return fabs(minus(z, other));
}

static double eye01(const effect_view *view, double z) {
    return z / view->setup->spec.zfar;
}

double eye01_apart(const effect_view *view, const double *p, double z, double other) {
    (void)p;
    return fabs(eye01(view, z) - eye01(view, other));
}

double intersection(const effect_view *view, const double *p, double z, double reference) {
    (void)view;
    return saturate(fabs(minus(reference, z)) / p[0]);
}

float intersection_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    return saturatef(fabsf(reference->eye - pixel->eye) / p[0]);
}

double force_field(const effect_view *view, const double *p, double z, double reference) {
    (void)view;
    return fmax(1 - p[FORCE_FACING] * p[FORCE_RIM], (1 - minus(z, reference)) * p[FORCE_POWER]);
}

float force_field_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    return fmaxf(1.0f - p[FORCE_FACING] * p[FORCE_RIM], (1.0f - (pixel->eye - reference->eye)) * p[FORCE_POWER]);
}

double fog_depth(const effect_view *view, const double *p, double z) {
    (void)p;
    return eye01(view, z);
}

double fog(const effect_view *view, const double *p, double z, double reference) {
    (void)reference;
    return saturate(eye01(view, z) * p[0]);
}

float fog_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    (void)reference;
    return saturatef(pixel->eye01 * p[0]);
}

double fog_distance(const effect_view *view, const double *p, double z) {
    (void)p;
    return eye01(view, z) * view->stretch;
}

double radial_fog(const effect_view *view, const double *p, double z, double reference) {
    (void)reference;
    return saturate(fog_distance(view, p, z) * p[0]);
}

float radial_fog_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    (void)reference;
    return saturatef(pixel->eye01 * pixel->stretch * p[0]);
}

double scan_line(const effect_view *view, const double *p, double z, double reference) {
    return saturate(fabs(eye01(view, reference) - eye01(view, z)) / p[0]);
}

float scan_line_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    return saturatef(fabsf(reference->eye01 - pixel->eye01) / p[0]);
}

double depth_of_field(const effect_view *view, const double *p, double z, double reference) {
    return saturate(fabs(eye01(view, z) - eye01(view, reference)) * p[0]);
}

float depth_of_field_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    return saturatef(fabsf(pixel->eye01 - reference->eye01) * p[0]);
}

/* One-sided: what lies before the particle does not fade it. */
double soft_particles(const effect_view *view, const double *p, double z, double reference) {
    (void)view;
    return saturate(minus(z, reference) / p[0]);
}

float soft_particles_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    return saturatef((pixel->eye - reference->eye) / p[0]);
}

/* ---- Along the view ray ------------------------------------------------------------------------------------------ */

double along_ray(const effect_view *view, const double *p, double z, double other) {
    (void)p;
    return view->stretch * fabs(minus(z, other));
}

double water_depth(const effect_view *view, const double *p, double z, double reference) {
    return -dp_expm1(-p[0] * view->stretch * fmax(minus(z, reference), 0));
}

float water_depth_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    return 1.0f - dp_expf(-p[0] * (fmaxf(pixel->eye - reference->eye, 0.0f) * pixel->stretch));
}

/* ---- Shadows ----------------------------------------------------------------------------------------------------- */

double contact_shadow(const effect_view *view, const double *p, double z, double reference) {
    (void)view;
    const double behind = minus(reference, z);
    return behind >= 0 && behind < p[CONTACT_THICKNESS];
}

float contact_shadow_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    const float behind = reference->eye - pixel->eye;
    return behind >= 0.0f && behind < p[CONTACT_THICKNESS] ? 1.0f : 0.0f;
}

double shadow_lit(const effect_view *view, const double *p, double z, double reference) {
    (void)view;
    return reference - p[SHADOW_BIAS] <= z;
}

float shadow_lit_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    return reference->eye - p[SHADOW_BIAS] <= pixel->eye ? 1.0f : 0.0f;
}
