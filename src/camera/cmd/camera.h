/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file camera.h  What is said of a camera, of what it sees, and of the arithmetic that its depth goes through: the
 * options that fill camera_asked, and what follows from several of them.
 */
#ifndef CAMERA_CMD_CAMERA_H
#define CAMERA_CMD_CAMERA_H

#include "camera/cmd/depths.h"
#include "camera/make.h"
#include "cli/option/option.h"
#include "depthprec/depthprec.h"
#include "raster/raster.h"
#include "shader/camera.h"

enum { CAMERA_FARS_MAX = 4, CAMERA_RANGES_MAX = 16 };

typedef struct camera_asked {
    asked_line *line;
    union {
        camera_said said; /**< by camera_complete(); of several presets see camera_of() */
        struct {
            CAMERA_FIELDS;
        };
    };
    lengths lengths;
    double fars[CAMERA_FARS_MAX]; /**< of the figures that take several, in the order given */
    size_t far_count;
    double ranges[CAMERA_RANGES_MAX][2]; /**< depth ranges, in the order given, each once; depth_range is the first */
    size_t range_count;                  /**< 0 where none was given */
    bool budgeted;             /**< only budgets are asked for: of logarithmic mappings, too, which have no codes in
                                    binary32 */
    double tolerance;          /**< a share */
    double azimuth;            /**< of one plane of --slant, degrees from right to up; NaN when not given */
    double intrinsics[4];      /**< focal lengths across and down, where the view axis meets the picture, pixels */
    camera_spec spec;          /**< the view's shape: --fov, --ortho; its size is the command's to fill in */
    depths at;                 /**< what --at said; count is 0 when it was not given. See depths_resolve() */
    double range_lo, range_hi; /**< what --range said, lo < hi. See range_resolve() */
    struct camera_asked *each; /**< of several presets this camera with each alone; else null */
} camera_asked;

/** The options of planes, formats, arithmetic and depths; those of a view and slanted triangles in it. */
extern const option_table camera_options, range_options, view_options;

/** The options that several commands take. */
extern const option_use camera_planes[], camera_uses[], camera_projected[], camera_slanted[], camera_beside_viewport[];

/** Texts of help about mappings, and about what a view changes. */
#define CAMERA_PERSPECTIVE "mappings: " DP_MAPPING_NAMES_PERSPECTIVE
#define CAMERA_OF_VIEW     "with --viewport also its field of view and rasterizer"
#define CAMERA_OF_TANGENTS "or the tangents of a view's edges, left,right,up,down, as OpenXR gives their angles"
#define CAMERA_OF_RG       "rg, of Unity's DepthNormals, is linear"

/** The unit where no preset brings one. */
#define CAMERA_UNIT_ALONE                                                                                              \
    OWN("unit", HELP("the length of a scene unit; any length can have a unit: 10cm"),                                  \
        WITHOUT("m where a length has a unit"))

/** Languages that some commands have in place of the rows'. */
option_parser parse_presets, parse_fars, parse_slant_or_plane, parse_depth_ranges;

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

/** Its preset of that index in few words: the name, where no other has it, else what was said of it, else "name (2)".
 * @return out */
const char *camera_preset_label(const camera_asked *c, size_t index, char out[PRESET_WORDS_SIZE]);

/** "0.01 mm": see lengths_text(). */
static inline number_text camera_length(const camera_asked *c, double value, int digits) {
    return lengths_text(&c->lengths, value, digits);
}

/** "m": what a scene unit is; null where nothing says it. */
static inline const char *camera_unit(const camera_asked *c) {
    return lengths_unit(&c->lengths);
}

/** Says a fault by its option. @return EXIT_USAGE */
int camera_refuse(const camera_fault *fault);

/** The vertical field of view in so many pixels, degrees: see camera_angle(). @return EXIT_FINE, or EXIT_USAGE
 * after one line on stderr */
int view_vertical(const camera_asked *c, int width, int height, double *fov_y);

/** Checks --viewport with the options beside it, and takes the field of view. @return as view_vertical() */
int slant_view(camera_asked *c);

/** Refuses a depth range beside what knows none. @return as view_vertical() */
int range_complete(const camera_asked *c);

/** View and rasterizer of what is drawn: 1920x1080 where no --viewport was given, llvmpipe where no --raster, and of
 * the formats those that it has. @return EXIT_FINE, or EXIT_USAGE after one line on stderr */
int view_drawn(camera_asked *c);

/** Reads a far plane, as --far has it. @return an exit status, after one line on stderr */
int camera_read_far(asked_line *line, const option_row *row, const char *value, double *out);

/* ---- Within this folder ------------------------------------------------------------------------------------------ */

option_parser parse_arith, parse_raster; /**< a name, or the profile of a GPU */

/** --arith is given and is a name: of a profile the formats count, too. */
bool camera_names_arith(const camera_asked *c);

/** Takes from a view what a command has no use for; without --viewport surfaces face the camera. @return as above */
int slant_complete(camera_asked *c);

enum { CAMERA_NAME_SIZE = 16 };
/** A key as the option that says it: "log-c". @return out */
const char *camera_option(const char *key, char out[CAMERA_NAME_SIZE]);

#endif
