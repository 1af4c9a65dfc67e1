/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/find.h"

static const finder_filter_row rows[FINDER_FILTERS] = {
    [FINDER_FACING] = {"facing", "that are never seen from one side"},
    [FINDER_BLENDED] = {"blended", "with a blended material"},
    [FINDER_THIN] = {"thin", "that touch along an edge"},
    [FINDER_HIDDEN] = {"hidden", "inside closed bodies"},
};

const finder_filter_row *finder_filter_get(size_t filter) {
    return filter < FINDER_FILTERS ? &rows[filter] : NULL;
}
