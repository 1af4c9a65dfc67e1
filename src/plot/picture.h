/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file picture.h  An image of numbers as a figure: colours, a bar that says what they mean, axes in pixels. */
#ifndef PLOT_PICTURE_H
#define PLOT_PICTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "plot/chart.h"

enum { PICTURE_CHANNELS = 3 };

/** What is shown: `columns` x `rows` fields, row 0 at the top, that stand for width x height pixels. */
typedef struct picture {
    uint32_t width, height;
    int columns, rows;
    int channels;        /**< 1, or 3: directions (unit vectors of view space), or three panels */
    const float *values; /**< channels interleaved; NaN is left empty */
    bool directions;     /**< channels are a direction: one panel in colours */
    bool magnitudes;     /**< errors: a logarithmic colour scale reaches four decades down, and what is less is dark */
    const char *label;   /**< "eye depth", for the colour bar */
    const char *unit;
    const char *const *names; /**< three panels: what each is */
} picture;

/** Fills in an empty chart whose title and subtitle are set. chart_failed() tells of memory. */
void picture_build(const picture *in, chart *out);

#endif
