/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/solve_report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/csv.h"
#include "cli/json.h"
#include "cli/number.h"
#include "cli/setups.h"

enum { DIGITS = 6, ISLANDS_SHOWN = 6, PHRASE_SIZE = 256 };

static const char *const target_names[SOLVE_FOR_COUNT] = {"", "near", "far", "format", "mapping", "separation"};

static bool is_near(const solve_candidate *c) {
    return c->unknown == SOLVE_NEAR;
}

static double plane_of(const solve_candidate *c) {
    return is_near(c) ? c->spec.znear : c->spec.zfar;
}

static const char *measure_name(const solve_report *r) {
    return r->kind == MEASURE_ERROR ? "error" : "separation";
}

/* The guarantee of binary32 arithmetic at the depth that is worst; NaN where it has no pipeline, or is not asked. */
static double in_binary32(const solve_report *r, const solve_candidate *c) {
    dp_setup setup;
    dp_budget budget;
    return r->kind == MEASURE_SEPARATION && dp_setup_init(&setup, &c->spec) == DP_OK &&
                   dp_budget_at(&setup, c->worst.z, NULL, &budget) == DP_OK
               ? budget.separation
               : (double)NAN;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

/*
 * A few digits, rounded to the safe side, away from what fails: typed in again they pass. All digits where an island
 * is too narrow for that.
 */
static const char *safe_digits(double value, double until, char out[NUMBER_SIZE]) {
    number_digits(value, DIGITS, out);
    const double sign = until >= value ? 1.0 : -1.0;
    double shown = strtod(out, NULL);
    if (isinf(value) || shown == value)
        return out;
    if ((shown - value) * sign < 0.0) {
        const double unit = pow(10.0, floor(log10(value)) - (DIGITS - 1));
        number_digits(shown + sign * unit, DIGITS, out);
        shown = strtod(out, NULL);
    }
    if (!((shown - value) * sign >= 0.0 && (until - shown) * sign >= 0.0))
        number_shortest(value, out);
    return out;
}

static const char *digits(double value, char out[NUMBER_SIZE]) {
    number_digits(value, DIGITS, out);
    return out;
}

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
        digits(value, text);
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

static void text_sentence(const solve_report *r, output *out) {
    const solve_candidate *c = &r->items[0];
    char goal[PHRASE_SIZE];
    char given[PHRASE_SIZE];
    char text[NUMBER_SIZE];
    char best[NUMBER_SIZE];
    given_phrase(r, c, given);
    if (r->target == SOLVE_FOR_SEPARATION) {
        output_format(out, "%s %s.\n", given, goal_phrase(r, c->worst.value, "s", goal));
        return;
    }
    goal_phrase(r, r->limit, c->possible && c->solved ? "" : "s", goal);
    if (isinf(c->worst.value))
        output_format(out, "Impossible: %s has no %s that %s: no depth lies one step behind.\n", given,
                      target_names[r->target], goal);
    else if (!c->possible && !c->solved)
        output_format(out, "Impossible: no %s with near and far as they are %s; %s comes nearest, with %s.\n",
                      target_names[r->target], goal, given, digits(c->worst.value, best));
    else if (!c->possible)
        output_format(out, "Impossible: no %s of %s %s; %s %s comes nearest, with %s.\n", target_names[r->target],
                      given, goal, target_names[r->target], digits(plane_of(c), text), digits(c->worst.value, best));
    else if (!c->solved)
        output_format(out, "%s %s%s.\n", given, goal, is_cheapest(r) ? ", the cheapest that does" : "");
    else if (plane_of(c) == (is_near(c) ? c->least : c->most))
        output_format(out, "Any %s from %s to %s will do for %s to %s.\n", target_names[r->target],
                      safe_digits(fmin(plane_of(c), c->until), fmax(plane_of(c), c->until), text),
                      safe_digits(fmax(plane_of(c), c->until), fmin(plane_of(c), c->until), best), given, goal);
    else
        output_format(out, "%s %s for %s to %s.\n", is_near(c) ? "Near must be at least" : "Far may be at most",
                      safe_digits(plane_of(c), c->until, text), given, goal);
}

static void text_islands(const solve_report *r, output *out) {
    const int before = r->items[0].island_count - 1;
    char lo[NUMBER_SIZE];
    char hi[NUMBER_SIZE];
    for (int i = before - 1; i >= 0 && before - 1 - i < ISLANDS_SHOWN; i--)
        output_format(out, "  %-14s from %s to %s\n", i == before - 1 ? "also" : "",
                      safe_digits(r->islands[i].lo, r->islands[i].hi, lo),
                      safe_digits(r->islands[i].hi, r->islands[i].lo, hi));
    if (before > ISLANDS_SHOWN)
        output_format(out, "  %-14s and %d more ranges further down; --json lists them\n", "", before - ISLANDS_SHOWN);
}

static void text_verification(const solve_report *r, output *out) {
    const solve_candidate *c = &r->items[0];
    char a[NUMBER_SIZE];
    char b[NUMBER_SIZE];
    if (c->solved && c->possible) {
        const double lo = fmin(plane_of(c), c->until);
        const double hi = fmax(plane_of(c), c->until);
        number_shortest(plane_of(c), a);
        output_format(out, "  %-14s %s exactly\n", target_names[r->target], a);
        output_format(out, "  %-14s every %s from %s to %s\n", "passes", target_names[r->target],
                      safe_digits(lo, hi, a), safe_digits(hi, lo, b));
        text_islands(r, out);
    }
    output_format(out, "  %-14s %s at z = %s", measure_name(r), digits(c->worst.value, a), digits(c->worst.z, b));
    if (!isnan(r->limit))
        output_format(out, ", wanted %s", digits(r->limit, a));
    output_char(out, '\n');
    const double binary32 = in_binary32(r, c);
    if (isinf(c->worst.value))
        return;
    if (isinf(binary32))
        output_format(out, "  %-14s nothing is certain there: 'depthprec budget' says why\n", "in binary32");
    else if (!isnan(binary32))
        output_format(out, "  %-14s %s is certain there%s\n", "in binary32", digits(binary32, a),
                      binary32 > r->limit * (1.0 + 1e-6) ? ", too much: 'depthprec budget' says why" : "");
}

/* The first possible alternative with its format, so that a caution is said once. */
static bool is_first_of_format(const solve_report *r, size_t index) {
    for (size_t i = 1; i < index; i++)
        if (r->items[i].possible && strcmp(r->items[i].spec.format.name, r->items[index].spec.format.name) == 0)
            return false;
    return true;
}

static void text_alternatives(const solve_report *r, output *out) {
    char plane[NUMBER_SIZE];
    char value[NUMBER_SIZE];
    const bool far_asked = r->target == SOLVE_FOR_FAR;
    if (r->count < 2)
        return;
    if (r->target == SOLVE_FOR_SEPARATION)
        output_format(out, "\nOthers\n  %-10s %-11s %12s\n", "format", "mapping", measure_name(r));
    else
        output_format(out, "\nAlternatives, cheapest first\n  %-10s %-11s %12s %12s %6s  %s\n", "format", "mapping",
                      far_asked                     ? "largest far"
                      : r->target == SOLVE_FOR_NEAR ? "least near"
                                                    : "near",
                      measure_name(r), "bytes", "to be had");
    for (size_t i = 1; i < r->count; i++) {
        const solve_candidate *c = &r->items[i];
        const char *mapping = dp_mapping_get(c->spec.mapping)->name;
        output_format(out, "  %-10s %-11s ", c->spec.format.name, mapping);
        if (r->target == SOLVE_FOR_SEPARATION) {
            output_format(out, "%12s\n", digits(c->worst.value, value));
            continue;
        }
        safe_digits(far_asked ? c->spec.zfar : c->spec.znear, c->solved ? c->until : (double)NAN, plane);
        output_format(out, "%12s %12s %6d  %s\n", c->possible ? plane : "none", digits(c->worst.value, value),
                      c->price.bytes, c->price.available);
    }
    for (size_t i = 1; i < r->count && r->target != SOLVE_FOR_SEPARATION; i++)
        if (is_first_of_format(r, i) && r->items[i].possible && r->items[i].price.caution[0] != '\0')
            output_format(out, "  %s\n", r->items[i].price.caution);
}

static void write_text(const solve_report *r, output *out) {
    text_sentence(r, out);
    text_verification(r, out);
    text_alternatives(r, out);
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

static void json_candidate(json *j, const solve_report *r, const solve_candidate *c) {
    dp_setup setup;
    if (dp_setup_init(&setup, &c->spec) == DP_OK)
        setup_json(j, &setup);
    json_bool(j, "possible", c->possible);
    json_number(j, measure_name(r), c->worst.value);
    json_number(j, "z", c->worst.z);
    json_number(j, "separation_fp32", in_binary32(r, c));
    if (c->solved && c->possible)
        json_number(j, "until", c->until);
    json_integer(j, "bytes", (uint64_t)c->price.bytes);
    json_string(j, "available", c->price.available);
    json_string(j, "caution", c->price.caution);
    json_string(j, "effort", c->price.effort);
}

static void write_json(const solve_report *r, output *out) {
    const solve_candidate *answer = &r->items[0];
    json j = json_start(out, "solve");
    json_string(&j, "for", target_names[r->target]);
    json_string(&j, "measure", measure_name(r));
    json_number(&j, "limit", r->limit);
    json_number(&j, "lo", r->lo);
    json_number(&j, "hi", r->hi);
    json_bool(&j, "possible", answer->possible);
    json_object(&j, "answer");
    json_candidate(&j, r, answer);
    json_end(&j);
    json_array(&j, "islands");
    for (int i = 0; i < answer->island_count; i++) {
        json_object(&j, NULL);
        json_number(&j, "lo", r->islands[i].lo);
        json_number(&j, "hi", r->islands[i].hi);
        json_end(&j);
    }
    json_end(&j);
    json_array(&j, "alternatives");
    for (size_t i = 1; i < r->count; i++) {
        json_object(&j, NULL);
        json_candidate(&j, r, &r->items[i]);
        json_end(&j);
    }
    json_end(&j);
    json_finish(&j);
}

/* ---- CSV: the answer, its earlier islands, the alternatives ------------------------------------------------------ */

static void csv_candidate(csv *c, const solve_report *r, const solve_candidate *item, const char *role, double from,
                          double to) {
    dp_setup setup;
    if (dp_setup_init(&setup, &item->spec) != DP_OK)
        return;
    csv_string(c, role);
    setup_csv(c, &setup);
    csv_string(c, target_names[r->target]);
    csv_string(c, item->possible ? "true" : "false");
    csv_string(c, measure_name(r));
    csv_number(c, r->limit);
    csv_number(c, item->worst.value);
    csv_number(c, item->worst.z);
    csv_number(c, from);
    csv_number(c, to);
    csv_integer(c, (uint64_t)item->price.bytes);
    csv_string(c, item->price.available);
    csv_end(c);
}

static void write_csv(const solve_report *r, output *out) {
    static const char *const heads[] = {"for",       "possible",     "measure",    "limit [scene]", "value [scene]",
                                        "z [scene]", "from [scene]", "to [scene]", "bytes",         "available"};
    csv c = csv_start(out);
    csv_string(&c, "role");
    setup_csv_head(&c);
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        csv_string(&c, heads[i]);
    csv_end(&c);
    for (size_t i = 0; i < r->count; i++) {
        const solve_candidate *item = &r->items[i];
        const bool solved = item->solved && item->possible;
        csv_candidate(&c, r, item, i == 0 ? "answer" : "alternative",
                      solved ? fmin(plane_of(item), item->until) : (double)NAN,
                      solved ? fmax(plane_of(item), item->until) : (double)NAN);
        for (int k = 0; i == 0 && k + 1 < item->island_count; k++)
            csv_candidate(&c, r, item, "island", r->islands[k].lo, r->islands[k].hi);
    }
}

void solve_report_write(const solve_report *r, output *out) {
    static void (*const writers[])(const solve_report *, output *) = {
        [FORM_TEXT] = write_text, [FORM_JSON] = write_json, [FORM_CSV] = write_csv};
    writers[r->o->form](r, out);
}
