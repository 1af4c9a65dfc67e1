/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file plot_data.h  The numbers of a figure as JSON or CSV: exactly those that its picture is drawn from. */
#ifndef CLI_PLOT_DATA_H
#define CLI_PLOT_DATA_H

#include "plot/chart.h"
#include "report/output.h"

/** {"schema":"depthprec/1","command":"plot","figure":NAME, ...,"panels":[{"series":[{"name","points":[...]}]}]} */
void plot_data_json(output *out, const char *figure, const chart *c);

/** One line a point: panel, series, then a column per axis with its unit. */
void plot_data_csv(output *out, const chart *c);

#endif
