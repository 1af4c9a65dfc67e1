/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file pixels.h  Pixels as PNG: a whole figure, or the picture inside of one. */
#ifndef DRAW_PIXELS_H
#define DRAW_PIXELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "draw/notes.h"

/** Rows of width pixels 0xAARRGGBB from the top, `stride` pixels apart. */
typedef struct pixels {
    const uint32_t *at;
    size_t stride;
    int width, height;
    bool holes; /**< a pixel is opaque or 0, which is none; else the highest byte says nothing */
} pixels;

/** @param words  as iTXt chunks before the pixels; or null. @return false when it cannot be written */
bool pixels_write_png(FILE *out, const pixels *p, const notes *words);

#endif
