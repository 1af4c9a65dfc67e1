/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _GNU_SOURCE /* qsort_r() */
#include "scene/find.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "core/elementary.h"
#include "scene/body.h"
#include "scene/hidden.h"
#include "scene/pairs.h"
#include "system/posix.h"

/* The share of the extent within which surfaces touch: binary32 files hardly ever hold exactly touching ones. */
#define AGAINST 1e-9

enum { TELL = 1 << 12 };

/* ---- What is asked, and of what -----------------------------------------------------------------------------------
 */

static int threads_of(const finder_asked *asked) {
#ifdef _OPENMP
    return asked->threads > 0 ? asked->threads : omp_get_max_threads();
#else
    (void)asked;
    return 1;
#endif
}

static bool in_range(double x, double hi) {
    return x >= 0.0 && x <= hi;
}

/* The middle and the diagonal of the model's box; false: a coordinate is out of range. */
static bool measure_box(search *s) {
    const model_box b = model_box_of(s->m);
    for (int k = 0; k < 3; k++) {
        if (b.lo[k] < -FINDER_COORDINATE_MAX || b.hi[k] > FINDER_COORDINATE_MAX)
            return false;
        s->origin[k] = 0.5 * b.lo[k] + 0.5 * b.hi[k];
    }
    s->extent = model_box_diagonal(&b);
    return true;
}

/* ---- What closed bodies hide --------------------------------------------------------------------------------------
 */

/* Whether a pair is hidden from each side that shows both triangles; without such a side, the user asked for it. */
static bool is_hidden(const hidden_among *among, const finder_pair *p, double gap) {
    const model *m = among->m;
    const bool both_a = m->surface[m->of[p->triangle[0]]].two_sided;
    const bool both_b = m->surface[m->of[p->triangle[1]]].two_sided;
    overlap o;
    pairs_overlap(m, p->triangle, gap, &o);
    const bool front = !o.opposite || both_b;
    const bool back = both_a && (o.opposite || both_b);
    return (front || back) && (!front || hidden_from(among, &o, true)) && (!back || hidden_from(among, &o, false));
}

/* Leaves out what is hidden; the pairs that stay keep their order. */
static finder_status leave_hidden_out(search *s) {
    finder_found *f = &s->found;
    uint32_t *body = body_numbers(s->m);
    uint8_t *hidden = malloc(f->pairs);
    const hidden_among among = {s->m, &s->t, s->origin, body, s->asked->gap, AGAINST * s->extent};
    bool stopped = false;
    finder_status status = body != NULL && hidden != NULL ? FINDER_DONE : FINDER_NO_MEMORY;
    for (size_t first = 0; first < f->pairs && status == FINDER_DONE; first += TELL) {
        const size_t end = first + TELL < f->pairs ? first + TELL : f->pairs;
#pragma omp parallel for schedule(dynamic, 16) num_threads(s->threads)
        for (size_t i = first; i < end; i++)
            hidden[i] = is_hidden(&among, &f->pair[i], s->asked->gap);
        stopped = !pairs_progress(s, PAIRS_SHARE + (1.0 - PAIRS_SHARE) * (double)end / (double)f->pairs);
        status = stopped ? FINDER_STOPPED : FINDER_DONE;
    }
    size_t kept = 0;
    for (size_t i = 0; i < f->pairs && status == FINDER_DONE; i++)
        if (!hidden[i])
            f->pair[kept++] = f->pair[i];
    if (status == FINDER_DONE) {
        f->left_out[FINDER_HIDDEN] = f->pairs - kept;
        f->pairs = kept;
    }
    free(body);
    free(hidden);
    return status;
}

/* ---- Findings -----------------------------------------------------------------------------------------------------
 */

static int order(double x, double y) {
    return (x > y) - (x < y);
}

static int by_surfaces(const void *x, const void *y, void *context) {
    const finder_pair *p = x;
    const finder_pair *q = y;
    const uint32_t *of = ((const search *)context)->m->of;
    for (int k = 0; k < 2; k++)
        if (of[p->triangle[k]] != of[q->triangle[k]])
            return of[p->triangle[k]] < of[q->triangle[k]] ? -1 : 1;
    if (p->area != q->area)
        return order(q->area, p->area);
    for (int k = 0; k < 2; k++)
        if (p->triangle[k] != q->triangle[k])
            return p->triangle[k] < q->triangle[k] ? -1 : 1;
    return 0;
}

static int worst_first(const void *x, const void *y) {
    const finder_finding *p = x;
    const finder_finding *q = y;
    const int by_gap = order(p->gap_min, q->gap_min);
    const int by_area = order(q->area, p->area);
    return by_gap != 0 ? by_gap : by_area != 0 ? by_area : order((double)p->first, (double)q->first);
}

static void add_pair(const search *s, finder_finding *g, const finder_pair *p) {
    const double nearest = p->gap_lo > 0.0 ? p->gap_lo : p->gap_hi < 0.0 ? -p->gap_hi : 0.0;
    overlap o;
    g->gap_min = fmin(g->gap_min, nearest);
    g->gap_max = fmax(g->gap_max, fmax(fabs(p->gap_lo), fabs(p->gap_hi)));
    g->area += p->area;
    pairs_overlap(s->m, p->triangle, s->asked->gap, &o);
    for (int i = 0; i < o.corners; i++)
        for (int k = 0; k < 3; k++) {
            g->lo[k] = fmin(g->lo[k], o.corner[i][k]);
            g->hi[k] = fmax(g->hi[k], o.corner[i][k]);
        }
    if (g->pairs++ == 0) {
        memcpy(g->place, p->place, sizeof g->place);
        memcpy(g->normal, o.normal, sizeof g->normal);
    }
}

static bool same_surfaces(const model *m, const finder_pair *p, const finder_pair *q) {
    return m->of[p->triangle[0]] == m->of[q->triangle[0]] && m->of[p->triangle[1]] == m->of[q->triangle[1]];
}

static finder_status group(search *s) {
    finder_found *f = &s->found;
    const model *m = s->m;
    if (f->pairs == 0)
        return FINDER_DONE;
    qsort_r(f->pair, f->pairs, sizeof *f->pair, by_surfaces, s);
    size_t count = 0;
    for (size_t i = 0; i < f->pairs; i++)
        count += i == 0 || !same_surfaces(m, &f->pair[i - 1], &f->pair[i]);
    f->finding = malloc(count * sizeof *f->finding);
    if (f->finding == NULL)
        return FINDER_NO_MEMORY;
    for (size_t i = 0; i < f->pairs; i++) {
        const finder_pair *p = &f->pair[i];
        if (i % TELL == 0 && !pairs_progress(s, 1.0))
            return FINDER_STOPPED;
        if (i == 0 || !same_surfaces(m, p - 1, p))
            f->finding[f->findings++] = (finder_finding){.a = m->of[p->triangle[0]],
                                                         .b = m->of[p->triangle[1]],
                                                         .gap_min = INFINITY,
                                                         .lo = {INFINITY, INFINITY, INFINITY},
                                                         .hi = {-INFINITY, -INFINITY, -INFINITY},
                                                         .first = i};
        add_pair(s, &f->finding[f->findings - 1], p);
    }
    if (f->findings > 1) /* none: no array either */
        qsort(f->finding, f->findings, sizeof *f->finding, worst_first);
    return FINDER_DONE;
}

/* ---- The search ---------------------------------------------------------------------------------------------------
 */

finder_status finder_find(const model *m, const finder_asked *asked, finder_found *out) {
    search s = {.m = m, .asked = asked, .threads = threads_of(asked)};
    *out = (finder_found){0};
    if (!in_range(asked->gap, FINDER_COORDINATE_MAX) || !in_range(asked->angle, FINDER_ANGLE_MAX) ||
        !in_range(asked->width, FINDER_COORDINATE_MAX) || !measure_box(&s))
        return FINDER_RANGE;
    s.sine = dp_sin(asked->angle * DP_DEGREE);
    s.found.extent = s.extent;
    finder_status status = pairs_find(&s);
    if (status == FINDER_DONE && s.found.pairs > 0 && (asked->off >> FINDER_HIDDEN & 1) == 0)
        status = leave_hidden_out(&s);
    if (status == FINDER_DONE)
        status = group(&s);
    tree_free(&s.t);
    free(s.normal);
    if (status == FINDER_DONE)
        *out = s.found;
    else
        finder_free(&s.found);
    return status;
}

void finder_free(finder_found *found) {
    free(found->finding);
    free(found->pair);
    *found = (finder_found){0};
}

int finder_corners(const model *m, const uint32_t triangle[2], double gap, double corner[FINDER_CORNERS][3]) {
    overlap o;
    pairs_overlap(m, triangle, gap, &o);
    memcpy(corner, o.corner, (size_t)o.corners * sizeof *corner);
    return o.corners;
}
