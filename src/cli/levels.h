/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file levels.h  table of a sensor's levels: how far apart depths are that it tells apart. */
#ifndef CLI_LEVELS_H
#define CLI_LEVELS_H

#include "cli/table/request.h"

/** Whether --lattice asks for it. */
bool levels_wanted(const table_request *o);

/** Writes them. @return an exit status */
int levels_write(const table_request *o);

#endif
