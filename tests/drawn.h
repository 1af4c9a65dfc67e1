/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file drawn.h  A drawn figure as a reader sees it: panels whose axes have the scale that their ticks and labels say,
 * a legend of words beside swatches, captions, curves and markers. Nothing of it comes from the program's own numbers.
 *
 * What does not look as a figure should (a major tick without its label, a word that is no label of anything) fails
 * the test while reading, or in drawn_close().
 */
#ifndef TESTS_DRAWN_H
#define TESTS_DRAWN_H

#include "draw/chart.h"
#include "draw/draw.h"
#include "svg.h"

enum { DRAWN_LABELS = 64, DRAWN_ENTRIES = 40, DRAWN_PANELS = 8, DRAWN_LINES = 8 };

/** The kind that a mark was recognised as, in svg_mark.used. */
enum { DRAWN_NEW = 0, DRAWN_PAGE, DRAWN_AXIS, DRAWN_LEGEND, DRAWN_DATA };

/** The colours that a theme promises. */
typedef struct drawn_theme {
    uint32_t background, text, faint, frame, grid, empty;
    uint32_t palette[8];
    double line; /**< width of a curve, px */
    const char *name;
} drawn_theme;
extern const drawn_theme drawn_light, drawn_dark, drawn_print;

/** px = a + b v, or a + b log10(v). */
typedef struct drawn_scale {
    bool log;
    double a, b;
    int ticks, labels;
    double tick[128];                 /**< px of every tick, */
    bool major[128];                  /**< and whether it is a long one */
    const svg_mark *at[DRAWN_LABELS]; /**< the labels, */
    double px[DRAWN_LABELS];          /**< and the ticks that they name */
} drawn_scale;

typedef struct drawn_panel {
    svg_box frame;
    char heading[SVG_TEXT]; /**< "" without; its lines joined */
    drawn_scale x, y, second;
} drawn_panel;

typedef enum drawn_shape {
    DRAWN_NONE = 0,
    DRAWN_DISC,
    DRAWN_SQUARE,
    DRAWN_DIAMOND,
    DRAWN_TRIANGLE,
    DRAWN_TRIANGLE_DOWN,
    DRAWN_HEXAGON,
    DRAWN_ARROW, /**< a triangle without a rim, its tip on top */
} drawn_shape;

/** A marker, or an arrow with (x, y) its tip. */
typedef struct drawn_marker {
    drawn_shape shape;
    double x, y, width;
    uint32_t inside, rim;
} drawn_marker;

/** A line of the legend. */
typedef struct drawn_entry {
    const svg_mark *words;
    const char *text;     /**< what they say */
    const svg_mark *line; /**< the stroke of the swatch, or null */
    const svg_mark *area; /**< a filled rectangle, or null */
    int lines;            /**< how many strokes */
    drawn_marker marker;  /**< DRAWN_NONE without */
    double y;             /**< of the middle of the words */
    double x;             /**< where they begin */
} drawn_entry;

typedef struct drawn {
    svg *svg;
    double scale;
    const drawn_theme *theme;
    char title[SVG_TEXT], subtitle[2 * SVG_TEXT];
    double title_y, subtitle_y;                            /**< of their last baselines */
    const svg_mark *x_caption, *y_caption, *right_caption; /**< the last is that of a second axis or a colour bar */
    size_t panel_count, entry_count;
    drawn_panel panels[DRAWN_PANELS]; /**< as they are read: line by line */
    drawn_entry entries[DRAWN_ENTRIES];
    const svg_mark *bar; /**< the colours of the bar, or null */
    drawn_scale value;   /**< and its scale */
} drawn;

/** Draws with the built program, `depthprec ARGUMENTS`, and reads. Figures of 800 x 500 px or what they are; of
 *  texture that of --figure, or that of --histogram where it is the last argument. */
drawn *drawn_run(const drawn_theme *look, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** A chart of the test's own, with one panel whose axes begin at 0. */
chart *drawn_sketch(double x_to, double y_to);

/** Draws a chart of the test's own and reads; it keeps the chart. */
drawn *drawn_chart(const drawn_theme *look, chart *c, int width, int height);

/** Checks that every word has been recognised, and frees. */
void drawn_close(drawn *d);

/** The output of `depthprec ARGUMENTS`, which must exit 0; free() it. */
char *drawn_output(const char *format, ...) __attribute__((format(printf, 1, 2)));

/** A folder of the test's own, removed when the program ends. */
const char *drawn_folder(void);

/** Where a value lies, and what lies there. */
double drawn_px(const drawn_scale *s, double value);
double drawn_at(const drawn_scale *s, double px);

/** The number that a label means: "0.01", "10" with a raised exponent, "2", a dot and "10" with one. */
double drawn_number(const char *text);

/** The entry whose words begin so; fails the test when there is none. */
const drawn_entry *drawn_legend(const drawn *d, const char *text);

/** Every entry in its place in the order given, and no other. */
void drawn_legend_is(const drawn *d, size_t count, const char *const *texts);

/** The strokes within a panel drawn with the pen of another mark; at most `room`. @return how many */
size_t drawn_strokes(const drawn *d, const drawn_panel *p, const svg_mark *pen, const svg_mark **out, size_t room);

/** The one stroke with the pen of the swatch. */
const svg_mark *drawn_curve(const drawn *d, const drawn_panel *p, const drawn_entry *e);

/** Range of heights, px, that a line has between two x. @return false when it is not there */
bool drawn_reach(const svg_mark *line, double x0, double x1, double *top, double *bottom);

/** The markers on a panel and up to 10 px beside it. @return how many */
size_t drawn_markers(const drawn *d, const drawn_panel *p, drawn_marker *out, size_t room);
bool drawn_alike(const drawn_marker *a, const drawn_marker *b); /**< in shape and colours */

/** Fails unless a swatch has colour `colour` of the palette (-1: that of the text), dashes `stroke` of the theme and
 * the marker, hollow where the stroke is odd; a thin one is half as wide. */
void drawn_style_is(const drawn *d, const drawn_entry *e, int colour, int stroke, drawn_shape marker, bool thin);

/** Fails unless the description for screen readers is title, subtitle and then these words. */
void drawn_description_is(const drawn *d, const char *shown);

/** Every marker on the panel that looks like the entry's lies on its curve, and there are some, evenly spaced. */
void drawn_markers_on(const drawn *d, const drawn_panel *p, const drawn_entry *e, const svg_mark *curve);

/** The values that a curve should have over the depths of a slice: its least and its greatest. false: nothing is to be
 * there */
typedef bool (*drawn_truth)(const void *context, double from, double to, double *lo, double *hi);

/** Fails unless a line shows the truth at `places` places of its panel, within `slack` px. */
void drawn_follows(const drawn_panel *p, const drawn_scale *y, const svg_mark *line, drawn_truth truth,
                   const void *context, int places, double slack);

/** The name of a point: beside it, or a little away with a thin line to it; fails the test when there is none. */
const svg_mark *drawn_label(const drawn *d, const drawn_panel *p, svg_point at, const char *name);

/** Words within a panel, as such consumed; null when there are none such. */
const svg_mark *drawn_words(const drawn *d, svg_box within, const char *text);

#define assert_px(got, want, slack) drawn_px_at((got), (want), (slack), #got, __FILE__, __LINE__)
void drawn_px_at(double got, double want, double slack, const char *what, const char *file, int line);

#endif
