/* SPDX-License-Identifier: MIT */
/**
 * @file format.h  Depth formats: which numbers in [0, 1] a depth buffer can hold.
 *
 * A format is a row. There are two kinds, and every format, real or made up for teaching, is one of them:
 *
 *     UNORM of N bits      code c stands for c / (2^N - 1)
 *     FLOAT of E.M bits    an unsigned float with bias B, subnormals kept, no infinities:
 *                          m 2^(1-B-M) in the lowest binade, (2^M + m) 2^(e-B-M) above it
 *
 * and rg, a UNORM of code_max 65025: what Unity's EncodeFloatRG leaves of eye depth over far (the mapping linear) in
 * two channels of 8 bits, rounded to nearest. Its code is 255 times the first channel plus the second, but that of far
 * is stored as 0: frac(255) is 0, and so is frac(1).
 *
 * Codes of either kind are ordered as their values are, 0 stores 0 and code_max stores 1. For fp16 and fp32 the
 * code is the IEEE 754 bit pattern.
 */
#ifndef DEPTHPREC_FORMAT_H
#define DEPTHPREC_FORMAT_H

#include <stddef.h>
#include <stdint.h>

#include "depthprec/status.h"

DP_BEGIN

typedef enum dp_format_kind { DP_FORMAT_UNORM = 0, DP_FORMAT_FLOAT } dp_format_kind;

/** How a depth between two codes is rounded. */
typedef enum dp_rounding {
    DP_ROUND_NEAREST =
        0,         /**< UNORM: ties up, floor(d M + 0.5) (D3D 11.3 functional spec 3.2.3.6); FLOAT: ties to even */
    DP_ROUND_EVEN, /**< ties to the even code in either kind */
    DP_ROUND_ZERO, /**< truncated (D3D 11.3 functional spec 3.2.2, for a float to a smaller float) */
    DP_ROUNDING_COUNT
} dp_rounding;

enum { DP_FORMAT_NAME_SIZE = 16 };

/** One format. Make it with dp_format_parse(); the fields are for reading. */
typedef struct dp_format {
    char name[DP_FORMAT_NAME_SIZE]; /**< the canonical name, "unorm24", "float3.3b5" */
    dp_format_kind kind;
    int bits;          /**< bits of the code that carry depth: N, or E + M; of rg 16 */
    int exponent_bits; /**< FLOAT: E, 2 to 8; else 0 */
    int mantissa_bits; /**< FLOAT: M, 1 to 23; else 0 */
    int bias;          /**< FLOAT: B, 1 to 2^E - 1; else 0 */
    uint32_t code_max; /**< the code of 1, so there are code_max + 1 codes in [0, 1] */
} dp_format;

/** A named format with what is claimed of it. The claims are what the tests hold the code to. */
typedef struct dp_format_row {
    dp_format format;
    const char *aliases;   /**< other accepted spellings, separated by one space */
    double claim_absolute; /**< |value - d| of a nearest rounding is at most claim_absolute + claim_relative d */
    double claim_relative;
    int buffer;            /**< some API has it as a depth buffer */
    int bytes;             /**< per pixel, with the padding that it is stored with */
    int rank;              /**< orders equal bytes: 0 is to be had everywhere */
    const char *available; /**< which APIs have it */
    const char *caution;   /**< what is easily overlooked about that, one line; "" when nothing */
    const char *note;
    const char *source; /**< paper, specification clause */
} dp_format_row;

/** How many depth formats have a name and a row: fp16, fp32, unorm16, unorm24. */
DP_API size_t dp_format_count(void);

/** The row of a named depth format; null when out of range. */
DP_API const dp_format_row *dp_format_get(size_t index);

/**
 * Finds the formats that a name stands for: a canonical name, an alias in the spelling of an API (letter case is
 * ignored), "rg", "20e4" (D24FS8, float4.20b15), "unormN" with N = 1..32, or "floatE.M" or "floatE.MbB" with E = 2..8,
 * M = 1..23, B = 1..2^E-1 (2^(E-1)-1 if not given).
 *
 * @param out  receives the formats; "depth24plus" of WebGPU leaves the choice to the implementation and gives two
 * @return the number of formats, 1 or 2; 0 when the name is unknown or an argument is null
 */
DP_API size_t dp_format_parse(const char *name, dp_format out[2]);

/** The value of a code, in [0, 1], exact for FLOAT and correctly rounded for UNORM. code <= code_max. */
DP_API double dp_format_value(const dp_format *format, uint32_t code);

/**
 * The correctly rounded code of a window depth.
 *
 * @param d  window depth; below 0 and NaN are stored as 0, above 1 as 1, as the APIs clamp
 */
DP_API uint32_t dp_format_encode(const dp_format *format, dp_rounding rounding, double d);

/** The name of a rounding mode, "nearest", "even" or "zero"; null when out of range. */
DP_API const char *dp_rounding_name(dp_rounding rounding);

DP_END
#endif
