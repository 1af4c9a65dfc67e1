/* SPDX-License-Identifier: GPL-3.0-or-later */

#include "method/method.h"

static const method_family_row *const families[METHOD_FAMILY_COUNT] = {
    [METHOD_INTERVAL] = &interval_family, [METHOD_LINEARIZE] = &linearize_family, [METHOD_ENCODE] = &encode_family,
    [METHOD_WORST] = &worst_family,       [METHOD_POSITION] = &position_family,   [METHOD_NORMAL] = &normal_family,
};

const method_family_row *method_family_get(size_t index) {
    return index < METHOD_FAMILY_COUNT ? families[index] : NULL;
}

const method_row *method_get(size_t index) {
    for (size_t i = 0; i < METHOD_FAMILY_COUNT; i++) {
        const method_family_row *family = method_family_get(i);
        if (index < *family->method_count)
            return &family->methods[index];
        index -= *family->method_count;
    }
    return NULL;
}
