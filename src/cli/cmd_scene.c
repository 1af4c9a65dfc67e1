/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene: which surfaces of a model fight, from where on, and what mends it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/option_rows.h"
#include "cli/progress.h"
#include "cli/reach.h"
#include "cli/setups.h"
#include "cli/slant.h"
#include "cli/stop.h"
#include "core/append.h"
#include "core/elementary.h"
#include "model/model.h"
#include "report/number.h"
#include "scene/find.h"
#include "scene/judge.h"

enum { DIGITS = 4, SHOWN_MOST = 20, STEPS = 1000, LABEL = 4, NAME_SIZE = 128, LINE_SIZE = 256 };

/* A surface as a report names it; null where the file has no name. */
typedef struct named {
    const char *node, *mesh, *material;
} named;

typedef struct place {
    double x, y, z;
} place;

typedef struct finding {
    const finder_finding *of;
    named a, b;
    double gap_min, gap_max, area;
    place place;
    scene_verdict verdict;
    uint64_t pairs;
    bool fights; /* nearer than --within asks */
} finding;

typedef struct scene {
    options o; /* with what stands for options that were not given */
    dp_setup setup;
    setup_fields fields;
    slant_fields slant;
    const slant_fields *triangles; /* null: surfaces face the camera */
    model model;
    finder_found found;
    finding *findings;
    const char *file, *unit, *transforms;
    double gap, angle, within, extent;
    uint64_t triangle_count, surface_count, finding_count, left_out[FINDER_FILTERS], degenerate;
    bool passed;
} scene;

/* ---- Reading and finding ----------------------------------------------------------------------------------------- */

static options scene_options(const options *given) {
    options o = *given;
    if (!option_given(given, OPTION_FORMAT) && given->preset_count == 0)
        parse_formats(&o, &option_rows[OPTION_FORMAT], "fp32");
    if (!option_given(given, OPTION_MAPPING) && given->preset_count == 0)
        parse_mappings(&o, &option_rows[OPTION_MAPPING], "reversed");
    if (!option_given(given, OPTION_ANGLE))
        o.angle = FINDER_ANGLE;
    return o;
}

/* One camera: its fullest model. */
static int take_setup(scene *s) {
    setups all;
    if (option_given(&s->o, OPTION_GAP) && s->o.gap > FINDER_COORDINATE_MAX)
        return option_error(OPTION_GAP, "must be at most %g here, got '%s'", FINDER_COORDINATE_MAX,
                            number_full(s->o.gap).text);
    if (s->o.angle > FINDER_ANGLE_MAX)
        return option_error(OPTION_ANGLE, "must be at most %g degrees here, got '%s'", FINDER_ANGLE_MAX,
                            number_full(s->o.angle).text);
    const int status = setups_make(&s->o, &all);
    if (status != EXIT_FINE)
        return status;
    const size_t count = all.count;
    s->setup = reach_model(&all.items[0]);
    setups_release(&all);
    if (count != 1)
        return option_error(OPTION_FORMAT, "and --mapping must name one camera here, got %zu", count);
    s->fields = setup_fields_of(&s->setup, s->unit);
    return EXIT_FINE;
}

static int read_model(scene *s) {
    const model_asked asked = {.transforms = s->o.transforms == 0 ? MODEL_EXACT : MODEL_BINARY32};
    model_error error;
    if (model_read(s->file, &asked, &s->model, &error))
        return EXIT_FINE;
    const int status = usage_error("%s: %s", s->file, error.text);
    return error.unreadable ? EXIT_IO : status;
}

/* Of the triangles: a file may have vertices that none of them uses. */
static double extent_of(const model *m) {
    double sum = 0.0;
    for (int k = 0; k < 3; k++) {
        double lo = HUGE_VAL, hi = -HUGE_VAL;
        for (size_t i = 0; i < 3 * m->triangles; i++) {
            const double x = m->position[m->triangle[i / 3][i % 3]][k];
            lo = fmin(lo, x);
            hi = fmax(hi, x);
        }
        sum = dp_hypot(sum, hi - lo);
    }
    return sum;
}

/* What was not said: as far as the model reaches, and the largest distance that is not told apart there. */
static int take_limits(scene *s) {
    const double znear = s->setup.spec.znear, zfar = s->setup.spec.zfar;
    dp_separation_worst worst = {.bound = HUGE_VAL};
    s->extent = extent_of(&s->model);
    s->within = option_given(&s->o, OPTION_WITHIN) ? s->o.within : fmin(fmax(s->extent, 2.0 * znear), zfar);
    if (!(s->within >= znear && s->within <= zfar))
        return option_error(OPTION_WITHIN, "must lie between near and far, got '%s'", number_full(s->within).text);
    dp_separation_over(&s->setup, znear, s->within, 0.0, &worst);
    s->gap = option_given(&s->o, OPTION_GAP) ? s->o.gap : fmin(worst.bound, 0.01 * s->extent);
    return EXIT_FINE;
}

static int advance(void *context, double share) {
    progress_step(context, (uint64_t)(share * STEPS));
    return stop_asked();
}

static int find(scene *s) {
    progress bar = progress_start("of the search", STEPS, s->o.quiet);
    const finder_asked asked = {.gap = s->gap,
                                .angle = s->angle,
                                .width = ldexp(s->extent, -22), /* four steps of binary32 */
                                .off = s->o.filters_off,
                                .threads = s->o.threads,
                                .progress = advance,
                                .context = &bar};
    stop_watch();
    const finder_status status = finder_find(&s->model, &asked, &s->found);
    progress_end(&bar);
    if (status == FINDER_NO_MEMORY)
        return usage_error("%s: there is no memory to search it", s->file);
    if (status == FINDER_RANGE)
        return usage_error("%s: its coordinates are beyond 1e50 or so small that they vanish", s->file);
    return EXIT_FINE; /* or stopped, which stop_end() sees */
}

/* ---- Judging ----------------------------------------------------------------------------------------------------- */

static named name_of(const model_surface *m) {
    return (named){m->node[0] != '\0' ? m->node : NULL, m->mesh[0] != '\0' ? m->mesh : NULL,
                   m->material[0] != '\0' ? m->material : NULL};
}

/* The nearest fight first, NaN before all; then the largest. */
static int compare(const void *one, const void *other) {
    const finding *a = one, *b = other;
    const double za = isnan(a->verdict.certain_to) ? -1.0 : a->verdict.certain_to;
    const double zb = isnan(b->verdict.certain_to) ? -1.0 : b->verdict.certain_to;
    if (za != zb)
        return za < zb ? -1 : 1;
    if (a->area != b->area)
        return a->area > b->area ? -1 : 1;
    return a->of < b->of ? -1 : 1;
}

static int judge(scene *s) {
    s->findings = calloc(s->found.findings + 1, sizeof *s->findings);
    if (s->findings == NULL)
        return usage_error("%s: no memory for %zu findings", s->file, s->found.findings);
    s->passed = true;
    for (size_t i = 0; i < s->found.findings; i++) {
        const finder_finding *f = &s->found.finding[i];
        const bool again = i > 0 && f->gap_min == f[-1].gap_min && f->gap_max == f[-1].gap_max;
        finding *out = &s->findings[i];
        *out =
            (finding){.of = f,
                      .a = name_of(&s->model.surface[f->a]),
                      .b = name_of(&s->model.surface[f->b]),
                      .gap_min = f->gap_min,
                      .gap_max = f->gap_max,
                      .area = f->area,
                      .place = {f->place[0], f->place[1], f->place[2]},
                      .pairs = f->pairs,
                      .verdict = again ? out[-1].verdict : scene_judge(&s->setup, f->gap_min, f->gap_max, s->within)};
        out->fights = !(out->verdict.certain_to >= s->within);
        s->passed = s->passed && !out->fights;
    }
    qsort(s->findings, s->found.findings, sizeof *s->findings, compare);
    return EXIT_FINE;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static number_text length(const page *p, double value) {
    return number_in(number_brief(number_of(value, DIGITS)), p->unit);
}

static const char *called(const named *n, char out[NAME_SIZE]) {
    out[0] = '\0';
    append(out, NAME_SIZE, "'%.40s'", n->node != NULL ? n->node : n->mesh != NULL ? n->mesh : "(no name)");
    if (n->material != NULL)
        append(out, NAME_SIZE, " (%.40s)", n->material);
    return out;
}

/* How many fight before the far plane; they come first. */
static size_t fighting(const scene *s) {
    size_t n = 0;
    while (n < s->found.findings && !(s->findings[n].verdict.certain_to >= s->setup.spec.zfar))
        n++;
    return n;
}

static void say_head(page *p, void *of) {
    const scene *s = of;
    const model_notes *n = &s->model.notes;
    const size_t count = s->found.findings, fights = fighting(s);
    char how_many[24] = "none";
    if (fights > 0)
        snprintf(how_many, sizeof how_many, "%zu", fights);
    p->unit = s->unit;
    page_title(p, "%s: %zu triangle%s, %zu surface%s, %s across", s->file, s->model.triangles,
               s->model.triangles == 1 ? "" : "s", s->model.surfaces, s->model.surfaces == 1 ? "" : "s",
               length(p, s->extent).text);
    setup_title(p, &s->setup, &s->fields);
    slant_say(p, page_title, &s->o, &s->setup);
    if (n->skinned + n->morphed + n->animated > 0)
        page_title(p, "in the rest pose: %zu skinned and %zu morphed meshes, %zu animated nodes", n->skinned,
                   n->morphed, n->animated);
    if (count == 0)
        page_text(p, "No surfaces lie within %s of each other.", length(p, s->gap).text);
    else
        page_text(p, "%zu pair%s of surfaces lie%s within %s of each other: %s can fight before the far plane.", count,
                  count == 1 ? "" : "s", count == 1 ? "s" : "", length(p, s->gap).text, how_many);
    if (option_given(&s->o, OPTION_WITHIN))
        page_text(p, "%s%s%s  %s nearer than %s.", s->passed ? p->good : p->bad, s->passed ? "pass" : "FAIL", p->plain,
                  s->passed ? "none fights" : "surfaces can fight", length(p, s->within).text);
}

static number_text safe_length(const page *p, double value, bool upward) {
    return number_in(number_brief(upward ? number_up(value, DIGITS) : number_down(value, DIGITS)), p->unit);
}

static void say_finding(page *p, const scene *s, size_t i) {
    const finding *f = &s->findings[i];
    const scene_verdict *v = &f->verdict;
    char a[NAME_SIZE], b[NAME_SIZE], label[16], text[LINE_SIZE] = "";
    snprintf(label, sizeof label, "%zu", i + 1);
    page_note(p, label, "%s and %s", called(&f->a, a), called(&f->b, b));
    if (isnan(v->certain_to))
        append(text, sizeof text, "certain nowhere");
    else
        append(text, sizeof text, "certain up to %s", safe_length(p, v->certain_to, false).text);
    if (!isnan(v->ties_from))
        append(text, sizeof text, ", ties from %s", safe_length(p, v->ties_from, true).text);
    append(text, sizeof text, "; ");
    if (f->gap_min != f->gap_max)
        append(text, sizeof text, "%s to ", number_brief(number_of(f->gap_min, DIGITS)).text);
    append(text, sizeof text, "%s apart", length(p, f->gap_max).text);
    page_note(p, "", "%s", text);
    page_note(p, "", "area %s, near %s %s %s", number_brief(number_of(f->area, DIGITS)).text,
              number_of(f->place.x, DIGITS).text, number_of(f->place.y, DIGITS).text,
              number_of(f->place.z, DIGITS).text);
    if (v->lift > 0.0 && isfinite(v->lift))
        page_note(p, "", "%s more between them are enough up to %s", safe_length(p, v->lift, true).text,
                  length(p, s->within).text);
}

static void say_notes(page *p, void *of) {
    const scene *s = of;
    const size_t fights = fighting(s), shown = fights < SHOWN_MOST ? fights : SHOWN_MOST;
    for (size_t i = 0; i < shown; i++)
        say_finding(p, s, i);
    if (fights > shown)
        page_text(p, "%zu more: --json and --csv have all.", fights - shown);
    for (size_t k = 0; k < FINDER_FILTERS; k++)
        if (s->found.left_out[k] > 0)
            page_line(p, "left out: %zu pairs of triangles %s (--also %s)", s->found.left_out[k],
                      finder_filter_get(k)->note, finder_filter_get(k)->name);
    if (s->found.degenerate > 0)
        page_line(p, "left out: %zu triangles without area", s->found.degenerate);
    if (s->found.cut)
        page_line(p, "cut short: too many triangles lie in one place, and not all pairs were looked at");
}

/* ---- Data -------------------------------------------------------------------------------------------------------- */

static void *next_finding(void *of, size_t i) {
    scene *s = of;
    return i < s->found.findings ? &s->findings[i] : NULL;
}

static const column named_columns[] = {{FIELD(named, node, "node", "")},
                                       {FIELD(named, mesh, "mesh", "")},
                                       {FIELD(named, material, "material", "")},
                                       {.kind = COLUMN_END}};

static const column place_columns[] = {{FIELD(place, x, "x", "scene")},
                                       {FIELD(place, y, "y", "scene")},
                                       {FIELD(place, z, "z", "scene")},
                                       {.kind = COLUMN_END}};

static const column finding_columns[] = {{PART(finding, a, "a", named_columns), .only = AS_JSON},
                                         {PART(finding, b, "b", named_columns), .only = AS_JSON},
                                         {FIELD(finding, a.node, "a_node", ""), .only = AS_CSV},
                                         {FIELD(finding, a.mesh, "a_mesh", ""), .only = AS_CSV},
                                         {FIELD(finding, a.material, "a_material", ""), .only = AS_CSV},
                                         {FIELD(finding, b.node, "b_node", ""), .only = AS_CSV},
                                         {FIELD(finding, b.mesh, "b_mesh", ""), .only = AS_CSV},
                                         {FIELD(finding, b.material, "b_material", ""), .only = AS_CSV},
                                         {FIELD(finding, gap_min, "gap_min", "scene")},
                                         {FIELD(finding, gap_max, "gap_max", "scene")},
                                         {FIELD(finding, area, "area", "scene^2")},
                                         {PART(finding, place, "place", place_columns)},
                                         {FIELD(finding, pairs, "pairs", "")},
                                         {FIELD(finding, verdict.certain_to, "certain_to", "scene")},
                                         {FIELD(finding, verdict.ties_from, "ties_from", "scene")},
                                         {FIELD(finding, verdict.lift, "lift", "scene")},
                                         {FIELD(finding, fights, "fights", "")},
                                         {.kind = COLUMN_END}};

static const column left_columns[] = {
    {FIELD(scene, left_out[FINDER_FACING], "facing", "")}, {FIELD(scene, left_out[FINDER_BLENDED], "blended", "")},
    {FIELD(scene, left_out[FINDER_THIN], "thin", "")},     {FIELD(scene, left_out[FINDER_HIDDEN], "hidden", "")},
    {FIELD(scene, degenerate, "degenerate", "")},          {.kind = COLUMN_END}};

static const column columns[] = {
    {FIELD(scene, file, "file", ""), .only = AS_JSON},
    {PART(scene, fields, "setup", setup_columns), .only = AS_JSON},
    {PART(scene, triangles, "triangles", slant_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {FIELD(scene, triangle_count, "model_triangles", ""), .only = AS_JSON},
    {FIELD(scene, surface_count, "model_surfaces", ""), .only = AS_JSON},
    {FIELD(scene, extent, "extent", "scene"), .only = AS_JSON},
    {FIELD(scene, transforms, "transforms", ""), .only = AS_JSON},
    {FIELD(scene, gap, "gap", "scene"), .only = AS_JSON},
    {FIELD(scene, angle, "angle", "degrees"), .only = AS_JSON},
    {FIELD(scene, within, "within", "scene"), .only = AS_JSON},
    {FIELD(scene, passed, "passed", ""), .only = AS_JSON},
    {FIELD(scene, found.cut, "cut", ""), .only = AS_JSON},
    {GROUP("left_out", left_columns), .only = AS_JSON},
    {LIST("findings", finding_columns, next_finding), .only = AS_JSON | AS_CSV},
    {.kind = COLUMN_END}};

/* ---- The command ------------------------------------------------------------------------------------------------- */

static void release(scene *s) {
    free(s->findings);
    finder_free(&s->found);
    model_free(&s->model);
}

static void count(scene *s) {
    s->triangle_count = s->model.triangles;
    s->surface_count = s->model.surfaces;
    s->degenerate = s->found.degenerate;
    for (int k = 0; k < FINDER_FILTERS; k++)
        s->left_out[k] = s->found.left_out[k];
}

int cmd_scene(const options *given) {
    output out;
    scene s = {.o = scene_options(given), .file = given->operands[0], .unit = options_unit(given)};
    s.angle = s.o.angle;
    s.transforms = option_word(OPTION_TRANSFORMS, s.o.transforms);
    s.triangles = slant_fields_of(&s.o, &s.slant);
    int status = take_setup(&s);
    if (status == EXIT_FINE)
        status = options_open(&s.o, &out);
    if (status != EXIT_FINE)
        return status;
    status = read_model(&s);
    if (status == EXIT_FINE)
        status = take_limits(&s);
    if (status == EXIT_FINE)
        status = find(&s);
    stop_end(&out);
    if (status == EXIT_FINE)
        status = judge(&s);
    if (status == EXIT_FINE) {
        const report_spec spec = {"scene", columns, &s, .label = LABEL, .head = say_head, .notes = say_notes};
        count(&s);
        report_write(&spec, &out, s.o.form);
        status = output_close(&out);
    } else {
        output_abandon(&out);
    }
    if (status == EXIT_FINE && option_given(&s.o, OPTION_WITHIN) && !s.passed)
        status = EXIT_FAILED;
    release(&s);
    return status;
}
