/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/append.h"
#include "core/elementary.h"
#include "plot/figure.h"

static const double most_digits = 16;

/* The table of a figure: a panel for each case, in all of them the same methods in the same rows. */
typedef struct table {
    const method_family_row *family;
    const stability_result *results;
    size_t count;
    size_t methods;
    const method_row *rows[BENCH_METHODS_MAX];
} table;

/* Null where the method does not speak of the case. */
static const stability_result *find(const table *t, size_t which, const method_row *row) {
    for (size_t i = 0; i < t->count; i++)
        if (t->results[i].which == which && t->results[i].row == row)
            return &t->results[i];
    return NULL;
}

static void list_methods(table *t) {
    for (size_t i = 0; i < t->count; i++)
        if (t->methods == 0 || t->rows[t->methods - 1] != t->results[i].row)
            t->rows[t->methods++] = t->results[i].row;
}

/* Decimal digits of a format's codes, which an error of one step leaves; 0 of families whose errors are relative. */
static double digits_of_format(const method_family_row *family, size_t which) {
    dp_format format[2];
    if (!family->steps || dp_format_parse(family->cases[which].format, format) == 0)
        return 0;
    return dp_log10(2) * (format[0].kind == DP_FORMAT_FLOAT ? format[0].mantissa_bits + 1 : format[0].bits);
}

/* Decimal digits that an error leaves: 0 where it is as large as the answer, NaN where there is none. */
static double digits(double error, double of_format) {
    return isnan(error) ? error
           : error > 0  ? fmin(fmax(of_format - dp_log10(error), 0), most_digits)
           : error == 0 ? most_digits
                        : 0;
}

static double claimed(const stability_result *r) {
    const method_claim *c = &r->row->claims[r->which];
    return isnan(c->worst) ? (double)NAN : c->ratio_hi;
}

static double broken(const stability_result *r) {
    return r->row->asked > 0 ? (double)NAN : r->breaks;
}

static double lost(const stability_result *r) {
    return r->row->asked > 0 ? r->breaks : (double)NAN;
}

/* One mark a method, at half its row, where far/near is finite. */
static void add_marks(const table *t, size_t which, chart *out, double (*at)(const stability_result *),
                      const char *name, chart_style style) {
    chart_panel *panel = &out->panels[out->panel_count - 1];
    double x[BENCH_METHODS_MAX], y[BENCH_METHODS_MAX];
    size_t marks = 0;
    for (size_t i = 0; i < t->methods; i++) {
        const stability_result *r = find(t, which, t->rows[i]);
        if (r == NULL || !isfinite(at(r)))
            continue;
        x[marks] = at(r);
        y[marks++] = (double)(t->methods - 1 - i) + 0.5; /* the first on top, as in a table */
    }
    chart_series *s = marks > 0 ? chart_add_series(out, panel, CHART_POINTS, marks) : NULL;
    if (s == NULL)
        return;
    s->style = style;
    snprintf(s->name, sizeof s->name, "%s", name);
    memcpy(s->x, x, marks * sizeof *x);
    memcpy(s->y, y, marks * sizeof *y);
}

static void add_panel(const table *t, size_t which, const stability_result *first, const char *const *names,
                      chart *out) {
    const double half = sqrt(first->ratio[1] / first->ratio[0]); /* each column is centred on its far/near */
    const double of_format = digits_of_format(t->family, which);
    chart_panel *panel = chart_add_panel(out);
    snprintf(panel->title, sizeof panel->title, "%s", t->family->cases[which].name);
    panel->x = (chart_axis){.scale = CHART_LOG, .label = "far/near", .key = "ratio", .unit = ""};
    panel->x.lo = first->ratio[0] / half;
    panel->x.hi = first->ratio[first->steps - 1] * half;
    panel->y = (chart_axis){.hi = (double)t->methods, .label = "method", .key = "method", .unit = "", .names = names};
    if (!chart_add_map(out, panel, first->steps, (int)t->methods))
        return;
    for (size_t row = 0; row < t->methods; row++) {
        const stability_result *r = find(t, which, t->rows[t->methods - 1 - row]);
        for (int k = 0; k < first->steps; k++) {
            const double left = r != NULL ? digits(r->error[k], of_format) : (double)NAN; /* hatched */
            *chart_field(&panel->map, (int)row, k) = left;
            out->value.hi = fmax(out->value.hi, ceil(left)); /* fmax drops NaN */
        }
    }
    add_marks(t, which, out, claimed, "claimed up to here", (chart_style){-1, 0, 0, true});
    add_marks(t, which, out, broken, "the claim breaks here", (chart_style){0, 1, 1, true});
    add_marks(t, which, out, lost, "yours is off by more than a half from here on", (chart_style){3, 2, 2, true});
}

const char *stability_draw(const method_family_row *family, const stability_result *results, size_t count, chart *out) {
    table t = {.family = family, .results = results, .count = count};
    list_methods(&t);
    const char **names = chart_memory(out, t.methods, sizeof *names);
    for (size_t i = 0; i < t.methods && names != NULL; i++)
        names[t.methods - 1 - i] = t.rows[i]->name;
    out->value = (chart_axis){.hi = 1, .label = "digits left", .key = "digits", .unit = ""};
    for (size_t which = 0; which < family->case_count && names != NULL; which++)
        for (size_t i = 0; i < count; i++)
            if (results[i].which == which) {
                add_panel(&t, which, &results[i], names, out);
                break;
            }
    if (count < out->panel_count * t.methods)
        append(out->subtitle, sizeof out->subtitle, ". Hatched: not of this case");
    return NULL;
}

const char *stability_build(const figure_request *request, chart *out) {
    const method_family_row *family = request->family;
    stability_result *results = chart_memory(out, STABILITY_MAX, sizeof *results);
    const size_t count = results != NULL ? stability_run(family, STABILITY_ALL, results) : 0;
    snprintf(out->subtitle, sizeof out->subtitle, "%s: %s; worst %s over four near planes%s", family->name,
             family->summary, family->measure, family->steps ? ", as digits of the code" : "");
    return count > 0 ? stability_draw(family, results, count, out) : "no memory for the methods";
}
