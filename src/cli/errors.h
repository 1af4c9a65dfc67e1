/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file errors.h  Faults of a command line: one line on stderr. */
#ifndef CLI_ERRORS_H
#define CLI_ERRORS_H

#include <stdarg.h>
#include <stddef.h>

/** Prints "depthprec: " and the rest, one line, on stderr. @return EXIT_USAGE */
int usage_error(const char *format, ...) __attribute__((format(printf, 1, 2)));

/** Writes the last of them as JSON on stdout: {"schema", "command", "version", "error": {"option", "text", "status"}}.
 */
void error_write_json(const char *command, int status);

/** The same, with "--OPTION: " before the rest unless `option` is null. */
int named_error(const char *option, const char *format, va_list arguments) __attribute__((format(printf, 2, 0)));

enum { ERROR_WORD_SHOWN = 24, ERROR_WORD_SIZE = ERROR_WORD_SHOWN + 4 };

/** A word of anybody's file, fit to be printed: ASCII, its start where it is long. @return out */
const char *error_word(const char *word, size_t length, char out[ERROR_WORD_SIZE]);

#endif
