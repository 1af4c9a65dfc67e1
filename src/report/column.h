/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file column.h  What the writers of all forms ask of a column; for the room report alone. */
#ifndef REPORT_COLUMN_H
#define REPORT_COLUMN_H

#include <math.h>

#include "report/number.h"
#include "report/report.h"

/** A number, a count, or else a word. */
typedef struct column_value {
    bool is_number, is_count;
    double number;
    uint64_t count;
    const char *word; /**< "true" and "false" of a flag; null where there is none */
} column_value;

/** The value of a column that is no part and no list. */
column_value column_of(const column *c, const void *item);

static inline bool column_exists(const column_value *v) {
    return v->is_number ? !isnan(v->number) : v->is_count || v->word != NULL;
}

/** The item of a part; null where it does not exist, or the outer item does not. */
void *column_part(const column *c, void *item);

/** Does a form, one of AS_TEXT, ..., have the column under these conditions? */
bool column_shows(const column *c, unsigned form, unsigned when);

void report_text(const report_spec *spec, output *out);

#endif
