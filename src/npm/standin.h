/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file standin.h  What the C library for modules may lack of what src/scene/find.c sorts by. */
#ifndef NPM_STANDIN_H
#define NPM_STANDIN_H

#include <stddef.h>

/** glibc's. */
void qsort_r(void *base, size_t count, size_t size, int (*compare)(const void *, const void *, void *), void *context);

#endif
