/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file levels.h  table of a sensor's levels: how far apart depths are that it tells apart. */
#ifndef QUANTITY_CMD_TABLE_LEVELS_H
#define QUANTITY_CMD_TABLE_LEVELS_H

#include "quantity/cmd_table/request.h"

/** Whether --lattice asks for it. */
bool levels_wanted(const table_request *o);

/** Writes them. @return an exit status */
int levels_write(const table_request *o);

#endif
