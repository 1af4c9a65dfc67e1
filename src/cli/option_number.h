/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file option_number.h  The parsers of options that take a single number, for the option table. */
#ifndef CLI_OPTION_NUMBER_H
#define CLI_OPTION_NUMBER_H

#include "cli/options.h"

/* Each reads the argument of its option. EXIT_FINE, or EXIT_USAGE after one line on stderr. */
int parse_near(options *o, const char *value);
int parse_far(options *o, const char *value);
int parse_log_c(options *o, const char *value);
int parse_separation(options *o, const char *value);
int parse_error(options *o, const char *value);
int parse_tolerance(options *o, const char *value);
int parse_interpolation(options *o, const char *value);
int parse_world(options *o, const char *value);
int parse_gap(options *o, const char *value);
int parse_sample(options *o, const char *value);
int parse_seed(options *o, const char *value);
int parse_threads(options *o, const char *value);
int parse_width(options *o, const char *value);
int parse_height(options *o, const char *value);

#endif
