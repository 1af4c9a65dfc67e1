/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The three biases that cover what is needed, and the gaps that they open; depthprec(7), "Shadow maps", and
 * depthprec-shadow(1) derive every line. */
#include <math.h>

#include "core/bits.h"
#include "core/elementary.h"
#include "shadow/ground.h"

/* Covers terms of second order and this file's own rounding. */
static const double outward = 1.0 + DP_ROUNDINGS32_14;

/* The largest error of a sine that a shader takes from a cosine. */
static const double sine_error = 0x1p-10;

static const double eps = 0x1p-24;
static const double root2 = 1.4142135623730951;
static const double quarter = 0.5 * SHADOW_HALF_TURN; /* of a turn */

static ground hardest_of(const shadow_light *light) {
    return shadow_ground_at(light, shadow_hardest(light));
}

/* The window depth that so many texels on each axis cost at that slant (radians). Distances change by less: a plane at
 * the angle t is 1/(1 + tan t tan x) times as far at the angle x towards the light. */
static double cost(const shadow_light *light, const ground *g, double texels, double slant) {
    const double off = texels * g->diagonal, lean = shadow_lean(light, g, slant);
    if (!shadow_holds_distance(light))
        return off * lean / g->depth;
    const double turned = off / g->z / (1.0 - 0.25 * off / g->z * off / g->z) * lean;
    return g->z * turned / (1.0 + turned) / g->depth;
}

double shadow_part_at(const shadow_light *light, const shadow_part *part, double slant) {
    const ground g = hardest_of(light);
    return cost(light, &g, part->texels, shadow_radians(slant)) + part->window;
}

/* ---- The three biases -------------------------------------------------------------------------------------------- */

/* How far the slope of a triangle as drawn may be off on each axis: by a part of that on both, and whatever it is. */
typedef struct drawn_slope {
    double relative, absolute; /* the second in window depth, a texel */
} drawn_slope;

static drawn_slope drawn_slope_of(const shadow_light *light, const ground *g) {
    const dp_triangles *t = &light->triangles;
    const double snap = t->subpixel > 0 ? ldexp(1.0, -t->subpixel - 1) : 0.0;
    const double moved = snap + g->vertex + g->placed;
    return (drawn_slope){.relative = 2.0 * moved / light->small + eps * (6.0 * g->box * t->slim + 2.0 * g->box + 2.0),
                         .absolute = 2.0 * (g->vertex_depth + g->placed_depth) / light->small};
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

/* The greatest change of depth from texel to texel on an axis, where the triangle is drawn too steep, seen along rays
 * that are so many times as long as their depth. */
static double steepest_of(const shadow_light *light, const ground *g, double lean, double longest) {
    const drawn_slope drawn = drawn_slope_of(light, g);
    const double off = drawn.relative * lean * g->diagonal + drawn.absolute * g->depth * longest; /* on either axis */
    return lean * fmax(g->texel_x, g->texel_y) + root2 * off;
}

static double times(double factor, double by) {
    return factor == 0.0 || isinf(factor) ? factor : factor * by;
}

/*
 * A point that is moved by l along its normal lies l/cos before the plane where it is looked up, at the angle to that
 * ray. There the plane may be deeper, *back times as deep.
 */
static double offset_gap(double moved, double z, double angle, double *back) {
    const double left = 1.0 - moved / (z * dp_cos(angle));
    *back = 1.0;
    if (moved == 0.0)
        return 0.0;
    if (!(left > 0.0))
        return (double)INFINITY;
    *back = (1.0 + moved / z) / left;
    return moved * dp_hypot(1.0, dp_tan(angle) / left);
}

/* The distance along the rays of a light that has a place, where receivers are farthest: what is added is taken off
 * 1/depth. */
static void lamp_gap_at(const shadow_light *light, const shadow_bias *bias, double slant, double *along_light,
                        double *along_normal) {
    const double angle = shadow_radians(slant), z = light->receiver_hi;
    const ground g = shadow_ground_at(light, z);
    const bool distance = shadow_holds_distance(light);
    const double longest = distance ? 1.0 : 1.0 / dp_cos(g.corner), ray = fmin(quarter - angle, g.corner);
    const double lean = distance ? dp_tan(angle) : dp_sin(ray) + dp_tan(angle) * dp_cos(ray);
    const double steep = times(bias->factor, steepest_of(light, &g, shadow_lean(light, &g, angle), 1.0));
    const double long_steep = times(bias->factor, steepest_of(light, &g, lean, longest));
    double back;
    const double offset = offset_gap(bias->offset * z * (distance ? dp_sin(angle) : 1.0), z, angle, &back);
    const double window = bias->window * g.depth * (distance ? 1.0 : back * back);
    const double share = distance ? 0.0 : (window + steep) / (z * back);
    *along_light =
        share < 1.0 && isfinite(offset) ? (window * longest + long_steep) / (1.0 - share) + offset : (double)INFINITY;
    *along_normal = *along_light;
    if (isfinite(*along_light))
        *along_normal = (*along_light - offset) * dp_cos(angle) + bias->offset * z * (distance ? dp_sin(angle) : 1.0);
}

void shadow_gap_at(const shadow_light *light, const shadow_bias *bias, double slant, double *along_light,
                   double *along_normal) {
    if (light->kind != SHADOW_SUN) {
        lamp_gap_at(light, bias, slant, along_light, along_normal);
        return;
    }
    const ground g = hardest_of(light);
    const double slope = dp_tan(shadow_radians(slant));
    *along_light =
        bias->window * g.depth + times(bias->factor, steepest_of(light, &g, slope, 1.0)) + bias->offset * slope;
    *along_normal = *along_light * dp_cos(shadow_radians(slant));
}

/* The part of the bias that is slope times filter radius, at the azimuth that needs most. */
static double share_of(const shadow_light *light, const ground *g, const shadow_bias *bias, double slant) {
    const bool distance = shadow_holds_distance(light);
    const double larger = fmax(g->texel_x, g->texel_y), lean = shadow_lean(light, g, slant);
    const double scaled = times(bias->factor, lean * larger * larger / g->diagonal);
    const double alone = cost(light, g, light->kernel, slant) * g->depth;
    if (light->kind == SHADOW_SUN || distance)
        return alone / (bias->window * g->depth + scaled + bias->offset * (distance ? g->z : 1.0) * lean);
    if (bias->offset == 0.0)
        return alone / (bias->window * g->depth + scaled);
    /* An offset has to be largest where the ray and the angle together make a right one, or at the corner. */
    const double ray = fmin(quarter - slant, g->corner), per = dp_cos(ray) / dp_cos(slant);
    const double moved = bias->offset * g->z / (1.0 - bias->offset);
    return light->kernel * per * dp_sin(slant + ray) * g->diagonal / (bias->window * g->depth + moved * per);
}

/* ---- What is enough ---------------------------------------------------------------------------------------------- */

/*
 * The multiple of the depth by which a point is moved along its normal. A plane at that slant, seen by a ray that leans
 * by up to the cone's angle, has a normal whose part across is the sine of the two; the depth of the point that was
 * moved may be greater than its own. Of distances the angle from ray to ray counts, and the sine of the slant.
 */
static double lamp_offset(const shadow_light *light, const ground *g, double texels, double slant) {
    const double off = texels * root2 * g->pitch;
    if (shadow_holds_distance(light))
        return off / (1.0 - 0.25 * off * off);
    const double across = off * dp_sin(fmin(slant + g->cone, quarter));
    return across / (1.0 - across);
}

static void biases_of(const shadow_light *light, const ground *g, shadow_need *need) {
    const double slant = shadow_radians(light->triangles.slant_hi);
    const drawn_slope drawn = drawn_slope_of(light, g);
    const double across = need->texels * g->diagonal; /* scene units: what the slope is multiplied with */
    const double rest = need->window * outward;
    shadow_bias *b = need->bias;
    b[SHADOW_CONSTANT] = (shadow_bias){.window = cost(light, g, need->texels, slant + g->turn) * outward + rest};
    const double factor = shadow_holds_distance(light) ? (double)INFINITY : factor_of(&drawn, need->texels);
    const double small = isfinite(factor) ? factor * drawn.absolute * outward : 0.0;
    b[SHADOW_SLOPE] = (shadow_bias){.window = fmin(rest + need->curvature + small, b->window), .factor = factor};
    const double moved = light->kind == SHADOW_SUN ? across : lamp_offset(light, g, need->texels, slant);
    const bool sines = light->kind == SHADOW_SUN || shadow_holds_distance(light);
    b[SHADOW_NORMAL] =
        (shadow_bias){.window = rest + (sines ? across * sine_error / g->depth : 0.0), .offset = moved * outward};
}

void shadow_need_of(const shadow_light *light, shadow_need *need) {
    const ground g = hardest_of(light);
    const double slant = light->triangles.slant_hi;
    *need = (shadow_need){.texel_x = g.texel_x, .texel_y = g.texel_y, .texel = fmax(g.texel_x, g.texel_y)};
    need->per_offset = light->kind == SHADOW_SUN ? need->texel : g.pitch;
    need->slope = dp_tan(shadow_radians(slant));
    need->texels = shadow_texels(light, &g, need->part);
    for (int i = 0; i < SHADOW_CAUSE_COUNT; i++)
        need->window += need->part[i].window;
    const double across = need->texels * g.diagonal, rest = need->window * outward;
    need->curvature = curvature_of(light, &g, need->slope, need->texels) * outward;
    need->offset_only = largest_wave(across * (1.0 + sine_error), rest * g.depth, shadow_radians(slant)) * outward;
    biases_of(light, &g, need);
    for (int way = 0; way < SHADOW_WAY_COUNT; way++) {
        shadow_bias *b = &need->bias[way];
        double same;
        shadow_gap_at(light, b, slant, &b->gap_light, &b->gap_normal);
        shadow_gap_at(light, b, 0.0, &b->gap_facing, &same);
        b->share = share_of(light, &g, b, shadow_radians(slant));
        b->limited = !(light->receiver_hi + b->gap_light <= light->setup.spec.zfar);
    }
}

double shadow_plane_needs(const shadow_light *light, const double normal[3], double distance) {
    const ground g = shadow_ground_at(light, 1.0);
    return light->kernel * g.pitch * (fabs(normal[0]) + fabs(normal[1])) / (distance * g.depth);
}

/* ---- As programs set it ------------------------------------------------------------------------------------------ */

int shadow_sign(const shadow_light *light) {
    return -bias_sign(&light->setup);
}

static shadow_way way_of(const shadow_bias *bias) {
    return bias->offset > 0.0 ? SHADOW_NORMAL : bias->factor > 0.0 ? SHADOW_SLOPE : SHADOW_CONSTANT;
}

/* Part i of the depths where receivers lie. A light's place has them divided where units follow the depth, for there
 * the need falls with the depth, too. False behind the last. */
static bool part_of(const shadow_light *light, const bias_api *api, int i, shadow_light *part) {
    static const double step = 1.0905077326652577; /* eight in an octave */
    const dp_format *format = &light->setup.spec.format;
    const bool follow = bias_unit_at(api, format, 0.0).least < bias_unit_at(api, format, 1.0).least;
    *part = *light;
    if (light->kind == SHADOW_SUN || !follow)
        return i == 0;
    part->receiver_lo = light->receiver_lo * dp_pow(step, i);
    part->receiver_hi = fmin(part->receiver_lo * step, light->receiver_hi);
    return i == 0 || part->receiver_lo < light->receiver_hi;
}

/* A texel is drawn beside the point, where the depth is smaller by what the bias has to cover. */
static double least_depth(const shadow_light *light, const shadow_bias *bias) {
    const double lo = dp_window(&light->setup, light->receiver_lo), hi = dp_window(&light->setup, light->receiver_hi);
    if (light->kind == SHADOW_SUN)
        return fmax(fmin(lo, hi) - bias->gap_light / light->setup.kappa, 0.0);
    shadow_need need;
    shadow_need_of(light, &need);
    return fmax(fmin(lo, hi) - need.bias[SHADOW_CONSTANT].window, 0.0);
}

/* ---- Casters ----------------------------------------------------------------------------------------------------- */

/* The depth of the farthest caster whose triangle reaches to where window depth is d, of a reversed map. */
static double farthest_at(const shadow_light *light, double d) {
    const dp_setup *setup = &light->setup;
    const dp_triangles *t = &light->triangles;
    const ground g = shadow_ground_at(light, fmax(dp_eye(setup, d, 1.0 - d), setup->spec.znear));
    const double least = d * (1.0 - 4.0 * eps) - g.vertex_depth - g.placed_depth; /* is rounded to d, perhaps */
    const double z = least > 0.0 ? dp_eye(setup, least, 1.0 - least) : (double)INFINITY;
    return light->kind == SHADOW_SUN ? z + t->pixels * g.diagonal * dp_tan(shadow_radians(t->slant_hi)) : z * t->depth;
}

/* Whether a caster at z with that bias may not yet be in front of all receivers, by the bias and what the constant bias
 * covers. */
static bool lacks_room(const shadow_light *light, const shadow_bias *set, double z) {
    const double angle = shadow_radians(light->triangles.slant_hi), kappa = light->setup.kappa;
    const ground g = shadow_ground_at(light, z);
    shadow_light at = *light;
    shadow_need need;
    double along, normal, back;
    at.receiver_lo = at.receiver_hi = z;
    if (!(z < light->receiver_lo))
        return true;
    if (shadow_light_check(&at) != SHADOW_OK) /* so near, positions are nothing in binary32 */
        return false;
    shadow_need_of(&at, &need);
    const double covered = need.bias[SHADOW_CONSTANT].window;
    if (light->kind == SHADOW_SUN || shadow_holds_distance(light)) {
        shadow_gap_at(light, set, light->triangles.slant_hi, &along, &normal);
        return !(z + along + covered * g.depth < light->receiver_lo);
    }
    /* The change of 1/depth, in parts of the caster's. The point was moved: where it is looked up the plane may be
     * nearer. */
    const double steep = times(set->factor, steepest_of(light, &g, shadow_lean(light, &g, angle), 1.0)) / z;
    const double left = 1.0 - set->offset / dp_cos(angle);
    back = left > 0.0 ? 1.0 / (left * (1.0 - set->offset)) : (double)INFINITY;
    return !(z * back / light->receiver_lo + z * kappa * (set->window + covered) + steep < 1.0);
}

double shadow_casters_window(const shadow_light *light, const shadow_bias *rest, const bias_api *api, double units) {
    const dp_setup *setup = &light->setup;
    const dp_format *format = &setup->spec.format;
    const double lo = dp_window(setup, light->receiver_lo), hi = dp_window(setup, light->receiver_hi);
    const bias_unit own = bias_unit_at(api, format, fmax(lo, hi));
    shadow_bias set = *rest;
    for (double d = 1.0; setup->reversed && bias_unit_at(api, format, d).most > own.most; d *= 0.5) {
        const double window = units * bias_unit_at(api, format, d).most;
        set.window = rest->window + window;
        if (lacks_room(light, &set, farthest_at(light, d)))
            return window;
    }
    return units * (isfinite(own.most) ? own.most : own.least);
}

shadow_bias shadow_as_added(const shadow_light *light, const shadow_bias *bias, const bias_api *api) {
    const dp_format *format = &light->setup.spec.format;
    const bool follow = bias_unit_at(api, format, 0.0).least < bias_unit_at(api, format, 1.0).least;
    const double units = follow ? shadow_state_of(light, bias, api).units : (double)INFINITY;
    shadow_bias added = *bias, rest = *bias;
    rest.window = 0.0;
    if (isfinite(units))
        added.window = shadow_casters_window(light, &rest, api, units);
    return added;
}

void shadow_state_widen(const shadow_light *light, const shadow_bias *bias, const bias_api *api, shadow_state *state) {
    shadow_bias set = {.factor = state->factor, .offset = bias->offset};
    double along, normal, facing, same;
    set.window = shadow_casters_window(light, &set, api, state->units);
    shadow_gap_at(light, &set, light->triangles.slant_hi, &along, &normal);
    shadow_gap_at(light, &set, 0.0, &facing, &same);
    state->gap_light = fmax(state->gap_light, along);
    state->gap_normal = fmax(state->gap_normal, normal);
    state->gap_facing = fmax(state->gap_facing, facing);
}

shadow_state shadow_state_of(const shadow_light *light, const shadow_bias *bias, const bias_api *api) {
    const dp_format *format = &light->setup.spec.format;
    shadow_state state = {.factor = (double)dp_float_up(bias->factor)};
    shadow_light part;
    for (int i = 0; part_of(light, api, i, &part); i++) {
        double window = bias->window;
        if (i > 0 || part.receiver_hi < light->receiver_hi) {
            shadow_need need;
            shadow_need_of(&part, &need);
            window = need.bias[way_of(bias)].window;
        }
        state.units = fmax(state.units, bias_units(api, format, least_depth(&part, bias), window));
    }
    for (int i = 0; part_of(light, api, i, &part); i++)
        shadow_state_widen(&part, bias, api, &state);
    return state;
}
