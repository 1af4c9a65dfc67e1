/* SPDX-License-Identifier: MIT */
/*
 * dp_guarantee_at() of many depths, to the bit: by stretches of depths for which demand.c decides alike.
 *
 * On its way to a demand it rounds numbers up to powers of two and compares; between these decisions it adds,
 * multiplies and divides. Each decision is about a number that, while all before it stay the same, only rises or only
 * falls with z, by more from one binary32 depth to the next than double rounds away (DP_SENSITIVE): clip, NDC and
 * window depths, their errors, and how far behind z something may be. So it is the same at all depths between two at
 * which it is the same; by induction, all of them are. What follows is then a share x = z window/(half slope) of one of
 * two forms: linear in z, or linear over the numerator t; and the farthest depth in question is z/(1 - x). It matters
 * only between which two binary32 numbers it lies: where a margin for roundings leaves that open, as where there is no
 * stretch, the depth is left to dp_guarantee_at().
 */
#include "core/clones.h"
#include "core/demand.h"
#include "core/engine.h"
#include "core/guarantee.h"
#include "core/rounding.h"

/* Far from where anything is subnormal. */
static const double least_z = 0x1p-90;

/* A stretch ends up to GAP binary32 numbers before the next one begins, as finding the place takes time. */
enum { GAP = 1 << 12, FIRST = 1 << 16 };

/* Notes the decisions on the way to the demand at a depth. */
static void decide(const dp_chain *chain, float z, dp_decisions *d) {
    dp_chain c = *chain;
    dp_demand ignored;
    c.decisions = d;
    d->count = d->unknown = 0;
    dp_demand_longest(&c, (dp_span){(double)z, (double)z}, 0.0, &ignored);
}

static int alike(const dp_decisions *a, const dp_decisions *b) {
    return !a->unknown && !b->unknown && a->count == b->count &&
           memcmp(a->made, b->made, (size_t)a->count * sizeof a->made[0]) == 0;
}

static double rise(double from, double to, double span) {
    return span > 0.0 && to < HUGE_VAL ? (to - from) / span : 0.0;
}

/* The rate of the lattice at depths that are rounded to those from one to another. */
static double lattice_over(const dp_setup *setup, uint32_t from, uint32_t to) {
    const double before = (double)dp_float32(from - 1U), behind = (double)dp_float32(to + 1U);
    return larger(dp_lattice_rate(setup, larger(before, setup->spec.znear)),
                  dp_lattice_rate(setup, smaller(behind, setup->spec.zfar)));
}

/* The longest stretch from a depth on, to a GAP; gives its last depth. */
static uint32_t grow(const dp_guarantee *g, uint32_t from, uint32_t most, dp_stretch *s) {
    const dp_chain *c = &g->chain;
    dp_decisions first, next, end;
    uint32_t to = from;
    decide(c, dp_float32(from), &first);
    end = first;
    int grows = 1;
    for (uint32_t step = FIRST; step >= GAP && to < most; step = grows ? 2 * step : step / 2) {
        const uint32_t at = most - to < step ? most : to + step;
        decide(c, dp_float32(at), &next);
        if (alike(&first, &next)) {
            to = at;
            end = next;
        } else {
            grows = 0;
        }
    }
    const double z = (double)dp_float32(from), span = (double)dp_float32(to) - z;
    *s = (dp_stretch){.from = first.unknown ? HUGE_VAL : z,
                      .to = z + span,
                      .linear = first.linear,
                      .linear_rise = rise(first.linear, end.linear, span),
                      .falling = first.falling,
                      .falling_rise = rise(first.falling, end.falling, span),
                      .kept_lo = first.kept_lo,
                      .product = first.product,
                      .granule = first.granule,
                      .end = first.end,
                      .lattice = lattice_over(g->setup, from, to)};
    return to;
}

/* A perspective in the arithmetic ieee, facing, far not so far that single steps of the numerator count. */
static int fits(const dp_guarantee *g) {
    if (!g->computed || g->setup->curve != DP_CURVE_PERSPECTIVE || g->setup->spec.triangles.width != 0)
        return 0;
    const dp_chain *c = &g->chain;
    const dp_pipeline *p = &c->pipeline;
    return !p->ortho && !c->run && !c->fused && !c->remap && !c->ranged && !c->few_steps &&
           p->arith->reciprocal == DP_RECIPROCAL_NONE && p->arith->conversion == DP_CONVERT_EXACT &&
           (p->format.kind == DP_FORMAT_FLOAT || (p->format.bits <= 24 && p->rounding != DP_ROUND_EVEN)) &&
           g->setup->spec.znear >= least_z;
}

void dp_stretches_find(dp_stretches *all, const dp_guarantee *g) {
    const dp_spec *spec = &g->setup->spec;
    const double sensitive = DP_SENSITIVE * fabs(g->chain.b);
    all->count = 0;
    if (!fits(g))
        return;
    all->first = dp_bits32(dp_float_up(spec->znear));
    all->last = dp_bits32(dp_float_down(spec->zfar < sensitive ? spec->zfar : sensitive));
    all->shift = 0;
    while ((all->last - all->first) >> all->shift >= DP_STRETCH_CELLS)
        all->shift++;
    for (uint32_t at = all->first, to = at; all->count < DP_STRETCHES && to < all->last; at = to + GAP)
        to = grow(g, at < all->last ? at : all->last, all->last, &all->list[all->count++]);
    all->list[all->count] = (dp_stretch){.from = HUGE_VAL, .to = HUGE_VAL};
    for (uint32_t cell = 0, i = 0; cell <= DP_STRETCH_CELLS; cell++) {
        while (i < (uint32_t)all->count && dp_bits32((float)all->list[i].to) < all->first + (cell << all->shift))
            i++;
        all->in_cell[cell] = (uint16_t)i;
    }
}

/* The farthest binary32 depth in question behind z, or NaN. */
DP_INLINE double last_behind(const dp_chain *c, const dp_stretch *s, double z) {
    const double margin = 0x1p-44, on = z - s->from;
    const double t = dp_on_lattice(dp_numerator_least(c, z, c->a * z + c->b, s->kept_lo, s->product, 0.0), s->granule);
    const double linear = s->linear + s->linear_rise * on, falling = s->falling + s->falling_rise * on;
    const double x = smaller(linear, falling / t);
    const double end = z + z * x / (1.0 - x) * DP_OUTWARD;
    if (!(x < 0.75))
        return (double)NAN;
    if (end * (1.0 - margin) > s->end)
        return s->end;
    const uint64_t low = dp_bits64(end * (1.0 - margin)) >> 29;
    return low == dp_bits64(end * (1.0 + margin)) >> 29 && end * (1.0 + margin) < s->end ? dp_float64(low << 29)
                                                                                         : (double)NAN;
}

DP_INLINE double separation_at(const dp_stretches *all, const dp_guarantee *g, double z) {
    const double z1 = (double)(float)z;
    const uint32_t bits = dp_bits32((float)z);
    if (!(z >= g->setup->spec.znear && z <= g->setup->spec.zfar) || bits < all->first || bits > all->last)
        return dp_guarantee_at(g, z);
    const dp_stretch *s = &all->list[all->in_cell[(bits - all->first) >> all->shift]];
    while (s->to < z1)
        s++;
    const double last = s->from <= z1 ? last_behind(&g->chain, s, z1) : (double)NAN;
    if (isnan(last))
        return dp_guarantee_at(g, z);
    const double needs = (last - z1 + dp_eye_rounding(z1, last)) * DP_OUTWARD;
    return dp_lattice_is_within(s->lattice, z, needs) ? needs : dp_with_lattice(g->setup, z, needs);
}

CLONES static void of_stretches(const dp_stretches *all, const dp_guarantee *g, const double *z, double *separation,
                                size_t count) {
    for (size_t i = 0; i < count; i++)
        separation[i] = separation_at(all, g, z[i]);
}

void dp_guarantee_many(const dp_guarantee *g, const dp_stretches *all, const double *z, double *separation,
                       size_t count) {
    if (all->count > 0) {
        of_stretches(all, g, z, separation, count);
        return;
    }
    for (size_t i = 0; i < count; i++)
        separation[i] = dp_guarantee_at(g, z[i]);
}
