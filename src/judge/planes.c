/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * 1/z, orthographic z, is affine in the window depth, and so is a window depth in 1/z: a line through the pairs has the
 * planes at its ends. Errors are relative, or alike at all depths.
 */
#include "judge/planes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { POINTS = 4096 };

/* Points of a line, y over u. */
typedef struct points {
    double u[POINTS], y[POINTS], weight[POINTS];
    size_t count;
} points;

static double standard(const dp_setup *setup, double d) {
    return setup->reversed ? 1 - d : d;
}

static void gather(const judge_pairs *p, const dp_setup *setup, const judge_input *input, const judge_output *output,
                   bool alike, points *out) {
    const bool ortho = setup->spec.ortho;
    const size_t step = 1 + p->count / POINTS;
    for (size_t i = 0; i < p->count && out->count < POINTS; i += step) {
        const judge_pair *pair = &p->pairs[i];
        const double share = input->window != NULL ? standard(setup, input->window(pair->in)) : 0;
        const double z = input->metric * pair->in, u = input->window != NULL ? share : ortho ? z : 1 / z;
        const double y =
            input->window != NULL ? output->line(pair->out, share, ortho) : standard(setup, output->window(pair->out));
        if (!isfinite(u) || !isfinite(y))
            continue;
        out->u[out->count] = u;
        out->y[out->count] = y;
        out->weight[out->count++] = input->window != NULL && y != 0 && !alike ? 1 / (y * y) : 1;
    }
}

/* y = far/near at 0, 1 at 1. */
static double ratio_of(const points *p) {
    double above = 0, below = 0;
    for (size_t i = 0; i < p->count; i++) {
        above += p->weight[i] * (1 - p->u[i]) * (p->y[i] - p->u[i]);
        below += p->weight[i] * (1 - p->u[i]) * (1 - p->u[i]);
    }
    return above / below;
}

/* y = c0 + c1 u by least squares. */
static void line_of(const points *p, double *c0, double *c1) {
    double weight = 0, u = 0, y = 0, above = 0, below = 0;
    for (size_t i = 0; i < p->count; i++) {
        weight += p->weight[i];
        u += (p->u[i] - u) * (p->weight[i] / weight);
        y += (p->y[i] - y) * (p->weight[i] / weight);
    }
    for (size_t i = 0; i < p->count; i++) {
        above += p->weight[i] * (p->u[i] - u) * (p->y[i] - y);
        below += p->weight[i] * (p->u[i] - u) * (p->u[i] - u);
    }
    *c1 = above / below;
    *c0 = y - u * *c1;
}

/* No depth that went in lies outside the planes. Where far is 10^4 times near, the far plane of a line that fits may be
 * a little nearer than the last depth; one beyond infinity, which is negative here, stays there. */
static void take_in(const judge_pairs *p, const judge_input *input, double *znear, double *zfar) {
    for (size_t i = 0; i < p->count; i++) {
        const double z = input->metric * p->pairs[i].in;
        *znear = fmin(*znear, z);
        *zfar = *zfar > 0 ? fmax(*zfar, z) : *zfar;
    }
}

bool judge_planes_of(const judge_pairs *pairs, const dp_setup *setup, const judge_input *input,
                     const judge_output *output, bool alike, double *znear, double *zfar) {
    static _Thread_local points p;
    const bool ortho = setup->spec.ortho, ratio = output->planes == JUDGE_PLANES_RATIO;
    const bool decodes = input->window != NULL && output->planes != JUDGE_PLANES_NONE;
    const bool encodes = input->metric != 0 && output->window != NULL;
    double c0, c1;
    if (setup->curve == DP_CURVE_LOG || (!ortho && setup->curve != DP_CURVE_PERSPECTIVE) || !(decodes || encodes))
        return false;
    p.count = 0;
    gather(pairs, setup, input, output, alike, &p);
    if (p.count < JUDGE_FITTED_LEAST)
        return false;
    if (decodes && ratio) {
        *zfar = setup->spec.zfar;
        *znear = ortho ? *zfar * ratio_of(&p) : *zfar / ratio_of(&p);
        return isfinite(*zfar);
    }
    line_of(&p, &c0, &c1);
    if (decodes) {
        *znear = ortho ? c0 : 1 / c0;
        *zfar = ortho ? c0 + c1 : 1 / (c0 + c1);
    } else {
        *znear = ortho ? -c0 / c1 : -c1 / c0;
        *zfar = ortho ? (1 - c0) / c1 : *znear / (1 - 1 / c0);
        take_in(pairs, input, znear, zfar);
    }
    return true;
}

static double rounded(double x, int digits) {
    char text[32];
    snprintf(text, sizeof text, "%.*e", digits - 1, x);
    return strtod(text, NULL);
}

bool judge_planes_set(dp_setup *setup, double znear, double zfar, int digits, bool infinite) {
    dp_spec spec = setup->spec;
    spec.znear = rounded(znear, digits);
    spec.zfar = infinite ? (double)INFINITY : rounded(zfar, digits);
    return dp_setup_init(setup, &spec) == DP_OK;
}
