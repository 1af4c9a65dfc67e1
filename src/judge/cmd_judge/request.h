/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  Functions of somebody's, and what judge is asked. */
#ifndef JUDGE_CMD_JUDGE_REQUEST_H
#define JUDGE_CMD_JUDGE_REQUEST_H

#include "cli/output/output.h"

enum { JUDGE_DEFINES_MAX = 16, JUDGE_MINE_MAX = 8 };

typedef struct judge_asked {
    const char *pairs;                      /**< file of pairs; null when not given */
    unsigned depths;                        /**< how many are printed to ask for; 0 when not given */
    const char *defines[JUDGE_DEFINES_MAX]; /**< NAME=VALUE */
    size_t define_count;
    const char *mine[JUDGE_MINE_MAX]; /**< FILE:FUNCTION */
    size_t mine_count;
    const char *device; /**< what runs them; null when not given */
} judge_asked;

extern const option_table judge_options;

/** The options that figures and methods take. */
extern const option_use judge_mine[];

typedef struct judge_request {
    CAMERA_REQUEST;
    judge_asked judge;
} judge_request;

option_parser parse_define; /**< see shader.c */

#endif
