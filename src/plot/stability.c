/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "plot/figure.h"

static const double most_digits = 16;

/* Decimal digits that an error leaves: 0 where it is as large as the answer. */
static double digits(double error) {
    return error > 0 ? fmin(fmax(-log10(error), 0), most_digits) : error == 0 ? most_digits : 0;
}

static double claimed(const stability_result *r) {
    const method_claim *c = &r->row->claims[r->which];
    return isnan(c->worst) ? (double)NAN : c->ratio_hi;
}

static double broken(const stability_result *r) {
    return r->breaks;
}

/* One mark a method, at half its row, where far/near is finite. */
static void add_marks(const stability_result *const *results, size_t count, chart *out, chart_panel *panel,
                      double (*at)(const stability_result *), const char *name, chart_style style) {
    size_t marks = 0;
    for (size_t i = 0; i < count; i++)
        marks += isfinite(at(results[i])) != 0;
    chart_series *s = marks > 0 ? chart_add_series(out, panel, CHART_POINTS, marks) : NULL;
    if (s == NULL)
        return;
    s->style = style;
    snprintf(s->name, sizeof s->name, "%s", name);
    for (size_t i = 0, k = 0; i < count; i++)
        if (isfinite(at(results[i]))) {
            s->x[k] = at(results[i]);
            s->y[k++] = (double)(count - 1 - i) + 0.5; /* the first on top, as in a table */
        }
}

/* Rows from the bottom; the names of the axis are those of the rows. */
static bool add_rows(const method_family_row *family, const stability_result *const *results, size_t count, chart *out,
                     chart_panel *panel) {
    const stability_result *first = results[0];
    const double half = sqrt(first->ratio[1] / first->ratio[0]); /* each column is centred on its far/near */
    const char **names = chart_memory(out, count, sizeof *names);
    char(*text)[CHART_TEXT] = chart_memory(out, count, sizeof *text);
    panel->x = (chart_axis){.scale = CHART_LOG, .label = "far/near", .key = "ratio", .unit = ""};
    panel->x.lo = first->ratio[0] / half;
    panel->x.hi = first->ratio[first->steps - 1] * half;
    panel->y = (chart_axis){.hi = (double)count, .label = "method", .key = "method", .unit = "", .names = names};
    if (names == NULL || text == NULL || !chart_add_map(out, panel, first->steps, (int)count))
        return false;
    double most = 1;
    for (size_t row = 0; row < count; row++) {
        const stability_result *r = results[count - 1 - row];
        snprintf(text[row], sizeof text[row], "%s, %s", r->row->name, family->cases[r->which].name);
        names[row] = text[row];
        for (int k = 0; k < r->steps; k++) {
            *chart_field(&panel->map, (int)row, k) = digits(r->error[k]);
            most = fmax(most, digits(r->error[k]));
        }
    }
    out->value = (chart_axis){.lo = 0, .hi = ceil(most), .label = "digits left", .key = "digits", .unit = ""};
    return true;
}

const char *stability_draw(const method_family_row *family, const stability_result *results, size_t count, chart *out) {
    const stability_result *ordered[STABILITY_MAX];
    size_t used = 0;
    chart_panel *panel = chart_add_panel(out);
    for (size_t which = 0; which < family->case_count; which++) /* what can be compared stands together */
        for (size_t i = 0; i < count; i++)
            if (results[i].which == which)
                ordered[used++] = &results[i];
    if (used == 0 || !add_rows(family, ordered, used, out, panel))
        return NULL;
    add_marks(ordered, used, out, panel, claimed, "claimed up to here", (chart_style){-1, 0, 0, false});
    add_marks(ordered, used, out, panel, broken, "the claim breaks here", (chart_style){0, 1, 1, false});
    return NULL;
}

const char *stability_build(const figure_request *request, chart *out) {
    const method_family_row *family = request->family;
    stability_result *results = chart_memory(out, STABILITY_MAX, sizeof *results);
    const size_t count = results != NULL ? stability_run(family, results) : 0;
    snprintf(out->subtitle, sizeof out->subtitle, "%s: %s; worst %s over near 1e-12, 0.1 and 1e6", family->name,
             family->summary, family->measure);
    return count > 0 ? stability_draw(family, results, count, out) : "no memory for the methods";
}
