/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/report.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "report/column.h"
#include "report/data.h"

/* ---- Text: tables of the lists whose columns have titles, sections of the others --------------------------------- */

typedef struct text_walk {
    page page;
    unsigned when;
    int spared; /* columns that are spared no earlier than this one are left out */
} text_walk;

/* A line of a table: whether something stands in it, and whether that was aligned to the left. */
typedef struct text_line {
    output *out;
    int waiting; /* blanks that are owed before the next cell: none end a line */
    bool begun, left;
} text_line;

static void blanks(output *out, int count) {
    for (; count > 0; count--)
        output_char(out, ' ');
}

/* A cell wider than its column pushes the rest, but is never cut or glued to its neighbour. */
static void put(text_line *line, const column *c, const char *text) {
    const int length = (int)strlen(text), rest = abs(c->width) - length;
    const bool left = c->width < 0;
    if (line->out->cells)
        output_char(line->out, '\x1f');
    if (left)
        line->waiting += !line->begun ? 0 : line->left ? 1 : 2;
    else
        line->waiting += rest > 1 ? rest : 1;
    if (length > 0) {
        blanks(line->out, line->waiting);
        output_text(line->out, text);
        line->waiting = 0;
    }
    line->waiting += left && rest > 0 ? rest : 0;
    line->begun = true;
    line->left = left;
}

/* The columns that text has, those of parts as if they stood here. */
static bool has_title(const text_walk *w, const column *c) {
    return c->title != NULL && c->spare < w->spared && column_shows(c, AS_TEXT, w->when);
}

static void measure_titles(const text_walk *w, const column *c, int *width, int *last) {
    for (; c->kind != COLUMN_END; c++) {
        if (c->kind == COLUMN_PART && column_shows(c, AS_TEXT, w->when))
            measure_titles(w, c->columns, width, last);
        if (!has_title(w, c))
            continue;
        *width += c->width < 0 ? 2 - c->width : c->width;
        *last = c->spare > *last ? c->spare : *last;
    }
}

/* Leaves out what is spared first, until the rest fits the page. */
static void spare(text_walk *w, const column *list) {
    int width, last = INT_MAX;
    do {
        w->spared = last;
        width = list->indent + (list->columns->width < 0 ? -2 : 0);
        last = 0;
        measure_titles(w, list->columns, &width, &last);
    } while (width > w->page.width && last > 0);
}

static void put_value(text_line *line, const column *c, const void *item) {
    number_text number;
    put(line, c, column_text(c, item, &number));
}

/* "z 10; code 16611104": what stands in a line of a table that is wider than the page, value by value. @return the
 * column behind it */
static int put_record(text_walk *w, const column *c, void *item, int at) {
    for (; c->kind != COLUMN_END; c++) {
        number_text number;
        char text[1024];
        if (c->kind == COLUMN_PART && column_shows(c, AS_TEXT, w->when))
            at = put_record(w, c->columns, column_part(c, item), at);
        if (c->kind == COLUMN_PART || !has_title(w, c))
            continue;
        const char *const title = c->title + strspn(c->title, " ");
        const int length =
            snprintf(text, sizeof text, "%s%s%s", title, *title != '\0' ? " " : "", column_text(c, item, &number));
        const bool goes_on = at > 0 && at + 3 + length <= w->page.width; /* "; ", and one behind it */
        output_text(w->page.out, at == 0 ? "" : goes_on ? "; " : ";\n");
        if (goes_on || (at == 0 && length < w->page.width)) {
            output_text(w->page.out, text);
            at += length + (goes_on ? 2 : 0);
        } else {
            const size_t start = w->page.out->used;
            page_line(&w->page, "%s", text);
            w->page.out->used--; /* its newline */
            at = w->page.out->used - start < (size_t)w->page.width ? (int)(w->page.out->used - start) : w->page.width;
        }
    }
    return at;
}

/* A line of the titles where there is no item. */
static void put_cells(const text_walk *w, text_line *line, const column *c, void *item) {
    for (; c->kind != COLUMN_END; c++) {
        if (c->kind == COLUMN_PART && column_shows(c, AS_TEXT, w->when))
            put_cells(w, line, c->columns, column_part(c, item));
        else if (has_title(w, c) && item == NULL)
            put(line, c, c->title);
        else if (has_title(w, c))
            put_value(line, c, item);
    }
}

static void put_line(const text_walk *w, const column *list, void *item) {
    text_line line = {.out = w->page.out, .waiting = list->indent};
    output_text(line.out, item == NULL ? w->page.soft : "");
    put_cells(w, &line, list->columns, item);
    output_text(line.out, item == NULL ? w->page.plain : "");
    output_char(line.out, '\n');
}

static int table_width(const text_walk *w, const column *list) {
    int width = list->indent + (list->columns->width < 0 ? -2 : 0), last = 0;
    measure_titles(w, list->columns, &width, &last);
    return width;
}

static bool is_table(const text_walk *w, const column *c) {
    int width = 0, last = 0;
    measure_titles(w, c, &width, &last);
    return width > 0;
}

static void put_lists(text_walk *w, const column *c, void *item);

enum { ROOM = 8192 }; /* more than what is in a line: it is taken back from the buffer */

/* A line; where it is wider than a terminal, what is in it. The table has no line of titles then, or this item alone.
 */
static void put_item(text_walk *w, const column *list, void *item, bool wide) {
    output *const out = w->page.out;
    if (w->page.fitted && OUTPUT_BUFFER_SIZE - out->used < ROOM)
        output_flush(out);
    const size_t start = out->used;
    if (!wide)
        put_line(w, list, item);
    if (!wide && (!w->page.fitted || page_fits(&w->page, out->buffer + start, out->used - start)))
        return;
    out->used = wide ? out->used : start;
    put_record(w, list->columns, item, 0);
    output_char(out, '\n');
}

/* A table without lines has no titles. */
static void put_table(text_walk *w, const column *list, void *item) {
    void *inner;
    if (list->head != NULL)
        list->head(&w->page, item);
    spare(w, list);
    const bool wide = w->page.fitted && table_width(w, list) > w->page.width;
    for (size_t i = 0; (inner = list->get(item, i)) != NULL; i++) {
        if (i == 0 && !wide)
            put_line(w, list, NULL);
        put_item(w, list, inner, wide);
    }
    if (list->notes != NULL)
        list->notes(&w->page, item);
}

static void put_sections(text_walk *w, const column *list, void *item) {
    void *inner;
    for (size_t i = 0; (inner = list->get(item, i)) != NULL; i++) {
        if (i > 0)
            output_char(w->page.out, '\n');
        if (list->head != NULL)
            list->head(&w->page, inner);
        put_lists(w, list->columns, inner);
        if (list->notes != NULL)
            list->notes(&w->page, inner);
    }
}

static void put_lists(text_walk *w, const column *c, void *item) {
    for (; c->kind != COLUMN_END; c++) {
        w->spared = INT_MAX;
        if (c->kind == COLUMN_LIST && column_shows(c, AS_TEXT, w->when))
            (is_table(w, c->columns) ? put_table : put_sections)(w, c, item);
    }
}

static void report_text(const report_spec *spec, output *out) {
    text_walk w = {.page = page_start(out, spec->label), .when = spec->when, .spared = INT_MAX};
    if (spec->head != NULL)
        spec->head(&w.page, spec->item);
    put_lists(&w, spec->columns, spec->item);
    if (spec->notes != NULL)
        spec->notes(&w.page, spec->item);
    if (out->measured != NULL)
        page_text(&w.page, "Measured on %s.", out->measured);
}

/* ---- All forms ------------------------------------------------------------------------------------------------- */

void report_write(const report_spec *spec, output *out, output_form form) {
    static void (*const writers[])(const report_spec *, output *) = {
        [FORM_TEXT] = report_text, [FORM_JSON] = report_json, [FORM_CSV] = report_csv};
    writers[form](spec, out);
}
