/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file slices.h  Depth ranges beside each other: the codes that each keeps, and those that two of them share. */
#ifndef QUANTITY_CMD_TABLE_SLICES_H
#define QUANTITY_CMD_TABLE_SLICES_H

#include "camera/cmd/setups.h"

/** The codes that depths of a set-up have from near to far, and their share of those that its format has from 0 to 1;
 * in the lattice, whatever the model is, as all here. */
double slice_codes(const dp_setup *setup);
double slice_share(const dp_setup *setup);

/** A set-up in a depth range, and its eye depths that are stored as shared codes. */
typedef struct slice_span {
    double lo, hi, z_lo, z_hi;
} slice_span;

/** Codes of two depth ranges of one set-up. */
typedef struct slice_pair {
    const char *mapping, *format;
    slice_span first, second;
    double codes; /**< how many they share, at least 1 */
    uint32_t from, to;
} slice_pair;

/** The columns of a pair. */
extern const column slice_columns[];

/** The pair of that index of those that share codes. @return false behind the last */
bool slices_shared(const setups *all, size_t index, slice_pair *out);

/** Writes sentences about the pairs; nothing where fewer than two ranges were asked for. */
void slices_say(page *p, const camera_asked *c, const setups *all);

#endif
