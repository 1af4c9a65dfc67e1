/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file camera.h  What is said of a camera, of what it sees, and of the arithmetic that its depth goes through: the
 * options that fill camera_asked, and what follows from several of them.
 */
#ifndef CAMERA_CMD_CAMERA_H
#define CAMERA_CMD_CAMERA_H

#include "camera/cmd/depths.h"
#include "camera/platform.h"
#include "camera/presets.h"
#include "camera/profile.h"
#include "camera/rules.h"
#include "cli/option/option.h"
#include "depthprec/depthprec.h"
#include "raster/raster.h"
#include "shader/camera.h"

enum { CAMERA_FORMATS_MAX = 64, CAMERA_FARS_MAX = 4, CAMERA_PRESETS_MAX = 16 };

/** How a command uses a camera. */
typedef struct camera_use {
    bool shape;    /**< --viewport is the shape of the view alone: nothing slants */
    bool drawn;    /**< a rasterizer draws */
    bool mapped;   /**< --viewport is the view that shadow maps cover */
    bool measured; /**< the profile of a GPU is of use without a view, too */
    bool pictured; /**< a picture takes view and rasterizer, see view_drawn() */
    bool seen;     /**< from an eye surfaces slant, whether --viewport is given or not */
    bool counted;  /**< the report counts what a shader's log2 may be off by */
    bool compared; /**< rg, which is no depth buffer, is shown beside buffers */
} camera_use;

typedef struct camera_asked {
    asked_line *line;
    camera_use use; /**< by camera_complete() */
    lengths lengths;
    double znear;                 /**< scene units */
    double zfar;                  /**< scene units or INFINITY; of several the farthest */
    double fars[CAMERA_FARS_MAX]; /**< of the figures that take several, in the order given */
    size_t far_count;
    bool ortho;
    dp_format formats[CAMERA_FORMATS_MAX]; /**< in the order given, each once */
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
    double tolerance;         /**< a share */
    profile gpu;              /**< of --arith and --raster */
    dp_triangles triangles;   /**< --viewport, --fov, --hfov, --raster, --subpixel, --slant, --triangle-class; width 0
                                   without the first */
    double fov_x;             /**< --hfov, degrees */
    double azimuth;           /**< of one plane of --slant, degrees from right to up; NaN when not given */
    double intrinsics[4];     /**< focal lengths across and down, where the view axis meets the picture, pixels */
    camera_spec spec;         /**< the view's shape: --fov, --ortho; its size is the command's to fill in */
    const raster_row *raster; /**< --raster; null when not given */
    const preset *presets[CAMERA_PRESETS_MAX]; /**< --preset, in the order given, each once */
    size_t preset_count; /**< of one, what the user did not give is already filled in; of several see camera_of() */
    const platform *platform;  /**< --platform; null when not given, and what the user did not give is filled in */
    depths at;                 /**< what --at said; count is 0 when it was not given. See depths_resolve() */
    double range_lo, range_hi; /**< what --range said, lo < hi. See range_resolve() */
    struct camera_asked *each; /**< of several presets this camera with each alone; else null */
} camera_asked;

/** The options of planes, formats, arithmetic and depths; those of a view and slanted triangles in it. */
extern const option_table camera_options, view_options;

/** The options that several commands take. */
extern const option_use camera_planes[], camera_uses[], camera_projected[], camera_slanted[], camera_beside_viewport[];

/** Texts of help about mappings, and about what a view changes. */
#define CAMERA_PERSPECTIVE     "mappings: " DP_MAPPING_NAMES_PERSPECTIVE
#define CAMERA_ALL_PERSPECTIVE CAMERA_PERSPECTIVE "; all are d3d and reversed"
#define CAMERA_OF_VIEW         "with --viewport also its field of view and rasterizer"
#define CAMERA_OF_RG           "rg, of Unity's DepthNormals, is linear"

/** The unit where no preset brings one. */
#define CAMERA_UNIT_ALONE                                                                                              \
    OWN("unit", HELP("the length of a scene unit; any length can have a unit: 10cm"),                                  \
        WITHOUT("m where a length has a unit"))

/** Languages that some commands have in place of the rows'. */
option_parser parse_presets, parse_fars, parse_slant_or_plane;

/** Completes options by others, once all are read; several presets are resolved. @return EXIT_FINE, or EXIT_USAGE
 * after one line on stderr */
int camera_complete(camera_asked *c, const camera_use *use);

/** The API of its presets and platform, which says the rule of a bias; null where none does. */
const char *camera_api(const camera_asked *c);

/** The language of its preset, else of its platform's API; null where neither is given. */
const char *camera_language(const camera_asked *c);

/** How many cameras there are: as many as presets, at least one. */
static inline size_t camera_count(const camera_asked *c) {
    return c->preset_count > 1 ? c->preset_count : 1;
}

/** It with the preset of that index alone, lengths in its own unit where that is known and --unit was not given; as it
 * is where there are not several. */
static inline const camera_asked *camera_of(const camera_asked *c, size_t index) {
    return c->each != NULL ? &c->each[index] : c;
}

/** "0.01 mm": see lengths_text(). */
static inline number_text camera_length(const camera_asked *c, double value, int digits) {
    return lengths_text(&c->lengths, value, digits);
}

/** "m": what a scene unit is; null where nothing says it. */
static inline const char *camera_unit(const camera_asked *c) {
    return lengths_unit(&c->lengths);
}

/** Whether the GPUs of the profiles store depth in that format; where not, one line on stderr says what they store.
 * @return EXIT_FINE or EXIT_USAGE */
int camera_check_stored(const camera_asked *c, const dp_format *format);

/** Says a fault by its option. @return EXIT_USAGE */
int camera_refuse(const camera_fault *fault);

/** The vertical field of view, degrees, as --fov or --hfov says it of so many pixels. @return EXIT_FINE, or EXIT_USAGE
 * after one line on stderr */
int view_vertical(const camera_asked *c, int width, int height, double *fov_y);

/** Checks --viewport with the options beside it, and takes the field of view. @return as view_vertical() */
int slant_view(camera_asked *c);

/** View and rasterizer of what is drawn: 1920x1080 where no --viewport was given, llvmpipe where no --raster, and of
 * the formats those that it has. @return EXIT_FINE, or EXIT_USAGE after one line on stderr */
int view_drawn(camera_asked *c);

/** Reads a far plane, as --far has it. @return an exit status, after one line on stderr */
int camera_read_far(asked_line *line, const option_row *row, const char *value, double *out);

/* ---- Within this folder ------------------------------------------------------------------------------------------ */

option_parser parse_arith, parse_raster; /**< a name, or the profile of a GPU */

/** --arith is given and is a name: of a profile the formats count, too. */
bool camera_names_arith(const camera_asked *c);

/** Takes the options of slanted triangles together; without --viewport surfaces face the camera. @return as above */
int slant_complete(camera_asked *c);

/** With --viewport: a preset's field of view and rasterizer, where none were given. */
void slant_take_preset(camera_asked *c, const preset *p);
/** With --viewport: the rasterizer of a name of raster_find(), where none was given. */
void slant_take_raster(camera_asked *c, const char *name);

#endif
