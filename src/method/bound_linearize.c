/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The methods of linearize as their operations: see linearize.c, where they run. Of d, n and f; in exact arithmetic z
 * is the eye depth, i its reciprocal, and s how far the window depth is from that of the far plane.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "core/bits.h"
#include "method/bound.h"
#include "method/estimate.h"

/* ---- Rows: standard depth, then reversed ------------------------------------------------------------------------- */

#define SHARE        "q = 1 - d : s; "
#define ABOVE        "q = d - L : s; "
#define BELOW        "q = H - d : s; "
#define UNITY        BY("d", "i") "z = 1/x : z"
#define COMPLEMENTED BY("q", "i") "z = 1/x : z"
#define BY(q, exact) "x = B + S*" q " : " exact "; "

#define COMPLEMENT "P = n*f; B = n; S = f - n"
#define WHOLE      "z = P/x : z"

#define NEWTON "y = estimate(x); t = newton(x, y); z = P*t : z"
#define MAGIC  BY("d", "i") "y = magic(x); z = newton(x, y) : z"

/* clang-format off */
const bound_steps bound_unity = {
    .constants = {"B = 1/n; S = -across", "B = 1/f; S = across", "B = 1/n + lo*across/(hi - lo); S = -across/(hi - lo)",
     "B = 1/f - lo*across/(hi - lo); S = across/(hi - lo)"},
    .steps = {UNITY, UNITY, UNITY, UNITY}};
const bound_steps bound_magic = {
    .constants = {"B = 1/n; S = -across", "B = 1/f; S = across"},
    .steps = {MAGIC, MAGIC}};
const bound_steps bound_complement_unity = {
    .constants = {"B = 1/f; S = across", "B = 1/f; S = across", "H = hi; B = 1/f; S = across/(hi - lo)",
     "L = lo; B = 1/f; S = across/(hi - lo)"},
    .steps = {SHARE COMPLEMENTED, UNITY, BELOW COMPLEMENTED, ABOVE COMPLEMENTED}};
const bound_steps bound_linear_01 = {
    .constants = {"F = f; B = f/n; S = -excess", "F = f; B = 1; S = excess"},
    .steps = {BY("d", "F*i") "t = 1/x : z/F; z = F*t : z", BY("d", "F*i") "t = 1/x : z/F; z = F*t : z"}};
const bound_steps bound_linear_01_near = {
    .constants = {"N = n; W = f - n; B = f/n; S = -excess", "N = n; W = f - n; B = 1; S = excess"},
    .steps = {BY("d", "(N + W)*i") "t = d/x : d/((N + W)*i); z = N + W*t : z",
     BY("d", "(N + W)*i") "r = 1 - d : 1 - d; t = r/x : (1 - d)/((N + W)*i); z = N + W*t : z"}};
const bound_steps bound_textbook = {
    .constants = {"P = n*f; B = f; S = n - f", COMPLEMENT},
    .steps = {BY("d", "P*i") WHOLE, BY("d", "P*i") WHOLE}};
const bound_steps bound_fused = {
    .constants = {"P = n*f; B = f; S = n - f", COMPLEMENT},
    .steps = {"x = fma(S, d, B) : P*i; " WHOLE, "x = fma(S, d, B) : P*i; " WHOLE}};
const bound_steps bound_complement = {
    .constants = {COMPLEMENT, COMPLEMENT},
    .steps = {SHARE BY("q", "P*i") WHOLE, BY("d", "P*i") WHOLE}};
const bound_steps bound_newton = {
    .constants = {COMPLEMENT, COMPLEMENT},
    .steps = {SHARE BY("q", "P*i") NEWTON, BY("d", "P*i") NEWTON}};
const bound_steps bound_double = {
    .constants = {"P = n*f; B = f; S = n - f", COMPLEMENT},
    .steps = {BY("d", "P*i") WHOLE, BY("d", "P*i") WHOLE}, .wide = true};
const bound_steps bound_phi = {
    .constants = {"N = n; p = n/f", "N = n; p = n/f"},
    .wide = true,
    .steps = {SHARE "x = q + p*d : N*i; z = N/x : z", "q = 1 - d : 1 - d; x = d + p*q : N*i; z = N/x : z"}};
const bound_steps bound_pair = {.off = 0x1p-41}; /* 70 squares of a unit, see depthprec(7) */
/* clang-format on */

const bound_arithmetic bound_nearest = {.rounding = 1, .division = 1};

/* ---- Constants --------------------------------------------------------------------------------------------------- */

/* The exact rounding error of a + b (Knuth). */
static double left_of_sum(double a, double b) {
    const double s = a + b, v = s - a;
    return (a - (s - v)) + (b - v);
}

/* The term of a constant; those of binary64 are known as products and sums of the planes. */
static term constant_of(const steps *s, int index, const steps_given *given, bool wide, double share) {
    const steps_node *of = &s->node[index];
    const double value = steps_value(s, index, given);
    const double a = of->of[0] < 0 ? 0 : steps_value(s, of->of[0], given);
    const double b = of->of[1] < 0 ? 0 : steps_value(s, of->of[1], given);
    if (of->kind == STEPS_NUMBER || (of->kind == STEPS_NAME && (wide || (double)(float)value == value)))
        return term_exact(value);
    if (wide && of->kind == STEPS_PRODUCT)
        return term_apart(value, fma(a, b, -value));
    if (wide && of->kind == STEPS_DIFFERENCE)
        return term_apart(value, left_of_sum(a, -b));
    return term_constant(value, share, wide ? TERM_DOUBLE : TERM_SINGLE);
}

int bound_variant(const dp_setup *setup) {
    return (setup->reversed != 0) + 2 * (setup->ranged != 0);
}

steps_given bound_given(const dp_setup *setup) {
    const dp_spec *s = &setup->spec;
    const float end = (float)s->depth_range[0], other = (float)s->depth_range[1];
    return (steps_given){.n = s->znear, .f = s->zfar, .lo = (double)fminf(end, other), .hi = (double)fmaxf(end, other)};
}

void bound_begin(const bound_steps *row, const dp_setup *setup, const bound_arithmetic *how, bound_walk *w) {
    const steps_given given = bound_given(setup);
    const double share = setup->ranged ? DP_ROUNDINGS_14 : DP_ROUNDINGS_2; /* of what forms a constant */
    const steps *k = &w->constants;
    w->row = row;
    w->variant = bound_variant(setup);
    w->how = how;
    w->constants.count = 0;
    if (row->steps[w->variant] == NULL)
        return;
    steps_read(row->constants[w->variant], &w->constants);
    steps_read(row->steps[w->variant], &w->steps);
    for (int i = 0; i < k->count; i++)
        w->known[i] = (bound_known){k->step[i].name, constant_of(k, k->step[i].is, &given, row->wide, share)};
}

/* ---- In exact arithmetic ----------------------------------------------------------------------------------------- */

static const bound_known *find(const bound_walk *w, const char *name) {
    int i = 0;
    while (strcmp(w->known[i].name, name) != 0)
        i++;
    return &w->known[i];
}

static range exact_of(const bound_walk *w, int index, const bound_piece *p) {
    const steps_node *of = &w->steps.node[index];
    if (of->kind == STEPS_NUMBER)
        return (range){of->value, of->value};
    if (of->kind == STEPS_NAME)
        return strcmp(of->name, "z") == 0   ? p->eye
               : strcmp(of->name, "i") == 0 ? p->inverse
               : strcmp(of->name, "s") == 0 ? p->near
                                            : find(w, of->name)->term.exact;
    const range a = exact_of(w, of->of[0], p), b = exact_of(w, of->of[1], p);
    return of->kind == STEPS_PRODUCT    ? range_product(a, b)
           : of->kind == STEPS_QUOTIENT ? range_quotient(a, b)
           : of->kind == STEPS_SUM      ? range_sum(a, b)
                                        : range_outward(a.lo - b.hi, a.hi - b.lo);
}

/* ---- As they are computed ---------------------------------------------------------------------------------------- */

static const range any = {-(double)INFINITY, (double)INFINITY};

static term rounded(const bound_walk *w, const term *t, double halves) {
    return term_rounded(t, w->row->wide ? TERM_DOUBLE : TERM_SINGLE, halves, w->how->flushes);
}

static term computed(const bound_walk *w, int index, const range *exact);

/* A product that is added, which may not be rounded at all: then it keeps its finer grid. */
static term summand(const bound_walk *w, int index) {
    const steps_node *of = &w->steps.node[index];
    term t = computed(w, index, &any);
    if (of->kind == STEPS_PRODUCT && w->how->contracts) {
        const term a = computed(w, of->of[0], &any), b = computed(w, of->of[1], &any), whole = term_product(&a, &b);
        t.grid = whole.grid < t.grid ? whole.grid : t.grid;
    }
    return t;
}

/* y (2 - x y) for y = (1 + e)/x is (1 - e^2)/x. Of x y and 2 - x y one is below 1 and one above: 1.5 units. */
static term newton(const bound_walk *w, const term *x, const char *seed) {
    const bool magic = strcmp(seed, "magic") == 0;
    const double off = magic ? 0.05052 : ESTIMATE_WORST, square = magic ? 2.552e-3 : off * off;
    const term one = term_exact(1);
    const double each = 1.5 * DP_UNIT * w->how->rounding * (1 + off);
    const term exact = term_quotient(&one, x, (range){0, (double)INFINITY});
    const term t = term_scaled(&exact, (range){-square - each, each});
    return rounded(w, &t, w->how->rounding);
}

static const char *seed_of(const bound_walk *w, const char *name) {
    int i = 0;
    while (strcmp(w->steps.step[i].name, name) != 0)
        i++;
    return w->steps.node[w->steps.step[i].is].name;
}

static term called(const bound_walk *w, const steps_node *of, const range *exact) {
    const term a = computed(w, of->of[0], &any);
    if (strcmp(of->name, "newton") == 0)
        return newton(w, &a, seed_of(w, w->steps.node[of->of[1]].name));
    if (strcmp(of->name, "fma") != 0) /* an estimate, which newton() knows */
        return a;
    const term b = computed(w, of->of[1], &any), c = computed(w, of->of[2], &any), m = term_product(&a, &b);
    const term t = term_sum(&c, &m, *exact);
    return rounded(w, &t, w->how->rounding);
}

/* By a power of two a binary32 number becomes another one, within the normal ones. */
static bool scales(const term *a, const term *product) {
    int exponent;
    const range is = range_sum(product->exact, product->off);
    const bool power =
        a->exact.lo == a->exact.hi && a->off.lo == 0 && a->off.hi == 0 && frexp(a->exact.lo, &exponent) == 0.5;
    return power && (is.lo >= (double)FLT_MIN || is.hi <= -(double)FLT_MIN) && fmax(is.hi, -is.lo) <= (double)FLT_MAX;
}

static term computed(const bound_walk *w, int index, const range *exact) {
    const steps_node *of = &w->steps.node[index];
    if (of->kind == STEPS_NUMBER)
        return term_exact(of->value);
    if (of->kind == STEPS_NAME)
        return find(w, of->name)->term;
    if (of->kind == STEPS_CALL)
        return called(w, of, exact);
    const bool sum = of->kind == STEPS_SUM || of->kind == STEPS_DIFFERENCE;
    const term a = sum ? summand(w, of->of[0]) : computed(w, of->of[0], &any);
    term b = sum ? summand(w, of->of[1]) : computed(w, of->of[1], &any), t;
    if (of->kind == STEPS_DIFFERENCE) {
        const term minus = term_exact(-1);
        b = term_product(&minus, &b);
    }
    t = sum                         ? term_sum(&a, &b, *exact)
        : of->kind == STEPS_PRODUCT ? term_product(&a, &b)
                                    : term_quotient(&a, &b, *exact);
    if (of->kind == STEPS_PRODUCT && (scales(&a, &t) || scales(&b, &t)))
        return t;
    return rounded(w, &t, of->kind == STEPS_QUOTIENT ? w->how->division : w->how->rounding);
}

term bound_run(bound_walk *w, const bound_piece *p) {
    int count = w->constants.count;
    if (w->row->steps[w->variant] == NULL) {
        const double off = w->how->rounding == 1 && !w->how->contracts ? w->row->off : (double)INFINITY;
        const term pairs = term_within(p->eye, (range){-off, off});
        return term_rounded(&pairs, TERM_SINGLE, 1, false);
    }
    w->known[count++] = (bound_known){"d", p->d};
    for (int i = 0; i < w->steps.count; i++) {
        const int exact = w->steps.step[i].exact;
        const range is = exact < 0 ? any : exact_of(w, exact, p);
        const term t = computed(w, w->steps.step[i].is, &is);
        w->known[count++] = (bound_known){w->steps.step[i].name, t};
    }
    const term *z = &w->known[count - 1].term;
    return w->row->wide ? term_rounded(z, TERM_SINGLE, 1, false) : *z;
}
