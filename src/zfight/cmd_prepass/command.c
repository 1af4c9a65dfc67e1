/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * prepass: a depth prepass by one vertex program and a main pass by another. How many vertices get different
 * codes, whether EQUAL is safe, and the bias of the main pass that makes LEQUAL safe (GEQUAL where reversed).
 */
#include <math.h>
#include <stdlib.h>

#include "bias/cmd_bias/call.h"
#include "camera/cmd/each_setup.h"
#include "report/number.h"
#include "zfight/cmd_prepass/request.h"

enum { DIGITS = 6 };
static const double most_z = 1e38;

/* The units by which an API makes up for a difference; NaN where none are enough. */
typedef struct api_bias {
    const char *api;
    double units;
} api_bias;

typedef struct line {
    const char *program;
    const vertex_difference *found;
    double share; /* percent; NaN where no vertex was counted */
    double bias;  /* window depth */
    api_bias api;
} line;

/* Below `line`, what belongs to the set-up at hand. */
typedef struct prepass {
    each_setup each;
    const prepass_request *o;
    vertex_request request;
    vertex_difference (*results)[VERTEX_OTHERS]; /* one of each set-up */
    const char *program, *vertices;
    uint64_t before;
    line line;
    size_t setup;
} prepass;

/* ---- What is asked ----------------------------------------------------------------------------------------------- */

static int check(prepass *a) {
    const prepass_request *o = a->o;
    vertex_request *r = &a->request;
    int status = setups_make_float(&o->camera, &a->each.all);
    if (status == EXIT_FINE)
        status = range_resolve(&o->camera, &r->lo, &r->hi);
    if (status == EXIT_FINE && isinf(r->hi))
        status = option_error("range", "must be given when far is inf: eye depths of vertices lie in it");
    if (status == EXIT_FINE && r->hi > most_z)
        status = option_error("range", "must end at 1e38 at most, so that positions are binary32 numbers, got %s",
                              number_full(r->hi).text);
    if (status == EXIT_FINE && r->spread == VERTEX_EYE_LOG && !(r->lo > 0.0))
        status = option_error("vertices", "must be box where depths of 0 or less are drawn, got '%s'",
                              vertex_spread_name(r->spread));
    return status;
}

static void tick(void *context, uint64_t done) {
    prepass *a = context;
    progress_step(&a->each.progress, a->before + done);
}

static int work(prepass *a) {
    bool fine = true;
    a->results = calloc(a->each.all.count, sizeof *a->results);
    a->each.progress = progress_start("vertices", a->each.all.count * a->request.count, a->o->out.quiet);
    for (size_t i = 0; i < a->each.all.count && fine; i++) {
        a->request.setup = &a->each.all.items[i];
        fine = a->results != NULL && vertex_compare(&a->request, a->results[i]);
        a->before += a->request.count;
    }
    progress_end(&a->each.progress);
    return fine ? EXIT_FINE : usage_error("no memory to compare the programs");
}

/* ---- What is reported -------------------------------------------------------------------------------------------- */

/* The units that suffice for all vertices: r is the same for all, or goes with the exponent of the depth. */
static api_bias bias_for(const dp_setup *setup, const bias_api *api, const vertex_difference *d) {
    const dp_format *format = &setup->spec.format;
    const double widest = bias_units(api, format, d->widest.depth, d->widest.bias);
    const double steepest = bias_units(api, format, d->steepest.depth, d->steepest.bias);
    return (api_bias){api->name, bias_signed(setup, fmax(widest, steepest))};
}

static void *next_api(void *of, size_t i) {
    prepass *a = of;
    const bias_api *api = bias_api_get(i);
    if (api == NULL)
        return NULL;
    a->line.api = bias_for(a->each.setup, api, a->line.found);
    return &a->line.api;
}

static void *next_program(void *of, size_t i) {
    prepass *a = of;
    if (i == a->request.others)
        return NULL;
    const vertex_difference *d = &a->results[a->setup][i];
    const double share = 100.0 * (double)d->differ / (double)d->vertices;
    a->line = (line){.program = a->request.other[i]->name,
                     .found = d,
                     .share = d->vertices > 0 ? share : (double)NAN,
                     .bias = d->widest.bias};
    return a;
}

static void *next_setup(void *of, size_t i) {
    prepass *a = of;
    a->setup = i;
    return each_setup_go(&a->each, i) ? a : NULL;
}

/* The greatest of all programs, as if it were one. */
static vertex_difference worst_of(const prepass *a) {
    vertex_difference worst = a->results[a->setup][0];
    for (size_t i = 1; i < a->request.others; i++) {
        const vertex_difference *d = &a->results[a->setup][i];
        worst.differ += d->differ;
        worst.most = d->most > worst.most ? d->most : worst.most;
        worst.widest = d->widest.bias > worst.widest.bias ? d->widest : worst.widest;
    }
    return worst;
}

static void say_answer(page *p, void *item) {
    const prepass *a = item;
    const vertex_request *r = &a->request;
    const vertex_difference worst = worst_of(a);
    each_setup_title(p, item);
    page_title(p, "%llu vert%s from z = %s to %s: %s; camera within +-%s; seed %llu",
               (unsigned long long)worst.vertices, worst.vertices == 1 ? "ex" : "ices",
               camera_length(a->each.here, r->lo, 0).text, camera_length(a->each.here, r->hi, 0).text,
               vertex_spread_note(r->spread), camera_length(a->each.here, r->world, 0).text,
               (unsigned long long)r->seed);
    if (worst.vertices == 0)
        page_text(p, "None of the random vertices lies within the range.");
    else if (worst.differ == 0)
        page_text(p, "EQUAL is safe on these vertices: each gets the same code as from %s.", a->program);
    else
        page_text(p, "EQUAL is not safe: a depth prepass and a main pass must run the same program, and be compiled to "
                     "the same operations (invariant in GLSL, precise in HLSL).");
}

static void say_apis(page *p, void *item) {
    const prepass *a = item;
    const vertex_difference worst = worst_of(a);
    if (worst.differ == 0)
        return;
    page_line(p,
              "%s is safe on these vertices if the main pass is moved towards the camera by %s of window depth, %u "
              "code%s, whichever of the programs it runs:",
              a->each.setup->reversed ? "GEQUAL" : "LEQUAL", number_up(worst.widest.bias, 3).text, worst.most,
              worst.most == 1 ? "" : "s");
    for (size_t i = 0; bias_api_get(i) != NULL; i++) {
        double units = 0.0;
        for (size_t k = 0; k < a->request.others; k++) {
            const double one = bias_for(a->each.setup, bias_api_get(i), &a->results[a->setup][k]).units;
            units = isnan(one) || fabs(one) > fabs(units) ? one : units;
        }
        page_note(p, bias_api_get(i)->name, "%s",
                  isnan(units) ? "no bias suffices" : bias_call(bias_api_get(i), units, 0.0).text);
    }
    if (a->each.setup->spec.format.kind == DP_FORMAT_FLOAT)
        page_line(p, "In a float format units shrink with the window depth: vertices next to d = 0 need the most; "
                     "--range leaves them out.");
    page_line(p, "Between vertices, triangle setup adds to that: see budget --viewport.");
}

static const column api_columns[] = {
    {FIELD(api_bias, api, "api", "")}, {FIELD(api_bias, units, "units", "")}, {.kind = COLUMN_END}};

static const column found_columns[] = {{FIELD(vertex_difference, vertices, "vertices", "")},
                                       {FIELD(vertex_difference, differ, "differ", "")},
                                       {.kind = COLUMN_END}};

static const column code_columns[] = {
    {FIELD(vertex_difference, percentile, "percentile_99", ""), SHOWN("99 % within", 13, 0)},
    {FIELD(vertex_difference, most, "most", ""), SHOWN("most codes", 12, 0)},
    {FIELD(vertex_difference, most_z, "most_z", "scene"), SHOWN("at z", 11, DIGITS)},
    {.kind = COLUMN_END}};

static const column program_columns[] = {
    {FIELD(prepass, line.program, "against", ""), SHOWN("against", -14, 0)},
    {PART(prepass, line.found, NULL, found_columns), .pointed = true, .only = AS_JSON | AS_CSV},
    {TEXT_FIELD(prepass, line.share, "differ %", 10, 4), .fixed = true},
    {PART(prepass, line.found, NULL, code_columns), .pointed = true},
    {FIELD(prepass, line.bias, "bias", ""), SHOWN("bias", 12, DIGITS), .upward = true},
    {LIST("bias_units", api_columns, next_api), .only = AS_JSON},
    {.kind = COLUMN_END}};

static const column drawn_columns[] = {{FIELD(vertex_request, lo, "lo", "scene")},
                                       {FIELD(vertex_request, hi, "hi", "scene")},
                                       {FIELD(vertex_request, world, "from_origin", "scene")},
                                       {FIELD(vertex_request, count, "drawn", "")},
                                       {FIELD(vertex_request, seed, "seed", "")},
                                       {.kind = COLUMN_END}};

static const column setup_report[] = {{PART(prepass, each.fields, NULL, setup_columns)},
                                      {FIELD(prepass, each.fields.arith, "arith", ""), .only = AS_CSV},
                                      {FIELD(prepass, program, "program", "")},
                                      {FIELD(prepass, vertices, "distribution", "")},
                                      {PART(prepass, request, NULL, drawn_columns)},
                                      {LIST("programs", program_columns, next_program), .notes = say_apis, .indent = 2},
                                      {.kind = COLUMN_END}};

static const column columns[] = {{LIST("setups", setup_report, next_setup), .head = say_answer, .verdict = true},
                                 {.kind = COLUMN_END}};

int cmd_prepass(void *request) {
    const prepass_request *o = request;
    if (o->stored.count > 0)
        return prepass_stored(o);
    prepass a = {.o = o,
                 .each = {.camera = &o->camera, .how = &o->out},
                 .program = o->program->name,
                 .vertices = vertex_spread_name((vertex_spread)o->vertices),
                 .request = {.spread = (vertex_spread)o->vertices,
                             .world = o->world,
                             .count = o->sample,
                             .seed = o->seed,
                             .threads = o->out.threads,
                             .base = o->program,
                             .others = o->against_count,
                             .progress = tick}};
    a.request.context = &a;
    for (size_t i = 0; i < o->against_count; i++)
        a.request.other[i] = o->against[i];
    int status = check(&a);
    if (status == EXIT_FINE)
        status = output_ready(&o->out);
    if (status == EXIT_FINE)
        status = work(&a);
    status = each_setup_write(&a.each, &(report_spec){"prepass", columns, &a, .label = 14}, status);
    free(a.results);
    return status;
}
