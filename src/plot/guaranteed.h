/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file guaranteed.h  Curves of what is guaranteed, thick, over those of the lattice, thin. Which set-ups have both:
 * all where the request says so, else those of the model float.
 */
#ifndef PLOT_GUARANTEED_H
#define PLOT_GUARANTEED_H

#include "plot/envelope.h"

/** Whether set-up i has both curves. */
bool guaranteed_has(const figure_request *request, size_t i);

/** envelope_curves() of the lattice; those of set-ups that have both are thin. */
chart_panel *guaranteed_begin(const figure_request *request, chart *out, quantity_kind q);

/** A separation at a depth. */
typedef double guaranteed_function(const void *of, double z);

/**
 * The farthest depth along the axis of a curve behind which something is certain up to far: a separation is left there.
 * Just before the axis begins where none is; NaN where the curve need not end, as it is so up to its last column, or
 * far is infinite.
 */
double guaranteed_certain_to(const refine_request *q, const dp_setup *setup, guaranteed_function *separation,
                             const void *of);

/** The separation of a set-up as the panel's next series, to where nothing behind is certain. Null when out of memory.
 *  @param q  of envelope_request(); afterwards as it was asked */
chart_series *guaranteed_separation(chart *out, chart_panel *panel, refine_request *q, const dp_setup *setup);

/**
 * The thick curve of set-up i as the panel's next series, in the style of the set-up; the note in the legend says where
 * it ends. Null where the set-up has no such curve, or when out of memory.
 * @param setup  itself, as `error` takes it; it knows more than `request` where surfaces slant
 * @param error  the curve's samples; null: it is guaranteed_separation()
 */
chart_series *guaranteed_add(const figure_request *request, chart *out, chart_panel *panel, size_t i,
                             const dp_setup *setup, refine_function *error);

/** Fits the axes. Where a set-up has both, an empty title becomes the given one, and the subtitle says what is thin. */
void guaranteed_end(const figure_request *request, chart *out, const char *title);

#endif
