/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file requirement.h  Requirement files: what a project's cameras must be able to tell apart. See depthprec(5).
 *
 *     unit = "m";
 *     cameras = { player = { near = "10 cm"; far = "inf"; mapping = "reversed"; format = "fp32"; model = "float"; }; };
 *     requirements = { decals = { camera = "player"; range = ["0.5 m", "50 m"]; separation = "1 mm"; }; };
 *
 * Nothing has a silent default that the verdict hangs on: a camera names its planes, mapping and format (itself or by
 * a preset), a requirement its camera, its depths and exactly one limit. What is not known is an error.
 */
#ifndef SOLVE_REQUIREMENT_H
#define SOLVE_REQUIREMENT_H

#include <stdbool.h>

#include "bias/bias.h"
#include "camera/matrix.h"
#include "camera/profile.h"
#include "depthprec/depthprec.h"
#include "quantity/quantity.h"
#include "raster/raster.h"
#include "world/world.h"

enum { NEED_SETUPS_MAX = 2 };

typedef struct need_camera {
    const char *name;
    int line;
    size_t count;                     /**< 1; 2 where the format (depth24plus) may be either of two */
    dp_setup setups[NEED_SETUPS_MAX]; /**< in the model asked for; exact where `automatic` */
    double world;                     /**< largest |coordinate| of places and camera; 0: eye depth is given */
    world_scheme scheme;              /**< where `world` is positive */
    bool automatic;                   /**< model "auto": the simplest model that can decide */
    const raster_row *raster; /**< whose grid and set-up the set-ups' triangles have; null where none is named */
    profile gpu;              /**< of `arith` and `raster` */
    camera_matrix matrix;     /**< of its planes */
} need_camera;

/** Lengths are in scene units. */
typedef struct need {
    const char *name;
    int line;
    size_t camera;      /**< index into the file's cameras */
    quantity_kind kind; /**< that it limits */
    double limit;       /**< largest that passes; a length or a share */
    double lo, hi;      /**< the range; equal for a single depth */
    bias_state bias;    /**< of a BIAS: the one given; `limit` is its units */
    bias_goal goal;     /**< likewise: slope and gap */
} need;

typedef struct need_file {
    const char *path;
    const char *unit; /**< "m": what one scene unit is; "" when the file does not say */
    size_t camera_count, count;
    need_camera *cameras;
    need *needs;
    struct settings *memory; /**< what the names live in */
} need_file;

enum { NEED_TEXT_SIZE = 256, NEED_KNOWN_SIZE = 1024, NEED_BYTES_MAX = 1 << 26 };

/** Why a file was refused. */
typedef struct need_error {
    int line;                    /**< 0 when it is about the file as a whole */
    bool unreadable;             /**< the file, or one that it names, could not be read */
    char text[NEED_TEXT_SIZE];   /**< what is allowed and what was found, one line */
    char given[64];              /**< a name that is not known, for a suggestion; else "" */
    char known[NEED_KNOWN_SIZE]; /**< the names that are, separated by spaces */
} need_error;

/**
 * Reads a file, "-" for stdin. A file of more than NEED_BYTES_MAX bytes, with a null byte or an @include is refused.
 * @return true, and then need_release() frees it; or false and *error says why
 */
bool need_read(const char *path, need_file *out, need_error *error);

/** The same for a text of `size` bytes followed by a null byte; `path` names it in messages. */
bool need_parse(const char *path, const char *text, size_t size, need_file *out, need_error *error);

void need_release(need_file *file);

#endif
