/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file named.h  Rows of tables by their names; null where there is none of a name. */
#ifndef TESTS_NAMED_H
#define TESTS_NAMED_H

#include <string.h>

#include "api/bias.h"
#include "api/platform.h"
#include "api/presets.h"
#include "frame/synthetic.h"
#include "method/method.h"
#include "plot/figure.h"
#include "shader/decode.h"
#include "shader/effect.h"
#include "shader/normal.h"
#include "shader/pack.h"
#include "shader/position.h"

#define BY_NAME(type, find, get)                                                                                       \
    static inline const type *find(const char *name) {                                                                 \
        for (size_t i = 0; get(i) != NULL; i++)                                                                        \
            if (strcmp(get(i)->name, name) == 0)                                                                       \
                return get(i);                                                                                         \
        return NULL;                                                                                                   \
    }

BY_NAME(preset, preset_find, preset_get)
BY_NAME(platform, platform_find, platform_get)
BY_NAME(bias_api, bias_api_find, bias_api_get)
BY_NAME(method_family_row, method_family_find, method_family_get)
BY_NAME(figure_row, figure_find, figure_get)
BY_NAME(decode_row, decode_find, decode_get)
BY_NAME(effect_row, effect_find, effect_get)
BY_NAME(position_row, position_find, position_get)
BY_NAME(normal_row, normal_find, normal_get)
BY_NAME(pack_row, pack_find, pack_get)
BY_NAME(synthetic_row, synthetic_find, synthetic_get)

#endif
