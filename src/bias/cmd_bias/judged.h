/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file judged.h  The verdict on a bias that somebody has, as reports show it. */
#ifndef BIAS_CMD_BIAS_JUDGED_H
#define BIAS_CMD_BIAS_JUDGED_H

#include "bias/cmd_bias/call.h"
#include "bias/limits.h"
#include "bias/remedy.h"
#include "bias/verdict.h"
#include "camera/cmd/setups.h"
#include "report/report.h"
#include "report/sentence.h"

/** The condition of columns of what is written in place of a bias. */
enum { BIAS_OF_REMEDY = 1 << 14 };

/** One question: surfaces that face the camera, that have a slope, or have any. */
typedef struct bias_judged {
    const char *what;   /**< "facing"; null where it is not asked */
    const char *asked;  /**< "facing the camera" */
    const char *answer; /**< "not enough" */
    bias_verdict v;
    char call[BIAS_CALL_SIZE]; /**< of the least that is enough; "" where none is */
    double steepest;           /**< remedy_steepest() of what is written in place of a bias; else NaN */
} bias_judged;

/** How far it moves a layer that faces the camera. */
typedef struct bias_pushed {
    double shift, z; /**< nearer, scene units, at most; where */
    double least;    /**< by how much the least bias does there; NaN where none is enough */
    double degrees;  /**< the angle of a surface that changes as much from one pixel to the next; NaN without a view */
} bias_pushed;

/** Judges a bias as the goal asks; one that is missed is none. */
bias_judged bias_judged_of(const dp_setup *setup, const bias_state *state, const bias_goal *goal, double lo, double hi);

/** Refuses a means that has no effect in some set-up, or an option that says nothing of it; null: there is none.
 * @return an exit status */
int bias_check_remedy(const asked_line *line, const remedy *row, const setups *all);

/** The same of what is written in place of a bias, and how far that pushes. */
bias_judged bias_judged_remedy(const dp_setup *setup, const remedy *row, double amount, const bias_goal *goal,
                               double lo, double hi);
bias_pushed bias_pushed_remedy(const dp_setup *setup, const remedy *row, double amount, const bias_judged *least,
                               double lo, double hi);

/** Makes a verdict that is open "not enough", by a pixel that was drawn: where, and as what both layers are stored. */
void bias_judged_by(bias_judged *j, double z, double code, double moved);

/** @param least  the verdict whose least bias it is compared with */
bias_pushed bias_pushed_of(const dp_setup *setup, const bias_state *state, const bias_judged *least, double lo,
                           double hi);

extern const column bias_judged_columns[], bias_pushed_columns[];

/** "Enough facing the camera; not proven at any slant". */
void bias_say_answer(page *p, const bias_judged *facing, const bias_judged *sloped);

/** Where it is enough, where not, what else would be, and how far it goes. `lo`, `hi`: the range that was asked for. */
void bias_say_judged(page *p, bias_judged *j, double lo, double hi);
void bias_say_pushed(page *p, bias_pushed *pushed);

#endif
