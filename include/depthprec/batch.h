/* SPDX-License-Identifier: MIT */
/**
 * @file batch.h  Whole arrays at a time: depths into codes and back, at the speed of the memory they lie in.
 *
 *     dp_batch batch;
 *     if (dp_batch_init(&batch, &setup, DP_TASK_CODE, DP_REAL_FLOAT, DP_WORD_32, dp_path_best()) == DP_OK)
 *         dp_batch_run(&batch, depths, codes, count);
 *
 * A path is the same arithmetic compiled for another instruction set. All paths give the same bits, those of the
 * scalar functions where a task says so. Codes are always the correctly rounded ones: a quick estimate with a proven
 * error decides nearly every element, and where it lies too near a rounding boundary dp_code() decides.
 */
#ifndef DEPTHPREC_BATCH_H
#define DEPTHPREC_BATCH_H

#include <stddef.h>
#include <stdint.h>

#include "depthprec/setup.h"
#include "depthprec/status.h"

DP_BEGIN

/** The operation on each element. Codes above code_max count as code_max in every task that reads codes. */
typedef enum dp_task {
    DP_TASK_CODE = 0, /**< eye depth to code, as dp_code(); outside [near, far] clamped, NaN as near */
    DP_TASK_EYE,      /**< code to eye depth: double as dp_stored(), bit for bit; float within DP_BATCH_EYE_ERROR,
                           INFINITY beyond the largest float */
    DP_TASK_WIDTH,    /**< code to cell width, within DP_BATCH_WIDTH_ERROR of dp_cell_of(); float: that, rounded */
    DP_TASK_ENCODE,   /**< window depth to code, as dp_format_encode(); outside [0, 1] clamped, NaN as 0 */
    DP_TASK_DECODE,   /**< code to window depth, as dp_format_value(); float: that, rounded */
    DP_TASK_LO,       /**< code to the nearest depth of its cell, as dp_cell_of(); float: that, rounded down, */
    DP_TASK_HI,       /**< to the farthest; float: that, rounded up */
    /* Eye depth to a number; NaN outside [near, far], but that the floats next to the planes count as these. */
    DP_TASK_WINDOW,     /**< to window depth, as dp_window(); float: that, rounded */
    DP_TASK_SEPARATION, /**< to the separation, as dp_separation() of the set-up; float: that, rounded up */
    DP_TASK_INTERVAL,   /**< to the width of its cell, as dp_cell_of(); float: that, rounded */
    DP_TASK_COUNT
} dp_task;

/** Relative error of an eye depth in float against dp_stored(): 3.1 units of 2^-24. */
#define DP_BATCH_EYE_ERROR 1.85e-7

/** Relative difference of a width in double from that of dp_cell_of(): 2^-49: fifteen roundings in the two. */
#define DP_BATCH_WIDTH_ERROR 1.78e-15

/** The type of depths and widths. */
typedef enum dp_real { DP_REAL_FLOAT = 0, DP_REAL_DOUBLE, DP_REAL_COUNT } dp_real;

/** The type of codes: uint16_t, for formats of at most 16 bits, or uint32_t. */
typedef enum dp_word { DP_WORD_16 = 0, DP_WORD_32, DP_WORD_COUNT } dp_word;

/** Instruction sets. BASELINE is what the library was compiled for and always there. */
typedef enum dp_path { DP_PATH_BASELINE = 0, DP_PATH_AVX2, DP_PATH_AVX512, DP_PATH_COUNT } dp_path;

/** The name of an instruction set, "baseline", "avx2" or "avx512"; null when out of range. */
DP_API const char *dp_path_name(dp_path path);

/** Whether this processor and this library have an instruction set: AVX2 with FMA and F16C; AVX-512 F, BW, DQ and VL
 * besides. */
DP_API int dp_path_available(dp_path path);

/** The fastest path that is available. */
DP_API dp_path dp_path_best(void);

/** A prepared task. Made by dp_batch_init() and only read; may be copied, and used by many threads at once. */
typedef struct dp_batch {
    dp_setup setup;
    dp_task task;
    dp_real real;
    dp_word word;
    dp_path path;
    size_t in_size, out_size; /**< bytes of an element read and of one written */
    uint64_t opaque[48];      /* private to the library */
} dp_batch;

/**
 * Prepares a conversion of arrays, such as eye depths to codes. ENCODE and DECODE read only the set-up's format and
 * rounding; a task without codes leaves the word unread.
 *
 * CODE, WIDTH, LO and HI in the models `staged` and `float`, and these and EYE of logarithmic mappings, have no vector
 * kernel, nor have EYE, LO and HI of orthographic planes with depth 0 between them and the tasks behind HI: each
 * element then costs what the scalar function does.
 *
 * @return DP_OK; DP_ERROR_NULL; DP_ERROR_BATCH for a task, type or path that does not exist or is not available;
 *         DP_ERROR_FORMAT for DP_WORD_16 with a format of more bits. *batch is then left as it was
 */
DP_API dp_status dp_batch_init(dp_batch *batch, const dp_setup *setup, dp_task task, dp_real real, dp_word word,
                               dp_path path);

/**
 * Converts `count` elements of an array, which may be 0, as dp_batch_init() has prepared it.
 *
 * @param in   depths or codes, aligned to their type, no more
 * @param out  codes, or depths; the same address as `in` is allowed where an element written is not larger than one
 *             read. Any other overlap is not.
 *
 * Cost: one thread, no allocation, some 24 KiB of stack, for separations 64.
 */
DP_API void dp_batch_run(const dp_batch *batch, const void *in, void *out, size_t count);

/** The bytes that dp_batch_keep() takes. */
#define DP_BATCH_KEEP 40960

/**
 * Finds once what dp_batch_run() otherwise finds in each call that asks for thousands of separations, and too late for
 * fewer. It takes as long as one to three thousand of them one by one. It gains where they face a perspective in the
 * arithmetic ieee: reversed, or with far at most 1e5 near. Nothing of other tasks; results stay the same.
 * @param memory  DP_BATCH_KEEP bytes, aligned as a double, that live as long as the batch and its copies
 */
DP_API void dp_batch_keep(dp_batch *batch, void *memory);

/**
 * Window depths, as they are read back from a buffer or an image, to eye depths. Each counts as the nearest code,
 * whatever the set-up's rounding: a reader's own rounding is far below half a step. Outside [0, 1] they are clamped;
 * NaN gives NaN.
 * @param real         the type of all arrays
 * @param eye, lo, hi  as the tasks EYE, LO and HI have them; null for what is not wanted; none overlaps `windows`
 * @return DP_OK; DP_ERROR_NULL; DP_ERROR_BATCH for a type that does not exist; nothing is written then
 */
DP_API dp_status dp_batch_windows(const dp_setup *setup, dp_real real, const void *windows, void *eye, void *lo,
                                  void *hi, size_t count);

DP_END
#endif
