/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file check.h  Requirements judged: a verdict each, found with the cheapest analysis that can decide.
 *
 *     separation  the largest dp_separation() at the depths asked about, of slanted surfaces where the camera says
 *                 what draws them. Models float and auto judge alike, by the guarantee; with auto the lattice comes
 *                 first, which passes nothing: no model's separation is below it, so all refuse what it refuses.
 *
 *     error       dp_worst_over(), or the error at a single depth; model auto: in the model staged, or of the shader
 *
 *     bias        bias_judge(), facing the camera and, where the camera says what draws surfaces, at any slant or for
 *                 the slope that is given
 *
 *     ties        none for certain where the guarantee is below one binary32 step of z; else counted, depth by depth,
 *                 or drawn at random where the range holds more than CHECK_CENSUS_MAX depths
 */
#ifndef SOLVE_CHECK_H
#define SOLVE_CHECK_H

#include "bias/verdict.h"
#include "solve/requirement.h"

enum { CHECK_CENSUS_MAX = 1 << 28, CHECK_SAMPLE = 1 << 24, CHECK_SEED = 1 };

/** The methods that decide, the cheapest first. */
typedef enum check_method {
    CHECK_LATTICE = 0, /**< the exact model */
    CHECK_STAGED,
    CHECK_GUARANTEE, /**< forward error analysis of the binary32 arithmetic */
    CHECK_CENSUS,    /**< every depth of the range */
    CHECK_SAMPLED,   /**< so many drawn at random: not certain */
    CHECK_METHOD_COUNT
} check_method;

typedef struct check_verdict {
    const need *asked;
    const need_camera *camera;
    dp_setup setup; /**< in the model that decided */
    check_method method;
    bias_answer answer; /**< of a bias; `value` is then the least units that are enough, beside that factor, else NaN */
    double factor;
    bool sloped;   /**< of a bias: decided for its slope */
    double value;  /**< at z; where `separation` decided over a range, all others are at most 2^-10 above it */
    double z;      /**< the depth where it is worst; NaN where there is none to name */
    uint32_t code; /**< stored there; of no meaning where z is NaN or infinite */
    bool passed;
} check_verdict;

/** Whether surfaces at any slant that the camera names are meant, z the farther one; else those that face the camera.
 */
bool check_is_slanted(const check_verdict *verdict);

/** A few words, "guaranteed separation"; null when out of range. */
const char *check_method_name(check_method method);

/**
 * Counts pairs in the wrong order over a range: *share of ties and swaps, and the depth in the band where the share is
 * greatest. Given by the caller, because the census is a layer of its own. @return false when stopped or out of memory
 */
typedef bool check_counter(void *context, const dp_setup *setup, double lo, double hi, bool sample, double *share,
                           double *z);

typedef struct check_request {
    const need_file *file;
    check_counter *count;
    void *context;
} check_request;

/** How many verdicts a file has: one a requirement and set-up of its camera. */
size_t check_count(const need_file *file);

/** Judges all, in the order of the file. @return the number that failed, or -1 when counting was stopped */
long check_all(const check_request *request, check_verdict *out);

#endif
