/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "system/dynload.h"

#include <stdio.h>
#include <string.h>

#include "system/process.h"

bool dynload_open(const library *l, dynload_function *functions[], char error[DYNLOAD_ERROR_SIZE]) {
    void *handle = NULL;
    for (size_t i = 0; handle == NULL && l->files[i] != NULL; i++)
        handle = dlopen(l->files[i], RTLD_NOW | RTLD_LOCAL);
    if (handle == NULL) {
        snprintf(error, DYNLOAD_ERROR_SIZE, "%s needs a library that is not there, %s: Debian's package %s has it",
                 l->kind, l->files[0], l->package);
        return false;
    }
    for (size_t i = 0; l->symbols[i] != NULL; i++) {
        void *found = dlsym(handle, l->symbols[i]);
        if (found == NULL) {
            snprintf(error, DYNLOAD_ERROR_SIZE, "%s: %s has no %s", l->kind, l->files[0], l->symbols[i]);
            return false;
        }
        memcpy(&functions[i], &found, sizeof found); /* POSIX has functions and objects of one size */
    }
    return true;
}
