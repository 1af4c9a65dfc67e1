/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file constants.h  table --constants: what shaders are given of a camera, make of depths, and read by wrong
 * formulas. */
#ifndef QUANTITY_CMD_TABLE_CONSTANTS_H
#define QUANTITY_CMD_TABLE_CONSTANTS_H

#include "quantity/cmd_table/request.h"

/** Writes them. @return an exit status */
int constants_write(const table_request *o);

#endif
