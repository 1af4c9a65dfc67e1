/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/quantity.h"

#include <math.h>

#include "core/engine.h"

/* ---- The separation ---------------------------------------------------------------------------------------------- */

/* The caller has checked the range. */
static quantity_worst separation_over(const dp_setup *setup, double lo, double hi, double limit) {
    dp_separation_worst worst = {.bound = (double)NAN, .separation = HUGE_VAL, .z = hi};
    dp_separation_over(setup, lo, hi, isnan(limit) ? 0.0 : limit, &worst);
    const bool passed = worst.bound <= limit;
    return (quantity_worst){
        .value = passed || worst.separation > limit ? worst.separation : worst.bound, .z = worst.z, .passed = passed};
}

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

static double error_at(const dp_setup *setup, double z) {
    double worst;
    return dp_is_computed(setup) ? dp_computed_error_over(setup, z, z, &worst)
                                 : fabs(dp_error(setup, dp_code(setup, z), z));
}

static quantity_worst error_over(const dp_setup *setup, double lo, double hi, double limit) {
    dp_worst worst = {.error = HUGE_VAL, .error_z = hi};
    if (dp_is_computed(setup)) {
        worst.error = dp_computed_error_over(setup, lo, hi, &worst.error_z);
        worst.error_code = dp_code(setup, worst.error_z);
    } else {
        dp_worst_over(setup, lo, hi, &worst);
    }
    return (quantity_worst){worst.error, worst.error_z, worst.error_code, worst.error <= limit};
}

static double interval_at(const dp_setup *setup, double z) {
    dp_sample sample = {.interval = (double)NAN};
    dp_sample_at(setup, z, &sample);
    return sample.interval;
}

static quantity_worst interval_over(const dp_setup *setup, double lo, double hi, double limit) {
    dp_worst worst = {.interval = (double)NAN, .interval_lo = (double)NAN};
    dp_worst_over(setup, lo, hi, &worst);
    return (quantity_worst){worst.interval, worst.interval_lo, worst.interval_code, worst.interval <= limit};
}

static double error_of(const dp_worst *worst) {
    return worst->error;
}

static double interval_of(const dp_worst *worst) {
    return worst->interval;
}

static double density_of(const dp_worst *worst) {
    return 1 / worst->interval;
}

/* ---- The rows ---------------------------------------------------------------------------------------------------- */

static const quantity_row rows[QUANTITY_COUNT] = {
    [QUANTITY_SEPARATION] = {.name = "separation",
                             .note = "separation",
                             .axis = "guaranteed separation",
                             .unit = "scene units",
                             .of_surfaces = true,
                             .at = dp_separation,
                             .over = separation_over,
                             .within = dp_separation_within},
    [QUANTITY_ERROR] = {.name = "error",
                        .note = "error of the stored depth",
                        .axis = "worst |decoded depth \u2212 z|",
                        .unit = "scene units",
                        .at = error_at,
                        .over = error_over,
                        .within = dp_error_within,
                        .of_cells = error_of},
    [QUANTITY_TIES] = {.name = "ties", .note = "share of ties and swaps"},
    [QUANTITY_BIAS] = {.name = "bias", .note = "bias", .of_surfaces = true},
    [QUANTITY_INTERVAL] = {.name = "interval",
                           .axis = "z-fighting interval",
                           .unit = "scene units",
                           .at = interval_at,
                           .over = interval_over,
                           .of_cells = interval_of},
    [QUANTITY_DENSITY] = {.name = "density",
                          .axis = "codes, fewest",
                          .unit = "per scene unit of depth",
                          .of_cells = density_of},
};

NAMED_TABLE(quantity, rows);

bool quantity_has_model(quantity_kind q, dp_model model, dp_mapping mapping) {
    return model != DP_MODEL_FLOAT || rows[q].of_cells == NULL || dp_mapping_get(mapping)->curve == DP_CURVE_LOG;
}

quantity_worst quantity_over(quantity_kind q, const dp_setup *setup, double lo, double hi, double limit) {
    if (lo != hi)
        return rows[q].over(setup, lo, hi, limit);
    const double value = rows[q].at(setup, lo);
    return (quantity_worst){value, lo, rows[q].of_cells != NULL ? dp_code(setup, lo) : 0, value <= limit};
}

double quantity_bound(quantity_kind q, const dp_setup *setup, double lo, double hi) {
    return rows[q].over(setup, lo, hi, (double)NAN).value;
}

dp_status quantity_setup(const dp_spec *spec, dp_setup *out) {
    dp_spec own = *spec;
    const bool shader = spec->model == DP_MODEL_FLOAT && dp_mapping_get(spec->mapping)->curve == DP_CURVE_LOG;
    if (shader)
        own.model = DP_MODEL_STAGED;
    const dp_status status = dp_setup_init(out, &own);
    if (status == DP_OK && shader)
        *out = dp_setup_guaranteed(out);
    return status;
}
