/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file solve_report.h  What solve found, as text, JSON and CSV. */
#ifndef CLI_SOLVE_REPORT_H
#define CLI_SOLVE_REPORT_H

#include "cli/options.h"
#include "need/cost.h"
#include "need/solve.h"

/** A format with a mapping, and what it can do. */
typedef struct solve_candidate {
    dp_spec spec; /**< with the answer filled in, or what comes nearest to it */
    bool asked;   /**< the user named it, or left the choice open */
    bool possible;
    measure_worst worst; /**< what is reached with `spec` */
    cost price;
    int islands_from;          /**< of near or far: index of its islands in solve_report.islands */
    int island_count;          /**< 0 where neither plane was solved for */
    solve_unknown unknown;     /**< the plane that was solved for, where one was */
    bool solved;               /**< one was */
    double least, most, until; /**< see solve_result */
} solve_candidate;

enum { SOLVE_CANDIDATES_MAX = OPTIONS_FORMATS_MAX * DP_MAPPING_COUNT + 16 };

typedef struct solve_report {
    const options *o;
    solve_target target; /**< never SOLVE_FOR_ANY */
    measure_kind kind;
    double limit; /**< NaN when what is reached is asked */
    double lo, hi;
    size_t count;           /**< at least 1 */
    solve_candidate *items; /**< the answer first, then the alternatives, best first */
    solve_island *islands;  /**< of the answer */
} solve_report;

/** Writes it in the form that the options ask for. */
void solve_report_write(const solve_report *r, output *out);

#endif
