/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file names.h  Names that stand for the rows of a table: looked up, listed in a refusal, and the nearest one offered.
 *
 *     static const name_list themes = {.words = (const char *const[]){"light", "dark", NULL}};
 *     if (!names_find(&themes, text, &index, NULL))       // must be light or dark, got 'drak'; did you mean 'dark'?
 *         usage_error("%s", names_refuse(&themes, text, buffer));
 */
#ifndef CLI_OPTION_NAMES_H
#define CLI_OPTION_NAMES_H

#include <stdbool.h>
#include <stddef.h>

#include "core/named.h"

enum { LIST_TEXT_SIZE = 768 };

/** One listed thing. Texts are static, except `bound`, which is written in place. */
typedef struct list_item {
    const char *name;
    const char *aliases;        /**< separated by one space; null or "" when there are none */
    const char *note;           /**< what it is, one line */
    char bound[LIST_TEXT_SIZE]; /**< the claim, "" when nothing is claimed */
    const char *source;         /**< null or "" when there is none */
    const void *row;            /**< the row itself; null where it has no pointer */
} list_item;

/** Writes what there is. @return true */
static inline bool list_fill(list_item *item, list_item what) {
    *item = what;
    return true;
}

/** Fills in thing `index`; false when there is none. */
typedef bool (*list_get)(size_t index, list_item *item);

typedef struct name_list {
    const char *const *words; /**< before the rows, null behind the last; or null when there are none */
    const named_table *rows;  /**< or null when there are none, */
    list_get get;             /**< or when they are no table: this gives them */
    void (*tell)(const void *row, list_item *item); /**< writes what is claimed of a row; null where nothing is */
    const char *more; /**< what else is allowed, added to the list in a refusal; or null */
} name_list;

enum { NAMES_SIZE = 1024 };

/** Name `index`, words first; false behind the last. A word has no row. */
bool names_get(const name_list *n, size_t index, list_item *item);

/** Letter case does not matter. `index` and `item` may be null. */
bool names_find(const name_list *n, const char *text, size_t *index, list_item *item);

/** All names: "a, b or c" with ", " between them and " or " before the last. @return out */
const char *names_join(const name_list *n, const char *between, const char *last, char out[NAMES_SIZE]);

/** "; did you mean 'PREFIXname' or 'PREFIXother'?" with the names, or other spellings, nearest to `given`, by edits or
 * because one begins the other; "" when none is near. `most`: up to 3 of them; of 2 the first alone where it is meant.
 * @return out */
const char *names_nearest(const name_list *n, const char *prefix, const char *given, size_t most, char out[NAMES_SIZE]);

/** "must be a, b or c, got 'given'" and the nearest. @return out */
const char *names_refuse(const name_list *n, const char *given, char out[NAMES_SIZE]);

#endif
