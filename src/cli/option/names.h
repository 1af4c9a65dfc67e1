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

#include "cli/list.h"

typedef struct name_list {
    const char *const *words; /**< before the rows, null behind the last; or null when there are none */
    list_get get;             /**< the rows, with their other spellings; or null when there are none */
    const char *more;         /**< what else is allowed, added to the list in a refusal; or null */
} name_list;

enum { NAMES_SIZE = 512 };

/** Name `index`, words first; false behind the last. A word has no row. */
bool names_get(const name_list *n, size_t index, list_item *item);

/** Is it called so, in any case? */
bool names_is(const list_item *item, const char *text);

/** Letter case does not matter. `index` and `item` may be null. */
bool names_find(const name_list *n, const char *text, size_t *index, list_item *item);

/** All names: "a, b or c" with ", " between them and " or " before the last. @return out */
const char *names_join(const name_list *n, const char *between, const char *last, char out[NAMES_SIZE]);

/** "; did you mean 'PREFIXname'?" with the name, or other spelling, nearest to `given`; "" when none is near.
 *  @return out */
const char *names_nearest(const name_list *n, const char *prefix, const char *given, char out[NAMES_SIZE]);

/** "must be a, b or c, got 'given'" and the nearest. @return out */
const char *names_refuse(const name_list *n, const char *given, char out[NAMES_SIZE]);

#endif
