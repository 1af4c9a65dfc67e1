/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/plot_data.h"

#include <stdio.h>

#include "plot/draw.h"
#include "report/csv.h"
#include "report/json.h"

static const char map_name[] = "map";

static void json_axis(json *j, const char *name, const chart_axis *axis) {
    json_object(j, name);
    json_string(j, "key", axis->key);
    json_string(j, "label", axis->label);
    json_string(j, "unit", axis->unit);
    json_string(j, "scale", axis->scale == CHART_LOG ? "log" : "linear");
    json_end(j);
}

static void json_series(json *j, const chart_panel *panel, const chart_series *s) {
    json_object(j, NULL);
    json_string(j, "name", s->name);
    if (s->method != NULL)
        json_string(j, "method", s->method);
    json_array(j, "points");
    for (size_t i = 0; i < s->count; i++) {
        json_object(j, NULL);
        json_number(j, panel->x.key, s->x[i]);
        json_number(j, s->second ? panel->second.key : panel->y.key, s->y[i]);
        json_end(j);
    }
    json_end(j);
    json_end(j);
}

static void json_map(json *j, const chart *c, const chart_panel *panel) {
    const chart_map *m = &panel->map;
    json_object(j, NULL);
    json_string(j, "name", map_name);
    json_array(j, "points");
    for (int row = 0; row < m->rows; row++)
        for (int column = 0; column < m->columns; column++) {
            json_object(j, NULL);
            json_number(j, panel->x.key, m->x[column]);
            json_number(j, panel->y.key, m->y[row]);
            json_number(j, c->value.key, m->value[(size_t)row * (size_t)m->columns + (size_t)column]);
            json_end(j);
        }
    json_end(j);
    json_end(j);
}

void plot_data_json(output *out, const char *figure, const chart *c) {
    char digest[17];
    json j = json_start(out, "plot");
    draw_digest(c, digest);
    json_string(&j, "figure", figure);
    json_string(&j, "title", c->title);
    json_string(&j, "subtitle", c->subtitle);
    json_string(&j, "data", digest);
    json_axis(&j, "x", &c->panels[0].x);
    json_axis(&j, "y", &c->panels[0].y);
    if (c->panels[0].second.label != NULL)
        json_axis(&j, "second", &c->panels[0].second);
    if (c->value.label != NULL)
        json_axis(&j, "value", &c->value);
    json_array(&j, "panels");
    for (size_t p = 0; p < c->panel_count; p++) {
        const chart_panel *panel = &c->panels[p];
        json_object(&j, NULL);
        json_string(&j, "title", panel->title);
        json_array(&j, "series");
        for (size_t s = 0; s < panel->series_count; s++)
            json_series(&j, panel, &panel->series[s]);
        if (panel->map.columns > 0)
            json_map(&j, c, panel);
        json_end(&j);
        json_end(&j);
    }
    json_finish(&j);
}

static void csv_head(csv *c, const chart_axis *axis) {
    char text[CHART_TEXT];
    if (axis->unit[0] == '\0')
        snprintf(text, sizeof text, "%s", axis->key);
    else
        snprintf(text, sizeof text, "%s [%s]", axis->key, axis->unit);
    csv_string(c, text);
}

void plot_data_csv(output *out, const chart *c) {
    csv lines = csv_start(out);
    csv_string(&lines, "panel");
    csv_string(&lines, "series");
    csv_head(&lines, &c->panels[0].x);
    csv_head(&lines, &c->panels[0].y);
    const bool two = c->panels[0].second.label != NULL;
    if (two)
        csv_head(&lines, &c->panels[0].second);
    if (c->value.label != NULL)
        csv_head(&lines, &c->value);
    csv_end(&lines);
    for (size_t p = 0; p < c->panel_count; p++) {
        const chart_panel *panel = &c->panels[p];
        for (size_t s = 0; s < panel->series_count; s++)
            for (size_t i = 0; i < panel->series[s].count; i++) {
                csv_string(&lines, panel->title);
                csv_string(&lines, panel->series[s].name);
                csv_number(&lines, panel->series[s].x[i]);
                if (panel->series[s].second)
                    csv_string(&lines, "");
                csv_number(&lines, panel->series[s].y[i]);
                if (two && !panel->series[s].second)
                    csv_string(&lines, "");
                if (c->value.label != NULL)
                    csv_string(&lines, "");
                csv_end(&lines);
            }
        const chart_map *m = &panel->map;
        for (int i = 0; i < m->columns * m->rows; i++) {
            csv_string(&lines, panel->title);
            csv_string(&lines, map_name);
            csv_number(&lines, m->x[i % m->columns]);
            csv_number(&lines, m->y[i / m->columns]);
            csv_number(&lines, m->value[i]);
            csv_end(&lines);
        }
    }
}
