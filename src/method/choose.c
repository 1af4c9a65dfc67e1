/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/choose.h"

#include <math.h>

static bool covers(const method_row *row, size_t which, const method_wish *w) {
    const method_claim *c = &row->claims[which];
    const double hi = isinf(w->ratio_hi) ? METHOD_RATIO_HI : w->ratio_hi;
    return method_speaks(row, which) && method_claim_over(c, w->ratio_lo, w->ratio_hi) <= w->tolerance &&
           c->ratio_lo <= w->ratio_lo && hi <= c->ratio_hi &&
           (!isinf(w->ratio_hi) || (row->domain & METHOD_INFINITE) != 0) &&
           (w->ortho ? (row->domain & METHOD_ORTHO) != 0 : (row->domain & METHOD_FLAT) == 0) &&
           (!w->cut_cells || (row->domain & METHOD_WHOLE) == 0) &&
           w->pipeline == ((row->domain & METHOD_PIPELINE) != 0);
}

const method_row *method_choose(const method_family_row *family, size_t which, const method_wish *wish) {
    const method_row *best = NULL;
    for (size_t i = 0; i < *family->method_count; i++) {
        const method_row *row = &family->methods[i];
        if (covers(row, which, wish) && method_available(row) && (best == NULL || row->cost < best->cost))
            best = row;
    }
    return best;
}
