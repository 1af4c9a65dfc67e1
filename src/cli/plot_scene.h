/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file plot_scene.h  The figure of a requirement file: its cameras and verdicts made into a request. */
#ifndef CLI_PLOT_SCENE_H
#define CLI_PLOT_SCENE_H

#include "cli/options.h"
#include "plot/figure.h"

/** Reads and judges the file named by the second operand and hands the request to `write`. @return exit status */
int plot_scene(const options *o, const figure_row *row,
               int (*write)(const options *o, const figure_row *row, const figure_request *request, chart *c));

#endif
