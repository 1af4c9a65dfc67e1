/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cascades: parts of a view, and the light's box about each. */
#include <math.h>

#include "core/elementary.h"
#include "shadow/shadow.h"

shadow_split shadow_split_default(void) {
    return (shadow_split){.znear = 0.1,
                          .zfar = 100.0,
                          .fov_y = 60.0,
                          .aspect = 16.0 / 9.0,
                          .count = 4,
                          .lambda = 0.5,
                          .casters = 100.0,
                          .stable = true};
}

static bool within(double x, double lo, double hi) {
    return x >= lo && x <= hi;
}

shadow_status shadow_split_check(const shadow_split *s) {
    const bool planes = s->znear >= 1e-12 && s->znear < s->zfar && s->zfar <= 1e12;
    const bool view = within(s->fov_y, DP_FOV_LEAST, DP_FOV_MOST) && within(s->aspect, 0.001, 1000.0);
    const bool parts = within(s->count, 1, SHADOW_CASCADES_MAX) && within(s->lambda, 0.0, 1.0);
    return planes && view && parts && within(s->casters, 0.0, 1e12) ? SHADOW_OK : SHADOW_CASCADES;
}

static double split_at(const shadow_split *s, int index) {
    const double part = (double)index / s->count;
    if (index == s->count)
        return s->zfar;
    return s->lambda * s->znear * dp_pow(s->zfar / s->znear, part) +
           (1.0 - s->lambda) * (s->znear + (s->zfar - s->znear) * part);
}

/* The smallest sphere about the eight corners: its centre is where near and far ones are equally far, or at the far
 * end. */
static void bound(const shadow_split *s, shadow_cascade *c) {
    const double tangent = dp_half_tangent(s->fov_y);
    const double corner = tangent * dp_hypot(s->aspect, 1.0);
    c->centre = fmin(0.5 * (c->from + c->to) * (1.0 + corner * corner), c->to);
    c->radius = dp_hypot(c->to - c->centre, c->to * corner);
}

/* The light's box, `behind` beyond the sphere. */
static shadow_status fit(const shadow_split *s, const shadow_light *model, shadow_cascade *c, double behind) {
    const dp_triangles *t = &model->triangles;
    /* Texels that are read lie a filter's radius beside the point, which a normal offset moves by a diagonal's. */
    const double margin = 2.5 * model->kernel + 1.0 + (s->stable ? 0.5 : 0.0);
    const double inside = 1.0 - 2.0 * margin / fmin(t->width, t->height);
    dp_spec spec = model->setup.spec;
    if (!(inside > 0.0))
        return SHADOW_BOX;
    c->light = *model;
    c->light.width = c->light.height = 2.0 * c->radius / inside;
    spec.ortho = 1;
    spec.znear = 0.0;
    spec.zfar = s->casters + 2.0 * c->radius + behind;
    c->light.receiver_lo = s->casters;
    c->light.receiver_hi = s->casters + 2.0 * c->radius;
    if (dp_setup_init(&c->light.setup, &spec) != DP_OK)
        return SHADOW_BOX;
    return shadow_light_check(&c->light);
}

static double widest_gap(const shadow_light *light) {
    shadow_need need;
    double gap = 0.0;
    shadow_need_of(light, &need);
    for (int way = 0; way < SHADOW_WAY_COUNT; way++)
        if (isfinite(need.bias[way].gap_light))
            gap = fmax(gap, need.bias[way].gap_light);
    return gap;
}

shadow_status shadow_cascade_of(const shadow_split *split, const shadow_light *model, int index, shadow_cascade *out) {
    enum { ROUNDS = 4 };
    shadow_status status = shadow_split_check(split);
    if (status != SHADOW_OK || index < 0 || index >= split->count)
        return SHADOW_CASCADES;
    shadow_cascade c = {.from = split_at(split, index), .to = split_at(split, index + 1)};
    shadow_light rebuilt = *model;
    if (split->camera != NULL)
        rebuilt.position += shadow_rebuilt(split->camera, c.from, c.to, model->world);
    bound(split, &c);
    status = fit(split, &rebuilt, &c, 0.0);
    /* A deeper box rounds more, which opens a wider gap: a little, but where small triangles leave hardly any slope. */
    for (int i = 0; i < ROUNDS && status == SHADOW_OK; i++) {
        const double gap = widest_gap(&c.light);
        if (c.light.receiver_hi + gap <= c.light.setup.spec.zfar)
            break;
        status = fit(split, &rebuilt, &c, 1.25 * gap);
    }
    if (status == SHADOW_OK)
        *out = c;
    return status;
}
