/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file mine.h  --mine: functions of somebody's in the chart. They are rows behind ours of linearize, whose values come
 * from the device at hand; how long they and ours take is measured there. --device alone: ours, of encode, too, whose
 * codes the device gives as numbers.
 */
#ifndef METHOD_CMD_METHODS_MINE_H
#define METHOD_CMD_METHODS_MINE_H

#include "judge/cmd_judge/shader.h"
#include "method/cmd_methods/methods.h"

/** A row of ours or theirs. */
typedef struct mine_row {
    struct mine *of;
    shader code;         /**< no text: it is not timed */
    double ns;           /**< of a call there; NaN: not timed */
    const char *operand; /**< null: of ours */
    judgement judged;    /**< of theirs */
    char name[96];
    struct seen *seen; /**< what it gave for which camera */
    size_t seen_count;
} mine_row;

/** The user's functions and the methods they are among. */
typedef struct mine {
    const judge_request *o;
    dp_setup setup;
    int status; /**< of what was run */
    method_family_row family;
    method_row rows[BENCH_METHODS_MAX];
    mine_row more[BENCH_METHODS_MAX + 1]; /**< of each row; behind them the loop in which they are timed */
    size_t count;
} mine;

/**
 * Compiles, judges and times them; *asked is then of their family.
 * @param on_device  ours are those that GLSL has, and run there, too
 * @return EXIT_FINE, or as a command does; *out is for mine_close() in any case
 */
int mine_open(const judge_request *o, methods_asked *asked, bool on_device, mine **out);

/** "llvmpipe (LLVM 15.0.6, 256 bits); llvmpipe, Mesa 22.3.6" */
const char *mine_device(const mine *m);

/** Null is allowed. */
void mine_close(mine *m);

#endif
