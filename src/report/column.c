/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/column.h"

bool column_shows(const column *c, unsigned form, unsigned when) {
    return (c->only == 0 || (c->only & form) != 0) && (c->when & ~when) == 0;
}

void *column_part(const column *c, void *item) {
    if (item == NULL)
        return NULL;
    void *at = (char *)item + c->offset;
    return c->pointed ? *(void **)at : at;
}

column_value column_of(const column *c, const void *item) {
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
