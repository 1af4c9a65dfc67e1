/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/legend.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/append.h"
#include "draw/alike.h"
#include "draw/series.h"
#include "draw/words.h"

#define SWATCH  42.0 /* px at scale 1 */
#define GAP     7.0
#define BETWEEN 22.0

static const char arrow_note[] = "unbounded from here: nothing beyond is resolved";
static const char end_note[] = "ends here: nothing behind it up to far is certain";

/* The entry of that name; `count` where there is none. */
static size_t entry_of(const legend *l, const chart_series *s) {
    size_t i = 0;
    while (i < l->count && strcmp(l->entries[i]->name, s->name) != 0)
        i++;
    return i;
}

/* The curve that hides this one in each panel that has it; where along x, as far as that holds in all of them. */
static alike hidden_by(const chart *c, const chart_panel *panel, size_t index) {
    const char *name = panel->series[index].name;
    alike all = {NULL, (double)NAN, (double)NAN};
    for (size_t p = 0; p < c->panel_count; p++)
        for (size_t k = 0; k < c->panels[p].series_count; k++) {
            const bool own = &c->panels[p] == panel;
            if (own ? k != index : strcmp(c->panels[p].series[k].name, name) != 0)
                continue;
            const alike found = alike_find(&c->panels[p], k);
            if (found.other == NULL || (all.other != NULL && strcmp(all.other->name, found.other->name) != 0))
                return (alike){.other = NULL};
            all = (alike){found.other, fmax(all.from, found.from), fmin(all.to, found.to)};
        }
    return isnan(all.from) || isnan(all.to) ? all : (alike){.other = NULL};
}

/* A name without the words that another begins or ends with, too: of "unorm24 d3d" beside "fp32 d3d", "unorm24". */
static void write_apart(const char *name, const char *other, char out[CHART_TEXT]) {
    size_t begin = 0, end = strlen(name), ends = strlen(other);
    for (size_t i = 0; name[i] != '\0' && name[i] == other[i]; i++)
        begin = name[i] == ' ' ? i + 1 : begin;
    for (size_t back = 1; begin == 0 && back < end && back < ends && name[end - back] == other[ends - back]; back++)
        if (name[end - back] == ' ') {
            end -= back;
            ends -= back;
            back = 0;
        }
    snprintf(out, CHART_TEXT, "%.*s", (int)(end - begin), name + begin);
}

/* The name, its note, and the curve that hides it. */
static void write_text(const chart *c, const chart_panel *panel, size_t index, char out[LEGEND_TEXT]) {
    const chart_series *s = &panel->series[index];
    const alike found = hidden_by(c, panel, index);
    const double end = isnan(found.from) ? found.to : found.from;
    char number[TICKS_TEXT], other[CHART_TEXT];
    snprintf(out, LEGEND_TEXT, "%s%s", s->name, s->note);
    if (found.other == NULL)
        return;
    write_apart(found.other->name, s->name, other);
    append(out, LEGEND_TEXT, ", hidden by %s", other);
    if (isnan(end))
        return;
    ticks_about(end, number);
    append(out, LEGEND_TEXT, "%s%s", isnan(found.from) ? " up to " : " from ", number);
}

/* As many columns as fit, each as wide as its widest entry. */
static bool arrange(const pencil *p, legend *l, size_t rows, double width) {
    l->rows = rows;
    l->columns = (l->count + rows - 1) / rows;
    double sum = -BETWEEN * p->scale;
    for (size_t column = 0; column < l->columns; column++) {
        l->column_width[column] = 0;
        for (size_t i = column * rows; i < l->count && i < (column + 1) * rows; i++)
            l->column_width[column] = fmax(l->column_width[column], canvas_text_width(p->c, l->text[i], &p->text));
        l->column_width[column] += (SWATCH + GAP + BETWEEN) * p->scale;
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

/* Does a line end in a bar? */
static bool has_end(const chart *c) {
    for (size_t p = 0; p < c->panel_count; p++)
        for (size_t s = 0; s < c->panels[p].series_count; s++)
            if (!isnan(c->panels[p].series[s].certain_to))
                return true;
    return false;
}

/* Lists the series of a panel that mark what others show, or, without `marks`, the others. */
static void list(legend *l, const chart *c, const chart_panel *panel, bool marks) {
    for (size_t k = 0; k < panel->series_count && l->count < LEGEND_MAX; k++) {
        const chart_series *s = &panel->series[k];
        const size_t at = entry_of(l, s);
        if (s->unlisted || (s->kind == CHART_POINTS || s->kind == CHART_LEVELS || s->kind == CHART_BARS) != marks)
            continue;
        if (at < l->count) { /* in another panel it may have something to note */
            if (s->note[0] != '\0' && strstr(l->text[at], s->note) == NULL)
                append(l->text[at], LEGEND_TEXT, "%s", s->note);
            continue;
        }
        write_text(c, panel, k, l->text[l->count]);
        l->entries[l->count++] = s;
    }
}

legend legend_make(const pencil *p, const chart *c, double width) {
    legend l = {0};
    for (size_t i = 0; i < 2 * c->panel_count; i++)
        list(&l, c, &c->panels[i % c->panel_count], i >= c->panel_count);
    l.width = width;
    l.arrows = l.count > 0 && has_blind(c);
    l.ends = l.count > 0 && has_end(c);
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
    size_t i = 0;
    for (size_t column = 0; column < l->columns; x += l->column_width[column], column++)
        for (size_t row = 0; row < l->rows && i < l->count; row++, i++) {
            double middle = y + ((double)row + 0.5) * height;
            series_swatch(p, l->entries[i], x, middle, SWATCH * p->scale);
            draw_text(p, l->text[i], x + before, middle, left + l->width - x - before);
        }
    const double middle = left + SWATCH / 2 * p->scale;
    y += (double)l->rows * height;
    if (l->arrows) {
        series_arrow(p, middle, y + (height - 9 * p->scale) / 2, p->theme->faint);
        draw_text(p, arrow_note, left + before, y + height / 2, l->width - before);
        y += height;
    }
    if (l->ends) {
        series_end(p, middle, y + height / 2, p->theme->faint);
        draw_text(p, end_note, left + before, y + height / 2, l->width - before);
        y += height;
    }
    return y;
}
