/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/find.h"

static const finder_filter_row rows[FINDER_FILTERS] = {
    [FINDER_FACING] = {"facing", NULL, "that are never seen from one side", NULL},
    [FINDER_BLENDED] = {"blended", NULL, "with a blended material", NULL},
    [FINDER_THIN] = {"thin", NULL, "that touch along an edge", NULL},
    [FINDER_HIDDEN] = {"hidden", NULL, "inside closed bodies", NULL},
};

NAMED_TABLE(finder_filter, rows);
