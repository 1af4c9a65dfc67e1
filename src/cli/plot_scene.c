/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/plot_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/check_report.h"
#include "cli/setups.h"
#include "plot/notes.h"
#include "report/append.h"

enum { WIDTH = 800, HEIGHT = 500, NAME_SIZE = SETUP_LABEL_SIZE + 80 };

/* One set-up of a camera that has requirements to show. */
typedef struct scene {
    check_file f;
    size_t count;
    dp_setup setups[CHART_PANELS];
    const need_camera *cameras[CHART_PANELS];
    char text[CHART_PANELS][NAME_SIZE];
    const char *names[CHART_PANELS];
    figure_need *needs;
    size_t need_count, ties, failed;
} scene;

/* The set-up that the curves are drawn of: the fullest model that the camera asks for. */
static dp_setup curve_setup(const check_verdict *v, const dp_setup *asked) {
    dp_setup setup = *asked;
    if (!v->camera->automatic)
        return setup;
    dp_spec spec = asked->spec;
    spec.model = DP_MODEL_FP32;
    if (dp_setup_init(&setup, &spec) != DP_OK)
        setup = *asked;
    return setup;
}

/* The place of a camera's set-up, a new one for a new one; false when the figure is full. */
static bool place_of(scene *s, const check_verdict *v, size_t *out) {
    const char *format = v->setup.spec.format.name;
    for (*out = 0; *out < s->count; ++*out)
        if (s->cameras[*out] == v->camera && strcmp(s->setups[*out].spec.format.name, format) == 0)
            return true;
    if (s->count == CHART_PANELS)
        return false;
    const size_t k = strcmp(v->camera->setups[0].spec.format.name, format) == 0 ? 0 : 1;
    char label[SETUP_LABEL_SIZE];
    s->setups[s->count] = curve_setup(v, &v->camera->setups[k]);
    s->cameras[s->count] = v->camera;
    snprintf(s->text[s->count], NAME_SIZE, "%s: %s, %s", v->camera->name,
             setup_label(&s->setups[s->count], false, label), dp_model_name(s->setups[s->count].spec.model));
    s->names[s->count] = s->text[s->count];
    s->count++;
    return true;
}

static int gather(scene *s) {
    s->needs = calloc(s->f.count, sizeof *s->needs);
    if (s->needs == NULL)
        return usage_error("plot scene: no memory");
    for (size_t i = 0; i < s->f.count; i++) {
        const check_verdict *v = &s->f.verdicts[i];
        size_t place;
        if (v->asked->kind == NEED_TIES) {
            s->ties++;
            continue;
        }
        if (!place_of(s, v, &place))
            return usage_error("plot scene: shows at most %d cameras with requirements", CHART_PANELS);
        s->failed += !v->passed;
        s->needs[s->need_count++] = (figure_need){.name = v->asked->name,
                                                  .setup = place,
                                                  .is_error = v->asked->kind == NEED_ERROR,
                                                  .passed = v->passed,
                                                  .lo = v->asked->lo,
                                                  .hi = v->asked->hi,
                                                  .limit = v->asked->limit,
                                                  .z = v->z};
    }
    return s->need_count > 0 ? EXIT_FINE
                             : usage_error("plot scene: %s limits no separation and no error", s->f.file.path);
}

/* Shares of ties have no place on an axis of lengths: they are not judged, and the subtitle says so. */
static bool no_ties(void *context, const dp_setup *setup, double lo, double hi, bool sample, double *share, double *z) {
    (void)context, (void)setup, (void)hi, (void)sample;
    *share = 0.0;
    *z = lo;
    return true;
}

static int judge(scene *s) {
    const check_request request = {.file = &s->f.file, .count = no_ties};
    s->f.count = check_count(&s->f.file);
    s->f.verdicts = calloc(s->f.count, sizeof *s->f.verdicts);
    if (s->f.verdicts == NULL)
        return usage_error("plot scene: no memory");
    check_all(&request, s->f.verdicts);
    return gather(s);
}

static int draw(const options *o, const figure_row *row, scene *s,
                int (*write)(const options *, const figure_row *, const figure_request *, chart *)) {
    figure_request request = {.setups = s->setups,
                              .count = s->count,
                              .names = s->names,
                              .lo = NAN,
                              .hi = NAN,
                              .at = NAN,
                              .needs = s->needs,
                              .need_count = s->need_count,
                              .columns = o->width > 0 ? o->width : WIDTH,
                              .rows = o->height > 0 ? o->height : HEIGHT};
    if (option_given(o, OPTION_RANGE)) {
        request.lo = o->range_lo;
        request.hi = o->range_hi;
    }
    chart *c = chart_new();
    if (c == NULL)
        return usage_error("plot: no memory");
    const char *slash = strrchr(s->f.file.path, '/');
    char subtitle[sizeof c->subtitle];
    snprintf(subtitle, sizeof subtitle, "%.100s: %zu met, %zu missed", slash != NULL ? slash + 1 : s->f.file.path,
             s->need_count - s->failed, s->failed);
    if (s->f.file.unit[0] != '\0')
        append(subtitle, sizeof subtitle, "; a scene unit is 1 %s", s->f.file.unit);
    if (s->ties > 0)
        append(subtitle, sizeof subtitle, "; not shown: %zu of ties", s->ties);
    notes_clean(c->title, sizeof c->title, o->title != NULL ? o->title : "");
    notes_clean(c->subtitle, sizeof c->subtitle, subtitle);
    const int status = write(o, row, &request, c);
    chart_free(c);
    return status;
}

int plot_scene(const options *o, const figure_row *row,
               int (*write)(const options *, const figure_row *, const figure_request *, chart *)) {
    if (option_given(o, OPTION_AT))
        return option_error(OPTION_AT, "has no meaning in the figure %s; --range cuts its axis", row->name);
    scene *s = calloc(1, sizeof *s);
    if (s == NULL)
        return usage_error("plot: no memory");
    int status = check_read(o->operands[1], &s->f.file);
    if (status == EXIT_FINE)
        status = judge(s);
    if (status == EXIT_FINE)
        status = draw(o, row, s, write);
    need_release(&s->f.file);
    free(s->f.verdicts);
    free(s->needs);
    free(s);
    return status;
}
