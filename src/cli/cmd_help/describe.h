/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file describe.h  What help says of an option, for who shows it elsewhere. */
#ifndef CLI_HELP_DESCRIBE_H
#define CLI_HELP_DESCRIBE_H

#include "cli/option/option.h"

enum { DESCRIPTION_SIZE = 1024 };

/** "what it does (LEAST to MOST UNIT; default D: what that means)". @return out */
const char *option_describe(const option_taken *use, char out[DESCRIPTION_SIZE]);

#endif
