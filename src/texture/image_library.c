/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/image_library.h"

#include <dlfcn.h>
#include <string.h>

bool image_library_open(const image_library *library, image_source *source, image_function *functions[]) {
    void *handle = NULL;
    for (size_t i = 0; handle == NULL && library->files[i] != NULL; i++)
        handle = dlopen(library->files[i], RTLD_NOW | RTLD_LOCAL);
    if (handle == NULL)
        return source_fail(source, "%s is read by a library that is not there, %s: Debian's package %s has it",
                           library->kind, library->files[0], library->package);
    for (size_t i = 0; library->symbols[i] != NULL; i++) {
        void *found = dlsym(handle, library->symbols[i]);
        if (found == NULL)
            return source_fail(source, "%s: %s has no %s", library->kind, library->files[0], library->symbols[i]);
        memcpy(&functions[i], &found, sizeof found); /* POSIX has functions and objects of one size */
    }
    return true;
}
