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
    [QUANTITY_SEPARATION] = {"separation", NULL, "separation", NULL, "guaranteed separation", "scene units",
                             dp_separation, separation_over, NULL},
    [QUANTITY_ERROR] = {"error", NULL, "error of the stored depth", NULL, "worst |decoded depth \u2212 z|",
                        "scene units", error_at, error_over, error_of},
    [QUANTITY_TIES] = {"ties", NULL, "share of ties and swaps", NULL, NULL, NULL, NULL, NULL, NULL},
    [QUANTITY_BIAS] = {"bias", NULL, "bias", NULL, NULL, NULL, NULL, NULL, NULL},
    [QUANTITY_INTERVAL] = {"interval", NULL, NULL, NULL, "z-fighting interval", "scene units", interval_at,
                           interval_over, interval_of},
    [QUANTITY_DENSITY] = {"density", NULL, NULL, NULL, "codes, fewest", "per scene unit of depth", NULL, NULL,
                          density_of},
};

NAMED_TABLE(quantity, rows);

quantity_worst quantity_over(quantity_kind q, const dp_setup *setup, double lo, double hi, double limit) {
    if (lo != hi)
        return rows[q].over(setup, lo, hi, limit);
    const double value = rows[q].at(setup, lo);
    return (quantity_worst){value, lo, q == QUANTITY_ERROR ? dp_code(setup, lo) : 0, value <= limit};
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
