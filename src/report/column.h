/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file column.h  For the forms of a report: whether a column is in one, and its value. */
#ifndef REPORT_COLUMN_H
#define REPORT_COLUMN_H

#include <math.h>

#include "report/report.h"

/* Does a form, one of AS_TEXT, ..., have the column under these conditions? */
static inline bool column_shows(const column *c, unsigned form, unsigned when) {
    return (c->only == 0 || (c->only & form) != 0) && (c->when & ~when) == 0;
}

/* A number, a count, or else a word. */
typedef struct column_value {
    bool is_number, is_count;
    double number;
    uint64_t count;
    const char *word; /* "true" and "false" of a flag; null where there is none */
} column_value;

/* The value of a column that is no part and no list. */
static inline column_value column_of(const column *c, const void *item) {
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

static inline bool column_exists(const column_value *v) {
    return v->is_number ? !isnan(v->number) : v->is_count || v->word != NULL;
}

#endif
