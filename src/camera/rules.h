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

#include "depthprec/depthprec.h"

/* The limits of a view on the command line and in files; those of triangles.h are a little wider. */
#define CAMERA_FOV_LEAST  0.01 /**< degrees */
#define CAMERA_FOV_MOST   179.0
#define CAMERA_NEAR_LEAST 1e-12 /**< scene units; orthographic: 0, or of either sign */
#define CAMERA_NEAR_MOST  1e12
enum { CAMERA_SIDE_MOST = 32768, CAMERA_SUBPIXEL_MOST = 8 }; /**< pixels of a side; bits */

enum { CAMERA_FAULT_SIZE = 512, CAMERA_NUMBER_SIZE = 32 };

typedef struct camera_fault {
    const char *key;              /**< as requirement files write it: "log_c" */
    char text[CAMERA_FAULT_SIZE]; /**< a phrase of which the key is the subject: "must be ..., got ..."; @ stands before
                                     another key */
} camera_fault;

/** Notes a fault. @return false */
bool camera_fails(camera_fault *fault, const char *key, const char *format, ...) __attribute__((format(printf, 3, 4)));

/** Its text with `mark`, "--" or nothing, in place of each @. @return out */
const char *camera_fault_text(const camera_fault *fault, const char *mark, char out[CAMERA_FAULT_SIZE]);

/** A number in the fewest digits, from 15 on, that are read as the same. @return out */
const char *camera_number(double value, char out[CAMERA_NUMBER_SIZE]);

/** Why dp_setup_init() refused a specification; `aside` is said of leaving out a model, or "". @return false */
bool camera_refused(const dp_spec *spec, dp_status status, const char *aside, camera_fault *fault);

/** The vertical field of view of a horizontal one, degrees, which triangles can have. */
bool camera_vertical(double fov_x, int width, int height, double *fov_y, camera_fault *fault);

#endif
