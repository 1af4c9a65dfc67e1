/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "requirement/solve.h"

#include <math.h>
#include <stdlib.h>

#include "core/bits.h"
#include "core/elementary.h"
#include "requirement/judge.h"
#include "requirement/root.h"

enum { BREAKS_MAX = 3 * 260, EXTEND_MOST = 4096 };

static const double near_least = 1e-12, near_most = 1e12, far_most = 1e18, planes_apart = 1e-6;

/* The part of the measure that a root is sought of. */
typedef enum part { PART_FALLING = 0, PART_RISING } part;

typedef struct search {
    const solve_problem *problem;
    solve_result *result;
    double margin;      /* a measure this much below the limit stays there whatever the rounding errors */
    bool inert;         /* the unknown has no influence */
    double least, most; /* finite */
    int break_count;
    uint64_t breaks[BREAKS_MAX]; /* a piece begins at each: bits of a double, ascending */
    double best_value;           /* where nothing passes: the least measure met, and where */
    double best;
} search;

/* ---- The measure as a function of the unknown -------------------------------------------------------------------- */

dp_status solve_setup(const solve_problem *p, double x, dp_setup *setup) {
    dp_spec spec = p->spec;
    *(p->unknown == SOLVE_NEAR ? &spec.znear : &spec.zfar) = x;
    return judge_setup(&spec, setup);
}

static measure_worst whole(const search *s, double x) {
    dp_setup setup;
    if (solve_setup(s->problem, x, &setup) != DP_OK)
        return (measure_worst){HUGE_VAL, s->problem->hi};
    return measure_over(s->problem->kind, &setup, s->problem->lo, s->problem->hi);
}

/* As near grows the measure falls between two breaks, but for what measure.h calls rising; as far grows it rises. */
static double worst_of_part(const search *s, part which, double x) {
    const solve_problem *p = s->problem;
    if (p->unknown == SOLVE_FAR)
        return which == PART_RISING ? whole(s, x).value : 0.0;
    dp_setup setup;
    measure_worst falling;
    measure_worst rising;
    if (solve_setup(p, x, &setup) != DP_OK)
        return HUGE_VAL;
    measure_parts(p->kind, &setup, p->lo, p->hi, &falling, &rising);
    return which == PART_FALLING ? falling.value : rising.value;
}

static bool passes(const search *s, part which, double x) {
    return worst_of_part(s, which, x) <= s->problem->limit;
}

/* Passes, and so does everything on its safe side in the piece. */
static bool passes_surely(const search *s, part which, double x) {
    return worst_of_part(s, which, x) * (1.0 + s->margin) <= s->problem->limit;
}

/* ---- Breaks: where the step that the separation takes changes ---------------------------------------------------- */

static uint32_t field_at(const search *s, double z, double x) {
    dp_setup setup;
    return solve_setup(s->problem, x, &setup) == DP_OK ? measure_field(&setup, z) : 0;
}

/* The unknown for which d(z) = v: the mappings of depthprec/mapping.h solved for near or far. */
static double unknown_of(const dp_setup *setup, solve_unknown unknown, double z, double v) {
    const double n = setup->spec.znear;
    const double f = setup->spec.zfar;
    const double c = setup->log_c;
    const int r = setup->reversed;
    if (setup->curve == DP_CURVE_LOG)
        return unknown == SOLVE_NEAR ? z * (1.0 - v) /* a guess: one of these has no such formula */
                                     : setup->anchor + dp_expm1(dp_log1p(c * (z - setup->anchor)) / v) / c;
    if (setup->curve == DP_CURVE_LINEAR && !setup->spec.ortho)
        return z / v;
    if (setup->curve == DP_CURVE_LINEAR && unknown == SOLVE_NEAR)
        return r ? f - (f - z) / v : (z - v * f) / (1.0 - v);
    if (setup->curve == DP_CURVE_LINEAR)
        return r ? (z - v * n) / (1.0 - v) : n + (z - n) / v;
    if (unknown == SOLVE_FAR)
        return r ? n * z * (1.0 - v) / (n - v * z) : v * z * n / (n - z * (1.0 - v));
    if (isinf(f))
        return r ? v * z : (1.0 - v) * z;
    return r ? v * z * f / ((f - z) + v * z) : (1.0 - v) * z * f / (f - v * z);
}

/* The first double of (lo, hi] at which the field of z has gone beyond `bound`; it has at hi and has not at lo. */
static uint64_t crossing(const search *s, double z, uint32_t bound, bool upward, double guess, uint64_t lo,
                         uint64_t hi) {
    const uint64_t start = guess > dp_float64(lo) && guess < dp_float64(hi) ? dp_bits64(guess) : lo + (hi - lo) / 2;
    uint64_t at = start;
    for (uint64_t step = 1; hi - lo > 1; step *= 4) {
        const uint32_t field = field_at(s, z, dp_float64(at));
        const bool beyond = upward ? field > bound : field < bound;
        *(beyond ? &hi : &lo) = at;
        const uint64_t room = beyond ? at - lo : hi - at;
        if (room <= 1 || step > (uint64_t)1 << 40 || step >= room)
            break;
        at = beyond ? at - step : at + step;
    }
    while (hi - lo > 1) {
        const uint64_t middle = lo + (hi - lo) / 2;
        const uint32_t field = field_at(s, z, dp_float64(middle));
        *((upward ? field > bound : field < bound) ? &hi : &lo) = middle;
    }
    return hi;
}

static void add_breaks(search *s, double z) {
    const solve_problem *p = s->problem;
    dp_setup setup;
    if (solve_setup(p, s->most, &setup) != DP_OK)
        return;
    const uint32_t first = field_at(s, z, s->least);
    const uint32_t last = field_at(s, z, s->most);
    const bool upward = last > first;
    uint64_t from = dp_bits64(s->least);
    for (uint32_t field = first; field != last && s->break_count < BREAKS_MAX;) {
        const double v = measure_threshold(&setup, upward ? field + 1 : field);
        from = crossing(s, z, field, upward, unknown_of(&setup, p->unknown, z, v), from, dp_bits64(s->most));
        s->breaks[s->break_count++] = from;
        field = field_at(s, z, dp_float64(from));
    }
}

static int compare_bits(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a;
    const uint64_t y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static void find_breaks(search *s) {
    const solve_problem *p = s->problem;
    dp_setup setup;
    s->breaks[s->break_count++] = dp_bits64(s->least);
    if (p->spec.format.kind == DP_FORMAT_FLOAT && !s->inert && solve_setup(p, s->most, &setup) == DP_OK) {
        const double governing = measure_governing(&setup, p->lo, p->hi);
        const double summit = measure_summit(p->kind, &setup, p->lo, p->hi);
        add_breaks(s, governing);
        if (p->lo < p->hi && p->unknown == SOLVE_NEAR && governing == p->hi && setup.reversed) {
            add_breaks(s, p->lo);
            if (summit > p->lo && summit < p->hi)
                add_breaks(s, summit);
        }
    }
    qsort(s->breaks, (size_t)s->break_count, sizeof s->breaks[0], compare_bits);
}

/* ---- A root in a piece ------------------------------------------------------------------------------------------- */

typedef struct equation {
    const search *s;
    part which;
    bool balance; /* the two parts against each other instead of one against the limit */
} equation;

/* Bounded, also where the measure is infinite; in the logarithm of the unknown. */
static double residual(double t, void *context) {
    const equation *e = context;
    const double x = fmin(fmax(dp_exp(t), e->s->least), e->s->most);
    const double value = worst_of_part(e->s, e->which, x);
    const double target =
        e->balance ? worst_of_part(e->s, PART_RISING, x) : e->s->problem->limit / (1.0 + e->s->margin);
    return isinf(value) ? 1.0 : (value - target) / (value + target);
}

static double find_root(equation *e, double a, double b) {
    return dp_exp(root_find(residual, e, dp_log(a), dp_log(b), 0x1p-50));
}

/*
 * Where the part begins to pass, from the end that does: `inside` passes surely, `outside` does not. The root, then the
 * exact double: first the last that passes surely, then those beyond that pass as they are.
 */
static uint64_t edge(const search *s, part which, uint64_t inside, uint64_t outside) {
    const bool down = outside < inside;
    equation e = {.s = s, .which = which};
    const double root = find_root(&e, dp_float64(down ? outside : inside), dp_float64(down ? inside : outside));
    const uint64_t lo = down ? outside : inside;
    const uint64_t hi = down ? inside : outside;
    uint64_t at = root > dp_float64(lo) && root < dp_float64(hi) ? dp_bits64(root) : lo + (hi - lo) / 2;
    for (uint64_t step = 1; inside != outside; step *= 4) {
        const bool good = passes_surely(s, which, dp_float64(at));
        *(good ? &inside : &outside) = at;
        const uint64_t room = good == down ? at - (down ? outside : inside) : (down ? inside : outside) - at;
        if (room <= 1 || step >= room)
            break;
        at = good == down ? at - step : at + step;
    }
    for (;;) {
        const uint64_t room = down ? inside - outside : outside - inside;
        if (room <= 1)
            break;
        const uint64_t middle = down ? inside - room / 2 : inside + room / 2;
        *(passes_surely(s, which, dp_float64(middle)) ? &inside : &outside) = middle;
    }
    return inside;
}

/* On from `at`, which passes, towards `end` while the neighbour does. */
static uint64_t extend(const search *s, part which, uint64_t at, uint64_t end) {
    for (int i = 0; i < EXTEND_MOST && at != end; i++) {
        const uint64_t next = end < at ? at - 1 : at + 1;
        if (!passes(s, which, dp_float64(next)))
            break;
        at = next;
    }
    return at;
}

/* Cuts off [*a, *b] what fails in one part, from the end `bad` where it is largest. False when nothing is left. */
static bool trim(const search *s, part which, uint64_t good, uint64_t *bad) {
    if (passes_surely(s, which, dp_float64(*bad)))
        return true;
    if (!passes(s, which, dp_float64(good)))
        return false;
    const uint64_t inside = passes_surely(s, which, dp_float64(good)) ? edge(s, which, good, *bad) : good;
    *bad = extend(s, which, inside, *bad);
    return true;
}

/* ---- Pieces and islands ------------------------------------------------------------------------------------------ */

static void add_island(search *s, double lo, double hi) {
    solve_result *r = s->result;
    solve_island *last = r->island_count > 0 ? &r->islands[r->island_count - 1] : NULL;
    if (last != NULL && dp_bits64(last->hi) + 1 >= dp_bits64(lo))
        last->hi = hi;
    else if (r->island_count < SOLVE_ISLANDS_MAX)
        r->islands[r->island_count++] = (solve_island){lo, hi};
}

static void offer_best(search *s, double x) {
    const double value = whole(s, x).value;
    if (value < s->best_value || isnan(s->best)) {
        s->best_value = value;
        s->best = x;
    }
}

/* The least measure of a piece: at an end, or where what falls meets what rises. */
static void offer_piece(search *s, double a, double b) {
    offer_best(s, a);
    offer_best(s, b);
    if (s->problem->unknown == SOLVE_NEAR && a < b &&
        worst_of_part(s, PART_FALLING, a) > worst_of_part(s, PART_RISING, a) &&
        worst_of_part(s, PART_FALLING, b) < worst_of_part(s, PART_RISING, b)) {
        equation e = {.s = s, .which = PART_FALLING, .balance = true};
        offer_best(s, fmin(fmax(find_root(&e, a, b), a), b));
    }
}

static void solve_piece(search *s, uint64_t a, uint64_t b) {
    uint64_t lo = a;
    uint64_t hi = b;
    if (trim(s, PART_FALLING, b, &lo) && trim(s, PART_RISING, a, &hi) && lo <= hi)
        add_island(s, dp_float64(lo), dp_float64(hi));
    else if (s->result->island_count == 0)
        offer_piece(s, dp_float64(a), dp_float64(b));
}

static void solve_pieces(search *s) {
    if (s->inert) { /* all or none */
        if (whole(s, s->most).value <= s->problem->limit)
            add_island(s, s->least, s->most);
        else
            offer_best(s, s->most);
        return;
    }
    for (int i = 0; i < s->break_count; i++) {
        const bool last = i + 1 == s->break_count;
        if (last || s->breaks[i + 1] > s->breaks[i])
            solve_piece(s, s->breaks[i], last ? dp_bits64(s->most) : s->breaks[i + 1] - 1);
    }
}

/* Infinity is no double among doubles: it joins the island that reaches the greatest far, or is one of its own. */
static void add_infinity(search *s) {
    solve_result *r = s->result;
    dp_setup setup;
    if (s->problem->unknown != SOLVE_FAR || solve_setup(s->problem, HUGE_VAL, &setup) != DP_OK)
        return;
    r->most = HUGE_VAL;
    if (!(whole(s, HUGE_VAL).value <= s->problem->limit)) {
        if (r->island_count == 0)
            offer_best(s, HUGE_VAL);
        return;
    }
    if (r->island_count > 0 && r->islands[r->island_count - 1].hi == s->most)
        r->islands[r->island_count - 1].hi = HUGE_VAL;
    else if (r->island_count < SOLVE_ISLANDS_MAX)
        r->islands[r->island_count++] = (solve_island){HUGE_VAL, HUGE_VAL};
}

/* ---- The door ---------------------------------------------------------------------------------------------------- */

/* The least and the greatest value that make a set-up and leave the depths inside it. */
static dp_status limits(search *s) {
    const solve_problem *p = s->problem;
    dp_setup setup;
    if (p->unknown == SOLVE_NEAR) {
        s->least = near_least;
        s->most = fmin(fmin(p->lo, near_most), p->spec.zfar / (1.0 + planes_apart));
        if (p->hi > p->spec.zfar || !(s->least <= s->most))
            return DP_ERROR_RANGE;
        for (int i = 0; i < 8 && solve_setup(p, s->most, &setup) == DP_ERROR_PLANES; i++)
            s->most = nextafter(s->most, 0.0);
        return solve_setup(p, s->most, &setup);
    }
    s->least = fmax(fmax(p->hi, p->spec.znear * (1.0 + planes_apart)), near_least);
    s->most = far_most;
    if (p->lo < p->spec.znear || !(s->least <= s->most))
        return DP_ERROR_RANGE;
    for (int i = 0; i < 8 && solve_setup(p, s->least, &setup) == DP_ERROR_PLANES; i++)
        s->least = nextafter(s->least, HUGE_VAL);
    return solve_setup(p, s->least, &setup);
}

static void conclude(search *s) {
    solve_result *r = s->result;
    r->possible = r->island_count > 0;
    if (r->possible) {
        const solve_island *last = &r->islands[r->island_count - 1];
        const bool znear = s->problem->unknown == SOLVE_NEAR;
        r->value = znear ? last->lo : last->hi;
        r->until = znear ? last->hi : last->lo;
    } else {
        r->value = r->until = s->best;
    }
    r->worst = whole(s, r->value);
}

dp_status solve(const solve_problem *problem, solve_result *result) {
    if (problem == NULL || result == NULL)
        return DP_ERROR_NULL;
    if (problem->spec.model != DP_MODEL_EXACT)
        return DP_ERROR_MODEL;
    /* A near plane is looked for among the positive ones; a far one behind the depths, which may begin anywhere. */
    const double first = problem->unknown == SOLVE_FAR && problem->spec.ortho ? problem->hi : problem->lo;
    if (!(problem->limit > 0.0 && first > 0.0 && problem->lo <= problem->hi && problem->hi < HUGE_VAL))
        return DP_ERROR_RANGE;
    search s = {.problem = problem, .result = result, .best_value = HUGE_VAL, .best = (double)NAN};
    const dp_status status = limits(&s);
    if (status != DP_OK)
        return status;
    const dp_mapping_row *mapping = dp_mapping_get(problem->spec.mapping);
    s.margin = mapping->curve == DP_CURVE_LOG ? 0x1p-44 : 0x1p-48;
    s.inert = problem->unknown == SOLVE_NEAR && !problem->spec.ortho && mapping->curve != DP_CURVE_PERSPECTIVE &&
              !mapping->log_from_near;
    result->least = s.least;
    result->most = s.most;
    result->island_count = 0;
    find_breaks(&s);
    solve_pieces(&s);
    add_infinity(&s);
    conclude(&s);
    return DP_OK;
}
