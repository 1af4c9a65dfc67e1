/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "system/pages.h"

#include <stdint.h>

#ifdef __linux__
#include <sys/mman.h>
#endif

enum { LARGE = 1 << 21 };

void pages_large(void *at, size_t size) {
#ifdef MADV_HUGEPAGE
    /* Whole pages only: what the block shares with others stays as it is. */
    const size_t before = (size_t)(-(uintptr_t)at % LARGE);
    if (at != NULL && size >= before + LARGE)
        madvise((char *)at + before, (size - before) / LARGE * LARGE, MADV_HUGEPAGE);
#else
    (void)at;
    (void)size;
#endif
}
