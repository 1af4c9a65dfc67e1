/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/cmd_plot/figure_sheet.h"

#include <math.h>
#include <string.h>

#include "report/report.h"

/* A chart; below `columns`, the panel at hand, and the place of it. */
typedef struct sheet {
    const chart *chart;
    size_t columns;
    const chart_series *of[CHART_SERIES]; /* the first of each name, whose column it is */
    const chart_panel *panel;
    const char *title;
    size_t next[CHART_SERIES]; /* of each series of the panel, its next point */
    double x, y[CHART_SERIES]; /* NaN: none */
} sheet;

static bool rises(const chart_series *s) {
    for (size_t i = 1; i < s->count; i++)
        if (!(s->x[i - 1] < s->x[i]))
            return false;
    return true;
}

static bool panel_suits(const chart_panel *panel) {
    const chart_series *line = NULL;
    for (size_t k = 0; k < panel->series_count; k++) {
        const chart_series *s = &panel->series[k];
        const bool is_line = s->kind == CHART_LINE || s->kind == CHART_AREA;
        if ((!is_line && s->kind != CHART_POINTS) || s->labels != NULL || !rises(s))
            return false;
        if (is_line && line != NULL && (s->count != line->count || memcmp(s->x, line->x, s->count * sizeof *s->x) != 0))
            return false;
        line = is_line ? s : line;
    }
    return line != NULL && panel->map.columns == 0;
}

bool figure_sheet_suits(const chart *c) {
    for (size_t i = 0; i < c->panel_count; i++)
        if (!panel_suits(&c->panels[i]))
            return false;
    return c->panel_count > 0;
}

/* The column of a series, by its name; `columns` where it has none yet. */
static size_t column_of(const sheet *s, const char *name) {
    size_t k = 0;
    while (k < s->columns && strcmp(s->of[k]->name, name) != 0)
        k++;
    return k;
}

static void *next_panel(void *of, size_t i) {
    sheet *s = of;
    if (i == s->chart->panel_count)
        return NULL;
    s->panel = &s->chart->panels[i];
    s->title = s->panel->title;
    memset(s->next, 0, sizeof s->next);
    return s;
}

/* The next place of any series. */
static void *next_place(void *of, size_t i) {
    sheet *s = of;
    (void)i;
    s->x = (double)NAN;
    for (size_t k = 0; k < s->panel->series_count; k++) {
        const chart_series *series = &s->panel->series[k];
        if (s->next[k] < series->count)
            s->x = fmin(s->x, series->x[s->next[k]]);
    }
    for (size_t k = 0; k < s->columns; k++)
        s->y[k] = (double)NAN;
    for (size_t k = 0; k < s->panel->series_count; k++) {
        const chart_series *series = &s->panel->series[k];
        if (s->next[k] < series->count && series->x[s->next[k]] == s->x)
            s->y[column_of(s, series->name) % CHART_SERIES] = series->y[s->next[k]++];
    }
    return isnan(s->x) ? NULL : s;
}

/* Columns of the series that a legend lists, or of the others. */
static void add_columns(sheet *s, column *places, bool unlisted) {
    const chart_panel *first = &s->chart->panels[0];
    for (size_t i = 0; i < s->chart->panel_count; i++)
        for (size_t k = 0; k < s->chart->panels[i].series_count; k++) {
            const chart_series *series = &s->chart->panels[i].series[k];
            if (series->unlisted != unlisted || column_of(s, series->name) < s->columns || s->columns == CHART_SERIES)
                continue;
            column *own = &places[s->columns];
            *own = (column){FIELD(sheet, y[0], series->name, series->second ? first->second.unit : first->y.unit)};
            own->offset = offsetof(sheet, y) + s->columns * sizeof s->y[0];
            s->of[s->columns++] = series;
        }
}

void figure_sheet_write(output *out, const char *command, const chart *c) {
    enum { SEVERAL = 1 };
    sheet s = {.chart = c};
    column places[CHART_SERIES + 2] = {{FIELD(sheet, x, c->panels[0].x.key, c->panels[0].x.unit)}};
    for (int unlisted = 0; unlisted < 2; unlisted++)
        add_columns(&s, places + 1, unlisted);
    places[1 + s.columns] = (column){.kind = COLUMN_END};
    const column panels[] = {{FIELD(sheet, title, "panel", ""), .when = SEVERAL},
                             {LIST("places", places, next_place)},
                             {.kind = COLUMN_END}};
    const column columns[] = {{LIST("panels", panels, next_panel)}, {.kind = COLUMN_END}};
    report_write(&(report_spec){command, columns, &s, .when = c->panel_count > 1 ? SEVERAL : 0}, out, FORM_CSV);
}
