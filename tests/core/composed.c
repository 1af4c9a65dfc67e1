/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "composed.h"
#include "nvidia.h"

enum { SAMPLES = 160, BEHIND = 16 };

/* ---- The pipeline --------------------------------------------------------------------------------------- */

static void project(double n, double f, bool reversed, bool is_signed, bool ortho, double *a, double *b) {
    if (ortho) {
        *a = is_signed ? 2.0 / (f - n) : 1.0 / (f - n);
        *b = is_signed ? -(f + n) / (f - n) : -n / (f - n);
    } else if (isinf(f)) {
        *a = 1.0;
        *b = is_signed ? -2.0 * n : -n;
    } else {
        *a = is_signed ? (f + n) / (f - n) : f / (f - n);
        *b = is_signed ? -2.0 * n * f / (f - n) : -n * f / (f - n);
    }
    if (reversed && is_signed) {
        *a = -*a;
        *b = -*b;
    } else if (reversed) { /* w less clip z */
        *a = ortho ? -*a : isinf(f) ? 0.0 : -n / (f - n);
        *b = ortho ? f / (f - n) : -*b;
    }
}

bool composed_make(set_up *s, double n, double f, dp_mapping mapping, const char *format, dp_arith arith, bool ortho,
                   dp_budget_terms terms) {
    dp_format formats[2];
    dp_format_parse(format, formats);
    dp_spec spec = dp_spec_default();
    spec.znear = n;
    spec.zfar = f;
    spec.mapping = mapping;
    spec.format = formats[0];
    spec.arith = arith;
    spec.ortho = ortho;
    spec.model = DP_MODEL_FLOAT;
    *s = (set_up){.arith = dp_arith_get(arith),
                  .reversed = mapping == DP_MAPPING_REVERSED || mapping == DP_MAPPING_GL_REVERSED,
                  .is_signed = mapping == DP_MAPPING_GL || mapping == DP_MAPPING_GL_REVERSED,
                  .ortho = ortho,
                  .terms = terms};
    project(n, f, s->reversed, s->is_signed, ortho, &s->a, &s->b);
    return dp_setup_init(&s->setup, &spec) == DP_OK;
}

/* The matrix of one camera. `relative` has no translation. */
static void compose(const set_up *s, camera *c) {
    const bool relative = s->terms.composition == DP_COMPOSITION_RELATIVE;
    double t = 0.0;
    for (int k = 0; k < 3; k++)
        t -= relative ? 0.0 : c->axis[k] * c->eye[k];
    const float a = (float)s->a;
    const float b = (float)s->b;
    for (int k = 0; k < 4; k++) {
        const double view = k < 3 ? c->axis[k] : t;
        const float entry = (float)view;
        const float product = a * entry;
        c->w[k] = s->ortho ? (k == 3 ? 1.0F : 0.0F) : entry;
        if (s->terms.composition == DP_COMPOSITION_PRODUCTS)
            c->clip[k] = k < 3 ? product : product + b;
        else
            c->clip[k] = (float)(s->a * view + (k < 3 ? 0.0 : s->b));
    }
}

static float multiply_add(bool fused, float x, float y, float sum) {
    const float product = x * y;
    return fused ? fmaf(x, y, sum) : product + sum;
}

float composed_dot(const camera *c, const float row[4], const float p[4], bool fused) {
    const int *o = c->order;
    const float first = multiply_add(fused, row[o[1]], p[o[1]], row[o[0]] * p[o[0]]);
    if (c->paired)
        return first + multiply_add(fused, row[o[3]], p[o[3]], row[o[2]] * p[o[2]]);
    return multiply_add(fused, row[o[3]], p[o[3]], multiply_add(fused, row[o[2]], p[o[2]], first));
}

/* The binary32 position that stands for the surface at z. False: outside the box. */
bool composed_place(const set_up *s, const camera *c, double z, float p[4]) {
    const bool relative = s->terms.composition == DP_COMPOSITION_RELATIVE;
    p[3] = 1.0F;
    for (int k = 0; k < 3; k++) {
        const double at = c->from[k] + z * c->ray[k];
        p[k] = (float)(relative ? at - c->eye[k] : at);
        if (!(fabs(at) <= s->terms.world))
            return false;
    }
    return true;
}

static float window_of(const set_up *s, float clip, float w) {
    if (s->is_signed && s->arith->remap)
        clip = (clip + w) * 0.5F;
    const float inverse = nvidia_inverse(s->arith->reciprocal, w);
    float d = s->arith->reciprocal ? clip * inverse : clip / w;
    if (s->is_signed && !s->arith->remap) {
        const float half = 0.5F * d;
        d = half + 0.5F;
    }
    return d > 0.0F ? (d < 1.0F ? d : 1.0F) : 0.0F;
}

/* The code as a number that rises with it. */
static double convert(const set_up *s, float d) {
    const double most = (double)s->setup.spec.format.code_max;
    if (s->setup.spec.format.kind == DP_FORMAT_FLOAT)
        return (double)d; /* fp32 alone is tested */
    const float product = d * (float)most;
    switch (s->arith->conversion) {
    case DP_CONVERT_PRODUCT_EVEN:
        return fmin(rint((double)product), most);
    case DP_CONVERT_PRODUCT_ZERO:
        return fmin(trunc((double)product), most);
    case DP_CONVERT_SIXTEENTHS:
        return nvidia_code(s->setup.spec.format.bits, d);
    default:
        return floor((double)d * most + 0.5);
    }
}

/* The code of the surface at z, falling with z where all is well. False: outside the box, or not in front. */
static bool falling_code(const set_up *s, const camera *c, double z, double *code) {
    float p[4];
    if (!composed_place(s, c, z, p))
        return false;
    const float w = composed_dot(c, c->w, p, s->arith->fused);
    const double stored = convert(s, window_of(s, composed_dot(c, c->clip, p, s->arith->fused), w));
    *code = s->reversed ? stored : -stored;
    return w > 0.0F;
}

/* ---- Cameras ----------------------------------------------------------------------------------------------------- */

static double sum_of_products(const double x[3], const double y[3]) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/*
 * Every third axis points nearly along a diagonal, where sums are largest, every third mostly along a coordinate,
 * where single products are; of cameras every third stands in the corner before it, every third in some corner.
 */
pose composed_pose(rng *r) {
    pose p = {.order = {0, 1, 2, 3}, .paired = rng_below(r, 4) == 0};
    const uint64_t direction = rng_below(r, 3);
    const int mostly = (int)rng_below(r, 3);
    const uint64_t place_of_eye = rng_below(r, 3);
    for (int k = 0; k < 3; k++) {
        p.axis[k] = rng_uniform(r, -1.0, 1.0);
        p.eye[k] = rng_uniform(r, -1.0, 1.0);
        p.side[k] = rng_uniform(r, -1.0, 1.0);
        if (direction == 0)
            p.axis[k] = copysign(0.8 + 0.2 * fabs(p.axis[k]), p.axis[k]);
        else if (direction == 1 && k != mostly)
            p.axis[k] *= 0.3;
        if (place_of_eye < 2)
            p.eye[k] = copysign(0.8 + 0.2 * fabs(p.eye[k]), place_of_eye == 0 ? p.axis[k] : p.eye[k]);
    }
    p.wide = sqrt(rng_unit(r));
    for (int k = 3; k > 0; k--) {
        const int other = (int)rng_below(r, (uint64_t)k + 1);
        const int held = p.order[k];
        p.order[k] = p.order[other];
        p.order[other] = held;
    }
    return p;
}

/* Another one like it. */
static pose changed_pose(rng *r, const pose *from) {
    const double much = rng_log(r, 1e-6, 0.3);
    pose p = *from;
    for (int k = 0; k < 3; k++) {
        p.axis[k] += much * rng_uniform(r, -1.0, 1.0);
        p.eye[k] = fmin(fmax(p.eye[k] + much * rng_uniform(r, -1.0, 1.0), -1.0), 1.0);
        p.side[k] += much * rng_uniform(r, -1.0, 1.0);
    }
    p.wide = fmin(fmax(p.wide + much * rng_uniform(r, -1.0, 1.0), 0.0), 1.0);
    return p;
}

void composed_aim(const set_up *s, double z, const pose *p, camera *c) {
    const double world = s->terms.world;
    const double length = sqrt(sum_of_products(p->axis, p->axis));
    for (int k = 0; k < 3; k++)
        c->axis[k] = p->axis[k] / length;
    /* beside the axis: a vector across it, up to tan 60 degrees */
    double side[3];
    const double along = sum_of_products(p->side, c->axis);
    for (int k = 0; k < 3; k++)
        side[k] = p->side[k] - along * c->axis[k];
    const double across = sqrt(sum_of_products(side, side));
    const double size = fmax(fabs(s->setup.spec.znear), fabs(s->setup.spec.zfar));
    const double wide = (s->ortho ? fmin(size, world) : sqrt(3.0)) * p->wide * (1.0 - 1e-9) / across;
    for (int k = 0; k < 3; k++) {
        c->ray[k] = c->axis[k] + (s->ortho ? 0.0 : wide * side[k]);
        const double ahead = z * c->ray[k] + (s->ortho ? wide * side[k] : 0.0);
        /* room for the point, and for those behind it */
        const double eye = p->eye[k] * world;
        const double moved = fmin(fmax(eye, -world - 1.1 * fmin(ahead, 0.0)), world - 1.1 * fmax(ahead, 0.0));
        c->eye[k] = fmin(fmax(moved, -world), world) * (1.0 - 1e-9);
        c->from[k] = c->eye[k] + (s->ortho ? wide * side[k] : 0.0);
    }
    memcpy(c->order, p->order, sizeof c->order);
    c->paired = p->paired;
    compose(s, c);
}

/* ---- The search -------------------------------------------------------------------------------------------------- */

double composed_separation_at(const set_up *s, double z) {
    dp_budget b;
    assert_int_equal(dp_budget_at(&s->setup, z, &s->terms, &b), DP_OK);
    return b.separation;
}

/* The farthest two depths of one ray whose codes are not strictly in order, by a running extreme. */
static void search_ray(rng *r, const set_up *s, const camera *c, double z, double width, found *best) {
    double depth[SAMPLES], least[SAMPLES];
    const double end = fmin(s->setup.spec.zfar, 8.0 * s->terms.world);
    found longest = {0};
    int count = 0;
    for (int i = 0; i < SAMPLES; i++) {
        const double share = (i + rng_unit(r)) / (SAMPLES - BEHIND);
        const double at = i < SAMPLES - BEHIND ? z + width * share : z + width * pow(1e3, share - 1.0);
        double code;
        if (at > end || !falling_code(s, c, at, &code))
            break;
        int first = 0; /* of the depths before, whose codes' running minimum falls */
        for (int beyond = count; first < beyond;) {
            const int middle = (first + beyond) / 2;
            if (least[middle] <= code)
                beyond = middle;
            else
                first = middle + 1;
        }
        if (first < count && at - depth[first] > longest.gap)
            longest = (found){.z = depth[first], .gap = at - depth[first]};
        depth[count] = at;
        least[count] = count > 0 ? fmin(least[count - 1], code) : code;
        count++;
    }
    if (longest.gap > 0.8 * best->gap) {
        longest.bound = composed_separation_at(s, longest.z);
        longest.ratio = longest.gap / (isinf(longest.bound) ? 1e9 * fabs(s->setup.spec.znear) : longest.bound);
        if (longest.ratio > best->ratio)
            *best = longest;
    }
}

/*
 * Some times from anew: rays at random, then others like the best of them. More often where that has found less than
 * `wanted` of the bound.
 */
found composed_search(rng *r, const set_up *s, double z, double wanted, uint64_t times) {
    const uint64_t rays = 60;
    const uint64_t most = 1000 * times;
    found best = {0};
    const double bound = composed_separation_at(s, z);
    const double width = isinf(bound) ? 20.0 * fabs(z) : 1.05 * bound;
    for (uint64_t i = 0; i < times || (best.ratio < wanted && i < most); i++) {
        found here = {0};
        pose best_pose = composed_pose(r);
        for (uint64_t k = 0; k < rays; k++) {
            const pose p = 3 * k < rays ? composed_pose(r) : changed_pose(r, &best_pose);
            const double before = here.ratio;
            camera c;
            composed_aim(s, z, &p, &c);
            search_ray(r, s, &c, z, width, &here);
            if (here.ratio > before)
                best_pose = p;
        }
        if (here.ratio > best.ratio)
            best = here;
    }
    return best;
}
