/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file figure.h  The figures, one row each. Adding a figure is writing its file and adding its row to figures.c.
 *
 * A figure is a function from set-ups to a chart; it computes with the library alone, the way the table does, and
 * draws nothing. draw.h makes the picture.
 */
#ifndef PLOT_FIGURE_H
#define PLOT_FIGURE_H

#include <stdbool.h>
#include <stddef.h>

#include "depthprec/depthprec.h"
#include "plot/chart.h"

/** A requirement of a set-up and how it was judged, for the figure that shows them. Lengths in scene units. */
typedef struct figure_need {
    const char *name;
    size_t setup;  /**< index into the request's set-ups */
    bool is_error; /**< it limits the error of the stored depth; else the separation */
    bool passed;
    double lo, hi; /**< the range, equal for a single depth; hi may be INFINITY */
    double limit;
    double z; /**< where it is worst */
} figure_need;

/** A cheaper way to the z-fighting interval than the exact cell, handed in: a figure does not know the methods. */
typedef struct figure_way {
    const char *name;
    /** Of a cell that no plane cuts, scene units. */
    double (*interval)(const void *context, const dp_setup *setup, double z);
    const void *context;
} figure_way;

/** What a census found of one set-up: the longest interval of each band, at its nearer depth. */
typedef struct figure_census {
    size_t count;
    const double *z, *longest; /**< scene units */
} figure_census;

/** What is asked for. */
typedef struct figure_request {
    const dp_setup *setups; /**< at least one; all with the same planes and projection */
    size_t count;
    const char *const *names; /**< "unorm24 d3d" of each, for legends */
    double lo, hi;            /**< eye depths to show; both NaN when the user left it to the figure */
    double at;                /**< a single depth for the figures that take one, else NaN */
    dp_budget_terms terms;    /**< what is added to the pipeline, for the figures that take it */
    const figure_need *needs; /**< for the figures that take them */
    size_t need_count;
    const struct figure_methods *methods; /**< for the figures that show methods, else null */
    const struct figure_normals *normals; /**< for the figure that shows them, else null */
    /** Finds a way whose relative error is within the tolerance; false where there is none. May be null: none. */
    bool (*find_way)(const dp_setup *setup, double tolerance, figure_way *out);
    double tolerance;            /**< for the ways; 0 for none; NaN for what the picture cannot show */
    const figure_census *census; /**< one for each set-up, or null */
    int columns, rows;           /**< how finely to compute: pixels of the figure; see refine.h */
} figure_request;

/** Methods of one family, measured: what the figures pareto and stability show. */
typedef struct figure_methods {
    const char *measure; /**< "relative error" */
    size_t count;
    const char *const *names;
    const double *ns;     /**< pareto: time an element */
    const double *errors; /**< pareto: a worst error each; stability: `steps` each, for the far/near of `ratios` */
    const int *group;     /**< pareto: methods of one group (0 or 1) answer the same question and share a front */
    const bool *front;    /**< pareto: no other is both faster and more exact */
    size_t steps;
    const double *ratios;  /**< stability: evenly spaced on a log axis */
    const double *claimed; /**< stability: the far/near up to which a claim is made; NaN for none */
    const double *breaks;  /**< stability: the far/near from which on it does not hold; INFINITY for none */
} figure_methods;

/** How far normals from depth are off, measured when asked: what the figure normals shows. */
typedef struct figure_normals {
    size_t surface_count, method_count;
    const char *const *surfaces; /**< "plane at 60 degrees", ... */
    const char *const *methods;
    const char *bound; /**< the name of what bounds a method on surface 0 */
    /** Degrees, for a surface at depth z; method_count stands for the bound. NaN where nothing was measured. */
    double (*error)(const dp_setup *setup, size_t surface, size_t method, double z);
} figure_normals;

/** What a figure can make something of. */
enum {
    FIGURE_AT = 1 << 0,      /**< one depth, given with --at */
    FIGURE_TERMS = 1 << 1,   /**< --interpolation, --world, --linearize */
    FIGURE_FP32 = 1 << 2,    /**< set-ups of the model fp32, which have no cells */
    FIGURE_NEEDS = 1 << 4,   /**< a requirement file, which brings its own set-ups, with planes of their own */
    FIGURE_PARETO = 1 << 5,  /**< methods and their times */
    FIGURE_WALK = 1 << 6,    /**< methods walked over far/near */
    FIGURE_NORMALS = 1 << 7, /**< normals from depth */
    FIGURE_WAYS = 1 << 8,    /**< other ways to the interval than the exact cell */
    FIGURE_CENSUS = 1 << 9,  /**< a census of each set-up of the model fp32 */
    FIGURE_METHODS = FIGURE_PARETO | FIGURE_WALK,
    FIGURE_BINARY32 = 1 << 3, /**< nothing but set-ups of the model fp32, whatever --model says */
};

typedef struct figure_row {
    const char *name;
    const char *title;
    const char *summary; /**< one line for `depthprec list figures` */
    size_t setups_max;   /**< most set-ups that stay legible */
    unsigned takes;      /**< FIGURE_... bits */
    /**
     * Fills in an empty chart whose subtitle is set; an empty title is replaced by the row's when left empty.
     * @return null, or a sentence about what of the request cannot be drawn; chart_failed() tells of memory
     */
    const char *(*build)(const figure_request *request, chart *out);
} figure_row;

/** Figures by index; null beyond the last. */
const figure_row *figure_get(size_t index);

/** The figure of a name; null when there is none. */
const figure_row *figure_find(const char *name);

/** Colour, stroke and marker of set-up i: the format decides the colour and the marker, the mapping the stroke;
 *  where all share the one or the other, each set-up has its own of all three. */
chart_style figure_style(const figure_request *request, size_t i);

/** The range of a curve: what was asked, or near to far; to 1e6 near when far is infinite. */
void figure_range(const figure_request *request, double *lo, double *hi);

/** The usual horizontal axis, eye depth. */
chart_axis figure_depth_axis(chart_scale scale, double lo, double hi);

const char *distribution_build(const figure_request *request, chart *out);
const char *share_build(const figure_request *request, chart *out);
const char *error_build(const figure_request *request, chart *out);
const char *interval_build(const figure_request *request, chart *out);
const char *budget_build(const figure_request *request, chart *out);
const char *scene_build(const figure_request *request, chart *out);
const char *map_build(const figure_request *request, chart *out);
const char *pareto_build(const figure_request *request, chart *out);
const char *stability_build(const figure_request *request, chart *out);
const char *normals_build(const figure_request *request, chart *out);

#endif
