/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file dynload.h  Libraries that are opened when a file of their kind is named: the program runs without them. */
#ifndef SYSTEM_DYNLOAD_H
#define SYSTEM_DYNLOAD_H

#include <stdbool.h>
#include <stddef.h>

typedef struct library {
    const char *kind;           /**< of what needs it: "EXR" */
    const char *files[3];       /**< one after the other is tried, up to null */
    const char *package;        /**< Debian's, that has it */
    const char *const *symbols; /**< up to null */
} library;

/** A function of some library. */
typedef void dynload_function(void);

/** From a list of at most 64 functions, LIST(X) with X(name) for each: `functions`, to call them by name, and
 * `symbols`, their names in the same order. */
#define DYNLOAD_FUNCTIONS(LIST)                                                                                        \
    DYNLOAD_CALLS(LIST)                                                                                                \
    static const char *const symbols[] = {LIST(DYNLOAD_NAME) NULL};
/** The first of both alone, for a header. */
#define DYNLOAD_CALLS(LIST)                                                                                            \
    typedef union functions {                                                                                          \
        struct {                                                                                                       \
            LIST(DYNLOAD_MEMBER)                                                                                       \
        };                                                                                                             \
        dynload_function *all[64];                                                                                     \
    } functions;
#define DYNLOAD_MEMBER(name) __typeof__(name) *name;
#define DYNLOAD_NAME(name)   #name,

enum { DYNLOAD_ERROR_SIZE = 192 };

/** Opens the library, which then stays open, and finds its symbols. @return false with a sentence in `error` */
bool dynload_open(const library *l, dynload_function *functions[], char error[DYNLOAD_ERROR_SIZE]);

#endif
