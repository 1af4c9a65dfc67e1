/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file append.h  Text that is put together piece by piece in a buffer of fixed size. */
#ifndef REPORT_APPEND_H
#define REPORT_APPEND_H

#include <stddef.h>

/** Adds to the text in `out`, which has `size` bytes and ends in a null; what does not fit is cut off. */
void append(char *out, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
