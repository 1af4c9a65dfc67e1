/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A requirement file: a panel for each set-up, in it what the set-up gives as curves, and each requirement as a level
 * line over its range, marked where it is worst. A requirement is met where the curve runs below its line, or on it.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "camera/surfaces.h"
#include "core/append.h"
#include "core/elementary.h"
#include "core/engine.h"
#include "draw/notes.h"
#include "draw/theme.h"
#include "plot/guaranteed.h"
#include "solve/check.h"
#include "solve/model.h"
#include "system/posix.h"

enum { COLOUR_SEPARATION = 0, COLOUR_MISSED = 1, COLOUR_MET = 2, COLOUR_CELLS = 3 };
enum { MARKER_MET = 0, MARKER_MISSED = 4 };

/* The verdicts to show. */
typedef struct needs {
    figure_request request; /* its range is what is shown, its set-up that of a panel */
    size_t count, passed, ties;
    check_verdict *verdicts;
} needs;

/* Shares of ties have no place on an axis of lengths: they are not judged, and the subtitle says so. */
static bool no_ties(void *context, const dp_setup *setup, double lo, double hi, bool sample, double *share, double *z) {
    (void)context, (void)setup, (void)hi, (void)sample;
    *share = 0.0;
    *z = lo;
    return true;
}

static void check_requirements(needs *s, chart *out) {
    const need_file *file = s->request.file;
    const size_t all = check_count(file);
    s->verdicts = chart_memory(out, all, sizeof *s->verdicts);
    if (s->verdicts == NULL)
        return;
    check_all(&(check_request){.file = file, .count = no_ties}, s->verdicts);
    for (size_t i = 0; i < all; i++)
        if (quantity_get(s->verdicts[i].asked->kind)->at == NULL) {
            s->ties++;
        } else {
            s->passed += s->verdicts[i].passed;
            s->verdicts[s->count++] = s->verdicts[i];
        }
}

static bool same_setup(const check_verdict *a, const check_verdict *b) {
    return a->camera == b->camera && strcmp(a->setup.spec.format.name, b->setup.spec.format.name) == 0;
}

/* The set-up that the curves are drawn of: the fullest model that the camera asks for. */
static dp_setup curve_setup(const check_verdict *v) {
    const need_camera *camera = v->camera;
    const bool second = strcmp(camera->setups[0].spec.format.name, v->setup.spec.format.name) != 0;
    dp_setup setup = camera->setups[second];
    if (camera->automatic)
        dp_setup_in(&camera->setups[second], DP_MODEL_FLOAT, &setup);
    return setup;
}

/* The depths to show: those that are asked about, with a margin, behind them one that a name fits into. */
static void find_range(needs *s) {
    double lo = INFINITY, hi = 0;
    if (!isnan(s->request.lo))
        return;
    for (size_t i = 0; i < s->count; i++) {
        const need *n = s->verdicts[i].asked;
        lo = fmin(lo, n->lo);
        hi = fmax(hi, isinf(n->hi) ? 100 * n->lo : n->hi);
    }
    const double margin = dp_pow(hi / lo, 0.05) * 1.2;
    s->request.lo = lo / margin;
    s->request.hi = hi * dp_pow(margin, 5);
}

typedef struct cells {
    const dp_setup *setup;
    quantity_kind kind;
} cells;

static void sample(const void *context, double from, double to, refine_sample *out) {
    const cells *c = context;
    envelope_slice(c->setup, from, to, c->kind, out);
}

static void add_curve(const figure_request *r, chart *out, chart_panel *panel, const dp_setup *given,
                      quantity_kind kind) {
    const bool of_cells = quantity_get(kind)->of_cells != NULL;
    dp_setup staged; /* in which it is judged where float, which has no cells, is the fullest */
    const bool other = of_cells && given->spec.model == DP_MODEL_FLOAT && dp_setup_in(given, DP_MODEL_STAGED, &staged);
    const dp_setup *setup = other ? &staged : given;
    const cells c = {setup, kind};
    refine_request q = envelope_request(r, setup, out, panel, sample, &c);
    q.lo = fmax(q.lo, setup->spec.znear);
    q.hi = fmin(q.hi, setup->spec.zfar);
    q.slices = true;
    chart_series *s = !(q.lo < q.hi) ? NULL
                      : of_cells     ? envelope_curve(out, panel, &q)
                                     : guaranteed_separation(out, panel, &q, setup);
    if (s == NULL)
        return;
    s->style =
        (chart_style){of_cells ? COLOUR_CELLS : COLOUR_SEPARATION, of_cells ? THEME_DOTTED : THEME_SOLID, -1, false};
    snprintf(s->name, sizeof s->name, "%s given", quantity_get(kind)->name);
}

/* Adds a level for each requirement over its depths, then a point where it is worst, with its name. */
static void add_needs(const needs *s, chart *out, chart_panel *panel, const check_verdict *first, bool passed) {
    size_t count = 0, k = 0;
    for (size_t i = 0; i < s->count; i++)
        count += same_setup(first, &s->verdicts[i]) && s->verdicts[i].passed == passed;
    if (count == 0)
        return;
    chart_series *levels = chart_add_series(out, panel, CHART_LEVELS, 2 * count);
    chart_series *points = chart_add_series(out, panel, CHART_POINTS, count);
    if (levels == NULL || points == NULL)
        return;
    points->labels = chart_memory(out, count, sizeof *points->labels);
    if (points->labels == NULL)
        return;
    levels->style = (chart_style){passed ? COLOUR_MET : COLOUR_MISSED, 0, -1, false};
    points->style =
        (chart_style){passed ? COLOUR_MET : COLOUR_MISSED, passed ? 0 : 1, passed ? MARKER_MET : MARKER_MISSED, false};
    snprintf(levels->name, sizeof levels->name, "allowed, %s", passed ? "met" : "missed");
    snprintf(points->name, sizeof points->name, "%s, where it is worst", passed ? "met" : "missed");
    for (size_t i = 0; i < s->count; i++) {
        const check_verdict *v = &s->verdicts[i];
        const need *n = v->asked;
        if (!same_setup(first, v) || v->passed != passed)
            continue;
        const double hi = fmax(fmin(n->hi, panel->x.hi), n->lo); /* behind the panel's end where all of it is */
        memcpy(&levels->x[2 * k], (double[]){n->lo, hi}, 2 * sizeof hi);
        memcpy(&levels->y[2 * k], (double[]){n->limit, n->limit}, 2 * sizeof hi);
        points->x[k] = fmin(isfinite(v->z) ? v->z : hi, hi);
        points->y[k] = n->limit;
        snprintf(points->labels[k], sizeof *points->labels, "%s", n->name);
        if (quantity_get(n->kind)->of_cells != NULL)
            append(points->labels[k], sizeof *points->labels, " (%s)", quantity_get(n->kind)->name);
        k++;
    }
}

static void add_panel(needs *s, chart *out, const check_verdict *first) {
    const chart_axis y = {.scale = CHART_LOG, .label = "allowed and given", .key = "length", .unit = "scene units"};
    const dp_setup setup = curve_setup(first);
    const dp_spec *spec = &setup.spec;
    bool wanted[QUANTITY_COUNT] = {false};
    s->request.setups = &setup;
    chart_panel *panel = figure_panel(&s->request, out, y);
    snprintf(panel->title, sizeof panel->title, "%s: %s %s, %s%s%s", first->camera->name, spec->format.name,
             dp_mapping_get(spec->mapping)->name, model_word(spec->model), spec->triangles.width > 0 ? ", " : "",
             spec->triangles.width > 0 ? surfaces_words(&spec->triangles).text : "");
    for (size_t i = 0; i < s->count; i++)
        wanted[s->verdicts[i].asked->kind] |= same_setup(first, &s->verdicts[i]);
    for (int q = 0; q < QUANTITY_COUNT; q++)
        if (wanted[q])
            add_curve(&s->request, out, panel, &setup, (quantity_kind)q);
    add_needs(s, out, panel, first, true);
    add_needs(s, out, panel, first, false);
}

static void write_subtitle(const needs *s, chart *out) {
    const need_file *file = s->request.file;
    char text[sizeof out->subtitle];
    snprintf(text, sizeof text, "%.100s: %zu met, %zu missed", path_name(file->path), s->passed, s->count - s->passed);
    out->unit = file->unit[0] != '\0' ? file->unit : NULL;
    if (s->ties > 0)
        append(text, sizeof text, "; not shown: %zu of ties and biases", s->ties);
    notes_clean(out->subtitle, sizeof out->subtitle, text);
}

const char *needs_build(const figure_request *request, chart *out) {
    needs s = {.request = *request};
    s.request.every = false; /* each curve has its own depths */
    for (size_t i = 0; i < request->file->camera_count; i++)
        if (request->file->cameras[i].world > 0.0)
            return "plot needs: a camera with from_origin has no curve: check judges it";
    check_requirements(&s, out);
    if (s.count == 0 && !chart_failed(out)) {
        snprintf(out->subtitle, sizeof out->subtitle, "plot needs: %s limits no separation and no error",
                 request->file->path);
        return out->subtitle;
    }
    write_subtitle(&s, out);
    find_range(&s);
    for (size_t i = 0; i < s.count; i++) {
        size_t before = 0;
        while (!same_setup(&s.verdicts[before], &s.verdicts[i]))
            before++;
        if (before == i && out->panel_count == CHART_PANELS)
            return "plot needs: shows at most 8 cameras with requirements";
        if (before == i)
            add_panel(&s, out, &s.verdicts[i]);
    }
    chart_fit(out);
    return NULL;
}
