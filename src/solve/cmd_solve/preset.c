/* SPDX-License-Identifier: GPL-3.0-or-later */
/* solve with a preset whose first number is left out: which of them keep the separation, in the preset's own terms. */
#include "solve/preset.h"

#include <math.h>

#include "camera/cmd/setups.h"
#include "camera/cmd/slant.h"
#include "quantity/cmd/preset_run.h"
#include "solve/cmd_solve/report.h"
#include "solve/cmd_solve/request.h"

enum { FEWEST = 5 }; /* digits of a number of the preset */

typedef struct seeking {
    const solve_request *o;
    preset_problem problem;
    preset_answer answer;
    const char *target, *preset, *parameter;
    dp_setup setup; /* at the end that is not the first or last number of all, else at the first */
    setup_fields fields;
    double lo, hi, from, to;
    uint64_t tried;
    bool possible;
} seeking;

static int check(const solve_request *o) {
    const char *name = preset_sought(o->camera.presets[0])->name;
    if (o->target != SOLVE_FOR_ANY)
        return option_error("for", "does not apply: the preset leaves %s open, which is then solved for", name);
    if (!option_given(o->line, "separation"))
        return option_error("separation", "must be given, to solve for %s; or give the preset its %s", name, name);
    if (o->camera.format_count != 1)
        return option_error("format", "must be one format, to solve for %s, got %zu", name, o->camera.format_count);
    if (o->camera.mapping_count != 1)
        return option_error("mapping", "must be one mapping, to solve for %s, got %zu", name, o->camera.mapping_count);
    if (o->camera.at.count > 1)
        return option_error("at", "solve takes one depth, or --range LO:HI, got %zu depths", o->camera.at.count);
    if (o->camera.at.count == 0 && !option_given(o->line, "range") && isnan(camera_focus(&o->camera)))
        return option_error("at", "must be given, or --range LO:HI: %s does not say where it looks",
                            o->camera.presets[0]->name);
    return setup_kept(&o->camera, &o->camera.formats[0]);
}

static preset_problem problem_of(const solve_request *o) {
    const bool chosen = option_given(o->line, "model") && !o->camera.model_auto;
    const bool range = option_given(o->line, "range");
    preset_problem p = preset_problem_of(o->line, &o->camera, chosen);
    p.limit = o->separation;
    if (range || o->camera.at.count > 0) {
        p.lo = range ? o->camera.range_lo : o->camera.at.lo;
        p.hi = range ? o->camera.range_hi : o->camera.at.lo;
    }
    return p;
}

static void say(page *p, void *item) {
    const seeking *s = item;
    const preset_answer *a = &s->answer;
    const char *unit = camera_unit(&s->o->camera);
    const number_text limit = camera_length(&s->o->camera, s->problem.limit, 0);
    const bool slanted = s->problem.spec.triangles.width > 0, starts = a->below || !a->above;
    number_text at = number_in(number_of(s->lo, SOLVE_DIGITS), unit),
                to = number_in(number_of(s->hi, SOLVE_DIGITS), unit);
    char where[128], run[PRESET_RUN_SIZE], which[128];
    if (isnan(s->problem.lo))
        snprintf(where, sizeof where, "where %s looks", s->problem.row->name);
    else if (s->lo == s->hi)
        snprintf(where, sizeof where, "at z = %s", at.text);
    else
        snprintf(where, sizeof where, "from z = %s to %s", at.text, to.text);
    preset_run_text(&s->problem, a, FEWEST, run);
    camera_page(p, &s->o->camera);
    snprintf(which, sizeof which, "%s %s", s->problem.spec.format.name, dp_mapping_get(s->problem.spec.mapping)->name);
    page_text(p, "%s, %s: a separation of %s%s%s is %s %s %s.", s->preset, which, limit.text, slanted ? " at " : "",
              slanted ? surfaces_words(&s->problem.spec.triangles).text : "",
              s->problem.spec.model == DP_MODEL_FLOAT ? "guaranteed" : "resolved", where, run);
    if (a->below && a->below_outside)
        page_note(p, "below", "z lies outside near and far");
    if (a->above && a->above_outside)
        page_note(p, "above", "z lies outside near and far");
    if (a->possible)
        page_note(p, "planes", "near %s, far %s, z = %s at %s %s",
                  number_in(number_of(s->setup.spec.znear, 6), unit).text,
                  number_in(number_of(s->setup.spec.zfar, 6), unit).text, at.text, s->parameter,
                  preset_typed(&s->problem, a, starts ? a->from : a->to, starts, FEWEST).text);
    if (a->possible)
        page_note(p, "tried", "%zu values of %s, all of which pass", a->tried, s->parameter);
    page_note(p, "model", "%s", option_word("model", s->problem.spec.model));
    slant_say(p, page_line, &s->o->camera, &(dp_setup){.spec = s->problem.spec});
}

int solve_preset(const solve_request *o) {
    static const column columns[] = {{FIELD(seeking, target, "for", "")},
                                     {FIELD(seeking, preset, "preset", "")},
                                     {FIELD(seeking, parameter, "parameter", "")},
                                     {PART(seeking, fields, NULL, setup_columns)},
                                     {FIELD(seeking, problem.limit, "limit", "scene")},
                                     {FIELD(seeking, possible, "possible", "")},
                                     {FIELD(seeking, from, "from", "")},
                                     {FIELD(seeking, to, "to", "")},
                                     {FIELD(seeking, tried, "tried", "")},
                                     {FIELD(seeking, lo, "lo", "scene")},
                                     {FIELD(seeking, hi, "hi", "scene")},
                                     {.kind = COLUMN_END}};
    output out;
    int status = check(o);
    if (status != EXIT_FINE)
        return status;
    seeking s = {.o = o, .problem = problem_of(o), .target = "preset", .preset = o->camera.values[0].words};
    const preset_parameter *sought = preset_sought(s.problem.row);
    s.parameter = sought->name;
    preset_solve(&s.problem, &s.answer);
    s.possible = s.answer.possible;
    s.tried = s.answer.tried;
    s.from = s.possible ? s.answer.from : (double)NAN;
    s.to = s.possible ? s.answer.to : (double)NAN;
    const double shown = !s.possible ? sought->example : s.answer.below || !s.answer.above ? s.from : s.to;
    s.setup.spec = s.problem.spec;
    if (!preset_setup(&s.problem, shown, &s.setup, &s.lo, &s.hi)) {
        s.lo = s.problem.lo;
        s.hi = s.problem.hi;
    }
    s.fields = setup_fields_of(&s.setup, camera_unit(&o->camera));
    status = output_start(&o->out, &o->camera, &out);
    if (status != EXIT_FINE)
        return status;
    report_write(&(report_spec){"solve", columns, &s, .label = 15, .head = say}, &out, o->out.form);
    status = output_close(&out);
    return status == EXIT_FINE && !s.possible ? EXIT_FAILED : status;
}
