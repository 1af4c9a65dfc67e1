/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A reader that may crash or never end, in a process of its own: what it makes comes back, or a sentence does. */
#ifndef MODEL_SANDBOX_H
#define MODEL_SANDBOX_H

#include "model/source.h"

enum { SANDBOX_SECONDS = 60 /* of processor time, after which it is given up */ };

/* Reads with `read`, which gets a source of its own that is like `s`. What comes back is checked as a file is. */
bool model_sandboxed(model_source *s, bool (*read)(model_source *s, const char *extension), const char *extension);

#endif
