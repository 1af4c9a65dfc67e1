/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file figure_sheet.h  The numbers of curves that share their places along x, as CSV: a line a place, a column a
 * curve. */
#ifndef PLOT_CMD_PLOT_FIGURE_SHEET_H
#define PLOT_CMD_PLOT_FIGURE_SHEET_H

#include "draw/chart.h"
#include "report/output.h"

/**
 * Whether a chart is so: in each panel all lines and bands have the same x, and what else there is are points, which
 * add lines of their own.
 */
bool figure_sheet_suits(const chart *c);

/** Writes such a chart, as `command` does. */
void figure_sheet_write(output *out, const char *command, const chart *c);

#endif
