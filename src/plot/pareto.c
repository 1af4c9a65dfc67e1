/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "plot/figure.h"
#include "plot/notes.h"

/* A log axis has no 0: what is exact is drawn here, and the legend says so. */
static const double exact = 1e-17;

/* A method that has a time and a finite error. Those judged by the pipeline answer a question of their own. */
typedef struct timed {
    const bench_result *of;
    double error;
    bool pipeline;
} timed;

typedef struct field {
    size_t count;
    timed methods[BENCH_METHODS_MAX];
} field;

static field gather(const method_family_row *family, const bench_result *results, size_t count) {
    field f = {0};
    for (size_t i = 0; i < count; i++) {
        const bench_result *r = &results[i];
        const double error = measured_error(family, &r->measured);
        if (isfinite(error) && isfinite(r->ns) && r->ns > 0)
            f.methods[f.count++] = (timed){r, error, (r->row->domain & METHOD_PIPELINE) != 0};
    }
    return f;
}

static void put(chart_series *s, size_t i, const timed *t) {
    s->x[i] = t->of->ns;
    s->y[i] = fmax(t->error, exact);
}

/* The front of those who answer one question, fastest first. */
static void add_front(const field *f, chart *out, chart_panel *panel, bool pipeline) {
    const timed *order[BENCH_METHODS_MAX];
    size_t count = 0;
    for (size_t i = 0; i < f->count; i++) {
        const timed *t = &f->methods[i];
        if (!t->of->front || t->pipeline != pipeline)
            continue;
        size_t k = count++;
        for (; k > 0 && order[k - 1]->of->ns > t->of->ns; k--)
            order[k] = order[k - 1];
        order[k] = t;
    }
    chart_series *s = count > 1 ? chart_add_series(out, panel, CHART_LINE, count) : NULL;
    if (s == NULL)
        return;
    s->unlisted = true;
    s->style = (chart_style){0, 0, -1, true};
    snprintf(s->name, sizeof s->name, "front");
    for (size_t i = 0; i < count; i++)
        put(s, i, order[i]);
}

static void add_points(const field *f, chart *out, chart_panel *panel, bool front) {
    size_t count = 0;
    for (size_t i = 0; i < f->count; i++)
        count += f->methods[i].of->front == front;
    chart_series *s = count > 0 ? chart_add_series(out, panel, CHART_POINTS, count) : NULL;
    if (s == NULL)
        return;
    s->style = front ? (chart_style){0, 0, 0, false} : (chart_style){1, 1, 1, false};
    snprintf(s->name, sizeof s->name, "%s", front ? "on the Pareto front" : "behind it");
    count = 0;
    for (size_t i = 0; i < f->count; i++) {
        if (f->methods[i].of->front != front)
            continue;
        put(s, count++, &f->methods[i]);
        if (f->methods[i].error < exact)
            snprintf(s->note, sizeof s->note, " (without error: at 10\u207b\u00b9\u2077)");
    }
}

static const chart_series *add_labels(const field *f, chart *out, chart_panel *panel) {
    chart_series *s = chart_add_series(out, panel, CHART_LABELS, f->count);
    if (s == NULL)
        return NULL;
    s->unlisted = true;
    snprintf(s->name, sizeof s->name, "methods");
    s->labels = chart_memory(out, f->count, sizeof *s->labels);
    for (size_t i = 0; i < f->count && s->labels != NULL; i++) {
        const timed *t = &f->methods[i];
        put(s, i, t);
        snprintf(s->labels[i], sizeof s->labels[i], "%s%s", t->of->row->name, t->pipeline ? " (pipeline)" : "");
    }
    return s;
}

/* Whole decades round the data, with room for the names. */
static void fit(chart_axis *axis, const double *values, size_t count) {
    double lo = values[0], hi = values[0];
    for (size_t i = 1; i < count; i++) {
        lo = fmin(lo, values[i]);
        hi = fmax(hi, values[i]);
    }
    axis->lo = pow(10, floor(log10(lo) - 0.1));
    axis->hi = pow(10, ceil(log10(hi) + 0.1));
}

const char *pareto_draw(const method_family_row *family, const bench_result *results, size_t count, chart *out) {
    const field f = gather(family, results, count);
    chart_panel *panel = chart_add_panel(out);
    if (f.count == 0)
        return "no method of this family has a time and a finite error here";
    if (panel == NULL)
        return NULL;
    panel->x = (chart_axis){.scale = CHART_LOG, .label = "time an element", .key = "time", .unit = "ns"};
    panel->y = (chart_axis){.scale = CHART_LOG, .label = "worst error", .key = "error", .unit = family->measure};
    for (int pipeline = 0; pipeline < 2; pipeline++)
        add_front(&f, out, panel, pipeline);
    add_points(&f, out, panel, false);
    add_points(&f, out, panel, true);
    const chart_series *all = add_labels(&f, out, panel);
    if (all == NULL)
        return NULL;
    fit(&panel->x, all->x, all->count);
    fit(&panel->y, all->y, all->count);
    return NULL;
}

const char *pareto_build(const figure_request *request, chart *out) {
    const method_family_row *family = request->family;
    const dp_spec *planes = &request->setups[0].spec;
    char subtitle[2 * CHART_TEXT];
    dp_setup setup;
    bench_result *results = chart_memory(out, BENCH_METHODS_MAX, sizeof *results);
    if (results == NULL || method_setup(family, request->which, planes->znear, planes->zfar, false, &setup) != DP_OK)
        return NULL;
    snprintf(subtitle, sizeof subtitle, "%s: %s; %s, %s", family->name, family->summary,
             family->cases[request->which].name, request->where);
    notes_clean(out->subtitle, sizeof out->subtitle, subtitle);
    const size_t count = bench_run(family, request->which, &setup, BENCH_REPETITIONS, results);
    return count > 0 ? pareto_draw(family, results, count, out) : "no memory for the methods";
}
