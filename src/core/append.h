/* SPDX-License-Identifier: MIT */
/* For the rooms above: text that is put together piece by piece in a buffer of fixed size. */
#ifndef CORE_APPEND_H
#define CORE_APPEND_H

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* Adds to the text in `out`, which has `size` bytes and ends in a null; what does not fit is cut off. */
__attribute__((format(printf, 3, 4))) static inline void append(char *out, size_t size, const char *format, ...) {
    const size_t used = strlen(out);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(out + used, size - used, format, arguments);
    va_end(arguments);
}

#endif
