/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The effects: each formula exactly, and in binary32 as a shader evaluates it. */
#include "texture/effect.h"

#include <math.h>

static double saturate(double x) {
    return fmin(fmax(x, 0), 1); /* 0 for NaN */
}

static float saturatef(float x) {
    return fminf(fmaxf(x, 0.0f), 1.0f);
}

/* Of two depths beyond all bounds neither is behind the other. */
static double minus(double a, double b) {
    return a == b ? 0 : a - b;
}

static double times(double a, double b) {
    return a == 0 || b == 0 ? 0 : a * b;
}

/* ---- Eye depth, and its share of far ----------------------------------------------------------------------------- */

static double eye_apart(const effect_view *view, const double *p, double z, double other) {
    (void)view, (void)p;
    return fabs(minus(z, other));
}

static double eye01(const effect_view *view, double z) {
    return z / view->setup->spec.zfar;
}

static double eye01_apart(const effect_view *view, const double *p, double z, double other) {
    (void)p;
    return fabs(eye01(view, z) - eye01(view, other));
}

static double intersection(const effect_view *view, const double *p, double z, double reference) {
    (void)view;
    return saturate(fabs(minus(reference, z)) / p[0]);
}

static float intersection_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    return saturatef(fabsf(reference->eye - pixel->eye) / p[0]);
}

static double force_field(const effect_view *view, const double *p, double z, double reference) {
    (void)view;
    return (1 - minus(z, reference)) * p[0];
}

static float force_field_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    return (1.0f - (pixel->eye - reference->eye)) * p[0];
}

static double fog_depth(const effect_view *view, const double *p, double z) {
    (void)p;
    return eye01(view, z);
}

static double fog(const effect_view *view, const double *p, double z, double reference) {
    (void)reference;
    return saturate(eye01(view, z) * p[0]);
}

static float fog_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    (void)reference;
    return saturatef(pixel->eye01 * p[0]);
}

static double scan_line(const effect_view *view, const double *p, double z, double reference) {
    return saturate(fabs(eye01(view, reference) - eye01(view, z)) / p[0]);
}

static float scan_line_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    return saturatef(fabsf(reference->eye01 - pixel->eye01) / p[0]);
}

static double depth_of_field(const effect_view *view, const double *p, double z, double reference) {
    return saturate(fabs(eye01(view, z) - eye01(view, reference)) * p[0]);
}

static float depth_of_field_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    return saturatef(fabsf(pixel->eye01 - reference->eye01) * p[0]);
}

/* ---- World height ------------------------------------------------------------------------------------------------ */

enum { WATER_BAND = 0, WATER_LEVEL };

static double height(const effect_view *view, double z) {
    return view->base[1] + times(view->along[1], z);
}

static double height_apart(const effect_view *view, const double *p, double z, double other) {
    (void)p;
    return fabs(times(view->along[1], minus(z, other)));
}

static double water_line(const effect_view *view, const double *p, double z, double reference) {
    (void)reference;
    const double below = p[WATER_LEVEL] - height(view, z);
    return p[WATER_BAND] > 0 ? saturate(below / p[WATER_BAND]) : below > 0;
}

static float water_line_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    (void)reference;
    const float below = p[WATER_LEVEL] - pixel->world[1];
    return p[WATER_BAND] > 0 ? saturatef(below / p[WATER_BAND]) : pixel->world[1] < p[WATER_LEVEL] ? 1.0f : 0.0f;
}

enum { HEIGHT_DENSITY = 0, HEIGHT_START, HEIGHT_END };

/* Where end is start, all is before or behind it. */
static double height_share(const effect_view *view, const double *p, double z) {
    const double above = minus(height(view, z), p[HEIGHT_START]);
    return above == 0 ? 0 : above / (p[HEIGHT_END] - p[HEIGHT_START]);
}

static double height_fog(const effect_view *view, const double *p, double z, double reference) {
    (void)reference;
    return saturate(height_share(view, p, z) * p[HEIGHT_DENSITY]);
}

static float height_fog_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    (void)reference;
    const float above = pixel->world[1] - p[HEIGHT_START];
    const float share = above == 0.0f ? 0.0f : above / (p[HEIGHT_END] - p[HEIGHT_START]);
    return saturatef(share * p[HEIGHT_DENSITY]);
}

/* ---- Two pixels -------------------------------------------------------------------------------------------------- */

static double edge(const effect_view *view, const double *p, double z, double reference) {
    return fabs(z - reference) / view->setup->spec.zfar > p[0];
}

static float edge_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    return fabsf(pixel->eye01 - reference->eye01) > p[0] ? 1.0f : 0.0f;
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

static double velocity(const effect_view *view, const double *p, double z, double reference) {
    (void)reference;
    return p[0] / 2 * hypot(view->ndc[0] - last_ndc(view, 0, z), view->ndc[1] - last_ndc(view, 1, z));
}

/* A quotient of two linear functions moves by (from w_per - per w)(z' - z)/(w(z) w(z')): nothing cancels. */
static double velocity_apart(const effect_view *view, const double *p, double z, double other) {
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
    return hypot(moved[0], moved[1]) / 2;
}

static float velocity_shader(const effect_pixel *pixel, const float *p, const effect_pixel *reference) {
    float clip[3];
    (void)reference;
    for (int k = 0; k < 3; k++) {
        const float *m = pixel->last[k];
        clip[k] = m[0] * pixel->world[0] + m[1] * pixel->world[1] + m[2] * pixel->world[2] + m[3];
    }
    const float x = (pixel->ndc[0] - clip[0] / clip[2]) / 2.0f, y = (pixel->ndc[1] - clip[1] / clip[2]) / 2.0f;
    return sqrtf(x * x + y * y) * p[0];
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

#define DEPTH_TEXTURE "shaders on Unity's _CameraDepthTexture"

/* clang-format off */
static const effect_row rows[] = {
    {.name = "intersection", .note = "saturate(|eye - scene|/half-width)",
     .parameters = {
         {"half-width", "distance from the surface over which the highlight fades", "scene", 1e-12, 1e12, 0.1,
          .whole = false}},
     .smallest = true, .needs = EFFECT_SECOND_DEPTH, .reference = "the eye depth of the surface", .given = true,
     .source = DEPTH_TEXTURE "; Lorach 2007, Soft particles",
     .kind = EFFECT_FADE, .apart = eye_apart, .output = intersection, .shader = intersection_shader},
    {.name = "force-field", .note = "(1 - (scene - eye)) power",
     .parameters = {{"power", "how fast the glow falls behind the surface", "1/scene", 1e-12, 1e12, 1, .whole = false}},
     .needs = EFFECT_SECOND_DEPTH, .reference = "the eye depth of the surface", .given = true, .source = DEPTH_TEXTURE,
     .kind = EFFECT_GAIN, .apart = eye_apart, .output = force_field, .shader = force_field_shader},
    {.name = "fog", .note = "saturate(eye01 density)",
     .parameters = {{"density", "how thick the fog is at the far plane", "1", 1e-12, 1e12, 1, .whole = false}},
     .eye01 = true, .source = DEPTH_TEXTURE,
     .kind = EFFECT_CLAMPED, .quantity = fog_depth, .output = fog, .shader = fog_shader},
    {.name = "scan-line", .note = "saturate(|cur - eye01|/half-width)",
     .parameters = {{"half-width", "depth over which the line fades, of far", "eye01", 1e-15, 1, 0.01, .whole = false}},
     .smallest = true, .eye01 = true, .needs = EFFECT_SECOND_DEPTH, .reference = "the depth cur of the line",
     .given = true, .source = DEPTH_TEXTURE,
     .kind = EFFECT_FADE, .apart = eye01_apart, .output = scan_line, .shader = scan_line_shader},
    {.name = "water-line", .note = "world y < level; with a band, saturate((level - y)/band)",
     .parameters = {
         [WATER_BAND] = {"band", "height over which the edge is softened, 0 for a hard one", "scene", 0, 1e12, 0,
                         .whole = false},
         [WATER_LEVEL] = {"level", "world height of the water", "scene", -1e12, 1e12, 0, .use = PARAMETER_IMAGE}},
     .wanted = WATER_BAND, .smallest = true, .needs = EFFECT_POSITION, .reference = "the level of the water",
     .source = DEPTH_TEXTURE,
     .kind = EFFECT_FADE, .apart = height_apart, .output = water_line, .shader = water_line_shader},
    {.name = "height-fog", .note = "saturate((y - start)/(end - start) density), y the world height",
     .parameters = {
         [HEIGHT_DENSITY] = {"density", "how thick the fog is at the height end", "1", 1e-12, 1e12, 1, .whole = false},
         [HEIGHT_START] = {"start", "world height where fog begins", "scene", -1e12, 1e12, 0, .whole = false},
         [HEIGHT_END] = {"end", "world height where density is reached", "scene", -1e12, 1e12, -100, .whole = false}},
     .wanted = HEIGHT_DENSITY, .needs = EFFECT_POSITION, .source = DEPTH_TEXTURE,
     .kind = EFFECT_CLAMPED, .quantity = height_share, .output = height_fog, .shader = height_fog_shader},
    {.name = "edge", .note = "|s1 - s4| > threshold, |s2 - s3| > threshold: Roberts' diagonals of eye01",
     .parameters = {
         {"threshold", "difference of two pixels that makes an edge, of far", "eye01", 0, 1, 0.001, .whole = false},
         {"slope", "a plane's change of eye depth from one pixel of a diagonal to the other", "scene", 0, 1e12, 0.1,
          .use = PARAMETER_TABLE},
         {"sample-distance", "from the pixel to each of the four that are compared, on both axes", "pixels", 1, 4, 1,
          .whole = true, .use = PARAMETER_IMAGE}},
     .smallest = true, .eye01 = true, .needs = EFFECT_SECOND_DEPTH, .reference = "the first pixel's place in its cell",
     .source = DEPTH_TEXTURE "; Roberts 1963",
     .kind = EFFECT_STEP, .apart = eye01_apart, .output = edge, .shader = edge_shader},
    {.name = "motion-blur", .note = "|current - last NDC|/2 strength: the world position, seen by last frame's camera",
     .parameters = {{"strength", "blur in pictures, of the way since last frame", "1", 1e-12, 1e12, 1, .whole = false}},
     .needs = EFFECT_POSITION | EFFECT_LAST_FRAME, .source = DEPTH_TEXTURE "; Rosado 2007, GPU Gems 3, chapter 27",
     .kind = EFFECT_GAIN, .apart = velocity_apart, .output = velocity, .shader = velocity_shader},
    {.name = "depth-of-field", .note = "saturate(|eye01 - focus| level)",
     .parameters = {{"level", "how fast the picture blurs away from the focus", "1", 1e-12, 1e15, 10, .whole = false}},
     .eye01 = true, .needs = EFFECT_SECOND_DEPTH, .reference = "the focus", .given = true, .source = DEPTH_TEXTURE,
     .kind = EFFECT_GAIN, .apart = eye01_apart, .output = depth_of_field, .shader = depth_of_field_shader},
};
/* clang-format on */

const effect_row *effect_get(size_t index) {
    return index < sizeof rows / sizeof rows[0] ? &rows[index] : NULL;
}

bool effect_applies(const effect_row *row, const dp_setup *setup) {
    return !row->eye01 || !isinf(setup->spec.zfar);
}
