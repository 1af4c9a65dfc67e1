/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where two triangles overlap, seen along their common normal, and how far apart they are there (find.h). */
#ifndef SCENE_OVERLAP_H
#define SCENE_OVERLAP_H

#include <stdbool.h>

#include "scene/exact.h"

enum { OVERLAP_CORNERS = 8 };

typedef struct overlap {
    bool opposite;    /* the triangles face opposite ways */
    int corners;      /* 3 to 8, but where the area is 0 */
    double lo, hi;    /* distance of b over the overlap, positive on a's front side; both exactly 0 in one plane */
    double area;      /* 0 where it rounds to that */
    double width;     /* area over the longest diagonal */
    double normal[3]; /* of a, length 1 */
    double along[3];  /* the common normal, length 1, on a's front side */
    double place[3];  /* the centroid, on a */
    double corner[OVERLAP_CORNERS][3]; /* on a, in order */
} overlap;

/*
 * Whether a and b, neither without area, overlap where they are at most `gap` apart, and their planes are within an
 * angle whose sine is `sine`.
 */
bool overlap_find(exact_triangle a, exact_triangle b, double gap, double sine, overlap *out);

#endif
