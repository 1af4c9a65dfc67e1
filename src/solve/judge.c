/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/judge.h"

#include <math.h>

#include "core/engine.h"

static judgement of_separation(const dp_setup *setup, double lo, double hi, double limit) {
    dp_separation_worst worst = {.bound = HUGE_VAL, .separation = HUGE_VAL, .z = hi};
    if (lo == hi)
        worst.bound = worst.separation = dp_separation(setup, lo);
    else
        dp_separation_over(setup, lo, hi, isnan(limit) ? 0.0 : limit, &worst); /* the caller has checked the range */
    const bool passed = worst.bound <= limit;
    return (judgement){
        .value = passed || worst.separation > limit ? worst.separation : worst.bound, .z = worst.z, .passed = passed};
}

/* The judgement of the error of depth that a shader writes, whatever its log2. */
static judgement of_written_error(const dp_setup *setup, double lo, double hi, double limit) {
    judgement out;
    out.value = dp_computed_error_over(setup, lo, hi, &out.z);
    out.code = dp_code(setup, out.z);
    out.passed = out.value <= limit;
    return out;
}

static judgement of_error(const dp_setup *setup, double lo, double hi, double limit) {
    if (setup->shader)
        return of_written_error(setup, lo, hi, limit);
    dp_worst worst = {.error = HUGE_VAL, .error_z = hi};
    if (lo == hi) {
        worst.error_code = dp_code(setup, lo);
        worst.error = fabs(dp_error(setup, worst.error_code, lo));
        worst.error_z = lo;
    } else {
        dp_worst_over(setup, lo, hi, &worst);
    }
    return (judgement){
        .value = worst.error, .z = worst.error_z, .code = worst.error_code, .passed = worst.error <= limit};
}

dp_status judge_setup(const dp_spec *spec, dp_setup *out) {
    dp_spec own = *spec;
    const bool shader = spec->model == DP_MODEL_FLOAT && dp_mapping_get(spec->mapping)->curve == DP_CURVE_LOG;
    if (shader)
        own.model = DP_MODEL_STAGED;
    const dp_status status = dp_setup_init(out, &own);
    if (status == DP_OK && shader)
        *out = dp_setup_guaranteed(out);
    return status;
}

judgement judge(measure_kind kind, const dp_setup *setup, double lo, double hi, double limit) {
    return kind == MEASURE_ERROR ? of_error(setup, lo, hi, limit) : of_separation(setup, lo, hi, limit);
}
