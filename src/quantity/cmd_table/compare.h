/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file compare.h  Several set-ups on one screen: what each guarantees at a few depths, and how far. */
#ifndef QUANTITY_CMD_TABLE_COMPARE_H
#define QUANTITY_CMD_TABLE_COMPARE_H

#include "camera/cmd/each_setup.h"
#include "quantity/cmd_table/request.h"

/** Whether that is what was asked for: text, more than one set-up, and nothing that only the tables show. */
bool compare_suits(const each_setup *w, const table_request *o);

/** Writes the screen in place of the tables of what each_setup_start() began; frees what each_setup_start() made. */
int compare_write(each_setup *w, const table_request *o);

#endif
