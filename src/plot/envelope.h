/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file envelope.h  Curves that promise: each pixel column shows the certified worst case over all cells that touch
 * it. Nothing is sampled, so no tooth of a float falls between; and refine.h leaves out the columns that a straight
 * line covers.
 */
#ifndef PLOT_ENVELOPE_H
#define PLOT_ENVELOPE_H

#include "method/ways.h"
#include "plot/figure.h"
#include "plot/refine.h"
#include "quantity/quantity.h"

/** The axis of a quantity. */
chart_axis envelope_axis(quantity_kind q);

/**
 * One panel with an axis of depth and that of a quantity of cells, and a curve for each set-up, in their order; to be
 * fitted. Cheaper ways may stand in for the interval: within a quarter of a pixel where the request leaves the
 * tolerance to the picture. Columns that touch a cut cell stay exact.
 */
chart_panel *envelope_curves(const figure_request *request, chart *out, quantity_kind q);

/** The same for one set-up and a slice of depths: the greatest value in it, over whole cells. NaN without cells. */
void envelope_slice(const dp_setup *setup, double from, double to, quantity_kind q, refine_sample *out);

/** A refine_function of slices: the largest separation in each, certified. Its context is the set-up. */
void envelope_separation(const void *setup, double from, double to, refine_sample *out);

/** The cheaper way within the tolerance, where there is one for cells that no plane cuts. */
bool envelope_way(const dp_setup *setup, double tolerance, way *out);

/** Does a plane cut the cell of z? */
bool envelope_is_cut(const dp_setup *setup, double z);

/** Request of a curve of one value along the axes of a panel, at edges; the knots are those of the set-up. */
refine_request envelope_request(const figure_request *request, const dp_setup *setup, chart *out,
                                const chart_panel *panel, refine_function *sample, const void *context);

/** Refines a curve of one value and adds it as the panel's next series; null when out of memory. */
chart_series *envelope_curve(chart *out, chart_panel *panel, const refine_request *request);

/** A finished curve as the panel's next series, `value` of its values; null when out of memory. */
chart_series *envelope_line(chart *out, chart_panel *panel, chart_kind kind, const refine *r, int value);

#endif
