/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file shader.h  A function in a shader file, run on the device at hand: pairs of it. */
#ifndef JUDGE_CMD_JUDGE_SHADER_H
#define JUDGE_CMD_JUDGE_SHADER_H

#include "camera/cmd/setups.h"
#include "judge/cmd_judge/request.h"
#include "judge/judge.h"
#include "judge/written.h"
#include "probe/compute.h"

enum { SHADER_TEXT_SIZE = 1024 };

typedef struct shader {
    const judge_request *o;
    void *run, *timed; /**< what is run for its values, and to be timed */
    char *text;        /**< of the file; null: SPIR-V */
    const char *function;
    bool hlsl, given;              /**< given: by the user, and so may --define be */
    bool camera;                   /**< it is given something of the camera at hand */
    char device[SHADER_TEXT_SIZE]; /**< "": not run yet */
    char defines[SHADER_TEXT_SIZE];
    char open[SHADER_TEXT_SIZE]; /**< why what it computes may not be what is meant; "": it is */
    uint64_t most;               /**< depths that it is run with, of a format that has more */
    uint64_t count;              /**< depths that it was run with */
    bool too_long;               /**< more take too long */
    char own[WRITTEN_NAME_SIZE]; /**< the function, where FILE has one alone */
} shader;

/** Reads and compiles FILE:FUNCTION or FILE.spv, which must last. @return EXIT_FINE, or as a command does */
int shader_open(const judge_request *o, const dp_setup *setup, const char *operand, bool timed, shader *out);

/** The same of GLSL of ours, to be timed. @param asked  for values, too */
int shader_write(const judge_request *o, const dp_setup *setup, const char *text, const char *function, bool asked,
                 shader *out);

/** Number i of `count` window depths that part what is known: the ends, powers of two beside either, even steps. */
double shader_asked(unsigned i, unsigned count);

/** Asks it for such depths, and judges what it gives, NaN left out. @param open as of judge_function() */
int shader_judge(shader *s, const dp_setup *asked, size_t count, judge_open open, judge_pairs *pairs, judgement *out);

/** "minus eye depth from window depth: d3d, near 0.1, far 1000" */
void shader_say(const judge_request *o, const judge_candidate *c, char out[SETUP_LABEL_SIZE]);

/** Values for `each` depths with what it is given of one camera after another. */
int shader_values(shader *s, const dp_setup *cameras, size_t count, const float *in, size_t each, float *out);

/** Nanoseconds of a call, COMPUTE_TIMES of each that is timed in turns on the device, which the last of them is told.
 */
int shader_times(shader *const *all, size_t count, double (*out)[COMPUTE_TIMES]);

/** All codes of the format, or many of them, as what is named takes them. */
int shader_all(shader *s, judge_pairs *pairs, judgement *out);

void shader_close(shader *s);

#endif
