/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stddef.h>
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

/* Decimal digits that an error leaves: 0 where it is as large as the answer, NaN where there is none. No code has more
 * than the nearest one. */
static double digits(double error, double of_format) {
    if (of_format > 0 && error < 0.5)
        error = 0.5;
    return isnan(error) ? error
           : error > 0  ? fmin(fmax(of_format - dp_log10(error), 0), most_digits)
           : error == 0 ? most_digits
                        : 0;
}

static double claimed(const stability_result *r) {
    return r->claim_to;
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

/* Each method's name, and what takes its digits in the first case in which something does. */
static const char *name_of(const table *t, size_t row, chart *out) {
    char *name = chart_memory(out, CHART_TEXT, 1);
    const char *cause = NULL;
    for (size_t i = 0; i < t->count && cause == NULL; i++)
        cause = t->results[i].row == t->rows[row] ? t->results[i].cause : NULL;
    if (name != NULL)
        snprintf(name, CHART_TEXT, "%s%s%s%s", t->rows[row]->name, cause != NULL ? " (" : "",
                 cause != NULL ? cause : "", cause != NULL ? ")" : "");
    return name;
}

static void add_panel(const table *t, size_t which, const stability_result *first, const char *const *names,
                      chart *out) {
    const double half = sqrt(first->ratio[1] / first->ratio[0]); /* each column is centred on its far/near */
    const double of_format = digits_of_format(t->family, which);
    const bool planes = !t->family->magnitudes;
    chart_panel *panel = chart_add_panel(out);
    if (panel == NULL)
        return;
    snprintf(panel->title, sizeof panel->title, "%s", t->family->cases[which].name);
    panel->x = (chart_axis){.scale = CHART_LOG,
                            .label = planes ? "far/near" : "window depth",
                            .key = planes ? "ratio" : "depth",
                            .unit = ""};
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
    add_marks(t, which, out, claimed, "a digit is claimed up to here", (chart_style){-1, 0, 0, true});
    add_marks(t, which, out, broken, "the claim breaks here", (chart_style){0, 1, 1, true});
    add_marks(t, which, out, lost, "yours is off by more than a half from here on", (chart_style){3, 2, 2, true});
}

/* ---- Cameras besides --------------------------------------------------------------------------------------------- */

/* A camera that has no far/near, or other depth: how it is named below its column and in the numbers. */
typedef struct other {
    const char *tick, *name;
    size_t offset; /* of its error */
    bool apart;    /* cases of reversed depth have a column of their own */
    double x;      /* its far/near, or window depth */
} other;

static const other others[] = {
    {"inf", "far infinite", offsetof(stability_result, infinite), true, INFINITY},
    {"ortho", "orthographic", offsetof(stability_result, ortho), false, STABILITY_BESIDE},
    {"oblique", "oblique near plane", offsetof(stability_result, oblique), false, STABILITY_BESIDE},
    {"log", "logarithmic depth", offsetof(stability_result, log), false, STABILITY_BESIDE},
    {"0 and subnormal numbers", "0 and subnormal numbers", offsetof(stability_result, subnormal), false, 0},
};
enum { OTHERS = sizeof others / sizeof others[0] };

/* A column: of which cameras, and of which cases. */
typedef struct column_of {
    const other *of;
    bool standard, reversed;
} column_of;

/* The fewest digits that a method has left over the cases of a column; NaN where it has none of them. */
static double digits_left(const table *t, const column_of *c, const method_row *row) {
    double least = (double)NAN;
    for (size_t i = 0; i < t->count; i++) {
        const stability_result *r = &t->results[i];
        const bool reversed = dp_mapping_get(t->family->cases[r->which].mapping)->reversed != 0;
        double error;
        memcpy(&error, (const char *)r + c->of->offset, sizeof error);
        if (r->row == row && (reversed ? c->reversed : c->standard))
            least = fmin(least, digits(error, digits_of_format(t->family, r->which)));
    }
    return least;
}

/* Those for which some method has a number. */
static size_t columns_shown(const table *t, column_of *out) {
    size_t count = 0;
    for (size_t i = 0; i < OTHERS; i++)
        for (int turned = 0; turned < (others[i].apart ? 2 : 1); turned++) {
            const column_of c = {&others[i], turned == 0, turned == 1 || !others[i].apart};
            bool any = false;
            for (size_t row = 0; row < t->methods; row++)
                any = any || !isnan(digits_left(t, &c, t->rows[row]));
            if (any)
                out[count++] = c;
        }
    return count;
}

static void add_others(const table *t, chart *out) {
    column_of shown[2 * OTHERS];
    const size_t count = columns_shown(t, shown);
    const char **ticks = chart_memory(out, 2 * OTHERS, sizeof *ticks);
    const char **series = chart_memory(out, 2 * OTHERS, sizeof *series);
    chart_panel *panel = count > 0 && ticks != NULL && series != NULL ? chart_add_panel(out) : NULL;
    if (panel == NULL)
        return;
    for (size_t k = 0; k < count; k++) {
        const bool turned = shown[k].of->apart && shown[k].reversed;
        ticks[k] = turned ? "rev. inf" : shown[k].of->tick;
        series[k] = turned ? "far infinite, reversed" : shown[k].of->name;
    }
    snprintf(panel->title, sizeof panel->title, t->family->magnitudes ? "other depths" : "other cameras");
    panel->x = (chart_axis){.hi = (double)count, .names = ticks, .label = "", .key = out->panels[0].x.key, .unit = ""};
    panel->y = out->panels[0].y;
    if (!chart_add_map(out, panel, (int)count, (int)t->methods))
        return;
    panel->map.names = series;
    for (size_t k = 0; k < count; k++)
        panel->map.x[k] = shown[k].of->x;
    for (size_t row = 0; row < t->methods; row++)
        for (size_t k = 0; k < count; k++)
            *chart_field(&panel->map, (int)row, (int)k) = digits_left(t, &shown[k], t->rows[t->methods - 1 - row]);
}

/* A case of few methods, whose digits stand in a column of the others, has no panel. */
static const stability_result *first_of(const table *t, size_t which) {
    enum { FEW = 3 };
    const stability_result *first = NULL;
    size_t count = 0;
    for (size_t i = t->count; i-- > 0;)
        if (t->results[i].which == which) {
            first = &t->results[i];
            count++;
        }
    return count >= FEW || t->family->besides == 0 ? first : NULL;
}

const char *stability_draw(const method_family_row *family, const stability_result *results, size_t count, chart *out) {
    table t = {.family = family, .results = results, .count = count};
    list_methods(&t);
    const char **names = chart_memory(out, t.methods, sizeof *names);
    for (size_t i = 0; i < t.methods && names != NULL; i++)
        names[t.methods - 1 - i] = name_of(&t, i, out);
    out->value = (chart_axis){.hi = 1, .label = "digits left", .key = "digits", .unit = ""};
    size_t empty = 0;
    for (size_t which = 0; which < family->case_count && names != NULL; which++) {
        const stability_result *first = first_of(&t, which);
        if (first != NULL)
            add_panel(&t, which, first, names, out);
        for (size_t i = 0; i < t.methods && first != NULL; i++)
            empty += find(&t, which, t.rows[i]) == NULL;
    }
    if (names != NULL)
        add_others(&t, out);
    if (empty > 0)
        append(out->subtitle, sizeof out->subtitle, ". Hatched: not of this case");
    return NULL;
}

const char *stability_build(const figure_request *request, chart *out) {
    const method_family_row *family = request->family;
    stability_result *results = chart_memory(out, STABILITY_MAX, sizeof *results);
    const size_t count = results != NULL ? stability_run(family, STABILITY_ALL, results) : 0;
    snprintf(out->subtitle, sizeof out->subtitle, "%s: %s; worst %s%s%s. In parentheses: what %s", family->name,
             family->summary, family->measure, family->magnitudes ? "" : " over four near planes",
             family->steps ? ", as digits of the code" : "",
             family->steps ? "makes codes wrong" : "takes the fourth digit");
    return count > 0 ? stability_draw(family, results, count, out) : "no memory for the methods";
}
