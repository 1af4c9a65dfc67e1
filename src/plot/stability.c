/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "plot/figure.h"

static const double most_digits = 16;

/* Decimal digits that an error leaves: 0 where it is as large as the answer. */
static double digits(double error) {
    return error > 0 ? fmin(fmax(-log10(error), 0), most_digits) : error == 0 ? most_digits : 0;
}

/* One mark a method, at half its row, where far/near is finite. */
static void add_marks(const figure_methods *m, chart *out, chart_panel *panel, const double *at, const char *name,
                      chart_style style) {
    size_t count = 0;
    for (size_t i = 0; i < m->count; i++)
        count += isfinite(at[i]) != 0;
    chart_series *s = count > 0 ? chart_add_series(out, panel, CHART_POINTS, count) : NULL;
    if (s == NULL)
        return;
    s->style = style;
    snprintf(s->name, sizeof s->name, "%s", name);
    count = 0;
    for (size_t i = 0; i < m->count; i++) {
        if (!isfinite(at[i]))
            continue;
        s->x[count] = at[i];
        s->y[count++] = (double)(m->count - 1 - i) + 0.5; /* the first on top, as in a table */
    }
}

const char *stability_build(const figure_request *request, chart *out) {
    const figure_methods *m = request->methods;
    chart_panel *panel = chart_add_panel(out);
    if (m == NULL || m->steps < 2)
        return "no methods to show";
    if (panel == NULL)
        return NULL;
    const char **names = chart_memory(out, m->count, sizeof *names);
    if (names == NULL)
        return NULL;
    for (size_t i = 0; i < m->count; i++)
        names[m->count - 1 - i] = m->names[i];
    double half = sqrt(m->ratios[1] / m->ratios[0]); /* each column is centred on its far/near */
    panel->x = (chart_axis){.scale = CHART_LOG,
                            .lo = m->ratios[0] / half,
                            .hi = m->ratios[m->steps - 1] * half,
                            .label = "far/near",
                            .key = "ratio",
                            .unit = ""};
    panel->y =
        (chart_axis){.lo = 0, .hi = (double)m->count, .label = "method", .key = "method", .unit = "", .names = names};
    double most = 1;
    for (size_t i = 0; i < m->count * m->steps; i++)
        most = fmax(most, digits(m->errors[i]));
    out->value = (chart_axis){.lo = 0, .hi = ceil(most), .label = "digits left", .key = "digits", .unit = ""};
    if (!chart_add_map(out, panel, (int)m->steps, (int)m->count))
        return NULL;
    for (size_t i = 0; i < m->count; i++)
        for (size_t k = 0; k < m->steps; k++)
            panel->map.value[(m->count - 1 - i) * m->steps + k] = digits(m->errors[i * m->steps + k]);
    add_marks(m, out, panel, m->claimed, "claimed up to here", (chart_style){-1, 0, 0, false});
    add_marks(m, out, panel, m->breaks, "the claim breaks here", (chart_style){0, 1, 1, false});
    return NULL;
}
