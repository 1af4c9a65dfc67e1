/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file plot_data.h  The numbers of a figure as JSON or CSV: exactly those that its picture is drawn from. */
#ifndef CLI_PLOT_DATA_H
#define CLI_PLOT_DATA_H

#include "plot/chart.h"
#include "report/output.h"

/**
 * JSON: {"schema":"depthprec/1","command":"plot","figure":NAME, ...,"panels":[{"series":[{"name","points":[...]}]}]}.
 * CSV: one line a point: panel, series, then a column per axis with its unit.
 */
void plot_data_write(output *out, output_form form, const char *figure, const chart *c);

#endif
