/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A fault of a camera by its option, which has hyphens where its key has underscores. */
#include <stdio.h>
#include <string.h>

#include "camera/cmd/camera.h"

const char *camera_option(const char *key, char out[CAMERA_NAME_SIZE]) {
    snprintf(out, CAMERA_NAME_SIZE, "%s%s", key, strcmp(key, "triangle") == 0 ? "-class" : "");
    for (char *c = out; *c != '\0'; c++)
        *c = *c == '_' ? '-' : *c;
    return out;
}

int camera_refuse(const camera_fault *fault) {
    char name[CAMERA_NAME_SIZE], text[CAMERA_FAULT_SIZE];
    return option_error(camera_option(fault->key, name), "%s", camera_fault_text(fault, "--", text));
}
