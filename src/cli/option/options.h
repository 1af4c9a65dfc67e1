/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file options.h  The command line: one table of option rows, from which parsing, help and completion are made.
 *
 * A command receives a `const options *` that is already checked option by option: numbers are whole numbers or
 * finite values in their own range, names are known. What needs several options at once is checked by setups_make()
 * (near, far, mapping), range_resolve() and depths_resolve().
 */
#ifndef CLI_OPTION_OPTIONS_H
#define CLI_OPTION_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "api/bias.h"
#include "api/platform.h"
#include "api/presets.h"
#include "api/profile.h"
#include "api/unit.h"
#include "cli/commands.h"
#include "cli/depths.h"
#include "cli/errors.h"
#include "cli/product.h"
#include "depthprec/depthprec.h"
#include "frame/moved.h"
#include "frame/stereo.h"
#include "frame/synthetic.h"
#include "raster/raster.h"
#include "raster/vertex_compare.h"
#include "report/number.h"
#include "report/output.h"
#include "shader/camera.h"
#include "shader/effect.h"
#include "shader/normal.h"
#include "shader/packing.h"
#include "shader/position.h"
#include "world/world.h"

/** The options, in the order in which help lists them. The index of an option's row is its id. */
typedef enum option_id {
    OPTION_NEAR = 0,
    OPTION_FAR,
    OPTION_FORMAT,
    OPTION_MAPPING,
    OPTION_LOG_C,
    OPTION_ORTHO,
    OPTION_PRESET,
    OPTION_PLATFORM,
    OPTION_UNIT,
    OPTION_ROUNDING,
    OPTION_MODEL,
    OPTION_ARITH,
    OPTION_TOLERANCE,
    OPTION_AT,
    OPTION_RANGE,
    OPTION_DEPTH,
    OPTION_CODE,
    OPTION_CONSTANTS,
    OPTION_FOR,
    OPTION_SEPARATION,
    OPTION_ERROR,
    OPTION_INTERPOLATION,
    OPTION_FROM_ORIGIN,
    OPTION_COMPOSITION,
    OPTION_SCHEME,
    OPTION_SHARE,
    OPTION_LINEARIZE,
    OPTION_LOG2,
    OPTION_EYE,
    OPTION_LOOK,
    OPTION_PATH,
    OPTION_CAMERA,
    OPTION_FOV,
    OPTION_HFOV,
    OPTION_INTRINSICS,
    OPTION_VIEWPORT,
    OPTION_RASTER,
    OPTION_SUBPIXEL,
    OPTION_SLANT,
    OPTION_TRIANGLE_CLASS,
    OPTION_CASCADES,
    OPTION_LIGHT_BOX,
    OPTION_CASTERS,
    OPTION_KERNEL,
    OPTION_ANGLE,
    OPTION_CURVATURE,
    OPTION_CAMERA_DEPTH,
    OPTION_API,
    OPTION_UNITS,
    OPTION_FACTOR,
    OPTION_CLAMP,
    OPTION_SLOPE,
    OPTION_SAMPLE,
    OPTION_SEED,
    OPTION_RASTERIZE,
    OPTION_AGAINST,
    OPTION_PROGRAM,
    OPTION_VERTICES,
    OPTION_WITHIN,
    OPTION_ALSO,
    OPTION_TRANSFORMS,
    OPTION_RENDER,
    OPTION_EMIT_NEED,
    OPTION_DEVICE,
    OPTION_KEEP,
    OPTION_LANGUAGE,
    OPTION_WHAT,
    OPTION_UNIFORMS,
    OPTION_PAIRS,
    OPTION_PAIRS_FOR,
    OPTION_DEFINE,
    OPTION_MINE,
    OPTION_MATRIX,
    OPTION_LAST_EYE,
    OPTION_LAST_LOOK,
    OPTION_SYNTHETIC,
    OPTION_SIZE,
    OPTION_PARAMETER,
    OPTION_SKY,
    OPTION_METRIC,
    OPTION_STEREO,
    OPTION_LATTICE,
    OPTION_RADIAL,
    OPTION_PACKING,
    OPTION_CHANNEL,
    OPTION_PIXEL,
    OPTION_PRODUCT,
    OPTION_AS,
    OPTION_PICTURE,
    OPTION_TINT,
    OPTION_HI_Z,
    OPTION_NORMAL_FORMAT,
    OPTION_ERROR_MAP,
    OPTION_FIGURE,
    OPTION_OVERLAY,
    OPTION_HISTOGRAM,
    OPTION_TYPE,
    OPTION_THEME,
    OPTION_FIGURE_SIZE,
    OPTION_BESIDE,
    OPTION_AXES,
    OPTION_TITLE,
    OPTION_LINK,
    OPTION_REPORT,
    OPTION_JSON,
    OPTION_CSV,
    OPTION_OUTPUT,
    OPTION_THREADS,
    OPTION_QUIET,
    OPTION_FULL,
    OPTION_COLOR,
    OPTION_HELP,
    OPTION_VERSION,
    OPTION_COUNT
} option_id;

/** Values of --for, and SOLVE_FOR_ANY when it was not given. The planes come first. */
typedef enum solve_target {
    SOLVE_FOR_NEAR = 0,
    SOLVE_FOR_FAR,
    SOLVE_FOR_FORMAT,
    SOLVE_FOR_MAPPING,
    SOLVE_FOR_SEPARATION,
    SOLVE_FOR_DISTANCE,
    SOLVE_FOR_FRUSTA,
    SOLVE_FOR_ANY
} solve_target;

/** Values of --report. */
typedef enum report_form { REPORT_TEXT = 0, REPORT_JSON, REPORT_JUNIT } report_form;

enum {
    OPTIONS_TYPED_MAX = 16,
    OPTIONS_FORMATS_MAX = 64,
    OPTIONS_FARS_MAX = 4,
    OPTIONS_PARAMETERS_MAX = 16,
    OPTIONS_MINE_MAX = 8,
    OPTIONS_PRESETS_MAX = 16,
    OPTIONS_SCHEMES_MAX = 16
};

/** One --parameter NAME=VALUE; whose it is, and whether there is such a one, is for the command to see. */
typedef struct named_number {
    char name[32];
    double value;
} named_number;

/** A length that was typed with a unit. */
typedef struct typed_length {
    double value;  /**< scene units */
    double number; /**< of `unit` */
    const unit_row *unit;
} typed_length;

/** What set-ups are made of. */
typedef struct options_camera {
    double znear;                  /**< scene units */
    double zfar;                   /**< scene units or INFINITY; of several the farthest */
    double fars[OPTIONS_FARS_MAX]; /**< of the figures that take several, in the order given */
    size_t far_count;
    bool ortho;
    dp_format formats[OPTIONS_FORMATS_MAX]; /**< in the order given, each once */
    size_t format_count;
    dp_mapping mappings[DP_MAPPING_COUNT]; /**< in the order given, each once */
    size_t mapping_count;
    double log_c;
    dp_rounding rounding;
    dp_model model;
    bool model_auto; /**< --model auto: see choice.h; `model` is then exact */
    bool budgeted;   /**< only budgets are asked for: of logarithmic mappings, too, which have no codes in binary32 */
    dp_arith arith;
    dp_arith raster_arith; /**< of the GPU whose profile --raster names */
    bool has_raster_arith;
    profile gpu;              /**< of --arith and --raster */
    dp_triangles triangles;   /**< --viewport, --fov, --hfov, --raster, --subpixel, --slant, --triangle-class; width 0
                                   without the first */
    double fov_x;             /**< --hfov, degrees */
    double azimuth;           /**< of one plane of --slant, degrees from right to up; NaN when not given */
    const raster_row *raster; /**< --raster; null when not given */
    const unit_row *unit;     /**< what a scene unit is; null where nothing says it: lengths are converted already */
    typed_length typed[OPTIONS_TYPED_MAX]; /**< the first that were */
    size_t typed_count;
    const preset *presets[OPTIONS_PRESETS_MAX]; /**< --preset, in the order given, each once */
    size_t preset_count; /**< of one, what the user did not give is already filled in; of several see options_of() */
    const platform *platform;  /**< --platform; null when not given, and what the user did not give is filled in */
    depths at;                 /**< what --at said; count is 0 when it was not given. See depths_resolve() */
    double range_lo, range_hi; /**< what --range said, lo < hi. See range_resolve() */
} options_camera;

/** What is asked of them. */
typedef struct options_wanted {
    solve_target target;      /**< --for */
    double separation, error; /**< scene units; 0 when not given */
    double tolerance;         /**< a share */
    bool constants;           /**< what shaders are given; the view's shape is then in view.spec */
    depths looked_up;         /**< window depths of --depth in [0, 1], or codes of --code; count is 0 without them */
} options_wanted;

/** Where vertices come from. */
typedef struct options_world {
    dp_budget_terms
        terms;        /**< --interpolation, --from-origin, --composition, --linearize, --log2; zero when not given */
    depths distances; /**< of the camera from the world's origin; count is 0 when not given */
    world_scheme schemes[OPTIONS_SCHEMES_MAX]; /**< in the order given, each once */
    size_t scheme_count;
    bool shared_origin; /**< both surfaces are of meshes with one origin */
} options_world;

typedef struct options_bias {
    const bias_api *api; /**< --api; null for several: those of `apis` */
    unsigned apis;       /**< 1 << index of bias_api_get(), or-ed */
    double units, factor;
    double clamp; /**< window depth; 0 is none */
    double slope; /**< scene units per pixel, not negative */
} options_bias;

/** A camera's place, and last frame's. */
typedef struct options_view {
    double eye[3], look[3]; /**< places: of an eye, and what it looks at */
    double last_eye[3], last_look[3];
    camera_spec spec;     /**< --size, --fov, --ortho; see texture_camera_place() */
    double intrinsics[4]; /**< focal lengths across and down, where the view axis meets the picture, pixels */
} options_view;

typedef struct options_scene {
    double within;         /**< eye depth; 0 when not given */
    const char *path;      /**< file of eyes; or null */
    const char *camera;    /**< of the model, by name; or null */
    unsigned transforms;   /**< of a model's nodes: a model_transforms */
    unsigned filters_off;  /**< of a model's pairs: 1 << finder_filter, or-ed */
    const char *render;    /**< file of a picture; null when not given */
    const char *emit_need; /**< file of requirements; null when not given */
} options_scene;

/** Pairs of surfaces, and the vertex programs that place them. */
typedef struct options_census {
    uint64_t sample; /**< pairs to draw; 0 when not given */
    uint64_t seed;
    bool drawn;                                   /**< --rasterize: the surfaces are drawn */
    const vertex_program *against[VERTEX_OTHERS]; /**< in the order given, each once */
    size_t against_count;
    const vertex_program *program; /**< what they are compared with */
    unsigned vertices;             /**< how they are drawn: a vertex_spread */
} options_census;

typedef struct options_probe {
    const char *device; /**< null when not given */
    const char *keep;   /**< file of raw codes; null when not given */
} options_probe;

typedef struct options_code {
    const struct code_language *language;
    unsigned what; /**< linearize, projection: in the order of the names */
    bool uniforms;
} options_code;

typedef struct options_judge {
    const char *pairs;                           /**< file of pairs; null when not given */
    unsigned depths;                             /**< how many are printed to ask for; 0 when not given */
    const char *defines[OPTIONS_PARAMETERS_MAX]; /**< NAME=VALUE */
    size_t define_count;
    const char *mine[OPTIONS_MINE_MAX]; /**< FILE:FUNCTION */
    size_t mine_count;
} options_judge;

typedef struct options_shadow {
    unsigned cascades;
    double lambda;       /**< of their split: 0 even, 1 logarithmic */
    double light_box[3]; /**< width, height, depth, scene units; 0 when not given */
    double casters;      /**< scene units */
    unsigned kernel;     /**< the filter reads so many texels in either direction */
    double curvature;    /**< radius of curvature of receivers, scene units; NaN when not given */
    double facet;        /**< of the circles about their triangles, scene units */
    dp_spec camera;      /**< of the depth texture that receivers are rebuilt from: format, mapping, far */
} options_shadow;

/** A depth image, and what is made of it. Rows and names are null when not given. */
typedef struct options_image {
    const char *matrix; /**< file of a projection matrix, which then says the planes and the field of view */
    const synthetic_row *synthetic;
    named_number parameters[OPTIONS_PARAMETERS_MAX];
    size_t parameter_count;
    double sky;             /**< window depth */
    double metric;          /**< scene units of 1 in a sample of metric depth; 0 when not given */
    const moved_row *moved; /**< how its bits were moved on the way into the file; null: they were not */
    stereo_spec stereo;     /**< of disparities, `metric` is then 1; its focal length 0 when not given */
    const char *lattice;    /**< what it was rounded to before; null when not given */
    bool radial;            /**< metric depth is the distance along the ray */
    const char *as;         /**< what eye depth is rounded to; null when not given */
    const char *picture;    /**< file of the colours that an effect is composed on; null when not given */
    double tint[4];         /**< red, green, blue, alpha */
    unsigned hi_z;          /**< a level of the pyramid of the farthest depths, or of */
    bool hi_z_nearest;      /**< ... the nearest */
    dp_format hi_z_format;  /**< what it is rounded to; of no bits where that is the image's own */
    const char *channel;    /**< of FILE, by name; null: that which is depth */
    const packing *packing; /**< of FILE */
    depths pixels;          /**< column and row of each in turn; count is 0 when not given */
    const product_row *product;
    const position_row *position;   /**< of --product position; null for exact as well */
    const normal_row *normal;       /**< of --product normal */
    const effect_row *effect;       /**< of --product effect */
    const packing *pack;            /**< of --product pack */
    const normal_row *normals_by;   /**< of an effect, or of what is packed */
    bool error_map;                 /**< in place of the product */
    const char *error_file;         /**< beside it; or null */
    unsigned normal_format;         /**< of a PNG: 0: y up, 1: y down */
    const char *figure, *histogram; /**< files */
    double overlay;                 /**< errors above it are shown, scene units; 0 when not given */
} options_image;

typedef struct options_figure {
    unsigned type;      /**< a canvas_format, where the name of a file does not say it */
    unsigned theme;     /**< index of theme_get() */
    int width, height;  /**< px; 0 when not given, so that each figure has its own default */
    const char *title;  /**< null when not given, */
    const char *beside; /**< as is this */
    double axes[4];     /**< the ends of x and those of y, where given */
} options_figure;

typedef struct options_output {
    const char *link; /**< where the page is that the link opens; null when none is asked for */
    report_form report;
    output_form form;
    const char *file; /**< the argument of -o; null when not given. "-" is stdout: see options_open() */
    bool quiet, full;
    unsigned colour; /**< --color: an output_colour */
    int threads;     /**< 0 when not given: as many as there are cores */
} options_output;

typedef struct options {
    const command_row *command;
    char **argv;     /**< the whole command line, for metadata */
    char **operands; /**< what is neither option nor command; operand_count is within the command's bounds */
    int operand_count;
    const void
        *operand_row; /**< the row that the first operand names where the command has a table of them, else null */
    unsigned parts;   /**< the part of the command that is asked for: option_parts() of uses.h */
    const char *given[OPTION_COUNT]; /**< the argument as the user gave it, "" of none; see option_given() */
    bool version;                    /**< in place of help */
    struct options *each;            /**< of several presets these options with each alone; else null */

    options_camera camera;
    options_wanted wanted;
    options_world world;
    options_bias bias;
    options_view view;
    options_scene scene;
    options_census census;
    options_probe probe;
    options_judge judge;
    options_code code;
    options_shadow shadow;
    options_image image;
    options_figure figure;
    options_output out;
    double angle; /**< degrees: of a receiver's normal to the light, or between the planes of surfaces */
} options;

/**
 * Reads a command line. argv[0] is the program; the command is the first word that belongs to no option, `table`
 * where there is none. --help and --version anywhere make the command `help`. No order of the options matters.
 *
 * @return EXIT_FINE, or EXIT_USAGE after one line on stderr
 */
int options_parse(options *o, int argc, char **argv);

/** The API of that index among those that are asked for; null behind the last. */
const bias_api *options_api(const options *o, size_t index);

/** How many cameras there are: as many as presets, at least one. */
static inline size_t options_cameras(const options *o) {
    return o->camera.preset_count > 1 ? o->camera.preset_count : 1;
}

/** Whether the GPUs of the profiles store depth in that format; where not, one line on stderr says what they store.
 * @return EXIT_FINE or EXIT_USAGE */
int options_check_stored(const options *o, const dp_format *format);

/** The options with the preset of that index alone, lengths in its own unit where that is known and --unit was not
 * given; as they are where there are not several. */
static inline const options *options_of(const options *o, size_t camera) {
    return o->each != NULL ? &o->each[camera] : o;
}

/** The vertical field of view, degrees, as --fov or --hfov says it of so many pixels. @return EXIT_FINE, or EXIT_USAGE
 * after one line on stderr */
int view_vertical(const options *o, int width, int height, double *fov_y);

/** Checks --viewport with the options beside it, and takes the field of view. @return as view_vertical() */
int slant_view(options *o);

/** View and rasterizer of what is drawn: 1920x1080 where no --viewport was given, llvmpipe where no --raster, and of
 * the formats those that it has. @return EXIT_FINE, or EXIT_USAGE after one line on stderr */
int view_drawn(options *o);

/** Opens what --output names, which is no picture's, for text, JSON or CSV, as wide as --full makes it, as --color
 * wants it dressed. @return EXIT_FINE, or EXIT_USAGE or EXIT_IO after one line on stderr */
int options_open(const options *o, output *out);

/** Frees what options_parse() allocated, whatever it returned. */
void options_release(options *o);

/** Did the user give this option? */
static inline bool option_given(const options *o, option_id id) {
    return o->given[id] != NULL;
}

/**
 * Prints "depthprec: --NAME: " and the rest, one line, on stderr. The rest says what is allowed and what was given:
 *     return option_error(OPTION_FORMAT, "must be one format, got %zu", count);
 * @return EXIT_USAGE
 */
int option_error(option_id id, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** "0.01 mm": a length as it was typed, with the unit that it had there; of another one so many significant digits, 0
 * for as many as it takes, with options_unit(). */
number_text options_length(const options *o, double value, int digits);

/** The unit behind the argument of an option that is one length; that of the scene where there is none, null where
 * nothing says that. */
const unit_row *options_unit_of(const options *o, option_id id);

/** "m": what a scene unit is; null where nothing says it. */
const char *options_unit(const options *o);

/** The long name of an option without its dashes. */
const char *option_name(option_id id);

/** The file that an option has written, "-" for stdout; null where it has none. */
const char *option_written(const options *o, option_id id);

/** Word `index` of an option that takes one of a few. */
const char *option_word(option_id id, size_t index);

/** Looks up an operand, which help calls `what`. @return EXIT_FINE and *found, or EXIT_USAGE after one line on stderr
 */
int check_operand(const command_row *v, const char *what, const name_list *n, const char *given, list_item *found);

#endif
