/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file probe.h  What the GPU of this machine does to depth: drawn, read back, compared with what is known.
 *
 * A finding names the hypothesis that predicts every code that was stored. Where several do, or none, it says that:
 * no answer is a guess.
 */
#ifndef PROBE_PROBE_H
#define PROBE_PROBE_H

#include "probe/plan.h"

enum { PROBE_SECONDS = 60 /**< for all draws, after which the driver is given up */, PROBE_FINDINGS_MAX = 40 };

/** The device that stands for OpenGL; all others are Vulkan's. */
#define PROBE_OPENGL "gl"

typedef enum probe_certainty {
    PROBE_SURE = 0, /**< one hypothesis predicts every case, no other does */
    PROBE_OPEN,     /**< several predict every case: these draws do not tell them apart */
    PROBE_NO_ROW,   /**< none does */
    PROBE_MEASURED, /**< a number, no hypothesis */
    PROBE_CERTAINTIES
} probe_certainty;

/** "sure", "open", "no row", "measured". */
const char *probe_certainty_name(probe_certainty certainty);

enum { PROBE_WORDS_SIZE = 160 };

typedef struct probe_finding {
    const char *key;    /**< "rounding" */
    const char *format; /**< "d24"; null: of all, found in fp32 */
    char words[PROBE_WORDS_SIZE];
    probe_certainty sure;
    uint64_t cases, hits; /**< pixels compared, and predicted by what `words` says */
    const char *next;     /**< the hypothesis that comes next; null: none */
    uint64_t next_hits;
    double value;     /**< of PROBE_MEASURED; NaN: none */
    const char *unit; /**< of it; or null */
} probe_finding;

typedef struct probe_result {
    shot_machine machine;
    shot_plan plan; /**< with the raw codes */
    size_t count;
    probe_finding finding[PROBE_FINDINGS_MAX];
    const char *arith;  /**< a row for dp_arith_parse(), of every format that was measured; null: no row */
    const char *raster; /**< a row of raster_find(); null: no row */
} probe_result;

/**
 * Draws and judges. The driver runs in a process of its own, and is given up after PROBE_SECONDS.
 *
 * @param device  a number, or a part of a name in either case; null: the first that is no processor, else the first
 * @param seed    of the scene that is predicted
 * @param error   receives a sentence where it failed; result->machine then has the devices that were found
 */
bool probe_run(const char *device, uint64_t seed, probe_result *result, char error[SHOT_ERROR_SIZE]);

/** Frees a result, which may be null. */
void probe_free(probe_result *result);

/** "d16", "d24", "d32f". */
const char *probe_format_name(shot_format format);

#endif
