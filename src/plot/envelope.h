/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file envelope.h  Curves that promise: the range of depths is cut into slices as fine as the picture, and each slice
 * shows the certified worst case over all cells that touch it. Nothing is sampled, so no tooth of a float falls
 * between.
 */
#ifndef PLOT_ENVELOPE_H
#define PLOT_ENVELOPE_H

#include "depthprec/depthprec.h"
#include "plot/chart.h"
#include "plot/figure.h"

/** What a curve takes from the worst case of a slice. */
typedef double (*envelope_value)(const dp_worst *worst);

/** Edge i of `count` slices between lo and hi, evenly spaced on the scale; 0 is exactly lo and count exactly hi. */
double envelope_edge(chart_scale scale, double lo, double hi, int i, int count);

/** One panel with an axis of depth and the given one, and a curve for each set-up, in their order; to be fitted. */
chart_panel *envelope_curves(const figure_request *request, chart *out, chart_axis y, envelope_value value);

/** The same, fitted: a whole figure. */
void envelope_build(const figure_request *request, chart *out, chart_axis y, envelope_value value);

#endif
