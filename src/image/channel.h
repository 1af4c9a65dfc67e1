/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file channel.h  Names of the channels of an EXR file, "ViewLayer.Depth.Z": which of them mean depth. */
#ifndef IMAGE_CHANNEL_H
#define IMAGE_CHANNEL_H

#include <stdbool.h>
#include <stddef.h>

/** How a name is looked for: as it is, or in any case, or as the last part behind a dot, or as the layer of a number.
 */
typedef enum channel_likeness { CHANNEL_SAME = 0, CHANNEL_CASE, CHANNEL_LAST, CHANNEL_LAYER } channel_likeness;

bool channel_is(const char *name, const char *wanted, channel_likeness how);

/** Where the last part of a name begins, "Z" of "ViewLayer.Depth.Z". */
size_t channel_last(const char *name);

/** Whether it is called Z or depth, in any case, by its last part or its layer. */
bool channel_of_depth(const char *name);

/** Whether DWA takes it for a colour, which it loses some of; it takes what has other names as it is. */
bool channel_is_colour(const char *name);

#endif
