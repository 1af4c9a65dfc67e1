/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pairs of triangles of find.h, before those that closed bodies hide are left out. */
#ifndef SCENE_PAIRS_H
#define SCENE_PAIRS_H

#include "scene/find.h"
#include "scene/overlap.h"
#include "scene/tree.h"

/* Their share of the whole search, for progress. */
#define PAIRS_SHARE 0.8

typedef struct search {
    const model *m;
    const finder_asked *asked;
    int threads;
    double origin[3], extent, sine;
    tree t;             /* its items are triangles */
    float (*normal)[3]; /* of each item, in the tree's order, length 1 */
    finder_found found; /* pairs and counts */
} search;

/* Fills `t`, `normal` and of `found` the pairs and counts; the caller frees them, whatever comes. */
finder_status pairs_find(search *s);

/* The overlap of a pair that was found. */
void pairs_overlap(const model *m, const uint32_t triangle[2], double gap, overlap *out);

/* Tells the share that is done; true: go on. */
bool pairs_progress(const search *s, double share);

#endif
