/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file surfaces.h  Of which surfaces something is said, in words: those that face the camera, or of which slants. */
#ifndef CAMERA_SURFACES_H
#define CAMERA_SURFACES_H

#include <stdbool.h>

#include "depthprec/triangles.h"

typedef struct surfaces_text {
    char text[48];
} surfaces_text;

/** "facing" without a viewport; else "any slant", "30 degrees" or "10 to 80 degrees", four digits of each. */
surfaces_text surfaces_words(const dp_triangles *t);

/** Whether the class has every slant, 0 to 90 degrees. */
bool surfaces_any_slant(const dp_triangles *t);

#endif
