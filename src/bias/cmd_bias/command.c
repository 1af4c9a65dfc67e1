/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * bias: whether a depth bias of an API is enough, and what it moves in the scene; or, when no bias is given, how much
 * of it is enough to tell coplanar layers apart, or to bring one nearer by a gap. Of one API a row a depth, and what is
 * enough over the range; of several a row an API for each place, a depth of --at or the range. A few set-ups stand
 * beside each other: their units differ, and how they are written does not.
 */
#include <math.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

#include "bias/cmd_bias/report.h"
#include "camera/cmd/raster_setups.h"
#include "camera/depth_range.h"
#include "core/append.h"
#include "draw/canvas.h"
#include "report/terminal.h"

enum { DIGITS = 6 };

/* Whether each set-up's factor is the least that is enough at any slant: a viewport, and neither a bias nor a slope. */
static bool chooses_factor(const bias_request *o) {
    return o->camera.triangles.width > 0 && !option_given(o->line, "factor") && !option_given(o->line, "slope") &&
           !option_given(o->line, "units") && o->remedy == NULL;
}

/* ---- How much is needed ------------------------------------------------------------------------------------------ */

static bias_need need_from(const biasing *b, const char *what, double gap, double lo, double hi) {
    const dp_setup *setup = b->each.setup;
    const bias_api next = bias_next(&b->api);
    /* A factor is written with the sign that the API takes, the goal counts nearer as +. */
    bias_goal goal = {
        .api = &b->api, .factor = b->state.factor * bias_sign(setup), .slope = b->o->bias.slope, .gap = gap};
    bias_need n = {what, "units", lo, hi, (double)NAN, (double)NAN, (double)NAN, (double)NAN, (double)NAN};
    double z;
    if (!(lo <= hi))
        return n;
    n.z = lo;
    n.units =
        bias_signed(setup, lo < hi ? bias_needed_over(setup, &goal, lo, hi, &n.z) : bias_needed(setup, &goal, lo));
    n.counted = fabs(n.units) == 1.0 ? "unit" : "units";
    if (lo < hi)
        bias_enough_over(setup, &goal, (double)INFINITY, lo, hi, &n.from, &n.to);
    else
        n.from = n.to = isnan(n.units) ? (double)NAN : lo;
    if (!bias_is_open(&b->api, &setup->spec.format) || !(b->when & ONE_API))
        return n;
    goal.api = &next; /* drivers that take the greater of two exponents */
    n.next = bias_signed(setup, lo < hi ? bias_needed_over(setup, &goal, lo, hi, &z) : bias_needed(setup, &goal, lo));
    return n;
}

static double shift_with(const biasing *b, double units, double z) {
    bias_state state = b->state;
    state.units = units;
    return isnan(units) || isinf(z) ? (double)NAN : bias_at(b->each.setup, &state, b->o->bias.slope, z).shift;
}

static void take_range(biasing *b) {
    const double gap = b->o->bias.separation;
    b->over = need_from(b, "resolved", 0.0, b->range_lo, b->range_hi);
    b->gap_over = need_from(b, "separated", gap, gap > 0.0 ? bias_gap_from(b) : (double)NAN, b->range_hi);
    b->wanted = gap > 0.0 ? &b->gap_over : &b->over;
    b->shift_lo = shift_with(b, b->wanted->units, bias_gap_from(b));
    b->shift_hi = shift_with(b, b->wanted->units, b->range_hi);
    b->call[0] = '\0';
    if (!isnan(b->wanted->units))
        append(b->call, sizeof b->call, "%s", bias_call(&b->api, b->wanted->units, b->state.factor).text);
}

/* ---- Whether it is enough ---------------------------------------------------------------------------------------- */

/* Facing the camera, and at a slope or a slant that is asked about. */
static void judge(biasing *b) {
    const bias_request *o = b->o;
    const remedy *row = o->remedy;
    const dp_setup *setup = b->each.setup;
    const dp_setup facing = dp_setup_facing(setup);
    const double shown = depths_get(&b->each.at, b->each.at.count - 1);
    bias_goal goal = {.api = &b->api, .gap = o->bias.separation};
    b->judged_hi = isinf(b->range_hi) ? fmax(shown, b->range_lo) : b->range_hi;
    b->judged_lo = fmin(bias_gap_from(b), b->judged_hi);
    const double lo = b->judged_lo, hi = b->judged_hi;
    b->facing = row != NULL ? bias_judged_remedy(&facing, row, o->amount, &goal, lo, hi)
                            : bias_judged_of(&facing, &b->state, &goal, lo, hi);
    b->sloped = (bias_judged){.what = NULL};
    goal.slope = o->bias.slope;
    if (b->when & OF_SLOPES)
        b->sloped = row != NULL ? bias_judged_remedy(&facing, row, o->amount, &goal, lo, hi)
                                : bias_judged_of(setup, &b->state, &goal, lo, hi);
    if (o->drawn && b->status == EXIT_FINE)
        b->status = bias_try(o->camera.raster, &b->drawn.items[setup - b->each.all.items], &b->state, o->bias.slope,
                             isnan(b->sloped.v.lo) ? lo : b->sloped.v.lo, isnan(b->sloped.v.hi) ? hi : b->sloped.v.hi,
                             o->render, &b->sloped, &b->trial);
    const bias_judged *strictest = b->when & OF_SLOPES ? &b->sloped : &b->facing;
    b->missed = b->missed || b->facing.v.answer != BIAS_ENOUGH || strictest->v.answer != BIAS_ENOUGH;
    b->pushed = row != NULL ? bias_pushed_remedy(setup, row, o->amount, strictest, lo, hi)
                            : bias_pushed_of(setup, &b->state, strictest, lo, hi);
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* Goes to an API, as the platform and the GPU have it in the format of this set-up. */
static void take_api(biasing *b, const bias_api *named) {
    const bias_request *o = b->o;
    const dp_setup *setup = b->each.setup;
    const profile_format *found = profile_biased(&o->camera.gpu, o->camera.platform, named, &setup->spec.format);
    b->named = named;
    b->api = profile_bias(&o->camera.gpu, o->camera.platform, named, &setup->spec.format);
    b->cuts = found != NULL && found->cuts;
    b->state = (bias_state){&b->api, b->cuts ? trunc(b->units_sent) : b->units_sent, o->bias.factor, o->bias.clamp};
    if (b->chosen)
        b->state.factor = bias_sign(setup) * bias_factor_least(setup);
}

static const sentence no_call[] = {
    LINE("suffices only up to z = {to}", FROM_LO), ELSE("suffices only from z = {from} on", UP_TO_HI),
    ELSE("suffices only from z = {from} to {to}", 0), ELSE("no bias suffices", 0), SENTENCE_END};

/* The call, or where in the range there is one. */
static void write_call(const biasing *b, bias_row *r) {
    const double units = r->gap.units;
    r->call[0] = r->said[0] = '\0';
    if (!isnan(units))
        append(r->call, sizeof r->call, "%s", bias_call(&b->api, units, r->factor).text);
    if (isnan(units))
        sentence_first(NULL, no_call, bias_need_columns, &r->gap, bias_need_place(&r->gap), r->said);
    else /* a factor that is chosen is long, and the same for all */
        append(r->said, sizeof r->said, "%s",
               b->chosen ? bias_call_of(&b->api, bias_short(units).text, "F").text : r->call);
}

/* The row of the API at hand, at a depth or, where that is NaN, over the range. */
static void fill_row(biasing *b, double z, bias_row *r) {
    const dp_setup *setup = b->each.setup;
    const bool ranged = isnan(z);
    bias_state state = b->state;
    r->api = b->api.name;
    r->z = z;
    r->factor = b->state.factor + 0.0; /* no -0 */
    if (b->when & INVERSE) {
        state.units = bias_sign(setup);
        state.factor = 0.0;
        r->gap = need_from(b, "", b->o->bias.separation, ranged ? fmin(bias_gap_from(b), b->range_hi) : z,
                           ranged ? b->range_hi : z);
    }
    if ((b->when & INVERSE) && !ranged)
        r->apart = need_from(b, "", 0.0, z, z);
    if (b->each.triangles != NULL && !ranged)
        r->guarantee = each_setup_guarantee(&b->each, z);
    if (!ranged)
        r->effect = b->o->remedy != NULL ? remedy_at(setup, b->o->remedy, b->o->amount, z)
                                         : bias_at(setup, &state, b->o->bias.slope, z);
    r->one_unit = r->effect.limited ? (double)NAN : fabs(r->effect.shift);
    r->held = !r->effect.limited ? "" : b->o->remedy != NULL ? "clipped" : "clamped to a plane";
    b->limited = b->limited || r->effect.limited;
    if (b->when & SEVERAL)
        write_call(b, r);
}

/* Place by place, API by API. */
static void *next_row(void *of, size_t i) {
    biasing *b = of;
    const bias_asked *asked = &b->o->bias;
    double z = (double)NAN;
    size_t apis = 0;
    while (bias_asked_api(asked, apis) != NULL)
        apis++;
    if (b->when & ONE_API ? !each_setup_depth(&b->each, i, &z)
                          : i / apis == (b->when & OF_RANGE ? 1 : b->each.at.count) || output_failed(&b->each.out))
        return NULL;
    if (b->when & SEVERAL)
        take_api(b, bias_asked_api(asked, i % apis));
    if (b->when & OF_DEPTHS)
        z = depths_get(&b->each.at, i / apis);
    fill_row(b, z, &b->row);
    return &b->row;
}

/* API by API for all set-ups at once. */
static void *next_beside(void *of, size_t i) {
    biasing *b = of;
    const bias_api *api = bias_asked_api(&b->o->bias, i);
    if (api == NULL)
        return NULL;
    for (size_t k = 0; k < b->each.all.count; k++) {
        b->each.setup = &b->each.all.items[k];
        take_api(b, api);
        fill_row(b, b->when & OF_RANGE ? (double)NAN : depths_get(&b->each.at, 0), &b->row);
        append(memset(b->row.beside[k], 0, NUMBER_SIZE), NUMBER_SIZE, "%s", bias_short(b->row.gap.units).text);
        b->fails = b->fails || isnan(b->row.gap.units);
    }
    return &b->row;
}

static void *next_setup(void *of, size_t i) {
    biasing *b = of;
    if (!each_setup_go(&b->each, i))
        return NULL;
    b->limited = false;
    take_api(b, bias_asked_api(&b->o->bias, 0));
    if ((b->when & INVERSE) && (b->when & ONE_API) && b->o->out.form != FORM_CSV)
        take_range(b);
    if (b->when & EFFECT)
        judge(b);
    return b;
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

static const column row_columns[] = {
    {FIELD(bias_row, api, "api", ""), .only = AS_JSON | AS_CSV, .when = SEVERAL},
    {FIELD(bias_row, z, "z", "scene"), SHOWN("z", 11, DIGITS_Z), .when = ONE_API},
    {FIELD(bias_row, z, "z", "scene"), .when = OF_DEPTHS},
    {TEXT_FIELD(bias_row, z, "z", 12, DIGITS_Z), .when = OF_PLACES},
    {TEXT_FIELD(bias_row, api, "api", -16, 0), .when = SEVERAL},
    {FIELD(bias_row, gap.lo, "lo", "scene"), .when = OF_RANGE},
    {FIELD(bias_row, gap.hi, "hi", "scene"), .when = OF_RANGE},
    {FIELD(bias_row, effect.r.least, "r", ""), SHOWN("r", 12, DIGITS), .when = ONE_API | OF_BIAS},
    {FIELD(bias_row, effect.r.most, "r_most", ""), .when = ONE_API | OF_BIAS},
    {FIELD(bias_row, effect.r.least, "r", ""), .when = OF_DEPTHS},
    {FIELD(bias_row, effect.r.most, "r_most", ""), .when = OF_DEPTHS},
    {FIELD(bias_row, effect.m, "slope", "per pixel"), .when = ONE_API | OF_BIAS},
    {TEXT_FIELD(bias_row, effect.m, "slope", 12, DIGITS), .when = ONE_API | WITH_SLOPE, .spare = 2},
    {FIELD(bias_row, one_unit, "one_unit", "scene"), SHOWN("one unit", 13, DIGITS), .when = ONE_API | INVERSE},
    {FIELD(bias_row, apart.units, "units_apart", ""), SHOWN("resolved", 17, DIGITS_Z), .outward = true,
     .when = ONE_API | INVERSE},
    {FIELD(bias_row, gap.units, "units_gap", ""), .only = AS_CSV, .when = ONE_API | INVERSE},
    {FIELD(bias_row, gap.units, "units_gap", ""), SHOWN("separated", 17, DIGITS_Z), .outward = true,
     .only = AS_JSON | AS_TEXT, .when = ONE_API | INVERSE | WITH_GAP},
    {TEXT_FIELD(bias_row, guarantee.facing, "facing", 11, DIGITS_SHORT), .upward = true,
     .when = ONE_API | INVERSE | WITH_TRIANGLES},
    GUARANTEES(bias_row, guarantee.facing, guarantee.slanted, 11, DIGITS_SHORT, ONE_API | INVERSE | WITH_TRIANGLES),
    {FIELD(bias_row, effect.offset, "bias", ""), SHOWN("bias", 12, DIGITS), .when = EFFECT, .spare = 1},
    {FIELD(bias_row, effect.depth, "depth", ""), .when = EFFECT},
    {FIELD(bias_row, effect.code, "code", ""), SHOWN("code", 11, 0), .when = EFFECT},
    {FIELD(bias_row, effect.moved, "code_moved", ""), SHOWN("moved to", 11, 0), .when = EFFECT},
    {FIELD(bias_row, effect.to, "z_moved", "scene"), SHOWN("decoded depth", 18, DIGITS_Z + 1), .when = EFFECT},
    {FIELD(bias_row, effect.shift, "shift", "scene"), SHOWN("shift", 12, DIGITS), .when = EFFECT},
    {FIELD(bias_row, effect.limited, "limited", ""), .only = AS_JSON, .when = EFFECT},
    {TEXT_FIELD(bias_row, held, "", -1, 0), .when = ONE_API | VERBOSE},
    {FIELD(bias_row, guarantee.certain, "certain", ""), .when = ONE_API | INVERSE | WITH_TRIANGLES},
    {FIELD(bias_row, gap.units, "units", ""), .when = SEVERAL},
    {FIELD(bias_row, factor, "factor", ""), .when = SEVERAL | WITH_TRIANGLES},
    {FIELD(bias_row, gap.z, "units_z", "scene"), .when = OF_RANGE},
    {FIELD(bias_row, gap.from, "from", "scene"), .when = OF_RANGE},
    {FIELD(bias_row, gap.to, "to", "scene"), .when = OF_RANGE},
    {FIELD(bias_row, call, "call", ""), .when = SEVERAL},
    {TEXT_FIELD(bias_row, said, "to write", -1, 0), .when = SEVERAL},
    {.kind = COLUMN_END}};

static const column range_columns[] = {{FIELD(biasing, over.lo, "lo", "scene")},
                                       {FIELD(biasing, over.hi, "hi", "scene")},
                                       {FIELD(biasing, over.units, "units_apart", "")},
                                       {FIELD(biasing, over.z, "units_apart_z", "scene")},
                                       {FIELD(biasing, over.from, "apart_from", "scene")},
                                       {FIELD(biasing, over.to, "apart_to", "scene")},
                                       {FIELD(biasing, over.next, "units_apart_next", "")},
                                       {FIELD(biasing, gap_over.lo, "gap_lo", "scene"), .when = WITH_GAP},
                                       {FIELD(biasing, gap_over.units, "units_gap", ""), .when = WITH_GAP},
                                       {FIELD(biasing, gap_over.next, "units_gap_next", ""), .when = WITH_GAP},
                                       {FIELD(biasing, gap_over.z, "units_gap_z", "scene"), .when = WITH_GAP},
                                       {FIELD(biasing, gap_over.from, "gap_from", "scene"), .when = WITH_GAP},
                                       {FIELD(biasing, gap_over.to, "gap_to", "scene"), .when = WITH_GAP},
                                       {FIELD(biasing, shift_lo, "shift_lo", "scene")},
                                       {FIELD(biasing, shift_hi, "shift_hi", "scene")},
                                       {.kind = COLUMN_END}};

static const column setup_report[] = {
    {PART(biasing, each.fields, NULL, setup_columns)},
    {FIELD(biasing, apis, "api", ""), .only = AS_CSV, .when = ONE_API | OF_BIAS},
    {FIELD(biasing, o_remedy, "remedy", ""), .only = AS_CSV, .when = BIAS_OF_REMEDY},
    {FIELD(biasing, state.factor, "factor", ""), .when = ONE_API | WITH_TRIANGLES | OF_BIAS},
    {LIST("rows", row_columns, next_row)},
    {GROUP("range", range_columns), .only = AS_JSON, .when = ONE_API | INVERSE},
    {PART(biasing, facing, "facing", bias_judged_columns), .only = AS_JSON, .when = EFFECT},
    {PART(biasing, sloped, "sloped", bias_judged_columns), .only = AS_JSON, .when = EFFECT | OF_SLOPES},
    {PART(biasing, pushed, "push", bias_pushed_columns), .only = AS_JSON, .when = EFFECT},
    {PART(biasing, trial, "drawn", bias_trial_columns), .only = AS_JSON, .when = DRAWN},
    {.kind = COLUMN_END}};

static const column columns[] = {
    {FIELD(biasing, apis, "api", ""), .only = AS_JSON, .when = OF_BIAS},
    {FIELD(biasing, o_remedy, "remedy", ""), .only = AS_JSON, .when = BIAS_OF_REMEDY},
    {FIELD(biasing, amount, "amount", ""), .only = AS_JSON, .when = BIAS_OF_REMEDY},
    {FIELD(biasing, units, "units", ""), .only = AS_JSON, .when = ONE_API | OF_BIAS},
    {FIELD(biasing, factor, "factor", ""), .only = AS_JSON, .when = ONE_API | OF_BIAS},
    {FIELD(biasing, state.clamp, "clamp", ""), .only = AS_JSON, .when = ONE_API | OF_BIAS},
    {FIELD(biasing, slope, "slope", ""), .only = AS_JSON, .when = OF_BIAS},
    {FIELD(biasing, factor, "factor", ""), .only = AS_JSON, .when = SEVERAL},
    {FIELD(biasing, gap, "gap", "scene"), .only = AS_JSON},
    {PART(biasing, each.triangles, "triangles", slant_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {LIST("setups", setup_report, next_setup), .head = bias_say_setup, .notes = bias_say_notes},
    {.kind = COLUMN_END}};

static int write_beside(biasing *b, int status) {
    column rows[BESIDE + 2] = {{TEXT_FIELD(bias_row, api, "", -WIDTH_API, 0)}};
    for (size_t k = 0; k < b->each.all.count; k++) {
        const char *mapping = dp_mapping_get(b->each.all.items[k].spec.mapping)->name;
        rows[k + 1] = (column){TEXT_FIELD(bias_row, beside[0], mapping, WIDTH_UNITS, 0)};
        rows[k + 1].offset = offsetof(bias_row, beside[k]);
    }
    rows[b->each.all.count + 1] = (column){.kind = COLUMN_END};
    const column list[] = {{LIST(NULL, rows, next_beside), .head = bias_say_beside, .notes = bias_say_calls},
                           {.kind = COLUMN_END}};
    const report_spec spec = {"bias", list, b, .label = 14};
    return each_setup_write(&b->each, &spec, status);
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

/* No bias can be about a viewport with a mapping that is not affine; without one the codes are counted, whatever the
 * arithmetic before them. */
static int check_slant(const bias_request *o) {
    if (o->camera.triangles.width == 0 && camera_names_arith(&o->camera))
        return option_error("arith", "needs --viewport: surfaces that face the camera are told apart by codes alone");
    for (size_t i = 0; i < o->camera.mapping_count && o->camera.triangles.width > 0; i++)
        if (dp_mapping_get(o->camera.mappings[i])->curve != DP_CURVE_PERSPECTIVE)
            return option_error("viewport", "does not apply to %s, which is not affine on the screen",
                                dp_mapping_get(o->camera.mappings[i])->name);
    return EXIT_FINE;
}

static int check_one(const bias_request *o, const bias_api *api) {
    const bool given = option_given(o->line, "units");
    const platform *by = o->camera.platform;
    if (given && api->whole && !isinf(o->bias.units) &&
        !(o->bias.units == nearbyint(o->bias.units) && fabs(o->bias.units) <= 0x1.fffffffcp30) &&
        (by == NULL || !by->cuts))
        return option_error("units", "must be a whole number from -2147483647 to 2147483647 for %s, got %s", api->name,
                            number_full(o->bias.units).text);
    if (option_given(o->line, "clamp") && !api->clamps)
        return option_error("clamp", "must not be given for %s, which has no clamp",
                            by != NULL && by->drops_clamp ? by->name : api->name);
    if (option_given(o->line, "clamp") && !given)
        return option_error("clamp", "must be given together with --units");
    camera_fault fault = {.key = NULL};
    return camera_range_suits(api, o->camera.depth_range, &fault) ? EXIT_FINE : camera_refuse(&fault);
}

static int check_several(const bias_request *o) {
    if (option_given(o->line, "units") || option_given(o->line, "clamp"))
        return option_error("api", "must be one API with --%s, got '%s'",
                            option_given(o->line, "units") ? "units" : "clamp", option_text(o->line, "api"));
    if (option_given(o->line, "at") && option_given(o->line, "range"))
        return option_error("range", "conflicts with --at for all APIs");
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

/* As a platform sends units, and as 32 bits hold them. */
static double units_sent(const bias_request *o, const bias_api *api) {
    const bool cuts = o->camera.platform != NULL && o->camera.platform->cuts;
    double units = cuts ? trunc(o->bias.units) : o->bias.units;
    if (isinf(units) && api->whole)
        units = units > 0.0 ? INT32_MAX : INT32_MIN;
    return units;
}

/* The set-ups as the rasterizer has them, and with them those that are judged. */
static int take_drawn(biasing *b) {
    const bias_request *o = b->o;
    if (!o->drawn)
        return EXIT_FINE;
    if (o->render != NULL && canvas_format_of(o->render) != CANVAS_PNG)
        return option_error("render", "must end in .png, got '%s'", o->render);
    if (o->render != NULL && b->each.all.count > 1)
        return option_error("render", "shows one format and mapping, got %zu", b->each.all.count);
    const int status = raster_setups(&o->camera, &b->drawn);
    for (size_t i = 0; status == EXIT_FINE && i < b->drawn.count; i++) {
        dp_spec spec = b->drawn.items[i].spec;
        spec.model = DP_MODEL_EXACT;
        dp_setup_init(&b->each.all.items[i], &spec);
    }
    return status == EXIT_FINE && o->render != NULL ? output_check(o->render) : status;
}

/* The conditions of columns, but for how many places there are. */
static unsigned conditions(const bias_request *o) {
    const unsigned of_several = SEVERAL | (option_given(o->line, "at") ? OF_DEPTHS : OF_RANGE);
    return (option_given(o->line, "units") || o->remedy != NULL ? EFFECT : INVERSE) |
           (o->remedy != NULL ? BIAS_OF_REMEDY : OF_BIAS) | (o->bias.api == NULL ? of_several : ONE_API) |
           (o->bias.separation > 0.0 ? WITH_GAP : 0) | (o->bias.slope > 0.0 ? WITH_SLOPE : 0) |
           (o->bias.slope > 0.0 || o->camera.triangles.width > 0 ? OF_SLOPES : 0) | (o->out.full ? VERBOSE : 0) |
           (o->camera.triangles.width > 0 ? WITH_TRIANGLES : 0) | (o->drawn ? DRAWN : 0);
}

/* Several APIs, a few set-ups, one place: whether they stand beside each other. */
static bool suits_beside(const biasing *b) {
    const bias_request *o = b->o;
    const size_t count = b->each.all.count;
    const int wide = terminal_columns(STDOUT_FILENO);
    const bool fits = wide == 0 || wide >= WIDTH_API + WIDTH_UNITS * (int)count;
    return (b->when & SEVERAL) && o->out.form == FORM_TEXT && !o->out.full && count > 1 && count <= BESIDE &&
           ((b->when & OF_RANGE) || b->each.at.count == 1) && b->each.triangles == NULL && fits &&
           o->camera.gpu.measured[0] == '\0'; /* what was measured is told of each format */
}

int cmd_bias(void *request) {
    const bias_request *o = request;
    const bias_api *api = o->bias.api;
    const bool given = option_given(o->line, "units") || o->remedy != NULL;
    biasing b = {.o = o,
                 .when = conditions(o),
                 .chosen = chooses_factor(o),
                 .state = {.clamp = o->bias.clamp},
                 .gap = given && o->bias.separation == 0.0 ? (double)NAN : o->bias.separation,
                 .slope = o->bias.slope,
                 .o_remedy = o->remedy != NULL ? o->remedy->name : NULL,
                 .amount = o->remedy != NULL && o->remedy->amount[0] != '\0' ? o->amount : (double)NAN};
    int status = check_slant(o);
    if (status != EXIT_FINE)
        return status;
    b.api = platform_bias(o->camera.platform, bias_asked_api(&o->bias, 0));
    b.apis = api != NULL ? api->name : option_text(o->line, "api");
    b.units_sent = units_sent(o, &b.api);
    b.units = !option_given(o->line, "units") ? (double)NAN : isinf(o->bias.units) ? b.units_sent : o->bias.units;
    b.factor = b.chosen ? (double)NAN : o->bias.factor;
    status = api != NULL ? check_one(o, &b.api) : check_several(o);
    if (status != EXIT_FINE)
        return status;
    status = each_setup_start(&b.each, &o->camera, &o->out);
    if (status == EXIT_FINE)
        status = resolve(&b, o);
    if (status == EXIT_FINE)
        status = take_drawn(&b);
    if (status == EXIT_FINE)
        status = bias_check_remedy(o->line, o->remedy, &b.each.all);
    if ((b.when & OF_DEPTHS) && b.each.at.count > 1)
        b.when |= OF_PLACES;
    if (suits_beside(&b))
        return write_beside(&b, status);
    const report_spec spec = {"bias", columns, &b, .when = b.when, .label = api != NULL ? 12 : 14};
    status = each_setup_write(&b.each, &spec, status);
    setups_release(&b.drawn);
    status = status == EXIT_FINE ? b.status : status;
    return status == EXIT_FINE && o->checked && b.missed ? EXIT_FAILED : status;
}
