/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A fault of a camera by its option, which has hyphens where its key has underscores. */
#include <stdio.h>

#include "camera/cmd/camera.h"

int camera_refuse(const camera_fault *fault) {
    char name[16];
    snprintf(name, sizeof name, "%s", fault->key);
    for (char *c = name; *c != '\0'; c++)
        *c = *c == '_' ? '-' : *c;
    return option_error(name, "%s", fault->text);
}
