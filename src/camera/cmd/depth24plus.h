/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file depth24plus.h  Who stores what for depth24plus, a format that leaves the choice to the browser. */
#ifndef CAMERA_CMD_DEPTH24PLUS_H
#define CAMERA_CMD_DEPTH24PLUS_H

#include "camera/cmd/camera.h"
#include "report/page.h"

/** A sentence where --format names depth24plus or depth24plus-stencil8 and no platform is named; else nothing. */
void depth24plus_say(page *p, const camera_asked *c);

#endif
