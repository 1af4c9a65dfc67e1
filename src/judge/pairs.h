/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file pairs.h  Pairs of what went into a function and what came out, as text or npy. */
#ifndef JUDGE_PAIRS_H
#define JUDGE_PAIRS_H

#include <stdbool.h>
#include <stddef.h>

enum { PAIRS_ERROR_SIZE = 256, PAIRS_MOST = 1 << 24 };

typedef struct judge_pair {
    double in, out;
} judge_pair;

/** The largest error of numbers as they were printed. */
typedef struct judge_digits {
    double absolute, relative;
} judge_digits;

typedef struct judge_pairs {
    judge_pair *pairs; /**< malloc'ed; both are numbers, `out` may be infinite */
    size_t count, distinct;
    size_t nan_count; /**< left out: the value is no number, the first */
    double nan_at;    /**< here */
    judge_digits in_digits, out_digits;
    /** All values are numbers of binary16; shares of 255; whole numbers; from 0 to about 1. */
    bool half, bytes, whole, shares;
} judge_pairs;

/**
 * Two columns parted by commas, semicolons or blanks; lines without two numbers at the top are titles, # begins a
 * remark. An npy file has two columns, or rows. "-" is stdin, as text.
 * @return 0, or an errno, or -1 with one sentence in `error`
 */
int judge_pairs_read(const char *path, judge_pairs *out, char error[PAIRS_ERROR_SIZE]);

/** Sorts pairs that are put together, and sees what their values are. */
void judge_pairs_look(judge_pairs *pairs);
void judge_pairs_free(judge_pairs *pairs);

#endif
