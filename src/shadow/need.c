/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The errors that a bias has to cover, and the three that do; depthprec(7), "Shadow maps", derives every line. */
#include <math.h>

#include "core/bits.h"
#include "core/elementary.h"
#include "shadow/shadow.h"

static const double eps = 0x1p-24;

/* Covers terms of second order and this file's own rounding. */
static const double outward = 1.0 + DP_ROUNDINGS32_14;

/* How far the rounding of the light's matrix turns the light, radians. */
static const double turned_light = 4.0 * 0x1p-24;

/* The largest error of a sine that a shader takes from a cosine. */
static const double sine_error = 0x1p-10;

static const double root2 = 1.4142135623730951;

/* The rounding of texture coordinates: Direct3D allows 0.6 of a step. */
static const double rounded_step = 0.6;

static double degrees(double angle) {
    return angle * (3.14159265358979323846 / 180.0);
}

/* ---- What is needed ---------------------------------------------------------------------------------------------- */

/* The terms of several parts and of the slope's own error. Lengths are of scene units, sizes of texels. */
typedef struct ground {
    double depth;            /**< far - near */
    double texel_x, texel_y; /**< scene units */
    double diagonal;         /**< of a texel, scene units */
    double size, reach;      /**< of the map, the longer side; and of triangles, texels */
    double place;            /**< a position rounded: the length of its error, scene units */
    double turned;           /**< the light's matrix: the error on each axis, scene units */
    double turned_depth;     /**< the same along the light, window depth */
    double vertex;           /**< a vertex's window position: its error on each axis, texels */
    double box;              /**< of a triangle's box over twice its area, at most */
} ground;

static ground ground_of(const shadow_light *light) {
    const dp_triangles *t = &light->triangles;
    ground g = {.depth = light->setup.kappa, .reach = t->pixels};
    g.texel_x = light->width / t->width;
    g.texel_y = light->height / t->height;
    g.diagonal = dp_hypot(g.texel_x, g.texel_y);
    g.size = fmax(t->width, t->height);
    /* The length of positions, and of those to the middle of the box, which the matrix takes off. */
    const double position =
        light->world > 0.0 ? sqrt(3.0) * light->world : 0.5 * dp_hypot(dp_hypot(light->width, light->height), g.depth);
    const double middle = light->world > 0.0 ? position : 0.0;
    g.place = eps * position;
    g.turned = 4.0 * eps * (position + middle);
    g.turned_depth = 4.0 * eps * ((position + middle) / g.depth + 0.5) + eps;
    g.vertex = g.turned / fmin(g.texel_x, g.texel_y) + eps * (2.0 * g.size + 4.0 * g.reach);
    g.box = 0.5 * (1.0 + dp_hypot(t->slim, 1.0));
    return g;
}

/* The conversion into the format, and of what is read back. */
static double format_loss(const dp_setup *setup) {
    const dp_format *format = &setup->spec.format;
    const dp_conversion conversion = dp_arith_get(setup->spec.arith)->conversion;
    const bool exact = conversion == DP_CONVERT_EXACT;
    const bool truncated = exact ? setup->spec.rounding == DP_ROUND_ZERO : conversion == DP_CONVERT_PRODUCT_ZERO;
    const double rounded = conversion == DP_CONVERT_SIXTEENTHS ? 9.0 / 16.0 : 0.5;
    if (format->kind == DP_FORMAT_UNORM)
        return (truncated ? 1.0 : rounded) / (double)format->code_max + (exact ? eps : 2.0 * eps);
    if (format->mantissa_bits == 23 && format->exponent_bits == 8)
        return 0.0;
    return ldexp(setup->spec.rounding == DP_ROUND_ZERO ? 1.0 : 0.5, -format->mantissa_bits - 1);
}

static void parts_of(const shadow_light *light, const ground *g, shadow_part part[SHADOW_CAUSE_COUNT]) {
    const dp_triangles *t = &light->triangles;
    const dp_plane_error *p = &t->plane;
    const double far_off = g->size + g->reach;
    const double box = p->box * g->box * (1.0 + 2.0 * p->origin * eps * far_off);
    const double moved = 3.0 * g->place;
    part[SHADOW_CAUSE_TEXEL] = (shadow_part){0.5, 0.0};
    part[SHADOW_CAUSE_KERNEL] = (shadow_part){light->kernel - 0.5, 0.0};
    part[SHADOW_CAUSE_LOOKUP] =
        (shadow_part){(light->subtexel > 0 ? ldexp(rounded_step, -light->subtexel) : 0.0) + 2.0 * eps * g->size, 0.0};
    part[SHADOW_CAUSE_SNAPPING] = (shadow_part){t->subpixel > 0 ? ldexp(1.0, -t->subpixel - 1) : 0.0, 0.0};
    part[SHADOW_CAUSE_SETUP] = (shadow_part){eps * (p->origin * far_off + (box + p->range) * g->reach), eps * p->value};
    part[SHADOW_CAUSE_POSITION] =
        (shadow_part){g->vertex + g->turned / fmin(g->texel_x, g->texel_y) + moved / g->diagonal,
                      2.0 * g->turned_depth + moved / g->depth};
    part[SHADOW_CAUSE_RECEIVER] = (shadow_part){light->position / g->diagonal, light->position / g->depth};
    part[SHADOW_CAUSE_FORMAT] = (shadow_part){0.0, eps + format_loss(&light->setup)};
}

double shadow_part_at(const shadow_light *light, const shadow_part *part, double slant) {
    const ground g = ground_of(light);
    return part->texels * dp_tan(degrees(slant)) * g.diagonal / g.depth + part->window;
}

/* ---- The three biases -------------------------------------------------------------------------------------------- */

/* How far the slope of a triangle as drawn may be off on each axis: by a part of that on both, and whatever it is. */
typedef struct drawn_slope {
    double relative, absolute; /* the second in window depth, a texel */
} drawn_slope;

static drawn_slope drawn_slope_of(const shadow_light *light, const ground *g) {
    const dp_triangles *t = &light->triangles;
    const double snap = t->subpixel > 0 ? ldexp(1.0, -t->subpixel - 1) : 0.0;
    const double moved = snap + g->vertex + g->place / fmin(g->texel_x, g->texel_y);
    return (drawn_slope){.relative = 2.0 * moved / light->small + eps * (6.0 * g->box * t->slim + 2.0 * g->box + 2.0),
                         .absolute = 2.0 * (g->turned_depth + g->place / g->depth) / light->small};
}

static double factor_of(const drawn_slope *drawn, double texels) {
    return drawn->relative < 0.5 ? texels / (0.5 - drawn->relative) * outward : (double)INFINITY;
}

static double curvature_of(const shadow_light *light, const ground *g, double slope, double texels) {
    const double off = texels * g->diagonal;
    const double bend = dp_pow(1.0 + slope * slope, 1.5) / light->radius;
    return isinf(light->radius) ? 0.0 : bend * off * (0.5 * off + 2.0 * light->facet) / g->depth;
}

/* a sin x + b cos x at its largest, 0 <= x <= most. */
static double largest_wave(double a, double b, double most) {
    const double x = fmin(dp_atan2(a, b), most);
    return a * dp_sin(x) + b * dp_cos(x);
}

void shadow_gap_at(const shadow_light *light, const shadow_bias *bias, double slant, double *along_light,
                   double *along_normal) {
    const ground g = ground_of(light);
    const double slope = dp_tan(degrees(slant));
    const drawn_slope drawn = drawn_slope_of(light, &g);
    const double off = drawn.relative * slope * g.diagonal + drawn.absolute * g.depth; /* on either axis */
    const double steepest = slope * fmax(g.texel_x, g.texel_y) + root2 * off;
    const double scaled = isinf(bias->factor) ? bias->factor : bias->factor * steepest;
    *along_light = bias->window * g.depth + scaled + bias->offset * slope;
    *along_normal = *along_light * dp_cos(degrees(slant));
}

/* The part of the bias that is slope times filter radius, at the azimuth that needs most. */
static double share_of(const shadow_light *light, const ground *g, const shadow_bias *bias, double slope) {
    const double larger = fmax(g->texel_x, g->texel_y);
    const double m = slope * larger * larger / g->diagonal;
    const double scaled = isinf(bias->factor) ? bias->factor : bias->factor * m;
    return light->kernel * slope * g->diagonal / (bias->window * g->depth + scaled + bias->offset * slope);
}

void shadow_need_of(const shadow_light *light, shadow_need *need) {
    const ground g = ground_of(light);
    const double slant = light->triangles.slant_hi;
    const drawn_slope drawn = drawn_slope_of(light, &g);
    *need = (shadow_need){.texel_x = g.texel_x, .texel_y = g.texel_y, .texel = fmax(g.texel_x, g.texel_y)};
    need->slope = dp_tan(degrees(slant));
    parts_of(light, &g, need->part);
    for (int i = 0; i < SHADOW_CAUSE_COUNT; i++) {
        need->texels += need->part[i].texels;
        need->window += need->part[i].window;
    }
    const double across = need->texels * g.diagonal; /* scene units: what the slope is multiplied with */
    const double rest = need->window * outward;
    need->curvature = curvature_of(light, &g, need->slope, need->texels) * outward;
    need->offset_only = largest_wave(across * (1.0 + sine_error), rest * g.depth, degrees(slant)) * outward;
    shadow_bias *b = need->bias;
    const double steepest = dp_tan(degrees(slant) + turned_light);
    b[SHADOW_CONSTANT] = (shadow_bias){.window = across * steepest / g.depth * outward + rest};
    const double factor = factor_of(&drawn, need->texels);
    const double small = isfinite(factor) ? factor * drawn.absolute * outward : 0.0;
    b[SHADOW_SLOPE] = (shadow_bias){.window = fmin(rest + need->curvature + small, b->window), .factor = factor};
    b[SHADOW_NORMAL] = (shadow_bias){.window = rest + across * sine_error / g.depth, .offset = across * outward};
    for (int way = 0; way < SHADOW_WAY_COUNT; way++) {
        double same;
        shadow_gap_at(light, &b[way], slant, &b[way].gap_light, &b[way].gap_normal);
        shadow_gap_at(light, &b[way], 0.0, &b[way].gap_facing, &same);
        b[way].share = share_of(light, &g, &b[way], need->slope);
        b[way].limited = !(light->receiver_hi + b[way].gap_light <= light->setup.spec.zfar);
    }
}

/* ---- As programs set it ------------------------------------------------------------------------------------------ */

int shadow_sign(const shadow_light *light) {
    return -bias_sign(&light->setup);
}

shadow_state shadow_state_of(const shadow_light *light, const shadow_bias *bias, const bias_api *api) {
    const dp_setup *setup = &light->setup;
    const dp_format *format = &setup->spec.format;
    const double ends[2] = {dp_window(setup, light->receiver_lo), dp_window(setup, light->receiver_hi)};
    /* A texel is drawn beside the point, where the depth is smaller by what the bias has to cover. */
    const double least = fmin(ends[0], ends[1]) - bias->gap_light / setup->kappa;
    const bias_unit high = bias_unit_at(api, format, fmax(ends[0], ends[1]));
    shadow_state state = {.units = bias_units(api, format, fmax(least, 0.0), bias->window),
                          .factor = (double)dp_float_up(bias->factor)};
    shadow_bias set = *bias;
    set.window = state.units * (isfinite(high.most) ? high.most : high.least);
    set.factor = state.factor;
    double same;
    shadow_gap_at(light, &set, light->triangles.slant_hi, &state.gap_light, &state.gap_normal);
    shadow_gap_at(light, &set, 0.0, &state.gap_facing, &same);
    return state;
}
