/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file figure_picture.h  An image of numbers as a figure: colours, a bar that says what they mean, axes in pixels. */
#ifndef TEXTURE_FIGURE_PICTURE_H
#define TEXTURE_FIGURE_PICTURE_H

#include <stdbool.h>
#include <stdint.h>

#include "draw/chart.h"

/** An image of width x height pixels, and the smaller one that stands for it: row 0 at the top. */
typedef struct picture {
    uint32_t width, height;
    int channels;      /**< 1, or 3: directions (unit vectors of view space), or three panels */
    bool directions;   /**< channels are a direction: one panel in colours */
    bool magnitudes;   /**< errors: a field is the largest of its pixels and not the one in its middle; a
                            logarithmic colour scale reaches four decades down, and what is less is dark */
    double above;      /**< with `magnitudes`: what is not above it is left out, and the colour scale begins there */
    bool shares;       /**< from 0 to 1 by nature: so is the colour scale, whatever part of it there is */
    bool grey;         /**< black to white, as a screen shows a depth texture */
    const char *label; /**< "eye depth", for the colour bar */
    const char *unit;
    const char *const *names; /**< several panels: what each is */

    int columns, rows; /**< of fields; set by picture_open(), as the rest */
    float *values;     /**< channels interleaved; NaN is left empty */
    uint64_t missing;  /**< pixels without a value that were taken: holes, sky, and what has too few neighbours */
} picture;

/** Fields for at most `most` in either direction; memory of the chart. @return false when that ran out */
bool picture_open(picture *p, int most, chart *memory);

/** Takes `count` rows of pixels from `row` on, each row once. */
void picture_take(picture *p, uint32_t row, uint32_t count, const float *values);

/** Marks places of the built chart, px from the left and upper edge, under a name for the legend. */
void picture_mark(chart *out, size_t count, const double (*at)[2], const char *name);

/** Shows another picture of one channel, of the same size, in grey under the built chart, where that has no value. */
void picture_lay_under(const picture *ground, chart *out);

/** Shows another picture of one channel, of the same size and scale, beside the built chart, under a title. */
void picture_put_beside(const picture *other, const char *title, chart *out);

/** Fills in an empty chart whose title and subtitle are set; the chart reads the picture. chart_failed() tells of
 * memory. */
void picture_build(const picture *in, chart *out);

#endif
