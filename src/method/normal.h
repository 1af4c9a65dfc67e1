/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file normal.h  The normal family: normals of slanted planes, stored in a format and read back.
 *
 * Inputs come in strips of METHOD_STRIP pixels of a 1920 x 1080 image with a vertical field of view of 60 degrees, each
 * strip with a plane and a place in the image of its own, and with the pixels around it. Planes are slanted by up to 70
 * degrees from the line of sight and lie between near and far as far as the methods look.
 */
#ifndef METHOD_NORMAL_H
#define METHOD_NORMAL_H

#include "method/method.h"

enum { METHOD_STRIP = 64 };

/** How many eye depths `count` pixels have around them, themselves included. */
size_t normal_eyes(size_t count);

void normal_fill(const dp_setup *setup, method_inputs *in);

#endif
