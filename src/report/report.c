/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/report.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "depthprec/depthprec.h"
#include "report/number.h"

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

/* Does a form, one of AS_TEXT, ..., have the column under these conditions? */
static bool column_shows(const column *c, unsigned form, unsigned when) {
    return (c->only == 0 || (c->only & form) != 0) && (c->when & ~when) == 0;
}

void *column_part(const column *c, void *item) {
    if (item == NULL)
        return NULL;
    void *at = (char *)item + c->offset;
    return c->pointed ? *(void **)at : at;
}

/* A number, a count, or else a word. */
typedef struct column_value {
    bool is_number, is_count;
    double number;
    uint64_t count;
    const char *word; /* "true" and "false" of a flag; null where there is none */
} column_value;

/* The value of a column that is no part and no list. */
static column_value column_of(const column *c, const void *item) {
    const void *at = (const char *)item + c->offset;
    if (c->pointed)
        at = *(const void *const *)at;
    if (at == NULL)
        return (column_value){.word = NULL};
    switch (c->kind) {
    case COLUMN_NUMBER:
        return (column_value){.is_number = true, .number = *(const double *)at};
    case COLUMN_COUNT:
        return (column_value){.is_count = true, .count = *(const uint64_t *)at};
    case COLUMN_CODE:
        return (column_value){.is_count = true, .count = *(const uint32_t *)at};
    case COLUMN_INT:
        return (column_value){.is_count = true, .count = (uint64_t) * (const int *)at};
    case COLUMN_FLAG:
        return (column_value){.word = *(const bool *)at ? "true" : "false"};
    case COLUMN_LETTERS:
        return (column_value){.word = *(const char *)at != '\0' ? at : NULL};
    default:
        return (column_value){.word = *(const char *const *)at};
    }
}

static bool column_exists(const column_value *v) {
    return v->is_number ? !isnan(v->number) : v->is_count || v->word != NULL;
}

bool column_has(const column *c, const void *item) {
    const column_value v = column_of(c, item);
    return column_exists(&v);
}

const char *column_text(const column *c, const void *item, number_text *number) {
    const column_value v = column_of(c, item);
    const int digits = c->digits_at > 0 ? *(const int *)((const char *)item + c->digits_at) : c->digits;
    *number = (number_text){"-"};
    if (v.is_count)
        number_count(v.count, number->text);
    else if (v.is_number && c->fixed && !isnan(v.number))
        snprintf(number->text, sizeof number->text, "%.*f", digits, v.number);
    else if (v.is_number && digits == 0)
        *number = isnan(v.number) ? *number : number_full(v.number);
    else if (v.is_number)
        *number = (c->upward     ? number_up
                   : c->downward ? number_down
                   : c->outward  ? number_outward
                                 : number_of)(v.number, digits);
    if (c->brief)
        *number = number_brief(*number);
    return v.word != NULL ? v.word : number->text;
}

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

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

/* A number with all its digits. */
static void put_digits(output *out, const column_value *v) {
    char text[NUMBER_SIZE];
    output_bytes(out, text, v->is_count ? number_count(v->count, text) : number_shortest(v->number, text));
}

/* Writes a character; a byte that is no UTF-8, as paths may hold, as U+FFFD. @return how many bytes it took */
static size_t utf8(output *out, const char *text) {
    const size_t length = text_utf8(text);
    if (length == 0)
        output_text(out, "\uFFFD");
    for (size_t i = 0; i < length; i++)
        output_char(out, text[i]);
    return length > 0 ? length : 1;
}

typedef struct json_walk {
    output *out;
    unsigned when;
    bool filled; /* the object or array that is open has a member */
} json_walk;

static void quoted(output *out, const char *text, size_t length) {
    output_char(out, '"');
    for (size_t i = 0; i < length;) {
        if ((unsigned char)text[i] < 0x20) {
            output_format(out, "\\u%04x", text[i++]);
            continue;
        }
        if (text[i] == '"' || text[i] == '\\')
            output_char(out, '\\');
        i += utf8(out, text + i);
    }
    output_char(out, '"');
}

/* Writes a comma before a value, and its key inside an object. */
static void json_member(json_walk *w, const char *key) {
    if (w->filled)
        output_char(w->out, ',');
    w->filled = true;
    if (key != NULL) {
        quoted(w->out, key, strlen(key));
        output_char(w->out, ':');
    }
}

static void json_open(json_walk *w, const char *key, const char *bracket) {
    json_member(w, key);
    output_text(w->out, bracket);
    w->filled = false;
}

static void json_close(json_walk *w, char bracket) {
    output_char(w->out, bracket);
    w->filled = true;
}

static void json_word(json_walk *w, const char *key, const char *word) {
    json_member(w, key);
    quoted(w->out, word, strlen(word));
}

static void json_names(json_walk *w, const char *key, const char *names) {
    json_open(w, key, "[");
    while (names != NULL && *names != '\0') {
        const size_t length = strcspn(names, " ");
        json_member(w, NULL);
        quoted(w->out, names, length);
        names += length + (names[length] == ' ');
    }
    json_close(w, ']');
}

static void json_value(json_walk *w, const column *c, const void *item) {
    const column_value v = column_of(c, item);
    if (c->names) {
        json_names(w, c->key, v.word);
        return;
    }
    if (c->optional && !column_exists(&v) && !(c->pointed && v.is_number))
        return;
    if (v.word != NULL && c->kind != COLUMN_FLAG) {
        json_word(w, c->key, v.word);
        return;
    }
    json_member(w, c->key);
    if (v.word != NULL)
        output_text(w->out, v.word);
    else if (column_exists(&v) && !(v.is_number && isinf(v.number)))
        put_digits(w->out, &v);
    else
        output_text(w->out, "null");
}

static void json_columns(json_walk *w, const column *c, void *item);

static void json_part(json_walk *w, const column *c, void *item) {
    void *part = column_part(c, item);
    if (part != NULL && c->key == NULL) {
        json_columns(w, c->columns, part);
    } else if (part != NULL) {
        json_open(w, c->key, "{");
        json_columns(w, c->columns, part);
        json_close(w, '}');
    } else if (c->key != NULL && !c->optional) {
        json_member(w, c->key);
        output_text(w->out, "null");
    }
}

/* Each item begins a line: so a diff of two outputs shows rows. */
static void json_list(json_walk *w, const column *c, void *item) {
    void *inner;
    json_open(w, c->key, "[");
    for (size_t i = 0; (inner = c->get(item, i)) != NULL; i++) {
        json_open(w, NULL, "\n{");
        json_columns(w, c->columns, inner);
        json_close(w, '}');
    }
    json_close(w, ']');
}

static void json_columns(json_walk *w, const column *c, void *item) {
    for (; c->kind != COLUMN_END; c++) {
        if (!column_shows(c, AS_JSON, w->when))
            continue;
        if (c->kind == COLUMN_PART)
            json_part(w, c, item);
        else if (c->kind == COLUMN_LIST)
            json_list(w, c, item);
        else if (c->key != NULL)
            json_value(w, c, item);
    }
}

static void report_json(const report_spec *spec, output *out) {
    json_walk w = {.out = out, .when = spec->when};
    json_open(&w, NULL, "{");
    json_word(&w, "schema", "depthprec/1");
    json_word(&w, "command", spec->command);
    json_word(&w, "version", dp_version());
    if (out->measured != NULL)
        json_word(&w, "measured", out->measured);
    json_columns(&w, spec->columns, spec->item);
    output_text(out, "}\n");
}

/* ---- CSV, after RFC 4180: CRLF line ends, quotes where needed ---------------------------------------------------- */

/* The way to a line: the columns of the items that are open, each within the list of the one before. */
typedef struct csv_level {
    const column *columns;
    void *item;
} csv_level;

enum { CSV_LEVELS_MAX = 8 };

typedef struct csv_walk {
    output *out;
    unsigned when;
    csv_level levels[CSV_LEVELS_MAX];
    bool heads; /* the line of the keys is being written, and no item is looked at */
    bool filled;
} csv_walk;

static void csv_word(output *out, const char *word) {
    const char *quote = strpbrk(word, ",\"\r\n") != NULL ? "\"" : "";
    output_text(out, quote);
    while (*word != '\0') {
        if (*word == '"')
            output_char(out, '"');
        word += utf8(out, word);
    }
    output_text(out, quote);
}

static void csv_head(output *out, const column *c) {
    char text[128];
    const bool has_unit = c->unit != NULL && c->unit[0] != '\0';
    snprintf(text, sizeof text, has_unit ? "%s [%s]" : "%s", c->key, c->unit);
    csv_word(out, text);
}

static void csv_cell(csv_walk *w, const column *c, const void *item) {
    if (w->filled)
        output_char(w->out, ',');
    w->filled = true;
    if (w->heads) {
        csv_head(w->out, c);
        return;
    }
    const column_value v = item != NULL ? column_of(c, item) : (column_value){.word = NULL};
    if (v.word != NULL)
        csv_word(w->out, v.word);
    else if (column_exists(&v))
        put_digits(w->out, &v);
}

static void csv_cells(csv_walk *w, const csv_level *level, const column *c, void *item) {
    for (; c->kind != COLUMN_END; c++) {
        if (!column_shows(c, AS_CSV, w->when))
            continue;
        if (c->kind == COLUMN_PART)
            csv_cells(w, level, c->columns, column_part(c, item));
        else if (c->kind == COLUMN_LIST)
            csv_cells(w, level + 1, level[1].columns, level[1].item);
        else if (c->key != NULL)
            csv_cell(w, c, item);
    }
}

/* Writes the lines of an item; those of the heads alone go down all lists without asking for items. */
static void csv_item(csv_walk *w, csv_level *level, const column *columns, void *item) {
    const column *list = columns;
    void *inner;
    *level = (csv_level){columns, item};
    while (list->kind != COLUMN_END && !(list->kind == COLUMN_LIST && column_shows(list, AS_CSV, w->when)))
        list++;
    if (list->kind == COLUMN_END) {
        csv_cells(w, w->levels, w->levels[0].columns, w->levels[0].item);
        output_text(w->out, "\r\n");
        w->filled = false;
    } else if (w->heads) {
        csv_item(w, level + 1, list->columns, NULL);
    } else {
        for (size_t i = 0; (inner = list->get(item, i)) != NULL; i++)
            csv_item(w, level + 1, list->columns, inner);
    }
}

static void report_csv(const report_spec *spec, output *out) {
    csv_walk w = {.out = out, .when = spec->when, .heads = true};
    csv_item(&w, w.levels, spec->columns, NULL);
    w.heads = false;
    csv_item(&w, w.levels, spec->columns, spec->item);
}

void report_write(const report_spec *spec, output *out, output_form form) {
    static void (*const writers[])(const report_spec *, output *) = {
        [FORM_TEXT] = report_text, [FORM_JSON] = report_json, [FORM_CSV] = report_csv};
    writers[form](spec, out);
}
