/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/cmd_plot/figure_data.h"

#include <math.h>

#include "plot/cmd_plot/figure_sheet.h"
#include "report/report.h"

typedef struct axis {
    const char *key, *label, *unit, *scale;
} axis;

/* A point of a series or a map; null where it lies on no such axis. */
typedef struct point {
    const double *x, *y, *second, *value;
    const char *label; /* null: it has none */
} point;

/* A chart; below `digest`, the panel, series and point at hand. */
typedef struct plotted {
    const chart *chart;
    const char *figure, *title, *subtitle, *unit;
    axis x, y, second, value;
    char digest[17];
    const chart_panel *panel;
    const char *panel_title, *name, *method;
    double certain_to;
    const chart_series *series; /* null: the map */
    point point;
    size_t map_column;
    size_t field; /* of a map that lies on another */
} plotted;

static axis axis_of(const chart_axis *a) {
    return (axis){a->key, a->label, a->unit, a->scale == CHART_LOG ? "log" : "linear"};
}

static void *next_panel(void *of, size_t i) {
    plotted *p = of;
    if (i == p->chart->panel_count)
        return NULL;
    p->panel = &p->chart->panels[i];
    p->panel_title = p->panel->title;
    return p;
}

/* The map comes last, as one series, or as one for each column where these have names. */
static void *next_series(void *of, size_t i) {
    plotted *p = of;
    const chart_map *m = &p->panel->map;
    const size_t maps = m->names != NULL ? (size_t)m->columns : m->columns > 0;
    if (i == p->panel->series_count + maps)
        return NULL;
    p->series = i < p->panel->series_count ? &p->panel->series[i] : NULL;
    p->map_column = i - p->panel->series_count;
    p->name = p->series != NULL ? p->series->name : m->names != NULL ? m->names[p->map_column] : "map";
    p->method = p->series != NULL ? p->series->method : NULL;
    p->certain_to = p->series != NULL ? p->series->certain_to : (double)NAN;
    return p;
}

/* The next field to write: of a map that lies on another, one that has a value. */
static size_t next_field(plotted *p, size_t i) {
    const chart_map *m = &p->panel->map;
    if (p->series != NULL || m->under == NULL)
        return i;
    p->field = i == 0 ? 0 : p->field + 1;
    while (p->field < (size_t)m->columns * (size_t)m->rows && isnan(m->value[p->field]))
        p->field++;
    return p->field;
}

static void *next_point(void *of, size_t at) {
    plotted *p = of;
    const chart_series *s = p->series;
    const chart_map *m = &p->panel->map;
    const size_t columns = (size_t)m->columns;
    const size_t i = s == NULL && m->names != NULL ? at * columns + p->map_column : next_field(p, at);
    if (i >= (s != NULL ? s->count : columns * (size_t)m->rows))
        return NULL;
    if (s == NULL)
        p->point = (point){&m->x[i % columns], &m->y[i / columns], NULL, &m->value[i], NULL};
    else {
        double *y = s->said != NULL ? &s->said[i] : &s->y[i];
        p->point = (point){&s->x[i], s->second ? NULL : y, s->second ? y : NULL, NULL,
                           s->labels != NULL ? s->labels[i] : NULL};
    }
    return &p->point;
}

static const column axis_columns[] = {{FIELD(axis, key, "key", "")},
                                      {FIELD(axis, label, "label", "")},
                                      {FIELD(axis, unit, "unit", "")},
                                      {FIELD(axis, scale, "scale", "")},
                                      {.kind = COLUMN_END}};

enum { WITH_SECOND = 1, WITH_VALUE = 2, WITH_LABELS = 4 };

static bool has_labels(const chart *c) {
    for (size_t i = 0; i < c->panel_count; i++)
        for (size_t k = 0; k < c->panels[i].series_count; k++)
            if (c->panels[i].series[k].labels != NULL)
                return true;
    return false;
}

void figure_data_write(output *out, output_form form, const char *command, const char *figure, const chart *c) {
    const chart_panel *first = &c->panels[0];
    if (form == FORM_CSV && figure_sheet_suits(c)) {
        figure_sheet_write(out, command, c);
        return;
    }
    plotted p = {.chart = c,
                 .figure = figure,
                 .title = c->title,
                 .subtitle = c->subtitle,
                 .unit = c->unit,
                 .x = axis_of(&first->x),
                 .y = axis_of(&first->y),
                 .second = axis_of(&first->second),
                 .value = axis_of(&c->value)};
    const unsigned when = (first->second.label != NULL ? WITH_SECOND : 0) | (c->value.label != NULL ? WITH_VALUE : 0) |
                          (has_labels(c) ? WITH_LABELS : 0);
    chart_digest(c, p.digest);
    const column points[] = {{FIELD(point, x, p.x.key, p.x.unit), .optional = true},
                             {FIELD(point, y, p.y.key, p.y.unit), .optional = true},
                             {FIELD(point, second, p.second.key, p.second.unit), .optional = true, .when = WITH_SECOND},
                             {FIELD(point, value, p.value.key, p.value.unit), .optional = true, .when = WITH_VALUE},
                             {FIELD(point, label, "label", ""), .optional = true, .when = WITH_LABELS},
                             {.kind = COLUMN_END}};
    const column series[] = {{FIELD(plotted, name, "name", ""), .only = AS_JSON},
                             {FIELD(plotted, name, "series", ""), .only = AS_CSV},
                             {FIELD(plotted, method, "method", ""), .only = AS_JSON, .optional = true},
                             {FIELD(plotted, certain_to, "certain_to", "scene"), .only = AS_JSON, .optional = true},
                             {LIST("points", points, next_point)},
                             {.kind = COLUMN_END}};
    const column panels[] = {{FIELD(plotted, panel_title, "title", ""), .only = AS_JSON},
                             {FIELD(plotted, panel_title, "panel", ""), .only = AS_CSV},
                             {LIST("series", series, next_series)},
                             {.kind = COLUMN_END}};
    const column columns[] = {{FIELD(plotted, figure, "figure", ""), .only = AS_JSON},
                              {FIELD(plotted, title, "title", ""), .only = AS_JSON},
                              {FIELD(plotted, subtitle, "subtitle", ""), .only = AS_JSON},
                              {FIELD(plotted, unit, "unit", ""), .only = AS_JSON},
                              {FIELD(plotted, digest, "data", ""), .only = AS_JSON},
                              {PART(plotted, x, "x", axis_columns), .only = AS_JSON},
                              {PART(plotted, y, "y", axis_columns), .only = AS_JSON},
                              {PART(plotted, second, "second", axis_columns), .only = AS_JSON, .when = WITH_SECOND},
                              {PART(plotted, value, "value", axis_columns), .only = AS_JSON, .when = WITH_VALUE},
                              {LIST("panels", panels, next_panel)},
                              {.kind = COLUMN_END}};
    report_write(&(report_spec){command, columns, &p, .when = when}, out, form);
}
