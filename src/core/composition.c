/* SPDX-License-Identifier: MIT */
/*
 * depthprec(7), "Composition", derives every line. The view axis a has length 1, so with |coordinates| <= W Cauchy's
 * inequality bounds what is summed: one product by W, two by sqrt(2) W, three by sqrt(3) W, and with the constant
 * -a . camera on top by sqrt(6) W and 3 W.
 */
#include "core/composition.h"

#include <math.h>

#include "core/curve.h"
#include "core/extremes.h"
#include "core/rounding.h"

static const double root2 = 1.41421357;
static const double root3 = 1.73205081;
static const double root6 = 2.44948975;

/* Terms of second order, and what rounded terms of a sum are larger than real ones. */
static const double outward = 1.0 + DP_ROUNDINGS32_254;

static const dp_composition_row rows[DP_COMPOSITION_COUNT] = {
    [DP_COMPOSITION_ONCE] = {"once",
                             "view and projection in one matrix, formed in double and rounded once to binary32"},
    [DP_COMPOSITION_PRODUCTS] = {"products", "binary32 view and projection matrices, multiplied in binary32 into one"},
    [DP_COMPOSITION_RELATIVE] = {"relative",
                                 "positions less the camera's, in double, rounded to binary32: no translation"},
};

const dp_composition_row *dp_composition_get(dp_composition composition) {
    return (unsigned)composition < DP_COMPOSITION_COUNT ? &rows[composition] : NULL;
}

/* The largest error of rounding a number of magnitude up to about x. */
static double half_ulp(double x) {
    return dp_half_ulp(x * outward);
}

static int is_power2(double x) {
    return x > 0.0 && x == dp_power2(dp_exponent(x));
}

/* The last sum, a z + b with a and b of opposite signs: no larger than either. With depths of any sign both add up. */
static void last_sum(dp_row_off *r, const dp_composing *in, double scale, double b, double z, double until) {
    const double constant = b > 0.0 ? half_ulp(b) : 0.0;
    const double added = in->any_sign ? b : 0.0;
    const double sum = larger(constant, isinf(until) ? DP_UNIT * (scale * z + added) : half_ulp(scale * until + added));
    r->sums += sum;
    r->late += sum;
    r->grow += isinf(until) ? DP_UNIT * scale : 0.0;
}

/*
 * The two sums before, in any order, of the products of a row over the world and its constant. The constant on top of
 * some products is what is left of z without the others.
 */
static void world_sums(dp_row_off *r, double most, double b, double depth) {
    const double two = half_ulp(root2 * most);
    const double three = half_ulp(root3 * most);
    const double one_on_top = half_ulp(smaller(root6 * most, root2 * most + depth) + b);
    const double two_on_top = half_ulp(smaller(3.0 * most, most + depth) + b);
    r->late = one_on_top + two_on_top;
    r->sums = larger(two + larger(three, larger(one_on_top, two_on_top)), r->late);
}

/* A row of one matrix over the world: scale times (axis, -axis . camera), and b added to the constant. */
static dp_row_off world_row(const dp_composing *in, double scale, double b, double z, double until) {
    const double w = in->world;
    const double most = scale * w;
    dp_row_off r = {.position = root3 * scale * half_ulp(w)};
    r.products = in->fused ? smaller(root2 * DP_UNIT * most, 2.0 * half_ulp(most))
                           : smaller(root3 * DP_UNIT * most, 3.0 * half_ulp(most));
    world_sums(&r, most, b, scale * until);
    last_sum(&r, in, scale, b, z, until);
    r.entries = smaller(root3 * DP_UNIT * scale, 3.0 * half_ulp(scale)) * w;
    r.constant = half_ulp(root3 * most + b);
    r.turn = DP_UNIT * scale * in->ray_ratio;
    return r;
}

/* How far from the camera surfaces are up to the eye depth `at`. */
static double length_of(const dp_composing *in, double at) {
    return in->ortho ? smaller(root2 * in->reach, 2.0 * root3 * in->world) : in->ray_ratio * at;
}

/*
 * A row of a matrix without translation, over positions no farther than `length` from the camera. Some of three
 * products that sum up to z are at most (length + z)/2. Without a constant there is one sum fewer.
 */
static dp_row_off relative_row(const dp_composing *in, double scale, double b, double z, double until, double length) {
    const double at = isinf(until) ? z : until;
    const double per_z = in->ortho ? 0.0 : in->ray_ratio;
    const double in_double = 0x1p-53 * (root3 * in->world + length);
    const int sums = b > 0.0 ? 2 : 1;
    const double part = 0.5 * scale * (length + at) + b;
    dp_row_off r = {.position = scale * (DP_UNIT * length + in_double), .products = DP_UNIT * scale * length};
    r.late = r.sums = sums * (isinf(until) ? DP_UNIT * part : half_ulp(part));
    r.grow = isinf(until) ? DP_UNIT * scale * (2.0 * per_z + sums * 0.5 * (per_z + 1.0)) : 0.0;
    last_sum(&r, in, scale, b, z, until);
    r.entries = DP_UNIT * scale * length;
    r.turn = DP_UNIT * scale * in->ray_ratio;
    return r;
}

/* The row of clip z. A constant alone, where A is 0, is exact. */
static dp_row_off clip_row(const dp_composing *in, double z, double until) {
    const double scale = fabs(in->a);
    const double b = fabs(in->b);
    if (scale == 0.0)
        return (dp_row_off){0};
    const int relative = in->composition == DP_COMPOSITION_RELATIVE;
    const double length = length_of(in, isinf(until) ? z : until);
    dp_row_off r = relative ? relative_row(in, scale, b, z, until, length) : world_row(in, scale, b, z, until);
    const int products = in->composition == DP_COMPOSITION_PRODUCTS;
    if (products && is_power2(scale))
        r.entries = r.turn = 0.0;
    else if (products)
        r.constant += half_ulp(root3 * scale * in->world);
    else if (!relative)
        r.constant += half_ulp(b); /* A and B are rounded as parts of entries here, and not by themselves */
    if (!products && !isinf(in->zfar)) {
        r.constant += half_ulp(scale) * z;
        r.turn += half_ulp(scale);
    }
    return r;
}

/* The row of clip w. Of three entries of a vector of length 1 none is rounded by more than H(1/2). */
static dp_row_off w_row(const dp_composing *in, double z, double until) {
    if (in->ortho)
        return (dp_row_off){0};
    const int relative = in->composition == DP_COMPOSITION_RELATIVE;
    const double length = length_of(in, isinf(until) ? z : until);
    dp_row_off r = relative ? relative_row(in, 1.0, 0.0, z, until, length) : world_row(in, 1.0, 0.0, z, until);
    r.entries = relative ? 0.5 * root3 * DP_UNIT * in->ray_ratio * z : 1.5 * DP_UNIT * in->world;
    r.turn = 0.5 * root3 * DP_UNIT * in->ray_ratio;
    return r;
}

static dp_composed orthographic(dp_composed m, const dp_composing *in, double z, double until) {
    const double scale = fabs(in->a);
    const double remap = in->remap ? DP_UNIT * (scale * (isinf(until) ? z : until) + fabs(in->b) + 1.0) : 0.0;
    m.own = (m.clip.position + m.clip.products + m.clip.sums + remap) / scale;
    m.shared = (m.clip.entries + m.clip.constant) / scale;
    m.loss = (m.clip.grow + m.clip.turn) / scale + (in->remap && isinf(until) ? DP_UNIT : 0.0);
    return m;
}

/*
 * The error of clip z beside A times that of w. A rounded coordinate moves both along the line. Where both rows have
 * the same entries, but for a power of two, so do their roundings, and those of the products.
 */
static dp_composed perspective(dp_composed m, const dp_composing *in, double z, double until) {
    const double scale = fabs(in->a);
    const double slope = fabs(in->b);
    double remap = 0.0; /* the sum of clip z and w in the shader, before it is halved */
    if (in->remap)
        remap = DP_UNIT * ((scale + 1.0) * (isinf(until) ? z : until) + slope) / slope;
    const int rounded = in->composition != DP_COMPOSITION_PRODUCTS; /* w's entries too, apart from clip z's */
    const int alike = is_power2(scale) && (!rounded || isinf(in->zfar));
    const dp_row_off *c = &m.clip;
    const dp_row_off *w = &m.w;
    m.own = w->position + w->products + w->sums;
    m.shared = w->entries + w->constant;
    m.loss = w->grow + w->turn;
    m.own_tilt = alike ? c->late + scale * w->late : c->sums + c->products + scale * (w->sums + w->products);
    m.own_tilt = m.own_tilt / slope + remap;
    m.shared_tilt = c->constant + (rounded ? scale * w->constant : 0.0);
    if (!alike)
        m.shared_tilt += c->entries + (rounded ? scale * w->entries : 0.0);
    m.shared_tilt /= slope;
    m.loss_tilt = c->grow + scale * w->grow + (alike ? 0.0 : c->turn + (rounded ? scale * w->turn : 0.0));
    m.loss_tilt += in->remap && isinf(until) ? DP_UNIT * (scale + 1.0) : 0.0;
    m.loss_tilt /= slope;
    return m;
}

dp_composed dp_composition_at(const dp_composing *in, double z, double until) {
    const double size = fabs(z);
    const double farthest = isinf(until) ? until : larger(size, fabs(until));
    dp_composed m = {.clip = clip_row(in, size, farthest), .w = w_row(in, size, farthest)};
    m = in->ortho ? orthographic(m, in, size, farthest) : perspective(m, in, size, farthest);
    const double tilt = m.own_tilt + m.shared_tilt;
    const double moved = m.own + m.shared;
    m.reach = tilt < 1.0 ? (moved + z * tilt) / (1.0 - tilt) * outward : HUGE_VAL;
    return m;
}

double dp_composition_separation(const dp_composed *m, double z, double plain, int clamped) {
    const double most_tilt = m->own_tilt + m->shared_tilt;
    const double eye = clamped ? m->own + larger(m->own, m->shared) : 2.0 * m->own;
    const double tilt = clamped ? m->own_tilt + larger(m->own_tilt, m->shared_tilt) : 2.0 * m->own_tilt;
    if (!(most_tilt < 1.0))
        return HUGE_VAL;
    const double stretched = (z + m->own + m->shared) / (1.0 - most_tilt);
    const double slope = 1.0 - m->loss - m->loss_tilt * (plain + stretched);
    const double need = eye + tilt * stretched + (1.0 + most_tilt + tilt) * plain;
    return slope > 0.0 ? need / slope * outward : HUGE_VAL;
}

dp_composed_vertex dp_composition_vertex(const dp_composing *in, const dp_composed_view *view, double farthest) {
    const int relative = in->composition == DP_COMPOSITION_RELATIVE;
    const dp_composed m = dp_composition_at(in, farthest, farthest);
    dp_composed_vertex v = {.position = m.w.position * (relative ? 1.0 : outward),
                            .along = m.w.products + m.w.sums,
                            .tilt = m.own_tilt,
                            .shared = m.shared_tilt,
                            .turn = 4.0 * DP_UNIT};
    for (int i = 0; i < 2; i++) {
        const double scale = view->scale[i];
        const double most = view->ray[i] * farthest;
        const dp_row_off r = relative ? relative_row(in, scale, 0.0, most, most, length_of(in, farthest))
                                      : world_row(in, scale, 0.0, most, most);
        v.across[i] = (r.products + r.sums) / scale;
    }
    return v;
}
