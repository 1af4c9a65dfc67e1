/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file pages.h  Large pages below large blocks of memory. */
#ifndef SYSTEM_PAGES_H
#define SYSTEM_PAGES_H

#include <stddef.h>

/**
 * Asks for large pages below a block that is about to be filled, for at each page that is touched first the system
 * halts the program and clears it: a block of 32 MiB takes 8,192 such halts of 4 KiB each, or 16. Systems that give
 * large pages without being asked, or never, are left alone, and so are blocks of less than some pages.
 * @param at    As malloc, calloc or realloc return it; null: nothing is asked.
 * @param size  Bytes.
 */
void pages_large(void *at, size_t size);

#endif
