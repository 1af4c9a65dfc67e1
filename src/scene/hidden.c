/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/hidden.h"

#include <math.h>

#include "scene/body.h"

#define INWARD 0x1p-10
#define SLIT   0x1p-10
/* A ray this near to an edge or a corner, relative to what the number is made of, may be on either side of it. */
#define GRAZING 1e-12

/* Added to the normal: a ray along it would run within the walls that stand on the surface. */
static const double tilts[][3] = {
    {0.371, 0.233, 0.117}, {-0.291, 0.347, -0.153}, {0.189, -0.311, 0.271}, {-0.137, -0.259, 0.393}};

typedef struct ray {
    const hidden_among *among;
    double start[3], along[3];
    double nearest; /* what it meets first, in lengths of `along` */
    uint32_t body;  /* whose inside that is; BODY_NONE: of none */
    bool counting;  /* a second time: how much oftener it leaves this body than it enters it */
    int left;
    bool grazes; /* it comes too near to an edge */
} ray;

static double triple(const double x[3], const double y[3], const double z[3]) {
    return x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2]) + x[2] * (y[0] * z[1] - y[1] * z[0]);
}

static double largest(const double x[3]) {
    return fmax(fmax(fabs(x[0]), fabs(x[1])), fabs(x[2]));
}

/* A triangle of no closed body hides nothing, and uncovers nothing: terrain that runs through a slab, say. */
static void meet(ray *r, uint32_t triangle) {
    const model *m = r->among->m;
    if (r->among->body[triangle] == BODY_NONE)
        return;
    double p[3][3];
    double size = 0.0;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            p[i][k] = m->position[m->triangle[triangle][i]][k] - r->start[k];
        size = fmax(size, largest(p[i]));
    }
    const double side[3] = {triple(r->along, p[1], p[2]), triple(r->along, p[2], p[0]), triple(r->along, p[0], p[1])};
    const double unsure = GRAZING * size * size;
    const double lo = fmin(fmin(side[0], side[1]), side[2]);
    const double hi = fmax(fmax(side[0], side[1]), side[2]);
    if (lo < -unsure && hi > unsure)
        return;
    const double facing = side[0] + side[1] + side[2];
    const double at = triple(p[0], p[1], p[2]) / facing;
    if (at <= 0.0)
        return;
    if (lo <= unsure && hi >= -unsure) {
        r->grazes = true;
        return;
    }
    if (r->counting)
        r->left += r->among->body[triangle] != r->body ? 0 : facing > 0.0 ? 1 : -1;
    else if (at < r->nearest) {
        r->nearest = at;
        r->body = facing > 0.0 ? r->among->body[triangle] : BODY_NONE;
    }
}

static bool visit(void *context, uint32_t leaf) {
    ray *r = context;
    const tree *t = r->among->t;
    for (uint32_t i = tree_first(t, leaf); i < tree_first(t, leaf + 1) && !r->grazes; i++)
        meet(r, t->item[i]);
    return !r->grazes;
}

/* Whether the ray can tell, and *within: that it starts inside a body. */
static bool tell(ray *r, bool *within) {
    double from[3];
    for (int i = 0; i < 3; i++)
        from[i] = r->start[i] - r->among->origin[i];
    if (!tree_ray(r->among->t, from, r->along, visit, r))
        return false;
    r->counting = true;
    *within = r->body != BODY_NONE && tree_ray(r->among->t, from, r->along, visit, r) && r->left > 0;
    return true;
}

static bool inside(const hidden_among *among, const double point[3], const double normal[3]) {
    for (size_t k = 0; k < sizeof tilts / sizeof tilts[0]; k++) {
        ray r = {.among = among, .nearest = INFINITY, .body = BODY_NONE};
        bool within;
        for (int i = 0; i < 3; i++) {
            r.start[i] = point[i];
            r.along[i] = normal[i] + tilts[k][i];
        }
        if (tell(&r, &within))
            return within;
    }
    return false;
}

/* The point of the overlap's number: its centroid, then of each side its first corner and its middle. */
static void point_of(const overlap *o, int number, double out[3]) {
    const int from = (number - 1) / 2;
    const int to = number % 2 == 1 ? from : (from + 1) % o->corners;
    for (int k = 0; k < 3; k++) {
        const double x = number == 0 ? o->place[k] : 0.5 * (o->corner[from][k] + o->corner[to][k]);
        out[k] = x + INWARD * (o->place[k] - x);
    }
}

bool hidden_from(const hidden_among *among, const overlap *o, bool front) {
    const double side = front ? 1.0 : -1.0;
    const double slit = fmin(among->gap, SLIT * o->area / o->width) + among->against;
    const double ahead = fmax(front ? o->hi : -o->lo, 0.0) + slit;
    const double normal[3] = {side * o->normal[0], side * o->normal[1], side * o->normal[2]};
    for (int number = 0; number < 1 + 2 * o->corners; number++) {
        double p[3];
        point_of(o, number, p);
        for (int k = 0; k < 3; k++)
            p[k] += ahead * normal[k];
        if (!inside(among, p, normal))
            return false;
    }
    return true;
}
