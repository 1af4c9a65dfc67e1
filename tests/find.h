/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file find.h  Rows by name, null when there is none: those of the APIs and presets as the command line finds them.
 */
#ifndef TESTS_FIND_H
#define TESTS_FIND_H

#include <string.h>

#include "api/bias.h"
#include "api/presets.h"
#include "cli/names.h"
#include "method/method.h"
#include "texture/effect.h"
#include "texture/pack.h"
#include "texture/scene.h"

#define FIND(ROW, NOUN)                                                                                                \
    static inline const ROW *NOUN##_find(const char *name) {                                                           \
        size_t i = 0;                                                                                                  \
        while (NOUN##_get(i) != NULL && strcmp(NOUN##_get(i)->name, name) != 0)                                        \
            i++;                                                                                                       \
        return NOUN##_get(i);                                                                                          \
    }
FIND(method_family_row, method_family)
FIND(decode_row, decode)
FIND(position_row, position)
FIND(normal_row, normal)
FIND(effect_row, effect)
FIND(pack_row, pack)
FIND(scene_row, scene)

#define FIND_LISTED(ROW, NOUN, LIST)                                                                                   \
    static inline const ROW *NOUN##_find(const char *name) {                                                           \
        size_t i;                                                                                                      \
        return names_find(&(name_list){.get = (LIST)}, name, &i, NULL) ? NOUN##_get(i) : NULL;                         \
    }
FIND_LISTED(bias_api, bias_api, list_api)
FIND_LISTED(preset, preset, list_preset)

#endif
