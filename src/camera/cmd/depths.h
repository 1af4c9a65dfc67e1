/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file depths.h  The depths that a command is asked about: a list, or LO:HI:log|lin:COUNT.
 *
 * A spaced set is never stored: depth i is computed when it is asked for, so a million rows cost no memory.
 */
#ifndef CAMERA_CMD_DEPTHS_H
#define CAMERA_CMD_DEPTHS_H

#include <stddef.h>

struct camera_asked;

enum { DEPTHS_MAX = 1000000 };

typedef enum depths_kind { DEPTHS_LIST = 0, DEPTHS_LOG, DEPTHS_LIN } depths_kind;

typedef struct depths {
    depths_kind kind;
    double lo, hi;                    /**< least and greatest depth, scene units */
    size_t count;                     /**< of a spaced set at least 2, or 1 for lo alone */
    const struct unit_row *from, *to; /**< null, or units that the list is converted from and into */
    double *list; /**< DEPTHS_LIST: the depths in the order given, owned by the options; else null */
} depths;

/** Depth i, i < count. The first of a spaced set is exactly lo, the last exactly hi, and none leaves [lo, hi]. */
double depths_get(const depths *d, size_t i);

/**
 * The depths of a command: those of --at, or `count` log-spaced ones from near to far (to 1e6 near when far is
 * infinite; evenly spaced when near is not positive). Call it after setups_make(), which checks near and far.
 *
 * @return EXIT_FINE, or EXIT_USAGE after one line when a depth lies outside [near, far]
 */
int depths_resolve(const struct camera_asked *c, size_t count, depths *out);

/** @return EXIT_USAGE after one line where binary32 cannot hold a depth of --at, else EXIT_FINE */
int depths_in_binary32(const depths *d);

/** The range of a command: that of --range, or [near, far]; *hi may then be INFINITY. Return as depths_resolve(). */
int range_resolve(const struct camera_asked *c, double *lo, double *hi);

#endif
