/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file apart.h  Work of a library or driver that may crash or never end, in a process of its own.
 *
 *     FILE *made;
 *     const apart_end end = apart_run(work, &of, (apart_limits){.processor = 60}, &made);
 *     if (end == APART_DONE)
 *         ...                            // read what it wrote, as a file is read: nothing of it is trusted
 *     apart_close(made);
 */
#ifndef OPENED_APART_H
#define OPENED_APART_H

#include <stdbool.h>
#include <stdio.h>

/** Seconds after which the process is ended; 0: never. */
typedef struct apart_limits {
    unsigned processor; /**< of processor time */
    unsigned wall;      /**< as a clock counts: for what waits and does nothing */
} apart_limits;

typedef enum apart_end {
    APART_DONE = 0,
    APART_NO_FILE,    /**< no file for what it writes: errno */
    APART_NO_PROCESS, /**< no process: errno */
    APART_ENDLESS,    /**< it reached a limit */
    APART_BROKEN      /**< a signal ended it, or work() was false */
} apart_end;

/**
 * Runs work(of, out) in a child whose stdout and stderr are for nobody, and waits for it. Where this process is killed,
 * the child ends soon after its limits.
 *
 * @param made  receives the file that `out` is, at its beginning; null where there is none
 */
apart_end apart_run(bool (*work)(void *of, FILE *out), void *of, apart_limits limits, FILE **made);

/** Null is allowed. */
void apart_close(FILE *made);

#endif
