/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd_table/per_vertex.h"

#include <math.h>

enum { DIGITS = 4, DIGITS_Z = 9 };

bool per_vertex_matters(const dp_setup *setup) {
    const dp_mapping_row *row = dp_mapping_get(setup->spec.mapping);
    return row->written == DP_WRITTEN_BY_VERTEX || row->written == DP_WRITTEN_BY_EITHER;
}

per_vertex per_vertex_at(const dp_setup *setup, double z, double depth, double separation) {
    per_vertex here = {(double)NAN, (double)NAN};
    dp_vertex_error e;
    if (!per_vertex_matters(setup) || dp_vertex_error_at(setup, z, depth, &e) != DP_OK)
        return here;
    here.error = e.eye;
    dp_vertex_depth_at(setup, z, separation, &here.depth);
    return here;
}

per_vertex_worst per_vertex_none(double depth) {
    return (per_vertex_worst){depth, (double)NAN, (double)NAN, (double)NAN, (double)NAN};
}

void per_vertex_add(per_vertex_worst *worst, const per_vertex *here, double z) {
    if (isnan(here->error))
        return;
    if (!(here->error / z <= worst->error / worst->z)) {
        worst->error = here->error;
        worst->z = z;
    }
    worst->depth = fmin(worst->depth, here->depth); /* the other one where one is NaN */
    worst->beyond = worst->depth - 1.0;
}

const column per_vertex_columns[] = {
    {FIELD(per_vertex_worst, z, "z", "scene"), .digits = DIGITS_Z},
    {FIELD(per_vertex_worst, error, "error", "scene"), .digits = DIGITS, .upward = true},
    {FIELD(per_vertex_worst, class, "class", "")},
    {FIELD(per_vertex_worst, beyond, "beyond", ""), .digits = 2, .downward = true},
    {.kind = COLUMN_END}};
