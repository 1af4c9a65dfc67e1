/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file figure_file.h  A chart drawn into a file, in the size and theme that the options ask for. */
#ifndef PLOT_CMD_PLOT_FIGURE_FILE_H
#define PLOT_CMD_PLOT_FIGURE_FILE_H

#include "cli/output/output.h"
#include "draw/draw.h"
#include "plot/cmd/request.h"

/** The format that the name of a file says, or --type where it does not. @return EXIT_FINE, or EXIT_USAGE after one
 * line
 */
int figure_file_type(const asked_line *line, const figure_asked *f, const char *name, const char *path,
                     canvas_format *out);

/** Is a figure drawn into --output? With --json and --csv only where the name of the file, or --type, is a figure's;
 * the numbers then go to stdout. */
bool figure_file_wanted(const asked_line *line, const output_asked *o);

/** Draws into the file, the argument of an option, whose figure_file_type() is known. @return false without memory */
bool figure_file_write(const asked_line *line, const figure_asked *f, const char *path, const chart *c, int width,
                       int height, output *out);

#endif
