/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file convert.h  Depths that are copied from one format to another, and perhaps back: which codes come back, over all
 * of them.
 *
 * A copy reads a code as a number and writes the number as a code. Between two formats of hardware that is exact but
 * for one rounding. Shaders and programs compute in binary32 instead, with a factor of their own, and cut: each way is
 * a row. Into fp32, which shaders compute in, numbers are always rounded to the nearest.
 */
#ifndef CONVERT_CONVERT_H
#define CONVERT_CONVERT_H

#include <stdbool.h>
#include <stdint.h>

#include "core/named.h"
#include "depthprec/format.h"

/** A way to make a number of an integer code c, or a code of a number d. Of floats it is only how they are rounded. */
typedef struct convert_way {
    NAMED_FIELDS;
    bool scales; /**< a factor of somebody's may stand in place of the largest code */
    /** @param factor  binary32; the number that the code factor stands for is 1. @return NaN where it is exact */
    double (*read)(float code, float factor);
    /** @param factor  likewise @return the whole number; null: rounded by the format, or its bits are moved */
    double (*write)(float number, float factor);
    bool cuts;  /**< floats: towards 0 */
    bool moves; /**< the bits of an integer are moved to those of another */
    bool fills; /**< and the low bits filled with the high ones */
} convert_way;

NAMED_ROWS(convert_way, convert_read);
NAMED_ROWS(convert_way, convert_write);

/** A way, and its factor; 0: the largest code of the format. */
typedef struct convert_rule {
    const convert_way *way;
    double factor;
} convert_rule;

enum { CONVERT_FORMATS = 3, CONVERT_WAYS = 6 /* to write */ };

typedef struct convert_chain {
    dp_format format[CONVERT_FORMATS];
    int count;          /**< of formats, 2 or 3 */
    convert_rule read;  /**< of codes that are integers */
    convert_rule write; /**< into every format but fp32 */
    bool saturate;      /**< a whole number beyond the largest code becomes that; else its low bits are kept */
    bool flush;         /**< no format of floats has subnormals: they are 0 */
} convert_chain;

/** One code on its way. */
typedef struct convert_path {
    uint32_t code[CONVERT_FORMATS];
    double number;                  /**< that the first code is read as */
    double beyond[CONVERT_FORMATS]; /**< whole numbers that the format has no code for; NaN where none was */
    bool changed; /**< the last code is another than the first, or where the formats differ, another number */
} convert_path;

/** @param code  of the first format, at most its largest */
convert_path convert_code(const convert_chain *chain, uint32_t code);

typedef struct convert_found {
    uint64_t codes, changed;
    uint64_t beyond;    /**< of whole numbers that the last format has no code for */
    uint64_t merged;    /**< neighbours that become one code */
    uint64_t swapped;   /**< neighbours whose order turns around */
    convert_path first; /**< the first that changes, where one does */
    convert_path most;  /**< the first that changes by as many codes as any; where the last format is the first */
    uint32_t by;        /**< codes; 0 where the formats differ */
} convert_found;

/** Looks at every code of the first format. @param threads  0: as many as there are cores */
convert_found convert_all(const convert_chain *chain, int threads);

#endif
