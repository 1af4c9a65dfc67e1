/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file families.h  methods without a family: which method of each to use. */
#ifndef METHOD_CMD_METHODS_FAMILIES_H
#define METHOD_CMD_METHODS_FAMILIES_H

#include "judge/cmd_judge/request.h"

/** Measures the methods of all families, writes the report and closes the output. @return an exit status */
int families_write(const judge_request *o, output *out);

#endif
