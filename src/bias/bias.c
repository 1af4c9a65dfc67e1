/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bias/bias.h"

#include <math.h>

#include "core/bits.h"
#include "core/elementary.h"
#include "core/search.h"

#define UNSCALED 0.0, 0.0

/* clang-format off */
static const bias_api rows[] = {
    {"d3d11", "d3d10 direct3d11",
     "DepthBias is an integer; all is computed in binary32, at the vertices, after clipping",
     "Direct3D 11 programming guide, output merger stage, Depth Bias",
     BIAS_CODE, BIAS_EXPONENT, BIAS_EXPONENT_N, true, true, true, false, "D3D11_RASTERIZER_DESC.DepthBias = U",
     ", SlopeScaledDepthBias = F", UNSCALED, "hlsl", NULL, NULL, true},
    {"d3d12", "direct3d12", "DepthBias is an integer; the rule of d3d11",
     "Direct3D 12, D3D12_RASTERIZER_DESC, which refers to Depth Bias of Direct3D 11",
     BIAS_CODE, BIAS_EXPONENT, BIAS_EXPONENT_N, true, true, true, false, "D3D12_RASTERIZER_DESC.DepthBias = U",
     ", SlopeScaledDepthBias = F", UNSCALED, "hlsl", NULL, NULL, true},
    {"webgpu", "wgpu", "depthBias is an integer; depth24plus may follow either rule (gpuweb/gpuweb#6350)",
     "WebGPU, biased fragment depth; gpuweb/cts depth_bias.spec.ts",
     BIAS_CODE, BIAS_EXPONENT, BIAS_EXPONENT_N, true, true, false, false, "depthBias: U", ", depthBiasSlopeScale: F",
     UNSCALED, "wgsl", NULL, NULL, true},
    {"metal", "mtl",
     "depthBias is a float; for integer buffers r is the smallest positive value that the buffer holds",
     "Metal, MTLRenderCommandEncoder, setDepthBias(_:slopeScale:clamp:)",
     BIAS_CODE, BIAS_EXPONENT, BIAS_EXPONENT_N, false, true, false, false,
     "setDepthBias(U, slopeScale: F, clamp: 0)", "", UNSCALED, "msl", NULL, NULL, false},
    {"vulkan", "vk", "for integer buffers r is the implementation's choice, at most 2 x 2^-N",
     "Vulkan specification, Depth Bias Computation",
     BIAS_BOUND, BIAS_EXPONENT, BIAS_EXPONENT_OPEN, false, true, false, true, "depthBiasConstantFactor = U",
     ", depthBiasSlopeFactor = F", UNSCALED, "glsl", NULL, NULL, false},
    {"vulkan-exact", "vk-exact",
     "VK_EXT_depth_bias_control with depthBiasExact: r = 2^-N, less than the distance of two codes",
     "Vulkan specification, Depth Bias Computation; VK_EXT_depth_bias_control",
     BIAS_POWER, BIAS_EXPONENT, BIAS_EXPONENT_OPEN, false, true, false, false, "depthBiasConstantFactor = U",
     ", depthBiasSlopeFactor = F", UNSCALED, "glsl", NULL, NULL, false},
    {"vulkan-unorm", "vk-unorm",
     "representation LEAST_REPRESENTABLE_VALUE_FORCE_UNORM with depthBiasExact: one r for all depths of a float buffer",
     "Vulkan specification, Depth Bias Computation; VK_EXT_depth_bias_control",
     BIAS_POWER, BIAS_MANTISSA, BIAS_EXPONENT_OPEN, false, true, false, false, "depthBiasConstantFactor = U",
     ", depthBiasSlopeFactor = F", UNSCALED, "glsl", NULL, NULL, false},
    {"vulkan-float", "vk-float", "representation FLOAT: r = 1, units are window depth, as in d3d9",
     "Vulkan specification, Depth Bias Computation; VK_EXT_depth_bias_control",
     BIAS_ONE, BIAS_ONE, BIAS_EXPONENT_OPEN, false, true, false, false, "depthBiasConstantFactor = U",
     ", depthBiasSlopeFactor = F", UNSCALED, "glsl", NULL, NULL, false},
    {"gl", "opengl gles webgl",
     "glPolygonOffset(factor, units); the clamp is EXT_polygon_offset_clamp or GL 4.6; for integer buffers r is the "
     "implementation's choice, 2^-N is assumed", "OpenGL specification, Depth Offset; EXT_polygon_offset_clamp",
     BIAS_FREE, BIAS_EXPONENT, BIAS_EXPONENT_OPEN, false, true, false, true, "glPolygonOffset(F, U)", "",
     UNSCALED, "glsl", "gl", "unorm24", false},
    {"three", "threejs three.js polygonOffset",
     "of a material with polygonOffset = true, handed to gl.polygonOffset(): see gl; WebGL has no clamp",
     "three.js, src/renderers/webgl/WebGLState.js (setPolygonOffset)",
     BIAS_FREE, BIAS_EXPONENT, BIAS_EXPONENT_OPEN, false, false, false, true,
     "polygonOffsetFactor = F, polygonOffsetUnits = U", "", UNSCALED, "glsl", "gl", "unorm24", false},
    {"d3d9", "direct3d9 d3d8to9", "D3DRS_DEPTHBIAS is a window depth; there is no clamp",
     "Direct3D 9, Depth Bias: Offset = m D3DRS_SLOPESCALEDEPTHBIAS + D3DRS_DEPTHBIAS",
     BIAS_ONE, BIAS_ONE, BIAS_EXPONENT_OPEN, false, false, false, false, "D3DRS_DEPTHBIAS = U",
     ", D3DRS_SLOPESCALEDEPTHBIAS = F", UNSCALED, "hlsl", NULL, "unorm24", false},
};
/* clang-format on */
enum { ROW_COUNT = sizeof rows / sizeof rows[0] };

enum { BINARY32_MANTISSA = 23, BINARY32_LOWEST = -126 };
static const double units_most = 0x1p31; /* beyond what an integer bias can hold */

NAMED_TABLE(bias_api, rows);

/* ---- What the APIs add ------------------------------------------------------------------------------------------- */

static double to_binary32(double value) {
    return (double)(float)value;
}

/* The exponent of the binary32 number nearest to d, not below the lowest that numbers of the format have. */
static int exponent_of(const dp_format *format, double d) {
    const bool is_float = format->kind == DP_FORMAT_FLOAT;
    const int lowest = is_float ? 1 - format->bias : BINARY32_LOWEST;
    const double held = to_binary32(d);
    int e = lowest + 1;
    if (held > 0.0)
        (void)frexp(held, &e);
    return e - 1 > lowest ? e - 1 : lowest;
}

/* The worth of a unit, before anything multiplies it, when the greatest depth has the exponent e. */
static double worth_of(const bias_api *api, const dp_format *format, int e) {
    const bool is_float = format->kind == DP_FORMAT_FLOAT;
    switch (is_float ? api->real : api->unorm) {
    case BIAS_CODE:
        return to_binary32(1.0 / (double)format->code_max);
    case BIAS_POWER:
    case BIAS_BOUND:
    case BIAS_FREE:
        return ldexp(1.0, -format->bits);
    case BIAS_EXPONENT:
        return ldexp(1.0, e + (api->exponent == BIAS_EXPONENT_NEXT) - format->mantissa_bits);
    case BIAS_MANTISSA:
        return ldexp(1.0, -(format->mantissa_bits + 1));
    case BIAS_ONE:
        break;
    }
    return 1.0;
}

/* r.least. */
static double unit_of(const bias_api *api, const dp_format *format, int e) {
    return worth_of(api, format, e) * (api->scale_least > 0.0 ? api->scale_least : 1.0);
}

bool bias_is_open(const bias_api *api, const dp_format *format) {
    return format->kind == DP_FORMAT_FLOAT && api->real == BIAS_EXPONENT && api->exponent == BIAS_EXPONENT_OPEN;
}

bias_api bias_next(const bias_api *api) {
    bias_api next = *api;
    next.exponent = BIAS_EXPONENT_NEXT;
    return next;
}

bias_unit bias_unit_at(const bias_api *api, const dp_format *format, double d) {
    const double least = unit_of(api, format, exponent_of(format, d));
    const bool is_unorm = format->kind == DP_FORMAT_UNORM;
    double most = least;
    if (is_unorm && api->unorm == BIAS_BOUND)
        most = 2.0 * least;
    else if (is_unorm && api->unorm == BIAS_FREE)
        most = (double)INFINITY;
    else if (bias_is_open(api, format))
        most = 2.0 * least;
    return (bias_unit){least, api->scale_least > 0.0 ? most * (api->scale_most / api->scale_least) : most};
}

double bias_offset(const bias_state *state, double r, double m) {
    double o = state->units * r + state->factor * m;
    if (state->api->binary32) /* two binary32 factors: the products are exact in double, so each is rounded once */
        o = to_binary32(to_binary32(state->units) * r);
    if (state->api->binary32)
        o = to_binary32(o + to_binary32(to_binary32(state->factor) * to_binary32(m)));
    if (state->clamp > 0.0)
        return fmin(o, state->clamp);
    return state->clamp < 0.0 ? fmax(o, state->clamp) : o;
}

/* ---- Between window depth and scene ------------------------------------------------------------------------------ */

int bias_sign(const dp_setup *setup) {
    return setup->reversed ? 1 : -1;
}

double bias_window_slope(const dp_setup *setup, double z, double slope) {
    const double c = setup->log_c;
    if (isinf(z) || slope == 0.0)
        return 0.0;
    return setup->curve == DP_CURVE_PERSPECTIVE ? slope / (setup->kappa * z * z)
           : setup->curve == DP_CURVE_LINEAR    ? slope / setup->kappa
                                                : slope * c / ((c * (z - setup->anchor) + 1.0) * setup->kappa);
}

/* How far z moves when its window depth moves by t towards far; the result lies between the planes. */
static double shift_of(const dp_setup *setup, double z, double t) {
    const double c = setup->log_c;
    /* perspective: 1/z' = 1/z - t kappa */
    return setup->curve == DP_CURVE_PERSPECTIVE ? t * setup->kappa * z * (z / (1.0 - t * setup->kappa * z))
           : setup->curve == DP_CURVE_LINEAR    ? t * setup->kappa
                                                : (c * (z - setup->anchor) + 1.0) / c * dp_expm1(t * setup->kappa);
}

/* The window distance from z to z - gap; INFINITY when that lies before the near plane. */
static double window_of_gap(const dp_setup *setup, double z, double gap) {
    const double c = setup->log_c;
    const double to = fmax(z - gap, setup->spec.znear);
    if (gap == 0.0)
        return 0.0;
    if (z < setup->spec.znear + gap) /* near + gap itself, as rounded, leads to the near plane */
        return (double)INFINITY;
    return setup->curve == DP_CURVE_PERSPECTIVE ? gap / (setup->kappa * z * to)
           : setup->curve == DP_CURVE_LINEAR    ? gap / setup->kappa
                                                : -dp_log1p(-c * gap / (c * (z - setup->anchor) + 1.0)) / setup->kappa;
}

bias_effect bias_at(const dp_setup *setup, const bias_state *state, double slope, double z) {
    const dp_format *format = &setup->spec.format;
    const double d = dp_window(setup, z);
    bias_effect effect = {.z = z, .r = bias_unit_at(state->api, format, d), .code = dp_code(setup, z)};
    effect.m = bias_window_slope(setup, z, slope);
    effect.offset = bias_offset(state, effect.r.least, effect.m);
    effect.depth = d + effect.offset;
    if (effect.offset == 0.0) {
        effect.moved = effect.code;
        effect.to = z;
        return effect;
    }
    const double low = setup->low, high = low + setup->span;
    effect.limited = effect.depth < low || effect.depth > high;
    effect.depth = fmin(fmax(effect.depth, low), high);
    effect.moved = dp_format_encode(format, setup->spec.rounding, effect.depth);
    if (effect.limited) {
        effect.to = (effect.depth == high) != (setup->reversed != 0) ? setup->spec.zfar : setup->spec.znear;
        effect.shift = effect.to - z;
        return effect;
    }
    effect.shift = shift_of(setup, z, -effect.offset * bias_sign(setup));
    effect.to = z + effect.shift;
    return effect;
}

/* ---- How much is enough ------------------------------------------------------------------------------------------ */

/*
 * The window distance that certainly leads from one code to another, for depths below 2^(e+1) that are binary32
 * numbers. In a format other than binary32 the sum d + o is rounded to binary32 and then to a code that it may meet at
 * any alignment; layers that are sampled apart have, besides m, two depths that were rounded by themselves.
 */
static double certain_step(const bias_goal *goal, const dp_format *format, int e, double r, double m) {
    const bool is_unorm = format->kind == DP_FORMAT_UNORM;
    const bool is_binary32 = !is_unorm && format->mantissa_bits == BINARY32_MANTISSA;
    const double step = is_unorm ? 1.0 / (double)format->code_max : ldexp(1.0, e - format->mantissa_bits);
    const double half = fmin(0x1p-25, 0x1p-24 * (ldexp(2.0, e) + step + m)); /* half a step of binary32 below 1 */
    const double apart = m > 0.0 ? m + 2.0 * half : 0.0;
    if (goal->api->guaranteed)
        return r + apart;
    return (is_binary32 ? step : is_unorm ? step + half : 2.0 * step + half) + apart;
}

/* The least that a program can set: whole where the API counts in r, a binary32 number where it takes a float. */
static double round_up(const bias_api *api, const dp_format *format, double units) {
    const bias_rule rule = format->kind == DP_FORMAT_FLOAT ? api->real : api->unorm;
    const double counted = rule == BIAS_ONE ? units : ceil(units);
    const double rounded = api->whole ? counted : (double)dp_float_up(counted);
    return rounded <= units_most ? rounded : (double)INFINITY;
}

/* How many units reach a window distance. One that is no normal binary32 number may be flushed to 0: none suffice. */
static double units_to(double window, double r) {
    return r >= 0x1p-126 ? window / r : window > 0.0 ? (double)INFINITY : 0.0;
}

double bias_units(const bias_api *api, const dp_format *format, double d, double window) {
    const double outward = api->binary32 ? DP_ROUNDINGS32_2 : DP_ROUNDINGS_30;
    return round_up(api, format, units_to((1.0 + outward) * window, bias_unit_at(api, format, d).least));
}

/* The goal asks this of units that make an offset of `window`. */
static double asked_of(const bias_goal *goal, const dp_format *format, double window, double r) {
    return goal->judged ? units_to(window, r) : round_up(goal->api, format, units_to(fmax(window, 0.0), r));
}

/*
 * Whether the clamp, or the planes, leave a layer no room to move by `window` at z, its depth having been displaced by
 * `off`: beyond a plane both depths are clamped to it.
 */
static bool is_held(const dp_setup *setup, const bias_goal *goal, double z, double window, double off) {
    const dp_format *format = &setup->spec.format;
    const double code = format->kind == DP_FORMAT_UNORM ? 1.0 / (double)format->code_max : 0.0; /* r may be less */
    const double d = dp_window(setup, z), whole = (fmax(window, code) + off) * (1.0 + 0x1p-20);
    if (goal->clamp > 0.0 && whole > goal->clamp)
        return true;
    return goal->judged &&
           (whole > fabs(d - setup->ends[0]) || (setup->spec.triangles.width > 0 && whole > fabs(setup->ends[1] - d)));
}

/* bias_needed() at z for a primitive whose greatest window depth has the exponent e. */
static double needed_with(const dp_setup *setup, const bias_goal *goal, double z, int e) {
    const dp_format *format = &setup->spec.format;
    const double r = unit_of(goal->api, format, e);
    const double m = bias_window_slope(setup, z, goal->slope);
    const double step = certain_step(goal, format, e, worth_of(goal->api, format, e), m);
    const double gap = window_of_gap(setup, z, goal->gap);
    const double window = fmax(step, gap) - goal->factor * m;
    /* Covers the roundings above and, where o itself is rounded to binary32, those; a single step is exact. */
    const double outward = gap <= step && m == 0.0 ? 0.0 : goal->api->binary32 ? DP_ROUNDINGS32_2 : DP_ROUNDINGS_30;
    if (is_held(setup, goal, z, fmax(step, gap), 0.0))
        return (double)INFINITY;
    return asked_of(goal, format, window + (fmax(step, gap) + fabs(goal->factor) * m) * outward, r);
}

double bias_factor_least(const dp_setup *setup) {
    static const double spare = 1.0 + 0x1p-9; /* for the roundings of products and sums, see needed_slanted() */
    dp_coplanar apart = {0};
    if (setup->spec.triangles.width == 0)
        return 0.0;
    if (dp_coplanar_over(setup, setup->spec.znear, setup->spec.znear, &apart) != DP_OK || !(apart.lost < 0.5))
        return (double)INFINITY;
    return ceil(apart.pixels / (1.0 - apart.lost) * spare * 0x1p12) * 0x1p-12;
}

/*
 * The part of the need that the slope adds, in window depth: at m and below, or at any. The rasterizer's own slope, at
 * least (1 - lost) m - lost_window, is never below 0: the factor takes nothing, and a larger one takes no more.
 */
static double taken_by_slope(const dp_setup *setup, const bias_goal *goal, const dp_coplanar *apart, double m) {
    const double unseen = apart->lost < 1.0 ? apart->lost_window / (1.0 - apart->lost) : (double)INFINITY;
    const double paid =
        (apart->pixels - goal->factor) * m + fabs(goal->factor) * (apart->lost * m + apart->lost_window);
    if (goal->slope == 0.0)
        return bias_factor_least(setup) * apart->lost_window;
    if (goal->factor > 0.0 && m <= unseen)
        return apart->pixels * m;
    return goal->factor > 0.0 ? fmax(paid, apart->pixels * unseen) : paid;
}

/* By how much the slope displaces two drawings at z: at any slant a triangle, at least a pixel high, has no steeper one
 * than its range of depths. */
static double off_by_slope(const dp_setup *setup, const bias_goal *goal, const dp_coplanar *apart, double z) {
    const double nearest = fmax(z / setup->spec.triangles.depth, setup->spec.znear);
    const double farthest = fmin(z * setup->spec.triangles.depth, setup->spec.zfar);
    const double range = fabs(dp_window(setup, nearest) - dp_window(setup, farthest)) + apart->window;
    const bool any = goal->slope == 0.0;
    return any && goal->clamp > 0.0 ? (double)INFINITY
                                    : apart->pixels * (any ? range : bias_window_slope(setup, z, goal->slope));
}

/*
 * bias_needed() for one plane drawn twice, at every depth of a range. A primitive's greatest depth is at least the
 * pixel's, which is displaced: r is that of the binade below where it is near the end of one, and the step that of the
 * binade above. At any slant a displacement by more than `beyond` of the depth is paid for by what the factor has to
 * spare, 2^-9 of it.
 */
static double needed_slanted(const dp_setup *setup, const bias_goal *goal, double lo, double hi, double *worst) {
    const dp_format *format = &setup->spec.format;
    const double ends[2] = {lo, hi};
    const double d_lo = fmin(dp_window(setup, lo), dp_window(setup, hi));
    const double d_hi = fmax(dp_window(setup, lo), dp_window(setup, hi));
    const double steepest = fmax(bias_window_slope(setup, lo, goal->slope), bias_window_slope(setup, hi, goal->slope));
    dp_coplanar apart;
    *worst = lo;
    if (dp_coplanar_over(setup, lo, hi, &apart) != DP_OK ||
        (goal->slope == 0.0 && (isinf(goal->factor) || goal->factor < bias_factor_least(setup))))
        return (double)INFINITY;
    const double off = apart.window + apart.pixels * steepest;
    const int here = exponent_of(format, fmin(d_hi + off, 1.0));
    const double least_step = certain_step(goal, format, here, worth_of(goal->api, format, here), 0.0);
    const double beyond = goal->slope == 0.0 ? fmin(256.0 * (least_step + apart.window) / d_lo, 1.0) : 0.0;
    const int below = exponent_of(format, fmax(d_lo * (1.0 - beyond) - off, 0.0));
    const double r = unit_of(goal->api, format, below);
    const int above = exponent_of(format, fmin(d_hi * (1.0 + beyond) + off, 1.0));
    const double step = certain_step(goal, format, above, worth_of(goal->api, format, below), 0.0) + apart.window;
    double needed = 0.0;
    for (int i = 0; i < 2; i++) {
        const double m = bias_window_slope(setup, ends[i], goal->slope);
        const double whole = fmax(step, window_of_gap(setup, ends[i], goal->gap));
        const double window = whole + taken_by_slope(setup, goal, &apart, m);
        const double outward = 0x1p-20 * (fabs(window) + (apart.pixels + fabs(goal->factor)) * m);
        const bool held = is_held(setup, goal, ends[i], whole, off_by_slope(setup, goal, &apart, ends[i]));
        const double units = held ? (double)INFINITY : asked_of(goal, format, window + outward, r);
        if (i == 0 || units > needed) {
            needed = units;
            *worst = ends[i];
        }
    }
    return needed;
}

/* Binade by binade of d, from the camera outwards, each in three parts: only those at its ends are near another one. */
static double needed_over_slanted(const dp_setup *setup, const bias_goal *goal, double lo, double hi, double *worst) {
    static const double parts[4] = {1.0, 1.0 + 0x1p-6, 2.0 - 0x1p-5, 2.0};
    const dp_format *format = &setup->spec.format;
    const double d_lo = dp_window(setup, lo), d_hi = dp_window(setup, hi);
    const int first = exponent_of(format, fmin(d_lo, d_hi));
    const int last = exponent_of(format, fmax(d_lo, d_hi));
    double most = -(double)INFINITY;
    for (int i = 0; i < 3 * (last - first + 1); i++) {
        const int at = setup->reversed ? 3 * (last - first + 1) - 1 - i : i;
        double ends[2], z;
        for (int end = 0; end < 2; end++) {
            const double d = fmin(ldexp(parts[at % 3 + end], first + at / 3), 1.0);
            ends[end] = fmin(fmax(dp_eye(setup, d, 1.0 - d), lo), hi);
        }
        if (at == 0) /* depths below the least exponent's */
            ends[0] = d_lo < d_hi ? lo : hi;
        const double needed = needed_slanted(setup, goal, fmin(ends[0], ends[1]), fmax(ends[0], ends[1]), &z);
        if (needed > most) {
            most = needed;
            *worst = z;
        }
    }
    return most;
}

double bias_needed(const dp_setup *setup, const bias_goal *goal, double z) {
    double worst;
    if (setup->spec.triangles.width > 0)
        return needed_slanted(setup, goal, z, z, &worst);
    return needed_with(setup, goal, z, exponent_of(&setup->spec.format, dp_window(setup, z)));
}

/*
 * r and the steps change only where the exponent of d does, and between two such places the need is monotone in z, or
 * was 0 before it rises: the greatest is at an end of the range or of a binade of d, seen from either side.
 */
double bias_needed_over(const dp_setup *setup, const bias_goal *goal, double lo, double hi, double *worst) {
    if (setup->spec.triangles.width > 0)
        return needed_over_slanted(setup, goal, lo, hi, worst);
    const dp_format *format = &setup->spec.format;
    const double d_lo = dp_window(setup, lo);
    const double d_hi = isinf(hi) ? setup->ends[1] : dp_window(setup, hi);
    const int first = exponent_of(format, fmin(d_lo, d_hi));
    const int last = exponent_of(format, fmax(d_lo, d_hi));
    double most = -(double)INFINITY;
    for (int i = 0; i <= last - first; i++) {
        const int e = setup->reversed ? last - i : first + i; /* from the camera outwards */
        const double least = e == first ? fmin(ldexp(1.0, e), fmin(d_lo, d_hi)) : ldexp(1.0, e); /* below all binades */
        const double ends[2] = {setup->reversed ? ldexp(1.0, e + 1) : least,
                                setup->reversed ? least : ldexp(1.0, e + 1)};
        for (int end = 0; end < 2; end++) {
            const double d = fmin(ends[end], 1.0);
            const double z = fmin(fmax(dp_eye(setup, d, 1.0 - d), lo), hi);
            const double needed = needed_with(setup, goal, z, e);
            if (needed > most) {
                most = needed;
                *worst = z;
            }
        }
    }
    return most;
}

static bool enough_between(const dp_setup *setup, const bias_goal *goal, double units, double a, double b) {
    double worst;
    const double needed =
        a == b ? bias_needed(setup, goal, a) : bias_needed_over(setup, goal, fmin(a, b), fmax(a, b), &worst);
    return isfinite(needed) && needed <= units;
}

/* The depth farthest from `start` towards `end` up to which a bias is enough. */
static double enough_towards(const dp_setup *setup, const bias_goal *goal, double units, double start, double end) {
    if (start == end || enough_between(setup, goal, units, start, end))
        return end;
    dp_edge e = {.holds = start, .fails = isinf(end) ? 1e300 : end, .apart = 0x1p-48};
    for (double z; dp_edge_between(&e, &z);)
        *(enough_between(setup, goal, units, start, z) ? &e.holds : &e.fails) = z;
    return e.holds;
}

void bias_enough_over(const dp_setup *setup, const bias_goal *goal, double units, double lo, double hi, double *from,
                      double *to) {
    enum { TRIED = 64 };
    const double last = isinf(hi) ? 0x1p64 * lo : hi; /* an infinite far is that of a perspective: lo is positive */
    double start = enough_between(setup, goal, units, lo, lo) ? lo : fmin(last, hi);
    for (int i = 1; i < TRIED && !enough_between(setup, goal, units, start, start); i++)
        start = lo > 0.0 ? lo * dp_pow(last / lo, (double)i / TRIED) : lo + (last - lo) * i / TRIED;
    *from = *to = (double)NAN;
    if (!enough_between(setup, goal, units, start, start))
        return;
    *from = enough_towards(setup, goal, units, start, lo);
    *to = enough_towards(setup, goal, units, start, hi);
}
