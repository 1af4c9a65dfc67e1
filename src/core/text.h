/* SPDX-License-Identifier: MIT */
/* Names: ASCII only and independent of the locale, which a library must not rely on. */
#ifndef CORE_TEXT_H
#define CORE_TEXT_H

#include <stddef.h>

static inline char dp_lower(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

/* Whether `name` is the first `length` characters of `word`, letter case ignored. */
static inline int dp_same_word(const char *name, const char *word, size_t length) {
    size_t i = 0;
    while (i < length && name[i] != '\0' && dp_lower(name[i]) == dp_lower(word[i]))
        i++;
    return i == length && name[i] == '\0';
}

/* Whether `name` is one of the words, separated by one space, of `words`. */
static inline int dp_word_among(const char *name, const char *words) {
    while (*words != '\0') {
        size_t length = 0;
        while (words[length] != '\0' && words[length] != ' ')
            length++;
        if (length > 0 && dp_same_word(name, words, length))
            return 1;
        words += length + (words[length] == ' ');
    }
    return 0;
}

#endif
