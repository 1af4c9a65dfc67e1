/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file setups.h  Checked set-ups in a line: SETUP("unorm24", .znear = 0.5, .zfar = 300, .mapping = DP_MAPPING_GL). */
#ifndef TESTS_SETUPS_H
#define TESTS_SETUPS_H

#include "depthprec/depthprec.h"

/** A checked set-up; planes and log_c that are 0 are the default ones. */
dp_setup setup_with(const char *format, dp_spec spec);
#define SETUP(format, ...) setup_with(format, (dp_spec){__VA_ARGS__})

/** A set-up in another model. */
dp_setup setup_in(const dp_setup *setup, dp_model model);

#endif
