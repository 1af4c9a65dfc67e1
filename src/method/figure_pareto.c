/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/elementary.h"
#include "draw/notes.h"
#include "draw/theme.h"
#include "method/advice.h"
#include "plot/figure.h"

/* A log axis has no 0: what is exact is drawn here, and the legend says so. */
static const double exact = 1e-17;
static const char dominated[] = "dominated", on_front[] = "on the Pareto front";

/* Bits for a method's kind. Those judged by the pipeline answer a question of their own. */
enum { FRONT = 1, PIPELINE = 2, MINE = 4 };

/* A method that has a time and an error. */
typedef struct timed {
    const bench_result *of;
    double error;
    int is;
} timed;

typedef struct field {
    size_t count;
    timed methods[BENCH_METHODS_MAX];
    chart_extent time, error;
    double limit; /* of all methods */
} field;

static field gather(const method_family_row *family, const bench_result *results, size_t count) {
    field f = {.time = {INFINITY, 0}, .error = {INFINITY, 0}};
    for (size_t i = 0; i < count; i++) {
        const bench_result *r = &results[i];
        const double error = measured_error(family, &r->measured);
        const int is = (r->front ? FRONT : 0) | (r->row->asked > 0 ? MINE : 0) |
                       ((r->row->domain & METHOD_PIPELINE) != 0 ? PIPELINE : 0);
        if (isnan(error) || !isfinite(r->ns) || !(r->ns > 0))
            continue;
        f.methods[f.count++] = (timed){r, error, is};
        f.limit = r->row->own != NULL ? 0 : r->limit; /* of this processor, and not of a device */
        f.time = (chart_extent){fmin(f.time.lo, f.limit > 0 ? fmin(f.limit, r->ns) : r->ns), fmax(f.time.hi, r->ns)};
        if (isinf(error))
            continue;
        f.error = (chart_extent){fmin(f.error.lo, fmax(error, exact)), fmax(f.error.hi, error)};
        if (isfinite(r->bound))
            f.error.hi = fmax(f.error.hi, r->bound);
    }
    return f;
}

/* A number without end is drawn at that of the panel. */
static double drawn_at(const timed *t, const chart_panel *panel) {
    return isinf(t->error) ? panel->y.hi : fmax(t->error, exact);
}

/* A series whose data have an error that the axis has not. */
static chart_series *add_series(chart *out, chart_panel *panel, chart_kind kind, size_t count) {
    chart_series *s = count > 0 ? chart_add_series(out, panel, kind, count) : NULL;
    double *said = s != NULL ? chart_memory(out, count, sizeof *said) : NULL;
    if (said == NULL)
        return NULL;
    s->said = said;
    return s;
}

/* Those of which `bits` are `set`, along a line the fastest first; null where there are none, or a line has but one. */
static chart_series *add_methods(const field *f, chart *out, chart_panel *panel, chart_kind kind, int bits, int set) {
    size_t count = 0;
    for (size_t i = 0; i < f->count; i++)
        count += (f->methods[i].is & bits) == set;
    chart_series *s = count > (kind == CHART_LINE ? 1u : 0u) ? add_series(out, panel, kind, count) : NULL;
    for (size_t i = 0, k = 0; i < f->count && s != NULL; i++) {
        const timed *t = &f->methods[i];
        if ((t->is & bits) != set)
            continue;
        size_t at = k++;
        for (; kind == CHART_LINE && at > 0 && s->x[at - 1] > t->of->ns; at--) {
            s->x[at] = s->x[at - 1];
            s->y[at] = s->y[at - 1];
            s->said[at] = s->said[at - 1];
        }
        s->x[at] = t->of->ns;
        s->y[at] = drawn_at(t, panel);
        s->said[at] = t->error;
        if (t->error < exact)
            snprintf(s->note, sizeof s->note, " (without error: at 10\u207b\u00b9\u2077)");
        else if (isinf(t->error))
            snprintf(s->note, sizeof s->note, " (unbounded: at the top)");
    }
    return s;
}

static void add_front(const field *f, chart *out, chart_panel *panel, int pipeline) {
    chart_series *s = add_methods(f, out, panel, CHART_LINE, FRONT | PIPELINE, FRONT | pipeline);
    if (s == NULL)
        return;
    s->unlisted = true;
    s->style = (chart_style){0, 0, -1, true};
    snprintf(s->name, sizeof s->name, "front");
}

/* Adds a bar for each method from the worst error found to the proven one. */
static void add_bars(const field *f, chart *out, chart_panel *panel) {
    size_t count = 0;
    for (size_t i = 0; i < f->count; i++)
        count += isfinite(f->methods[i].of->bound) && isfinite(f->methods[i].error) ? 1 : 0;
    chart_series *s = add_series(out, panel, CHART_BARS, 2 * count);
    if (s == NULL)
        return;
    s->style = (chart_style){2, 0, -1, false};
    snprintf(s->name, sizeof s->name, "from the worst found to the bound");
    for (size_t i = 0, k = 0; i < f->count; i++) {
        const timed *t = &f->methods[i];
        if (!isfinite(t->of->bound) || isinf(t->error))
            continue;
        s->x[k] = s->x[k + 1] = t->of->ns;
        s->said[k] = t->error;
        s->said[k + 1] = t->of->bound;
        s->y[k++] = fmax(t->error, exact);
        s->y[k++] = t->of->bound;
    }
}

/* Adds a set of methods as points: our own on the front, our own behind it, or a user's. */
static void add_points(const field *f, chart *out, chart_panel *panel, int bits, int set) {
    chart_series *s = add_methods(f, out, panel, CHART_POINTS, bits, set);
    if (s == NULL)
        return;
    s->style = set == MINE    ? (chart_style){3, 2, 2, true}
               : set == FRONT ? (chart_style){0, 0, 0, false}
                              : (chart_style){1, 1, 1, false};
    snprintf(s->name, sizeof s->name, "%s", set == MINE ? "yours" : set == FRONT ? on_front : dominated);
    s->labels = chart_memory(out, s->count, sizeof *s->labels);
    for (size_t i = 0, k = 0; i < f->count && s->labels != NULL; i++) {
        const timed *t = &f->methods[i];
        if ((t->is & bits) == set)
            snprintf(s->labels[k++], sizeof *s->labels, "%s%s", t->of->row->name,
                     t->is & PIPELINE ? " (pipeline)" : "");
    }
}

/* From the least time of each method to that of a quarter of its turns. */
static void add_whiskers(const field *f, chart *out, chart_panel *panel) {
    size_t count = 0;
    for (size_t i = 0; i < f->count; i++)
        count += f->methods[i].of->spread > 0;
    chart_series *s = add_series(out, panel, CHART_SPANS, 2 * count);
    if (s == NULL)
        return;
    s->style = (chart_style){-1, 0, -1, true};
    snprintf(s->name, sizeof s->name, "spread of the times");
    for (size_t i = 0, k = 0; i < f->count; i++) {
        const timed *t = &f->methods[i];
        if (!(t->of->spread > 0))
            continue;
        s->x[k] = t->of->ns;
        s->x[k + 1] = t->of->ns * (1 + t->of->spread);
        s->y[k] = s->y[k + 1] = drawn_at(t, panel);
        s->said[k] = s->said[k + 1] = t->error;
        k += 2;
    }
}

/* A method that waits for memory can be no faster than this line. */
static void add_memory(const field *f, chart *out, chart_panel *panel) {
    chart_series *s = add_series(out, panel, CHART_LINE, f->limit > 0 ? 2 : 0);
    if (s == NULL)
        return;
    s->style = (chart_style){-1, THEME_DOTTED, -1, true};
    snprintf(s->name, sizeof s->name, "moving the same bytes");
    s->x[0] = s->x[1] = f->limit;
    s->y[0] = panel->y.lo;
    s->y[1] = panel->y.hi;
    s->said[0] = s->said[1] = (double)NAN; /* it is a time and no error */
}

/* Whole decades round the data, 1, 2 or 5 of one where they span less, with room for the names. */
static void fit(chart_axis *axis, chart_extent e) {
    const double lo = dp_pow(10, floor(dp_log10(e.lo) - 0.1)), hi = dp_pow(10, ceil(dp_log10(fmax(e.lo, e.hi)) + 0.1));
    axis->lo = lo;
    axis->hi = hi;
    for (int part = 2; part <= 5 && e.hi < 10 * e.lo; part += 3) {
        axis->lo = 1.25 * part * lo <= e.lo ? part * lo : axis->lo;
        axis->hi = hi / part >= 1.25 * e.hi ? hi / part : axis->hi;
    }
}

/* A panel of a family. @return false: it has nothing to show */
static bool add_family(const method_family_row *family, const bench_result *results, size_t count, chart *out) {
    const field f = gather(family, results, count);
    chart_panel *panel = chart_add_panel(out);
    if (isinf(f.error.lo) || panel == NULL)
        return false;
    panel->x = (chart_axis){.scale = CHART_LOG, .label = "time per element", .key = "time", .unit = "ns"};
    panel->y = (chart_axis){.scale = CHART_LOG, .label = "worst error", .key = "error", .unit = family->measure};
    fit(&panel->x, f.time);
    fit(&panel->y, f.error);
    add_front(&f, out, panel, 0);
    add_front(&f, out, panel, PIPELINE);
    add_bars(&f, out, panel);
    add_points(&f, out, panel, FRONT | MINE, 0);
    add_points(&f, out, panel, FRONT | MINE, FRONT);
    add_points(&f, out, panel, MINE, MINE);
    add_whiskers(&f, out, panel);
    add_memory(&f, out, panel);
    return true;
}

const char *pareto_draw(const method_family_row *family, const bench_result *results, size_t count, chart *out) {
    return add_family(family, results, count, out) ? NULL
                                                   : "no method of this family has a time and a finite error here";
}

/* Small panels have room for the names on the front. */
static void name_panel(const method_family_row *family, size_t which, bool one_family, chart_panel *panel) {
    const bool relative = strcmp(family->measure, "relative error") == 0;
    bool front = false;
    const char *none;
    for (size_t i = 0; i < panel->series_count; i++) {
        panel->series[i].unwritten = strcmp(panel->series[i].name, dominated) == 0;
        front = front || strcmp(panel->series[i].name, on_front) == 0;
    }
    none = front ? "" : "; no claim reaches here";
    if (one_family)
        snprintf(panel->title, sizeof panel->title, "%s%s", family->cases[which].name, none);
    else
        snprintf(panel->title, sizeof panel->title, "%s, %s%s%s%s", family->name, family->cases[which].name,
                 relative ? "" : ": ", relative ? "" : family->measure, none);
    if (!one_family) {
        panel->y.label = "worst error, relative where no unit is named";
        panel->y.unit = "";
    }
}

/* The panel of a case. @return null, or why there is none */
static const char *build_case(const method_family_row *family, const bench_result *results, size_t count, chart *out) {
    if (count == 0)
        return "no memory for the methods";
    if (add_family(family, results, count, out))
        return NULL;
    snprintf(out->title, sizeof out->title, "no method of the family %s has a time and a finite error here",
             family->name);
    return out->title; /* which lasts as long as the chart */
}

/* Each family in the first case in which a method keeps what it claims. */
static const char *build_all(const figure_request *request, chart *out, bench_result *results) {
    const dp_spec *planes = &request->setups[0].spec;
    const char *wrong = NULL;
    snprintf(out->subtitle, sizeof out->subtitle, "%s. Lower left is better", request->where);
    out->apart = true;
    for (size_t i = 0; i < METHOD_FAMILY_COUNT && wrong == NULL; i++) {
        const method_family_row *family = method_family_get(i);
        size_t which = 0;
        const size_t count = advice_case(family, planes->znear, planes->zfar, &which, results);
        wrong = build_case(family, results, count, out);
        if (wrong == NULL)
            name_panel(family, which, false, &out->panels[out->panel_count - 1]);
    }
    return wrong;
}

/* One family: a panel for each case that is asked. */
const char *pareto_build(const figure_request *request, chart *out) {
    const dp_spec *planes = &request->setups[0].spec;
    const method_family_row *family = request->family;
    char subtitle[2 * CHART_TEXT], cases[CHART_TEXT] = "";
    bench_result *results = chart_memory(out, BENCH_METHODS_MAX, sizeof *results);
    const char *wrong = NULL;
    if (results == NULL)
        return NULL;
    if (family == NULL)
        return build_all(request, out, results);
    const bool several = (request->cases & (request->cases - 1)) != 0;
    out->apart = several;
    for (size_t i = 0; i < family->case_count && wrong == NULL; i++) {
        dp_setup setup;
        if ((request->cases >> i & 1) == 0 ||
            method_setup(family, i, planes->znear, planes->zfar, planes->ortho, &setup) != DP_OK)
            continue;
        wrong = build_case(family, results, bench_run(family, i, &setup, BENCH_REPETITIONS, results), out);
        if (!several)
            snprintf(cases, sizeof cases, "%s, ", family->cases[i].name);
        else if (wrong == NULL)
            name_panel(family, i, true, &out->panels[out->panel_count - 1]);
    }
    snprintf(subtitle, sizeof subtitle, "%s: %s; %s%s%s", family->name, family->summary, cases, request->where,
             several ? ". Lower left is better" : "");
    notes_clean(out->subtitle, sizeof out->subtitle, subtitle);
    return wrong;
}
