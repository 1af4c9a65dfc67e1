/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file report.h  Columns as data: a report is described once, and written as text, JSON or CSV.
 *
 * A command fills flat structs; a column is one row that says where its value lies and how each form shows it.
 *
 *     typedef struct line { double z; uint32_t code; double separation; } line;
 *     static const column line_columns[] = {
 *         {FIELD(line, z, "z", "scene"), SHOWN("z", 12, 9)},             // JSON "z", CSV "z [scene]", text under "z"
 *         {FIELD(line, code, "code", ""), SHOWN("code", 11, 0), .only = AS_TEXT | AS_CSV},
 *         {FIELD(line, separation, "separation", "scene"), SHOWN("separation", 12, 6), .upward = true},
 *         {.kind = COLUMN_END}};
 *     static void *next_line(void *of, size_t i) { ... }                 // line i of the item `of`, or null
 *     static const column root[] = {{FIELD(root, api, "api", ""), .only = AS_JSON},
 *                                   {LIST("rows", line_columns, next_line), .notes = say_more}, {.kind = COLUMN_END}};
 *     report_write(&(report_spec){"table", root, &item, .when = WITH_ARITH}, &out, FORM_JSON);
 *
 * JSON nests as the columns do. CSV has a line for each item of the innermost list; what stands beside that list in the
 * outer items is in every line, before or after it, so it must be known when the first line is asked for. Text has a
 * table of each list whose columns have titles; of another list a section for each item, parted by an empty line.
 */
#ifndef REPORT_REPORT_H
#define REPORT_REPORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "report/number.h"
#include "report/output.h"
#include "report/page.h"

/** The forms, for column.only. */
enum { AS_TEXT = 1 << FORM_TEXT, AS_JSON = 1 << FORM_JSON, AS_CSV = 1 << FORM_CSV };

/** The type of the value at a column's offset, or pointed to from there. A value that does not exist is "-" in text,
 * null in JSON, empty in CSV. */
typedef enum column_kind {
    COLUMN_END = 0,
    COLUMN_NUMBER,  /**< double; NaN: does not exist. Infinity is null in JSON */
    COLUMN_COUNT,   /**< uint64_t */
    COLUMN_CODE,    /**< uint32_t */
    COLUMN_INT,     /**< int, not negative */
    COLUMN_FLAG,    /**< bool: true or false */
    COLUMN_WORD,    /**< const char *; null: does not exist */
    COLUMN_LETTERS, /**< char[]: the word itself; "": does not exist */
    COLUMN_PART,    /**< a struct with columns of its own, a JSON object; without a key, as if they stood here */
    COLUMN_LIST     /**< items that `get` hands out, one after the other */
} column_kind;

typedef struct column {
    const char *key;   /**< of JSON, and of CSV with the unit behind it; null: neither has it */
    const char *unit;  /**< "scene"; null or "": none */
    const char *title; /**< above the text's column; null: text does not have it */
    column_kind kind;
    size_t offset;    /**< in the item */
    size_t digits_at; /**< where the item holds the digits, an int; 0: they are in `digits` */
    int width;        /**< characters, with the blank before it; negative: aligned to the left, without */
    int digits;       /**< significant ones of a number; 0: all */
    bool fixed;       /**< ... or, after the point */
    bool upward;      /**< what holds as it is printed: text rounds a number up */
    bool downward;    /**< the same, down */
    bool outward;     /**< the same, away from 0 */
    bool brief;       /**< short: 82800 and 1.2e-7 in place of 8.28e+04 and 1.2e-07 */
    bool optional;    /**< JSON leaves it out where it does not exist; of a pointer, where that is null */
    bool names;       /**< a word of words parted by one space: an array of strings in JSON */
    bool pointed;     /**< the item holds a pointer to the value or part, null where it does not exist */
    bool given;       /**< a length that may be one that was asked for: a sentence writes it as that was */
    int spare;        /**< text leaves it out where the table is wider than the page, the highest first; 0: never */
    unsigned only;    /**< the forms that have it; 0: all */
    unsigned when;    /**< conditions of the report, bits that must all be set */
    const struct column *columns; /**< of a part, or of a list's items */
    /** COLUMN_LIST: the item of that index, asked for once and in order; null behind the last. It may live in the outer
     *  item, or lie anywhere until the next is asked for. */
    void *(*get)(void *of, size_t index);
    /** COLUMN_LIST: what text says above an item's section and below it; null: nothing. Of a table it is said once, of
     *  the outer item, even where the table is left out because it has no lines. */
    void (*head)(page *p, void *item);
    void (*notes)(page *p, void *item);
    bool verdict; /**< COLUMN_LIST: an item of JSON begins with the first sentence that `head` says */
    int indent;   /**< COLUMN_LIST: blanks before each line of a table */
} column;

/* The kind follows from the member's type, so the two cannot disagree. */
#define FIELD_KIND(type, member)                                                                                       \
    _Generic(((type){}).member,                                                                                        \
        double: COLUMN_NUMBER,                                                                                         \
        uint64_t: COLUMN_COUNT,                                                                                        \
        uint32_t: COLUMN_CODE,                                                                                         \
        int: COLUMN_INT,                                                                                               \
        const double *: COLUMN_NUMBER,                                                                                 \
        bool: COLUMN_FLAG,                                                                                             \
        const bool *: COLUMN_FLAG,                                                                                     \
        const char *: COLUMN_WORD,                                                                                     \
        char *: COLUMN_LETTERS)
#define FIELD_POINTED(type, member)                                                                                    \
    _Generic(((type){}).member, const double * : true, const bool * : true, default : false)
#define FIELD_AT(type, member)                                                                                         \
    .kind = FIELD_KIND(type, member), .pointed = FIELD_POINTED(type, member), .offset = offsetof(type, member)
#define FIELD(type, member, its_key, its_unit)  .key = (its_key), .unit = (its_unit), FIELD_AT(type, member)
#define SHOWN(its_title, its_width, its_digits) .title = (its_title), .width = (its_width), .digits = (its_digits)
#define TEXT_FIELD(type, member, its_title, its_width, its_digits)                                                     \
    FIELD_AT(type, member), SHOWN(its_title, its_width, its_digits)
#define PART(type, member, its_key, its_columns)                                                                       \
    .key = (its_key), .kind = COLUMN_PART, .offset = offsetof(type, member), .columns = (its_columns)
/* Columns of the same item, in an object of their own. */
#define GROUP(its_key, its_columns) .key = (its_key), .kind = COLUMN_PART, .columns = (its_columns)
#define LIST(its_key, its_columns, its_get)                                                                            \
    .key = (its_key), .kind = COLUMN_LIST, .columns = (its_columns), .get = (its_get)

typedef struct report_spec {
    const char *command;   /**< "table" */
    const column *columns; /**< of the root item */
    void *item;
    unsigned when;                      /**< the conditions that hold */
    int label;                          /**< width of the labels of the notes, see page.h */
    void (*head)(page *p, void *item);  /**< what text says first, */
    void (*notes)(page *p, void *item); /**< and last; null: nothing */
    bool verdict;                       /**< JSON begins with the first sentence that `head` says */
} report_spec;

/** The item of a part; null where it does not exist, or the outer item does not. */
void *column_part(const column *c, void *item);

/** Whether the value of a column that is no part and no list exists. */
bool column_has(const column *c, const void *item);

/** Its text, a number's with the digits and the direction of the column, all digits where it says none; `number` holds
 * what is no word. */
const char *column_text(const column *c, const void *item, number_text *number);

/** Writes a report. Failures are the output's to remember. */
void report_write(const report_spec *spec, output *out, output_form form);

#endif
