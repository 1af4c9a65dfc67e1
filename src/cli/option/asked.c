/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What commands ask of options that were read. */
#include "cli/option/options.h"

const char *options_unit(const options *o) {
    return o->camera.unit != NULL ? o->camera.unit->name : NULL;
}

number_text options_length(const options *o, double value, int digits) {
    const options_camera *c = &o->camera;
    for (size_t i = 0; i < c->typed_count; i++)
        if (c->typed[i].value == value)
            return number_in(number_full(c->typed[i].number), c->typed[i].unit->name);
    return number_in(digits > 0 ? number_of(value, digits) : number_full(value), options_unit(o));
}

const bias_api *options_api(const options *o, size_t index) {
    size_t i = 0;
    while (bias_api_get(i) != NULL && ((o->bias.apis >> i & 1U) == 0 || index-- > 0))
        i++;
    return bias_api_get(i);
}
