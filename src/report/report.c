/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "report/column.h"
#include "report/csv.h"
#include "report/json.h"

bool column_shows(const column *c, unsigned form, unsigned when) {
    return (c->only == 0 || (c->only & form) != 0) && (c->when & ~when) == 0;
}

void *column_part(const column *c, void *item) {
    char *at = (char *)item + c->offset;
    return c->pointed ? *(void **)at : at;
}

column_value column_of(const column *c, const void *item) {
    const char *at = (const char *)item + c->offset;
    const bool *flag = NULL;
    switch (c->kind) {
    case COLUMN_NUMBER:
        return (column_value){VALUE_NUMBER, .number = *(const double *)at};
    case COLUMN_COUNT:
        return (column_value){VALUE_COUNT, .count = *(const uint64_t *)at};
    case COLUMN_CODE:
        return (column_value){VALUE_COUNT, .count = *(const uint32_t *)at};
    case COLUMN_INT:
        return (column_value){VALUE_COUNT, .count = (uint64_t) * (const int *)at};
    case COLUMN_FLAG:
        return (column_value){VALUE_WORD, .word = *(const bool *)at ? "true" : "false"};
    case COLUMN_ANSWER:
        flag = *(const bool *const *)at;
        return (column_value){VALUE_WORD, .word = flag == NULL ? NULL : *flag ? "true" : "false"};
    case COLUMN_LETTERS:
        return (column_value){VALUE_WORD, .word = *at != '\0' ? at : NULL};
    default:
        return (column_value){VALUE_WORD, .word = *(const char *const *)at};
    }
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

static void json_names(json *j, const char *key, const char *names) {
    json_array(j, key);
    while (names != NULL && *names != '\0') {
        char name[64];
        const size_t length = strcspn(names, " ");
        snprintf(name, sizeof name, "%.*s", (int)length, names);
        json_string(j, NULL, name);
        names += length + (names[length] == ' ');
    }
    json_end(j);
}

static void json_value(json *j, const column *c, const void *item) {
    const column_value v = column_of(c, item);
    if (c->optional && !column_exists(&v))
        return;
    if (c->names)
        json_names(j, c->key, v.word);
    else if ((c->kind == COLUMN_FLAG || c->kind == COLUMN_ANSWER) && v.word != NULL)
        json_bool(j, c->key, *v.word == 't');
    else if (v.kind == VALUE_NUMBER)
        json_number(j, c->key, v.number);
    else if (v.kind == VALUE_COUNT)
        json_integer(j, c->key, v.count);
    else
        json_string(j, c->key, v.word);
}

static void json_columns(json *j, unsigned when, const column *c, void *item);

static void json_part(json *j, unsigned when, const column *c, void *item) {
    void *part = column_part(c, item);
    if (part == NULL) {
        if (c->key != NULL && !c->optional)
            json_null(j, c->key);
        return;
    }
    if (c->key != NULL)
        json_object(j, c->key);
    json_columns(j, when, c->columns, part);
    if (c->key != NULL)
        json_end(j);
}

static void json_list(json *j, unsigned when, const column *c, void *item) {
    void *inner;
    json_array(j, c->key);
    for (size_t i = 0; (inner = c->get(item, i)) != NULL; i++) {
        json_object(j, NULL);
        json_columns(j, when, c->columns, inner);
        json_end(j);
    }
    json_end(j);
}

static void json_columns(json *j, unsigned when, const column *c, void *item) {
    for (; c->kind != COLUMN_END; c++) {
        if (!column_shows(c, AS_JSON, when))
            continue;
        if (c->kind == COLUMN_PART)
            json_part(j, when, c, item);
        else if (c->kind == COLUMN_LIST)
            json_list(j, when, c, item);
        else if (c->key != NULL)
            json_value(j, c, item);
    }
}

static void write_json(const report_spec *spec, output *out) {
    json j = json_start(out, spec->command);
    json_columns(&j, spec->when, spec->columns, spec->item);
    json_finish(&j);
}

/* ---- CSV --------------------------------------------------------------------------------------------------------- */

/* The way to a line: the columns of the items that are open, each within the list of the one before. */
typedef struct csv_level {
    const column *columns;
    void *item;
} csv_level;

enum { CSV_LEVELS_MAX = 8 };

typedef struct csv_walk {
    csv lines;
    unsigned when;
    csv_level levels[CSV_LEVELS_MAX];
    bool heads; /* the line of the keys is being written, and no item is looked at */
} csv_walk;

static void csv_head(csv *c, const column *of) {
    char text[128];
    const bool has_unit = of->unit != NULL && of->unit[0] != '\0';
    snprintf(text, sizeof text, has_unit ? "%s [%s]" : "%s", of->key, of->unit);
    csv_string(c, text);
}

static void csv_value(csv *c, const column *of, const void *item) {
    const column_value v = column_of(of, item);
    if (v.kind == VALUE_NUMBER)
        csv_number(c, v.number);
    else if (v.kind == VALUE_COUNT)
        csv_integer(c, v.count);
    else
        csv_string(c, v.word != NULL ? v.word : "");
}

static void csv_cells(csv_walk *w, const csv_level *level, const column *c, void *item) {
    for (; c->kind != COLUMN_END; c++) {
        if (!column_shows(c, AS_CSV, w->when))
            continue;
        if (c->kind == COLUMN_PART)
            csv_cells(w, level, c->columns, w->heads ? NULL : column_part(c, item));
        else if (c->kind == COLUMN_LIST)
            csv_cells(w, level + 1, level[1].columns, level[1].item);
        else if (c->key != NULL && w->heads)
            csv_head(&w->lines, c);
        else if (c->key != NULL && item == NULL)
            csv_string(&w->lines, "");
        else if (c->key != NULL)
            csv_value(&w->lines, c, item);
    }
}

static void csv_line(csv_walk *w) {
    csv_cells(w, w->levels, w->levels[0].columns, w->levels[0].item);
    csv_end(&w->lines);
}

static const column *csv_list(const csv_walk *w, const column *c) {
    while (c->kind != COLUMN_END && !(c->kind == COLUMN_LIST && column_shows(c, AS_CSV, w->when)))
        c++;
    return c->kind == COLUMN_LIST ? c : NULL;
}

/* Writes the lines of an item; those of the heads alone go down all lists without asking for items. */
static void csv_item(csv_walk *w, csv_level *level, const column *columns, void *item) {
    const column *list = csv_list(w, columns);
    void *inner;
    *level = (csv_level){columns, item};
    if (list == NULL)
        csv_line(w);
    else if (w->heads)
        csv_item(w, level + 1, list->columns, NULL);
    else
        for (size_t i = 0; (inner = list->get(item, i)) != NULL; i++)
            csv_item(w, level + 1, list->columns, inner);
}

static void write_csv(const report_spec *spec, output *out) {
    csv_walk w = {.lines = csv_start(out), .when = spec->when, .heads = true};
    csv_item(&w, w.levels, spec->columns, NULL);
    w.heads = false;
    csv_item(&w, w.levels, spec->columns, spec->item);
}

void report_write(const report_spec *spec, output *out, output_form form) {
    static void (*const writers[])(const report_spec *, output *) = {
        [FORM_TEXT] = report_text, [FORM_JSON] = write_json, [FORM_CSV] = write_csv};
    writers[form](spec, out);
}
