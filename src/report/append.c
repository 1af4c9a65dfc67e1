/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/append.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void append(char *out, size_t size, const char *format, ...) {
    const size_t used = strlen(out);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(out + used, size - used, format, arguments);
    va_end(arguments);
}
