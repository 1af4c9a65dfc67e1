/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * bias --api all: a row an API for each place, a depth of --at or the range. A few set-ups stand beside each other:
 * their units differ, and how they are written does not.
 */
#include "bias/cmd_bias/bias_all.h"
#include "bias/cmd_bias/request.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "camera/cmd/each_setup.h"
#include "camera/cmd/slant.h"
#include "core/append.h"
#include "quantity/cmd/resolved.h"
#include "report/number.h"
#include "report/terminal.h"

enum { DIGITS_Z = 9, DIGITS_SHORT = 4, BESIDE = 6, WIDTH_API = 13, WIDTH_UNITS = 11 };

double bias_signed(const dp_setup *setup, double units) {
    return isinf(units) ? (double)NAN : units * bias_sign(setup) + 0.0; /* no -0 */
}

/* Whole numbers in all their digits; a window depth as a float needs it. */
static number_text units_text(double units) {
    return units == nearbyint(units) ? number_full(units) : number_of(units, DIGITS_Z);
}

/* The letters U and F where they are words. */
static void fill_in(bias_call_text *out, const char *form, const char *units, const char *factor) {
    for (const char *c = form; *c != '\0'; c++) {
        const bool word = (c == form || !isalnum((unsigned char)c[-1])) && !isalnum((unsigned char)c[1]);
        if (word && (*c == 'U' || *c == 'F'))
            append(out->text, BIAS_CALL_SIZE, "%s", *c == 'U' ? units : factor);
        else
            append(out->text, BIAS_CALL_SIZE, "%c", *c);
    }
}

static bias_call_text call_of(const bias_api *api, const char *units, const char *factor) {
    bias_call_text out = {""};
    fill_in(&out, api->call, units, factor);
    if (strcmp(factor, "0") != 0)
        fill_in(&out, api->sloped, units, factor);
    return out;
}

bias_call_text bias_call(const bias_api *api, double units, double factor) {
    return call_of(api, units_text(units).text, number_full(factor).text);
}

const char *bias_of_gpu(const bias_request *o, const bias_api *api, const dp_format *format, char out[BIAS_CALL_SIZE]) {
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

int bias_check_slant(const bias_request *o) {
    for (size_t i = 0; i < o->camera.mapping_count && o->camera.triangles.width > 0; i++)
        if (dp_mapping_get(o->camera.mappings[i])->curve != DP_CURVE_PERSPECTIVE)
            return option_error("viewport", "does not apply to %s, which is not affine on the screen",
                                dp_mapping_get(o->camera.mappings[i])->name);
    return EXIT_FINE;
}

typedef struct row {
    const char *api, *label;
    double z, lo, hi; /* the depth, or the range */
    bias_unit r;      /* at the depth; NaN over a range */
    double factor;
    double units, units_z, from, to;
    char call[BIAS_CALL_SIZE], said[BIAS_CALL_SIZE]; /* said: the call, or why there is none */
    char beside[BESIDE][NUMBER_SIZE];                /* the units of each set-up, short */
} row;

typedef struct all {
    each_setup each;
    const bias_request *o;
    double lo, hi; /* the range, where no depths are given */
    bool by_range;
    row row;
    const char *apis;
    bool fails; /* somewhere no bias is enough */
    double slope, gap;
    double factor; /* as asked; NaN where each set-up has its own */
    slant_fields slant;
    const slant_fields *triangles; /* null: surfaces face the camera */
} all;

/* ---- What is needed ---------------------------------------------------------------------------------------------- */

static bias_goal goal_of(const bias_request *o, const bias_api *api, const dp_setup *setup) {
    const double factor = bias_chooses_factor(o) ? bias_factor_least(setup) : o->bias.factor * bias_sign(setup);
    return (bias_goal){.api = api, .factor = factor, .slope = o->bias.slope, .gap = o->bias.separation};
}

/* Where the gap leads to the near plane, at least. */
static double range_from(const all *a) {
    return fmin(fmax(a->lo, a->each.here->znear + a->o->bias.separation), a->hi);
}

/* The call, or where in the range there is one. */
static void say_result(row *r) {
    const number_text from = number_up(r->from, DIGITS_Z), to = number_down(r->to, DIGITS_Z);
    if (!isnan(r->units) || isnan(r->from))
        append(r->said, sizeof r->said, "%s", isnan(r->units) ? "no bias suffices" : r->call);
    else if (r->from == r->lo)
        append(r->said, sizeof r->said, "suffices only up to z = %s", to.text);
    else if (r->to == r->hi)
        append(r->said, sizeof r->said, "suffices only from z = %s on", from.text);
    else
        append(r->said, sizeof r->said, "suffices only from z = %s to %s", from.text, to.text);
}

/* In nine digits or, on the safe side, in fewer. */
static void write_short(double units, char out[NUMBER_SIZE]) {
    const bool whole = units == nearbyint(units) && fabs(units) < 1e9;
    const number_text text = whole ? number_full(fabs(units)) : number_up(fabs(units), DIGITS_SHORT);
    out[0] = '\0';
    append(out, NUMBER_SIZE, "%s%s", units < 0.0 ? "-" : "", text.text);
}

static void fill_row(const all *a, const bias_api *named, const dp_setup *setup, double z, row *r) {
    const bias_request *o = a->o;
    const bias_api here = profile_bias(&o->camera.gpu, o->camera.platform, named, &setup->spec.format), *api = &here;
    const bias_goal goal = goal_of(o, api, setup);
    *r = (row){.api = api->name, .label = api->name, .z = z, .lo = (double)NAN, .hi = (double)NAN, .units_z = z};
    r->factor = goal.factor * bias_sign(setup) + 0.0; /* no -0 */
    if (!a->by_range) {
        r->r = bias_unit_at(api, &setup->spec.format, dp_window(setup, z));
        r->units = bias_signed(setup, bias_needed(setup, &goal, z));
        r->from = r->to = isnan(r->units) ? (double)NAN : z;
    } else {
        r->lo = range_from(a);
        r->hi = a->hi;
        r->r = (bias_unit){(double)NAN, (double)NAN};
        r->units = bias_signed(setup, bias_needed_over(setup, &goal, r->lo, r->hi, &r->units_z));
        bias_enough_over(setup, &goal, r->lo, r->hi, &r->from, &r->to);
    }
    if (!isnan(r->units))
        memcpy(r->call, bias_call(api, r->units, r->factor).text, sizeof r->call);
    say_result(r);
    char shown[NUMBER_SIZE];
    write_short(r->units, shown);
    if (bias_chooses_factor(o) && !isnan(r->units)) /* the factor is long, and the same for all */
        snprintf(r->said, sizeof r->said, "%s", call_of(api, shown, "F").text);
}

static size_t api_count(const bias_request *o) {
    size_t count = 0;
    while (bias_asked_api(&o->bias, count) != NULL)
        count++;
    return count;
}

/* Place by place, API by API. */
static void *next_row(void *of, size_t i) {
    all *a = of;
    const size_t apis = api_count(a->o);
    const bias_api *api = bias_asked_api(&a->o->bias, i % apis);
    if (i / apis == (a->by_range ? 1 : a->each.at.count) || output_failed(&a->each.out))
        return NULL;
    fill_row(a, api, a->each.setup, a->by_range ? (double)NAN : depths_get(&a->each.at, i / apis), &a->row);
    return &a->row;
}

/* The same for all set-ups at once. */
static void *next_beside(void *of, size_t i) {
    all *a = of;
    const bias_api *api = bias_asked_api(&a->o->bias, i);
    row r;
    if (api == NULL)
        return NULL;
    for (size_t k = 0; k < a->each.all.count; k++) {
        fill_row(a, api, &a->each.all.items[k], a->by_range ? (double)NAN : depths_get(&a->each.at, 0), &r);
        write_short(r.units, a->row.beside[k]);
        a->fails = a->fails || isnan(r.units);
    }
    a->row.api = api->name;
    return &a->row;
}

static void *next_setup(void *of, size_t i) {
    all *a = of;
    return each_setup_go(&a->each, i) ? a : NULL;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static void say_goal(page *p, const all *a) {
    const bias_request *o = a->o;
    char goal[64] = "To be resolved", place[128] = "", slope[64] = "";
    if (o->bias.separation > 0.0)
        snprintf(goal, sizeof goal, "To bring a layer %s nearer",
                 camera_length(&o->camera, o->bias.separation, 0).text);
    if (o->bias.slope > 0.0)
        snprintf(slope, sizeof slope, ", slope %s per pixel", camera_length(&o->camera, o->bias.slope, 0).text);
    if (a->by_range)
        snprintf(place, sizeof place, " from z = %s to %s", camera_length(&o->camera, range_from(a), DIGITS_Z).text,
                 camera_length(&o->camera, a->hi, DIGITS_Z).text);
    else if (a->each.at.count == 1)
        snprintf(place, sizeof place, " at z = %s", camera_length(&o->camera, a->each.at.lo, DIGITS_Z).text);
    page_text(p, "%s%s%s:", goal, place, slope);
}

static void say_setup(page *p, void *item) {
    const all *a = item;
    const dp_setup full = dp_setup_guaranteed(a->each.setup);
    each_setup_title(p, item);
    slant_say(p, page_title, a->each.here, &full);
    say_goal(p, a);
}

static const char *const chosen_by_drivers[] = {"vulkan", "gl"};

static bool is_asked(const bias_request *o, const char *name) {
    size_t i = 0;
    while (bias_asked_api(&o->bias, i) != NULL && strcmp(bias_asked_api(&o->bias, i)->name, name) != 0)
        i++;
    return bias_asked_api(&o->bias, i) != NULL;
}

/* Those that are asked for; those that were measured in the format are told, and left out. @return out */
static const char *say_measured(page *p, const bias_request *o, const dp_format *format, char out[BIAS_CALL_SIZE]) {
    char text[BIAS_CALL_SIZE] = "";
    out[0] = '\0';
    for (size_t i = 0; i < sizeof chosen_by_drivers / sizeof chosen_by_drivers[0]; i++) {
        const char *const name = chosen_by_drivers[i];
        if (!is_asked(o, name))
            continue;
        if (format != NULL && bias_of_gpu(o, bias_api_find(name), format, text)[0] != '\0')
            page_line(p, "%s: %s", name, text);
        else
            append(out, BIAS_CALL_SIZE, "%s%s", *out != '\0' ? " and " : "", name);
    }
    return out;
}

static void say_choice(page *p, const bias_request *o, const dp_format *format) {
    char text[BIAS_CALL_SIZE];
    const char *const open = say_measured(p, o, format, text);
    if (*open == '\0')
        return;
    if (format->kind == DP_FORMAT_UNORM)
        page_line(p, "%s: r is the implementation's choice, 2^-%d is assumed", open, format->bits);
    else
        page_line(p,
                  "%s: the exponent of a depth is the driver's to read, r may be twice as much: these units are "
                  "enough with both, half of them with that",
                  open);
}

static void say_notes(page *p, void *item) {
    const all *a = item;
    if (bias_chooses_factor(a->o) && isinf(a->row.factor))
        page_line(p, "%s", BIAS_NO_FACTOR);
    else if (bias_chooses_factor(a->o))
        page_line(p, "F, the slope factor, is %s", number_full(a->row.factor).text);
    if (a->triangles != NULL)
        page_line(p, "%s", BIAS_DRAWN_TWICE);
    if (bias_is_missed(a->each.setup))
        page_line(p, "%s", BIAS_MISSED);
    say_choice(p, a->o, &a->each.setup->spec.format);
}

/* Formats above mappings, and below what is written in place of U. */
static void say_beside(page *p, void *item) {
    const all *a = item;
    const bias_request *o = a->o;
    page_title(p, "near %s, far %s, %s", number_full(o->camera.znear).text, number_full(o->camera.zfar).text,
               o->camera.ortho ? "orthographic" : "perspective");
    say_goal(p, a);
    output_format(p->out, "%s%-*s", p->soft, WIDTH_API, "");
    for (size_t k = 0; k < a->each.all.count; k++)
        output_format(p->out, "%*s", WIDTH_UNITS, a->each.all.items[k].spec.format.name);
    output_format(p->out, "%s\n", p->plain);
}

static bool is_integer(const dp_setup *setup) {
    return setup->spec.format.kind == DP_FORMAT_UNORM;
}

static bool is_any(const all *a, bool (*is)(const dp_setup *setup)) {
    size_t k = 0;
    while (k < a->each.all.count && !is(&a->each.all.items[k]))
        k++;
    return k < a->each.all.count;
}

static void say_calls(page *p, void *item) {
    const all *a = item;
    if (a->fails)
        page_line(p, "-: no bias suffices; ask about that format and mapping alone to see where one does");
    if (is_any(a, bias_is_missed))
        page_line(p, "%s", BIAS_MISSED);
    char open[BIAS_CALL_SIZE];
    if (*say_measured(p, a->o, NULL, open) != '\0' && is_any(a, is_integer))
        page_line(p, "%s: in integer formats r is the implementation's choice, 2^-N is assumed", open);
    output_char(p->out, '\n');
    const bias_api *api;
    for (size_t i = 0; (api = bias_asked_api(&a->o->bias, i)) != NULL; i++)
        page_note(p, api->name, "%s", call_of(api, "U", number_full(a->o->bias.factor).text).text);
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

enum { OF_DEPTHS = 1, OF_RANGE = 2, OF_SEVERAL = 4, WITH_TRIANGLES = 8 };

static const column row_columns[] = {{FIELD(row, api, "api", ""), .only = AS_JSON | AS_CSV},
                                     {FIELD(row, z, "z", "scene"), .when = OF_DEPTHS},
                                     {TEXT_FIELD(row, z, "z", 12, DIGITS_Z), .when = OF_SEVERAL},
                                     {TEXT_FIELD(row, label, "api", -16, 0)},
                                     {FIELD(row, lo, "lo", "scene"), .when = OF_RANGE},
                                     {FIELD(row, hi, "hi", "scene"), .when = OF_RANGE},
                                     {FIELD(row, r.least, "r", ""), .when = OF_DEPTHS},
                                     {FIELD(row, r.most, "r_most", ""), .when = OF_DEPTHS},
                                     {FIELD(row, units, "units", "")},
                                     {FIELD(row, factor, "factor", ""), .when = WITH_TRIANGLES},
                                     {FIELD(row, units_z, "units_z", "scene"), .when = OF_RANGE},
                                     {FIELD(row, from, "from", "scene"), .when = OF_RANGE},
                                     {FIELD(row, to, "to", "scene"), .when = OF_RANGE},
                                     {FIELD(row, call, "call", "")},
                                     {TEXT_FIELD(row, said, "to write", -1, 0)},
                                     {.kind = COLUMN_END}};

static const column setup_report[] = {{PART(all, each.fields, NULL, setup_columns)},
                                      {LIST("rows", row_columns, next_row), .notes = say_notes},
                                      {.kind = COLUMN_END}};

static const column columns[] = {
    {FIELD(all, apis, "api", ""), .only = AS_JSON},
    {FIELD(all, slope, "slope", ""), .only = AS_JSON},
    {FIELD(all, factor, "factor", ""), .only = AS_JSON},
    {FIELD(all, gap, "gap", "scene"), .only = AS_JSON},
    {PART(all, triangles, "triangles", slant_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {LIST("setups", setup_report, next_setup), .head = say_setup},
    {.kind = COLUMN_END}};

static int write_beside(all *a, int status) {
    column rows[BESIDE + 2] = {{TEXT_FIELD(row, api, "", -WIDTH_API, 0)}};
    for (size_t k = 0; k < a->each.all.count; k++) {
        const char *mapping = dp_mapping_get(a->each.all.items[k].spec.mapping)->name;
        rows[k + 1] = (column){TEXT_FIELD(row, beside[0], mapping, WIDTH_UNITS, 0)};
        rows[k + 1].offset = offsetof(row, beside[k]);
    }
    rows[a->each.all.count + 1] = (column){.kind = COLUMN_END};
    const column list[] = {{LIST(NULL, rows, next_beside), .head = say_beside, .notes = say_calls},
                           {.kind = COLUMN_END}};
    const report_spec spec = {"bias", list, a, .label = 14};
    return each_setup_write(&a->each, &spec, status);
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

int bias_all_write(const bias_request *o) {
    all a = {.o = o,
             .by_range = !option_given(o->line, "at"),
             .apis = option_text(o->line, "api"),
             .slope = o->bias.slope,
             .gap = o->bias.separation};
    a.triangles = slant_fields_of(&o->camera, &a.slant);
    a.factor = bias_chooses_factor(o) ? (double)NAN : o->bias.factor;
    if (option_given(o->line, "units") || option_given(o->line, "clamp"))
        return option_error("api", "must be one API with --%s, got '%s'",
                            option_given(o->line, "units") ? "units" : "clamp", option_text(o->line, "api"));
    if (option_given(o->line, "at") && option_given(o->line, "range"))
        return option_error("range", "conflicts with --at for all APIs");
    int status = each_setup_start(&a.each, &o->camera, &o->out);
    if (status == EXIT_FINE)
        status = range_resolve(&o->camera, &a.lo, &a.hi);
    const bool beside = o->out.form == FORM_TEXT && !o->out.full && a.each.all.count > 1 &&
                        a.each.all.count <= BESIDE && (a.by_range || a.each.at.count == 1) && a.triangles == NULL &&
                        o->camera.gpu.measured[0] == '\0'; /* what was measured is told of each format */
    const int wide = terminal_columns(STDOUT_FILENO);
    const bool fits = wide == 0 || wide >= WIDTH_API + WIDTH_UNITS * (int)a.each.all.count;
    const unsigned when = (a.by_range ? OF_RANGE : OF_DEPTHS) | (!a.by_range && a.each.at.count > 1 ? OF_SEVERAL : 0) |
                          (a.triangles != NULL ? WITH_TRIANGLES : 0);
    if (beside && fits)
        return write_beside(&a, status);
    return each_setup_write(&a.each, &(report_spec){"bias", columns, &a, .when = when, .label = 14}, status);
}
