/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which part of a block large pages are asked for: the whole pages in it, and nothing that it shares with others. */
#include "support.h"

#ifdef __linux__
#include <sys/mman.h>

static uintptr_t asked_at;
static size_t asked_size;

static int note(const void *at, size_t size, int advice) {
    assert_int_equal(advice, MADV_HUGEPAGE);
    asked_at = (uintptr_t)at;
    asked_size = size;
    return 0;
}

#define madvise(at, size, advice) note(at, size, advice)
#endif

#include "system/pages.c"

#ifdef MADV_HUGEPAGE
/* The pages are counted one by one. */
TEST(whole_pages_of_a_block) {
    enum { PAGE = 2097152, MOST = 6 };
    rng r = rng_make("pages");
    int none = 0;
    for (int turn = 0; turn < 4000; turn++) {
        const uintptr_t edge = turn % 3 == 0 ? 0 : (uintptr_t)rng_below(&r, PAGE);
        const uintptr_t at = PAGE * (uintptr_t)(1 + rng_below(&r, 8)) + edge;
        const size_t more = turn % 5 == 0 ? 0 : rng_below(&r, PAGE);
        const size_t size = PAGE * rng_below(&r, MOST) + more;
        uintptr_t first = 0;
        size_t pages = 0;
        for (uintptr_t page = 0; page < 20; page++)
            if (page * PAGE >= at && (page + 1) * PAGE <= at + size) {
                first = pages == 0 ? page * PAGE : first;
                pages++;
            }
        asked_at = asked_size = 0;
        pages_large((void *)at, size);
        none += pages == 0;
        assert_int_equal(asked_at, first);
        assert_int_equal(asked_size, pages * PAGE);
    }
    assert_in_range(none, 1, 2000);
    asked_size = 0;
    pages_large(NULL, 8 * (size_t)PAGE);
    pages_large((void *)(uintptr_t)PAGE, 0);
    assert_int_equal(asked_size, 0);
}
#else
TEST(nothing_is_asked_elsewhere) {
    char block[16] = "kept";
    pages_large(block, sizeof block);
    assert_string_equal(block, "kept");
}
#endif
