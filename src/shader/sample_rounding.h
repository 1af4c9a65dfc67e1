/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file sample_rounding.h  What a sample of an image says about the depth behind it: from which to which eye depth.
 *
 * A buffer rounds the depth to a code; the image may have rounded that again, to fewer values. So a sample stands for
 * a range of codes and each of these for its cell. How an image was rounded is not known unless it is said: to nearest,
 * cut off, or shifted out of more bits. All three leave the buffer's number v within
 *
 *     min(k - 1/2, k M/(M + 1))/M <= v < (k + 1)/M        sample k of steps of 1/M
 *
 * Bits that were shifted up may have been k/2^N or k/(2^N - 1): then v lies within either.
 *
 * Ranges end where window depth does, at 0 and 1, and not at the camera's near plane: that of a linear or logarithmic
 * mapping is no more than what somebody said about the image.
 */
#ifndef SHADER_SAMPLE_ROUNDING_H
#define SHADER_SAMPLE_ROUNDING_H

#include <math.h>
#include <stdbool.h>

#include "core/engine.h"
#include "depthprec/depthprec.h"

typedef enum grain_kind {
    GRAIN_CODES = 0, /**< samples are the buffer's codes */
    GRAIN_STEPS,     /**< samples are multiples of 1/steps */
    GRAIN_FLOATS     /**< samples are binary floating-point numbers of `bits` bits */
} grain_kind;

/** How an image was rounded. */
typedef enum grain_rounding { GRAIN_ANY = 0, GRAIN_NEAREST, GRAIN_ZERO } grain_rounding;

/** The levels to which depth was rounded before it became a sample of metric depth: they are even in eye depth or
 * in its inverse, or binary16. */
typedef enum grain_levels { GRAIN_FINE = 0, GRAIN_EVEN, GRAIN_INVERSE, GRAIN_HALF } grain_levels;

typedef struct grain {
    grain_kind kind;
    grain_rounding rounding;
    double steps; /**< GRAIN_STEPS: M, at least 1; need not be whole where bits were shifted out */
    double own; /**< GRAIN_STEPS: what they are multiples of in any case, where steps may be chance; 0: nothing more */
    double whole;  /**< GRAIN_STEPS: k may as well be k/whole: 2^N - 1 where N bits were shifted up; 0: not so */
    bool buffer;   /**< behind the image lies a buffer of the set-up's format; else the depth itself, or */
    bool mirrored; /**< GRAIN_STEPS: what was rounded falls where v rises, so that what is cut off lies below */
    double margin; /**< ... a finer buffer, whose cells reach so far beyond its numbers, window depth */
    int bits; /**< GRAIN_FLOATS: significant bits, 11, 24 or 53; GRAIN_STEPS: 0, or those that steps were rounded to */
    double least;        /**< the least subnormal */
    double between;      /**< of a linear mapping from the eye on alone: a depth was rounded to multiples of it, window
                              depth, before that; 0: it was not */
    grain_levels levels; /**< of a linear mapping from the eye on alone: what was rounded before, in the same way */
    double level;        /**< its step, of window depth or of the inverse of that; GRAIN_HALF: 1 as window depth */
} grain;

/** How far apart levels near v are, in what they are even in; GRAIN_HALF: in window depth. */
double grain_level_gap(const grain *g, double v);

/** GRAIN_STEPS and GRAIN_FLOATS: how far apart the numbers of the file near v are, and how many it has below v. */
double grain_number_gap(const grain *g, double v);
double grain_numbers_below(const grain *g, double v);

/** "unknown", "nearest", "zero". */
const char *grain_rounding_name(grain_rounding rounding);

/** GRAIN_FLOATS of a buffer of UNORM: within how many units in the last place a code came back as a number, and how
 * many codes on either side a number may so have been. */
double grain_quotient_units(const grain *g);
double grain_quotient_codes(const grain *g, const dp_format *format, double v);

/** Eye depths, scene units. */
typedef struct grain_range {
    double lo, hi; /**< within 2^-44 relative; hi may be INFINITY, and is where levels reach beyond the last code */
    double reach;  /**< from the depth that the code gives back to the farther end; never below that */
} grain_range;

/** Outweighs what is lost in window depths that were computed in double, a few units of 2^-53 of cells that are at
 * least 2^-25 of their depth, and all roundings of ranges. */
#define GRAIN_OUTWARD (1 + 0x1p-20)

/** Window depths: that of a code, and the ends of what its pixel may have had. */
typedef struct grain_points {
    dp_point own, to_near, to_far;
} grain_points;

grain_points grain_points_of(const dp_setup *setup, const grain *g, uint32_t code);

/**
 * The eye depths that a pixel may have whose sample became `code`, the nearest one. Null: GRAIN_CODES.
 * @param setup  of the model exact
 * @param code   at most code_max
 */
grain_range grain_range_of(const dp_setup *setup, const grain *g, uint32_t code);

/** How far a window depth can be from what such a code gives back. */
double grain_window_reach(const dp_setup *setup, const grain *g, uint32_t code);

/** Room for what many codes say, an array each. */
typedef struct grain_rows {
    double *stored; /**< as dp_stored() */
    double *lo, *hi, *reach;
} grain_rows;

/** The same of many codes, bit for bit; codes above code_max count as 0. */
void grain_ranges_of(const dp_setup *setup, const grain *g, const uint32_t *codes, size_t count, const grain_rows *out);

/** How far what is stored is off at most of depths from lo to hi, of 1/z or, where the set-up is orthographic, of z. */
double grain_range_error(const dp_setup *setup, double stored, double lo, double hi, double reading);

/**
 * How far a stored depth at z can be off at most, of 1/z or of z where the set-up is orthographic: what the image holds
 * may be any sample whose range has z, that of z's code or one at the ends of its range.
 * @param reading  relative error of reading it back, which comes on top
 */
double grain_error_of(const dp_setup *setup, const grain *g, double z, double reading);

/**
 * The same in closed form, and of all depths between two: half the widest cell that a depth between them may lie in,
 * times GRAIN_OUTWARD, and what reading adds. Of "quantity": 1/z, or z where the set-up is orthographic.
 */
enum { GRAIN_BINADES = 128 };
typedef struct grain_bound {
    double zero, per;     /* the quantity at window depth 0; window depth that one unit of it makes, of either sign */
    double least, most;   /* quantities of the planes */
    double stretch, more; /* a sample's number may exceed window depth by so much: relative, absolute */
    double reading;
    double half[GRAIN_BINADES]; /* a cell's half, of numbers from 2^-k up; the last: of all below, too */
} grain_bound;

/** @return false where there is no such form: then grain_errors_of() */
bool grain_bound_init(grain_bound *out, const dp_setup *setup, const grain *g, double reading);

/** The bound for quantities from lo to hi; INFINITY where they are not between the planes. */
DP_INLINE double grain_bound_of(const grain_bound *b, double lo, double hi) {
    const double at_lo = (lo - b->zero) * b->per, at_hi = (hi - b->zero) * b->per;
    const double depth = at_lo > at_hi ? at_lo : at_hi, number = depth * b->stretch + b->more;
    const uint64_t field = dp_bits64(number > 0x1p-127 ? number : 0x1p-127) >> 52;
    const double half = b->half[field < 1023 ? 1023 - field : 0];
    const double size_lo = fabs(lo), size_hi = fabs(hi), size = size_lo > size_hi ? size_lo : size_hi;
    return lo >= b->least && hi <= b->most ? half + b->reading * (size + half) : (double)INFINITY;
}

/** Errors of codes that were met, of one set-up, grain and reading. Zeros to begin with. */
enum { GRAIN_MEMO = 1 << 14 };
typedef struct grain_memo {
    uint32_t code[GRAIN_MEMO]; /**< + 1 */
    double error[GRAIN_MEMO];
} grain_memo;

/** The same at many depths, bit for bit; anything where z is not between near and far. @param memo  may be null */
void grain_errors_of(const dp_setup *setup, const grain *g, const double *z, size_t count, double reading,
                     grain_memo *memo, double *out);

#endif
