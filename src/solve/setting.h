/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file setting.h  The grammar of requirement files, which is libconfig's: a text becomes a tree of settings.
 *
 *     group    = { NAME ("=" | ":") value [";" | ","] }       the whole text is one
 *     value    = "{" group "}" | "[" values "]" | "(" values ")" | STRING { STRING } | number | "true" | "false"
 *     values   = [ value { "," value } [","] ]                in brackets scalars of one kind
 *     NAME     = a letter or "*", then letters, digits, "*", "-" and "_"
 *     number   = an integer, decimal or 0x..., perhaps with L or LL behind it, or a decimal number with a point or an
 *                exponent
 *
 * Words are of either case. Blanks and comments stand between any two of them: from # or // to the end of the line, or
 * between slash-star and star-slash. In a string a backslash has a meaning before " \ a b f n r t v and xHH.
 */
#ifndef SOLVE_SETTING_H
#define SOLVE_SETTING_H

#include <stdbool.h>
#include <stddef.h>

typedef enum setting_kind {
    SETTING_INTEGER,
    SETTING_REAL,
    SETTING_WORD, /**< true or false */
    SETTING_STRING,
    SETTING_GROUP, /**< { } */
    SETTING_ARRAY, /**< [ ] */
    SETTING_LIST   /**< ( ) */
} setting_kind;

typedef struct setting {
    setting_kind kind;
    int line;                     /**< on which its name stands, or without one its value; from 1 */
    const char *name;             /**< null for an element of an array or list, and for the text as a whole */
    const char *string;           /**< of a string */
    double number;                /**< of a number; 1 for true, 0 for false */
    long long integer;            /**< of an integer, as it was written; beyond 64 bits the nearest that they have */
    size_t count;                 /**< of a group, array or list */
    struct setting *first, *next; /**< its first, and the one behind it; null where there is none */
    struct setting *before;       /**< read before it: for setting_release() */
} setting;

/** Groups, arrays and lists within each other: no more are read. */
enum { SETTING_DEEPEST = 64 };

typedef struct settings {
    setting *root; /**< the text as a group */
    setting *last;
    char *words; /**< that all names and strings point into */
} settings;

typedef struct setting_fault {
    int line;
    const char *text; /**< a phrase without the line: "syntax error" */
} setting_fault;

/** Reads a text that ends with its first null byte. @return true, or false and why in *fault; in both cases `out` is
 * for setting_release() */
bool setting_parse(const char *text, settings *out, setting_fault *fault);

void setting_release(settings *s);

static inline bool setting_is_number(const setting *s) {
    return s->kind == SETTING_INTEGER || s->kind == SETTING_REAL;
}

#endif
