/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file sandbox.h  Work of a library or driver that may crash or never end, in a process of its own.
 *
 *     FILE *made;
 *     const sandbox_end end = sandbox_run(work, &of, (sandbox_limits){.processor = 60}, &made);
 *     if (end == SANDBOX_DONE)
 *         ...                            // read what it wrote, as a file is read: nothing of it is trusted
 *     sandbox_close(made);
 */
#ifndef SYSTEM_SANDBOX_H
#define SYSTEM_SANDBOX_H

#include <stdbool.h>
#include <stdio.h>

/** Seconds after which the process is ended; 0: never. */
typedef struct sandbox_limits {
    unsigned processor; /**< of processor time */
    unsigned wall;      /**< as a clock counts: for what waits and does nothing */
} sandbox_limits;

typedef enum sandbox_end {
    SANDBOX_DONE = 0,
    SANDBOX_NO_FILE,    /**< no file for what it writes: errno */
    SANDBOX_NO_PROCESS, /**< no process: errno */
    SANDBOX_ENDLESS,    /**< it reached a limit */
    SANDBOX_BROKEN      /**< a signal ended it, or work() was false */
} sandbox_end;

/**
 * Runs work(of, out) in a child whose stdout and stderr are for nobody, and waits for it. Where this process is killed,
 * the child ends soon after its limits.
 *
 * @param made  receives the file that `out` is, at its beginning; null where there is none
 */
sandbox_end sandbox_run(bool (*work)(void *of, FILE *out), void *of, sandbox_limits limits, FILE **made);

/** Null is allowed. */
void sandbox_close(FILE *made);

#endif
