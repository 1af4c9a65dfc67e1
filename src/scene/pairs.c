/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/pairs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/*
 * The leaves are asked in chunks, the chunks in rounds: what is kept and when it is too much is settled between rounds,
 * in the order of the leaves, whatever the threads do. The first rounds are short: a model all in one place ends there.
 */
enum { CHUNK = 256, ROUND_MAX = 16 };

/* Work, in comparisons of two boxes: that of looking at two triangles, of a model all in one place and of each triangle
 * more before it is too much, and after which progress is told. */
enum { WORK_LOOK = 64, WORK_EACH = 32 * WORK_LOOK, WORK_TELL = 1 << 24 };
#define WORK_MAX ((uint64_t)1 << 27)

/* The error of the float normals' product, six roundings. */
#define FLOAT_SLACK 1e-6F

typedef struct chunk {
    const search *s;
    uint32_t leaf; /* asked now */
    float cosine;  /* least product of two normals */
    uint64_t work; /* in comparisons of two boxes */
    uint64_t work_max, told;
    size_t room, pairs;
    size_t pairs_max;
    finder_pair *pair;
    size_t left_out[FINDER_FILTERS];
    bool cut, stopped, no_memory;
} chunk;

static void corners_of(const model *m, uint32_t triangle, const double *out[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = m->position[m->triangle[triangle][k]];
}

bool pairs_progress(const search *s, double share) {
    bool go_on = true;
    if (s->asked->progress != NULL) {
#pragma omp critical(scene_progress)
        go_on = s->asked->progress(s->asked->context, share) == 0;
    }
    return go_on;
}

void pairs_overlap(const model *m, const uint32_t triangle[2], double gap, overlap *out) {
    const double *a[3];
    const double *b[3];
    corners_of(m, triangle[0], a);
    corners_of(m, triangle[1], b);
    if (!overlap_find(a, b, gap, 1.0, out))
        out->corners = 0;
}

/* ---- One pair -----------------------------------------------------------------------------------------------------
 */

static finder_filter filter_of(const search *s, const finder_pair *p, const overlap *o) {
    const model *m = s->m;
    const model_surface *a = &m->surface[m->of[p->triangle[0]]];
    const model_surface *b = &m->surface[m->of[p->triangle[1]]];
    const bool out[FINDER_FILTERS] = {
        [FINDER_FACING] = o->opposite && !a->two_sided && !b->two_sided,
        [FINDER_BLENDED] = a->blended || b->blended,
        [FINDER_THIN] = o->width < s->asked->width,
    };
    if (o->area == 0.0)
        return FINDER_THIN;
    for (int k = 0; k < FINDER_FILTERS; k++)
        if (out[k] && (s->asked->off >> k & 1) == 0)
            return (finder_filter)k;
    return FINDER_FILTERS;
}

static bool keep(chunk *c, const finder_pair *p) {
    c->cut = c->pairs == c->pairs_max;
    if (c->cut)
        return false;
    if (c->pairs == c->room) {
        const size_t room = c->room == 0 ? 64 : 2 * c->room;
        finder_pair *grown = realloc(c->pair, room * sizeof *grown);
        if (grown == NULL) {
            c->no_memory = true;
            return false;
        }
        c->pair = grown;
        c->room = room;
    }
    c->pair[c->pairs++] = *p;
    return true;
}

static bool look_at(chunk *c, uint32_t x, uint32_t y) {
    const search *s = c->s;
    const uint32_t *of = s->m->of;
    const uint32_t i = s->t.item[x];
    const uint32_t j = s->t.item[y];
    const bool turned = of[i] != of[j] ? of[i] > of[j] : i > j;
    finder_pair p = {.triangle = {turned ? j : i, turned ? i : j}};
    const double *a[3];
    const double *b[3];
    overlap o;
    c->work += WORK_LOOK;
    corners_of(s->m, p.triangle[0], a);
    corners_of(s->m, p.triangle[1], b);
    if (!overlap_find(a, b, s->asked->gap, s->sine, &o))
        return true;
    const finder_filter filter = filter_of(s, &p, &o);
    if (filter != FINDER_FILTERS) {
        c->left_out[filter]++;
        return true;
    }
    p.gap_lo = o.lo;
    p.gap_hi = o.hi;
    p.area = o.area;
    memcpy(p.place, o.place, sizeof p.place);
    return keep(c, &p);
}

static bool visit(void *context, uint32_t leaf) {
    chunk *c = context;
    const search *s = c->s;
    const tree *t = &s->t;
    for (uint32_t x = tree_first(t, c->leaf); x < tree_first(t, c->leaf + 1); x++) {
        const float *n = s->normal[x];
        uint32_t y = tree_first(t, leaf);
        for (y = y > x ? y : x + 1; y < tree_first(t, leaf + 1); y++) {
            const float *o = s->normal[y];
            c->work++;
            if (fabsf(n[0] * o[0] + n[1] * o[1] + n[2] * o[2]) >= c->cosine && tree_meet(&t->box[x], &t->box[y]) &&
                !look_at(c, x, y))
                return false;
        }
    }
    c->cut = c->work > c->work_max;
    if (c->work - c->told > WORK_TELL) {
        c->told = c->work;
        c->stopped = !pairs_progress(s, PAIRS_SHARE * c->leaf / t->leaves);
    }
    return !c->cut && !c->stopped;
}

/* ---- All of them --------------------------------------------------------------------------------------------------
 */

static void run_chunk(chunk *c, uint32_t number) {
    const tree *t = &c->s->t;
    const uint32_t end = number * CHUNK + CHUNK < t->leaves ? number * CHUNK + CHUNK : t->leaves;
    for (c->leaf = number * CHUNK; c->leaf < end; c->leaf++)
        if (!tree_query(t, &t->node[t->leaves + c->leaf], c->leaf, visit, c))
            return;
}

/* Adds what a chunk has found, up to the most that is kept; false: there is no memory. */
static bool gather(finder_found *f, const chunk *c, size_t most) {
    const size_t taken = c->pairs < most - f->pairs ? c->pairs : most - f->pairs;
    f->cut = c->cut || taken < c->pairs;
    for (int k = 0; k < FINDER_FILTERS; k++)
        f->left_out[k] += c->left_out[k];
    if (taken == 0)
        return true;
    finder_pair *grown = realloc(f->pair, (f->pairs + taken) * sizeof *grown);
    if (grown == NULL)
        return false;
    f->pair = grown;
    memcpy(f->pair + f->pairs, c->pair, taken * sizeof *grown);
    f->pairs += taken;
    return true;
}

/* A round of `count` chunks from `first` on; what is left of the work is taken off *work. */
static finder_status run_round(search *s, uint32_t first, uint32_t count, size_t most, uint64_t *work) {
    chunk chunks[ROUND_MAX];
    finder_found *f = &s->found;
    finder_status status = FINDER_DONE;
    for (uint32_t i = 0; i < count; i++)
        chunks[i] = (chunk){.s = s,
                            .cosine = (float)sqrt(1.0 - s->sine * s->sine) - FLOAT_SLACK,
                            .work_max = *work,
                            .pairs_max = most - f->pairs};
#pragma omp parallel for schedule(dynamic) num_threads(s->threads)
    for (uint32_t i = 0; i < count; i++)
        run_chunk(&chunks[i], first + i);
    for (uint32_t i = 0; i < count; i++) {
        chunk *c = &chunks[i];
        status = c->stopped ? FINDER_STOPPED : c->no_memory ? FINDER_NO_MEMORY : status;
        if (status == FINDER_DONE && !f->cut && !gather(f, c, most))
            status = FINDER_NO_MEMORY;
        f->cut = f->cut || c->work > *work;
        *work -= c->work < *work ? c->work : *work;
        free(c->pair);
    }
    return status;
}

static finder_status run(search *s) {
    const size_t most = s->asked->pairs_max == 0 ? FINDER_PAIRS_MAX : s->asked->pairs_max;
    const uint32_t chunks = (s->t.leaves + CHUNK - 1) / CHUNK;
    uint64_t work = WORK_MAX + (uint64_t)s->t.items * WORK_EACH;
    uint32_t count = 1;
    finder_status status = FINDER_DONE;
    for (uint32_t first = 0; first < chunks && status == FINDER_DONE && !s->found.cut; first += count) {
        count = first < ROUND_MAX ? count + (first > 0) : ROUND_MAX;
        count = count < chunks - first ? count : chunks - first;
        status = run_round(s, first, count, most, &work);
        if (status == FINDER_DONE && !pairs_progress(s, PAIRS_SHARE * (first + count) / chunks))
            status = FINDER_STOPPED;
    }
    return status;
}

/* ---- The tree -----------------------------------------------------------------------------------------------------
 */

/* The triangles that have an area, their boxes and normals; the arrays are freed by the caller. */
static uint32_t fill(search *s, uint32_t *triangle, tree_box *box) {
    uint32_t items = 0;
    for (uint32_t i = 0; i < (uint32_t)s->m->triangles; i++) {
        const double *t[3];
        double n[3];
        corners_of(s->m, i, t);
        if (!exact_normal(t, n)) {
            s->found.degenerate++;
            continue;
        }
        triangle[items] = i;
        /* half the gap each, and what the distance's rounding may add */
        box[items++] = tree_box_of(t, 3, s->origin, 0.5 * s->asked->gap * (1.0 + 1e-9));
    }
    return items;
}

static void set_normal(search *s, uint32_t at) {
    const double *t[3];
    double n[3];
    corners_of(s->m, s->t.item[at], t);
    exact_normal(t, n);
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++)
        s->normal[at][k] = (float)(n[k] / length);
}

/* Each step is a second of millions of triangles: between them it may be stopped. */
static finder_status build(search *s) {
    uint32_t *triangle = malloc(s->m->triangles * sizeof *triangle);
    tree_box *box = malloc(s->m->triangles * sizeof *box);
    finder_status status = triangle != NULL && box != NULL ? FINDER_DONE : FINDER_NO_MEMORY;
    const uint32_t items = status == FINDER_DONE ? fill(s, triangle, box) : 0;
    if (items > 0)
        status = !pairs_progress(s, 0.0)                     ? FINDER_STOPPED
                 : tree_build(&s->t, box, items, s->threads) ? FINDER_DONE
                                                             : FINDER_NO_MEMORY;
    free(box);
    if (status == FINDER_DONE && items > 0) {
        s->normal = malloc(items * sizeof *s->normal);
        status = s->normal == NULL ? FINDER_NO_MEMORY : pairs_progress(s, 0.0) ? FINDER_DONE : FINDER_STOPPED;
    }
    for (uint32_t i = 0; status == FINDER_DONE && i < items; i++) {
        s->t.item[i] = triangle[s->t.item[i]];
        set_normal(s, i);
    }
    free(triangle);
    return status;
}

finder_status pairs_find(search *s) {
    if (s->m->triangles == 0)
        return FINDER_DONE;
    const finder_status status = build(s);
    return status == FINDER_DONE && s->t.items > 0 ? run(s) : status;
}
