/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file posix.h  What the program calls of POSIX beyond what every C library has. It is the system's own, but on
 * Windows, where src/windows makes it.
 */
#ifndef SYSTEM_POSIX_H
#define SYSTEM_POSIX_H

#include <fcntl.h>
#include <locale.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#ifdef _WIN32
#include "windows/posix.h"
#else
#define PATH_ENDS_FOLDER "/"
#endif

/** The name in a path, behind its folders. */
static inline const char *path_name(const char *path) {
    const char *name = path;
    for (; *path != '\0'; path++)
        if (strchr(PATH_ENDS_FOLDER, *path) != NULL)
            name = path + 1;
    return name;
}

/** Does the path say of itself where it is? */
static inline bool path_is_absolute(const char *path) {
    const size_t drive = path[0] != '\0' && path[1] == ':' ? 1 : 0;
    return path[0] != '\0' && strchr(PATH_ENDS_FOLDER, path[drive]) != NULL;
}

#endif
