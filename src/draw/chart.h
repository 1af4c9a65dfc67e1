/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file chart.h  What a figure shows, as numbers and words, before anything is drawn.
 *
 * A figure is computed into a chart; from the chart it is drawn, listed as CSV or JSON, and digested: so the numbers
 * a test compares are the very numbers that reach the picture. Memory belongs to the chart and is freed with it; when
 * it runs out, the chart remembers and chart_failed() tells, so builders need not check each step.
 */
#ifndef DRAW_CHART_H
#define DRAW_CHART_H

#include <stdbool.h>
#include <stddef.h>

enum { CHART_TEXT = 192, CHART_SETUPS = 32, CHART_SERIES = 2 * CHART_SETUPS, CHART_PANELS = 8 };

typedef enum chart_scale {
    CHART_LINEAR = 0,
    CHART_LOG,
    CHART_DOWN /**< linear, growing downwards: rows of an image; lo and hi are never fitted */
} chart_scale;

typedef struct chart_extent {
    double lo, hi;
} chart_extent;

/** One direction of a panel. */
typedef struct chart_axis {
    chart_scale scale;
    double lo, hi;     /**< finite, lo < hi, both above 0 on a log axis; lo == hi asks for the extent of the data */
    const char *label; /**< "z-fighting interval" */
    const char *key;   /**< the column's name in CSV and JSON, "interval" */
    const char *unit;  /**< "scene units", "%"; "" for a pure number; see chart_unit() */
    /** Null, or what the numbers 0, 1, ... below hi stand for: a tick with that name half a step above each. */
    const char *const *names;
} chart_axis;

/** How a series is drawn; the index of its row in series.c. */
typedef enum chart_kind {
    CHART_LINE = 0, /**< through the points; y = INFINITY ends it with an arrow to the top, NaN interrupts it */
    CHART_DROPS,    /**< each point joined to both axes: the codes of a small format */
    CHART_LEVELS,   /**< broad lines below all others, each from one point to the next of equal y */
    CHART_BARS,     /**< from each point to the next of equal x, which has a cross stroke wider than a marker */
    CHART_SPANS,    /**< thin lines, each from one point to the next of equal y */
    CHART_POINTS,   /**< markers; their labels where given, each where it is free of points, lines and other labels */
    CHART_AREA,     /**< a band as thick as y, standing on the bands before it; its name is written into it */
    CHART_KIND_COUNT
} chart_kind;

/** Indices into the theme: see theme_pen() and theme_marker(). */
typedef struct chart_style {
    int colour; /**< -1 is the colour of the text */
    int stroke;
    int marker; /**< -1 for none */
    bool thin;  /**< a line in the background; points that stand close */
} chart_style;

typedef struct chart_series {
    chart_kind kind;
    chart_style style;
    char name[CHART_TEXT]; /**< for the data, and for the legend unless `unlisted` */
    char note[64];         /**< follows the name in the legend only */
    bool unlisted;
    bool behind;        /**< of points: under the lines, which stay visible where they run through one */
    const char *method; /**< what it was computed by where that is not the exact engine; else null */
    bool second;        /**< CHART_LINE: y is measured on the panel's second axis */
    double certain_to;  /**< CHART_LINE: x where it ends, with a bar: beyond, nothing is certain; NaN: it does not */
    size_t count;
    double *x, *y;
    double *said; /**< null, or what the data have in place of y, which is then no more than a place in the picture */
    char (*labels)[CHART_TEXT]; /**< CHART_POINTS: a label each, or null */
    bool unwritten;             /**< the labels are for the data alone */
} chart_series;

/** Numbers of a grid that are made, a row at a time, when they are wanted: of large ones, so that no copy is held. */
typedef struct chart_rows {
    void (*make)(const void *of, int channel, int row, double *out); /**< null: there are none */
    const void *of;
    int channel;
} chart_rows;

/** A grid of values, colour-coded: value[row * columns + column], row 0 at the bottom. NaN is left empty. */
typedef struct chart_map {
    int columns, rows;
    double *x, *y; /**< centres, evenly spaced on the panel's axes */
    double *value;
    double *under; /**< null, or of as many fields what shows in grey where there is no value; NaN is left empty */
    chart_rows values, grounds; /**< in place of `value` and `under` where those are null */
    double *room;               /**< for a row of them */
    const char *const *names; /**< null, or a name for each column, which then is a series of its own in the numbers */
    size_t by_way;            /**< how many were computed by another way than the exact engine */
} chart_map;

typedef struct chart_panel {
    char title[CHART_TEXT]; /**< "" when the chart has one panel */
    chart_axis x, y;
    chart_axis second; /**< on the right; label is null when there is none. All panels have one, or none has */
    size_t series_count;
    chart_series series[CHART_SERIES];
    chart_map map; /**< columns is 0 when there is none */
} chart_panel;

typedef struct chart {
    char title[CHART_TEXT];
    char subtitle[2 * CHART_TEXT]; /**< what holds for all of it: planes, projection, model */
    const char *unit;              /**< "m": what a scene unit is; null where nothing says it */
    size_t panel_count;
    chart_panel panels[CHART_PANELS];
    chart_axis value;   /**< the colour scale shared by the maps; label is null when there is none */
    chart_axis ground;  /**< the grey scale of what lies under a map: lo is light */
    bool contours;      /**< lines at the decades of the maps */
    size_t curves;      /**< how many were refined, */
    size_t evaluations; /**< how often something was computed for them, */
    size_t places;      /**< and how often it would have been with one point a pixel column: see refine.h */
    double shape;       /**< width over height that the panels keep, stacked ones together; 0: they fill the page */
    bool colours;       /**< the values of the maps are 0xRRGGBB; directions, see heat.h */
    bool grey;          /**< the values of the maps go from black to white */
    bool stacked;       /**< panels lie below each other and share x; each has a y of its own, on one scale */
    bool bare;          /**< a field without a value shows the page, not a hatch */
    bool apart;         /**< panels have axes of their own, of which each shows its numbers; not stacked */
    bool classes;       /**< they are indices of the panel's series, areas, whose tints they have; no colour bar */
} chart;

/** An empty chart; null when out of memory. */
chart *chart_new(void);
void chart_free(chart *c);

/** Marks a chart that cannot be what it should be: memory or room ran out. Null counts as failed. */
void chart_fail(chart *c);
bool chart_failed(const chart *c);

/** A block that lives as long as the chart, zeroed; null when out of memory. */
void *chart_memory(chart *c, size_t count, size_t size);

/** The next panel, empty; there are fewer than CHART_PANELS. */
chart_panel *chart_add_panel(chart *c);

/** The panel's next series, empty; null when the room or the memory is used up. */
chart_series *chart_add_series(chart *c, chart_panel *panel, chart_kind kind, size_t count);

/** Fits every axis with lo == hi to the finite data, the same axis in all panels alike. */
void chart_fit(chart *c);

/** Puts the curves of another chart of one panel on that of this one, on axes that hold both: each name begins with A
 *  or B, B in the colours behind the first `styles`. A scene unit of the other is `unit` of this one's.
 *  @return false: they show different things */
bool chart_join(chart *c, const chart *other, int styles, double unit);

/** A map of columns x rows, centred on the panel's axes (which must be set); false when out of memory. */
bool chart_add_map(chart *c, chart_panel *panel, int columns, int rows);

/** The same, of values that are made when they are wanted. */
bool chart_add_rows(chart *c, chart_panel *panel, int columns, int rows, chart_rows values);

/** A row of a map's values, and of what is under them, null where nothing is; `room` is for one row. */
const double *chart_value_row(const chart_map *m, int row, double *room);
const double *chart_under_row(const chart_map *m, int row, double *room);

/** The field of a map in row i, column k, whose values are held. */
static inline double *chart_field(const chart_map *m, int i, int k) {
    return &m->value[(size_t)i * (size_t)m->columns + (size_t)k];
}

/** The value at share t (0..1) of an axis. */
double chart_axis_at(const chart_axis *axis, double t);

/** The share of a value: 0 at lo, 1 at hi; infinite values keep their sign. */
double chart_axis_share(const chart_axis *axis, double value);

/** The unit that is written beside an axis: with "m" in place of "scene units" where the chart says what one is. */
const char *chart_unit(const chart *c, const chart_axis *axis, char out[CHART_TEXT]);

/** 64 bits (FNV-1a, "0123456789abcdef") over every name and every number to 30 bits: the same when the figures say so.
 */
void chart_digest(const chart *c, char out[17]);

#endif
