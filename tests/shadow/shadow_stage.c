/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shadow_stage.h"

#include <float.h>

static const double pi = 3.14159265358979323846;

void shadow_stage_turn(rng *r, double axis[3][3]) {
    const double a = rng_uniform(r, 0, 2 * pi), b = rng_uniform(r, -pi / 2, pi / 2), c = rng_uniform(r, 0, 2 * pi);
    const double u[3] = {cos(a) * cos(b), sin(a) * cos(b), sin(b)}, v[3] = {-sin(a), cos(a), 0};
    const double w[3] = {-cos(a) * sin(b), -sin(a) * sin(b), cos(b)};
    for (int i = 0; i < 3; i++) {
        axis[0][i] = cos(c) * v[i] + sin(c) * w[i];
        axis[1][i] = cos(c) * w[i] - sin(c) * v[i];
        axis[2][i] = u[i];
    }
}

static void to_world(const shadow_stage *s, const double p[3], double out[3]) {
    const double along = p[2] - 0.5 * (s->n + s->f);
    for (int i = 0; i < 3; i++)
        out[i] = s->middle[i] + s->axis[0][i] * p[0] + s->axis[1][i] * p[1] + s->axis[2][i] * along;
}

void shadow_stage_matrix(shadow_stage *s) {
    const double sign = s->light.setup.reversed ? -1.0 : 1.0;
    const double scale[3] = {2.0 / s->light.width, 2.0 / s->light.height, sign / (s->f - s->n)};
    for (int row = 0; row < 3; row++) {
        double moved = 0;
        for (int i = 0; i < 3; i++) {
            s->matrix[row][i] = (float)(s->axis[row][i] * scale[row]);
            moved -= s->axis[row][i] * s->middle[i] * scale[row];
        }
        s->matrix[row][3] = (float)(row == 2 ? moved + 0.5 : moved);
    }
}

/* Clip coordinates of a place as a shader has it. */
static void transform(const shadow_stage *s, const float p[3], float clip[3]) {
    for (int row = 0; row < 3; row++) {
        const float *m = s->matrix[row];
        float sum = m[0] * p[0];
        for (int i = 1; i < 3; i++) {
            const float product = m[i] * p[i];
            sum = s->fused ? fmaf(m[i], p[i], sum) : sum + product;
        }
        clip[row] = sum + m[3];
    }
}

void shadow_stage_place(const shadow_stage *s, double u, double v, double *x, double *y) {
    *x = (u / s->target.width - 0.5) * s->light.width;
    *y = (v / s->target.height - 0.5) * s->light.height;
}

/* ---- The map ----------------------------------------------------------------------------------------------------- */

static float stored_value(const shadow_stage *s, float d) {
    const dp_format *format = &s->light.setup.spec.format;
    const float in = d < 0.0F ? 0.0F : d > 1.0F ? 1.0F : d;
    if (format->kind == DP_FORMAT_FLOAT)
        return in;
    const float product = in * (float)format->code_max;
    const float code = strcmp(s->name, "softpipe") == 0 ? truncf(product) : rintf(product);
    return (float)((double)code / (double)format->code_max);
}

static float rounded_up(double x) {
    const float near = (float)x;
    return (double)near < x ? nextafterf(near, FLT_MAX) : near;
}

bool shadow_stage_draw(const shadow_stage *s, float *depth, float *slope) {
    raster_vertex v[3];
    raster_triangle drawn;
    int from, to;
    for (int i = 0; i < 3; i++) {
        double place[3];
        float clip[3];
        to_world(s, (const double[3]){s->caster[i][0], s->caster[i][1], s->caster[i][2] - s->raised}, place);
        const float p[3] = {(float)place[0], (float)place[1], (float)place[2]};
        transform(s, p, clip);
        v[i] = (raster_vertex){clip[0], clip[1], clip[2], 1.0F};
        if (fabsf(clip[0]) > 1.0F || fabsf(clip[1]) > 1.0F || clip[2] < 0.0F || clip[2] > 1.0F)
            return false;
    }
    if (raster_set_up(&s->target, v, &drawn) != RASTER_OK || drawn.count != 1 ||
        !raster_span(&s->target, &drawn.piece[0], s->py, &from, &to) || s->px < from || s->px >= to)
        return false;
    raster_depths(&s->target, &drawn.piece[0], s->py, s->px, s->px + 1, depth);
    *slope = fmaxf(fabsf(drawn.piece[0].plane.a), fabsf(drawn.piece[0].plane.b));
    return true;
}

/*
 * Whether a lookup at texture coordinate t reads the texel, with a rounding and an edge that favour it as far as
 * texture units may: 0.6 of a step, and either of two texels at a border.
 */
static bool reads(const shadow_stage *s, float t, int size, int texel) {
    const int bits = s->light.subtexel;
    const double off = (double)(t * (float)size) - (texel + 0.5);
    const double steps = ldexp(fabs(off), bits);
    const double at = bits > 0 ? ldexp(rint(steps - 0.1), -bits) : fabs(off);
    return at <= s->light.kernel;
}

/* The offset that an API adds for its units and its factor; the greatest depth of the primitive decides their worth.
 */
static float added_by(const shadow_stage *s, const shadow_state *state, const bias_api *api, float slope) {
    const dp_format *format = &s->light.setup.spec.format;
    const bool is_float = format->kind == DP_FORMAT_FLOAT;
    const bias_rule rule = is_float ? api->real : api->unorm;
    float deepest = 0.0F;
    int e;
    for (int i = 0; i < 3; i++) {
        double place[3];
        float clip[3];
        to_world(s, s->caster[i], place);
        transform(s, (const float[3]){(float)place[0], (float)place[1], (float)place[2]}, clip);
        deepest = fmaxf(deepest, clip[2]);
    }
    (void)frexpf(deepest, &e);
    const float unit = rule == BIAS_ONE        ? 1.0F
                       : rule == BIAS_EXPONENT ? ldexpf(1.0F, e - 24)
                       : rule == BIAS_MANTISSA ? 0x1p-24F
                       : rule == BIAS_CODE     ? (float)(1.0 / (double)format->code_max)
                                               : ldexpf(1.0F, -format->bits);
    const float constant = (float)state->units * unit;
    return state->factor > 0.0 ? constant + (float)state->factor * slope : constant;
}

bool shadow_stage_lit(const shadow_stage *s, shadow_way way, double share, const bias_api *api,
                      const shadow_spot *point, float depth, float slope, bool *judged) {
    const shadow_bias *bias = &s->need.bias[way];
    double place[3];
    float p[3], clip[3];
    const double cosine = -point->normal[2], sine = sqrt(1.0 - cosine * cosine);
    const float off = (float)(share * bias->offset * sine);
    double normal[3] = {0};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            normal[i] += s->axis[k][i] * point->normal[k];
    to_world(s, point->at, place);
    for (int i = 0; i < 3; i++) {
        const float rounded = (float)place[i], moved = off * (float)normal[i];
        p[i] = way == SHADOW_NORMAL ? rounded + moved : rounded;
    }
    transform(s, p, clip);
    *judged = reads(s, clip[0] * 0.5F + 0.5F, s->target.width, s->px) &&
              reads(s, clip[1] * 0.5F + 0.5F, s->target.height, s->py);
    const float sign = (float)shadow_sign(&s->light);
    float o = rounded_up(share * bias->window);
    if (way == SHADOW_SLOPE)
        o = o + rounded_up(share * bias->factor) * slope;
    if (api != NULL) {
        const shadow_state state = shadow_state_of(&s->light, bias, api);
        if (isinf(state.units))
            return true; /* said to be impossible */
        o = added_by(s, &state, api, slope);
    }
    const bool shader = s->in_shader && way != SHADOW_SLOPE && api == NULL;
    const float value = stored_value(s, shader ? depth : depth + sign * o);
    const float reference = shader ? clip[2] - sign * o : clip[2];
    return s->light.setup.reversed ? reference >= value : reference <= value;
}
