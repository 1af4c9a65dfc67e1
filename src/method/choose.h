/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file choose.h  The cheapest method that is good enough, from the claims alone: for methods, table and figures.
 */
#ifndef METHOD_CHOOSE_H
#define METHOD_CHOOSE_H

#include "method/method.h"

/** The method that is wanted: its error, its inputs and where it runs. */
typedef struct method_wish {
    double tolerance;          /**< worst error, in the family's measure */
    double ratio_lo, ratio_hi; /**< for every far/near in between; ratio_hi may be INFINITY: finite ones up to
                                    METHOD_RATIO_HI and the infinite one */
    bool ortho;                /**< for an orthographic projection too */
    bool cut_cells;            /**< interval: at the planes too */
    bool pipeline;             /**< interval: of the binary32 pipeline, not of the lattice */
} method_wish;

/**
 * The cheapest method of a family, by its row's cost, whose claim covers the wish in case `which`.
 * @return null when none does
 */
const method_row *method_choose(const method_family_row *family, size_t which, const method_wish *wish);

#endif
