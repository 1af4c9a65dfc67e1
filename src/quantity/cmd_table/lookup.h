/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file lookup.h  table the other way round: the eye depths behind window depths or codes. */
#ifndef QUANTITY_CMD_TABLE_LOOKUP_H
#define QUANTITY_CMD_TABLE_LOOKUP_H

#include "quantity/cmd_table/request.h"

/** Whether --depth or --code asks for it. */
bool lookup_wanted(const table_request *o);

/** Writes them. @return an exit status */
int lookup_write(const table_request *o);

#endif
