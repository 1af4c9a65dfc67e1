/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/body.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct edge {
    uint32_t from, to; /* the lesser first; from == BODY_NONE: free */
    int32_t balance;   /* how much oftener it is run through this way than the other */
    uint32_t triangle; /* one that has it */
} edge;

typedef struct bodies {
    const model *m;
    uint32_t *piece;  /* of each surface; BODY_NONE: it hides nothing */
    uint32_t *corner; /* of each corner of each triangle: the first that has this place in this piece; in the
 end the numbers */
    uint32_t *place;  /* hashed: corners */
    edge *edge;       /* hashed */
    size_t mask;      /* the hashed ones' size less 1 */
    uint32_t *parent; /* union-find over triangles */
} bodies;

static uint64_t mixed(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
}

/* Surfaces of one node and mesh follow one another. */
static void set_pieces(bodies *b) {
    const model_surface *s = b->m->surface;
    uint32_t piece = 0;
    for (size_t i = 0; i < b->m->surfaces; i++) {
        if (i > 0 && (strcmp(s[i].node, s[i - 1].node) != 0 || strcmp(s[i].mesh, s[i - 1].mesh) != 0))
            piece++;
        b->piece[i] = s[i].blended || s[i].two_sided ? BODY_NONE : piece;
    }
}

static const double *position(const bodies *b, uint32_t corner) {
    return b->m->position[b->m->triangle[corner / 3][corner % 3]];
}

/* Comparing with == takes -0 for 0; adding 0 gives both the same bits. */
static uint64_t hash_of(const bodies *b, uint32_t corner, uint32_t piece) {
    uint64_t hash = mixed(piece);
    const double *p = position(b, corner);
    for (int k = 0; k < 3; k++) {
        const double x = p[k] + 0.0;
        uint64_t bits;
        memcpy(&bits, &x, sizeof bits);
        hash = mixed(hash ^ bits);
    }
    return hash;
}

static void set_corner(bodies *b, uint32_t corner) {
    const double *p = position(b, corner);
    const uint32_t piece = b->piece[b->m->of[corner / 3]];
    size_t at = hash_of(b, corner, piece) & b->mask;
    for (; b->place[at] != BODY_NONE; at = (at + 1) & b->mask) {
        const double *q = position(b, b->place[at]);
        if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2] && b->piece[b->m->of[b->place[at] / 3]] == piece)
            break;
    }
    if (b->place[at] == BODY_NONE)
        b->place[at] = corner;
    b->corner[corner] = b->place[at];
}

static edge *edge_at(const bodies *b, uint32_t from, uint32_t to) {
    size_t at = mixed((uint64_t)from << 32 | to) & b->mask;
    while (b->edge[at].from != BODY_NONE && (b->edge[at].from != from || b->edge[at].to != to))
        at = (at + 1) & b->mask;
    return &b->edge[at];
}

static uint32_t root(uint32_t *parent, uint32_t t) {
    while (parent[t] != t)
        t = parent[t] = parent[parent[t]];
    return t;
}

static void join(bodies *b, uint32_t triangle) {
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t from = b->corner[3 * triangle + k];
        const uint32_t to = b->corner[3 * triangle + (k + 1) % 3];
        if (from == to)
            continue;
        edge *e = from < to ? edge_at(b, from, to) : edge_at(b, to, from);
        if (e->from == BODY_NONE)
            *e = (edge){from < to ? from : to, from < to ? to : from, 0, triangle};
        e->balance += from < to ? 1 : -1;
        b->parent[root(b->parent, triangle)] = root(b->parent, e->triangle);
    }
}

static bool hides(const bodies *b, uint32_t triangle) {
    return b->piece[b->m->of[triangle]] != BODY_NONE;
}

static bool find_corners(bodies *b, uint32_t triangles) {
    b->place = malloc((b->mask + 1) * sizeof *b->place);
    if (b->place == NULL)
        return false;
    memset(b->place, 0xff, (b->mask + 1) * sizeof *b->place);
    for (uint32_t t = 0; t < triangles; t++)
        for (uint32_t k = 0; k < 3 && hides(b, t); k++)
            set_corner(b, 3 * t + k);
    free(b->place);
    b->place = NULL;
    return true;
}

static bool find_edges(bodies *b, uint32_t triangles) {
    b->edge = malloc((b->mask + 1) * sizeof *b->edge);
    if (b->edge == NULL)
        return false;
    memset(b->edge, 0xff, (b->mask + 1) * sizeof *b->edge);
    for (uint32_t t = 0; t < triangles; t++)
        b->parent[t] = t;
    for (uint32_t t = 0; t < triangles; t++)
        if (hides(b, t))
            join(b, t);
    return true;
}

/* Turns each triangle's parent into its body's number: the root's own, which is marked where an edge is left over. */
static void set_numbers(bodies *b, uint32_t triangles) {
    for (uint32_t t = 0; t < triangles; t++)
        b->corner[t] = root(b->parent, t);
    for (size_t at = 0; at <= b->mask; at++)
        if (b->edge[at].from != BODY_NONE && b->edge[at].balance != 0)
            b->parent[b->corner[b->edge[at].triangle]] = BODY_NONE;
    for (uint32_t t = 0; t < triangles; t++)
        b->corner[t] = hides(b, t) ? b->parent[b->corner[t]] : BODY_NONE;
}

uint32_t *body_numbers(const model *m) {
    const uint32_t triangles = (uint32_t)m->triangles;
    bodies b = {.m = m, .mask = 1};
    while (b.mask < 4 * (size_t)triangles)
        b.mask = 2 * b.mask + 1;
    b.piece = malloc(m->surfaces * sizeof *b.piece);
    b.corner = malloc(3 * (size_t)triangles * sizeof *b.corner);
    b.parent = malloc((size_t)triangles * sizeof *b.parent);
    bool done = b.piece != NULL && b.corner != NULL && b.parent != NULL;
    if (done)
        set_pieces(&b);
    done = done && find_corners(&b, triangles) && find_edges(&b, triangles);
    if (done)
        set_numbers(&b, triangles);
    free(b.piece);
    free(b.place);
    free(b.edge);
    free(b.parent);
    if (done)
        return b.corner;
    free(b.corner);
    return NULL;
}
