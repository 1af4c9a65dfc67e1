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

/**
 * envelope_curves() of the lattice; those of set-ups that have both are thin.
 * @param guaranteed  the label of the axis where there are such, in place of its own
 */
chart_panel *guaranteed_begin(const figure_request *request, chart *out, chart_axis y, const char *guaranteed,
                              envelope_value value, bool interval);

/**
 * The thick curve of set-up i as the panel's next series, in the style of the set-up; the note in the legend says where
 * it ends. Null where the set-up has no such curve, or when out of memory.
 * @param setup  itself, as `sample` takes it; it knows more than `request` where surfaces slant
 */
chart_series *guaranteed_add(const figure_request *request, chart *out, chart_panel *panel, size_t i,
                             const dp_setup *setup, refine_function *sample);

/** Fits the axes. Where a set-up has both, an empty title becomes the given one, and the subtitle says what is thin. */
void guaranteed_end(const figure_request *request, chart *out, const char *title);

#endif
