/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/shell_word.h"

#include <stdbool.h>
#include <string.h>

#include "core/append.h"

void append_shell_word(char *out, size_t size, const char *word) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+,.:/%@";
    const bool quoted = *word == '\0' || word[strspn(word, plain)] != '\0';
    append(out, size, quoted ? " '" : " ");
    for (; *word != '\0'; word++)
        append(out, size, *word == '\'' ? "'\\''" : "%c", *word);
    append(out, size, quoted ? "'" : "");
}
