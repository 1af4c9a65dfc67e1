/* SPDX-License-Identifier: MIT */
/*
 * For the rooms above: tables of rows that have a name. Such a row begins with NAMED_FIELDS, a room shows its table
 * with NAMED_ROWS(raster_row, raster) in a header and defines it with NAMED_TABLE(raster, rows) beside the rows:
 *
 *     for (size_t i = 0; raster_get(i) != NULL; i++)
 *         puts(raster_get(i)->name);
 *     const raster_row *row = raster_find("softpipe"); // null when nothing is called so
 */
#ifndef CORE_NAMED_H
#define CORE_NAMED_H

#include <stdbool.h>
#include <stddef.h>
#include <string.h>
#include <strings.h>

#define NAMED_FIELDS                                                                                                   \
    const char *name;                                                                                                  \
    const char *aliases; /* other accepted spellings, separated by one space; null when there are none */              \
    const char *note;    /* what it is, one line; null when the name says it */                                        \
    const char *source   /* where that is written; null when nowhere else */

/* The beginning of every row of a table. */
typedef struct named_row {
    NAMED_FIELDS;
} named_row;

typedef struct named_table {
    const void *rows;
    size_t size, count; /* of a row, in bytes; of rows */
} named_table;

/* Row `index`; null for one that is not below the count. */
static inline const void *named_at(const named_table *t, size_t index) {
    return index < t->count ? (const char *)t->rows + index * t->size : NULL;
}

/* Whether `text` is one of the words of `list`, which are separated by one space, in any case. */
static inline bool named_among(const char *text, const char *list) {
    for (const size_t length = strlen(text); list != NULL && length > 0; list = strchr(list, ' ')) {
        list += *list == ' ';
        if (strcspn(list, " ") == length && strncasecmp(list, text, length) == 0)
            return true;
    }
    return false;
}

/* Whether a thing of that name and those other spellings is called `text`, in any case. */
static inline bool named_is(const char *name, const char *aliases, const char *text) {
    return strcasecmp(name, text) == 0 || named_among(text, aliases);
}

/* The first row that is called so; null when there is none. */
static inline const void *named_find(const named_table *t, const char *text) {
    for (size_t i = 0; i < t->count; i++) {
        const named_row *row = named_at(t, i);
        if (named_is(row->name, row->aliases, text))
            return row;
    }
    return NULL;
}

/* Declares the table PREFIX_table and, over it, named_at() and named_find() as PREFIX_get() and PREFIX_find(). */
#define NAMED_ROWS(type, prefix)                                                                                       \
    extern const named_table prefix##_table;                                                                           \
    static inline const type *prefix##_get(size_t index) {                                                             \
        return named_at(&prefix##_table, index);                                                                       \
    }                                                                                                                  \
    static inline const type *prefix##_find(const char *text) {                                                        \
        return named_find(&prefix##_table, text);                                                                      \
    }                                                                                                                  \
    struct named_table_end /* which the semicolon behind it ends */

/* Defines it. */
#define NAMED_TABLE(prefix, array)                                                                                     \
    _Static_assert(offsetof(__typeof__((array)[0]), name) == 0, "a row begins with NAMED_FIELDS");                     \
    const named_table prefix##_table = {array, sizeof(array)[0], sizeof(array) / sizeof(array)[0]}

#endif
