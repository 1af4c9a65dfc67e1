/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file shortest.h  The quick way to the shortest digits of a double. A million table rows hold ten million numbers,
 * and printf with strtod takes most of a microsecond for each.
 */
#ifndef REPORT_SHORTEST_H
#define REPORT_SHORTEST_H

#include <stddef.h>

enum { SHORTEST_SIZE = 32 };

/**
 * Writes what the first of %.15g, %.16g, %.17g that reads back to the same double would write.
 *
 * @return the length, or 0 when the quick arithmetic cannot tell (about one number in ten, and whatever lies outside
 *         [1e-38, 1e17)): then printf and strtod must
 */
size_t shortest_quick(double value, char out[SHORTEST_SIZE]);

#endif
