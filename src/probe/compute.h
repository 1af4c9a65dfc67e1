/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file compute.h  A function of somebody's, compiled and run over depths on the device at hand. */
#ifndef PROBE_COMPUTE_H
#define PROBE_COMPUTE_H

#include "probe/shot.h"

enum {
    COMPUTE_CONSTANTS = 256,
    COMPUTE_FEW = 65536,
    COMPUTE_TIMED_MOST = 32,
    COMPUTE_TIMES = 15,
    COMPUTE_SECONDS = 10, /**< of processor time, for few depths, */
    COMPUTE_ALL_SECONDS = 30,
    COMPUTE_WAIT_SECONDS = 120, /**< as a clock counts, for a GPU that works meanwhile */
    COMPUTE_ERROR_SIZE = 512,
    COMPUTE_NAME_SIZE = 64
};

/** A compute shader with depths at binding 0, what it gives at binding 1, and constants at binding 2. */
typedef struct compute_run {
    uint32_t *code; /**< SPIR-V, malloc'ed */
    size_t size;    /**< bytes */
    char entry[COMPUTE_NAME_SIZE];
    uint32_t group; /**< depths that a workgroup takes */
    float constants[COMPUTE_CONSTANTS];
    const float (*cameras)[COMPUTE_CONSTANTS]; /**< in their place those of one camera after another, */
    uint64_t each;                             /**< each for so many depths; 0: no such */
    uint64_t count;
    unsigned turns; /**< how often it calls the function for each depth, where it is timed, in turns of a loop whose
                         number is the last constant; else 0 */
    float (*depth)(const void *of, uint64_t i); /**< asked for in the child, and where its values are read */
    const void *of;
} compute_run;

/** GLSL or HLSL, into SPIR-V. @return false with glslangValidator's first error, whose line is in `*line`, else 0 */
bool compute_compile(const char *text, bool hlsl, compute_run *run, unsigned *line, char error[COMPUTE_ERROR_SIZE]);

/** Looks into SPIR-V for its entry point and workgroup. */
bool compute_look(compute_run *run, char error[COMPUTE_ERROR_SIZE]);

/**
 * Runs it in a process of its own, which is ended if the shader is not.
 * @param device   as of probe_run()
 * @param runs     0; or so many are timed in turns, and COMPUTE_TIMES times, ns a call of each, stand for values, as
 *                 double
 * @param values   receives a file whose next numbers are the `count` values, for sandbox_close(); null where it fails
 * @param endless  whether it was ended
 */
bool compute_values(const char *device, const compute_run *run, size_t runs, shot_machine *machine, FILE **values,
                    bool *endless, char error[COMPUTE_ERROR_SIZE]);

/** Runs in the child: values, or times where `runs` is not 0, go to `out`. */
bool shot_compute(const char *wanted, const compute_run *run, size_t runs, shot_machine *machine, FILE *out);

#endif
