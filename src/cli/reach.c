/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/reach.h"

#include <math.h>
#include <stdio.h>

#include "need/distance.h"

static const struct {
    double bare, value;
    const char *unit;
} limits[REACH_LIMITS] = {{0.001, 1, "mm"}, {0.01, 1, "cm"}, {0.1, 10, "cm"}};

double reach_limit(size_t i, const unit_row *unit) {
    return unit != NULL ? unit_convert(limits[i].value, unit_find(limits[i].unit), unit) : limits[i].bare;
}

number_text reach_limit_text(size_t i, const unit_row *unit) {
    return unit != NULL ? number_in(number_full(limits[i].value), limits[i].unit) : number_full(limits[i].bare);
}

dp_setup reach_in(const dp_setup *setup, dp_model model) {
    dp_setup out = *setup;
    dp_spec spec = setup->spec;
    spec.model = model;
    if (model != setup->spec.model)
        dp_setup_init(&out, &spec); /* cannot fail: the set-up was made, and the model is one that its mapping has */
    return out;
}

dp_setup reach_model(const dp_setup *setup) {
    const dp_curve curve = dp_mapping_get(setup->spec.mapping)->curve;
    return reach_in(setup, curve == DP_CURVE_PERSPECTIVE ? DP_MODEL_FP32 : DP_MODEL_STAGED);
}

double reach_of(const dp_setup *full, double limit) {
    distance_answer answer;
    const dp_status status =
        distance_solve(MEASURE_SEPARATION, full, full->spec.znear, full->spec.zfar, limit, &answer);
    return status == DP_OK && answer.possible ? answer.value : (double)NAN;
}

const char *reach_text(double zfar, double up_to, const unit_row *unit, char out[REACH_TEXT_SIZE]) {
    if (up_to >= zfar)
        snprintf(out, REACH_TEXT_SIZE, "the far plane");
    else
        snprintf(out, REACH_TEXT_SIZE, "%s",
                 number_in(number_brief(number_down(up_to, REACH_DIGITS)), unit != NULL ? unit->name : NULL).text);
    return out;
}
