/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file given.h  What engines' own numbers are worth in the maps of a command line. */
#ifndef SHADOW_CMD_SHADOW_GIVEN_H
#define SHADOW_CMD_SHADOW_GIVEN_H

#include "report/report.h"
#include "shadow/cmd_shadow/maps.h"
#include "shadow/engine.h"

/** One engine in all maps of a set-up. */
typedef struct shadow_engine_row {
    const char *engine, *bias_name, *normal_name, *unconfirmed;
    double bias, normal;             /**< given, or the same as what is given of the first; NaN: it has none */
    double free, acne, gap;          /**< as shadow_verdict has them, of the worst map; free NaN where it is -1 */
    double least_bias, least_normal; /**< that are enough beside the other one; NaN: none is */
    bool enough;
} shadow_engine_row;

/** The engine of that index among those that are asked for; false behind the last. */
bool shadow_engine_row_of(const shadow_request *o, const shadow_maps *maps, size_t index, shadow_engine_row *out);

/** Says of the first whether it is enough. */
void shadow_say_given(page *p, const shadow_request *o, const shadow_maps *maps);

extern const column shadow_engine_columns[];

#endif
