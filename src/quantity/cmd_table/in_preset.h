/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file in_preset.h  table in the terms of an engine: from which zoom of a map on a separation is resolved. */
#ifndef QUANTITY_CMD_TABLE_IN_PRESET_H
#define QUANTITY_CMD_TABLE_IN_PRESET_H

#include "quantity/cmd/resolved.h"
#include "quantity/cmd_table/request.h"

enum { IN_PRESET_SIZE = 384 };

typedef struct in_preset {
    const char
        *parameter; /**< "zoom"; null: the camera is of no preset that asks for one, or says not where it looks */
    double from[RESOLVED_LIMITS], to[RESOLVED_LIMITS]; /**< NaN where none keeps that separation */
    char text[IN_PRESET_SIZE];                         /**< "1 cm from zoom 16.9 on, ..."; "" where none keeps any */
} in_preset;

/** The numbers that keep each separation of resolved.h where the preset looks. */
void in_preset_find(const table_request *o, in_preset *out);

#endif
