/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * bias: what a depth bias of an API moves in the scene; or, when no bias is given, how much of it is enough to tell
 * coplanar layers apart, or to bring one nearer by a gap.
 */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "bias/bias.h"
#include "bias/cmd_bias/bias_all.h"
#include "bias/cmd_bias/request.h"
#include "camera/cmd/each_setup.h"
#include "camera/cmd/slant.h"
#include "core/append.h"
#include "core/engine.h"
#include "quantity/cmd/resolved.h"
#include "report/number.h"

enum { DIGITS = 6, DIGITS_Z = 9, DIGITS_SHORT = 4 };

/* The effect of the bias, or of one unit and how many are enough. */
typedef struct row {
    bias_effect effect;     /* of the bias given, or of one unit that brings a layer nearer */
    double one_unit;        /* what one unit moves; NaN where it is held at a plane */
    double apart;           /* inverse: the units that tell layers apart, with their sign; NaN when none do */
    double gap;             /* inverse: the units that bring a layer nearer by the gap */
    const char *held;       /* text: where the biased depth is held at a plane */
    double facing, slanted; /* the separations that need no bias */
    bool certain;           /* the facing one ends before far */
} row;

/* Inverse: the same over the range. */
typedef struct needs {
    double lo, hi, gap_lo;
    double apart, apart_z, apart_from, apart_to; /* and where a bias is enough at all */
    double gap, gap_z, gap_from, gap_to;
    double apart_next, gap_next; /* where the exponent is n + 1; NaN where that is not open */
    double shift_lo, shift_hi;   /* what the units of the gap do at the ends, or those that tell apart without a gap */
} needs;

/* The question; the fields below `range_lo` are of the set-up at hand. */
typedef struct biasing {
    each_setup each;
    const bias_request *o;
    const char *api;
    const bias_api *named;
    double units_sent; /* as the platform sends them */
    bool cuts;         /* the GPU cuts fractions of them */
    bias_api row_here; /* as the platform has it, and the GPU that was measured in the set-up's format */
    bias_state state;
    bias_goal goal;
    bool inverse; /* no bias was given: one is asked for */
    bool chosen;  /* the factor is the least that is enough at any slant */
    slant_fields slant;
    const slant_fields *triangles; /* null: surfaces face the camera */
    dp_setup facing, slanted;      /* in the model float */
    double units, gap;             /* as asked; NaN where the other one is */
    double factor;                 /* as asked; NaN where each set-up has its own */
    double range_lo, range_hi;
    row row;
    needs needs;
    bool limited; /* some depth is held at a plane */
} biasing;

/* ---- What is asked ----------------------------------------------------------------------------------------------- */

/* The goal for this set-up: the factor is written with the sign that the API takes, the goal counts nearer as +. */
static bias_goal goal_of(const biasing *b, double gap) {
    bias_goal goal = b->goal;
    goal.factor = b->state.factor * bias_sign(b->each.setup);
    goal.gap = gap;
    return goal;
}

static void *next_row(void *of, size_t i) {
    biasing *b = of;
    row *r = &b->row;
    bias_state state = b->state;
    double z;
    if (!each_setup_depth(&b->each, i, &z))
        return NULL;
    const dp_setup *setup = b->each.setup;
    if (b->inverse) {
        const bias_goal apart = goal_of(b, 0.0);
        const bias_goal gap = goal_of(b, b->goal.gap);
        state.units = bias_sign(setup);
        state.factor = 0.0;
        r->apart = bias_signed(setup, bias_needed(setup, &apart, z));
        r->gap = bias_signed(setup, bias_needed(setup, &gap, z));
    }
    if (b->triangles != NULL) {
        r->facing = dp_separation(&b->facing, z);
        r->certain = dp_is_certain(&b->facing, z, r->facing);
        r->slanted = dp_separation(&b->slanted, z);
    }
    r->effect = bias_at(setup, &state, b->goal.slope, z);
    r->one_unit = r->effect.limited ? (double)NAN : fabs(r->effect.shift);
    r->held = r->effect.limited ? "clamped to a plane" : "";
    b->limited = b->limited || r->effect.limited;
    return r;
}

static double shift_with(const biasing *b, double units, double z) {
    bias_state state = b->state;
    state.units = units;
    return isnan(units) || isinf(z) ? (double)NAN : bias_at(b->each.setup, &state, b->goal.slope, z).shift;
}

/* bias_needed_over() and bias_enough_over(), at a depth where the range is one. */
static double needed(const dp_setup *setup, const bias_goal *goal, double lo, double hi, double *worst) {
    if (lo < hi)
        return bias_needed_over(setup, goal, lo, hi, worst);
    *worst = lo;
    return bias_needed(setup, goal, lo);
}

static void enough(const dp_setup *setup, const bias_goal *goal, double lo, double hi, double *from, double *to) {
    if (lo < hi)
        bias_enough_over(setup, goal, lo, hi, from, to);
    else
        *from = *to = isfinite(bias_needed(setup, goal, lo)) ? lo : (double)NAN;
}

/* The same where drivers take the greater of two exponents that the specification leaves open. */
static void next_over_range(const biasing *b, needs *n) {
    const dp_setup *setup = b->each.setup;
    const bias_api next = bias_next(b->state.api);
    bias_goal apart = goal_of(b, 0.0), gap = goal_of(b, b->goal.gap);
    double z;
    n->apart_next = n->gap_next = (double)NAN;
    if (!bias_is_open(b->state.api, &setup->spec.format))
        return;
    apart.api = gap.api = &next;
    n->apart_next = bias_signed(setup, needed(setup, &apart, n->lo, n->hi, &z));
    if (b->goal.gap > 0.0 && n->gap_lo <= n->hi)
        n->gap_next = bias_signed(setup, needed(setup, &gap, n->gap_lo, n->hi, &z));
}

static needs over_range(const biasing *b) {
    const dp_setup *setup = b->each.setup;
    const double lo = b->range_lo, hi = b->range_hi;
    needs n = {.lo = lo, .hi = hi, .gap_lo = fmax(lo, setup->spec.znear + b->goal.gap)};
    const bias_goal apart = goal_of(b, 0.0);
    const bias_goal gap = goal_of(b, b->goal.gap);
    n.apart = bias_signed(setup, needed(setup, &apart, lo, hi, &n.apart_z));
    enough(setup, &apart, lo, hi, &n.apart_from, &n.apart_to);
    n.gap = n.gap_z = n.gap_from = n.gap_to = (double)NAN;
    if (b->goal.gap > 0.0 && n.gap_lo <= hi)
        enough(setup, &gap, n.gap_lo, hi, &n.gap_from, &n.gap_to);
    if (b->goal.gap > 0.0 && n.gap_lo <= hi)
        n.gap = bias_signed(setup, needed(setup, &gap, n.gap_lo, hi, &n.gap_z));
    next_over_range(b, &n);
    const double units = b->goal.gap > 0.0 ? n.gap : n.apart;
    n.shift_lo = shift_with(b, units, n.gap_lo);
    n.shift_hi = shift_with(b, units, hi);
    return n;
}

/* The API as the platform and the GPU have it in the format of this set-up. */
static void take_measured(biasing *b) {
    const bias_request *o = b->o;
    const dp_format *format = &b->each.setup->spec.format;
    const profile_format *found = profile_biased(&o->camera.gpu, o->camera.platform, b->named, format);
    b->row_here = profile_bias(&o->camera.gpu, o->camera.platform, b->named, format);
    b->cuts = found != NULL && found->cuts;
    b->state.units = b->cuts ? trunc(b->units_sent) : b->units_sent;
}

static void *next_setup(void *of, size_t i) {
    biasing *b = of;
    if (!each_setup_go(&b->each, i))
        return NULL;
    b->limited = false;
    take_measured(b);
    if (b->triangles != NULL) {
        b->slanted = resolved_in(b->each.setup, DP_MODEL_FLOAT);
        b->facing = dp_setup_facing(&b->slanted);
    }
    if (b->chosen)
        b->state.factor = bias_sign(b->each.setup) * bias_factor_least(b->each.setup);
    if (b->inverse && b->o->out.form != FORM_CSV)
        b->needs = over_range(b);
    return b;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static void say_states(page *p, void *item) {
    const biasing *b = item;
    const bias_state *s = &b->state;
    each_setup_title(p, item);
    slant_say(p, page_title, &b->o->camera, &b->slanted);
    char text[256] = "";
    append(text, sizeof text, "%s", s->api->name);
    if (!b->inverse)
        append(text, sizeof text, ", units %s", number_full(s->units).text);
    if (!b->inverse && isinf(b->o->bias.units) && s->api->whole)
        append(text, sizeof text,
               " (%s in 32 bits, as a cast that saturates makes it; in C it is undefined, and x86 "
               "makes -2147483648 of either sign)",
               number_full(b->o->bias.units).text);
    if (s->factor != 0.0 && isfinite(s->factor))
        append(text, sizeof text, ", factor %s", number_full(s->factor).text);
    if (!b->inverse && s->clamp != 0.0)
        append(text, sizeof text, ", clamp %s", number_full(s->clamp).text);
    if (b->goal.slope > 0.0)
        append(text, sizeof text, ", slope %s per pixel", camera_length(b->each.here, b->goal.slope, 0).text);
    page_text(p, "%s", text);
}

/* "  resolved    -2 units from 0.1 to 1000 (needed at z = 0.1)", or where a bias suffices at all. */
static void say_needed(page *p, const bias_request *o, const char *what, double units, const double range[2], double z,
                       const double enough[2]) {
    const number_text lo = camera_length(&o->camera, range[0], DIGITS_Z);
    const number_text hi = camera_length(&o->camera, range[1], DIGITS_Z);
    const number_text from = number_in(number_up(enough[0], DIGITS_Z), p->unit);
    const number_text to = number_in(number_down(enough[1], DIGITS_Z), p->unit);
    if (range[0] == range[1] && isnan(units))
        page_note(p, what, "no bias suffices at z = %s", lo.text);
    else if (range[0] == range[1])
        page_note(p, what, "%s unit%s at z = %s", number_of(units, DIGITS_Z).text, fabs(units) == 1.0 ? "" : "s",
                  lo.text);
    else if (!isnan(units))
        page_note(p, what, "%s unit%s from %s to %s (needed at z = %s)", number_of(units, DIGITS_Z).text,
                  fabs(units) == 1.0 ? "" : "s", lo.text, hi.text, camera_length(&o->camera, z, DIGITS_Z).text);
    else if (isnan(enough[0]))
        page_note(p, what, "no bias suffices from %s to %s", lo.text, hi.text);
    else if (enough[0] == range[0])
        page_note(p, what, "suffices up to z = %s; from there to %s no bias does", to.text, hi.text);
    else if (enough[1] == range[1])
        page_note(p, what, "suffices from z = %s on; from %s to there no bias does", from.text, lo.text);
    else
        page_note(p, what, "suffices from z = %s to %s; elsewhere from %s to %s no bias does", from.text, to.text,
                  lo.text, hi.text);
}

static void say_range(page *p, const biasing *b) {
    const needs *r = &b->needs;
    say_needed(p, b->o, "resolved", r->apart, (const double[]){r->lo, r->hi}, r->apart_z,
               (const double[]){r->apart_from, r->apart_to});
    if (b->goal.gap > 0.0)
        say_needed(p, b->o, "separated", r->gap, (const double[]){r->gap_lo, r->hi}, r->gap_z,
                   (const double[]){r->gap_from, r->gap_to});
    const double units = b->goal.gap > 0.0 ? r->gap : r->apart;
    if (!isnan(units))
        page_note(p, "to write", "%s", bias_call(b->state.api, units, b->state.factor).text);
    const double next = b->goal.gap > 0.0 ? r->gap_next : r->apart_next;
    if (!isnan(units) && !isnan(next))
        page_note(p, "", "where drivers take the exponent n + 1, %s suffices; this suffices with either",
                  number_of(next, DIGITS_Z).text);
    if (b->goal.gap == 0.0)
        return;
    const unit_row *unit = option_unit(b->o->line, "separation");
    const double shift = unit_convert(fabs(r->shift_hi), b->each.here->lengths.unit, unit);
    if (!isnan(r->shift_hi))
        page_note(p, "", "the same units bring a layer nearer by %s at z = %s",
                  number_in(number_of(shift, DIGITS), unit != NULL ? unit->name : NULL).text,
                  camera_length(b->each.here, r->hi, DIGITS_Z).text);
}

/* Says how far r was measured. @return whether there is nothing more to say of it */
static bool say_measured(page *p, const biasing *b) {
    const bias_request *o = b->o;
    char text[BIAS_CALL_SIZE];
    if (o->camera.gpu.measured[0] == '\0')
        return false;
    bias_of_gpu(o, b->named, &b->each.setup->spec.format, text);
    if (text[0] == '\0')
        page_line(p, "r was not measured on this GPU for %s", b->named->name);
    else
        page_line(p, "%s%s", text, b->cuts ? "; fractional units are truncated: 0.5 becomes 0" : "");
    return text[0] != '\0';
}

/* Says which r the API leaves open. */
static void say_open(page *p, const biasing *b) {
    const bias_unit unit = bias_unit_at(b->state.api, &b->each.setup->spec.format, 1.0);
    if (isinf(unit.most))
        page_line(p, "r is the implementation's choice: the value shown is assumed");
    else if (bias_is_open(b->state.api, &b->each.setup->spec.format))
        page_line(p, "drivers take the exponent of a depth in [2^n, 2^(n+1)) as n or n+1: r is up to %s times this",
                  number_of(unit.most / unit.least, DIGITS_SHORT).text);
    else if (unit.most > unit.least)
        page_line(p, "r is the implementation's choice: up to twice the value shown");
}

static void say_notes(page *p, void *item) {
    const biasing *b = item;
    if (b->inverse)
        say_range(p, b);
    else
        page_line(p, "a %s bias brings a layer nearer", bias_sign(b->each.setup) < 0 ? "negative" : "positive");
    if (bias_is_missed(b->each.setup))
        page_line(p, "%s", BIAS_MISSED);
    if (b->triangles != NULL)
        page_line(p, "%s", BIAS_DRAWN_TWICE);
    const double least = bias_factor_least(b->each.setup); /* 0 without triangles */
    if (b->inverse && b->goal.slope == 0.0 && isinf(least))
        page_line(p, "%s", BIAS_NO_FACTOR);
    else if (b->inverse && b->goal.slope == 0.0 && b->state.factor * bias_sign(b->each.setup) < least)
        page_line(p, "at any slant no units suffice with a factor below %s; --slope says how steep surfaces are",
                  number_full(least).text);
    if (b->limited && !b->inverse)
        page_line(p, "a biased depth outside [0, 1] is clamped to the plane");
    if (!say_measured(p, b))
        say_open(p, b);
    if (b->o->camera.platform != NULL && b->o->camera.platform->bias[0] != '\0')
        page_line(p, "%s %s", b->o->camera.platform->name, b->o->camera.platform->bias);
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

/* Either the effect of a bias is asked, or the bias that is needed. */
enum { EFFECT = 1, INVERSE = 2, WITH_GAP = 4, WITH_SLOPE = 8, VERBOSE = 16, WITH_TRIANGLES = 32 };

static unsigned conditions(const biasing *b) {
    return (b->inverse ? INVERSE : EFFECT) | (b->goal.gap > 0.0 ? WITH_GAP : 0) |
           (b->goal.slope > 0.0 ? WITH_SLOPE : 0) | (b->o->out.full ? VERBOSE : 0) |
           (b->triangles != NULL ? WITH_TRIANGLES : 0);
}

static const column row_columns[] = {
    {FIELD(row, effect.z, "z", "scene"), SHOWN("z", 11, DIGITS_Z)},
    {FIELD(row, effect.r.least, "r", ""), SHOWN("r", 12, DIGITS)},
    {FIELD(row, effect.r.most, "r_most", "")},
    {FIELD(row, effect.m, "slope", "per pixel")},
    {TEXT_FIELD(row, effect.m, "slope", 12, DIGITS), .when = WITH_SLOPE, .spare = 2},
    {FIELD(row, one_unit, "one_unit", "scene"), SHOWN("one unit", 13, DIGITS), .when = INVERSE},
    {FIELD(row, apart, "units_apart", ""), SHOWN("resolved", 17, DIGITS_Z), .when = INVERSE},
    {FIELD(row, gap, "units_gap", ""), .only = AS_CSV, .when = INVERSE},
    {FIELD(row, gap, "units_gap", ""), SHOWN("separated", 17, DIGITS_Z), .only = AS_JSON | AS_TEXT,
     .when = INVERSE | WITH_GAP},
    {FIELD(row, facing, "guarantee_facing", "scene"), SHOWN("facing", 11, DIGITS_SHORT), .upward = true,
     .when = WITH_TRIANGLES},
    {FIELD(row, slanted, "guarantee_slanted", "scene"), SHOWN("slanted", 11, DIGITS_SHORT), .upward = true,
     .when = WITH_TRIANGLES},
    {FIELD(row, effect.offset, "bias", ""), SHOWN("bias", 12, DIGITS), .when = EFFECT, .spare = 1},
    {FIELD(row, effect.depth, "depth", ""), .when = EFFECT},
    {FIELD(row, effect.code, "code", ""), SHOWN("code", 11, 0), .when = EFFECT},
    {FIELD(row, effect.moved, "code_moved", ""), SHOWN("moved to", 11, 0), .when = EFFECT},
    {FIELD(row, effect.to, "z_moved", "scene"), SHOWN("decoded depth", 18, DIGITS_Z + 1), .when = EFFECT},
    {FIELD(row, effect.shift, "shift", "scene"), SHOWN("shift", 12, DIGITS), .when = EFFECT},
    {FIELD(row, effect.limited, "limited", ""), .only = AS_JSON, .when = EFFECT},
    {TEXT_FIELD(row, held, "", -1, 0), .when = VERBOSE},
    {FIELD(row, certain, "certain", ""), .when = WITH_TRIANGLES},
    {.kind = COLUMN_END}};

static const column needs_columns[] = {{FIELD(needs, lo, "lo", "scene")},
                                       {FIELD(needs, hi, "hi", "scene")},
                                       {FIELD(needs, apart, "units_apart", "")},
                                       {FIELD(needs, apart_z, "units_apart_z", "scene")},
                                       {FIELD(needs, apart_from, "apart_from", "scene")},
                                       {FIELD(needs, apart_to, "apart_to", "scene")},
                                       {FIELD(needs, apart_next, "units_apart_next", "")},
                                       {FIELD(needs, gap_lo, "gap_lo", "scene"), .when = WITH_GAP},
                                       {FIELD(needs, gap, "units_gap", ""), .when = WITH_GAP},
                                       {FIELD(needs, gap_next, "units_gap_next", ""), .when = WITH_GAP},
                                       {FIELD(needs, gap_z, "units_gap_z", "scene"), .when = WITH_GAP},
                                       {FIELD(needs, gap_from, "gap_from", "scene"), .when = WITH_GAP},
                                       {FIELD(needs, gap_to, "gap_to", "scene"), .when = WITH_GAP},
                                       {FIELD(needs, shift_lo, "shift_lo", "scene")},
                                       {FIELD(needs, shift_hi, "shift_hi", "scene")},
                                       {.kind = COLUMN_END}};

static const column setup_report[] = {{PART(biasing, each.fields, NULL, setup_columns)},
                                      {FIELD(biasing, api, "api", ""), .only = AS_CSV},
                                      {FIELD(biasing, state.factor, "factor", ""), .when = WITH_TRIANGLES},
                                      {LIST("rows", row_columns, next_row)},
                                      {PART(biasing, needs, "range", needs_columns), .only = AS_JSON, .when = INVERSE},
                                      {.kind = COLUMN_END}};

static const column columns[] = {
    {FIELD(biasing, api, "api", ""), .only = AS_JSON},
    {FIELD(biasing, units, "units", ""), .only = AS_JSON},
    {FIELD(biasing, factor, "factor", ""), .only = AS_JSON},
    {FIELD(biasing, state.clamp, "clamp", ""), .only = AS_JSON},
    {FIELD(biasing, goal.slope, "slope", ""), .only = AS_JSON},
    {FIELD(biasing, gap, "gap", "scene"), .only = AS_JSON},
    {PART(biasing, triangles, "triangles", slant_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {LIST("setups", setup_report, next_setup), .head = say_states, .notes = say_notes},
    {.kind = COLUMN_END}};

/* ---- The command ------------------------------------------------------------------------------------------------- */

static int check_states(const bias_request *o, const bias_api *api) {
    const bool given = option_given(o->line, "units");
    if (given && api->whole && !isinf(o->bias.units) &&
        !(o->bias.units == nearbyint(o->bias.units) && fabs(o->bias.units) <= 0x1.fffffffcp30) &&
        (o->camera.platform == NULL || !o->camera.platform->cuts))
        return option_error("units", "must be a whole number from -2147483647 to 2147483647 for %s, got %s", api->name,
                            number_full(o->bias.units).text);
    if (option_given(o->line, "clamp") && !api->clamps)
        return option_error("clamp", "must not be given for %s, which has no clamp",
                            o->camera.platform != NULL && o->camera.platform->drops_clamp ? o->camera.platform->name
                                                                                          : api->name);
    if (option_given(o->line, "clamp") && !given)
        return option_error("clamp", "must be given together with --units");
    return EXIT_FINE;
}

/* The range that is asked for, else that of the depths that are. */
static int resolve(biasing *b, const bias_request *o) {
    const depths *at = &b->each.at;
    const int status = range_resolve(&o->camera, &b->range_lo, &b->range_hi);
    if (status != EXIT_FINE || option_given(o->line, "range") || !option_given(o->line, "at"))
        return status;
    b->range_lo = b->range_hi = depths_get(at, 0);
    for (size_t i = 1; i < at->count; i++) {
        b->range_lo = fmin(b->range_lo, depths_get(at, i));
        b->range_hi = fmax(b->range_hi, depths_get(at, i));
    }
    return status;
}

int cmd_bias(void *request) {
    const bias_request *given = request;
    bias_request o = *given;
    const bias_api *api = o.bias.api;
    const int affine = bias_check_slant(&o);
    if (affine != EXIT_FINE || api == NULL)
        return affine != EXIT_FINE ? affine : bias_all_write(&o);
    biasing b = {.o = &o,
                 .state = {api, o.bias.units, o.bias.factor, o.bias.clamp},
                 .goal = {.api = api, .slope = o.bias.slope, .gap = o.bias.separation},
                 .inverse = !option_given(o.line, "units"),
                 .api = api->name,
                 .named = api,
                 .row_here = platform_bias(o.camera.platform, api)};
    b.state.api = b.goal.api = &b.row_here;
    if (o.camera.platform != NULL && o.camera.platform->cuts)
        b.state.units = trunc(o.bias.units);
    if (isinf(b.state.units) && b.row_here.whole)
        b.state.units = b.state.units > 0.0 ? INT32_MAX : INT32_MIN;
    b.units_sent = b.state.units;
    b.units = b.inverse ? (double)NAN : isinf(o.bias.units) ? b.state.units : o.bias.units;
    b.gap = b.inverse ? o.bias.separation : (double)NAN;
    b.triangles = slant_fields_of(&o.camera, &b.slant);
    b.chosen = bias_chooses_factor(&o);
    b.factor = b.chosen ? (double)NAN : o.bias.factor;
    int status = check_states(&o, &b.row_here);
    if (status != EXIT_FINE)
        return status;
    status = each_setup_start(&b.each, &o.camera, &o.out);
    if (status == EXIT_FINE)
        status = resolve(&b, &o);
    const report_spec spec = {"bias", columns, &b, .when = conditions(&b), .label = 12};
    return each_setup_write(&b.each, &spec, status);
}
