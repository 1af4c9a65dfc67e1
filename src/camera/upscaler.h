/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file upscaler.h  How far apart in depth two samples are taken to be two surfaces: what temporal upscalers ship.
 *
 * A sample of this frame and the one of the last frame that it came from are of one surface, or what was hidden has
 * come into view. Upscalers decide by a separation that is a share of the eye depth. Each form is a row, as it was
 * shipped.
 */
#ifndef CAMERA_UPSCALER_H
#define CAMERA_UPSCALER_H

#include <stddef.h>

#include "core/named.h"

/** Pixels and vertical angle of a view with square pixels. */
typedef struct upscaler_view {
    int width, height; /**< pixels */
    double fov_y;      /**< degrees, above 0 and below 180 */
} upscaler_view;

typedef struct upscaler_row {
    NAMED_FIELDS;                               /**< the note is the formula of the separation, scene units */
    double (*share)(const upscaler_view *view); /**< the separation over the eye depth */
} upscaler_row;

enum { UPSCALER_ROWS = 2 };

NAMED_ROWS(upscaler_row, upscaler);

#endif
