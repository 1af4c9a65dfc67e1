/* SPDX-License-Identifier: MIT */
/*
 * The largest separation over a range: at binade ends in the model exact, by branch and bound in the others; and
 * whether a limit holds over a range in all cameras of a run, by branch and bound in all models.
 */
#include "core/boundary.h"
#include "core/curve.h"
#include "core/engine.h"
#include "core/extremes.h"
#include "core/guarantee.h"
#include "core/rounding.h"
#include "depthprec/bounds.h"
#include "depthprec/depth.h"

enum { PARTS_MAX = 512, EVALUATIONS_MAX = 1 << 16, EVALUATIONS_OF_RUN = 1 << 9 };

/* The search stops refining what is no more than this above what was found. */
static const double slack = 1.0 + 0x1p-10;

/* A part of the range. In binary32 its ends are binary32 depths, and it holds these only. */
typedef struct part {
    double lo, hi;
    double bound;
} part;

typedef struct search {
    const dp_setup *setup;
    const dp_setup *inner; /* the other end of a run of cameras, of which `setup` is the outer one; else null */
    int half;              /* half a step, or what a truncated depth is off by, in place of a separation */
    dp_guarantee guarantee;
    dp_setup lattice;
    dp_separation_worst *worst;
    double limit;
    int evaluations;
    int only_whether; /* it is within the limit, and not how far */
    int count;
    part parts[PARTS_MAX]; /* a stack */
} search;

/*
 * `ahead` with what rounding the eye depths adds, at any depth from lo to hi: it adds most at one of the two. As
 * dp_lattice_separation() has it, a little larger.
 */
static double with_eye(const dp_setup *setup, double lo, double hi, double ahead) {
    const double outward = dp_curve_outward(setup) * (1.0 + DP_ROUNDINGS_6);
    if (setup->spec.model == DP_MODEL_EXACT)
        return ahead * outward;
    return dp_apart_with_eye(lo, hi, ahead) * outward;
}

/*
 * The most that any depth of the part may be off by, however it is aligned. Truncated codes are those of lower d, but
 * the stages before them round to nearest.
 */
static double error_of(const dp_setup *setup, double hi, double step) {
    const double share = dp_error_share(setup);
    return fabs(dp_curve_ahead(setup, (setup->spec.model == DP_MODEL_EXACT ? share : fabs(share)) * step, 1.0, hi)) *
           dp_curve_outward(setup) * (1.0 + DP_ROUNDINGS_6);
}

/* The same as a bound of the lattice: in a run its steps are the largest of any camera, and as long as in the outer. */
static double lattice_bound(const search *s, double lo, double hi) {
    const dp_setup *inner = s->inner != NULL ? s->inner : &s->lattice;
    const double step = dp_separation_step(&s->lattice, inner, lo, hi, s->half) * (1.0 + DP_ROUNDINGS_6);
    return s->half ? error_of(&s->lattice, hi, step)
                   : with_eye(&s->lattice, lo, hi, dp_curve_ahead(&s->lattice, step, 1.0, hi));
}

/*
 * An upper bound of the separation at every depth of the part. In binary32 that of the lattice is a floor: its bound is
 * that of the same part in the model exact.
 */
static double bound_of(const search *s, double lo, double hi) {
    const double bound = lattice_bound(s, lo, hi);
    return s->guarantee.computed ? larger(dp_guarantee_bound(&s->guarantee, (float)lo, (float)hi), bound) : bound;
}

static double separation_at(const search *s, double z) {
    if (s->inner == NULL)
        return dp_guarantee_at(&s->guarantee, z);
    const double bound = lattice_bound(s, z, z);
    return s->guarantee.computed ? larger(dp_guarantee_at(&s->guarantee, z), bound) : bound;
}

/* In binary32 the depth nearest to an end of the range may lie just outside, and is meant by that end. */
static void note_separation(const search *s, double depth) {
    dp_separation_worst *worst = s->worst;
    const double z = smaller(larger(depth, worst->lo), worst->hi);
    const double separation = separation_at(s, z);
    if (separation > worst->separation) {
        worst->separation = separation;
        worst->z = z;
    }
}

/* Nothing lies between the ends of the part. */
static int is_single(const dp_setup *setup, const part *p) {
    if (dp_is_computed(setup))
        return (double)nextafterf((float)p->lo, HUGE_VALF) >= p->hi;
    return nextafter(p->lo, HUGE_VAL) >= p->hi;
}

static void raise_bound(dp_separation_worst *worst, double bound) {
    worst->bound = larger(worst->bound, bound);
}

/* A part is of no interest when it cannot be worse than what is known; then its bound is the range's, too. */
static void offer(search *s, double lo, double hi) {
    if (s->only_whether && lo < hi) {
        const double bound = bound_of(s, lo, hi);
        s->evaluations++;
        if (bound <= s->limit)
            return;
    }
    note_separation(s, lo);
    note_separation(s, hi);
    part p = {lo, hi, 0.0};
    if (is_single(s->setup, &p)) {
        raise_bound(s->worst, s->worst->separation);
        return;
    }
    p.bound = bound_of(s, lo, hi);
    s->evaluations++;
    if (s->count == PARTS_MAX)
        raise_bound(s->worst, p.bound);
    else
        s->parts[s->count++] = p;
}

/* Half-way between two depths, for parts of many binades as well as of one. From 0 on, most of the binades are left. */
static double middle_of(double lo, double hi) {
    if (lo < 0.0)
        return hi > 0.0 ? 0.0 : -middle_of(-hi, -lo);
    if (lo == 0.0)
        return hi * (hi > 0x1p-100 ? 0x1p-20 : 0.5);
    return lo < 0.5 * hi ? sqrt(lo) * sqrt(hi) : 0.5 * lo + 0.5 * hi;
}

/* The depths of a part that lie on either side of its middle; binary32 depths have no depth between them. */
static void divide(search *s, const part *p) {
    const double middle = middle_of(p->lo, p->hi);
    if (dp_is_computed(s->setup)) {
        float m = (float)middle;
        if ((double)m >= p->hi)
            m = nextafterf(m, -HUGE_VALF);
        offer(s, p->lo, (double)m);
        offer(s, (double)nextafterf(m, HUGE_VALF), p->hi);
        return;
    }
    offer(s, p->lo, middle);
    offer(s, middle, p->hi);
}

/*
 * The youngest part, as what was found about it says where the worst is; in a long search the one of the largest bound,
 * of several the widest, so that no branch whose bound stays above its depths is all that is looked at.
 */
static part next_part(search *s) {
    int at = s->count - 1;
    if (s->evaluations > EVALUATIONS_OF_RUN && s->count < PARTS_MAX / 2)
        for (int i = 0; i < s->count; i++) {
            const part *a = &s->parts[at], *b = &s->parts[i];
            if (b->bound > a->bound || (b->bound == a->bound && b->hi - b->lo > a->hi - a->lo))
                at = i;
        }
    const part p = s->parts[at];
    s->parts[at] = s->parts[--s->count];
    return p;
}

/*
 * Now and then in a long search: whether even neighbours well inside the part have its bound, as where rounding hides
 * how depths differ. Then only depths one by one would tell more, and there are too many.
 */
static int is_hopeless(const search *s, const part *p) {
    enum { SELDOM = 64, FEW = 4096 };
    const double middle = middle_of(p->lo, p->hi), inside[] = {middle, middle_of(p->lo, middle)};
    if (s->evaluations <= EVALUATIONS_OF_RUN || s->evaluations % SELDOM >= 2 || dp_is_computed(s->setup) ||
        p->hi - p->lo < FEW * 0x1p-52 * larger(fabs(p->lo), fabs(p->hi)))
        return 0;
    for (int i = 0; i < 2; i++)
        if (bound_of(s, inside[i], nextafter(inside[i], HUGE_VAL)) * (1.0 + 0x1p-12) < p->bound)
            return 0;
    return 1;
}

static void refine(search *s) {
    const int most = s->inner != NULL ? EVALUATIONS_OF_RUN : EVALUATIONS_MAX;
    while (s->count > 0) {
        const part p = next_part(s);
        if (is_hopeless(s, &p))
            s->evaluations = most; /* the bounds stay as they are */
        const double enough = s->limit > 0.0 ? s->limit : slack * s->worst->separation;
        const int exceeded = s->limit > 0.0 && s->worst->separation > s->limit;
        if (p.bound <= enough || exceeded || s->evaluations >= most || isinf(s->worst->separation))
            raise_bound(s->worst, p.bound);
        else
            divide(s, &p);
    }
}

/* Where the next binade begins behind a depth; depths within `tiny` of 0 count as one. */
static double next_binade(double z, double tiny) {
    if (z >= tiny)
        return 2.0 * dp_power2(dp_exponent(z));
    if (z >= -tiny)
        return tiny;
    const double power = dp_power2(dp_exponent(-z));
    return smaller(-z > power ? -power : -0.5 * power, -tiny);
}

/* In binary32 parts within one binade, the nearest first, so that the farthest is looked at first. */
static void begin(search *s) {
    const dp_separation_worst *w = s->worst;
    if (!dp_is_computed(s->setup)) {
        offer(s, w->lo, w->hi);
        return;
    }
    const double hi = (double)(float)w->hi;
    double lo = (double)(float)w->lo;
    const double tiny = lo > 0.0 ? 0.0 : larger(0x1p-24 * larger(-lo, fabs(hi)), 0x1p-126);
    while (lo < hi) {
        const double next = next_binade(lo, tiny);
        offer(s, lo, next <= hi ? (double)nextafterf((float)next, -HUGE_VALF) : hi);
        lo = (double)(float)next;
    }
    if (lo == hi)
        offer(s, lo, hi);
}

static void branch_and_bound(search *s, double limit) {
    s->limit = limit;
    s->evaluations = 0;
    s->worst->bound = s->worst->separation;
    begin(s);
    refine(s);
    s->worst->bound = larger(s->worst->bound, s->worst->separation);
}

/*
 * exact, reversed floats: with depth the steps only become finer, so the far end of each binade has its largest
 * separation. The step from a binade's end is its own, the larger one.
 */
static void over_binades(const search *s) {
    const dp_setup *setup = s->setup;
    dp_separation_worst *out = s->worst;
    const dp_format *format = &setup->spec.format;
    const int lowest = 1 - format->bias;
    for (int e = dp_binade(format, dp_window(setup, out->lo)) + 1; e >= lowest; e--) {
        const double end = e == lowest ? out->hi : dp_curve_eye(setup, dp_point_make(dp_power2(e), 1.0));
        if (end * (1.0 + DP_ROUNDINGS_126) < out->lo || dp_power2(e) > setup->ends[0])
            continue;
        const double z = smaller(end * (1.0 + DP_ROUNDINGS_126), out->hi);
        raise_bound(out, with_eye(setup, z, z, dp_curve_ahead(setup, dp_step_num(format, e), 1.0, z)));
        note_separation(s, smaller(larger(end * (1.0 - DP_ROUNDINGS_126), out->lo), out->hi));
        if (end * (1.0 - DP_ROUNDINGS_126) > out->hi)
            break;
    }
}

/* The set-up whose lattice bounds a search: where depths are computed, that of the model exact. */
static dp_setup lattice_of(const dp_setup *setup) {
    dp_setup lattice = *setup;
    if (dp_is_computed(setup)) {
        lattice.spec.model = DP_MODEL_EXACT;
        lattice.shader = 0;
    }
    return lattice;
}

/* In a run, over the range of `s->worst`. */
static int is_within(search *s, double limit) {
    dp_separation_worst *worst = s->worst;
    note_separation(s, worst->hi);
    note_separation(s, worst->lo);
    if (worst->separation <= limit && worst->lo < worst->hi)
        branch_and_bound(s, limit);
    return larger(worst->separation, worst->bound) <= limit;
}

int dp_separation_within(const dp_setup *outer, const dp_setup *inner, double lo, double hi, double limit) {
    dp_separation_worst worst = {.lo = lo, .hi = hi, .z = hi};
    search s = {.setup = outer, .inner = inner, .worst = &worst};
    if (!dp_guarantee_between(outer, inner, &s.guarantee))
        return 0;
    s.lattice = lattice_of(outer);
    return is_within(&s, limit);
}

/* Whether dp_separation_over() would find that limit kept, without the worst depth; 0 where that is not sure. */
int dp_separation_soon(const dp_setup *setup, double lo, double hi, double limit) {
    dp_separation_worst worst = {.lo = lo, .hi = hi, .z = hi};
    search s = {.setup = setup,
                .guarantee = dp_guarantee_make(setup),
                .lattice = lattice_of(setup),
                .worst = &worst,
                .only_whether = 1};
    const int inside = lo >= setup->spec.znear && lo <= hi && hi <= setup->spec.zfar && !isinf(hi);
    return inside && limit > 0.0 && s.guarantee.computed && is_within(&s, limit);
}

int dp_error_within(const dp_setup *outer, const dp_setup *inner, double lo, double hi, double limit) {
    dp_separation_worst worst = {.lo = lo, .hi = hi, .z = hi};
    search s = {.setup = outer, .inner = inner, .half = 1, .lattice = *outer, .worst = &worst};
    s.guarantee = (dp_guarantee){.setup = outer};
    if (outer->shader)
        return dp_shader_error_between(outer, inner, lo, hi) <= limit;
    return outer->spec.model != DP_MODEL_FLOAT && is_within(&s, limit);
}

dp_status dp_separation_over(const dp_setup *setup, double lo, double hi, double limit, dp_separation_worst *out) {
    if (setup == NULL || out == NULL)
        return DP_ERROR_NULL;
    if (!(lo >= setup->spec.znear && lo <= hi && hi <= setup->spec.zfar) || isinf(lo))
        return DP_ERROR_RANGE;
    dp_separation_worst worst = {.lo = lo, .hi = hi, .z = hi};
    search s = {.setup = setup, .guarantee = dp_guarantee_make(setup), .lattice = lattice_of(setup), .worst = &worst};
    note_separation(&s, hi);
    note_separation(&s, lo);
    const int rises = lo >= 0x1p-126 || (lo >= 0.0 && hi >= 0x1p-102); /* the rounding of eye depths, flushed or not */
    const int exact =
        !s.guarantee.computed && (setup->spec.model == DP_MODEL_EXACT || (dp_staged_is_exact(setup) && rises));
    if (isinf(worst.separation)) {
        worst.bound = worst.separation;
    } else if (exact) {
        if (lo < hi && setup->reversed && setup->spec.format.kind == DP_FORMAT_FLOAT)
            over_binades(&s);
        worst.bound = larger(worst.bound, worst.separation) * dp_curve_outward(setup);
    } else {
        branch_and_bound(&s, 0.0);
        if (worst.separation <= limit && worst.bound > limit) {
            const double known = worst.bound;
            branch_and_bound(&s, limit);
            worst.bound = smaller(worst.bound, known);
        }
    }
    *out = worst;
    return DP_OK;
}

/*
 * What binary32 arithmetic guarantees for depths from lo to hi, one binade after the other. A depth is meant by the
 * binary32 depth nearest to it.
 */
static double computed_bound(const dp_guarantee *g, double lo, double hi) {
    const double tiny = lo > 0.0 ? 0.0 : larger(0x1p-24 * larger(-lo, fabs(hi)), 0x1p-126);
    double bound = 0.0;
    while (lo <= hi) {
        const double next = next_binade(lo, tiny);
        const double end = next <= hi ? (double)nextafterf((float)next, -HUGE_VALF) : hi;
        if (lo < end) /* a single depth is the one that was given, or stands beside one */
            bound = larger(bound, dp_guarantee_bound(g, (float)lo, (float)end));
        else if (lo >= g->setup->spec.znear && lo <= g->setup->spec.zfar)
            bound = larger(bound, dp_guarantee_at(g, lo));
        lo = (double)(float)next;
    }
    return bound;
}

dp_status dp_separation_runs(const dp_setup *setup, const double *lo, const double *hi, double *bound, size_t count) {
    if (setup == NULL || (count > 0 && (lo == NULL || hi == NULL || bound == NULL)))
        return DP_ERROR_NULL;
    for (size_t i = 0; i < count; i++)
        if (!(lo[i] >= setup->spec.znear && lo[i] <= hi[i] && hi[i] <= setup->spec.zfar) || isinf(hi[i]))
            return DP_ERROR_RANGE;
    search s = {.setup = setup, .guarantee = dp_guarantee_make(setup), .lattice = lattice_of(setup)};
    for (size_t i = 0; i < count; i++) {
        const double ends = larger(dp_guarantee_at(&s.guarantee, lo[i]), dp_guarantee_at(&s.guarantee, hi[i]));
        bound[i] = larger(
            larger(ends, lattice_bound(&s, lo[i], hi[i])),
            s.guarantee.computed ? computed_bound(&s.guarantee, (double)(float)lo[i], (double)(float)hi[i]) : 0.0);
    }
    return DP_OK;
}
