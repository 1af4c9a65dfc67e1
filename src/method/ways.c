/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/ways.h"

#include <math.h>
#include <string.h>

#include "method/choose.h"

/* The family's case that a set-up is one of, or case_count. Claims speak of no other rounding, model or arithmetic. */
static size_t case_of(const method_family_row *family, const dp_spec *spec) {
    size_t which = 0;
    if (spec->rounding != DP_ROUND_NEAREST || spec->model == DP_MODEL_STAGED ||
        (spec->model == DP_MODEL_FLOAT && (spec->arith != 0 || spec->ortho)))
        return family->case_count;
    while (which < family->case_count && (strcmp(spec->format.name, family->cases[which].format) != 0 ||
                                          spec->mapping != family->cases[which].mapping))
        which++;
    return which;
}

way way_choose(const dp_setup *setup, double tolerance, bool cut_cells) {
    const dp_spec *spec = &setup->spec;
    const method_family_row *family = method_family_get(METHOD_INTERVAL);
    const size_t which = case_of(family, spec);
    const double ratio = spec->zfar / spec->znear;
    const bool pipeline = spec->model == DP_MODEL_FLOAT;
    const method_wish wish = {.tolerance = tolerance,
                              .ratio_lo = fmin(ratio, METHOD_RATIO_HI),
                              .ratio_hi = ratio,
                              .ortho = spec->ortho,
                              .cut_cells = cut_cells && !pipeline,
                              .pipeline = pipeline};
    /* Claims are of far/near, which says nothing where near is not in front. */
    const bool claimed = which < family->case_count && spec->znear > 0 && !setup->ranged;
    const method_row *row = claimed ? method_choose(family, which, &wish) : NULL;
    if (row == NULL)
        return (way){.name = pipeline ? NULL : "cell", .claim = pipeline ? (double)NAN : 0};
    return (way){row, row->name, method_claim_over(&row->claims[which], wish.ratio_lo, wish.ratio_hi)};
}

double way_interval(const way *w, const dp_setup *setup, double z) {
    double value = NAN;
    const method_inputs in = {.count = 1, .z = &z};
    const method_outputs out = {.value = &value};
    if ((w->row->domain & METHOD_PIPELINE) == 0 || z + dp_separation(setup, z) <= setup->spec.zfar)
        w->row->run(&(method_call){w->row, setup, NULL, &in, &out}); /* no method of the family prepares anything */
    return value;
}
