/* SPDX-License-Identifier: MIT */
/* For the rooms above: text that is put together piece by piece in a buffer of fixed size. */
#ifndef CORE_APPEND_H
#define CORE_APPEND_H

#include <stdarg.h>
#include <stdbool.h>
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

/* Length of the valid UTF-8 at `text` (no overlong forms, no surrogates), 0 when there is none. */
static inline size_t text_utf8(const char *text) {
    const unsigned char *s = (const unsigned char *)text;
    if (s[0] < 0x80)
        return 1;
    size_t length = s[0] >= 0xC2 && s[0] < 0xE0   ? 2
                    : s[0] >= 0xE0 && s[0] < 0xF0 ? 3
                    : s[0] >= 0xF0 && s[0] < 0xF5 ? 4
                                                  : 0;
    for (size_t i = 1; i < length; i++)
        if ((s[i] & 0xC0) != 0x80)
            return 0;
    if ((s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xED && s[1] > 0x9F) || (s[0] == 0xF0 && s[1] < 0x90) ||
        (s[0] == 0xF4 && s[1] > 0x8F))
        return 0;
    return length;
}

/* The same of a character that is no control, 0 of one that is. */
static inline size_t text_character(const char *text) {
    const unsigned char *s = (const unsigned char *)text;
    const bool control = s[0] < 0x20 || s[0] == 0x7F || (s[0] == 0xC2 && s[1] < 0xA0);
    return control ? 0 : text_utf8(text);
}

#endif
