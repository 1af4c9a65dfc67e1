/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file column.h  What the writers of all forms ask of a column; for the room report alone. */
#ifndef REPORT_COLUMN_H
#define REPORT_COLUMN_H

#include <math.h>

#include "report/report.h"

typedef enum column_value_kind { VALUE_NUMBER, VALUE_COUNT, VALUE_WORD } column_value_kind;

typedef struct column_value {
    column_value_kind kind;
    double number;
    uint64_t count;
    const char *word; /**< "true" and "false" of a flag; null where there is none */
} column_value;

/** The value of a column that is no part and no list. */
column_value column_of(const column *c, const void *item);

static inline bool column_exists(const column_value *v) {
    return v->kind == VALUE_NUMBER ? !isnan(v->number) : v->kind == VALUE_COUNT || v->word != NULL;
}

/** The item of a part; null where it does not exist. */
void *column_part(const column *c, void *item);

/** Does a form, one of AS_TEXT, ..., have the column under these conditions? */
bool column_shows(const column *c, unsigned form, unsigned when);

void report_text(const report_spec *spec, output *out);

#endif
