/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file depth_range.h  The depth range of a camera's viewport: what viewports and APIs take, and who knows 0 to 1
 * alone.
 *
 * Those that return false say why in *fault.
 */
#ifndef CAMERA_DEPTH_RANGE_H
#define CAMERA_DEPTH_RANGE_H

#include "bias/bias.h"
#include "camera/rules.h"

/** Whether its ends are what viewports take, and those of an API, null where none is known. */
bool camera_range_takes(const char *api, const double range[2], camera_fault *fault);

/** The second of these questions alone. */
bool camera_range_suits(const bias_api *api, const double range[2], camera_fault *fault);

/** Why a set-up of that range was refused; false, and nothing said, where it was not for that. */
bool camera_range_refused(const dp_spec *spec, dp_status status, camera_fault *fault);

#endif
