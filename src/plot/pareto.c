/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "plot/figure.h"

/* A log axis has no 0: what is exact is drawn here, and the legend says so. */
static const double exact = 1e-17;

static double drawn(double error) {
    return fmax(error, exact);
}

static bool shown(const figure_methods *m, size_t i) {
    return isfinite(m->errors[i]) && isfinite(m->ns[i]) && m->ns[i] > 0;
}

/* The front of a group, fastest first. */
static size_t front_of(const figure_methods *m, int group, size_t *order) {
    size_t count = 0;
    for (size_t i = 0; i < m->count; i++) {
        if (!shown(m, i) || !m->front[i] || m->group[i] != group)
            continue;
        size_t k = count++;
        for (; k > 0 && m->ns[order[k - 1]] > m->ns[i]; k--)
            order[k] = order[k - 1];
        order[k] = i;
    }
    return count;
}

static void add_points(const figure_methods *m, chart *out, chart_panel *panel, bool front) {
    size_t count = 0;
    bool zero = false;
    for (size_t i = 0; i < m->count; i++)
        count += shown(m, i) && m->front[i] == front;
    chart_series *s = count > 0 ? chart_add_series(out, panel, CHART_POINTS, count) : NULL;
    if (s == NULL)
        return;
    s->style = front ? (chart_style){0, 0, 0, false} : (chart_style){1, 1, 1, false};
    snprintf(s->name, sizeof s->name, "%s", front ? "on the Pareto front" : "behind it");
    count = 0;
    for (size_t i = 0; i < m->count; i++) {
        if (!shown(m, i) || m->front[i] != front)
            continue;
        s->x[count] = m->ns[i];
        s->y[count++] = drawn(m->errors[i]);
        zero = zero || m->errors[i] < exact;
    }
    if (zero)
        snprintf(s->note, sizeof s->note, " (without error: at 10\u207b\u00b9\u2077)");
}

static void add_labels(const figure_methods *m, chart *out, chart_panel *panel) {
    size_t count = 0;
    for (size_t i = 0; i < m->count; i++)
        count += shown(m, i);
    chart_series *s = chart_add_series(out, panel, CHART_LABELS, count);
    if (s == NULL)
        return;
    s->unlisted = true;
    snprintf(s->name, sizeof s->name, "methods");
    s->labels = chart_memory(out, count, sizeof *s->labels);
    count = 0;
    for (size_t i = 0; i < m->count; i++) {
        if (!shown(m, i))
            continue;
        s->x[count] = m->ns[i];
        s->y[count] = drawn(m->errors[i]);
        if (s->labels != NULL)
            snprintf(s->labels[count], sizeof s->labels[count], "%s", m->names[i]);
        count++;
    }
}

/* Whole decades round the data, with room for the names. */
static void fit(chart_axis *axis, double lo, double hi) {
    axis->lo = pow(10, floor(log10(lo) - 0.1));
    axis->hi = pow(10, ceil(log10(hi) + 0.1));
}

const char *pareto_build(const figure_request *request, chart *out) {
    enum { MOST = 64 };
    const figure_methods *m = request->methods;
    size_t order[MOST], count;
    chart_panel *panel = chart_add_panel(out);
    if (m == NULL || m->count > MOST)
        return "no methods to show";
    if (panel == NULL)
        return NULL;
    double lo[2] = {(double)INFINITY, (double)INFINITY}, hi[2] = {0, 0};
    for (size_t i = 0; i < m->count; i++) {
        if (!shown(m, i))
            continue;
        lo[0] = fmin(lo[0], m->ns[i]);
        hi[0] = fmax(hi[0], m->ns[i]);
        lo[1] = fmin(lo[1], drawn(m->errors[i]));
        hi[1] = fmax(hi[1], drawn(m->errors[i]));
    }
    if (hi[0] <= 0)
        return "no method of this family has a time and a finite error here";
    panel->x = (chart_axis){.scale = CHART_LOG, .label = "time an element", .key = "time", .unit = "ns"};
    panel->y = (chart_axis){.scale = CHART_LOG, .label = "worst error", .key = "error", .unit = m->measure};
    fit(&panel->x, lo[0], hi[0]);
    fit(&panel->y, lo[1], hi[1]);
    for (int group = 0; group < 2; group++) {
        count = front_of(m, group, order);
        chart_series *line = count > 1 ? chart_add_series(out, panel, CHART_LINE, count) : NULL;
        if (line != NULL) {
            line->unlisted = true;
            line->style = (chart_style){0, 0, -1, true};
            snprintf(line->name, sizeof line->name, "front");
            for (size_t i = 0; i < count; i++) {
                line->x[i] = m->ns[order[i]];
                line->y[i] = drawn(m->errors[order[i]]);
            }
        }
    }
    add_points(m, out, panel, false);
    add_points(m, out, panel, true);
    add_labels(m, out, panel);
    return NULL;
}
