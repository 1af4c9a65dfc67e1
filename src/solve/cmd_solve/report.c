/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The findings of solve in sentences. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/cmd/setups.h"
#include "camera/cmd/slant.h"
#include "camera/paste.h"
#include "core/append.h"
#include "core/elementary.h"
#include "report/sentence.h"
#include "solve/cmd_solve/report.h"
#include "solve/cmd_solve/request.h"

const char *solve_measure_name(const solve_report *r) {
    return quantity_get(r->kind)->name;
}

double solve_in_binary32(const solve_report *r, const solve_candidate *c, bool slanted) {
    dp_spec spec = c->spec;
    dp_setup setup;
    dp_budget budget;
    if (!slanted)
        spec.triangles.width = 0;
    return quantity_get(r->kind)->of_surfaces && quantity_setup(&spec, &setup) == DP_OK &&
                   dp_budget_at(&setup, c->reached.z, NULL, &budget) == DP_OK
               ? budget.separation
               : (double)NAN;
}

enum { DIGITS_MOST = 17, UNITS = 8, PHRASES = 10 };

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

/* ---- What is told ------------------------------------------------------------------------------------------------ */

/* The answer in words, and in numbers as they keep what they promise; null and "" where they are not told. */
typedef struct told {
    const solve_report *report;
    const solve_candidate *answer;
    const char *target, *measure, *mapping, *ortho, *at_slant, *property, *manner, *model, *rounding, *effort, *paste;
    const char *paste_slanted, *assumed;
    number_text goal, wanted, best, from, to, facing, lattice_best, guaranteed, short_of, slanted;
    double plane, throughout;
    const char *given, *goals, *fight, *ideal, *slants; /* phrases */
    char text[PHRASES][SENTENCE_SIZE];                  /* of phrases */
} told;

static const column asked_columns[] = {
    LENGTH(solve_report, limit, 0),
    LENGTH(solve_report, lo, 0),
    LENGTH(solve_report, hi, 0),
    {FIELD(solve_report, fight.first, "first", "scene"), .digits = SOLVE_DIGITS, .downward = true},
    {FIELD(solve_report, fight.searched, "searched", "scene"), .digits = SOLVE_DIGITS, .downward = true},
    {.kind = COLUMN_END}};
static const column answer_columns[] = {
    {FIELD(solve_candidate, spec.format.name, "format", "")},
    {FIELD(solve_candidate, spec.znear, "near", "scene"), .given = true},
    {FIELD(solve_candidate, spec.zfar, "far", "scene"), .given = true},
    {FIELD(solve_candidate, reached.z, "z", "scene"), .digits = SOLVE_DIGITS, .given = true},
    {FIELD(solve_candidate, reached.z, "z_down", "scene"), .digits = SOLVE_DIGITS, .downward = true},
    {FIELD(solve_candidate, distance.value, "up_to", "scene"), .digits = SOLVE_DIGITS, .downward = true},
    {FIELD(solve_candidate, lattice.reached.z, "lattice_z", "scene"), .digits = SOLVE_DIGITS, .given = true},
    {FIELD(solve_candidate, lattice.value, "ideal_least", "scene"), .digits = SOLVE_DIGITS, .upward = true},
    {FIELD(solve_candidate, lattice.value, "ideal_most", "scene"), .digits = SOLVE_DIGITS, .downward = true},
    {.kind = COLUMN_END}};
/* clang-format off */
static const column told_columns[] = {
    {PART(told, report, NULL, asked_columns), .pointed = true},
    {PART(told, answer, NULL, answer_columns), .pointed = true},
    WORD(told, target), WORD(told, measure), WORD(told, mapping), WORD(told, ortho), WORD(told, at_slant),
    WORD(told, property), WORD(told, manner), WORD(told, model), WORD(told, rounding), WORD(told, effort),
    WORD(told, paste),
    LENGTH(told, plane, 0),
    LENGTH(told, throughout, 0), NUMBER(told, goal), NUMBER(told, wanted), NUMBER(told, best), NUMBER(told, from),
    NUMBER(told, to), NUMBER(told, facing), NUMBER(told, lattice_best), NUMBER(told, guaranteed),
    NUMBER(told, short_of), WORD(told, given), WORD(told, goals), WORD(told, fight), WORD(told, ideal),
    WORD(told, slants), NUMBER(told, slanted), WORD(told, assumed), WORD(told, paste_slanted),
    {.kind = COLUMN_END}};
/* clang-format on */

/* Conditions of sentences: of the question, of the answer, and of what stands behind it. */
enum { OF_DISTANCE = 1, OF_NEAR = 2, OF_FAR = 4, OF_ERROR = 8, OVER_RANGE = 16 };
enum { POSSIBLE = 32, SOLVED = 64, AS_IT_IS = 128, IS_NEAR = 256, CERTAIN = 512, UNCERTAIN = 1024, ANY_PASSES = 2048 };
enum { UNBOUNDED = 1 << 12, CHEAPEST = 1 << 13, ALONE = 1 << 14, EXACT = 1 << 15, NOT_IDEAL = 1 << 16 };
enum { NO_NEAR = 1 << 17, NO_FAR = 1 << 18, BESIDE = 1 << 19, NOT_ENOUGH = 1 << 20, NOTHING_SAFE = 1 << 21 };
enum { FACING = 1 << 22, ASSUMED = 1 << 23, HOLDS_SLANTED = 1 << 24 };

static const sentence given_words[] = {PROSE("{format} {mapping}{ortho}, far {far},", OF_NEAR),
                                       ELSE("{format} {mapping}{ortho}, near {near},", OF_FAR),
                                       ELSE("{format} {mapping}{ortho}, near {near}, far {far}", 0), SENTENCE_END};

/* Behind "keeps" or "to keep": {goals} says which. */
static const sentence goal_words[] = {
    PROSE("keep{goals} the error within {goal} from z = {lo} to {hi}", OF_ERROR | OVER_RANGE),
    ELSE("keep{goals} the error within {goal} at z = {lo}", OF_ERROR),
    ELSE("resolve{goals} {goal}{at_slant} from z = {lo} to {hi}", OVER_RANGE),
    ELSE("resolve{goals} {goal}{at_slant} at z = {lo}", 0), SENTENCE_END};

static const sentence fight_words[] = {PROSE("; first found to z-fight at z = {first}", 0),
                                       ELSE("; no z-fighting found up to z = {searched}", 0),
                                       ELSE("; nothing up to z = {hi} lies that far behind it", ALONE), SENTENCE_END};

static const sentence ideal_words[] = {PROSE("", EXACT), ELSE("; nor in the lattice", NOT_IDEAL),
                                       ELSE("; in the lattice up to {ideal_most}", 0), SENTENCE_END};

/* Behind what holds facing the camera: what does at any slant. */
static const sentence slants_words[] = {
    PROSE("; at any slant up to z = {slanted}", POSSIBLE | FACING | ASSUMED | HOLDS_SLANTED | OF_DISTANCE),
    ELSE("; at any slant nowhere", POSSIBLE | FACING | ASSUMED | OF_DISTANCE),
    ELSE("; at any slant {target} {slanted} does", POSSIBLE | FACING | ASSUMED | HOLDS_SLANTED | SOLVED),
    ELSE("; at any slant no {target} does", POSSIBLE | FACING | ASSUMED | SOLVED),
    ELSE("; at any slant {slanted}", POSSIBLE | FACING | ASSUMED),
    ELSE("; at a slant nothing is guaranteed", POSSIBLE | FACING),
    SENTENCE_END};

static const sentence answer_words[] = {
    PROSE("{given}: {property} {limit}{at_slant} {manner} from z = {lo} up to z = {throughout}{slants}{fight}{ideal}.",
          OF_DISTANCE | POSSIBLE),
    ELSE("{given}: {property} {limit}{at_slant} {manner} from z = {lo} up to z = {up_to}{slants}{fight}{ideal}.",
         OF_DISTANCE | POSSIBLE),
    ELSE("Impossible: {given}: {property} {limit}{at_slant} {manner} even at z = {lo}{fight}{ideal}.", OF_DISTANCE),
    ELSE("{given} {goals}, the cheapest that does{slants}.", POSSIBLE | AS_IT_IS | CHEAPEST),
    ELSE("{given} {goals}{slants}.", POSSIBLE | AS_IT_IS),
    ELSE("Near {from} suffices for {given} to {goals}{slants}.", POSSIBLE | UNCERTAIN | IS_NEAR),
    ELSE("Far {to} suffices for {given} to {goals}{slants}.", POSSIBLE | UNCERTAIN),
    ELSE("Any {target} from {from} to {to} suffices for {given} to {goals}{slants}.", POSSIBLE | ANY_PASSES),
    ELSE("Near must be at least {from} for {given} to {goals}{slants}.", POSSIBLE | IS_NEAR),
    ELSE("Far may be at most {to} for {given} to {goals}{slants}.", POSSIBLE),
    ELSE("Impossible: {given} has no {target} that {goals}: nothing farther is guaranteed to be resolved.", UNBOUNDED),
    ELSE("Impossible: with this near and far no {target} {goals}; {given} comes nearest, with {best}.", AS_IT_IS),
    ELSE("Impossible: no {target} of {given} {goals}; {target} {plane:6} comes near, with {best}.", CERTAIN),
    ELSE("No {target} of {given} was found that {goals}; {target} {plane:6} comes near, with {best}.", 0),
    SENTENCE_END};

static const sentence note_words[] = {
    NOTE("assumed", "near {near}, far {far}: not given", NO_NEAR | NO_FAR),
    ELSE("near {near}: not given", NO_NEAR),
    ELSE("far {far}: not given", NO_FAR),
    NOTE("{target}", "{plane} exactly", SOLVED | POSSIBLE | CERTAIN),
    ELSE("{plane} exactly; a smaller one may suffice", SOLVED | POSSIBLE | IS_NEAR),
    ELSE("{plane} exactly; a larger one may suffice", SOLVED | POSSIBLE),
    NOTE("to write", "{paste}", SOLVED | POSSIBLE | IS_NEAR),
    NOTE("", "{paste_slanted} at any slant", 0),
    NOTE("passes", "every {target} from {from} to {to}", SOLVED | POSSIBLE),
    NOTE("{measure}", "{best} at z = {z_down}, wanted {wanted}", OF_DISTANCE),
    ELSE("{best} at z = {z}, wanted {wanted}", 0),
    ELSE("{best} at z = {z}", 0),
    NOTE("facing", "{facing} there", 0),
    ELSE("the camera, " SLANT_AS_WALL, FACING),
    NOTE("any slant", "of a viewport of {assumed}", 0),
    NOTE("model", "{model}", 0),
    NOTE("rounding", "{rounding}", 0),
    NOTE("cost", "{effort}", 0),
    NOTE("lattice", "{lattice_best} at z = {lattice_z}", BESIDE | AS_IT_IS),
    ELSE("ideal arithmetic has no such {target} either", BESIDE | NOT_IDEAL),
    ELSE("ideal arithmetic needs only {target} {ideal_least}", BESIDE | IS_NEAR),
    ELSE("ideal arithmetic needs only {target} {ideal_most}", BESIDE),
    NOTE("guaranteed", "nothing there: 'depthprec budget' says why", NOTHING_SAFE),
    ELSE("only {guaranteed}, short of {short_of}: 'depthprec budget' says why", NOT_ENOUGH),
    ELSE("{guaranteed} there", 0),
    SENTENCE_END};

static bool is_slanted(const solve_report *r) {
    return r->o->camera.triangles.width > 0;
}

/* Guaranteed separations without a viewport: what there is of them at any slant stands beside it. */
static bool is_facing(const solve_report *r, const solve_candidate *c) {
    const bool computed = dp_mapping_get(c->spec.mapping)->curve == DP_CURVE_PERSPECTIVE;
    return quantity_get(r->kind)->of_surfaces && !is_slanted(r) && (c->spec.model == DP_MODEL_FLOAT || !computed);
}

/* The measured value in the unit of the one wanted, and that beside it. */
static number_two against_wanted(const solve_report *r, double value) {
    const solve_request *o = r->o;
    const unit_row *unit = option_unit(o->line, solve_measure_name(r));
    const char *name = unit != NULL ? unit->name : NULL;
    const number_two out = number_compared(unit_convert(value, o->camera.lengths.unit, unit),
                                           unit_convert(r->limit, o->camera.lengths.unit, unit), SOLVE_DIGITS);
    return (number_two){number_in(out.value, name), number_in(out.limit, name)};
}

static number_text measured(const solve_report *r, double value) {
    return against_wanted(r, value).value;
}

/* An end of the values that pass. */
static number_text passing(const solve_report *r, const solve_candidate *c, double value, double until) {
    if (value == r->lo || value == r->hi) /* the run ends at a depth that was asked about */
        return camera_length(&r->o->camera, value, 0);
    return number_in(solve_safe_digits(r, c, value, until), camera_unit(&r->o->camera));
}

static bool is_cheapest(const solve_report *r) {
    for (size_t i = 1; i < r->count; i++)
        if (r->items[i].possible && !r->items[i].solved && cost_compare(&r->items[i].price, &r->items[0].price) < 0)
            return false;
    return r->count > 1 && r->target != SOLVE_FOR_SEPARATION;
}

static bool nobody_gave(const solve_report *r, const char *option, solve_target solved) {
    return !option_given(r->o->line, option) && !camera_says_planes(&r->o->camera.said) && r->target != solved;
}

static unsigned conditions(const solve_report *r, const solve_candidate *c, double binary32) {
    const plane_answer *p = &c->plane;
    const bool near = c->unknown == SOLVE_NEAR, distance = r->target == SOLVE_FOR_DISTANCE;
    return (distance ? OF_DISTANCE : 0) | (r->target == SOLVE_FOR_NEAR ? OF_NEAR : 0) |
           (r->target == SOLVE_FOR_FAR ? OF_FAR : 0) | (r->kind == QUANTITY_ERROR ? OF_ERROR : 0) |
           (r->lo < r->hi ? OVER_RANGE : 0) | (c->possible ? POSSIBLE : 0) | (c->solved ? SOLVED : AS_IT_IS) |
           (near ? IS_NEAR : 0) | (p->certain ? CERTAIN : UNCERTAIN) |
           (solve_plane_of(c) == (near ? p->least : p->most) ? ANY_PASSES : 0) |
           (isinf(c->reached.value) ? UNBOUNDED : 0) | (is_cheapest(r) ? CHEAPEST : 0) |
           (c->possible && !c->distance.throughout && r->kind == QUANTITY_SEPARATION && !is_slanted(r) &&
                    c->distance.value + r->limit > r->hi
                ? ALONE
                : 0) |
           (c->spec.model == DP_MODEL_EXACT ? EXACT : 0) | (c->lattice.possible ? 0 : NOT_IDEAL) |
           (nobody_gave(r, "near", SOLVE_FOR_NEAR) ? NO_NEAR : 0) |
           (nobody_gave(r, "far", SOLVE_FOR_FAR) ? NO_FAR : 0) |
           (!distance && c->spec.model != DP_MODEL_EXACT ? BESIDE : 0) | (isinf(binary32) ? NOTHING_SAFE : 0) |
           (binary32 > r->limit * (1.0 + 1e-6) ? NOT_ENOUGH : 0) | (is_facing(r, c) ? FACING : 0) |
           (r->slanted->spec.triangles.width > 0 ? ASSUMED : 0) | (r->slanted->possible ? HOLDS_SLANTED : 0);
}

/* The model, and why it is not the fullest that there is. */
static const char *model_words(const solve_report *r, const solve_candidate *c, char out[SENTENCE_SIZE]) {
    static const char *const words[DP_MODEL_COUNT] = {
        [DP_MODEL_EXACT] = "exact: real arithmetic, the lattice alone",
        [DP_MODEL_STAGED] = "staged: NDC and window depth each rounded to binary32",
        [DP_MODEL_FLOAT] = "float: guaranteed in binary32 arithmetic, ",
    };
    const bool chosen = r->o->camera.model_auto || !option_given(r->o->line, "model");
    const bool computed = c->spec.model == DP_MODEL_FLOAT;
    const bool shader = computed && dp_mapping_get(c->spec.mapping)->curve == DP_CURVE_LOG;
    const char *more = computed                                     ? dp_arith_get(c->spec.arith)->name
                       : !chosen || c->spec.model == DP_MODEL_EXACT ? ""
                       : quantity_has_model(r->kind, DP_MODEL_FLOAT, c->spec.mapping)
                           ? "; model float does not cover this mapping"
                           : "; model float has no cells, so no error";
    snprintf(out, SENTENCE_SIZE, "%s%s%s%s", words[c->spec.model], more,
             shader          ? ", for every log2 that a shader may use"
             : is_slanted(r) ? ", at "
                             : "",
             !shader && is_slanted(r) ? surfaces_words(&r->o->camera.triangles).text : "");
    return out;
}

static void tell_numbers(const solve_report *r, const solve_candidate *c, double binary32, told *t) {
    const double plane = solve_plane_of(c), until = c->plane.until;
    t->plane = plane;
    t->throughout = c->distance.throughout ? c->distance.value : (double)NAN;
    t->best = measured(r, c->reached.value);
    t->lattice_best = measured(r, c->lattice.reached.value);
    t->goal = isnan(r->limit) ? t->best : camera_length(&r->o->camera, r->limit, 0);
    if (!isnan(r->limit))
        t->wanted = against_wanted(r, c->reached.value).limit;
    if (is_slanted(r))
        t->facing = measured(r, solve_in_binary32(r, c, false));
    if (c->solved && c->possible) {
        t->from = plane < until ? passing(r, c, plane, until) : passing(r, c, until, plane);
        t->to = plane < until ? passing(r, c, until, plane) : passing(r, c, plane, until);
    }
    if (!isnan(binary32)) {
        t->guaranteed = measured(r, binary32);
        t->short_of = against_wanted(r, binary32).limit;
    }
}

/* The same question answered of surfaces at any slant: a plane, a depth, or the separation that is reached. */
static void tell_slanted(const solve_report *r, told *t) {
    const solve_candidate *s = r->slanted;
    const double up_to = s->distance.value;
    for (size_t i = 0; i < r->count && t->assumed == NULL; i++)
        if (r->slanted[i].spec.triangles.width > 0)
            t->assumed = slant_assumed(&r->slanted[i].spec.triangles, t->text[7]);
    if (r->target == SOLVE_FOR_DISTANCE && s->possible)
        t->slanted = s->distance.throughout ? camera_length(&r->o->camera, up_to, 0)
                                            : number_in(number_down(up_to, SOLVE_DIGITS), camera_unit(&r->o->camera));
    else if (s->solved && s->possible)
        t->slanted = passing(r, s, solve_plane_of(s), s->plane.until);
    else if (!isinf(s->reached.value))
        t->slanted = measured(r, s->reached.value);
    else
        t->slanted = (number_text){"nothing"};
}

/* The engine's code for the number that the first sentence says. */
static const char *paste_of(const solve_report *r, const solve_candidate *c, char out[SENTENCE_SIZE]) {
    const paste of = {r->o->camera.preset_count == 1 ? r->o->camera.presets[0] : NULL, r->o->camera.lengths.unit};
    const number_text least = solve_safe_digits(r, c, solve_plane_of(c), c->plane.until);
    return c->solved && c->possible && c->unknown == SOLVE_NEAR ? paste_near(&of, least.text, out, SENTENCE_SIZE)
                                                                : NULL;
}

void solve_report_answer(page *p, void *item) {
    static const char *const manners[DP_MODEL_COUNT][2] = {
        [DP_MODEL_EXACT] = {"does not hold in the lattice", "holds in the lattice"},
        [DP_MODEL_STAGED] = {"does not hold in model staged", "holds in model staged"},
        [DP_MODEL_FLOAT] = {"is not guaranteed", "is guaranteed"},
    };
    const solve_report *r = item;
    const solve_candidate *c = &r->items[0];
    const dp_mapping_row *mapping = dp_mapping_get(c->spec.mapping);
    const bool fuller = r->target == SOLVE_FOR_DISTANCE || c->spec.model == DP_MODEL_FLOAT || isinf(c->reached.value);
    const double binary32 = fuller ? (double)NAN : solve_in_binary32(r, c, false);
    const unsigned when = conditions(r, c, binary32);
    told t = {.report = r,
              .answer = c,
              .target = option_word("for", r->target),
              .measure = solve_measure_name(r),
              .mapping = mapping->name,
              .ortho = c->spec.ortho ? " orthographic" : "",
              .at_slant = !is_facing(r, c)                                 ? ""
                          : c->possible || r->target == SOLVE_FOR_DISTANCE ? " " SLANT_FACING
                                                                           : " even " SLANT_FACING,
              .property = r->kind == QUANTITY_ERROR ? "an error within" : "a separation of",
              .manner = manners[c->spec.model][c->possible],
              .rounding = c->spec.rounding != DP_ROUND_NEAREST ? dp_rounding_name(c->spec.rounding) : NULL,
              .effort = mapping->curve != DP_CURVE_PERSPECTIVE ? c->price.effort : NULL,
              .goals = c->solved && c->possible ? "" : "s"};
    if (is_slanted(r)) {
        snprintf(t.text[0], SENTENCE_SIZE, " at %s", surfaces_words(&r->o->camera.triangles).text);
        t.at_slant = t.text[0];
    }
    camera_page(p, &r->o->camera);
    tell_numbers(r, c, binary32, &t);
    tell_slanted(r, &t);
    t.model = model_words(r, c, t.text[1]);
    t.paste = paste_of(r, c, t.text[PHRASES - 1]);
    t.paste_slanted = r->slanted->spec.triangles.width > 0 ? paste_of(r, r->slanted, t.text[PHRASES - 2]) : NULL;
    t.given = sentence_first(p, given_words, told_columns, &t, when, t.text[2]);
    t.goals = sentence_first(p, goal_words, told_columns, &t, when, t.text[3]);
    t.fight = sentence_first(p, fight_words, told_columns, &t, when, t.text[4]);
    t.ideal = sentence_first(p, ideal_words, told_columns, &t, when, t.text[5]);
    t.slants = sentence_first(p, slants_words, told_columns, &t, when, t.text[6]);
    page_say(p, answer_words, told_columns, &t, when);
    solve_say_beyond(p, r);
    page_say(p, note_words, told_columns, &t, when);
    const dp_setup answered = {.spec = c->spec};
    const setup_fields fields = setup_fields_asked(&answered, &r->o->camera);
    slant_say(p, page_line, &r->o->camera, &answered);
    setup_say_planes(p, &fields);
    if (c->possible)
        setup_say_code(p, &c->spec);
}
