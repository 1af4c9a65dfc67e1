/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/data.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/append.h"
#include "depthprec/depthprec.h"
#include "report/column.h"
#include "report/number.h"

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

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

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

/* The first sentence that text has from the margin on: it marks them, see output.h. */
static void json_verdict(json_walk *w, void (*head)(page *p, void *item), void *item) {
    static output text;
    text = (output){.fd = -1, .width = OUTPUT_UNLIMITED, .cells = true};
    page p = page_start(&text, 0);
    head(&p, item);
    output_char(&text, '\0');
    char *const from = strchr(text.buffer, OUTPUT_SENTENCE);
    char *const end = from != NULL ? strchr(from + 1, OUTPUT_SENTENCE) : NULL;
    if (end != NULL) {
        *end = '\0';
        json_word(w, "verdict", from + 1);
    }
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
        if (c->verdict)
            json_verdict(w, c->head, inner);
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

void report_json(const report_spec *spec, output *out) {
    json_walk w = {.out = out, .when = spec->when};
    json_open(&w, NULL, "{");
    json_word(&w, "schema", "depthprec/1");
    json_word(&w, "command", spec->command);
    json_word(&w, "version", dp_version());
    if (out->measured != NULL)
        json_word(&w, "measured", out->measured);
    if (spec->verdict)
        json_verdict(&w, spec->head, spec->item);
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

void report_csv(const report_spec *spec, output *out) {
    csv_walk w = {.out = out, .when = spec->when, .heads = true};
    csv_item(&w, w.levels, spec->columns, NULL);
    w.heads = false;
    csv_item(&w, w.levels, spec->columns, spec->item);
}
