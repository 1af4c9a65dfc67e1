/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/solve_report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/setups.h"
#include "report/number.h"

enum { DIGITS = 6, DIGITS_MOST = 17, UNITS = 8, ISLANDS_SHOWN = 6, PHRASE_SIZE = 256 };

static bool is_near(const solve_candidate *c) {
    return c->unknown == SOLVE_NEAR;
}

static const char *measure_name(const solve_report *r) {
    return r->kind == MEASURE_ERROR ? "error" : "separation";
}

double solve_in_binary32(const solve_report *r, const solve_candidate *c) {
    dp_setup setup;
    dp_budget budget;
    return r->kind == MEASURE_SEPARATION && dp_setup_init(&setup, &c->spec) == DP_OK &&
                   dp_budget_at(&setup, c->reached.z, NULL, &budget) == DP_OK
               ? budget.separation
               : (double)NAN;
}

/* ---- Numbers that keep what they promise, as they are printed ---------------------------------------------------- */

static bool plane_is_good(const solve_report *r, const solve_candidate *c, double value) {
    const solve_problem p = {
        .spec = c->spec, .unknown = c->unknown, .kind = r->kind, .limit = r->limit, .lo = r->lo, .hi = r->hi};
    return plane_passes(&p, value);
}

/*
 * The fewest digits, six or more, of a plane between `value` and `until`, which lies on its safe side: typed in again
 * they pass, which is tried and not concluded.
 */
static const char *safe_digits(const solve_report *r, const solve_candidate *c, double value, double until,
                               char out[NUMBER_SIZE]) {
    const double sign = until >= value ? 1.0 : -1.0;
    for (int digits = DIGITS; digits <= DIGITS_MOST && isfinite(value); digits++) {
        const double unit = pow(10.0, floor(log10(value)) - (digits - 1));
        for (int i = 0; i < UNITS; i++) {
            number_digits(value + sign * i * unit, digits, out);
            const double shown = strtod(out, NULL);
            if ((shown - value) * sign >= 0.0 && (until - shown) * sign >= 0.0 && plane_is_good(r, c, shown))
                return out;
        }
    }
    number_shortest(value, out);
    return out;
}

static const char *digits(double value, char out[NUMBER_SIZE]) {
    number_digits(value, DIGITS, out);
    return out;
}

static const char *bound_digits(double value, bool upward, char out[NUMBER_SIZE]) {
    number_bound(value, DIGITS, upward, out);
    return out;
}

/* ---- Phrases ----------------------------------------------------------------------------------------------------- */

/* "at z = 5000", "from z = 10 to 5000" */
static const char *depths_phrase(const solve_report *r, char out[PHRASE_SIZE]) {
    char lo[NUMBER_SIZE];
    char hi[NUMBER_SIZE];
    number_shortest(r->lo, lo);
    number_shortest(r->hi, hi);
    if (r->lo < r->hi)
        snprintf(out, PHRASE_SIZE, "from z = %s to %s", lo, hi);
    else
        snprintf(out, PHRASE_SIZE, "at z = %s", lo);
    return out;
}

/* "tell surfaces 0.01 apart", "keep the error within 0.01", of what is wanted or of what is reached */
static const char *goal_phrase(const solve_report *r, double value, const char *ending, char out[PHRASE_SIZE]) {
    char text[NUMBER_SIZE];
    char where[PHRASE_SIZE];
    if (isnan(r->limit))
        bound_digits(value, true, text);
    else
        number_shortest(value, text);
    depths_phrase(r, where);
    if (r->kind == MEASURE_ERROR)
        snprintf(out, PHRASE_SIZE, "keep%s the error within %s %.100s", ending, text, where);
    else
        snprintf(out, PHRASE_SIZE, "tell%s surfaces %s apart %.100s", ending, text, where);
    return out;
}

/* "unorm24 d3d, far 10000", without what is solved for */
static const char *given_phrase(const solve_report *r, const solve_candidate *c, char out[PHRASE_SIZE]) {
    char znear[NUMBER_SIZE + 8] = "";
    char zfar[NUMBER_SIZE + 8] = "";
    char text[NUMBER_SIZE];
    const bool open_plane = r->target == SOLVE_FOR_NEAR || r->target == SOLVE_FOR_FAR;
    if (r->target != SOLVE_FOR_NEAR && number_shortest(c->spec.znear, text) > 0)
        snprintf(znear, sizeof znear, ", near %s", text);
    if (r->target != SOLVE_FOR_FAR && number_shortest(c->spec.zfar, text) > 0)
        snprintf(zfar, sizeof zfar, ", far %s", text);
    snprintf(out, PHRASE_SIZE, "%s %s%s%s%s%s", c->spec.format.name, dp_mapping_get(c->spec.mapping)->name,
             c->spec.ortho ? " orthographic" : "", znear, zfar, open_plane ? "," : "");
    return out;
}

static bool is_cheapest(const solve_report *r) {
    for (size_t i = 1; i < r->count; i++)
        if (r->items[i].possible && !r->items[i].solved && cost_compare(&r->items[i].price, &r->items[0].price) < 0)
            return false;
    return r->count > 1;
}

/* ---- The sentence ------------------------------------------------------------------------------------------------ */

static void sentence_of_distance(const solve_report *r, const solve_candidate *c, output *out) {
    static const char *const manners[DP_MODEL_COUNT][2] = {
        [DP_MODEL_EXACT] = {"does not hold in the lattice", "holds in the lattice"},
        [DP_MODEL_STAGED] = {"does not hold in the model staged", "holds in the model staged"},
        [DP_MODEL_FP32] = {"is not guaranteed", "is guaranteed"},
    };
    char given[PHRASE_SIZE], limit[NUMBER_SIZE], lo[NUMBER_SIZE], reach[NUMBER_SIZE], ideal[NUMBER_SIZE];
    given_phrase(r, c, given);
    number_shortest(r->limit, limit);
    number_shortest(r->lo, lo);
    number_shortest(c->distance.value, reach);
    if (!c->distance.throughout)
        bound_digits(c->distance.value, false, reach);
    output_format(out, "%s%s: %s %s %s", c->possible ? "" : "Impossible: ", given,
                  r->kind == MEASURE_ERROR ? "an error within" : "a separation of", limit,
                  manners[c->spec.model][c->possible]);
    if (c->possible)
        output_format(out, " from z = %s up to z = %s", lo, reach);
    else
        output_format(out, " even at z = %s", lo);
    if (c->spec.model == DP_MODEL_EXACT)
        output_text(out, ".\n");
    else if (!c->lattice.possible)
        output_text(out, "; nor in the lattice.\n");
    else
        output_format(out, "; in the lattice up to %s.\n", bound_digits(c->lattice.value, false, ideal));
}

static void sentence_of_nothing(const solve_report *r, const solve_candidate *c, output *out) {
    char goal[PHRASE_SIZE], given[PHRASE_SIZE], text[NUMBER_SIZE], best[NUMBER_SIZE];
    given_phrase(r, c, given);
    goal_phrase(r, r->limit, "s", goal);
    const char *what = option_word(OPTION_FOR, r->target);
    if (isinf(c->reached.value))
        output_format(out, "Impossible: %s has no %s that %s: nothing behind is certain to be told apart.\n", given,
                      what, goal);
    else if (!c->solved)
        output_format(out, "Impossible: no %s with near and far as they are %s; %s comes nearest, with %s.\n", what,
                      goal, given, bound_digits(c->reached.value, true, best));
    else if (c->plane.certain)
        output_format(out, "Impossible: no %s of %s %s; %s %s comes nearest, with %s.\n", what, given, goal, what,
                      digits(solve_plane_of(c), text), bound_digits(c->reached.value, true, best));
    else
        output_format(out, "No %s of %s was found that %s; %s %s comes near, with %s.\n", what, given, goal, what,
                      digits(solve_plane_of(c), text), bound_digits(c->reached.value, true, best));
}

static void sentence_of_plane(const solve_report *r, const solve_candidate *c, output *out) {
    char goal[PHRASE_SIZE], given[PHRASE_SIZE], a[NUMBER_SIZE], b[NUMBER_SIZE];
    const double value = solve_plane_of(c);
    const double until = c->plane.until;
    const bool scattered = c->plane.passed < c->plane.tried;
    given_phrase(r, c, given);
    goal_phrase(r, r->limit, "", goal);
    if (scattered && !isnan(c->plane.steady))
        output_format(out, "%s %s is enough for %s to %s; %s %s on every one tried is.\n", is_near(c) ? "Near" : "Far",
                      safe_digits(r, c, value, until, a), given, goal, is_near(c) ? "from" : "down from",
                      safe_digits(r, c, c->plane.steady, until, b));
    else if (scattered || !c->plane.certain)
        output_format(out, "%s %s is enough for %s to %s.\n", is_near(c) ? "Near" : "Far",
                      safe_digits(r, c, value, until, a), given, goal);
    else if (value == (is_near(c) ? c->least : c->most))
        output_format(out, "Any %s from %s to %s will do for %s to %s.\n", option_word(OPTION_FOR, r->target),
                      safe_digits(r, c, fmin(value, until), fmax(value, until), a),
                      safe_digits(r, c, fmax(value, until), fmin(value, until), b), given, goal);
    else
        output_format(out, "%s %s for %s to %s.\n", is_near(c) ? "Near must be at least" : "Far may be at most",
                      safe_digits(r, c, value, until, a), given, goal);
}

static void text_sentence(const solve_report *r, output *out) {
    const solve_candidate *c = &r->items[0];
    char goal[PHRASE_SIZE];
    char given[PHRASE_SIZE];
    if (r->target == SOLVE_FOR_DISTANCE)
        sentence_of_distance(r, c, out);
    else if (!c->possible)
        sentence_of_nothing(r, c, out);
    else if (c->solved)
        sentence_of_plane(r, c, out);
    else if (r->target == SOLVE_FOR_SEPARATION)
        output_format(out, "%s %s.\n", given_phrase(r, c, given), goal_phrase(r, c->reached.value, "s", goal));
    else
        output_format(out, "%s %s%s.\n", given_phrase(r, c, given), goal_phrase(r, r->limit, "s", goal),
                      is_cheapest(r) ? ", the cheapest that does" : "");
}

/* ---- What stands behind it --------------------------------------------------------------------------------------- */

static void text_islands(const solve_report *r, output *out) {
    const solve_candidate *c = &r->items[0];
    const int before = c->island_count - 1;
    char lo[NUMBER_SIZE];
    char hi[NUMBER_SIZE];
    if (c->spec.model != DP_MODEL_EXACT)
        return; /* the lattice's */
    for (int i = before - 1; i >= 0 && before - 1 - i < ISLANDS_SHOWN; i--)
        output_format(out, "  %-14s from %s to %s\n", i == before - 1 ? "also" : "",
                      safe_digits(r, c, r->islands[i].lo, r->islands[i].hi, lo),
                      safe_digits(r, c, r->islands[i].hi, r->islands[i].lo, hi));
    if (before > ISLANDS_SHOWN)
        output_format(out, "  %-14s and %d more ranges further down; --json lists them\n", "", before - ISLANDS_SHOWN);
}

/* Which values pass, beside the answer: all of them, or those that were tried. */
static void text_plane(const solve_report *r, output *out) {
    const solve_candidate *c = &r->items[0];
    const char *what = option_word(OPTION_FOR, r->target);
    const plane_answer *p = &c->plane;
    char a[NUMBER_SIZE];
    char b[NUMBER_SIZE];
    const double lo = fmin(solve_plane_of(c), p->until);
    const double hi = fmax(solve_plane_of(c), p->until);
    number_shortest(solve_plane_of(c), a);
    output_format(out, "  %-14s %s exactly%s\n", what, a,
                  p->certain   ? ""
                  : is_near(c) ? "; a smaller one may be enough, too"
                               : "; a larger one may be enough, too");
    safe_digits(r, c, lo, hi, a);
    safe_digits(r, c, hi, lo, b);
    if (p->tried == 0)
        output_format(out, "  %-14s every %s from %s to %s\n", "passes", what, a, b);
    else if (p->passed == p->tried)
        output_format(out, "  %-14s every %s tried from %s to %s, %llu of them\n", "passes", what, a, b,
                      (unsigned long long)p->tried);
    else
        output_format(out, "  %-14s %llu of %llu tried from %s to %s: it hangs on how the matrix is rounded\n",
                      "passes", (unsigned long long)p->passed, (unsigned long long)p->tried, a, b);
    if (!isnan(p->fails_to))
        output_format(out, "  %-14s every binary32 %s from there %s to %s\n", "fails", what, is_near(c) ? "down" : "up",
                      bound_digits(p->fails_to, is_near(c), a));
    text_islands(r, out);
}

/* The model, and why it is not the fullest that there is. */
static void text_model(const solve_report *r, const solve_candidate *c, output *out) {
    static const char *const words[DP_MODEL_COUNT] = {
        [DP_MODEL_EXACT] = "exact: real arithmetic, the lattice alone",
        [DP_MODEL_STAGED] = "staged: NDC and window depth each rounded to binary32",
        [DP_MODEL_FP32] = "fp32: guaranteed in binary32 arithmetic",
    };
    const bool chosen = r->o->model_auto || !option_given(r->o, OPTION_MODEL);
    const char *why = "";
    if (c->spec.model == DP_MODEL_STAGED && chosen)
        why = r->kind == MEASURE_ERROR ? "; fp32 has no cells whose error could be asked"
                                       : "; the mapping has no binary32 pipeline for fp32";
    output_format(out, "  %-14s %s%s%s%s\n", "model", words[c->spec.model], c->spec.model == DP_MODEL_FP32 ? ", " : "",
                  c->spec.model == DP_MODEL_FP32 ? dp_arith_get(c->spec.arith)->name : "", why);
}

/* The lattice beside a fuller model, and the guarantee beside the lattice. */
static void text_beside(const solve_report *r, const solve_candidate *c, output *out) {
    char a[NUMBER_SIZE];
    char b[NUMBER_SIZE];
    const double binary32 = solve_in_binary32(r, c);
    if (c->spec.model != DP_MODEL_EXACT && r->target != SOLVE_FOR_DISTANCE) {
        if (c->solved && !c->lattice.possible)
            output_format(out, "  %-14s no %s would do in it either\n", "in the lattice",
                          option_word(OPTION_FOR, r->target));
        else if (c->solved)
            output_format(out, "  %-14s %s %s would do\n", "in the lattice", option_word(OPTION_FOR, r->target),
                          bound_digits(c->lattice.value, is_near(c), a));
        else
            output_format(out, "  %-14s %s at z = %s\n", "in the lattice",
                          bound_digits(c->lattice.reached.value, true, a), digits(c->lattice.reached.z, b));
    }
    if (c->spec.model == DP_MODEL_FP32 || isinf(c->reached.value) || r->target == SOLVE_FOR_DISTANCE)
        return;
    if (isinf(binary32))
        output_format(out, "  %-14s nothing is certain there: 'depthprec budget' says why\n", "in binary32");
    else if (!isnan(binary32))
        output_format(out, "  %-14s %s is certain there%s\n", "in binary32", bound_digits(binary32, true, a),
                      binary32 > r->limit * (1.0 + 1e-6) ? ", too much: 'depthprec budget' says why" : "");
}

static void text_verification(const solve_report *r, output *out) {
    const solve_candidate *c = &r->items[0];
    char a[NUMBER_SIZE];
    char b[NUMBER_SIZE];
    if (c->solved && c->possible)
        text_plane(r, out);
    output_format(out, "  %-14s %s at z = %s", measure_name(r), bound_digits(c->reached.value, true, a),
                  digits(c->reached.z, b));
    if (!isnan(r->limit))
        output_format(out, ", wanted %s", digits(r->limit, a));
    output_char(out, '\n');
    text_model(r, c, out);
    text_beside(r, c, out);
}

/* ---- Alternatives ------------------------------------------------------------------------------------------------ */

/* The first possible alternative with its format, so that a caution is said once. */
static bool is_first_of_format(const solve_report *r, size_t index) {
    for (size_t i = 1; i < index; i++)
        if (r->items[i].possible && strcmp(r->items[i].spec.format.name, r->items[index].spec.format.name) == 0)
            return false;
    return true;
}

/* What a candidate can do and what it could in the lattice: its plane or distance, or what it reaches. */
static void text_alternative(const solve_report *r, const solve_candidate *c, output *out) {
    char plane[NUMBER_SIZE], value[NUMBER_SIZE], ideal[NUMBER_SIZE];
    const bool far_asked = r->target == SOLVE_FOR_FAR;
    const bool by_value = r->target == SOLVE_FOR_FORMAT || r->target == SOLVE_FOR_MAPPING;
    output_format(out, "  %-10s %-11s %-6s ", c->spec.format.name, dp_mapping_get(c->spec.mapping)->name,
                  dp_model_name(c->spec.model));
    bound_digits(c->reached.value, true, value);
    bound_digits(by_value ? c->lattice.reached.value : c->lattice.value, by_value || r->target == SOLVE_FOR_NEAR,
                 ideal);
    if (r->target == SOLVE_FOR_SEPARATION) {
        output_format(out, "%12s %12s\n", value, bound_digits(c->lattice.reached.value, true, ideal));
        return;
    }
    if (r->target == SOLVE_FOR_DISTANCE)
        bound_digits(c->distance.value, false, plane);
    else if (c->solved && c->possible)
        safe_digits(r, c, solve_plane_of(c), c->plane.until, plane);
    else
        digits(far_asked ? c->spec.zfar : c->spec.znear, plane);
    output_format(out, "%12s %12s %12s %6d  %s\n", c->possible ? plane : "none",
                  c->lattice.possible || by_value ? ideal : "none", value, c->price.bytes, c->price.available);
}

static void text_alternatives(const solve_report *r, output *out) {
    static const char *const heads[] = {"least near", "largest far", "near", "near", "", "distance"};
    if (r->count < 2)
        return;
    if (r->target == SOLVE_FOR_SEPARATION)
        output_format(out, "\nOthers\n  %-10s %-11s %-6s %12s %12s\n", "format", "mapping", "model", measure_name(r),
                      "lattice");
    else
        output_format(out, "\nAlternatives, cheapest first\n  %-10s %-11s %-6s %12s %12s %12s %6s  %s\n", "format",
                      "mapping", "model", heads[r->target], "lattice", measure_name(r), "bytes", "to be had");
    for (size_t i = 1; i < r->count; i++)
        text_alternative(r, &r->items[i], out);
    for (size_t i = 1; i < r->count && r->target != SOLVE_FOR_SEPARATION; i++)
        if (is_first_of_format(r, i) && r->items[i].possible && r->items[i].price.caution[0] != '\0')
            output_format(out, "  %s\n", r->items[i].price.caution);
}

static void write_text(const solve_report *r, output *out) {
    text_sentence(r, out);
    text_verification(r, out);
    text_alternatives(r, out);
}

void solve_report_write(const solve_report *r, output *out) {
    static void (*const writers[])(const solve_report *, output *) = {
        [FORM_TEXT] = write_text, [FORM_JSON] = solve_report_json, [FORM_CSV] = solve_report_csv};
    writers[r->o->form](r, out);
}
