/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/cost.h"

#include <string.h>

/* A surface is shaded where it is drawn, or before that tested: where it is the nearest of those drawn so far, of the
 * k-th a chance of 1/k. */
static double shaded(bool early) {
    double runs = 0;
    for (int k = 1; k <= COST_SURFACES; k++)
        runs += early ? 1.0 / k : 1;
    return runs;
}

cost cost_of(const dp_format *format, dp_mapping mapping) {
    const dp_mapping_row *row = dp_mapping_get(mapping);
    cost c = {
        .early = true, .bytes = (format->bits + 7) / 8, .available = "no API: for study", .caution = "", .effort = ""};
    for (size_t i = 0; i < dp_format_count(); i++)
        if (strcmp(dp_format_get(i)->format.name, format->name) == 0) {
            const dp_format_row *named = dp_format_get(i);
            c = (cost){.buffer = named->buffer,
                       .bytes = named->bytes,
                       .early = true,
                       .rank = named->rank,
                       .available = named->available,
                       .caution = named->caution,
                       .effort = ""};
        }
    if (row != NULL) {
        c.rank += row->rank;
        c.effort = row->effort;
        c.early = row->written == DP_WRITTEN_BY_MATRIX || row->written == DP_WRITTEN_BY_VERTEX;
    }
    c.shaded = shaded(c.early);
    return c;
}

int cost_compare(const cost *a, const cost *b) {
    const int buffers = b->buffer - a->buffer;
    return buffers != 0 ? buffers : a->bytes != b->bytes ? a->bytes - b->bytes : a->rank - b->rank;
}
