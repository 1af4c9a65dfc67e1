/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bias in words: the goal and the state above rows, what is enough and which r is open below them. */
#include <math.h>
#include <stdio.h>

#include "bias/cmd_bias/report.h"
#include "core/append.h"

enum { DIGITS = 6 };

double bias_gap_from(const biasing *b) {
    return fmax(b->range_lo, b->each.here->znear + b->o->bias.separation);
}

/* "gl, units -2, factor 1": the bias of one API. */
static void say_state(page *p, const biasing *b) {
    const bias_state *s = &b->state;
    char text[256] = "";
    append(text, sizeof text, "%s", s->api->name);
    if (b->when & EFFECT)
        append(text, sizeof text, ", units %s", number_full(s->units).text);
    if ((b->when & EFFECT) && isinf(b->o->bias.units) && s->api->whole)
        append(text, sizeof text, " (%s in 32 bits, as a cast that saturates makes it)",
               number_full(b->o->bias.units).text);
    if (s->factor != 0.0 && isfinite(s->factor))
        append(text, sizeof text, ", factor %s", number_full(s->factor).text);
    if ((b->when & EFFECT) && s->clamp != 0.0)
        append(text, sizeof text, ", clamp %s", number_full(s->clamp).text);
    if (b->o->bias.slope > 0.0)
        append(text, sizeof text, ", slope %s per pixel", camera_length(b->each.here, b->o->bias.slope, 0).text);
    page_text(p, "%s", text);
}

/* "ndc: NDC z - e, or clip z - e w, e = 1e-05": what is written in place of a bias. */
static void say_remedy(page *p, const biasing *b) {
    const remedy *r = b->o->remedy;
    if (r->amount[0] == '\0')
        page_text(p, "%s: %s", r->name, r->note);
    else
        page_text(p, "%s: %s, %.1s = %s", r->name, r->note, r->amount, number_full(b->o->amount).text);
}

/* "To be resolved from z = 0.1 to 1000:", the goal that several APIs are to reach. */
static void say_goal(page *p, const biasing *b) {
    const bias_request *o = b->o;
    char text[256] = "To be resolved";
    if (o->bias.separation > 0.0)
        snprintf(text, sizeof text, "To bring a layer %s nearer",
                 camera_length(&o->camera, o->bias.separation, 0).text);
    if (b->when & OF_RANGE)
        append(text, sizeof text, " from z = %s to %s",
               camera_length(&o->camera, fmin(bias_gap_from(b), b->range_hi), DIGITS_Z).text,
               camera_length(&o->camera, b->range_hi, DIGITS_Z).text);
    else if (b->each.at.count == 1)
        append(text, sizeof text, " at z = %s", camera_length(&o->camera, b->each.at.lo, DIGITS_Z).text);
    if (o->bias.slope > 0.0)
        append(text, sizeof text, ", slope %s per pixel", camera_length(&o->camera, o->bias.slope, 0).text);
    page_text(p, "%s:", text);
}

void bias_say_setup(page *p, void *item) {
    const biasing *b = item;
    if (b->when & EFFECT)
        bias_say_answer(p, &b->facing, &b->sloped);
    each_setup_title(p, item);
    slant_say(p, page_title, &b->o->camera, &b->each.slanted);
    (b->when & BIAS_OF_REMEDY ? say_remedy : b->when & ONE_API ? say_state : say_goal)(p, b);
}

const column bias_need_columns[] = {{FIELD(bias_need, what, "what", "")},
                                    {FIELD(bias_need, counted, "counted", "")},
                                    {FIELD(bias_need, lo, "lo", "scene"), .digits = DIGITS_Z, .given = true},
                                    {FIELD(bias_need, hi, "hi", "scene"), .digits = DIGITS_Z, .given = true},
                                    {FIELD(bias_need, units, "units", ""), .digits = DIGITS_Z, .outward = true},
                                    {FIELD(bias_need, z, "z", "scene"), .digits = DIGITS_Z, .given = true},
                                    {FIELD(bias_need, from, "from", "scene"), .digits = DIGITS_Z, .upward = true},
                                    {FIELD(bias_need, to, "to", "scene"), .digits = DIGITS_Z, .downward = true},
                                    {FIELD(bias_need, next, "next", ""), .digits = DIGITS_Z, .outward = true},
                                    {.kind = COLUMN_END}};

static const sentence need_words[] = {
    NOTE("{what}", "{units} {counted} at z = {lo}", AT_A_DEPTH),
    ELSE("no bias suffices at z = {lo}", AT_A_DEPTH),
    ELSE("{units} {counted} from {lo} to {hi} (needed at z = {z})", 0),
    ELSE("suffices up to z = {to}; from there to {hi} no bias does", FROM_LO),
    ELSE("suffices from z = {from} on; from {lo} to there no bias does", UP_TO_HI),
    ELSE("suffices from z = {from} to {to}; elsewhere from {lo} to {hi} no bias does", 0),
    ELSE("no bias suffices from {lo} to {hi}", 0),
    SENTENCE_END};

static const column wanted_columns[] = {{FIELD(biasing, call, "call", "")},
                                        {PART(biasing, wanted, "wanted", bias_need_columns), .pointed = true},
                                        {.kind = COLUMN_END}};

static const sentence wanted_words[] = {
    NOTE("to write", "{call}", 0),
    NOTE("", "where drivers take the exponent n + 1, {wanted.next} suffices; this suffices with either", INVERSE),
    SENTENCE_END};

static void say_range(page *p, biasing *b) {
    const unit_row *unit = option_unit(b->o->line, "separation");
    const double shift = unit_convert(fabs(b->shift_hi), b->each.here->lengths.unit, unit);
    page_say(p, need_words, bias_need_columns, &b->over, bias_need_place(&b->over));
    if (b->when & WITH_GAP)
        page_say(p, need_words, bias_need_columns, &b->gap_over, bias_need_place(&b->gap_over));
    page_say(p, wanted_words, wanted_columns, b, isnan(b->wanted->units) ? 0 : INVERSE);
    if ((b->when & WITH_GAP) && !isnan(shift))
        page_note(p, "", "the same units bring a layer nearer by %s at z = %s",
                  number_in(number_of(shift, DIGITS), unit != NULL ? unit->name : NULL).text,
                  camera_length(b->each.here, b->range_hi, DIGITS_Z).text);
}

/* The r of an API that was measured in that format on the GPU of a profile: a sentence, "" where none was. @return out
 */
static const char *measured(const bias_request *o, const bias_api *api, const dp_format *format,
                            char out[BIAS_CALL_SIZE]) {
    const profile_format *of = profile_biased(&o->camera.gpu, o->camera.platform, api, format);
    out[0] = '\0';
    if (of == NULL)
        return out;
    append(out, BIAS_CALL_SIZE, "on this GPU r is %s", number_full(of->least).text);
    if (format->kind == DP_FORMAT_UNORM) {
        append(out, BIAS_CALL_SIZE, " code%s", of->least == 1.0 ? "" : "s");
        return out;
    }
    if (of->least < of->most)
        append(out, BIAS_CALL_SIZE, " to %s", number_full(of->most).text);
    append(out, BIAS_CALL_SIZE, " times 2^(n-%d), for a depth in [2^n, 2^(n+1))", format->mantissa_bits);
    return out;
}

/* Which r was measured, or is left open. */
static void say_r(page *p, const biasing *b) {
    const bias_request *o = b->o;
    const dp_format *format = &b->each.setup->spec.format;
    const bias_unit unit = bias_unit_at(&b->api, format, 1.0);
    char text[BIAS_CALL_SIZE];
    const bool known = *measured(o, b->named, format, text) != '\0';
    if (o->camera.gpu.measured[0] != '\0' && known)
        page_line(p, "%s%s", text, b->cuts ? "; fractional units are truncated: 0.5 becomes 0" : "");
    else if (o->camera.gpu.measured[0] != '\0')
        page_line(p, "r was not measured on this GPU for %s", b->named->name);
    if (known)
        return;
    if (isinf(unit.most))
        page_line(p, "r is the implementation's choice: the value shown is assumed");
    else if (bias_is_open(&b->api, format))
        page_line(p, "drivers take the exponent of a depth in [2^n, 2^(n+1)) as n or n+1: r is up to %s times this",
                  number_up(unit.most / unit.least, DIGITS_SHORT).text);
    else if (unit.most > unit.least)
        page_line(p, "r is the implementation's choice: up to twice the value shown");
}

/* The APIs among several whose r drivers choose; those that were measured in the format are told, and left out. */
static const char *say_measured(page *p, const bias_request *o, const dp_format *format, char out[BIAS_CALL_SIZE]) {
    static const char *const names[] = {"vulkan", "gl"};
    char text[BIAS_CALL_SIZE] = "";
    out[0] = '\0';
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const bias_api *api = bias_api_find(names[i]);
        size_t k = 0;
        while (bias_asked_api(&o->bias, k) != NULL && bias_asked_api(&o->bias, k) != api)
            k++;
        if (bias_asked_api(&o->bias, k) == NULL)
            continue;
        if (format != NULL && measured(o, api, format, text)[0] != '\0')
            page_line(p, "%s: %s", names[i], text);
        else
            append(out, BIAS_CALL_SIZE, "%s%s", *out != '\0' ? " and " : "", names[i]);
    }
    return out;
}

static void say_choice(page *p, const biasing *b) {
    const dp_format *format = &b->each.setup->spec.format;
    char text[BIAS_CALL_SIZE];
    const char *const open = say_measured(p, b->o, format, text);
    if (*open != '\0' && format->kind == DP_FORMAT_UNORM)
        page_line(p, "%s: r is the implementation's choice, 2^-%d is assumed", open, format->bits);
    else if (*open != '\0')
        page_line(p,
                  "%s: the exponent of a depth is the driver's to read, r may be twice as much: these units are "
                  "enough with both, half of them with that",
                  open);
}

/* The limits of the bias there, --full: anywhere. */
static void say_limits(page *p, const biasing *b) {
    const bias_use use = {.setup = b->each.setup,
                          .state = &b->state,
                          .slanted = b->each.triangles != NULL,
                          .infinite = (b->when & EFFECT) && isinf(b->o->bias.units),
                          .lo = b->judged_lo,
                          .hi = b->judged_hi};
    const bool given = (b->when & EFFECT) && (b->when & OF_BIAS);
    for (size_t i = 0; bias_limit_get(i) != NULL; i++) {
        const bias_limit *row = bias_limit_get(i);
        const bool always = row == bias_limit_find("written"); /* also where none is given */
        if (row->applies != NULL ? (given || always) && row->applies(&use) : given && (b->when & VERBOSE))
            page_line(p, "%s", row->said);
    }
}

/* The slope factor of surfaces at any slant. */
static void say_factor(page *p, const biasing *b) {
    const double least = bias_factor_least(b->each.setup); /* 0 without triangles */
    const bool one = b->when & ONE_API;
    if ((b->when & INVERSE) && b->o->bias.slope == 0.0 && isinf(least) && (one || b->chosen))
        page_line(p, "at any slant no factor suffices; --slope says how steep surfaces are");
    else if (!one && b->chosen)
        page_line(p, "F, the slope factor, is %s", number_full(b->row.factor).text);
    else if (one && (b->when & INVERSE) && b->o->bias.slope == 0.0 &&
             b->state.factor * bias_sign(b->each.setup) < least)
        page_line(p, "at any slant no units suffice with a factor below %s; --slope says how steep surfaces are",
                  number_full(least).text);
}

static void say_verdict(page *p, biasing *b) {
    bias_say_judged(p, &b->facing, b->judged_lo, b->judged_hi);
    if (b->sloped.what != NULL)
        bias_say_judged(p, &b->sloped, b->judged_lo, b->judged_hi);
    if (b->when & DRAWN)
        bias_say_trial(p, &b->trial);
    bias_say_pushed(p, &b->pushed);
    if (b->when & OF_BIAS) {
        page_line(p, "a %s bias brings a layer nearer", bias_sign(b->each.setup) < 0 ? "negative" : "positive");
        return;
    }
    const remedy *r = b->o->remedy;
    page_note(p, "worth", "%s", r->worth);
    page_note(p, "costs", "%s", r->cost);
    page_note(p, "reversed", "%s", r->turned);
}

void bias_say_notes(page *p, void *item) {
    biasing *b = item;
    const bool one = b->when & ONE_API;
    const platform *by = b->o->camera.platform;
    if (!one)
        say_factor(p, b);
    else if (b->when & INVERSE)
        say_range(p, b);
    else
        say_verdict(p, b);
    if (b->when & OF_BIAS)
        say_limits(p, b);
    if (b->each.triangles != NULL && (b->when & OF_BIAS))
        page_line(p, "resolved: one plane drawn as different triangles, each at least a pixel high");
    if (!one) {
        say_choice(p, b);
        return;
    }
    say_factor(p, b);
    if (b->when & BIAS_OF_REMEDY)
        return;
    if (b->limited && (b->when & EFFECT))
        page_line(p, "a biased depth beyond a plane is clamped to it");
    say_r(p, b);
    if (by != NULL && by->bias[0] != '\0')
        page_line(p, "%s %s", by->name, by->bias);
}

/* Formats above mappings, and below what is written in place of U. */
void bias_say_beside(page *p, void *item) {
    const biasing *b = item;
    const camera_asked *c = &b->o->camera;
    page_title(p, "near %s, far %s, %s", number_full(c->znear).text, number_full(c->zfar).text,
               c->ortho ? "orthographic" : "perspective");
    say_goal(p, b);
    output_format(p->out, "%s%-*s", p->soft, WIDTH_API, "");
    for (size_t k = 0; k < b->each.all.count; k++)
        output_format(p->out, "%*s", WIDTH_UNITS, b->each.all.items[k].spec.format.name);
    output_format(p->out, "%s\n", p->plain);
}

void bias_say_calls(page *p, void *item) {
    const biasing *b = item;
    char open[BIAS_CALL_SIZE];
    bool misses = false, integer = false;
    for (size_t k = 0; k < b->each.all.count; k++) {
        misses = misses || bias_is_missed(&b->each.all.items[k]);
        integer = integer || b->each.all.items[k].spec.format.kind == DP_FORMAT_UNORM;
    }
    if (b->fails)
        page_line(p, "-: no bias suffices; ask about that format and mapping alone to see where one does");
    if (misses)
        page_line(p, "%s", bias_limit_find("written")->said);
    if (*say_measured(p, b->o, NULL, open) != '\0' && integer)
        page_line(p, "%s: in integer formats r is the implementation's choice, 2^-N is assumed", open);
    output_char(p->out, '\n');
    const bias_api *api;
    for (size_t i = 0; (api = bias_asked_api(&b->o->bias, i)) != NULL; i++)
        page_note(p, api->name, "%s", bias_call_of(api, "U", number_full(b->o->bias.factor).text).text);
}
