/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file named.h  The tables whose rows tests take by name, and the families of methods, which are no table. */
#ifndef TESTS_NAMED_H
#define TESTS_NAMED_H

#include <string.h>

#include "bias/bias.h"
#include "camera/platform.h"
#include "camera/presets.h"
#include "method/method.h"
#include "plot/figure.h"
#include "shader/decode.h"
#include "shader/effect.h"
#include "shader/normal.h"
#include "shader/pack.h"
#include "shader/position.h"
#include "texture/synthetic.h"

static inline const method_family_row *method_family_find(const char *name) {
    for (size_t i = 0; method_family_get(i) != NULL; i++)
        if (strcmp(method_family_get(i)->name, name) == 0)
            return method_family_get(i);
    return NULL;
}

#endif
