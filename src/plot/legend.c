/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/legend.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plot/series.h"
#include "plot/words.h"

#define SWATCH  42.0 /* px at scale 1 */
#define GAP     7.0
#define BETWEEN 22.0

static const char arrow_note[] = "unbounded from here: nothing behind is told apart";

static bool listed(const legend *l, const chart_series *s) {
    for (size_t i = 0; i < l->count; i++)
        if (strcmp(l->entries[i]->name, s->name) == 0)
            return true;
    return false;
}

static const char *text_of(const chart_series *s, char out[2 * CHART_TEXT]) {
    snprintf(out, 2 * CHART_TEXT, "%s%s", s->name, s->note);
    return out;
}

static double entry_width(const pencil *p, const chart_series *s) {
    char text[2 * CHART_TEXT];
    return (SWATCH + GAP) * p->scale + canvas_text_width(p->c, text_of(s, text), &p->text);
}

/* As many columns as fit, each as wide as its widest entry. */
static bool arrange(const pencil *p, legend *l, size_t rows, double width) {
    l->rows = rows;
    l->columns = (l->count + rows - 1) / rows;
    double sum = -BETWEEN * p->scale;
    for (size_t column = 0; column < l->columns; column++) {
        l->column_width[column] = 0;
        for (size_t i = column * rows; i < l->count && i < (column + 1) * rows; i++)
            l->column_width[column] = fmax(l->column_width[column], entry_width(p, l->entries[i]));
        l->column_width[column] += BETWEEN * p->scale;
        sum += l->column_width[column];
    }
    return sum <= width;
}

/* How many entries stand together: those of one format, which share a colour. 1 when they do not come in equal groups.
 */
static size_t group_size(const legend *l) {
    size_t size = 1;
    while (size < l->count && l->entries[size]->style.colour == l->entries[0]->style.colour)
        size++;
    return size < l->count && l->count % size == 0 ? size : 1;
}

/* Does a line end in an arrow? */
static bool has_blind(const chart *c) {
    for (size_t p = 0; p < c->panel_count; p++)
        for (size_t s = 0; s < c->panels[p].series_count; s++) {
            const chart_series *series = &c->panels[p].series[s];
            if (series->kind == CHART_LINE && series->count > 0 && isinf(series->y[series->count - 1]))
                return true;
        }
    return false;
}

legend legend_make(const pencil *p, const chart *c, double width) {
    legend l = {0};
    for (size_t i = 0; i < c->panel_count; i++)
        for (size_t s = 0; s < c->panels[i].series_count && l.count < CHART_SERIES; s++)
            if (!c->panels[i].series[s].unlisted && !listed(&l, &c->panels[i].series[s]))
                l.entries[l.count++] = &c->panels[i].series[s];
    l.width = width;
    l.arrows = l.count > 0 && has_blind(c);
    /* The fewest rows that fit; then as many more as keep each group in one column. */
    size_t rows = 1, group = group_size(&l);
    while (rows < l.count && !arrange(p, &l, rows, width))
        rows++;
    if (l.count > 0)
        arrange(p, &l, (rows + group - 1) / group * group, width);
    return l;
}

static void draw_text(const pencil *p, const char *text, double x, double middle, double room) {
    words w = words_break(p, text, &p->text, room, 1);
    if (w.count > 0)
        canvas_text(p->c, x, middle + 0.36 * p->text.size, w.lines[0], &p->text, CANVAS_LEFT);
}

double legend_draw(const pencil *p, const legend *l, double x, double y) {
    double height = words_height(&p->text), left = x, before = (SWATCH + GAP) * p->scale;
    char text[2 * CHART_TEXT];
    size_t i = 0;
    for (size_t column = 0; column < l->columns; x += l->column_width[column], column++)
        for (size_t row = 0; row < l->rows && i < l->count; row++, i++) {
            double middle = y + ((double)row + 0.5) * height;
            series_swatch(p, l->entries[i], x, middle, SWATCH * p->scale);
            draw_text(p, text_of(l->entries[i], text), x + before, middle, left + l->width - x - before);
        }
    y += (double)l->rows * height;
    if (!l->arrows)
        return y;
    series_arrow(p, left + SWATCH / 2 * p->scale, y + (height - 9 * p->scale) / 2, p->theme->faint);
    draw_text(p, arrow_note, left + before, y + height / 2, l->width - before);
    return y + height;
}
