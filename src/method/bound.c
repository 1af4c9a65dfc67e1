/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/bound.h"

#include <float.h>
#include <math.h>

#include "core/bits.h"

/* Octaves of d, those of 1 - d, the two ends, and what halving adds. */
enum { HALVINGS = 128, PIECES = 149 + 24 + 2 + HALVINGS };

/* Binary32 window depths from a to b, and the worst error there. */
typedef struct piece {
    float a, b;
    double worst;
} piece;

typedef struct search {
    bound_walk walk;
    bool reversed;
    double slope, base; /* 1/z = slope near + base */
    double far;         /* the window depth of the far plane */
    float least, most;  /* window depths */
    piece heap[PIECES]; /* the worst first */
    int count;
} search;

static double worst_of(search *s, float a, float b) {
    bound_piece p = {.d = term_any(a, b)};
    const double from = fabs(s->far - (double)(s->reversed ? a : b)), to = fabs(s->far - (double)(s->reversed ? b : a));
    if (s->walk.how->flushes && a < FLT_MIN) {
        p.d.off = (range){(double)-FLT_MIN, 0};
        p.d.share = (range){-1, 0};
    }
    p.near = s->far == 0 ? p.d.exact : range_outward(from, to);
    p.inverse = range_outward((s->slope * p.near.lo + s->base) * (1 - DP_ROUNDINGS_14),
                              (s->slope * p.near.hi + s->base) * (1 + DP_ROUNDINGS_14));
    if (!(p.inverse.lo > 0))
        return (double)INFINITY;
    p.eye = range_quotient((range){1, 1}, p.inverse);
    const term z = bound_run(&s->walk, &p);
    const double worst = fmax(-z.share.lo, z.share.hi);
    return worst <= 1 ? worst : (double)INFINITY; /* NaN, too */
}

static void push_piece(search *s, float a, float b) {
    piece p = {a, b, worst_of(s, a, b)};
    int at = s->count++;
    for (; at > 0 && s->heap[(at - 1) / 2].worst < p.worst; at = (at - 1) / 2)
        s->heap[at] = s->heap[(at - 1) / 2];
    s->heap[at] = p;
}

static piece pop_worst(search *s) {
    const piece worst = s->heap[0], last = s->heap[--s->count];
    int at = 0;
    for (int next = 1; next < s->count; at = next, next = 2 * at + 1) {
        if (next + 1 < s->count && s->heap[next + 1].worst > s->heap[next].worst)
            next++;
        if (s->heap[next].worst <= last.worst)
            break;
        s->heap[at] = s->heap[next];
    }
    s->heap[at] = last;
    return worst;
}

/* Pieces are the octaves of d below 1/2, above it those of 1 - d, to where depths are those at the plane, or to the
 * last number. */
static void first_pieces(search *s) {
    const double turn = s->reversed ? s->base / (s->base + s->slope) * 0x1p-4 : 0x1p-26;
    float b = 0.5f;
    for (; b > s->least && (double)b > turn && b > 0x1p-149f; b /= 2)
        push_piece(s, fmaxf(b / 2, s->least), b);
    if (b > s->least)
        push_piece(s, s->least, b);
    for (float rest = 0.5f; rest >= 0x1p-24f; rest /= 2)
        if (1 - rest <= s->most)
            push_piece(s, 1 - rest, fminf(rest > 0x1p-24f ? 1 - rest / 2 : 1 - rest, s->most));
    if (s->most == 1)
        push_piece(s, 1, 1);
}

/* In another range each half of the way to the far plane's depth, to where depths are those at the plane, or to the
 * last number. */
static void ranged_pieces(search *s) {
    const double turn = s->base / s->slope * 0x1p-4, whole = (double)s->most - (double)s->least;
    const float end = s->reversed ? s->least : s->most;
    float at = s->reversed ? s->most : s->least;
    for (double rest = whole / 2; rest > turn && at != end; rest /= 2) {
        const float next = s->reversed ? fmaxf((float)(s->far + rest), end) : fminf((float)(s->far - rest), end);
        push_piece(s, fminf(at, next), fmaxf(at, next));
        at = next;
    }
    if (at != end)
        push_piece(s, fminf(at, end), fmaxf(at, end));
}

double bound_over(const bound_steps *row, const dp_setup *setup, const bound_arithmetic *how) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    const bool infinite = isinf(f), reversed = setup->reversed != 0;
    const steps_given given = bound_given(setup);
    const double span = given.hi - given.lo, unit = n * span;
    search s = {.reversed = reversed, .least = (float)given.lo, .most = (float)given.hi};
    s.slope = (infinite ? 1 / n : (f - n) / n / f) / span;
    s.base = 1 / f;
    s.far = reversed ? given.lo : given.hi;
    if (infinite && reversed && given.lo == 0.0)
        s.least = dp_float_up(how->flushes ? fmax(unit, 1) * 0x1p-125 : fmax(unit * 0x1p-127, 0x1p-149));
    else if (infinite && reversed)
        s.least = nextafterf(s.least, 1);
    else if (infinite)
        s.most = nextafterf(s.most, 0);
    bound_begin(row, setup, how, &s.walk);
    (setup->ranged ? ranged_pieces : first_pieces)(&s);
    for (int i = 0; i < HALVINGS && s.heap[0].a < s.heap[0].b; i++) {
        const piece worst = pop_worst(&s);
        const float middle = dp_float_down(((double)worst.a + (double)worst.b) / 2);
        push_piece(&s, worst.a, middle);
        push_piece(&s, dp_ranked32(dp_rank32(middle) + 1U), worst.b);
    }
    return s.heap[0].worst * DP_OUTWARD + 0x1p-48;
}
