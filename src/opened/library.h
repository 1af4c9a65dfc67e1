/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file library.h  Libraries that are opened when a file of their kind is named: the program runs without them. */
#ifndef OPENED_LIBRARY_H
#define OPENED_LIBRARY_H

#include <stdbool.h>
#include <stddef.h>

typedef struct library {
    const char *kind;           /**< of file: "EXR" */
    const char *files[3];       /**< one after the other is tried, up to null */
    const char *package;        /**< Debian's, that has it */
    const char *const *symbols; /**< up to null */
} library;

/** A function of some library. */
typedef void library_function(void);

/** From a list of at most 64 functions, LIST(X) with X(name) for each: `functions`, to call them by name, and
 * `symbols`, their names in the same order. */
#define LIBRARY_FUNCTIONS(LIST)                                                                                        \
    typedef union functions {                                                                                          \
        struct {                                                                                                       \
            LIST(LIBRARY_MEMBER)                                                                                       \
        };                                                                                                             \
        library_function *all[64];                                                                                     \
    } functions;                                                                                                       \
    static const char *const symbols[] = {LIST(LIBRARY_NAME) NULL};
#define LIBRARY_MEMBER(name) __typeof__(name) *name;
#define LIBRARY_NAME(name)   #name,

enum { LIBRARY_ERROR_SIZE = 192 };

/** Opens the library, which then stays open, and finds its symbols. @return false with a sentence in `error` */
bool library_open(const library *l, library_function *functions[], char error[LIBRARY_ERROR_SIZE]);

#endif
