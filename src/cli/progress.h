/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file progress.h  A bar on stderr, for work that lasts: on a terminal, after half a second, never with --quiet.
 *
 *     progress p = progress_start("rows", total, o->quiet);
 *     for (...) progress_step(&p, done);       // cheap: the clock is read only now and then
 *     progress_end(&p);                        // wipes the bar
 */
#ifndef CLI_PROGRESS_H
#define CLI_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct progress {
    const char *what; /**< what is counted, "rows" */
    uint64_t total;
    uint64_t next; /**< the count at which the clock is read again */
    uint64_t stride;
    double start, shown; /**< seconds of the monotonic clock */
    bool drawn;
} progress;

progress progress_start(const char *what, uint64_t total, bool quiet);

/** Draws when it is time; not for use outside progress_step(). */
void progress_draw(progress *p, uint64_t done);

static inline void progress_step(progress *p, uint64_t done) {
    if (done >= p->next)
        progress_draw(p, done);
}

void progress_end(progress *p);

#endif
