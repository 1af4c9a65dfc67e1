/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bias/cmd_bias/judged.h"

#include <ctype.h>
#include <math.h>

#include "cli/errors.h"
#include "core/append.h"
#include "core/elementary.h"
#include "report/number.h"

enum { DIGITS = 9, DIGITS_PUSHED = 4 };

/* The question in words, and its answer. */
static bias_judged told_of(bool slanted, double slope, bias_verdict v) {
    bias_judged j = {.what = slope > 0.0 ? "slope"
                             : slanted   ? "any slant"
                                         : "facing",
                     .asked = slope > 0.0 ? "at the slope"
                              : slanted   ? "at any slant"
                                          : "facing the camera",
                     .answer = bias_answer_name(v.answer),
                     .v = v,
                     .steepest = (double)NAN};
    return j;
}

bias_judged bias_judged_of(const dp_setup *setup, const bias_state *given, const bias_goal *goal, double lo,
                           double hi) {
    const bool lost = bias_is_missed(setup);
    const bias_state none = {given->api, 0.0, 0.0, 0.0}, *state = lost ? &none : given;
    bias_judged j = told_of(setup->spec.triangles.width > 0, goal->slope, bias_judge(setup, state, goal, lo, hi));
    if (lost)
        j.v.units = j.v.factor = (double)NAN;
    if (!isnan(j.v.units))
        append(j.call, sizeof j.call, "%s", bias_call(state->api, j.v.units, j.v.factor).text);
    return j;
}

void bias_judged_by(bias_judged *j, double z, double code, double moved) {
    j->v.answer = BIAS_NOT_ENOUGH;
    j->answer = bias_answer_name(BIAS_NOT_ENOUGH);
    j->v.z = z;
    j->v.code = code;
    j->v.moved = moved;
}

/* The least is rounded so that it stays enough. */
bias_judged bias_judged_remedy(const dp_setup *setup, const remedy *row, double amount, const bias_goal *goal,
                               double lo, double hi) {
    bias_judged j = told_of(false, goal->slope, remedy_judge(setup, row, amount, goal, lo, hi));
    if (!isnan(j.v.units))
        append(j.call, sizeof j.call, "--remedy %s:%s", row->name,
               (row->grows ? number_up : number_down)(j.v.units, DIGITS).text);
    if (goal->slope == 0.0)
        j.steepest = remedy_steepest(setup, row, amount, goal->gap, lo, hi);
    return j;
}

bias_pushed bias_pushed_remedy(const dp_setup *setup, const remedy *row, double amount, const bias_judged *least,
                               double lo, double hi) {
    const bias_push most = remedy_push(setup, row, amount, lo, hi);
    bias_pushed p = {.shift = most.shift, .z = most.z, .least = (double)NAN, .degrees = (double)NAN};
    if (!isnan(least->v.units))
        p.least = -remedy_at(setup, row, least->v.units, most.z).shift + 0.0; /* no -0 */
    return p;
}

bias_pushed bias_pushed_of(const dp_setup *setup, const bias_state *state, const bias_judged *least, double lo,
                           double hi) {
    const dp_triangles *t = &setup->spec.triangles;
    const bias_push most = bias_is_missed(setup) ? (bias_push){0.0, lo} : bias_push_over(setup, state, lo, hi);
    const bias_state enough = {state->api, least->v.units, 0.0, 0.0};
    bias_pushed p = {.shift = most.shift, .z = most.z, .least = (double)NAN, .degrees = (double)NAN};
    if (!isnan(enough.units))
        p.least = -bias_at(setup, &enough, 0.0, most.z).shift + 0.0; /* no -0 */
    if (t->width > 0) {
        const double pixel = 2.0 * dp_half_tangent(t->fov_y) / t->height * most.z;
        p.degrees = dp_atan(fabs(most.shift) / pixel) / DP_DEGREE;
    }
    return p;
}

int bias_check_remedy(const asked_line *line, const remedy *row, const setups *all) {
    for (size_t i = 0; row != NULL && i < all->count; i++)
        if (!remedy_suits(row, &all->items[i]))
            return option_error("remedy", "%s has no effect with %s%s: name another means, or mapping", row->name,
                                dp_mapping_get(all->items[i].spec.mapping)->name,
                                all->items[i].spec.ortho ? ", orthographic" : "");
    if (row != NULL && row->parallel && option_given(line, "slope"))
        return option_error("slope", "says nothing of --remedy %s: see 'slanted' of table --viewport", row->name);
    return EXIT_FINE;
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

/* clang-format off */
const column bias_judged_columns[] = {
    {FIELD(bias_judged, answer, "answer", "")},
    {FIELD(bias_judged, v.lo, "lo", "scene"), .digits = DIGITS, .given = true, .upward = true},
    {FIELD(bias_judged, v.hi, "hi", "scene"), .digits = DIGITS, .given = true, .downward = true},
    {FIELD(bias_judged, v.from, "from", "scene"), .digits = DIGITS, .given = true, .upward = true},
    {FIELD(bias_judged, v.to, "to", "scene"), .digits = DIGITS, .given = true, .downward = true},
    {FIELD(bias_judged, v.units, "units", "")},
    {FIELD(bias_judged, v.factor, "factor", "")},
    {FIELD(bias_judged, call, "call", "")},
    {FIELD(bias_judged, v.z, "z", "scene"), .digits = DIGITS},
    {FIELD(bias_judged, v.code, "code", "")},
    {FIELD(bias_judged, v.moved, "code_moved", "")},
    {FIELD(bias_judged, v.short_of_gap, "short_of_gap", "")},
    {FIELD(bias_judged, v.clipped, "clipped", ""), .when = BIAS_OF_REMEDY},
    {FIELD(bias_judged, steepest, "steepest", "scene"), .digits = DIGITS_PUSHED, .downward = true,
     .when = BIAS_OF_REMEDY},
    {FIELD(bias_judged, v.next, "enough_next", "")},
    {FIELD(bias_judged, v.turned, "enough_turned", "")},
    {FIELD(bias_judged, v.clamped, "enough_unclamped", "")},
    {.kind = COLUMN_END}};

const column bias_pushed_columns[] = {
    {FIELD(bias_pushed, shift, "shift", "scene"), .digits = DIGITS_PUSHED, .upward = true},
    {FIELD(bias_pushed, z, "z", "scene"), .digits = DIGITS, .given = true},
    {FIELD(bias_pushed, least, "least", "scene"), .digits = DIGITS_PUSHED},
    {FIELD(bias_pushed, degrees, "degrees", ""), .digits = DIGITS_PUSHED},
    {.kind = COLUMN_END}};
/* clang-format on */

/* ---- Words ------------------------------------------------------------------------------------------------------- */

enum {
    IS_ENOUGH = 1,
    HAS_WITNESS = 2,
    SHORT = 4,
    PARTLY = 8,
    NARROWER = 16,
    NEXT = 32,
    TURNED = 64,
    CLAMPED = 128,
    CLIPPED = 256,
    STEEP = 512
};

static const column said_columns[] = {
    {GROUP(NULL, bias_judged_columns)}, WORD(bias_judged, what), {.kind = COLUMN_END}};

static const sentence judged_words[] = {
    NOTE("{what}", "enough from {from} to {to}", IS_ENOUGH),
    ELSE("not enough: at z = {z} the near plane clips the layer", HAS_WITNESS | CLIPPED),
    ELSE("not enough: at z = {z} it brings the layer nearer by less than the separation", HAS_WITNESS | SHORT),
    ELSE("not enough: at z = {z} the layer is stored as {code_moved}, the one below as {code}", HAS_WITNESS),
    ELSE("not proven from {lo} to {hi}: neither a proof nor a depth where it fails", 0),
    ELSE("no bias suffices", 0),
    NOTE("", "enough only from {from} to {to}", PARTLY),
    NOTE("", "it has the wrong sign: with the other one it is enough", TURNED),
    NOTE("", "enough where drivers take the exponent n + 1, but not where they take n", NEXT),
    NOTE("", "the clamp holds it: without one it is enough", CLAMPED),
    NOTE("", "the least that is enough: {call}", 0),
    NOTE("", "next to the planes none is certain", NARROWER),
    NOTE("", "and up to --slope {steepest}", STEEP),
    SENTENCE_END};

/* Ends that nobody would tell from those that were asked for are not told. */
static bool is_narrower(const bias_verdict *v, double lo, double hi) {
    static const double told = 1e-6;
    return v->lo - lo > told * fabs(lo) || hi - v->hi > told * fabs(hi);
}

void bias_say_judged(page *p, bias_judged *j, double lo, double hi) {
    const bias_verdict *v = &j->v;
    const bool open = v->answer != BIAS_ENOUGH;
    page_say(p, judged_words, said_columns, j,
             (!open ? IS_ENOUGH : 0) | (v->answer == BIAS_NOT_ENOUGH ? HAS_WITNESS : 0) |
                 (v->short_of_gap ? SHORT : 0) | (open && !isnan(v->from) ? PARTLY : 0) |
                 (is_narrower(v, lo, hi) ? NARROWER : 0) | (v->next ? NEXT : 0) | (v->turned ? TURNED : 0) |
                 (v->clamped ? CLAMPED : 0) | (v->clipped ? CLIPPED : 0) | (isfinite(j->steepest) ? STEEP : 0));
}

static const sentence pushed_words[] = {
    NOTE("pushes", "up to {shift} nearer, at z = {z}: the layer shows through what is less in front of it", 0),
    NOTE("", "as much as a surface at {degrees} degrees changes from one pixel to the next", 0),
    NOTE("", "the least that is enough moves it by {least} there", 0), SENTENCE_END};

void bias_say_pushed(page *p, bias_pushed *pushed) {
    if (pushed->shift > 0.0)
        page_say(p, pushed_words, bias_pushed_columns, pushed, 0);
}

void bias_say_answer(page *p, const bias_judged *facing, const bias_judged *sloped) {
    const bool good = facing->v.answer == BIAS_ENOUGH && (sloped->what == NULL || sloped->v.answer == BIAS_ENOUGH);
    char text[SENTENCE_SIZE] = "";
    append(text, sizeof text, "%s %s", facing->answer, facing->asked);
    if (sloped->what != NULL && sloped->v.answer == facing->v.answer)
        append(text, sizeof text, " and %s", sloped->asked);
    else if (sloped->what != NULL)
        append(text, sizeof text, ", %s %s", sloped->answer, sloped->asked);
    text[0] = (char)toupper((unsigned char)text[0]);
    page_text(p, "%s%s%s", good ? p->good : p->bad, text, p->plain);
}
