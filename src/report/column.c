/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>

#include "report/column.h"
#include "report/number.h"

void *column_part(const column *c, void *item) {
    if (item == NULL)
        return NULL;
    void *at = (char *)item + c->offset;
    return c->pointed ? *(void **)at : at;
}

bool column_has(const column *c, const void *item) {
    const column_value v = column_of(c, item);
    return column_exists(&v);
}

const char *column_text(const column *c, const void *item, number_text *number) {
    const column_value v = column_of(c, item);
    const int digits = c->digits_at > 0 ? *(const int *)((const char *)item + c->digits_at) : c->digits;
    *number = (number_text){"-"};
    if (v.is_count)
        number_count(v.count, number->text);
    else if (v.is_number && c->fixed && !isnan(v.number))
        snprintf(number->text, sizeof number->text, "%.*f", digits, v.number);
    else if (v.is_number && digits == 0)
        *number = isnan(v.number) ? *number : number_full(v.number);
    else if (v.is_number)
        *number = (c->upward     ? number_up
                   : c->downward ? number_down
                   : c->outward  ? number_outward
                                 : number_of)(v.number, digits);
    if (c->brief)
        *number = number_brief(*number);
    return v.word != NULL ? v.word : number->text;
}
