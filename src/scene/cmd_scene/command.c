/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene: which surfaces of a model fight, from where on, and what mends it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/cmd/setups.h"
#include "cli/progress.h"
#include "cli/stop.h"
#include "quantity/cmd/resolved.h"
#include "quantity/quantity.h"
#include "report/number.h"
#include "scene/cmd_scene/request.h"
#include "scene/cmd_scene/scene.h"
#include "solve/distance.h"
#include "texture/strips.h"

enum { STEPS = 1000, DIGITS = 6, AT_ONCE = 128 /* findings that a thread judges before an interrupt is seen */ };

/* The largest distance that is looked for unasked, a share of the model. */
#define COARSEST 0.01

/* ---- Reading and finding ----------------------------------------------------------------------------------------- */

/* The report is on stdout without -o; that the files beside it can be written is known before the search. */
static int check_files(const scene *s) {
    static const char *const files[] = {"render", "emit-need"};
    const scene_request *o = &s->o;
    const char *on_stdout = o->out.file == NULL || strcmp(o->out.file, "-") == 0 ? "output" : NULL;
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        const char *path = option_written(o->line, files[i]);
        if (path == NULL)
            continue;
        if (strcmp(path, "-") == 0 && on_stdout != NULL)
            return option_error(files[i], "must not be the file of --%s, got '-'", on_stdout);
        if (strcmp(path, "-") == 0)
            on_stdout = files[i];
        const int status = output_check(path);
        if (status != EXIT_FINE)
            return status;
    }
    return EXIT_FINE;
}

/* One camera: its fullest model. */
static int take_setup(scene *s) {
    setups all;
    if (option_given(s->o.line, "separation") && s->o.scene.separation > FINDER_COORDINATE_MAX)
        return option_error("separation", "must be at most %g here, got '%s'", FINDER_COORDINATE_MAX,
                            number_full(s->o.scene.separation).text);
    if (s->o.scene.angle > FINDER_ANGLE_MAX)
        return option_error("angle", "must be at most %g degrees here, got '%s'", FINDER_ANGLE_MAX,
                            number_full(s->o.scene.angle).text);
    const int status = setups_make(&s->o.camera, &all);
    if (status != EXIT_FINE)
        return status;
    const size_t count = all.count;
    s->setup = dp_setup_guaranteed(&all.items[0]);
    setups_release(&all);
    if (count != 1)
        return option_error("format", "and --mapping must name one camera here, got %zu", count);
    s->fields = setup_fields_asked(&s->setup, &s->o.camera);
    return EXIT_FINE;
}

/* Where nobody says what a scene unit is, the model may. */
static void take_unit(scene *s) {
    const unit_row *unit;
    for (size_t i = 0; (unit = unit_get(i)) != NULL && s->o.camera.lengths.unit == NULL; i++)
        if (fabs(s->model.metres * 1e9 - unit->nanometres) <= 1e-9 * unit->nanometres)
            s->o.camera.lengths.unit = unit;
    s->unit = camera_unit(&s->o.camera);
    s->fields = setup_fields_asked(&s->setup, &s->o.camera);
}

static int read_model(scene *s) {
    const model_asked asked = {.transforms = s->o.scene.transforms == 0 ? MODEL_EXACT : MODEL_BINARY32};
    model_error error;
    if (model_read(s->file, &asked, &s->model, &error)) {
        if (s->o.camera.lengths.unit == NULL)
            take_unit(s);
        if (s->model.metres > 0.0 && s->o.camera.lengths.unit != NULL) /* both say what theirs is */
            model_scale(&s->model, s->model.metres * 1e9 / s->o.camera.lengths.unit->nanometres);
        return EXIT_FINE;
    }
    const int status = usage_error("%s: %s", s->file, error.text);
    return error.unreadable ? EXIT_IO : status;
}

/* How far the model reaches from any eye asked for; without an eye, a depth at which it looks small. */
static double farthest(const scene *s, const model_box *b) {
    double reach = s->eyes.count > 0 ? 0.0 : SCENE_FAR_AWAY * s->extent;
    for (size_t i = 0; i < 8 * s->eyes.count; i++) {
        const double corner[3] = {i & 1 ? b->hi[0] : b->lo[0], i & 2 ? b->hi[1] : b->lo[1],
                                  i & 4 ? b->hi[2] : b->lo[2]};
        double seen[3];
        scene_eye_sees(&s->eyes.eye[i / 8], corner, seen);
        reach = fmax(reach, seen[2]);
    }
    return reach;
}

/* Where a camera tells apart no detail of the model nothing is asked of it: judged is up to where it tells apart `gap`.
 */
static void shorten(scene *s, double gap) {
    const double znear = s->setup.spec.znear;
    const double to = s->gap > gap ? distance_about(&s->setup, znear, s->within, gap, DIGITS) : (double)NAN;
    if (!(to > znear))
        return;
    s->within = to;
    s->gap = gap;
}

/* Defaults of limits: as far as the model reaches, and the largest distance that is not told apart there. */
static int take_limits(scene *s) {
    const double znear = s->setup.spec.znear, zfar = s->setup.spec.zfar;
    const model_box b = model_box_of(&s->model);
    s->extent = model_box_diagonal(&b);
    s->within = option_given(s->o.line, "within") ? s->o.scene.within : fmin(fmax(farthest(s, &b), 2.0 * znear), zfar);
    if (!(s->within >= znear && s->within <= zfar))
        return option_error("within", "must lie between near and far, got '%s'", number_full(s->within).text);
    s->gap = option_given(s->o.line, "separation") ? s->o.scene.separation
                                                   : quantity_bound(QUANTITY_SEPARATION, &s->setup, znear, s->within);
    if (!option_given(s->o.line, "separation") && !option_given(s->o.line, "within") && s->eyes.count == 0)
        shorten(s, COARSEST * s->extent);
    return EXIT_FINE;
}

static int advance(void *context, double share) {
    progress_step(context, (uint64_t)(share * STEPS));
    return stop_asked();
}

static int find(scene *s) {
    progress bar = progress_start("of the search", STEPS, s->o.out.quiet);
    const finder_asked asked = {.gap = s->gap,
                                .angle = s->angle,
                                .width = ldexp(s->extent, -22), /* four steps of binary32 */
                                .off = s->o.scene.filters_off,
                                .threads = s->o.out.threads,
                                .progress = advance,
                                .context = &bar};
    stop_watch();
    const finder_status status = finder_find(&s->model, &asked, &s->found);
    progress_end(&bar);
    if (status == FINDER_NO_MEMORY)
        return usage_error("%s: no memory to search it", s->file);
    if (status == FINDER_RANGE)
        return usage_error("%s: its coordinates are beyond 1e50 or so small that they vanish", s->file);
    return EXIT_FINE; /* or stopped, which stop_end() sees */
}

/* ---- Judging ----------------------------------------------------------------------------------------------------- */

static scene_named name_of(const model_surface *m) {
    return (scene_named){m->node[0] != '\0' ? m->node : NULL, m->mesh[0] != '\0' ? m->mesh : NULL,
                         m->material[0] != '\0' ? m->material : NULL};
}

/* The first of them that differs decides: from an eye, what fights there, what is not covered, what is seen. */
typedef struct urgency {
    double key[4];
} urgency;

static urgency urgency_of(const scene_finding *f) {
    const scene_sight *e = &f->sight;
    return (urgency){{isnan(e->fights_from) ? HUGE_VAL : e->fights_from, e->covered ? 1.0 : 0.0,
                      isnan(e->seen_from) ? HUGE_VAL : 0.0,
                      isnan(f->verdict.certain_to) ? -1.0 : f->verdict.certain_to}};
}

/* The nearest fight first, certain nowhere before all; then the largest. */
static int compare(const void *one, const void *other) {
    const scene_finding *a = one, *b = other;
    const urgency u = urgency_of(a), v = urgency_of(b);
    for (int k = 0; k < 4; k++)
        if (u.key[k] != v.key[k])
            return u.key[k] < v.key[k] ? -1 : 1;
    if (a->area != b->area)
        return a->area > b->area ? -1 : 1;
    return a->of < b->of ? -1 : 1;
}

/* Findings come in the order of their distances. */
static bool is_as_before(const finder_finding *f, size_t i) {
    return i > 0 && f[i].gap_min == f[i - 1].gap_min && f[i].gap_max == f[i - 1].gap_max;
}

/* Each distance once, however many findings have it. */
static void judge_distances(scene *s) {
    const finder_finding *f = s->found.finding;
    const size_t count = s->found.findings;
    const int threads = strips_threads(s->o.out.threads);
    const size_t round = AT_ONCE * (size_t)threads;
    progress bar = progress_start("findings judged", count, s->o.out.quiet);
    for (size_t first = 0; first < count && !stop_asked(); first += round) {
        const size_t end = first + round < count ? first + round : count;
#pragma omp parallel for schedule(dynamic, 4) num_threads(threads)
        for (size_t i = first; i < end; i++)
            if (!is_as_before(f, i))
                s->findings[i].verdict = scene_judge(&s->setup, f[i].gap_min, f[i].gap_max, s->within);
        progress_step(&bar, end);
    }
    progress_end(&bar);
    for (size_t i = 0; i < count; i++) {
        if (is_as_before(f, i))
            s->findings[i].verdict = s->findings[i - 1].verdict;
        s->findings[i].fights = !(s->findings[i].verdict.certain_to >= s->within);
    }
}

static int judge_findings(scene *s) {
    s->findings = calloc(s->found.findings + 1, sizeof *s->findings);
    if (s->findings == NULL)
        return usage_error("%s: no memory for %zu findings", s->file, s->found.findings);
    for (size_t i = 0; i < s->found.findings; i++) {
        const finder_finding *f = &s->found.finding[i];
        s->findings[i] = (scene_finding){.of = f,
                                         .a = name_of(&s->model.surface[f->a]),
                                         .b = name_of(&s->model.surface[f->b]),
                                         .gap_min = f->gap_min,
                                         .gap_max = f->gap_max,
                                         .area = f->area,
                                         .place = {f->place[0], f->place[1], f->place[2]},
                                         .pairs = f->pairs,
                                         .wrong_pixels = (double)NAN,
                                         .sight = {.covered = true},
                                         .line = (double)NAN};
    }
    judge_distances(s);
    for (size_t i = 0; i < s->found.findings; i++) /* once each distance is judged */
        s->findings[i].verdict.lift = scene_lift(&s->model, &s->found, s->findings[i].of, s->findings[i].verdict.lift);
    const int status = s->eyes.count > 0 ? scene_eyes_judge(s) : EXIT_FINE;
    s->required = option_given(s->o.line, "within");
    s->passed = true;
    for (size_t i = 0; i < s->found.findings; i++)
        s->passed = s->passed && !s->findings[i].fights;
    if (s->found.findings > 1) /* none: no array either */
        qsort(s->findings, s->found.findings, sizeof *s->findings, compare);
    return status;
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

/* The camera, for all that asks of it. */
static int take_camera(scene *s) {
    s->triangles = slant_fields_of(&s->o.camera, &s->slant);
    const int status = take_setup(s);
    return status == EXIT_FINE ? scene_render_check(s) : status;
}

int scene_begin(scene *s, const scene_request *given, const char *file) {
    *s = (scene){.o = *given, .file = file, .unit = camera_unit(&given->camera)};
    s->angle = s->o.scene.angle;
    s->transforms = option_word("transforms", s->o.scene.transforms);
    const int status = scene_eyes_check(&s->o);
    return status == EXIT_FINE && s->o.scene.camera == NULL ? take_camera(s) : status;
}

int scene_look(scene *s, output *out) {
    int status = read_model(s);
    if (status == EXIT_FINE)
        status = scene_eyes_take(s);
    if (status == EXIT_FINE && s->o.scene.camera != NULL)
        status = take_camera(s);
    if (status == EXIT_FINE)
        status = take_limits(s);
    if (status == EXIT_FINE)
        status = find(s);
    stop_end(out);
    if (status == EXIT_FINE)
        status = judge_findings(s);
    stop_end(out);
    if (status == EXIT_FINE) {
        scene_bias_take(s);
        scene_models_take(s);
    }
    return status;
}

void scene_end(scene *s) {
    free(s->findings);
    free(s->eyes.eye);
    finder_free(&s->found);
    model_free(&s->model);
}

/* Checks the options that only this command has. */
static int check_asked(const scene *s) {
    const scene_request *o = &s->o;
    if (o->out.report != REPORT_TEXT && o->out.form != FORM_TEXT)
        return option_error("report", "conflicts with --json or --csv");
    if (o->out.report == REPORT_JUNIT && !option_given(o->line, "within"))
        return option_error("report", "junit needs --within: surfaces that may z-fight nearer fail");
    if (o->scene.emit_need != NULL && option_given(o->line, "separation") && o->scene.separation == 0.0)
        return option_error("emit-need", "needs a --separation above 0: no camera resolves coplanar surfaces");
    if (o->bias.api == NULL)
        return option_error("api", "must name one here, got '%s'", option_text(o->line, "api"));
    const int status = setup_decided(&o->camera);
    return status == EXIT_FINE ? check_files(s) : status;
}

/* The files beside the report, each after the one before, so that an interrupt leaves whole ones alone. */
static int write_files(scene *s, output *out) {
    const struct {
        const char *path;
        int (*write)(scene *s);
    } files[] = {{s->o.scene.render, scene_render}, {s->o.scene.emit_need, scene_need}};
    int status = EXIT_FINE;
    for (size_t i = 0; i < sizeof files / sizeof files[0] && status == EXIT_FINE; i++) {
        if (files[i].path != NULL)
            status = files[i].write(s);
        stop_end(out);
    }
    return status;
}

static int write_report(scene *s, output *out) {
    if (s->o.out.report == REPORT_JUNIT) {
        scene_junit(s, out);
    } else {
        const report_spec spec = scene_report(s);
        report_write(&spec, out, s->o.out.report == REPORT_JSON ? FORM_JSON : s->o.out.form);
    }
    return output_close(out);
}

int cmd_scene(void *request) {
    const scene_request *given = request;
    output out;
    scene s;
    int status = scene_begin(&s, given, given->line->operands[0]);
    if (status == EXIT_FINE)
        status = check_asked(&s);
    if (status == EXIT_FINE)
        status = output_start(&s.o.out, &s.o.camera, &out);
    if (status != EXIT_FINE)
        return status;
    status = scene_look(&s, &out);
    if (status == EXIT_FINE)
        status = write_files(&s, &out);
    if (status == EXIT_FINE)
        status = write_report(&s, &out);
    else
        output_abandon(&out);
    if (status == EXIT_FINE && s.required && !s.passed)
        status = EXIT_FAILED;
    scene_end(&s);
    return status;
}
