/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file drawn_truth.h  What figures ought to show, of the library's public functions: a drawn_truth each. */
#ifndef TESTS_DRAWN_TRUTH_H
#define TESTS_DRAWN_TRUTH_H

#include "depthprec/depthprec.h"
#include "drawn.h"

enum { DRAWN_CAMERAS = 16 };

/** Some set-ups of one camera, formats first, as the program orders them. */
typedef struct cameras {
    size_t count;
    dp_setup setups[DRAWN_CAMERAS];
    char names[DRAWN_CAMERAS][48]; /**< "unorm24 d3d" */
    const char *texts[DRAWN_CAMERAS];
} cameras;

/** @param formats, mappings  names with commas between */
cameras cameras_of(dp_spec spec, const char *formats, const char *mappings);

/** The default set-up with other planes; near <= 0: orthographic. */
dp_spec drawn_camera(double znear, double zfar);

/* The context of each is a dp_setup. */
bool true_error(const void *setup, double from, double to, double *lo, double *hi);      /**< of whole cells */
bool true_interval(const void *setup, double from, double to, double *lo, double *hi);   /**< of cells touched */
bool true_density(const void *setup, double from, double to, double *lo, double *hi);    /**< 1/interval */
bool true_separation(const void *setup, double from, double to, double *lo, double *hi); /**< the largest */
bool true_share(const void *setup, double from, double to, double *lo, double *hi);      /**< of the codes behind, % */
bool true_window(const void *setup, double from, double to, double *lo, double *hi);

#endif
