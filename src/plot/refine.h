/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file refine.h  Curves with no more points than a picture can show.
 *
 * The axis of a curve has as many places as the picture has pixel columns. A curve is evaluated at its ends and where
 * it may jump or bend, and then wherever the straight line between two places is not yet within half a pixel of it;
 * never between two neighbouring places. Several values of one place (the bands of a stack) are refined together.
 *
 *     refine_begin(&r, &request, chart);      one for each curve of a panel
 *     refine_share_axis(curves, count);       where they share the axis of value 0
 *     refine_finish(&r);                      r.points places are now known
 *     refine_take(&r, value, x, y);
 */
#ifndef PLOT_REFINE_H
#define PLOT_REFINE_H

#include <stdbool.h>
#include <stddef.h>

#include "draw/chart.h"

enum { REFINE_VALUES = 13, REFINE_KNOTS = 1024 };

/** The values of curves at one place. */
typedef struct refine_sample {
    double y[REFINE_VALUES]; /**< INFINITY and NaN are values like others, to be reached to the column */
    /** How much it may change without a knot from one depth to the next: in units of a linear axis, relatively on a
     *  log one. Where that can be seen a straight line is no evidence, and of a curve that climbs in steps only a level
     *  is; of one that flickers, up and down, nothing is. */
    double step[REFINE_VALUES], flicker[REFINE_VALUES];
} refine_sample;

/** The values at one place: of a slice, or at an edge, where from == to. */
typedef void refine_function(const void *context, double from, double to, refine_sample *out);

typedef struct refine_request {
    chart_scale scale; /**< of the horizontal axis */
    double lo, hi;     /**< its ends */
    int columns, rows; /**< px of the figure, both at least 1: no smaller than its frame */
    /** True: a place is a pixel column and its value the greatest (or least) in it, drawn at the column's middle, so
     *  that the value of several columns bounds theirs. False: a place is an edge between two columns. */
    bool slices;
    bool every; /**< all places are evaluated */
    int values;
    chart_axis axis[REFINE_VALUES]; /**< vertical; lo == hi where it will be fitted to the data */
    const double *knots;            /**< where the curve may jump or bend; those outside [lo, hi] are passed over */
    size_t knot_count;
    refine_function *sample;
    const void *context;
} refine_request;

/** Private to refine.c, but for the points. */
typedef struct refine {
    refine_request request;
    chart *account;
    size_t points; /**< places evaluated */
    int places;
    bool *visited;                    /* memory of the chart, as */
    refine_sample *at;                /* what the curve is at each of them */
    chart_extent seen[REFINE_VALUES]; /* what has been seen of each value */
} refine;

/** Edge i of `count` slices between lo and hi, evenly spaced on the scale; 0 is exactly lo and count exactly hi. */
double refine_edge(chart_scale scale, double lo, double hi, int i, int count);

/** Evaluates the ends and the knots. The chart gives the memory and keeps account. @return false when out of memory */
bool refine_begin(refine *r, const refine_request *request, chart *account);

/** Half a pixel is as much for all of them. */
void refine_share_axis(refine *curves, size_t count);

/** Half a pixel as it is seen so far: a distance on a linear axis, a difference of logarithms on a log one. */
double refine_half_pixel(const refine *r, int value);

void refine_finish(refine *r);

/** Writes r->points points, left to right. */
void refine_take(const refine *r, int value, double *x, double *y);

#endif
