/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file stored.h  Who stores what for depth24plus, a format that leaves the choice to the browser. */
#ifndef CLI_STORED_H
#define CLI_STORED_H

#include "cli/options.h"
#include "report/page.h"

/** The format of that platform for the name that was given with --format; null where it is no such name. */
const char *stored_on(const platform *p, const char *given);

/** A sentence where --format names depth24plus or depth24plus-stencil8 and no platform is named; else nothing. */
void stored_say(page *p, const options *o);

#endif
