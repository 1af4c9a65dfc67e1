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

/* What is guaranteed of a smaller separation is so of a larger one: each is sought behind the one before. */
void reach_of(const dp_setup *full, const unit_row *unit, double up_to[REACH_LIMITS]) {
    double from = full->spec.znear;
    for (size_t i = 0; i < REACH_LIMITS; i++) {
        up_to[i] = distance_about(full, from, full->spec.zfar, reach_limit(i, unit), REACH_DIGITS);
        from = isnan(up_to[i]) ? from : up_to[i];
    }
}

const char *reach_text(double zfar, double up_to, const unit_row *unit, char out[REACH_TEXT_SIZE]) {
    if (up_to >= zfar)
        snprintf(out, REACH_TEXT_SIZE, "the far plane");
    else
        snprintf(out, REACH_TEXT_SIZE, "%s",
                 number_in(number_brief(number_down(up_to, REACH_DIGITS)), unit != NULL ? unit->name : NULL).text);
    return out;
}
