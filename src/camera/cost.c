/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/cost.h"

#include <string.h>

cost cost_of(const dp_format *format, dp_mapping mapping) {
    const dp_mapping_row *row = dp_mapping_get(mapping);
    cost c = {
        .early = true, .bytes = (format->bits + 7) / 8, .available = "no API: for study", .caution = "", .effort = ""};
    for (size_t i = 0; i < dp_format_count(); i++)
        if (strcmp(dp_format_get(i)->format.name, format->name) == 0) {
            const dp_format_row *named = dp_format_get(i);
            c = (cost){named->buffer, named->bytes, true, named->rank, named->available, named->caution, ""};
        }
    if (row != NULL) {
        c.rank += row->rank;
        c.effort = row->effort;
        c.early = row->written == DP_WRITTEN_BY_MATRIX || row->written == DP_WRITTEN_BY_VERTEX;
    }
    return c;
}

int cost_compare(const cost *a, const cost *b) {
    const int buffers = b->buffer - a->buffer;
    return buffers != 0 ? buffers : a->bytes != b->bytes ? a->bytes - b->bytes : a->rank - b->rank;
}
