/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file figure.h  The figures, one row each. A new one is a file, its function below, and its row in figures.c.
 *
 * A figure measures what it shows, the way the commands do, and fills a chart; draw.h makes the picture.
 */
#ifndef PLOT_FIGURE_H
#define PLOT_FIGURE_H

#include <stdbool.h>
#include <stddef.h>

#include "core/named.h"
#include "depthprec/depthprec.h"
#include "draw/chart.h"
#include "method/bench.h"
#include "method/stability.h"
#include "raster/raster.h"

/** The data and options that a figure is drawn from. */
typedef struct figure_request {
    const dp_setup *setups; /**< all with the same planes and projection; at least one, but for figures of a file or of
                               shadow maps */
    size_t count;
    const char *const *names; /**< "unorm24 d3d" of each, for legends */
    bool guaranteed;          /**< the set-ups are those of dp_setup_guaranteed(), over their lattice */
    bool every;               /**< curves have a point in every pixel column, so that they share them */
    double lo, hi;            /**< eye depths to show; both NaN when the user left it to the figure */
    const double *fars;       /**< the far planes of a figure that shows several; none: that of the set-ups */
    size_t far_count;
    double at;                         /**< a single depth for the figures that take one, else NaN */
    dp_budget_terms terms;             /**< what is added to the pipeline, for the figures that take it */
    double tolerance;                  /**< of intervals by cheaper ways; 0: none; NaN: what the picture cannot show */
    uint64_t census;                   /**< most depths that a census may visit for the figure; 0: none is made */
    const struct shadow_cascade *maps; /**< for the figures of shadow maps, map_count of them, at most CHART_PANELS */
    size_t map_count;
    const struct shadow_engine *engine; /**< whose bias is shown beside; null: none, */
    double bias, normal_bias;           /**< its numbers, */
    const struct bias_api *api;         /**< and what units are of */
    const raster_row *raster;           /**< for the figures that draw */
    double slant, azimuth;              /**< the normal of what they draw, see raster/fight.h; degrees */
    const struct need_file *file;       /**< for the figures that take a file, else null */
    const struct fights_asked *fights;  /**< for the figures of a model, else null: see scene.h */
    const method_family_row *family;    /**< for the figures that show methods, else null */
    unsigned cases;                     /**< its cases, bits, where times are measured, */
    const char *where;                  /**< and in words at which planes, on which machine */
    int columns, rows;                  /**< how finely to compute: pixels of the figure; see refine.h */
} figure_request;

/** Bits for the options that a figure uses. */
enum {
    FIGURE_AT = 1 << 0,          /**< one depth, given with --at */
    FIGURE_TERMS = 1 << 1,       /**< --interpolation, --from-origin, --linearize */
    FIGURE_FLOAT = 1 << 2,       /**< set-ups of the model float, which have no cells */
    FIGURE_BINARY32 = 1 << 3,    /**< nothing but set-ups of the model float, whatever --model says */
    FIGURE_TOLERANCE = 1 << 4,   /**< other ways to the interval than the exact cell */
    FIGURE_SIGNED = 1 << 6,      /**< depths of 0 and less: a camera with near <= 0 */
    FIGURE_FILE = 1 << 5,        /**< a requirement file, which brings its own set-ups, with planes of their own */
    FIGURE_DRAWN = 1 << 8,       /**< what a rasterizer draws: the set-ups have a view, and its arithmetic */
    FIGURE_SLANTED = 1 << 9,     /**< set-ups with triangles */
    FIGURE_MODEL = 1 << 10,      /**< a model and what was found in it; the camera is that of the command scene */
    FIGURE_SETUPS = 1 << 11,     /**< set-ups, as the options of a camera say them */
    FIGURE_SHADOW = 1 << 7,      /**< shadow maps, whose cameras are not that of the view */
    FIGURE_GUARANTEED = 1 << 13, /**< what is guaranteed, unless --model is given */
    FIGURE_METHODS = 1 << 17,    /**< methods of a family, in one of its cases: a format and a mapping */
    FIGURE_TIMED = 1 << 18,      /**< between planes that are given; others walk over far/near */
    FIGURE_MINE = 1 << 16,       /**< functions of somebody's among the methods of linearize */
    FIGURE_COST = 1 << 19,   /**< all mappings that the camera can have, but those of engines, unless some are named */
    FIGURE_SMALL = 1 << 20,  /**< formats of few codes, and planes at which they are seen */
    FIGURE_FARS = 1 << 14,   /**< several far planes, and no formats */
    FIGURE_BESIDE = 1 << 15, /**< curves that another camera's can stand beside, on axes that can be given */
    FIGURE_RANGED = 1 << 21, /**< set-ups whose viewport moves depth */
    FIGURE_STAGED = 1 << 12, /**< codes that are reached: staged unless --model is given, where NDC is of [-1, 1] */
};

/**
 * Fills in an empty chart whose subtitle is set; a title left empty becomes the row's.
 * @return null, or a sentence about what of the request cannot be drawn, which lasts as long as the chart;
 *         chart_failed() tells of memory
 */
typedef const char *figure_build(const figure_request *request, chart *out);

typedef struct figure_row {
    NAMED_FIELDS;
    const char *title;
    size_t setups_max;   /**< most set-ups that stay legible */
    unsigned takes;      /**< FIGURE_... bits */
    const char *family;  /**< of methods, shown when none is named; null: the figure shows no methods */
    const char *formats; /**< those shown when none are named and all would be too many set-ups; else null */
    figure_build *build;
} figure_row;

NAMED_ROWS(figure_row, figure);

/** Colour, stroke and marker of set-up i: the format decides the colour and the marker; where all share it, or the
 *  mapping, each set-up has its own. Where a format has several mappings, these decide the stroke: solid or dotted with
 *  filled markers, or dashed with hollow ones if they are reversed. */
chart_style figure_style(const figure_request *request, size_t i);

/**
 * Behind NDC of [-1, 1] with p bits of mantissa depth is (1 + ndc)/2, which comes in steps of 2^-(p + 2) up to 1/4, and
 * above in none that are wider than those of a float of p bits or fewer. So of such a format the multiples of 2^-(p +
 * 2) are reached, and no others. p is 23; in formats so small that a figure draws code by code NDC is in the format.
 * @return 0 where each code is reached: of other mappings and formats, and in the model exact
 */
double figure_step(const dp_setup *setup);

/** dp_code(), through such an NDC. */
uint32_t figure_code(const dp_setup *setup, double z);

/** Whether a format has so few codes that each can be drawn. */
bool figure_draws_codes(const dp_format *format);

/** The range of a curve: what was asked, or near to far; to 1e6 near when far is infinite. */
void figure_range(const figure_request *request, double *lo, double *hi);

/** The next panel, with the given axis and one of eye depth over that range: logarithmic, or linear where it has depths
 *  of 0 or less. */
chart_panel *figure_panel(const figure_request *request, chart *out, chart_axis y);

figure_build distribution_build, share_build, error_build, interval_build, budget_build, needs_build, map_build,
    linear01_build, pareto_build, cost_build, stability_build, normals_build, shadow_build, shadow_distance_build,
    world_build, fight_build, scene_build;

/** Figures whose measuring takes long or differs from run to run, drawn of what was measured. */
const char *pareto_draw(const method_family_row *family, const bench_result *results, size_t count, chart *out);
const char *stability_draw(const method_family_row *family, const stability_result *results, size_t count, chart *out);

/** Degrees that the normals of a method are off on a surface at depth z: both counted as the figure names them. */
typedef double normals_error(const dp_setup *setup, size_t surface, size_t method, double z);
const char *normals_draw(const figure_request *request, normals_error *error, chart *out);

#endif
