/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file paste.h  What the users of an engine write to change its camera: a row each. */
#ifndef CAMERA_PASTE_H
#define CAMERA_PASTE_H

#include "camera/presets.h"

/** Whose code is written, and the scene unit of lengths, null where nothing says what that is. */
typedef struct paste {
    const preset *engine; /**< null: none */
    const unit_row *unit;
} paste;

/** Writes what moves the near plane there to `value`, a number of scene units. @return out; null where no row says it,
 * or the engine counts in another unit */
const char *paste_near(const paste *p, const char *value, char *out, size_t size);

/** Code that reverses depth there; null where no row says it. */
const char *paste_reversed(const paste *p);

/** The presets whose users write so, names parted by blanks; null beyond the last row. */
const char *paste_presets(size_t i);

#endif
