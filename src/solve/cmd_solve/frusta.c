/* SPDX-License-Identifier: GPL-3.0-or-later */
/* solve --for frusta: how few frusta, one behind the other, keep a separation everywhere; and where their planes lie.
 */
#include <math.h>
#include <stdio.h>

#include "camera/cmd/setups.h"
#include "camera/cmd/slant.h"
#include "solve/cmd_solve/report.h"
#include "solve/cmd_solve/request.h"
#include "solve/frusta.h"

static const double fixed_ratio = 1000.0; /* CesiumJS, updateFrustums() of View.js; without logarithmic depth */

typedef struct frustum_line {
    frustum found;
    char near_text[NUMBER_SIZE], far_text[NUMBER_SIZE]; /* as they must be typed in */
} frustum_line;

typedef struct planning {
    const solve_request *o;
    dp_setup setup;
    setup_fields fields;
    frusta_plan plan, fixed;
    uint64_t count, at_least, fixed_count; /* fixed_count is 0 where there is no such plan */
    double limit, ratio, fixed_value, fixed_z, stuck;
    double slanted;  /* how many at any slant; 0: no plan was found; NaN: nothing is guaranteed, or the lattice asked */
    dp_spec assumed; /* in which view that is */
    bool possible;
    const char *target;
    frustum_line line;
} planning;

/* ---- What is asked ----------------------------------------------------------------------------------------------- */

static int check_frusta(const solve_request *o) {
    if (!option_given(o->line, "separation"))
        return option_error("separation", "must be given, to solve for frusta");
    if (!(option_given(o->line, "far") || camera_says_planes(&o->camera.said)) || isinf(o->camera.zfar))
        return option_error("far", "must be finite, to solve for frusta: nothing is resolved at an infinite far plane");
    if (o->camera.format_count != 1)
        return option_error("format", "must be one format, to solve for frusta, got %zu", o->camera.format_count);
    if (o->camera.mapping_count != 1)
        return option_error("mapping", "must be one mapping, to solve for frusta, got %zu", o->camera.mapping_count);
    return EXIT_FINE;
}

static dp_spec spec_of(const solve_request *o) {
    const bool chosen = option_given(o->line, "model") && !o->camera.model_auto;
    const bool linear = dp_mapping_get(o->camera.mappings[0])->curve == DP_CURVE_LINEAR;
    dp_spec spec = camera_to_spec(&o->camera.said);
    if (!chosen)
        spec.model = linear ? DP_MODEL_STAGED : DP_MODEL_FLOAT;
    return spec;
}

/* ---- The report -------------------------------------------------------------------------------------------------- */

static void *next_frustum(void *of, size_t i) {
    planning *p = of;
    if (i >= p->plan.count)
        return NULL;
    p->line.found = p->plan.frusta[i];
    number_shortest(p->line.found.znear, p->line.near_text);
    number_shortest(p->line.found.zfar, p->line.far_text);
    return &p->line;
}

/* Which of the two forbids one frustum, or any plan: the lattice, or the arithmetic before it. */
static void say_why(page *p, const planning *x) {
    const dp_spec *spec = &x->setup.spec;
    const char *unit = camera_unit(&x->o->camera);
    const double near = x->possible ? (double)NAN : frusta_lattice_near(spec, x->stuck, x->limit);
    const quantity_worst one = frusta_lattice(spec, x->limit);
    const number_text z = number_in(number_of(one.z, SOLVE_DIGITS), unit);
    number_text value = {"nothing"};
    if (isfinite(one.value))
        value = number_in(number_up(one.value, SOLVE_DIGITS), unit);
    if (!x->possible && x->plan.count == FRUSTA_MAX)
        return;
    if (!x->possible && isnan(near))
        page_note(p, "why", "the lattice alone forbids it, before any arithmetic");
    else if (!x->possible)
        page_note(p, "why", "the lattice alone allows it from near %s on: binary32 arithmetic forbids it",
                  number_in(number_up(near, SOLVE_DIGITS), unit).text);
    else if (x->count > 1 && one.passed)
        page_note(p, "why", "the lattice alone would allow one frustum: %s at z = %s; binary32 arithmetic forbids it",
                  value.text, z.text);
    else if (x->count > 1)
        page_note(p, "why", "the lattice alone forbids one frustum: it resolves %s at z = %s", value.text, z.text);
}

static void say_plan(page *p, void *item) {
    const planning *x = item;
    const dp_spec *spec = &x->setup.spec;
    const char *unit = camera_unit(&x->o->camera);
    const number_text limit = camera_length(&x->o->camera, x->limit, 0),
                      near = camera_length(&x->o->camera, spec->znear, 0),
                      far = camera_length(&x->o->camera, spec->zfar, 0);
    const char *format = spec->format.name, *mapping = dp_mapping_get(spec->mapping)->name;
    const char *const facing = isnan(x->slanted) ? "" : " " SLANT_FACING;
    const unsigned long long count = x->count, at_least = x->at_least;
    char slanted[NUMBER_SIZE] = "", view[SLANT_ASSUMED_SIZE];
    if (x->slanted > 0.0)
        snprintf(slanted, sizeof slanted, "; at any slant %.0f do%s", x->slanted, x->slanted == 1.0 ? "es" : "");
    else if (x->slanted == 0.0)
        snprintf(slanted, sizeof slanted, "; at any slant none do");
    if (!x->possible && x->plan.count == FRUSTA_MAX)
        page_text(p, "No plan: %d frusta of %s %s do not suffice to resolve %s from z = %s to %s.", FRUSTA_MAX, format,
                  mapping, limit.text, near.text, far.text);
    else if (!x->possible)
        page_text(p, "No plan was found: up to far %s no near plane of those searched lets %s %s resolve %s.",
                  number_in(number_full(x->stuck), unit).text, format, mapping, limit.text);
    else
        page_text(p, "%llu %s of %s %s %s %s%s from z = %s to %s%s%s.", count, count == 1 ? "frustum" : "frusta",
                  format, mapping, count == 1 ? "resolves" : "resolve", limit.text, facing, near.text, far.text,
                  count == 1          ? ""
                  : count == at_least ? "; fewer cannot"
                                      : "",
                  slanted);
    if (x->possible && count != at_least && at_least > 1)
        page_note(p, "at least", "%llu frusta, whatever the arithmetic", at_least);
    say_why(p, x);
    if (x->fixed_count > 0)
        page_note(p, "ratio 1000", "%llu %s, separation %s at z = %s", (unsigned long long)x->fixed_count,
                  x->fixed_count == 1 ? "frustum" : "frusta",
                  number_in(number_up(x->fixed_value, SOLVE_DIGITS), unit).text,
                  number_in(number_of(x->fixed_z, SOLVE_DIGITS), unit).text);
    if (x->slanted >= 0.0)
        page_note(p, "any slant", "of a viewport of %s", slant_assumed(&x->assumed.triangles, view));
    page_note(p, "model", "%s", option_word("model", spec->model));
    if (x->plan.count > 0)
        output_text(p->out, "\n");
}

static void write_plan(planning *x, output *out) {
    static const column frustum_columns[] = {
        {TEXT_FIELD(frustum_line, near_text, "near", 14, 0), .only = AS_TEXT},
        {TEXT_FIELD(frustum_line, far_text, "far", 14, 0), .only = AS_TEXT},
        {FIELD(frustum_line, found.znear, "near", "scene")},
        {FIELD(frustum_line, found.zfar, "far", "scene")},
        {FIELD(frustum_line, found.reached.value, "separation", "scene"), SHOWN("separation", 14, SOLVE_DIGITS),
         .upward = true},
        {FIELD(frustum_line, found.reached.z, "z", "scene"), SHOWN("at z", 14, SOLVE_DIGITS)},
        {.kind = COLUMN_END}};
    static const column fixed_columns[] = {{FIELD(planning, ratio, "ratio", "")},
                                           {FIELD(planning, fixed_count, "count", "")},
                                           {FIELD(planning, fixed_value, "separation", "scene")},
                                           {FIELD(planning, fixed_z, "z", "scene")},
                                           {.kind = COLUMN_END}};
    const column columns[] = {{FIELD(planning, target, "for", ""), .only = AS_JSON},
                              {PART(planning, fields, NULL, setup_columns), .only = AS_JSON},
                              {FIELD(planning, limit, "limit", "scene"), .only = AS_JSON},
                              {FIELD(planning, possible, "possible", ""), .only = AS_JSON},
                              {FIELD(planning, count, "count", ""), .only = AS_JSON},
                              {FIELD(planning, at_least, "at_least", ""), .only = AS_JSON},
                              {FIELD(planning, slanted, "any_slant_count", ""), .only = AS_JSON},
                              {FIELD(planning, stuck, "stuck", "scene"), .only = AS_JSON},
                              {GROUP("fixed", fixed_columns), .only = AS_JSON},
                              {LIST("frusta", frustum_columns, next_frustum), .indent = 2},
                              {.kind = COLUMN_END}};
    report_write(&(report_spec){"solve", columns, x, .label = 15, .head = say_plan, .verdict = true}, out,
                 x->o->out.form);
}

/* How few at any slant. */
static double count_slanted(planning *x, const dp_spec *spec) {
    frusta_plan plan;
    if (spec->model != DP_MODEL_FLOAT || !camera_assumed(&x->o->camera.said, spec, &x->assumed) ||
        frusta_solve(&x->assumed, x->limit, &plan) != DP_OK)
        return (double)NAN;
    return plan.possible ? (double)plan.count : 0.0;
}

int solve_frusta(const solve_request *o) {
    output out;
    planning x = {
        .o = o, .limit = o->separation, .ratio = fixed_ratio, .fixed_value = (double)NAN, .fixed_z = (double)NAN};
    int status = check_frusta(o);
    if (status == EXIT_FINE)
        status = solve_check_apart(o, SOLVE_FOR_FRUSTA);
    if (status != EXIT_FINE)
        return status;
    const dp_spec spec = spec_of(o);
    const dp_status solved = frusta_solve(&spec, x.limit, &x.plan);
    if (solved != DP_OK)
        return setup_refused(&o->camera, &spec, solved);
    x.setup = (dp_setup){.spec = spec};
    x.fields = setup_fields_asked(&x.setup, &o->camera);
    x.target = option_word("for", SOLVE_FOR_FRUSTA);
    x.possible = x.plan.possible;
    x.count = x.plan.count;
    x.stuck = x.plan.stuck;
    x.slanted = count_slanted(&x, &spec);
    x.at_least = frusta_at_least(&spec, x.limit);
    if (frusta_by_ratio(&spec, fixed_ratio, &x.fixed) == DP_OK) {
        const frustum *worst = &x.fixed.frusta[x.fixed.worst];
        x.fixed_count = x.fixed.count;
        x.fixed_value = worst->reached.value;
        x.fixed_z = worst->reached.z;
    }
    status = output_start(&o->out, &o->camera, &out);
    if (status != EXIT_FINE)
        return status;
    write_plan(&x, &out);
    status = output_close(&out);
    return status == EXIT_FINE && !x.possible ? EXIT_FAILED : status;
}
