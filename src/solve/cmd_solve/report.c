/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The findings of solve in sentences. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/cmd/setups.h"
#include "camera/cmd/slant.h"
#include "core/append.h"
#include "core/elementary.h"
#include "solve/cmd_solve/report.h"
#include "solve/cmd_solve/request.h"

const char *solve_measure_name(const solve_report *r) {
    return r->kind == MEASURE_ERROR ? "error" : "separation";
}

double solve_in_binary32(const solve_report *r, const solve_candidate *c, bool slanted) {
    dp_spec spec = c->spec;
    dp_setup setup;
    dp_budget budget;
    if (!slanted)
        spec.triangles.width = 0;
    return r->kind == MEASURE_SEPARATION && judge_setup(&spec, &setup) == DP_OK &&
                   dp_budget_at(&setup, c->reached.z, NULL, &budget) == DP_OK
               ? budget.separation
               : (double)NAN;
}

enum { DIGITS_MOST = 17, UNITS = 8, PHRASE_SIZE = 256 };

/* A part of a sentence; lives until the statement ends. */
typedef struct phrase {
    char text[PHRASE_SIZE];
} phrase;

static bool is_slanted(const solve_report *r) {
    return r->o->camera.triangles.width > 0;
}

static bool is_near(const solve_candidate *c) {
    return c->unknown == SOLVE_NEAR;
}

static const char *target_name(const solve_report *r) {
    return option_word("for", r->target);
}

/* Lengths, with the unit where it is known. */
static number_text in_unit(const solve_report *r, number_text number) {
    return number_in(number, camera_unit(&r->o->camera));
}

static number_text whole(const solve_report *r, double value) {
    return camera_length(&r->o->camera, value, 0);
}

static number_text digits(const solve_report *r, double value) {
    return camera_length(&r->o->camera, value, SOLVE_DIGITS);
}

static number_text up(const solve_report *r, double value) {
    return in_unit(r, number_up(value, SOLVE_DIGITS));
}

static number_text bound(const solve_report *r, double value, bool upward) {
    return upward ? up(r, value) : in_unit(r, number_down(value, SOLVE_DIGITS));
}

/* The measured value in the unit of the one wanted, and that beside it. */
static number_two against_wanted(const solve_report *r, double value) {
    const solve_request *o = r->o;
    const unit_row *unit = option_unit(o->line, r->kind == MEASURE_ERROR ? "error" : "separation");
    const char *name = unit != NULL ? unit->name : NULL;
    const number_two out = number_compared(unit_convert(value, o->camera.lengths.unit, unit),
                                           unit_convert(r->limit, o->camera.lengths.unit, unit), SOLVE_DIGITS);
    return (number_two){number_in(out.value, name), number_in(out.limit, name)};
}

static number_text measured(const solve_report *r, double value) {
    return against_wanted(r, value).value;
}

/* ---- Numbers that keep what they promise, as they are printed ---------------------------------------------------- */

static bool plane_is_good(const solve_report *r, const solve_candidate *c, double value) {
    const solve_problem p = {
        .spec = c->spec, .unknown = c->unknown, .kind = r->kind, .limit = r->limit, .lo = r->lo, .hi = r->hi};
    return plane_passes(&p, value);
}

number_text solve_safe_digits(const solve_report *r, const solve_candidate *c, double value, double until) {
    const double sign = until >= value ? 1.0 : -1.0;
    for (int digits = SOLVE_DIGITS; digits <= DIGITS_MOST && isfinite(value); digits++) {
        const double unit = dp_pow(10.0, floor(dp_log10(value)) - (digits - 1));
        for (int i = 0; i < UNITS; i++) {
            const number_text out = number_of(value + sign * i * unit, digits);
            const double shown = strtod(out.text, NULL);
            if ((shown - value) * sign >= 0.0 && (until - shown) * sign >= 0.0 && plane_is_good(r, c, shown))
                return out;
        }
    }
    return number_full(value);
}

static number_text safe_digits(const solve_report *r, const solve_candidate *c, double value, double until) {
    if (value == r->lo || value == r->hi) /* the run ends at a depth that was asked about */
        return whole(r, value);
    return in_unit(r, solve_safe_digits(r, c, value, until));
}

/* The ends of the values that pass, the lower first, or the upper. */
static number_text passing(const solve_report *r, const solve_candidate *c, bool lower) {
    const double lo = fmin(solve_plane_of(c), c->plane.until), hi = fmax(solve_plane_of(c), c->plane.until);
    return lower ? safe_digits(r, c, lo, hi) : safe_digits(r, c, hi, lo);
}

/* ---- Phrases ----------------------------------------------------------------------------------------------------- */

/* "resolve 0.01 at z = 5000", "keep the error within 0.01 from z = 10 to 5000" */
static phrase goal_phrase(const solve_report *r, double value, const char *ending) {
    phrase out;
    const number_text text = isnan(r->limit) ? measured(r, value) : whole(r, value);
    if (r->kind == MEASURE_ERROR)
        snprintf(out.text, PHRASE_SIZE, "keep%s the error within %s ", ending, text.text);
    else
        snprintf(out.text, PHRASE_SIZE, "resolve%s %s%s%s ", ending, text.text, is_slanted(r) ? " at " : "",
                 is_slanted(r) ? slant_words(&r->o->camera.triangles).text : "");
    if (r->lo < r->hi)
        append(out.text, PHRASE_SIZE, "from z = %s to %s", whole(r, r->lo).text, whole(r, r->hi).text);
    else
        append(out.text, PHRASE_SIZE, "at z = %s", whole(r, r->lo).text);
    return out;
}

/* "unorm24 d3d, far 10000", without what is solved for */
static phrase given_phrase(const solve_report *r, const solve_candidate *c) {
    phrase out;
    snprintf(out.text, PHRASE_SIZE, "%s %s%s", c->spec.format.name, dp_mapping_get(c->spec.mapping)->name,
             c->spec.ortho ? " orthographic" : "");
    if (r->target != SOLVE_FOR_NEAR)
        append(out.text, PHRASE_SIZE, ", near %s", whole(r, c->spec.znear).text);
    if (r->target != SOLVE_FOR_FAR)
        append(out.text, PHRASE_SIZE, ", far %s", whole(r, c->spec.zfar).text);
    if (r->target == SOLVE_FOR_NEAR || r->target == SOLVE_FOR_FAR)
        append(out.text, PHRASE_SIZE, ",");
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
        [DP_MODEL_STAGED] = {"does not hold in model staged", "holds in model staged"},
        [DP_MODEL_FLOAT] = {"is not guaranteed", "is guaranteed"},
    };
    const distance_answer *d = &c->distance;
    output_format(out, "%s%s: %s %s%s%s %s", c->possible ? "" : "Impossible: ", given_phrase(r, c).text,
                  r->kind == MEASURE_ERROR ? "an error within" : "a separation of", whole(r, r->limit).text,
                  is_slanted(r) ? " at " : "", is_slanted(r) ? slant_words(&r->o->camera.triangles).text : "",
                  manners[c->spec.model][c->possible]);
    if (c->possible)
        output_format(out, " from z = %s up to z = %s", whole(r, r->lo).text,
                      (d->throughout ? whole(r, d->value) : bound(r, d->value, false)).text);
    else
        output_format(out, " even at z = %s", whole(r, r->lo).text);
    if (!isnan(r->fight.first))
        output_format(out, "; first found to z-fight at z = %s", bound(r, r->fight.first, false).text);
    else if (!isnan(r->fight.searched))
        output_format(out, "; no z-fighting found up to z = %s", bound(r, r->fight.searched, false).text);
    else if (c->possible && !d->throughout && r->kind == MEASURE_SEPARATION && !is_slanted(r) &&
             d->value + r->limit > r->hi)
        output_format(out, "; nothing up to z = %s lies that far behind it", whole(r, r->hi).text);
    if (c->spec.model == DP_MODEL_EXACT)
        output_text(out, ".\n");
    else if (!c->lattice.possible)
        output_text(out, "; nor in the lattice.\n");
    else
        output_format(out, "; in the lattice up to %s.\n", bound(r, c->lattice.value, false).text);
}

static void sentence_of_nothing(const solve_report *r, const solve_candidate *c, output *out) {
    const phrase given = given_phrase(r, c), goal = goal_phrase(r, r->limit, "s");
    const number_text plane = digits(r, solve_plane_of(c)), best = measured(r, c->reached.value);
    const char *what = target_name(r);
    if (isinf(c->reached.value))
        output_format(out, "Impossible: %s has no %s that %s: nothing farther is guaranteed to be resolved.\n",
                      given.text, what, goal.text);
    else if (!c->solved)
        output_format(out, "Impossible: with this near and far no %s %s; %s comes nearest, with %s.\n", what, goal.text,
                      given.text, best.text);
    else
        output_format(out, "%s %s of %s %s%s; %s %s comes near, with %s.\n", c->plane.certain ? "Impossible: no" : "No",
                      what, given.text, c->plane.certain ? "" : "was found that ", goal.text, what, plane.text,
                      best.text);
}

/* "larger one up to 5000", on the safe side of the answer */
static phrase beyond_phrase(const solve_report *r, const solve_candidate *c) {
    phrase out;
    snprintf(out.text, PHRASE_SIZE, "%s one %s to %s", is_near(c) ? "larger" : "smaller", is_near(c) ? "up" : "down",
             passing(r, c, !is_near(c)).text);
    return out;
}

static void sentence_of_plane(const solve_report *r, const solve_candidate *c, output *out) {
    const phrase given = given_phrase(r, c), goal = goal_phrase(r, r->limit, "");
    const plane_answer *p = &c->plane;
    const double value = solve_plane_of(c);
    const number_text safe = safe_digits(r, c, value, p->until);
    const char *name = is_near(c) ? "Near" : "Far";
    if (!p->certain)
        output_format(out, "%s %s suffices for %s to %s, and so does any %s.\n", name, safe.text, given.text, goal.text,
                      beyond_phrase(r, c).text);
    else if (value == (is_near(c) ? p->least : p->most))
        output_format(out, "Any %s from %s to %s suffices for %s to %s.\n", target_name(r), passing(r, c, true).text,
                      passing(r, c, false).text, given.text, goal.text);
    else
        output_format(out, "%s %s for %s to %s.\n", is_near(c) ? "Near must be at least" : "Far may be at most",
                      safe.text, given.text, goal.text);
}

static void say_sentence(const solve_report *r, const solve_candidate *c, output *out) {
    const bool asked = r->target == SOLVE_FOR_SEPARATION;
    if (r->target == SOLVE_FOR_DISTANCE)
        sentence_of_distance(r, c, out);
    else if (!c->possible)
        sentence_of_nothing(r, c, out);
    else if (c->solved)
        sentence_of_plane(r, c, out);
    else
        output_format(out, "%s %s%s.\n", given_phrase(r, c).text,
                      goal_phrase(r, asked ? c->reached.value : r->limit, "s").text,
                      !asked && is_cheapest(r) ? ", the cheapest that does" : "");
}

/* ---- What stands behind it --------------------------------------------------------------------------------------- */

static void say_plane(const solve_report *r, const solve_candidate *c, page *p) {
    const char *what = target_name(r);
    page_note(p, what, "%s exactly%s", whole(r, solve_plane_of(c)).text,
              c->plane.certain ? ""
              : is_near(c)     ? "; a smaller one may suffice"
                               : "; a larger one may suffice");
    page_note(p, "passes", "every %s from %s to %s", what, passing(r, c, true).text, passing(r, c, false).text);
}

/* The model, and why it is not the fullest that there is. */
static void say_model(const solve_report *r, const solve_candidate *c, page *p) {
    static const char *const words[DP_MODEL_COUNT] = {
        [DP_MODEL_EXACT] = "exact: real arithmetic, the lattice alone",
        [DP_MODEL_STAGED] = "staged: NDC and window depth each rounded to binary32",
        [DP_MODEL_FLOAT] = "float: guaranteed in binary32 arithmetic, ",
    };
    const bool chosen = r->o->camera.model_auto || !option_given(r->o->line, "model");
    const char *more = "";
    if (c->spec.model == DP_MODEL_FLOAT)
        more = dp_arith_get(c->spec.arith)->name;
    else if (c->spec.model == DP_MODEL_STAGED && chosen)
        more = r->kind == MEASURE_ERROR ? "; model float has no cells, so no error"
                                        : "; model float does not cover this mapping";
    const bool shader = c->spec.model == DP_MODEL_FLOAT && dp_mapping_get(c->spec.mapping)->curve == DP_CURVE_LOG;
    page_note(p, "model", "%s%s%s%s", words[c->spec.model], more,
              shader          ? ", for every log2 that a shader may use"
              : is_slanted(r) ? ", at "
                              : "",
              !shader && is_slanted(r) ? slant_words(&r->o->camera.triangles).text : "");
}

/* The lattice beside a fuller model, and the guarantee beside the lattice. */
static void say_beside(const solve_report *r, const solve_candidate *c, page *p) {
    const double binary32 = solve_in_binary32(r, c, false);
    if (r->target == SOLVE_FOR_DISTANCE)
        return;
    if (c->spec.model != DP_MODEL_EXACT) {
        if (!c->solved)
            page_note(p, "lattice", "%s at z = %s", measured(r, c->lattice.reached.value).text,
                      digits(r, c->lattice.reached.z).text);
        else if (c->lattice.possible)
            page_note(p, "lattice", "ideal arithmetic needs only %s %s", target_name(r),
                      bound(r, c->lattice.value, is_near(c)).text);
        else
            page_note(p, "lattice", "ideal arithmetic has no such %s either", target_name(r));
    }
    if (c->spec.model == DP_MODEL_FLOAT || isinf(c->reached.value))
        return;
    if (isinf(binary32))
        page_note(p, "guaranteed", "nothing there: 'depthprec budget' says why");
    else if (binary32 > r->limit * (1.0 + 1e-6))
        page_note(p, "guaranteed", "only %s, short of %s: 'depthprec budget' says why", measured(r, binary32).text,
                  against_wanted(r, binary32).limit.text);
    else if (!isnan(binary32))
        page_note(p, "guaranteed", "%s there", measured(r, binary32).text);
}

/* The planes that nobody gave. */
static void say_assumed(const solve_report *r, page *p) {
    const bool no_near =
        !option_given(r->o->line, "near") && r->o->camera.preset_count == 0 && r->target != SOLVE_FOR_NEAR;
    const bool no_far =
        !option_given(r->o->line, "far") && r->o->camera.preset_count == 0 && r->target != SOLVE_FOR_FAR;
    const number_text near = whole(r, r->items[0].spec.znear), far = whole(r, r->items[0].spec.zfar);
    if (no_near && no_far)
        page_note(p, "assumed", "near %s, far %s: not given", near.text, far.text);
    else if (no_near || no_far)
        page_note(p, "assumed", "%s %s: not given", no_near ? "near" : "far", (no_near ? near : far).text);
}

void solve_report_answer(page *p, void *item) {
    const solve_report *r = item;
    const solve_candidate *c = &r->items[0];
    char wanted[NUMBER_SIZE + 16] = "";
    output sentence = {.fd = -1}; /* never flushed: what is written stays in its buffer */
    say_sentence(r, c, &sentence);
    page_text(p, "%.*s", (int)sentence.used - 1, sentence.buffer);
    solve_say_beyond(p, r);
    say_assumed(r, p);
    if (c->solved && c->possible)
        say_plane(r, c, p);
    if (!isnan(r->limit))
        snprintf(wanted, sizeof wanted, ", wanted %s", against_wanted(r, c->reached.value).limit.text);
    page_note(p, solve_measure_name(r), "%s at z = %s%s", measured(r, c->reached.value).text,
              (r->target == SOLVE_FOR_DISTANCE ? bound(r, c->reached.z, false) : digits(r, c->reached.z)).text, wanted);
    if (is_slanted(r))
        page_note(p, "facing", "%s there", measured(r, solve_in_binary32(r, c, false)).text);
    say_model(r, c, p);
    if (dp_mapping_get(c->spec.mapping)->curve != DP_CURVE_PERSPECTIVE)
        page_note(p, "cost", "%s", c->price.effort);
    say_beside(r, c, p);
    slant_say(p, page_line, &r->o->camera, &(dp_setup){.spec = c->spec});
    if (c->possible)
        setup_say_code(p, &c->spec);
}
