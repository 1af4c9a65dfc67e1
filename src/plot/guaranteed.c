/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/guaranteed.h"

#include <math.h>
#include <stdio.h>

#include "core/append.h"
#include "core/engine.h"
#include "core/search.h"
#include "draw/ticks.h"

bool guaranteed_has(const figure_request *request, size_t i) {
    return request->guaranteed || request->setups[i].spec.model == DP_MODEL_FLOAT;
}

static size_t count_of(const figure_request *request) {
    size_t count = 0;
    for (size_t i = 0; i < request->count; i++)
        count += guaranteed_has(request, i);
    return count;
}

static void into_background(chart_series *s) {
    s->style.thin = true;
    s->style.marker = -1;
    s->unlisted = true;
    s->note[0] = '\0';
    append(s->name, sizeof s->name, ", lattice");
}

chart_panel *guaranteed_begin(const figure_request *request, chart *out, quantity_kind q) {
    dp_setup lattice[CHART_SETUPS];
    figure_request cells = *request;
    cells.setups = lattice;
    for (size_t i = 0; i < request->count; i++) {
        lattice[i] = request->setups[i];
        if (guaranteed_has(request, i))
            dp_setup_in(&request->setups[i], DP_MODEL_EXACT, &lattice[i]);
    }
    chart_panel *panel = envelope_curves(&cells, out, q);
    for (size_t i = 0; i < request->count && !chart_failed(out); i++)
        if (guaranteed_has(request, i))
            into_background(&panel->series[i]);
    return panel;
}

/* ---- Where a curve ends ------------------------------------------------------------------------------------------ */

double guaranteed_certain_to(const refine_request *q, const dp_setup *setup, guaranteed_function *separation,
                             const void *of) {
    dp_edge e = {.holds = q->lo, .fails = refine_edge(q->scale, q->lo, q->hi, q->columns - 1, q->columns)};
    if (isinf(setup->spec.zfar) || dp_is_certain(setup, e.fails, separation(of, e.fails)))
        return NAN;
    if (!dp_is_certain(setup, e.holds, separation(of, e.holds)))
        return nextafter(e.holds, -HUGE_VAL);
    for (double z; dp_edge_between(&e, &z);)
        *(dp_is_certain(setup, z, separation(of, z)) ? &e.holds : &e.fails) = z;
    return e.holds;
}

static double separation_at(const void *setup, double z) {
    return dp_separation(setup, z);
}

/* A set-up, and how far its separation is shown. */
typedef struct reach {
    const dp_setup *setup;
    double to;
} reach;

/* A column in which certainty ends shows what lies before; of those behind nothing is shown. */
static void sample(const void *context, double from, double to, refine_sample *out) {
    const reach *r = context;
    envelope_separation(r->setup, from, fmin(to, r->to), out);
}

chart_series *guaranteed_separation(chart *out, chart_panel *panel, refine_request *q, const dp_setup *setup) {
    const double to = guaranteed_certain_to(q, setup, separation_at, setup);
    const reach r = {setup, isnan(to) ? HUGE_VAL : to};
    q->sample = sample;
    q->context = &r;
    q->slices = true;
    chart_series *s = envelope_curve(out, panel, q);
    q->sample = envelope_separation;
    q->context = setup;
    if (s != NULL)
        s->certain_to = to;
    return s;
}

/* Where the values of a line become infinite, between two places of it; NaN: nowhere. */
static double unbounded_from(const refine_request *q, const chart_series *s) {
    size_t k = 0;
    while (k < s->count && !isinf(s->y[k]))
        k++;
    if (k == s->count)
        return NAN;
    dp_edge e = {.holds = k > 0 ? s->x[k - 1] : q->lo, .fails = k + 1 < s->count ? s->x[k + 1] : q->hi};
    for (double x; dp_edge_between(&e, &x);) {
        refine_sample at;
        q->sample(q->context, x, x, &at);
        *(isinf(at.y[0]) ? &e.fails : &e.holds) = x;
    }
    return e.fails;
}

static void say_end(const refine_request *q, chart_series *s) {
    char text[TICKS_TEXT];
    const double end = isnan(s->certain_to) ? unbounded_from(q, s) : s->certain_to;
    if (isnan(end))
        return;
    ticks_about(end, text);
    snprintf(s->note, sizeof s->note, " (ends at %s)", text);
}

/* ---- Curves ------------------------------------------------------------------------------------------------------ */

chart_series *guaranteed_add(const figure_request *request, chart *out, chart_panel *panel, size_t i,
                             const dp_setup *setup, refine_function *error) {
    if (!guaranteed_has(request, i) || chart_failed(out))
        return NULL;
    refine_request q = envelope_request(request, setup, out, panel, error, setup);
    q.slices = true;
    chart_series *s = error != NULL ? envelope_curve(out, panel, &q) : guaranteed_separation(out, panel, &q, setup);
    if (s == NULL)
        return NULL;
    say_end(&q, s);
    s->style = figure_style(request, i);
    snprintf(s->name, sizeof s->name, "%s", request->names[i]);
    return s;
}

void guaranteed_end(const figure_request *request, chart *out, const char *title) {
    size_t computed = 0, count = count_of(request);
    chart_fit(out);
    if (count == 0)
        return;
    for (size_t i = 0; i < request->count; i++)
        computed += guaranteed_has(request, i) && dp_is_computed(&request->setups[i]);
    if (out->title[0] == '\0')
        snprintf(out->title, sizeof out->title, "%s", title);
    append(out->subtitle, sizeof out->subtitle, ". Thick: guaranteed%s%s. Thin: the lattice of codes alone",
           computed > 0 ? " in binary32 arithmetic" : "", computed < count ? " (linear: in the model staged)" : "");
}
