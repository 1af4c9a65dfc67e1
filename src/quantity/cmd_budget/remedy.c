/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd_budget/remedy.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

enum {
    AGAINST_COMPOSITION = 1 << DP_CAUSE_COMPOSITION,
    AGAINST_ROUNDING = 1 << DP_CAUSE_PROJECTION | 1 << DP_CAUSE_NDC,
    AGAINST_PROJECTION = 1 << DP_CAUSE_PROJECTION,
    AGAINST_FORMAT = 1 << DP_CAUSE_FORMAT,
    AGAINST_SHADER = 1 << DP_CAUSE_ARGUMENT | 1 << DP_CAUSE_LOG2 | 1 << DP_CAUSE_SCALE,
    AGAINST_LINEARIZATION = 1 << DP_CAUSE_LINEARIZATION
};

/* A change of the camera, and the causes that it lessens. */
typedef struct remedy {
    unsigned causes;
    const char *text, *format; /* a finer format, or null */
    bool relative, complement, fused, zero_to_one, infinite, reversed;
} remedy;

/* The simpler first. */
static const remedy remedies[] = {
    {AGAINST_COMPOSITION, "positions relative to the camera", .relative = true},
    {AGAINST_LINEARIZATION, "reading back by the complement form", .complement = true},
    {AGAINST_PROJECTION, "a fused A z + B", .fused = true},
    {AGAINST_ROUNDING, "NDC from 0 to 1", .zero_to_one = true},
    {AGAINST_FORMAT, "unorm24", .format = "unorm24"},
    {AGAINST_FORMAT, "fp32", .format = "fp32"},
    {AGAINST_ROUNDING, "an infinite far plane", .infinite = true},
    {AGAINST_ROUNDING | AGAINST_FORMAT | AGAINST_LINEARIZATION, "reversed depth", .reversed = true},
    {AGAINST_ROUNDING, "reversed depth and an infinite far plane", .reversed = true, .infinite = true},
    {AGAINST_ROUNDING | AGAINST_FORMAT | AGAINST_SHADER, "reversed depth in fp32", .reversed = true, .format = "fp32"},
};

/* False where depth is reversed already: to leave [-1, 1] is a change of its own. */
static bool change(const remedy *r, dp_spec *spec, dp_budget_terms *terms) {
    const bool was_reversed = dp_mapping_get(spec->mapping)->reversed;
    const dp_arith_row *arith = dp_arith_get(spec->arith);
    dp_format found[2];
    const bool finer =
        r->format != NULL && dp_format_parse(r->format, found) == 1 && found[0].code_max > spec->format.code_max;
    if (finer)
        spec->format = found[0];
    if (r->zero_to_one || r->reversed)
        spec->mapping = r->reversed || was_reversed ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
    if (r->fused && !arith->fused)
        dp_arith_parse(arith->reciprocal ? "fused-reciprocal" : "fused", &spec->arith);
    if (r->infinite)
        spec->zfar = HUGE_VAL;
    if (r->relative)
        terms->composition = DP_COMPOSITION_RELATIVE;
    if (r->complement)
        terms->linearize = 0;
    return !r->reversed || !was_reversed || finer;
}

double remedy_step(double z) {
    const float here = (float)z;
    return (double)nextafterf(here, HUGE_VALF) - (double)here;
}

remedy_result remedy_find(const dp_setup *setup, const dp_budget_terms *terms, double z, dp_cause cause) {
    static const double about_as_well = 0.95;
    dp_budget budget = {.separation = HUGE_VAL};
    dp_budget_at(setup, z, terms, &budget);
    remedy_result best = {NULL, budget.separation};
    for (const remedy *r = remedies; r < remedies + sizeof remedies / sizeof remedies[0]; r++) {
        dp_spec spec = setup->spec;
        dp_budget_terms other = *terms;
        dp_setup changed;
        if ((r->causes >> cause & 1) == 0 || !change(r, &spec, &other) || dp_setup_init(&changed, &spec) != DP_OK ||
            dp_budget_at(&changed, z, &other, &budget) != DP_OK)
            continue;
        const double separation = fmax(budget.separation, remedy_step(z));
        if (separation < about_as_well * best.separation)
            best = (remedy_result){r->text, separation};
    }
    return best;
}
