/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/reach.h"

#include <math.h>
#include <stdio.h>

#include "need/distance.h"
#include "report/number.h"

const double reach_limits[REACH_LIMITS] = {0.001, 0.01, 0.1};

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

const char *reach_text(const dp_setup *setup, double up_to, char out[REACH_TEXT_SIZE]) {
    if (up_to >= setup->spec.zfar)
        snprintf(out, REACH_TEXT_SIZE, "the far plane");
    else
        snprintf(out, REACH_TEXT_SIZE, "%s", number_brief(number_down(up_to, REACH_DIGITS)).text);
    return out;
}
