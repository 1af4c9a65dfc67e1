/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file written.h  Cameras and limits as requirement files have them, see requirement.h, with all digits. */
#ifndef SOLVE_CMD_WRITTEN_H
#define SOLVE_CMD_WRITTEN_H

#include "depthprec/depthprec.h"
#include "raster/raster.h"
#include "report/output.h"

/** " = { ... };" behind a camera's name. Its view is written where it is judged, in the model float. @param model  its
 * word; @param raster  null where none is named */
void need_write_camera(output *out, const dp_spec *spec, const char *model, const raster_row *raster);

/** The same of a requirement: surfaces so far apart at depths from lo to hi. */
void need_write_separation(output *out, const char *camera, double lo, double hi, double separation);

#endif
