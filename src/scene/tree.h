/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Boxes in a complete binary tree: the range of items is halved at the median along the longest side, down to leaves of
 * at most TREE_LEAF items, all at one depth. Node k has the children 2k and 2k + 1; the root is 1.
 */
#ifndef SCENE_TREE_H
#define SCENE_TREE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { TREE_LEAF = 4 };

/* A box in binary32, rounded outward. */
typedef struct tree_box {
    float lo[3], hi[3];
} tree_box;

typedef struct tree {
    uint32_t items, leaves;
    uint32_t *item; /* their numbers, in the order of the leaves */
    tree_box *box;  /* of each item, in that order */
    tree_box *node; /* 2 leaves of them; [0] is unused */
} tree;

/* At least one item; box[i] is item i's. The boxes are copied. False: no memory. */
bool tree_build(tree *t, const tree_box *box, uint32_t items, int threads);
void tree_free(tree *t);

/* The box of points, grown on every side; from their coordinates less the origin's. */
tree_box tree_box_of(const double *const *corner, int corners, const double origin[3], double grown);

static inline bool tree_meet(const tree_box *a, const tree_box *b) {
    return a->lo[0] <= b->hi[0] && b->lo[0] <= a->hi[0] && a->lo[1] <= b->hi[1] && b->lo[1] <= a->hi[1] &&
           a->lo[2] <= b->hi[2] && b->lo[2] <= a->hi[2];
}

/* A leaf's first place in item[] and box[]; it ends where the next leaf's begins. */
static inline uint32_t tree_first(const tree *t, uint32_t leaf) {
    return (uint32_t)((uint64_t)t->items * leaf / t->leaves);
}

/* Visits the leaves from `from` on whose box meets `box`, until a visit returns false. */
typedef bool tree_visit(void *context, uint32_t leaf);
bool tree_query(const tree *t, const tree_box *box, uint32_t from, tree_visit *visit, void *context);

/* The leaves whose box a ray meets, at or after its start. */
bool tree_ray(const tree *t, const double start[3], const double along[3], tree_visit *visit, void *context);

#endif
