/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file effect_rows.h  The formulas of effects: between effect_depth.c, effect_world.c and effect_pairs.c, which have
 * them, and effect_rows.c, which makes rows of them.
 */
#ifndef SHADER_EFFECT_ROWS_H
#define SHADER_EFFECT_ROWS_H

#include <math.h>

#include "shader/effect.h"

static inline double saturate(double x) {
    return fmin(fmax(x, 0), 1); /* 0 for NaN */
}

static inline float saturatef(float x) {
    return fminf(fmaxf(x, 0.0f), 1.0f);
}

/** a - b; of two infinite depths neither is behind the other. */
static inline double minus(double a, double b) {
    return a == b ? 0 : a - b;
}

static inline double times(double a, double b) {
    return a == 0 || b == 0 ? 0 : a * b;
}

/* ---- Eye depth, and its share of far ----------------------------------------------------------------------------- */

enum { THICKNESS_BEHIND = 1 };
enum { FORCE_POWER = 0, FORCE_RIM, FORCE_FACING };

effect_apart eye_apart, eye01_apart, along_ray;
effect_quantity fog_depth, fog_distance;
effect_output intersection, soft_particles, force_field, fog, radial_fog, scan_line, depth_of_field, water_depth,
    contact_shadow, shadow_lit;
effect_shader intersection_shader, soft_particles_shader, force_field_shader, fog_shader, radial_fog_shader,
    scan_line_shader, depth_of_field_shader, water_depth_shader, contact_shadow_shader, shadow_lit_shader;

/* ---- The world --------------------------------------------------------------------------------------------------- */

enum { WATER_BAND = 0, WATER_LEVEL };
enum { HEIGHT_DENSITY = 0, HEIGHT_START, HEIGHT_END };
enum { DECAL_FEATHER = 0, DECAL_YAW, DECAL_X, DECAL_Y, DECAL_Z, DECAL_WIDTH, DECAL_HEIGHT, DECAL_DEPTH };

effect_apart height_apart, velocity_apart, decal_apart;
effect_quantity height_share, decal_inside;
effect_most decal_most;
effect_output water_line, height_fog, velocity, decal;
effect_shader water_line_shader, height_fog_shader, velocity_shader, decal_shader;
effect_vector velocity_vector;
effect_exact_vector velocity_exact;

/* ---- Two pixels -------------------------------------------------------------------------------------------------- */

enum { EDGE_THRESHOLD = 0 };
enum { OUTLINE_DEPTH = 0, OUTLINE_NORMAL };
enum { OCCLUSION_BIAS = 0, OCCLUSION_RADIUS };
enum { CONTACT_THICKNESS = 0, CONTACT_STEP };
enum { SHADOW_BIAS = 0, SHADOW_SLOPE };

effect_critical edge_critical, outline_critical, occlusion_critical, contact_critical, shadow_critical;
effect_output edge, outline, occlusion;
effect_shader edge_shader, outline_shader, occlusion_shader;

#endif
