/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file rules.h  What relates the keys of a camera, whichever door they came through, and the sentence for what is
 * wrong. The command line adds "--", a requirement file its line.
 *
 * All return true, or false and what is wrong in *fault.
 */
#ifndef CAMERA_RULES_H
#define CAMERA_RULES_H

#include <stdbool.h>

#include "camera/profile.h"
#include "depthprec/depthprec.h"
#include "raster/raster.h"

/* The limits of a view on the command line and in files; those of triangles.h are a little wider. */
#define CAMERA_FOV_LEAST 0.01 /**< degrees */
#define CAMERA_FOV_MOST  179.0
enum { CAMERA_SIDE_MOST = 32768, CAMERA_SUBPIXEL_MOST = 8 }; /**< pixels of a side; bits */

typedef struct camera_fault {
    const char *key; /**< as requirement files write it: "log_c" */
    char text[512];  /**< a phrase of which the key is the subject: "must be ..., got ..." */
} camera_fault;

/** Why dp_setup_init() refused a specification; `aside` is said of leaving out a model, or "". @return false */
bool camera_refused(const dp_spec *spec, dp_status status, const char *aside, camera_fault *fault);

/** The vertical field of view of a horizontal one, degrees, which triangles can have. */
bool camera_vertical(double fov_x, int width, int height, double *fov_y, camera_fault *fault);

/** Takes a rasterizer's grid and plane; where `asked` bits of the grid were given, more than 0, the rasterizer must
 * have no grid of its own, and at least as many as it promises. */
bool camera_take_raster(const raster_row *raster, int asked, dp_triangles *triangles, camera_fault *fault);

/** Whether the rasterizer, null where none is named, draws the format within the bound of triangles.h. */
bool camera_bounded(const raster_row *raster, const dp_format *format, camera_fault *fault);

/** Whether the GPUs of the profile store the format. */
bool camera_stored(const profile *gpu, const dp_format *format, camera_fault *fault);

#endif
