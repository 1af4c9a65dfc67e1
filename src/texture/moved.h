/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file moved.h  Bits of samples that were moved, or lost, on the way into an image of 8 or 16 bits: told by what it
 * does to differences of neighbours, and moved back where it can be.
 */
#ifndef TEXTURE_MOVED_H
#define TEXTURE_MOVED_H

#include "image/image.h"

typedef struct moved_row {
    const char *name;    /**< "rotated" */
    const char *note;    /**< what was done to the samples */
    const char *reading; /**< how --metric reads them; null: they are lost */
    const char *lattice; /**< of what is read; null: none is known */
    int bits;            /**< that they were rotated up by; 0: something else */
} moved_row;

const moved_row *moved_get(size_t index); /**< null beyond the last */

typedef struct moved {
    const moved_row *row; /**< null: nothing was moved */
    bool certain;         /**< else the samples may as well be what they are */
} moved;

/** Looks at integers. */
moved moved_find(const image *img);

/** Moves them back. @return false without memory, or where the image cannot be of this kind */
bool moved_undo(const moved_row *row, image *img);

#endif
