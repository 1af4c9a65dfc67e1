/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Roundings of positions, matrices and lookups of a map; depthprec(7), "Shadow maps", derives every line for the sun,
 * and depthprec-shadow(1) what differs for lights that have a place. */
#include "shadow/ground.h"

#include <math.h>

#include "core/elementary.h"

static const double eps = 0x1p-24;
static const double root2 = 1.4142135623730951, root3 = 1.7320508075688773;

static ground sun_ground(const shadow_light *light) {
    const dp_triangles *t = &light->triangles;
    ground g = {.depth = light->setup.kappa, .most = 1.0, .turn = 4.0 * eps, .second = 1.0};
    g.texel_x = light->width / t->width;
    g.texel_y = light->height / t->height;
    g.diagonal = dp_hypot(g.texel_x, g.texel_y);
    g.size = fmax(t->width, t->height);
    g.reach = t->pixels;
    /* The length of positions, and of those to the middle of the box, which the matrix takes off. */
    const double position =
        light->world > 0.0 ? root3 * light->world : 0.5 * dp_hypot(dp_hypot(light->width, light->height), g.depth);
    const double middle = light->world > 0.0 ? position : 0.0;
    const double place = eps * position, turned = 4.0 * eps * (position + middle);
    g.point = turned / fmin(g.texel_x, g.texel_y);
    g.vertex = g.point + eps * (2.0 * g.size + 4.0 * g.reach);
    g.vertex_depth = g.point_depth = 4.0 * eps * ((position + middle) / g.depth + 0.5) + eps;
    g.placed = place / fmin(g.texel_x, g.texel_y);
    g.placed_depth = place / g.depth;
    g.moved = 3.0 * place / g.diagonal;
    g.moved_depth = 3.0 * place / g.depth;
    return g;
}

/* What a window depth rounds of a place at z, whose transformed coordinates are off by 5 eps q. */
static double depth_rounded(const shadow_light *light, double z, double q, double most) {
    const dp_setup *setup = &light->setup;
    const bool half = dp_mapping_get(setup->spec.mapping)->ndc_signed != 0;
    const double scale = half ? 0.5 : 1.0;
    const double a = fabs((double)setup->matrix[0]), b = fabs((double)setup->matrix[1]);
    if (shadow_holds_distance(light)) /* three products, two sums, a root, far - near taken off and divided by */
        return eps * (5.0 * q + 8.0 * z) / (setup->spec.zfar - setup->spec.znear);
    return 5.0 * eps * (scale * (a * q + b) + most * q) / z + 4.0 * eps * (half ? 1.0 : most);
}

static ground lamp_ground(const shadow_light *light, double z) {
    const dp_setup *setup = &light->setup;
    const dp_triangles *t = &light->triangles;
    const double h = dp_half_tangent(light->fov), corner = dp_hypot(1.0, root2 * h);
    const double nearest = fmax(z / t->depth, setup->spec.znear); /* of vertices */
    const bool half = dp_mapping_get(setup->spec.mapping)->ndc_signed != 0, distance = shadow_holds_distance(light);
    const bool falls = !distance && setup->reversed && !half; /* what is far is near 0 */
    /* The length of positions over their depth, of a vertex and of a point; and with what the matrix takes off. */
    const double vertex = light->world > 0.0 ? root3 * light->world / nearest : corner;
    const double point = light->world > 0.0 ? root3 * light->world / z : corner;
    const double twice = light->world > 0.0 ? 2.0 : 1.0;
    ground g = {.size = t->width, .reach = t->pixels, .z = z, .pitch = 2.0 * h / t->width};
    const double off = 5.0 * eps * twice * (1.0 + h) / g.pitch;
    const double second = 1.0 - 16.0 * eps * twice * vertex;  /* its cube is 1/2 or more in a light that was checked */
    g.depth = distance ? setup->kappa : z * z * setup->kappa; /* far - near; 1/near - 1/far */
    g.texel_x = g.texel_y = g.pitch * z;
    g.diagonal = root2 * g.pitch * z;
    g.most = falls ? fmin(dp_window(setup, nearest), 1.0) : 1.0;
    g.point = off * point + eps * g.size;
    g.vertex = off * vertex + eps * (3.0 * g.size + 4.0 * g.reach);
    g.vertex_depth = distance ? 0.0 : depth_rounded(light, nearest, twice * vertex * nearest, g.most);
    g.point_depth = depth_rounded(light, z, twice * point * z, falls ? fmin(dp_window(setup, z), 1.0) : 1.0);
    g.placed = eps * vertex * corner / g.pitch;
    g.placed_depth =
        eps * (distance ? fmax(vertex * nearest, point * z * t->depth) / g.depth : vertex / (nearest * setup->kappa));
    g.moved = eps * corner / (root2 * g.pitch) * (vertex + 2.0 * point);
    g.moved_depth = g.placed_depth + 2.0 * eps * point * z / g.depth;
    g.second = 1.0 / (second * second * second);
    g.corner = dp_atan2(root2 * h, 1.0);
    g.cone = light->kind == SHADOW_POINT ? 0.5 * SHADOW_HALF_TURN : g.corner;
    return g;
}

ground shadow_ground_at(const shadow_light *light, double z) {
    ground g = light->kind == SHADOW_SUN ? sun_ground(light) : lamp_ground(light, z);
    const dp_plane_error *p = &light->triangles.plane;
    g.box = 0.5 * (1.0 + dp_hypot(light->triangles.slim, 1.0));
    if (shadow_holds_distance(light)) /* a quotient of two planes, positions over depth and 1 over depth */
        g.interpolated =
            eps * (2.0 * light->triangles.depth * (p->value + p->box * g.box + p->range) + 8.0) * z / g.depth;
    return g;
}

double shadow_lean(const shadow_light *light, const ground *g, double slant) {
    if (light->kind == SHADOW_SUN || shadow_holds_distance(light))
        return dp_tan(slant);
    const double ray = fmin(0.5 * (0.5 * SHADOW_HALF_TURN - slant), g->cone);
    return dp_cos(ray) * (dp_sin(ray) + dp_tan(slant) * dp_cos(ray));
}

double shadow_hardest(const shadow_light *light) {
    return shadow_holds_distance(light) ? light->receiver_hi : light->receiver_lo;
}

/* The rounding of texture coordinates: Direct3D allows 0.6 of a step. */
static const double rounded_step = 0.6;

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

double shadow_texels(const shadow_light *light, const ground *g, shadow_part part[SHADOW_CAUSE_COUNT]) {
    const dp_triangles *t = &light->triangles;
    const dp_plane_error *p = &t->plane;
    const double far_off = g->size + g->reach;
    const double box = p->box * g->box * (1.0 + 2.0 * p->origin * eps * far_off);
    part[SHADOW_CAUSE_TEXEL] = (shadow_part){0.5, 0.0};
    part[SHADOW_CAUSE_KERNEL] = (shadow_part){light->kernel - 0.5, 0.0};
    part[SHADOW_CAUSE_LOOKUP] =
        (shadow_part){(light->subtexel > 0 ? ldexp(rounded_step, -light->subtexel) : 0.0) + 2.0 * eps * g->size, 0.0};
    part[SHADOW_CAUSE_SNAPPING] = (shadow_part){t->subpixel > 0 ? ldexp(1.0, -t->subpixel - 1) : 0.0, 0.0};
    part[SHADOW_CAUSE_SETUP] = (shadow_part){eps * (p->origin * far_off + (box + p->range) * g->reach),
                                             shadow_holds_distance(light) ? g->interpolated : eps * p->value * g->most};
    part[SHADOW_CAUSE_POSITION] =
        (shadow_part){g->vertex + g->point + g->moved, g->vertex_depth + g->point_depth + g->moved_depth};
    part[SHADOW_CAUSE_RECEIVER] = (shadow_part){light->position / g->diagonal, light->position / g->depth};
    part[SHADOW_CAUSE_FORMAT] = (shadow_part){0.0, eps * g->most + format_loss(&light->setup)};
    double texels = 0.0;
    for (int i = 0; i < SHADOW_CAUSE_COUNT; i++) {
        part[i].texels *= g->second;
        part[i].window *= g->second;
        texels += part[i].texels;
    }
    /* Beyond the edge of a cube's face the texels of the next are a little farther away. */
    return light->kind == SHADOW_POINT ? texels / (1.0 - texels * g->pitch) : texels;
}
