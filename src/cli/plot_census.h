/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file plot_census.h  What a census finds of the set-ups of a figure, as the points that the figure shows. */
#ifndef CLI_PLOT_CENSUS_H
#define CLI_PLOT_CENSUS_H

#include "cli/setups.h"
#include "plot/figure.h"

/** Most depths that a figure waits for, about a quarter of a second a set-up; and most set-ups: three lines each. */
#define PLOT_CENSUS_DEPTHS_MAX (1u << 28)
enum { PLOT_CENSUS_SETUPS_MAX = CHART_SERIES / 3 };

typedef struct plot_census {
    figure_census *shown; /**< one for each set-up, empty for those without; null: none of them has one */
    void *memory;
} plot_census;

/**
 * A census of every set-up of the model fp32 over the range of the figure, when its depths are few enough.
 * @return EXIT_FINE or, after one line on stderr, EXIT_IO
 */
int plot_census_make(const setups *all, const figure_request *request, plot_census *out);
void plot_census_free(plot_census *c);

#endif
