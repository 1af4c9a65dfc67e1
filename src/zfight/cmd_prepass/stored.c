/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * prepass --prepass-format, --resolve and --half: a pass that meets what a prepass stored otherwise. Whether EQUAL and
 * LEQUAL (GEQUAL where reversed) hold, and the bias that makes the latter hold.
 */
#include "zfight/cmd_prepass/stored.h"

#include <math.h>
#include <stdlib.h>

#include "bias/cmd_bias/call.h"
#include "camera/cmd/each_setup.h"
#include "convert/again.h"
#include "core/bits.h"
#include "report/number.h"
#include "zfight/cmd_prepass/request.h"

enum { DIGITS = 6 };
static const double least_depth = 0x1p-102; /* below it units of fp32 may be flushed to 0: none are enough there */

typedef struct api_bias {
    const char *api;
    double units, factor; /* NaN where no units are enough */
} api_bias;

/* What a case needs, and what of it does not exist as NaN. */
typedef struct line {
    const char *stored;
    const char *says_equal, *says_test; /* of text */
    bool equal, passes;
    double codes, unequal, fails, most, most_z;
    double pixels, bias, moves;
    again_found found;
    api_bias api;
} line;

/* Below `line`, what belongs to the set-up at hand. */
typedef struct stored {
    each_setup each;
    const prepass_request *o;
    double lo, hi;
    line (*lines)[STORED_MOST]; /* those of each set-up */
    line line;
    const line *here;
    const char *test;
} stored;

/* ---- What is found ----------------------------------------------------------------------------------------------- */

static double window_at(const dp_setup *setup, double z) {
    return isinf(z) ? setup->ends[1] : dp_window(setup, z);
}

static void find_format(const stored *a, const dp_setup *setup, const stored_case *one, line *l) {
    const double from = window_at(setup, a->lo), to = window_at(setup, a->hi);
    const again_request q = {.stored = one->format,
                             .drawn = setup->spec.format,
                             .rounding = setup->spec.rounding,
                             .lo = dp_float_down(fmin(from, to)),
                             .hi = dp_float_up(fmax(from, to)),
                             .reversed = setup->reversed != 0,
                             .threads = a->o->out.threads};
    const again_found found = again_all(&q);
    const double at = found.most_at;
    *l = (line){.found = found,
                .equal = found.unequal == 0,
                .codes = (double)found.codes,
                .unequal = (double)found.unequal,
                .fails = (double)found.fails,
                .most = found.most,
                .most_z = isnan(at) ? at : dp_eye(setup, at, 1 - at)};
}

/* On a slanted plane EQUAL fails whatever is stored: what is drawn again lies elsewhere, or is an extreme. */
static void find_resolved(const stored *a, const dp_setup *setup, const stored_case *one, line *l) {
    const double from = window_at(setup, a->lo), to = window_at(setup, a->hi), none = (double)NAN;
    *l = (line){.codes = none, .unequal = none, .fails = none, .most = none, .most_z = none};
    for (int i = 0; i < 2; i++) {
        const double depth = fmax(i == 0 ? fmin(from, to) : fmax(from, to), least_depth);
        const resolve_need need = resolve_needs(one->way, one->samples, &setup->spec.format, setup->spec.rounding,
                                                setup->reversed != 0, depth);
        again_take(&setup->spec.format, (again_gap){need.window, depth}, &l->found);
        l->pixels = need.pixels;
    }
}

/* How far the bias moves a surface at z, towards the camera. */
static double moved_by(const dp_setup *setup, double bias, double z) {
    const bias_state state = {.api = bias_api_find("d3d9"), .units = bias_sign(setup) * bias};
    return isinf(z) ? (double)NAN : fabs(bias_at(setup, &state, 0, z).shift);
}

static void find(const stored *a, const dp_setup *setup, const stored_case *one, line *l) {
    if (one->way == NULL)
        find_format(a, setup, one, l);
    else
        find_resolved(a, setup, one, l);
    l->stored = one->name;
    l->bias = l->found.widest.bias;
    l->passes = l->bias == 0 && l->pixels == 0;
    l->says_equal = l->equal ? "holds" : "fails";
    l->says_test = l->passes ? "holds" : "fails";
    l->moves = moved_by(setup, l->bias, a->hi);
}

static int work(stored *a) {
    a->lines = calloc(a->each.all.count, sizeof *a->lines);
    if (a->lines == NULL)
        return usage_error("no memory for what is found");
    for (size_t i = 0; i < a->each.all.count; i++)
        for (size_t k = 0; k < a->o->stored.count; k++)
            find(a, &a->each.all.items[i], &a->o->stored.cases[k], &a->lines[i][k]);
    return EXIT_FINE;
}

/* ---- What is reported -------------------------------------------------------------------------------------------- */

static api_bias bias_for(const dp_setup *setup, const bias_api *api, const line *l) {
    const dp_format *format = &setup->spec.format;
    const again_gap *widest = &l->found.widest, *steepest = &l->found.steepest;
    const double units = fmax(bias_units(api, format, widest->depth, widest->bias),
                              bias_units(api, format, steepest->depth, steepest->bias));
    const double signed_units = bias_signed(setup, units);
    return (api_bias){api->name, signed_units, isnan(signed_units) ? signed_units : bias_sign(setup) * l->pixels};
}

static void *next_api(void *of, size_t i) {
    stored *a = of;
    const bias_api *api = bias_api_get(i);
    if (api == NULL)
        return NULL;
    a->line.api = bias_for(a->each.setup, api, &a->line);
    return &a->line.api;
}

static void *next_line(void *of, size_t i) {
    stored *a = of;
    if (i == a->o->stored.count)
        return NULL;
    a->line = a->here[i];
    return a;
}

static void *next_setup(void *of, size_t i) {
    stored *a = of;
    if (!each_setup_go(&a->each, i))
        return NULL;
    a->here = a->lines[i];
    a->test = a->each.setup->reversed ? "GEQUAL" : "LEQUAL";
    return a;
}

/* Ways are said once, whatever they are made of. */
static void say_ways(page *p, const stored_asked *o) {
    for (size_t i = 0; i < o->count; i++) {
        bool again = false;
        for (size_t k = 0; k < i; k++)
            again = again || o->cases[k].way == o->cases[i].way;
        if (!again)
            page_note(p, o->cases[i].way->name, "%s", o->cases[i].way->note);
    }
}

static void say_stored(page *p, void *item) {
    const stored *a = item;
    const stored_asked *o = &a->o->stored;
    each_setup_title(p, item);
    if (o->cases[0].way == NULL) {
        page_title(p, "Every window depth from z = %s to %s, stored in another format by the prepass and copied to %s",
                   camera_length(a->each.here, a->lo, 0).text, camera_length(a->each.here, a->hi, 0).text,
                   a->each.setup->spec.format.name);
        return;
    }
    page_title(p, "Planes from z = %s to %s, in pixels that they cover: %s", camera_length(a->each.here, a->lo, 0).text,
               camera_length(a->each.here, a->hi, 0).text,
               o->cases[0].samples > 0 ? "samples at the standard positions, of which the prepass keeps one depth"
                                       : "two by two of them read one depth of the prepass");
    say_ways(p, o);
}

/* The calls that suffice for each of the cases. */
static void say_calls(page *p, const stored *a) {
    for (size_t i = 0; bias_api_get(i) != NULL; i++) {
        api_bias most = {.units = 0};
        for (size_t k = 0; k < a->o->stored.count; k++) {
            const api_bias one = bias_for(a->each.setup, bias_api_get(i), &a->here[k]);
            most.units = isnan(one.units) || fabs(one.units) > fabs(most.units) ? one.units : most.units;
            most.factor = fabs(one.factor) > fabs(most.factor) ? one.factor : most.factor;
        }
        page_note(p, bias_api_get(i)->name, "%s",
                  isnan(most.units) ? "no bias suffices" : bias_call(bias_api_get(i), most.units, most.factor).text);
    }
}

static void say_needs(page *p, void *item) {
    const stored *a = item;
    double bias = 0, pixels = 0;
    for (size_t k = 0; k < a->o->stored.count; k++) {
        bias = fmax(bias, a->here[k].bias);
        pixels = fmax(pixels, a->here[k].pixels);
    }
    if (bias == 0 && pixels == 0)
        return;
    if (pixels > 0)
        page_line(p,
                  "%s is safe if the pass is moved towards the camera by %s of window depth and by what depth changes "
                  "over %s pixel%s, |x| + |y|, whichever of these is stored:",
                  a->test, number_up(bias, 3).text, number_full(pixels).text, pixels > 1 ? "s" : "");
    else
        page_line(p,
                  "%s is safe if the pass is moved towards the camera by %s of window depth, whichever of these is "
                  "stored:",
                  a->test, number_up(bias, 3).text);
    say_calls(p, a);
    if (a->each.setup->spec.format.kind == DP_FORMAT_FLOAT && a->o->stored.cases[0].way == NULL)
        page_line(p, "In a float format units shrink with the window depth: depths next to d = 0 need the most; "
                     "--range leaves them out.");
    if (!isinf(a->hi))
        page_line(p, "moves: how much nearer that brings a surface at z = %s, without what its slope adds.",
                  camera_length(a->each.here, a->hi, 0).text);
    page_line(p, "Between vertices, triangle setup adds to that: see budget --viewport.");
}

static const column api_columns[] = {{FIELD(api_bias, api, "api", "")},
                                     {FIELD(api_bias, units, "units", "")},
                                     {FIELD(api_bias, factor, "factor", "")},
                                     {.kind = COLUMN_END}};

static const column line_columns[] = {
    {FIELD(stored, line.stored, "stored", ""), SHOWN("stored", -14, 0)},
    {FIELD(stored, line.equal, "equal", ""), .only = AS_JSON | AS_CSV},
    {FIELD(stored, line.passes, "passes", ""), .only = AS_JSON | AS_CSV},
    {TEXT_FIELD(stored, line.says_equal, "EQUAL", 7, 0)},
    {TEXT_FIELD(stored, line.says_test, "test", 7, 0)},
    {FIELD(stored, line.codes, "codes", ""), SHOWN("codes", 11, 0), .spare = 2},
    {FIELD(stored, line.unequal, "unequal", ""), SHOWN("unequal", 10, 0), .spare = 1},
    {FIELD(stored, line.fails, "failing", ""), SHOWN("failing", 10, 0)},
    {FIELD(stored, line.most, "most", ""), SHOWN("most", 9, 0)},
    {FIELD(stored, line.most_z, "most_z", "scene"), .only = AS_JSON | AS_CSV},
    {FIELD(stored, line.pixels, "pixels", ""), SHOWN("pixels", 8, 0)},
    {FIELD(stored, line.bias, "bias", ""), SHOWN("bias", 12, DIGITS), .upward = true},
    {FIELD(stored, line.moves, "moves", "scene"), SHOWN("moves", 11, DIGITS), .upward = true},
    {LIST("bias_units", api_columns, next_api), .only = AS_JSON},
    {.kind = COLUMN_END}};

static const column setup_report[] = {{PART(stored, each.fields, NULL, setup_columns)},
                                      {FIELD(stored, lo, "lo", "scene")},
                                      {FIELD(stored, hi, "hi", "scene")},
                                      {FIELD(stored, test, "test", "")},
                                      {LIST("cases", line_columns, next_line), .notes = say_needs, .indent = 2},
                                      {.kind = COLUMN_END}};

static const column columns[] = {{LIST("setups", setup_report, next_setup), .head = say_stored}, {.kind = COLUMN_END}};

int prepass_stored(const prepass_request *o) {
    stored a = {.o = o, .each = {.camera = &o->camera, .how = &o->out}};
    int status = setups_make_float(&o->camera, &a.each.all);
    if (status == EXIT_FINE)
        status = range_resolve(&o->camera, &a.lo, &a.hi);
    if (status == EXIT_FINE)
        status = output_ready(&o->out);
    if (status == EXIT_FINE)
        status = work(&a);
    status = each_setup_write(&a.each, &(report_spec){"prepass", columns, &a, .label = 14}, status);
    free(a.lines);
    return status;
}
