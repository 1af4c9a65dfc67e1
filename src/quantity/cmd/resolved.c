/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd/resolved.h"

#include <math.h>
#include <stdio.h>

#include "solve/distance.h"

static const struct {
    double bare, value;
    const char *unit;
} limits[RESOLVED_LIMITS] = {{0.001, 1, "mm"}, {0.01, 1, "cm"}, {0.1, 10, "cm"}};

double resolved_limit(size_t i, const unit_row *unit) {
    return unit != NULL ? unit_convert(limits[i].value, unit_find(limits[i].unit), unit) : limits[i].bare;
}

number_text resolved_limit_text(size_t i, const unit_row *unit) {
    return unit != NULL ? number_in(number_full(limits[i].value), limits[i].unit) : number_full(limits[i].bare);
}

/* Where a smaller separation is guaranteed a larger one is: each is sought behind the one before. */
void resolved_up_to(const dp_setup *full, const unit_row *unit, double up_to[RESOLVED_LIMITS]) {
    double from = full->spec.znear;
    for (size_t i = 0; i < RESOLVED_LIMITS; i++) {
        up_to[i] = distance_about(full, from, full->spec.zfar, resolved_limit(i, unit), RESOLVED_DIGITS);
        from = isnan(up_to[i]) ? from : up_to[i];
    }
}

const char *resolved_text(double zfar, double up_to, const unit_row *unit, char out[RESOLVED_TEXT_SIZE]) {
    if (up_to >= zfar)
        snprintf(out, RESOLVED_TEXT_SIZE, "the far plane");
    else
        snprintf(out, RESOLVED_TEXT_SIZE, "%s",
                 number_in(number_brief(number_down(up_to, RESOLVED_DIGITS)), unit != NULL ? unit->name : NULL).text);
    return out;
}
