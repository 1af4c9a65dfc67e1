/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The text of a report: tables of the lists whose columns have titles, sections of the others. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "report/column.h"
#include "report/number.h"

typedef struct text_walk {
    page page;
    unsigned when;
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

/* What is wider than its column pushes the rest, but is never cut or glued to its neighbour. */
static void put(text_line *line, const column *c, const char *text) {
    const int length = (int)strlen(text), rest = abs(c->width) - length;
    const bool left = c->width < 0;
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
    return c->title != NULL && column_shows(c, AS_TEXT, w->when);
}

static void put_value(text_line *line, const column *c, const void *item) {
    const column_value v = column_of(c, item);
    const int digits = c->digits_at > 0 ? *(const int *)((const char *)item + c->digits_at) : c->digits;
    number_text number = {"-"};
    if (v.is_count)
        number_count(v.count, number.text);
    else if (v.is_number && c->fixed && !isnan(v.number))
        snprintf(number.text, sizeof number.text, "%.*f", digits, v.number);
    else if (v.is_number)
        number = c->upward ? number_up(v.number, digits) : number_of(v.number, digits);
    put(line, c, v.word != NULL ? v.word : number.text);
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

static bool is_table(const text_walk *w, const column *c) {
    for (; c->kind != COLUMN_END; c++)
        if (has_title(w, c) || (c->kind == COLUMN_PART && column_shows(c, AS_TEXT, w->when) && is_table(w, c->columns)))
            return true;
    return false;
}

static void put_lists(text_walk *w, const column *c, void *item);

/* A table without lines has no titles. */
static void put_table(text_walk *w, const column *list, void *item) {
    void *inner;
    if (list->head != NULL)
        list->head(&w->page, item);
    for (size_t i = 0; (inner = list->get(item, i)) != NULL; i++) {
        if (i == 0)
            put_line(w, list, NULL);
        put_line(w, list, inner);
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
    for (; c->kind != COLUMN_END; c++)
        if (c->kind == COLUMN_LIST && column_shows(c, AS_TEXT, w->when))
            (is_table(w, c->columns) ? put_table : put_sections)(w, c, item);
}

void report_text(const report_spec *spec, output *out) {
    text_walk w = {.page = page_start(out, spec->label), .when = spec->when};
    if (spec->head != NULL)
        spec->head(&w.page, spec->item);
    put_lists(&w, spec->columns, spec->item);
    if (spec->notes != NULL)
        spec->notes(&w.page, spec->item);
}
