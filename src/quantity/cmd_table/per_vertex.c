/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd_table/per_vertex.h"

#include <math.h>

#include "report/number.h"

enum { DIGITS = 4, DIGITS_Z = 9 };

bool per_vertex_matters(const dp_setup *setup) {
    const dp_mapping_row *row = dp_mapping_get(setup->spec.mapping);
    return row->curve != DP_CURVE_PERSPECTIVE && !row->per_fragment;
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

per_vertex_worst per_vertex_none(void) {
    return (per_vertex_worst){(double)NAN, (double)NAN, (double)NAN};
}

void per_vertex_add(per_vertex_worst *worst, const per_vertex *here, double z) {
    if (isnan(here->error))
        return;
    if (!(here->error / z <= worst->error / worst->z)) {
        worst->error = here->error;
        worst->z = z;
    }
    worst->depth = fmin(worst->depth, here->depth); /* the other one where one is NaN */
}

void per_vertex_say(page *p, const per_vertex_worst *w, double depth) {
    if (isnan(w->z))
        return;
    const number_text class = number_full(depth);
    const number_text error = number_in(number_up(w->error, DIGITS), p->unit);
    const number_text z = number_in(number_of(w->z, DIGITS_Z), p->unit);
    if (depth <= w->depth)
        page_line(p,
                  "written per vertex, depth is at most %s too far at z = %s in triangles from z/%s to %s z: less than "
                  "the separation",
                  error.text, z.text, class.text, class.text);
    else
        page_line(p,
                  "written per vertex, depth is up to %s too far at z = %s in triangles from z/%s to %s z: write it "
                  "per fragment, unless all triangles lie within z/k and k z, k = 1 + %s",
                  error.text, z.text, class.text, class.text, number_down(w->depth - 1.0, 2).text);
}
