/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file report.h  The report of bias: rows, what is enough over the range, and the words around them. */
#ifndef BIAS_CMD_BIAS_REPORT_H
#define BIAS_CMD_BIAS_REPORT_H

#include "bias/cmd_bias/call.h"
#include "bias/cmd_bias/judged.h"
#include "bias/cmd_bias/request.h"
#include "bias/cmd_bias/trial.h"
#include "camera/cmd/each_setup.h"
#include "camera/cmd/slant.h"
#include "report/sentence.h"

enum { BESIDE = 6, DIGITS_Z = 9, DIGITS_SHORT = 4, WIDTH_API = 13, WIDTH_UNITS = 11 };

/** Conditions of columns: the effect of a bias is asked, or the bias that is needed; of one API, or of several. */
enum {
    EFFECT = 1,
    INVERSE = 2,
    ONE_API = 4,
    SEVERAL = 8,
    OF_DEPTHS = 16, /**< of several */
    OF_RANGE = 32,
    WITH_GAP = 64,
    WITH_SLOPE = 128,
    VERBOSE = 256,
    WITH_TRIANGLES = 512,
    OF_PLACES = 1024, /**< at several depths */
    OF_SLOPES = 2048, /**< of surfaces that need not face the camera */
    DRAWN = 4096,
    OF_BIAS = 8192 /**< not of what is written in place of one */
};

/** The units that reach a goal from lo to hi; all NaN where lo is beyond hi. */
typedef struct bias_need {
    const char *what, *counted; /**< "resolved"; "units" */
    double lo, hi;
    double units, z; /**< with their sign, NaN where none are enough; and the depth that needs them */
    double from, to; /**< where a bias is enough at all */
    double next;     /**< where the exponent is n + 1; NaN where that is not open */
} bias_need;

/** A depth, or an API at a place. */
typedef struct bias_row {
    const char *api;
    double z;
    bias_effect effect;   /**< of the bias given, or of one unit that brings a layer nearer */
    double one_unit;      /**< what one unit moves; NaN where it is held at a plane */
    bias_need apart, gap; /**< inverse: to tell layers apart, and by the gap that is asked for */
    const char *held;     /**< text: where the biased depth is held at a plane */
    guarantee guarantee;  /**< needs no bias */
    double factor;
    char call[BIAS_CALL_SIZE], said[SENTENCE_SIZE]; /**< said: the call, or why there is none */
    char beside[BESIDE][NUMBER_SIZE];               /**< the units of each set-up, short */
} bias_row;

/** The question; the fields below `range_lo` are of the set-up at hand. */
typedef struct biasing {
    each_setup each;
    const bias_request *o;
    unsigned when;
    const char *apis, *o_remedy;      /**< o_remedy: name of what is written in place of a bias */
    double amount;                    /**< its number */
    double units_sent;                /**< as the platform sends them */
    bool chosen;                      /**< the factor is the least that is enough at any slant */
    double units, gap, factor, slope; /**< as asked; NaN where something else is */
    double range_lo, range_hi;
    bool cuts;             /**< the GPU cuts fractions of units */
    const bias_api *named; /**< the API at hand */
    bias_api api;          /**< as the platform has it, and the GPU that was measured in the set-up's format */
    bias_state state;      /**< of it */
    bias_row row;
    bias_need over, gap_over;   /**< inverse, of one API: the same over the range */
    const bias_need *wanted;    /**< the one that is asked for */
    double shift_lo, shift_hi;  /**< the effect of its units at the ends */
    char call[BIAS_CALL_SIZE];  /**< that sets them */
    bias_judged facing, sloped; /**< of a bias that is given, of one API: is it enough? */
    bias_pushed pushed;
    bias_trial trial;            /**< with --rasterize */
    int status;                  /**< of that */
    setups drawn;                /**< likewise: the set-ups in the rasterizer's arithmetic */
    double judged_lo, judged_hi; /**< the range of that; of an infinite one up to the last depth shown */
    bool missed;                 /**< in some set-up it is not */
    bool limited;                /**< some depth is held at a plane */
    bool fails;                  /**< somewhere no bias is enough */
} biasing;

/** The part of a range in which a bias is enough, as conditions of sentences over `bias_need_columns`. */
enum { AT_A_DEPTH = 1, FROM_LO = 2, UP_TO_HI = 4 };

static inline unsigned bias_need_place(const bias_need *n) {
    return (n->lo == n->hi ? AT_A_DEPTH : 0) | (n->from == n->lo ? FROM_LO : 0) | (n->to == n->hi ? UP_TO_HI : 0);
}

extern const column bias_need_columns[];

/** Where the gap leads to the near plane, at least. */
double bias_gap_from(const biasing *b);

/** Text above a set-up and below it; the same of several side by side. */
void bias_say_setup(page *p, void *item);
void bias_say_notes(page *p, void *item);
void bias_say_beside(page *p, void *item);
void bias_say_calls(page *p, void *item);

#endif
