/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file make.h  A camera of what was said of it, whichever door it came through: the words are put into keys there, and
 * here it is decided what a preset, a platform and a rasterizer bring where nothing was said, and what goes together.
 */
#ifndef CAMERA_MAKE_H
#define CAMERA_MAKE_H

#include "camera/matrix.h"
#include "camera/platform.h"
#include "camera/presets.h"
#include "camera/profile.h"
#include "camera/rules.h"
#include "raster/raster.h"

enum { CAMERA_FORMATS_MAX = 64, CAMERA_PRESETS_MAX = 16 };

/** The keys of a camera, in the order in which a file is read. */
typedef enum camera_key {
    CAMERA_PRESET,
    CAMERA_MATRIX,
    CAMERA_NEAR,
    CAMERA_FAR,
    CAMERA_MAPPING,
    CAMERA_FORMAT,
    CAMERA_ORTHO,
    CAMERA_ROUNDING,
    CAMERA_MODEL,
    CAMERA_ARITH,
    CAMERA_LOG_C,
    CAMERA_DEPTH_RANGE,
    CAMERA_VIEWPORT, /**< from here on what surfaces that slant need */
    CAMERA_FOV,
    CAMERA_HFOV,
    CAMERA_RASTER,
    CAMERA_SUBPIXEL,
    CAMERA_SLANT,
    CAMERA_TRIANGLE,
    CAMERA_KEYS
} camera_key;

/** Their names as requirement files write them, "log_c"; then null. */
extern const char *const camera_keys[CAMERA_KEYS + 1];

/** How a command uses a camera. */
typedef struct camera_use {
    bool shape;    /**< --viewport is the shape of the view alone: nothing slants */
    bool drawn;    /**< a rasterizer draws */
    bool mapped;   /**< --viewport is the view that shadow maps cover */
    bool measured; /**< the profile of a GPU is of use without a view, too */
    bool pictured; /**< a picture takes view and rasterizer, see view_drawn() */
    bool seen;     /**< from an eye surfaces slant, whether --viewport is given or not */
    bool counted;  /**< the report counts what a shader's log2 may be off by */
    bool angled;   /**< a field of view stands without a viewport, too: see slant_complete() */
    bool imaged;   /**< an image may say the mapping: the command takes the matrix apart once it is read */
    bool compared; /**< rg, which is no depth buffer, is shown beside buffers */
} camera_use;

/* Which the options of a command have among their own. */
#define CAMERA_FIELDS                                                                                                  \
    const char *words[CAMERA_KEYS]; /* of each key, "" of what is no word; null: it was not said */                    \
    camera_use use;                                                                                                    \
    double znear; /* scene units */                                                                                    \
    double zfar;  /* scene units or INFINITY; of several the farthest */                                               \
    bool ortho;                                                                                                        \
    dp_format formats[CAMERA_FORMATS_MAX]; /* in the order given, each once */                                         \
    size_t format_count;                                                                                               \
    dp_mapping mappings[DP_MAPPING_COUNT]; /* in the order given, each once */                                         \
    size_t mapping_count;                                                                                              \
    double log_c;                                                                                                      \
    double depth_range[2]; /* of the viewport, as a specification has it; both 0: 0 and 1 */                           \
    dp_rounding rounding;                                                                                              \
    dp_model model;  /* DP_MODEL_COUNT until it is made: the simplest that suffices */                                 \
    bool model_auto; /* that was asked for, see choice.h; `model` is then exact */                                     \
    dp_arith arith;                                                                                                    \
    bool raster_profiled;  /* the rasterizer is that of a profile, and so is its arithmetic */                         \
    bool has_raster_arith; /* which the profile names */                                                               \
    dp_arith raster_arith;                                                                                             \
    profile gpu;                               /* of arithmetic and rasterizer */                                      \
    dp_triangles triangles;                    /* width 0 without a viewport; the angle is the vertical one */         \
    double fov_x;                              /* the horizontal one where it was said, degrees */                     \
    const raster_row *raster;                  /* null where none is known */                                          \
    const preset *presets[CAMERA_PRESETS_MAX]; /* in the order given, each once; of several none is made */            \
    size_t preset_count;                                                                                               \
    preset_values values[CAMERA_PRESETS_MAX]; /* what was said of each */                                              \
    camera_matrix matrix;                     /* nothing where none was said */                                        \
    bool mapping_brought;                     /* an API chose the mapping */                                           \
    const platform *platform                  /* null where none was said */

typedef struct camera_said {
    CAMERA_FIELDS;
} camera_said;

/** Gives its presets the height of its viewport, where they ask for one. */
bool camera_canvas(camera_said *c, camera_fault *fault);

/**
 * Completes a camera: what its one preset, its platform and its rasterizer bring where nothing was said.
 * @param unit  of its lengths, which a preset's are converted into; null where nothing says it
 * @return true, or false and what is wrong in *fault
 */
bool camera_make(camera_said *c, const unit_row *unit, camera_fault *fault);

/**
 * Takes the profile of a GPU in place of the name of an arithmetic or a rasterizer, whose arithmetic comes with it.
 * @return 0 and the name, of which nothing but its length is known; or as profile_add()
 */
int camera_profile(camera_said *c, const char *path, camera_key key, char name[PROFILE_NAME_SIZE],
                   char error[PROFILE_ERROR_SIZE]);

/**
 * The vertical field of view in so many pixels: that of the horizontal one where it was said, else a single preset's
 * where none was, else `given`. Degrees.
 */
bool camera_angle(const camera_said *c, double given, int width, int height, double *fov_y, camera_fault *fault);

/** Takes its matrix apart and what it says of the camera from it: planes, mapping, projection. Once, where one is
 * given; `like` and `oblique` as camera_matrix_take() has them. */
bool camera_take_matrix(camera_said *c, dp_mapping like, bool oblique, camera_fault *fault);

/** The API of its platform or one preset; null where there is none. */
static inline const char *camera_said_api(const camera_said *c) {
    return c->platform != NULL ? c->platform->api : c->preset_count == 1 ? c->presets[0]->api : NULL;
}

/** Whether near and far were said: by themselves, or by a preset or a matrix, which say all. */
static inline bool camera_says_planes(const camera_said *c) {
    return c->preset_count > 0 || c->matrix.count == MATRIX_ENTRIES;
}

/** The part of it that is about the view: what needs a viewport, and the angle. */
bool camera_viewed(camera_said *c, camera_fault *fault);

/** The grid of its rasterizer, or as many bits of it as were said. */
bool camera_grid(camera_said *c, camera_fault *fault);

/** Whether its GPUs store the format, and its rasterizer draws it within a bound. */
bool camera_keeps(const camera_said *c, const dp_format *format, camera_fault *fault);

/** All of a made camera but format and mapping, of which there may be several: those are its first. */
dp_spec camera_to_spec(const camera_said *c);

/**
 * Surfaces at any slant where nothing was said of a viewport: what a set-up of the camera is with `viewport` 1920x1080,
 * or as high as the canvas that its preset computes with, the standard class, and of field of view, rasterizer and
 * arithmetic what preset and platform then bring.
 * @return false where nothing is guaranteed to them: orthographic, a mapping that is not affine on the screen, a
 *         rasterizer without a bound; or where a viewport was said
 */
bool camera_assumed(const camera_said *c, const dp_spec *spec, dp_spec *out);

/** Whether a constant C or an arithmetic is of use to a set-up: a shader writes a linear depth, and what is said of it
 * leaves its arithmetic out. */
bool camera_has(const dp_spec *spec, camera_key key);

/** Whether that key, if it was said, is of use to one of so many set-ups, whose specifications lie `stride` bytes
 * apart; the formats of a profile are anyway. */
bool camera_serves(const camera_said *c, camera_key key, const dp_spec *first, size_t stride, size_t count,
                   camera_fault *fault);

#endif
