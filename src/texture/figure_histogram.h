/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file figure_histogram.h  Where the depths of an image lie: pixels over eye depth, and how many codes there are. */
#ifndef TEXTURE_FIGURE_HISTOGRAM_H
#define TEXTURE_FIGURE_HISTOGRAM_H

#include "draw/chart.h"
#include "texture/frame.h"

/**
 * Fills in an empty chart whose title and subtitle are set: counts in bins from the nearest depth to the farthest, of
 * equal ratios where these are far apart. Sky and holes are left out.
 * @param codes    whether the image holds codes, which are counted too
 * @param counted  how many pixels have a depth; where none has, the chart stays empty
 * @return false when out of memory; so says chart_failed()
 */
bool histogram_build(const frame *f, bool codes, chart *out, uint64_t *counted);

#endif
