/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file report.h  The findings of solve, as text, JSON and CSV. */
#ifndef SOLVE_CMD_SOLVE_REPORT_H
#define SOLVE_CMD_SOLVE_REPORT_H

#include "camera/cost.h"
#include "report/number.h"
#include "report/report.h"
#include "solve/cmd_solve/request.h"
#include "solve/distance.h"
#include "solve/plane.h"

/** The need of real arithmetic: the same question in the model exact. */
typedef struct solve_lattice {
    bool possible;
    double value;           /**< the plane or distance; NaN where neither is asked */
    quantity_worst reached; /**< there, or with the set-up as it is */
} solve_lattice;

/** A format with a mapping, and what it can do. */
typedef struct solve_candidate {
    dp_spec spec; /**< with the answer filled in, or what comes nearest to it; its model is what the answer holds in */
    bool asked;   /**< the user named it, or left the choice open */
    bool possible;
    quantity_worst reached; /**< with `spec` */
    cost price;
    size_t place;          /**< before they are put in order: which of two that are alike comes first */
    solve_unknown unknown; /**< the plane that was solved for, where one was */
    bool solved;           /**< one was */
    plane_answer plane;    /**< where one was solved for */
    distance_span island;  /**< and one was found in the lattice: the values that pass there */
    distance_answer distance;
    solve_lattice lattice;
} solve_candidate;

/** Surfaces that far apart in the binary32 pipeline, from the guaranteed distance on. */
typedef struct solve_fight {
    double first;    /**< the nearest depth at which a census finds them to fight; NaN: none found */
    double searched; /**< the farthest that it looked at; NaN: no pair lies farther */
} solve_fight;

enum { SOLVE_AGAIN_MAX = 32 };
enum { SOLVE_CANDIDATES_MAX = CAMERA_FORMATS_MAX * DP_MAPPING_COUNT + 16 };

typedef struct solve_report {
    const solve_request *o;
    solve_target target; /**< never SOLVE_FOR_ANY */
    quantity_kind kind;
    double limit; /**< NaN when what is reached is asked */
    double lo, hi;
    size_t count;             /**< at least 1 */
    solve_candidate *items;   /**< the answer first, then the alternatives, best first */
    solve_candidate *slanted; /**< each of them at any slant, see camera_assumed(); without a viewport: nothing is
                                   guaranteed there */
    solve_fight fight;        /**< of the answer, where a distance is solved for */
    size_t again_count;
    distance_span again[SOLVE_AGAIN_MAX]; /**< where it holds again beyond that distance */
} solve_report;

/** solve --for frusta, all of it. @return an exit status */
int solve_frusta(const solve_request *o);

/** solve for a number that a preset leaves open, all of it. @return an exit status */
int solve_preset(const solve_request *o);

/** That the view is as deep as the separation: else there is no pair of surfaces to ask about. @return EXIT_FINE, or
 * EXIT_USAGE after one line on stderr */
int solve_check_apart(const solve_request *o, solve_target target);

/** Fills in `fight` and `again` of the answer. */
void solve_look_beyond(solve_report *r);

/** Writes `again` in text. */
void solve_say_beyond(page *p, const solve_report *r);

/** Writes it in the form that the options ask for. */
void solve_report_write(const solve_report *r, output *out);

/* ---- What the files of the report share -------------------------------------------------------------------------- */

enum { SOLVE_DIGITS = 6 };

/** The answer in sentences, and what stands behind it; of an item that begins with its solve_report. */
void solve_report_answer(page *p, void *item);

/** "separation" or "error". */
const char *solve_measure_name(const solve_report *r);

/**
 * The fewest digits, six or more, of a plane between `value` and `until`, which lies on its safe side: typed in again
 * they pass, which is tried and not concluded.
 */
number_text solve_safe_digits(const solve_report *r, const solve_candidate *c, double value, double until);

static inline double solve_plane_of(const solve_candidate *c) {
    return c->unknown == SOLVE_NEAR ? c->spec.znear : c->spec.zfar;
}

/**
 * The guarantee of binary32 arithmetic at the depth that is worst, for surfaces that face the camera or at any slant;
 * NaN where it has no pipeline, or is not asked.
 */
double solve_in_binary32(const solve_report *r, const solve_candidate *c, bool slanted);

#endif
