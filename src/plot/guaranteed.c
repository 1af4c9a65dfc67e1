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

chart_panel *guaranteed_begin(const figure_request *request, chart *out, chart_axis y, const char *guaranteed,
                              envelope_value value, bool interval) {
    dp_setup lattice[CHART_SETUPS];
    figure_request cells = *request;
    cells.setups = lattice;
    for (size_t i = 0; i < request->count; i++) {
        dp_spec spec = request->setups[i].spec;
        lattice[i] = request->setups[i];
        spec.model = DP_MODEL_EXACT;
        if (guaranteed_has(request, i))
            dp_setup_init(&lattice[i], &spec);
    }
    if (count_of(request) > 0)
        y.label = guaranteed;
    chart_panel *panel = envelope_curves(&cells, out, y, value, interval);
    for (size_t i = 0; i < request->count && !chart_failed(out); i++)
        if (guaranteed_has(request, i))
            into_background(&panel->series[i]);
    return panel;
}

/* Where the values of a line become infinite, between two places of it. */
static void say_end(const refine_request *q, chart_series *s) {
    char text[TICKS_TEXT];
    size_t k = 0;
    while (k < s->count && !isinf(s->y[k]))
        k++;
    if (k == s->count)
        return;
    dp_edge e = {.holds = k > 0 ? s->x[k - 1] : q->lo, .fails = k + 1 < s->count ? s->x[k + 1] : q->hi};
    for (double x; dp_edge_between(&e, &x);) {
        refine_sample at;
        q->sample(q->context, x, x, &at);
        *(isinf(at.y[0]) ? &e.fails : &e.holds) = x;
    }
    ticks_about(e.fails, text);
    snprintf(s->note, sizeof s->note, " (ends at %s)", text);
}

chart_series *guaranteed_add(const figure_request *request, chart *out, chart_panel *panel, size_t i,
                             const dp_setup *setup, refine_function *sample) {
    if (!guaranteed_has(request, i) || chart_failed(out))
        return NULL;
    refine_request q = envelope_request(request, setup, out, panel, sample, setup);
    q.slices = true;
    chart_series *s = envelope_curve(out, panel, &q);
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
