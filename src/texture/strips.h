/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file strips.h  Work in strips, on several threads: handed out one by one, taken in order.
 *
 * A thread that finished a strip begins the next one, and none waits for another but where it is a whole round ahead of
 * what was taken: then it sleeps. So a core that is busy elsewhere delays its own strip and nothing else.
 */
#ifndef TEXTURE_STRIPS_H
#define TEXTURE_STRIPS_H

#include <stdbool.h>
#include <stddef.h>

typedef struct strips {
    size_t count;
    int threads;  /**< at most; the caller's is one of them. Fewer run where there are fewer strips */
    size_t slots; /**< strips that may be made and not yet taken; those of a round lie in slots 0 to slots - 1 */
    /** Makes strip `index` into a slot. `thread`, from 0 on, is whose room it works in. */
    void (*make)(void *context, size_t index, size_t slot, int thread);
    /** Takes it, in order, one thread at a time, whichever is there. Null: nothing is taken, and no slot waited for.
     * @return false to stop */
    bool (*take)(void *context, size_t index, size_t slot);
    void *context;
} strips;

/** How many threads there are for `wanted`, 0 being as many as there are cores. */
int strips_threads(int wanted);

/** @return false where it was stopped */
bool strips_run(const strips *s);

#endif
