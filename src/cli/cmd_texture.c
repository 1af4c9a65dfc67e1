/* SPDX-License-Identifier: GPL-3.0-or-later */
/* texture: a depth image, or a synthetic scene in its place. */
#include "cli/options.h"

int cmd_texture(const options *o);

int cmd_texture(const options *o) {
    (void)o;
    return usage_error("texture: not yet");
}
