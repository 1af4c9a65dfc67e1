/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file mine.h  --mine: functions of somebody's in the chart. They are rows behind ours of linearize, whose values come
 * from the device at hand; how long they and ours take is measured there.
 */
#ifndef CLI_MINE_H
#define CLI_MINE_H

#include "cli/judge/shader.h"
#include "cli/methods.h"

typedef struct mine mine;

/** What is said of a row. */
typedef struct mine_row {
    const char *operand; /**< null: a row of ours */
    const judgement *judged;
    const shader *code;
    double ns, spread; /**< of a call; NaN: not timed */
} mine_row;

/**
 * Compiles and judges them; *asked is then of their family.
 * @param on_device  ours are those that GLSL has, and run there, too
 * @return EXIT_FINE, or as a command does
 */
int mine_open(const options *o, methods_asked *asked, bool on_device, mine **out);

/** Times all; what was measured is of no account where a function is not of eye depths, or knows one camera alone. */
int mine_end(mine *m, bench_result *results, stability_result *walked, size_t count);

/** EXIT_FINE, or what went wrong since. */
int mine_status(const mine *m);

mine_row mine_of(const mine *m, const method_row *row);

/** Where it ran, and how much of each time is that of the loop. */
const char *mine_device(const mine *m, double *loop);

/** Null is allowed. */
void mine_close(mine *m);

#endif
