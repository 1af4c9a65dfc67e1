/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file figure_data.h  The numbers of a figure as JSON or CSV. */
#ifndef PLOT_CMD_PLOT_FIGURE_DATA_H
#define PLOT_CMD_PLOT_FIGURE_DATA_H

#include "draw/chart.h"
#include "report/output.h"

/** All points of all panels, as `command` writes them; CSV has a column a curve where figure_sheet_suits(). @param
 *  form  not that of text */
void figure_data_write(output *out, output_form form, const char *command, const char *figure, const chart *c);

#endif
