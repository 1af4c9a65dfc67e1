/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file figure_file.h  A chart drawn into a file, in the size and theme that the options ask for. */
#ifndef CLI_FIGURE_FILE_H
#define CLI_FIGURE_FILE_H

#include "cli/options.h"
#include "plot/draw.h"

/** Draws in the format that the name of the file, the argument of an option, ends in. @return false without memory */
bool figure_file_write(const options *o, const char *path, const chart *c, int width, int height, output *out);

#endif
