/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Strips: each is made once and taken once, in order, out of the slot that it was made in, whichever threads are slow;
 * a stop stops; and where nothing is taken no slot is waited for.
 */
#include <stdatomic.h>
#include <time.h>

#include "support.h"
#include "texture/strips.h"

enum { COUNT = 400, SLOTS = 7, THREADS = 4 };

typedef struct work {
    atomic_int made[COUNT], makers[THREADS], takers;
    size_t slot[SLOTS]; /* the strip that lies in it, + 1 */
    size_t next, stop_at;
    bool wrong;
} work;

static void wait_some(long nanoseconds) {
    nanosleep(&(struct timespec){0, nanoseconds}, NULL);
}

static void make(void *context, size_t index, size_t slot, int thread) {
    work *w = context;
    if (atomic_fetch_add(&w->makers[thread], 1) != 0) /* a room of its own */
        w->wrong = true;
    if (index % 50 == 3)
        wait_some(2000000); /* lost its core: the others go on */
    if (slot >= SLOTS || w->slot[slot] != 0)
        w->wrong = true;
    else
        w->slot[slot] = index + 1;
    atomic_fetch_add(&w->made[index], 1);
    atomic_fetch_sub(&w->makers[thread], 1);
}

static bool take(void *context, size_t index, size_t slot) {
    work *w = context;
    if (atomic_fetch_add(&w->takers, 1) != 0 || index != w->next++ || w->slot[slot] != index + 1)
        w->wrong = true;
    if (index % 90 == 5)
        wait_some(1000000);
    w->slot[slot] = 0;
    atomic_fetch_sub(&w->takers, 1);
    return index != w->stop_at;
}

TEST(strips_are_taken_in_order) {
    for (int threads = 1; threads <= THREADS; threads++)
        for (size_t slots = 1; slots <= SLOTS; slots += 2) {
            work w = {.stop_at = SIZE_MAX};
            assert_true(strips_run(&(strips){COUNT, threads, slots, make, take, &w}));
            assert_true(!w.wrong && w.next == COUNT);
            for (size_t i = 0; i < COUNT; i++)
                assert_int_equal(w.made[i], 1);
        }
}

TEST(a_stop_stops) {
    for (int threads = 1; threads <= THREADS; threads++) {
        work w = {.stop_at = 20};
        assert_false(strips_run(&(strips){COUNT, threads, SLOTS, make, take, &w}));
        assert_true(!w.wrong && w.next == 21);
        assert_int_equal(w.made[COUNT - 1], 0);
    }
}

static void count_made(void *context, size_t index, size_t slot, int thread) {
    work *w = context;
    (void)thread;
    w->wrong = w->wrong || slot != 0;
    atomic_fetch_add(&w->made[index], 1);
}

TEST(nothing_need_be_taken) {
    work w = {0};
    assert_true(strips_run(&(strips){COUNT, THREADS, 1, count_made, NULL, &w}));
    assert_false(w.wrong);
    for (size_t i = 0; i < COUNT; i++)
        assert_int_equal(w.made[i], 1);
    assert_true(strips_run(&(strips){0, THREADS, 1, count_made, take, &w}));
}
