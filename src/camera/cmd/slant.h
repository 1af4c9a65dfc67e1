/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file slant.h  How reports name slanted triangles. */
#ifndef CAMERA_CMD_SLANT_H
#define CAMERA_CMD_SLANT_H

#include "camera/cmd/camera.h"
#include "camera/surfaces.h"
#include "report/number.h"
#include "report/report.h"

/** Triangles and rasterizer as JSON has them. */
typedef struct slant_fields {
    dp_triangles triangles;
    const char *raster; /**< null when none was named */
    const char *arith;
} slant_fields;

extern const column slant_columns[];
extern const column slant_view_columns[]; /**< of dp_triangles: the view that is assumed */

/** Columns of the separation guaranteed to surfaces that face the camera and to any asked for; text has the latter. */
#define GUARANTEES(type, facing, slanted, width, digits, its_when)                                                     \
    {FIELD(type, facing, "guarantee_facing", "scene"), .when = (its_when)}, {                                          \
        FIELD(type, slanted, "guarantee_slanted", "scene"), SHOWN("slanted", width, digits), .upward = true,           \
                                                                                             .when = (its_when)        \
    }

/** The word for the other guarantee, and what explains it; the page of the browser has the same. */
#define SLANT_FACING  "facing the camera"
#define SLANT_AS_WALL "as a wall straight ahead does"

/** The view that camera_assumed() assumes: "1920x1080, fov 60, 8 subpixel bits". @return out */
enum { SLANT_ASSUMED_SIZE = 80 };
const char *slant_assumed(const dp_triangles *t, char out[SLANT_ASSUMED_SIZE]);

/** Fills `out` from options that have a viewport. @return out; null without one */
const slant_fields *slant_fields_of(const camera_asked *c, slant_fields *out);

/** page_title() or page_line(). */
typedef void slant_line(page *p, const char *format, ...) __attribute__((format(printf, 2, 3)));

/**
 * Writes text above a set-up, or above several where it is null: view, grid and class, or why there is no guarantee;
 * nothing without a viewport.
 */
void slant_say(page *p, slant_line *line, const camera_asked *c, const dp_setup *setup);

#endif
