/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/remedy.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* What is changed; a change that would change nothing, or that the set-up cannot have, says false. */
typedef struct plan {
    dp_spec spec;
    dp_budget_terms terms;
} plan;

static bool use_format(plan *p, const char *name) {
    dp_format found[2];
    if (dp_format_parse(name, found) != 1 || found[0].code_max <= p->spec.format.code_max)
        return false;
    p->spec.format = found[0];
    return true;
}

static bool use_unorm24(plan *p) {
    return use_format(p, "unorm24");
}

static bool use_fp32(plan *p) {
    return use_format(p, "fp32");
}

static bool use_zero_to_one(plan *p) {
    const bool is_signed = dp_mapping_get(p->spec.mapping)->ndc_signed;
    p->spec.mapping = dp_mapping_get(p->spec.mapping)->reversed ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
    return is_signed;
}

static bool use_reversed(plan *p) {
    const bool is_reversed = dp_mapping_get(p->spec.mapping)->reversed;
    p->spec.mapping = DP_MAPPING_REVERSED;
    return !is_reversed;
}

static bool use_reversed_fp32(plan *p) {
    const bool reversed = use_reversed(p);
    return use_fp32(p) || reversed;
}

static bool use_fused(plan *p) {
    const dp_arith_row *row = dp_arith_get(p->spec.arith);
    return !row->fused && dp_arith_parse(row->reciprocal ? "fused-reciprocal" : "fused", &p->spec.arith) == DP_OK;
}

static bool use_infinite(plan *p) {
    const bool finite = !isinf(p->spec.zfar);
    p->spec.zfar = HUGE_VAL;
    return finite;
}

static bool use_infinite_reversed(plan *p) {
    return use_reversed(p) && use_infinite(p);
}

static bool use_relative(plan *p) {
    const bool absolute = p->terms.composition != DP_COMPOSITION_RELATIVE;
    p->terms.composition = DP_COMPOSITION_RELATIVE;
    return absolute;
}

static bool use_complement(plan *p) {
    p->terms.linearize = 0;
    return true;
}

enum {
    AGAINST_COMPOSITION = 1 << DP_CAUSE_COMPOSITION,
    AGAINST_ROUNDING = 1 << DP_CAUSE_PROJECTION | 1 << DP_CAUSE_NDC,
    AGAINST_PROJECTION = 1 << DP_CAUSE_PROJECTION,
    AGAINST_FORMAT = 1 << DP_CAUSE_FORMAT,
    AGAINST_LINEARIZATION = 1 << DP_CAUSE_LINEARIZATION
};

/* The simpler first. */
static const struct {
    unsigned causes;
    const char *text;
    bool (*change)(plan *);
} rows[] = {
    {AGAINST_COMPOSITION, "positions relative to the camera", use_relative},
    {AGAINST_LINEARIZATION, "reading back by the complement form", use_complement},
    {AGAINST_PROJECTION, "a fused A z + B", use_fused},
    {AGAINST_ROUNDING, "NDC from 0 to 1", use_zero_to_one},
    {AGAINST_FORMAT, "unorm24", use_unorm24},
    {AGAINST_FORMAT, "fp32", use_fp32},
    {AGAINST_ROUNDING, "an infinite far plane", use_infinite},
    {AGAINST_ROUNDING | AGAINST_FORMAT | AGAINST_LINEARIZATION, "reversed depth", use_reversed},
    {AGAINST_ROUNDING, "reversed depth and an infinite far plane", use_infinite_reversed},
    {AGAINST_ROUNDING | AGAINST_FORMAT, "reversed depth in fp32", use_reversed_fp32},
};

double remedy_step(double z) {
    const float here = (float)z;
    return (double)nextafterf(here, HUGE_VALF) - (double)here;
}

remedy_result remedy_find(const dp_setup *setup, const dp_budget_terms *terms, double z, dp_cause cause) {
    static const double about_as_well = 0.95;
    dp_budget budget = {.separation = HUGE_VAL};
    dp_budget_at(setup, z, terms, &budget);
    remedy_result best = {NULL, budget.separation};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        plan p = {setup->spec, *terms};
        dp_setup changed;
        if ((rows[i].causes >> cause & 1) == 0 || !rows[i].change(&p) || dp_setup_init(&changed, &p.spec) != DP_OK ||
            dp_budget_at(&changed, z, &p.terms, &budget) != DP_OK)
            continue;
        const double separation = fmax(budget.separation, remedy_step(z));
        if (separation < about_as_well * best.separation)
            best = (remedy_result){rows[i].text, separation};
    }
    return best;
}
