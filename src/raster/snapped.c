/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Coverage of convex polygons whose corners lie on a grid: exact in integers. A row holds the pixels from the left edge
 * on, it included, to the right one, it excluded; rows likewise from the top: the top-left rule.
 */
#include <stdlib.h>

#include "raster/model.h"

/* The least integer that is not below n / d, d > 0. */
DP_INLINE int64_t ceiling(int64_t n, int64_t d) {
    const int64_t quotient = n / d;
    return quotient + (n - quotient * d > 0 ? 1 : 0);
}

static int within(int64_t value, int most) {
    return value < 0 ? 0 : value > most ? most : (int)value;
}

bool raster_snapped_rows(const raster_target *target, raster_piece *piece) {
    int32_t least = piece->y[0];
    int32_t most = piece->y[0];
    for (int i = 1; i < piece->corners; i++) {
        least = piece->y[i] < least ? piece->y[i] : least;
        most = piece->y[i] > most ? piece->y[i] : most;
    }
    const int64_t one = (int64_t)1 << piece->bits;
    piece->y0 = within(ceiling(least, one), target->height);
    piece->y1 = within(ceiling(most, one), target->height);
    return piece->y0 < piece->y1;
}

bool raster_snapped_span(const raster_target *target, const raster_piece *piece, int y, int *from, int *to) {
    const int64_t row = (int64_t)y * (1 << piece->bits);
    int64_t left = INT64_MAX;
    int64_t right = INT64_MIN;
    if (y < piece->y0 || y >= piece->y1)
        return false;
    for (int i = 0, j = piece->corners - 1; i < piece->corners; j = i++) {
        const bool crosses = (piece->y[i] <= row) != (piece->y[j] <= row);
        if (!crosses)
            continue;
        const int64_t high = (int64_t)piece->y[j] - piece->y[i];
        const int64_t wide = (int64_t)piece->x[j] - piece->x[i];
        const int64_t along = piece->x[i] * high + wide * (row - piece->y[i]);
        const int64_t x = ceiling(high < 0 ? -along : along, llabs(high) << piece->bits);
        left = x < left ? x : left;
        right = x > right ? x : right;
    }
    *from = within(left, target->width);
    *to = within(right, target->width);
    return *from < *to;
}
