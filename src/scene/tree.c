/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/tree.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/outward.h"

enum { DEPTH_MAX = 32, TASK_ITEMS = 1 << 14 };

/* ---- Boxes --------------------------------------------------------------------------------------------------------
 */

static float below(double x) {
    const float f = (float)fmax(x, -(double)FLT_MAX);
    return (double)f > x ? nextafterf(f, -HUGE_VALF) : f;
}

static float above(double x) {
    return -below(-x);
}

tree_box tree_box_of(const double *const *corner, int corners, const double origin[3], double grown) {
    tree_box box;
    for (int k = 0; k < 3; k++) {
        double lo = corner[0][k];
        double hi = lo;
        for (int i = 1; i < corners; i++) {
            lo = fmin(lo, corner[i][k]);
            hi = fmax(hi, corner[i][k]);
        }
        /* two roundings in double, far below one in binary32, which is not left to chance */
        const double size = fmax(fabs(lo), fabs(hi)) + fabs(origin[k]) + grown;
        box.lo[k] = below(lo - origin[k] - grown - size * DP_ROUNDINGS_2);
        box.hi[k] = above(hi - origin[k] + grown + size * DP_ROUNDINGS_2);
    }
    return box;
}

static void enclose(tree_box *box, const tree_box *other) {
    for (int k = 0; k < 3; k++) {
        box->lo[k] = fminf(box->lo[k], other->lo[k]);
        box->hi[k] = fmaxf(box->hi[k], other->hi[k]);
    }
}

/* ---- Building -----------------------------------------------------------------------------------------------------
 */

typedef struct entry {
    float centre[3];
    uint32_t at;
} entry;

static void swap(entry *a, entry *b) {
    const entry kept = *a;
    *a = *b;
    *b = kept;
}

/*
 * Brings the `wanted` entries that are least along an axis to the front (Hoare's FIND). The pivot is a median of three
 * whose places no file can foresee for long.
 */
static void select_least(entry *e, ptrdiff_t count, ptrdiff_t wanted, int axis) {
    ptrdiff_t first = 0;
    ptrdiff_t last = count - 1;
    uint32_t mixed = (uint32_t)count;
    while (first < last) {
        float at[3];
        for (int k = 0; k < 3; k++) {
            mixed = mixed * 1664525U + 1013904223U;
            at[k] = e[first + (ptrdiff_t)(((uint64_t)mixed * (uint64_t)(last - first + 1)) >> 32)].centre[axis];
        }
        const float pivot = fmaxf(fminf(at[0], at[1]), fminf(fmaxf(at[0], at[1]), at[2]));
        ptrdiff_t i = first;
        ptrdiff_t j = last;
        while (i <= j) {
            while (e[i].centre[axis] < pivot)
                i++;
            while (e[j].centre[axis] > pivot)
                j--;
            if (i <= j)
                swap(&e[i++], &e[j--]);
        }
        if (wanted <= j)
            last = j;
        else if (wanted >= i)
            first = i;
        else
            return;
    }
}

static int longest_axis(const entry *e, size_t count) {
    float lo[3] = {HUGE_VALF, HUGE_VALF, HUGE_VALF};
    float hi[3] = {-HUGE_VALF, -HUGE_VALF, -HUGE_VALF};
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            lo[k] = e[i].centre[k] < lo[k] ? e[i].centre[k] : lo[k];
            hi[k] = e[i].centre[k] > hi[k] ? e[i].centre[k] : hi[k];
        }
    int axis = hi[1] - lo[1] > hi[0] - lo[0] ? 1 : 0;
    return hi[2] - lo[2] > hi[axis] - lo[axis] ? 2 : axis;
}

/* Sorts the entries of the leaves first .. first + leaves - 1, a power of two of them. */
static void sort_entries(const tree *t, entry *e, uint32_t first, uint32_t leaves) {
    if (leaves == 1)
        return;
    const uint32_t half = leaves / 2;
    const uint32_t from = tree_first(t, first);
    const uint32_t middle = tree_first(t, first + half);
    const uint32_t end = tree_first(t, first + leaves);
    select_least(e + from, (ptrdiff_t)(end - from), (ptrdiff_t)(middle - from), longest_axis(e + from, end - from));
#pragma omp task if (end - from > TASK_ITEMS)
    sort_entries(t, e, first, half);
    sort_entries(t, e, first + half, half);
}

static entry *centres(const tree *t, const tree_box *box) {
    entry *e = malloc((size_t)t->items * sizeof *e);
    for (uint32_t i = 0; e != NULL && i < t->items; i++) {
        e[i].at = i;
        for (int k = 0; k < 3; k++)
            e[i].centre[k] = 0.5F * box[i].lo[k] + 0.5F * box[i].hi[k];
    }
    return e;
}

static void build_nodes(tree *t) {
    for (uint32_t leaf = 0; leaf < t->leaves; leaf++) {
        tree_box *node = &t->node[t->leaves + leaf];
        *node = t->box[tree_first(t, leaf)];
        for (uint32_t i = tree_first(t, leaf) + 1; i < tree_first(t, leaf + 1); i++)
            enclose(node, &t->box[i]);
    }
    for (uint32_t k = t->leaves - 1; k > 0; k--) {
        t->node[k] = t->node[2 * k];
        enclose(&t->node[k], &t->node[2 * k + 1]);
    }
}

bool tree_build(tree *t, const tree_box *box, uint32_t items, int threads) {
    *t = (tree){.items = items, .leaves = 1};
    while ((uint64_t)t->leaves * TREE_LEAF < items)
        t->leaves *= 2;
    entry *e = centres(t, box);
    t->item = malloc((size_t)items * sizeof *t->item);
    t->box = malloc((size_t)items * sizeof *t->box);
    t->node = malloc(2 * (size_t)t->leaves * sizeof *t->node);
    const bool built = e != NULL && t->item != NULL && t->box != NULL && t->node != NULL;
    if (built) {
#pragma omp parallel num_threads(threads)
#pragma omp single
        sort_entries(t, e, 0, t->leaves);
        for (uint32_t i = 0; i < items; i++) {
            t->item[i] = e[i].at;
            t->box[i] = box[e[i].at];
        }
        build_nodes(t);
    } else
        tree_free(t);
    free(e);
    return built;
}

void tree_free(tree *t) {
    free(t->item);
    free(t->box);
    free(t->node);
    *t = (tree){0};
}

/* ---- Asking -------------------------------------------------------------------------------------------------------
 */

/* The last leaf below a node. */
static uint32_t last_leaf(const tree *t, uint32_t node) {
    const int down = __builtin_clz(node) - __builtin_clz(t->leaves);
    return ((node + 1) << down) - 1 - t->leaves;
}

/* A box and the first leaf that is wanted, or a ray. */
typedef struct question {
    const tree_box *box;
    uint32_t from;
    const double *start;
    double inverse[3];
} question;

static bool box_meets(const tree *t, uint32_t node, const question *q) {
    return tree_meet(&t->node[node], q->box) && last_leaf(t, node) >= q->from;
}

/* 1e-6 of slack: the start and the quotients are rounded, and the boxes do not care. */
static bool ray_meets(const tree *t, uint32_t node, const question *q) {
    const tree_box *box = &t->node[node];
    double enter = 0.0;
    double leave = INFINITY;
    for (int k = 0; k < 3; k++) {
        const double x = ((double)box->lo[k] - q->start[k]) * q->inverse[k];
        const double y = ((double)box->hi[k] - q->start[k]) * q->inverse[k];
        enter = fmax(enter, fmin(x, y));
        leave = fmin(leave, fmax(x, y));
    }
    return enter <= leave * (1.0 + 1e-6);
}

static inline bool walk(const tree *t, bool (*meets)(const tree *, uint32_t, const question *), const question *q,
                        tree_visit *visit, void *context) {
    uint32_t stack[DEPTH_MAX];
    int depth = 0;
    stack[depth++] = 1;
    while (depth > 0) {
        const uint32_t k = stack[--depth];
        if (!meets(t, k, q))
            continue;
        if (k < t->leaves) {
            stack[depth++] = 2 * k + 1;
            stack[depth++] = 2 * k;
        } else if (!visit(context, k - t->leaves))
            return false;
    }
    return true;
}

bool tree_query(const tree *t, const tree_box *box, uint32_t from, tree_visit *visit, void *context) {
    return walk(t, box_meets, &(question){.box = box, .from = from}, visit, context);
}

bool tree_ray(const tree *t, const double start[3], const double along[3], tree_visit *visit, void *context) {
    const question q = {.start = start, .inverse = {1.0 / along[0], 1.0 / along[1], 1.0 / along[2]}};
    return walk(t, ray_meets, &q, visit, context);
}
