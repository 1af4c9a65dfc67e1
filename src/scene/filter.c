/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/find.h"

static const finder_filter_row rows[FINDER_FILTERS] = {
    [FINDER_FACING] = {"facing", NULL, "that are never seen from one side"},
    [FINDER_BLENDED] = {"blended", NULL, "with a blended material"},
    [FINDER_THIN] = {"thin", NULL, "that touch along an edge"},
    [FINDER_HIDDEN] = {"hidden", NULL, "inside closed bodies"},
};

NAMED_TABLE(finder_filter, rows);
