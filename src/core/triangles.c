/* SPDX-License-Identifier: MIT */
#include "core/triangles.h"

#include "core/bits.h"
#include "core/demand.h"
#include "core/elementary.h"
#include "core/extremes.h"
#include "core/rounding.h"

/* For roundings of what is rounded already. */
static const double second_order = 1.0 + 0x1p-10;

/* A bound on what is flushed to zero on the way, for triangles of any size; the least window depth beside it. */
static const double underflow = 0x1p-90;
static const double least_window = 0x1p-60;

/* clang-format off */
static const dp_anchor_row anchors[DP_ANCHOR_COUNT] = {
    [DP_ANCHOR_VERTEX] = {"vertex", {.value = 2, .box = 11, .range = 2, .origin = 0},
                          "anchored at a vertex, which is on the subpixel grid"},
    [DP_ANCHOR_ORIGIN] = {"origin", {.value = 3, .box = 10, .range = 2, .origin = 4},
                          "anchored at the target's corner, two fused operations a pixel"},
    [DP_ANCHOR_ORIGIN_UNFUSED] = {"origin-unfused", {.value = 3, .box = 10, .range = 2, .origin = 5},
                                  "the same, by multiply and add"},
    [DP_ANCHOR_ORIGIN_STEPPED] = {"origin-stepped", {.value = 5, .box = 8, .range = 2, .origin = 5},
                                  "the same at every other pixel, stepped between them"},
};
/* clang-format on */

const dp_anchor_row *dp_anchor_get(dp_anchor anchor) {
    return (unsigned)anchor < DP_ANCHOR_COUNT ? &anchors[anchor] : NULL;
}

dp_triangles dp_triangles_default(void) {
    return (dp_triangles){.width = 1920,
                          .height = 1080,
                          .fov_y = 60.0,
                          .subpixel = 8,
                          .plane = anchors[DP_ANCHOR_VERTEX].plane,
                          .slant_lo = 0.0,
                          .slant_hi = 90.0,
                          .depth = 2.0,
                          .pixels = 512.0,
                          .slim = 16.0};
}

double dp_fov_vertical(double fov_x, int width, int height) {
    return 2.0 * dp_atan(dp_half_tangent(fov_x) * height / width) / DP_DEGREE;
}

static int within(double x, double lo, double hi) {
    return x >= lo && x <= hi;
}

const char *dp_triangles_fault(const dp_triangles *t) {
    static const double most = 1e6;
    if (t == NULL)
        return dp_status_text(DP_ERROR_NULL);
    const dp_plane_error *p = &t->plane;
    const struct {
        int good;
        const char *sentence;
    } rules[] = {
        {within(t->width, 1, 32768) && within(t->height, 1, 32768), "viewport must have sides from 1 to 32768 pixels"},
        {within(t->fov_y, DP_FOV_LEAST, DP_FOV_MOST), "fov must be from 0.001 to 179.9 degrees"},
        {within(t->subpixel, 0, 8), "subpixel must be from 0 to 8 bits"},
        {within(p->value, 0, most) && within(p->box, 0, most) && within(p->range, 0, most) &&
             within(p->origin, 0, most),
         "plane must have errors from 0 to 1e6"},
        {within(t->slant_lo, 0, 90) && within(t->slant_hi, t->slant_lo, 90),
         "slant must be two angles from 0 to 90 degrees, the smaller first"},
        {within(t->depth, 1, 1e6) && within(t->pixels, 1, 65536) && within(t->slim, 2, 1024),
         "triangle class must have depth from 1 to 1e6, pixels from 1 to 65536 and slim from 2 to 1024"},
    };
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++)
        if (!rules[i].good)
            return rules[i].sentence;
    return NULL;
}

dp_status dp_triangles_check(const dp_triangles *t) {
    if (t == NULL)
        return DP_ERROR_NULL;
    return dp_triangles_fault(t) == NULL ? DP_OK : DP_ERROR_TRIANGLES;
}

/* ---- What is the same at every depth ----------------------------------------------------------------------------- */

/* The angle of those asked for at which `per_sine` sin + `per_cosine` cos, neither negative, is largest. */
static double worst_slant(const dp_slant *s, double per_sine, double per_cosine) {
    return smaller(larger(dp_atan2(per_sine, per_cosine), s->lo), s->hi);
}

dp_slant dp_slant_make(const dp_triangles *t) {
    const double y = dp_half_tangent(t->fov_y);
    const double pixel = 2.0 * y / t->height;
    const double x = 0.5 * pixel * t->width;
    const double off = pixel * t->pixels;
    const double snap = t->subpixel > 0 ? dp_power2(-t->subpixel - 1) : 0.0;
    dp_slant s = {.pixel = pixel,
                  .ray = dp_hypot(x, y),
                  .vertex_ray = dp_hypot(x + off, y + off),
                  .vertex_x = x + off,
                  .vertex_y = y + off,
                  .box = 0.5 + 0.5 * dp_hypot(t->slim, 1.0),
                  .snap = snap,
                  .snapped = dp_hypot(snap, snap),
                  .lo = t->slant_lo * DP_DEGREE,
                  .hi = t->slant_hi * DP_DEGREE};
    const double longest = worst_slant(&s, s.ray, 1.0);
    s.longest = dp_sin(longest) * s.ray + dp_cos(longest);
    return s;
}

dp_composed_view dp_triangles_view(const dp_triangles *t, const dp_slant *v) {
    return (dp_composed_view){.scale = {2.0 / (v->pixel * t->width), 2.0 / (v->pixel * t->height)},
                              .ray = {v->vertex_x, v->vertex_y}};
}

/* ---- What both triangles lose ------------------------------------------------------------------------------------ */

/* The depths at which vertices lie. */
static dp_span depths_of(const dp_chain *c, dp_span run, const dp_triangles *t) {
    const double lo = larger(run.lo / t->depth, c->reach.lo);
    const double hi = smaller(run.hi * t->depth, c->reach.hi);
    return (dp_span){(double)(float)lo, (double)(float)larger(lo, hi)};
}

dp_span dp_triangles_depths(const dp_chain *c, dp_span run, const dp_triangles *t, const dp_composed_vertex *moved) {
    dp_span at = depths_of(c, run, t);
    if (moved == NULL)
        return at;
    const double off = moved->position + moved->along;
    const double tilt = moved->tilt + moved->shared;
    if (!(off < at.lo && tilt < 1.0))
        return (dp_span){0.0, at.hi};
    at.lo = (double)dp_float_down((at.lo - off) / (1.0 + tilt));
    at.hi = (double)dp_float_up(smaller((at.hi + off) / (1.0 - tilt), 0x1p127));
    return at;
}

/* A vertex's own errors: binade by binade of z, in each as they are at worst. */
typedef struct own_error {
    double projection, ndc;
} own_error;

static own_error own_error_over(const dp_chain *c, dp_span r) {
    own_error worst = {0};
    double lo = r.lo, hi;
    do {
        hi = smaller(2.0 * dp_power2(dp_exponent(lo)) * (1.0 - DP_UNIT), r.hi);
        const dp_steps s = dp_chain_steps(c, (dp_span){lo, hi});
        const double ndc = s.inverse.error + s.quotient.error + s.viewport.error;
        worst.projection = larger(worst.projection, s.full - ndc);
        worst.ndc = larger(worst.ndc, ndc);
        lo = (double)nextafterf((float)hi, HUGE_VALF);
    } while (hi < r.hi);
    return worst;
}

/* Window depth of both, by cause; and by how many pixels each plane is displaced on top of snapping. */
typedef struct loss {
    double cause[DP_CAUSE_COUNT];
    double dx, dy;
} loss;

/*
 * The loss of triangles with vertices at these depths. The range of a triangle's window depths follows from the depths
 * of the class or, `by_slope`, from the plane's slope and the width of the box: then it acts as if the plane were
 * displaced. `stray` is what a composition moves a vertex by in window depth.
 */
static loss loss_of(const dp_chain *c, dp_span at, own_error own, const dp_triangles *t, const dp_slant *slant,
                    const double asked[DP_CAUSE_COUNT], double stray, int by_slope) {
    const double full = own.projection + own.ndc;
    const double g1 = dp_chain_window(c, at.lo);
    const double g2 = dp_chain_window(c, at.hi);
    const double more = larger(dp_chain_window_more(c, at.lo), dp_chain_window_more(c, at.hi));
    const double most = smaller(larger(g1, g2) + full + more, 1.0);
    const double far_x = t->width + t->pixels;
    const double far_y = t->height + t->pixels;
    const double gradients = 1.0 + t->plane.origin * DP_UNIT * (far_x + far_y);
    const double per_range = (t->plane.box * slant->box + t->plane.range) * gradients * second_order;
    const double range = (by_slope ? 0.0 : fabs(g1 - g2) + 2.0 * more) + 2.0 * (full + stray);
    const double setup = DP_UNIT * (t->plane.value * most * second_order + per_range * range) + underflow;
    const double slope = by_slope ? per_range * t->pixels : 0.0;
    const double room = full + stray + setup + more;
    loss out = {.dx = 3.0 * t->width + 6.0 * t->pixels + t->plane.origin * far_x + slope,
                .dy = 3.0 * t->height + 6.0 * t->pixels + t->plane.origin * far_y + slope};
    out.dx *= DP_UNIT * second_order;
    out.dy *= DP_UNIT * second_order;
    out.cause[DP_CAUSE_PROJECTION] = 2.0 * own.projection;
    out.cause[DP_CAUSE_NDC] = 2.0 * own.ndc + c->below + c->above;
    out.cause[DP_CAUSE_SETUP] = 2.0 * setup;
    out.cause[DP_CAUSE_INTERPOLATION] = asked[DP_CAUSE_INTERPOLATION];
    out.cause[DP_CAUSE_FORMAT] = dp_format_loss(&c->pipeline, smaller(g1, g2) - room, larger(g1, g2) + room, 0.0);
    out.cause[DP_CAUSE_LINEARIZATION] = asked[DP_CAUSE_LINEARIZATION];
    return out;
}

/* ---- The worst slant --------------------------------------------------------------------------------------------- */

/*
 * The budget at the slant where it is largest, and at the farthest depth of the run: each term grows with depth.
 * INFINITY where nothing in front of the nearest one is certain, whatever its slant: such a surface is behind the eye.
 */
static dp_budget at_worst(const dp_chain *c, dp_span run, const dp_triangles *t, const dp_slant *v, const loss *of,
                          const dp_composed_vertex *moved) {
    const double both = (1.0 + t->depth) * second_order; /* of a vertex moved: that of the nearer plane counts for k */
    const double z = run.hi;
    const double slope = c->half * fabs(c->b);
    double window = 0.0;
    for (int i = 0; i < DP_CAUSE_COUNT; i++)
        window += of->cause[i];
    const double facing = (window * z * z / slope + 2.0 * moved->tilt * z) / (1.0 - moved->shared);
    const double eye = 2.0 * DP_UNIT * second_order * z;
    const double per_sine = 2.0 * v->pixel * z * dp_hypot(v->snap + of->dx, v->snap + of->dy) + eye * v->vertex_ray +
                            both * dp_hypot(moved->across[0], moved->across[1]);
    const double per_cosine = eye + both * moved->along;
    const double angle = worst_slant(v, per_sine + facing * v->ray, per_cosine + facing);
    const double sine = dp_sin(angle);
    const double cosine = dp_cos(angle);
    const double along = sine * v->ray + cosine; /* of the normal, along the ray */
    const double sum = sine * per_sine + cosine * per_cosine + along * facing + both * moved->position;
    dp_budget b = {.separation = sum / (1.0 - moved->turn) * DP_OUTWARD};
    double rest = b.separation;
    for (int i = 0; i < DP_CAUSE_COUNT; i++)
        b.cause[i] = along * of->cause[i] * z * z / slope;
    b.cause[DP_CAUSE_EYE] = eye * (sine * v->vertex_ray + cosine);
    b.cause[DP_CAUSE_SNAPPING] = 2.0 * v->pixel * z * v->snapped * sine;
    b.cause[DP_CAUSE_SETUP] = 0.0;
    for (int i = 0; i < DP_CAUSE_COUNT; i++)
        rest -= b.cause[i];
    b.cause[DP_CAUSE_SETUP] = larger(rest, 0.0);
    b.window = b.separation * slope / (along * z * z);
    if (!(b.separation < v->longest * run.lo) || slope < least_window * z * t->depth)
        b.separation = HUGE_VAL;
    return b;
}

void dp_triangles_add(const dp_chain *c, dp_span run, const dp_triangles *t, const dp_slant *slant,
                      const double asked[DP_CAUSE_COUNT], const dp_composed_vertex *moved, dp_budget *out) {
    static const dp_composed_vertex none = {0};
    const dp_span at = dp_triangles_depths(c, run, t, moved);
    if (t->slant_hi == 0.0)
        return;
    if (!(at.lo > 0.0)) {
        *out = (dp_budget){.separation = HUGE_VAL, .window = 1.0};
        return;
    }
    const double stray = fabs(dp_chain_window(c, at.lo) - dp_chain_window(c, depths_of(c, run, t).lo));
    const own_error own = own_error_over(c, at);
    const loss by_class = loss_of(c, at, own, t, slant, asked, stray, 0);
    const loss by_slope = loss_of(c, at, own, t, slant, asked, stray, 1);
    const dp_budget first = at_worst(c, run, t, slant, &by_class, moved != NULL ? moved : &none);
    const dp_budget second = at_worst(c, run, t, slant, &by_slope, moved != NULL ? moved : &none);
    const dp_budget *lesser = second.separation < first.separation ? &second : &first;
    if (lesser->separation > out->separation)
        *out = *lesser;
}

/* ---- One plane, two drawings ------------------------------------------------------------------------------------- */

dp_status dp_coplanar_over(const dp_setup *setup, double lo, double hi, dp_coplanar *out) {
    static const double none[DP_CAUSE_COUNT] = {0};
    dp_pipeline pipeline;
    if (setup == NULL || out == NULL)
        return DP_ERROR_NULL;
    const dp_triangles *t = &setup->spec.triangles;
    if (t->width == 0)
        return DP_ERROR_TRIANGLES;
    if (!(lo >= setup->spec.znear && lo <= hi && hi <= setup->spec.zfar))
        return DP_ERROR_DEPTH;
    const dp_status status = dp_pipeline_init(&pipeline, setup);
    if (status != DP_OK)
        return status;
    const dp_chain c = dp_chain_make(setup, &pipeline);
    const dp_span run = {larger(smaller(lo, c.reach.hi), c.reach.lo), larger(smaller(hi, c.reach.hi), c.reach.lo)};
    const dp_span at = depths_of(&c, run, t);
    const dp_slant slant = dp_slant_make(t);
    const loss of = loss_of(&c, at, own_error_over(&c, at), t, &slant, none, 0.0, 1);
    const double eye = DP_UNIT * c.half * fabs(c.b) / run.lo;
    const double off = 0.5 * (of.cause[DP_CAUSE_PROJECTION] + of.cause[DP_CAUSE_NDC] + of.cause[DP_CAUSE_SETUP]) + eye;
    const double beside = DP_UNIT * (t->width + t->height + 2.0 * t->pixels);
    const double moved = 2.0 * slant.snap + of.dx + of.dy + beside;
    out->window = 2.0 * off * second_order;
    out->pixels = 2.0 * moved * second_order;
    out->lost = (2.0 * moved + DP_UNIT * (6.0 * slant.box * t->slim + 2.0 * slant.box + 2.0)) * second_order;
    out->lost_window = out->window;
    return DP_OK;
}
