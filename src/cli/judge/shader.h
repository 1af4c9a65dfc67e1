/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file shader.h  A function in a shader file, run on the device at hand: pairs of it. */
#ifndef CLI_JUDGE_SHADER_H
#define CLI_JUDGE_SHADER_H

#include "cli/option/options.h"
#include "judge/judge.h"

enum { SHADER_TEXT_SIZE = 1024 };

typedef struct shader {
    const options *o;
    void *run;                     /**< what is run */
    bool camera;                   /**< it is given something of the camera at hand */
    char device[SHADER_TEXT_SIZE]; /**< "": not run yet */
    char defines[SHADER_TEXT_SIZE];
    char open[SHADER_TEXT_SIZE]; /**< why what it computes may not be what is meant; "": it is */
    uint64_t count;              /**< depths that it was run with */
    bool too_long;               /**< more take too long */
} shader;

/** Reads and compiles the operand. @return EXIT_FINE, or as a command does */
int shader_open(const options *o, const dp_setup *setup, shader *out);

/** Depths in, so many of each kind: pairs of each kind, without NaN. */
int shader_pairs(shader *s, const float *in, size_t count, size_t kinds, judge_pairs out[]);

/** All codes of the format, or many of them, as what is named takes them. */
int shader_all(shader *s, judge_pairs *pairs, judgement *out);

void shader_close(shader *s);

#endif
