/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file option_bias.h  The parsers of --preset and of the options of bias, for the option table. */
#ifndef CLI_OPTION_BIAS_H
#define CLI_OPTION_BIAS_H

#include "cli/options.h"

/* Each reads the argument of its option. EXIT_FINE, or EXIT_USAGE after one line on stderr. */
int parse_preset(options *o, const char *value);
int parse_api(options *o, const char *value);
int parse_units(options *o, const char *value);
int parse_factor(options *o, const char *value);
int parse_clamp(options *o, const char *value);
int parse_slope(options *o, const char *value);

#endif
