/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "raster/vertex_compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "core/bits.h"
#include "core/elementary.h"
#include "core/engine.h"

/* ---- Vertices ---------------------------------------------------------------------------------------------------- */

static const struct {
    const char *name, *note;
} spreads[VERTEX_SPREAD_COUNT] = {
    [VERTEX_EYE_LOG] = {"eye-log", "eye depth log-uniform over the range, in a round view of 90 degrees"},
    [VERTEX_BOX] = {"box", "uniform in the box of the camera, those within the range"},
};

const char *vertex_spread_name(vertex_spread spread) {
    return (unsigned)spread < VERTEX_SPREAD_COUNT ? spreads[spread].name : NULL;
}

const char *vertex_spread_note(vertex_spread spread) {
    return (unsigned)spread < VERTEX_SPREAD_COUNT ? spreads[spread].note : NULL;
}

/* The numbers that a vertex takes, each uniform in [0, 1). */
enum { CAMERA_X, CAMERA_Y, CAMERA_Z, TURN, TILT, ACROSS, AROUND, DEPTH, DRAWS };

static double draw(uint64_t seed, uint64_t i, int which) {
    return dp_uniform(dp_draw64(seed, i * DRAWS + (uint64_t)which));
}

static const double tau = 6.283185307179586;

/* Two axes across a third, after Duff et al. 2017, Building an orthonormal basis, revisited. */
static void across(const double n[3], double s[3], double t[3]) {
    const double sign = copysign(1.0, n[2]);
    const double a = -1.0 / (sign + n[2]);
    const double b = n[0] * n[1] * a;
    s[0] = 1.0 + sign * n[0] * n[0] * a;
    s[1] = sign * b;
    s[2] = -sign * n[0];
    t[0] = b;
    t[1] = sign + n[1] * n[1] * a;
    t[2] = -n[1];
}

/* A point at a depth drawn, at most that far beside the axis. */
static void place_in_view(const vertex_request *r, uint64_t i, vertex_drawn *v) {
    const double beside = sqrt(draw(r->seed, i, ACROSS));
    const double angle = tau * draw(r->seed, i, AROUND);
    const double x = beside * dp_cos(angle), y = beside * dp_sin(angle);
    double s[3], t[3];
    v->z = r->lo * dp_exp(draw(r->seed, i, DEPTH) * dp_log(r->hi / r->lo));
    across(v->axis, s, t);
    for (int k = 0; k < 3; k++)
        v->position[k] = (float)(v->place[k] + v->z * (v->axis[k] + x * s[k] + y * t[k]));
}

static void place_in_box(const vertex_request *r, uint64_t i, vertex_drawn *v) {
    static const int numbers[3] = {ACROSS, AROUND, DEPTH};
    v->z = 0.0;
    for (int k = 0; k < 3; k++) {
        const double x = r->world * (2.0 * draw(r->seed, i, numbers[k]) - 1.0);
        v->z += v->axis[k] * (x - v->place[k]);
        v->position[k] = (float)x;
    }
}

bool vertex_draw(const vertex_request *r, uint64_t i, vertex_drawn *v) {
    const double angle = tau * draw(r->seed, i, TURN);
    const double up = 2.0 * draw(r->seed, i, TILT) - 1.0;
    const double level = sqrt(1.0 - up * up);
    v->axis[0] = level * dp_cos(angle);
    v->axis[1] = level * dp_sin(angle);
    v->axis[2] = up;
    for (int k = 0; k < 3; k++)
        v->place[k] = r->world * (2.0 * draw(r->seed, i, CAMERA_X + k) - 1.0);
    (r->spread == VERTEX_BOX ? place_in_box : place_in_view)(r, i, v);
    return r->spread != VERTEX_BOX || (v->z >= r->lo && v->z <= r->hi);
}

/* ---- Differences ------------------------------------------------------------------------------------------------- */

/* How often each difference occurs: exact up to 2^12 codes, then 2^11 steps an octave. */
enum { FINE_BITS = 11, FINE = 1 << FINE_BITS, BINS = FINE * (32 - FINE_BITS + 1) };

static int octave_of(uint32_t codes) {
    int shift = 0;
    while (codes >> shift >= 2 * FINE)
        shift++;
    return shift;
}

static size_t bin_of(uint32_t codes) {
    const int shift = octave_of(codes);
    return (size_t)shift * FINE + (codes >> shift);
}

static uint32_t end_of_bin(size_t bin) {
    const size_t shift = bin < 2 * FINE ? 0 : bin / FINE - 1;
    const uint64_t next = ((uint64_t)(bin - shift * FINE) + 1) << shift;
    return (uint32_t)(next - 1);
}

typedef struct tally {
    vertex_difference found;
    uint64_t bins[BINS];
} tally;

/* In units of 2^e; below the normal numbers of a format there is one e. */
static double in_exponents(const dp_format *format, vertex_gap g) {
    const double least = dp_power2(format->kind == DP_FORMAT_FLOAT ? 1 - format->bias : -126);
    return g.bias / dp_power2(dp_exponent(fmax(g.depth, least)));
}

static void take_gap(const dp_format *format, vertex_difference *d, vertex_gap g) {
    if (g.bias > d->widest.bias)
        d->widest = g;
    if (in_exponents(format, g) > in_exponents(format, d->steepest))
        d->steepest = g;
}

static void take_most(vertex_difference *d, uint32_t codes, double z) {
    if (codes > d->most || (codes == d->most && codes > 0 && z < d->most_z)) {
        d->most = codes;
        d->most_z = z;
    }
}

typedef struct stored {
    double depth; /* in [0, 1] */
    uint32_t code;
} stored;

static stored store(const dp_pipeline *p, vertex_clip clip) {
    const float d = dp_pipeline_divide(p, clip.z, clip.w);
    const float held = d > 0.0f ? (d < 1.0f ? d : 1.0f) : 0.0f; /* NaN becomes 0 */
    return (stored){(double)held, dp_pipeline_convert(p, held)};
}

static vertex_gap gap_of(const dp_pipeline *p, double a, double b) {
    const double greater = fmax(a, b), lesser = fmin(a, b);
    return (vertex_gap){greater - lesser, p->reversed ? lesser : greater};
}

static void compare_one(const vertex_request *r, const dp_pipeline *p, uint64_t i, tally *tallies) {
    vertex_drawn v;
    if (!vertex_draw(r, i, &v))
        return;
    const vertex_camera camera = vertex_camera_of(r->setup, p, v.axis, v.place);
    const stored first = store(p, vertex_run(r->base, &camera, v.position));
    for (size_t k = 0; k < r->others; k++) {
        const stored second = store(p, vertex_run(r->other[k], &camera, v.position));
        const uint32_t codes = first.code > second.code ? first.code - second.code : second.code - first.code;
        vertex_difference *d = &tallies[k].found;
        tallies[k].bins[bin_of(codes)]++;
        d->vertices++;
        d->differ += codes > 0;
        take_most(d, codes, v.z);
        if (codes > 0)
            take_gap(&p->format, d, gap_of(p, first.depth, second.depth));
    }
}

static void add_tally(const dp_format *format, tally *all, const tally *mine) {
    const vertex_difference *d = &mine->found;
    all->found.vertices += d->vertices;
    all->found.differ += d->differ;
    take_most(&all->found, d->most, d->most_z);
    take_gap(format, &all->found, d->widest);
    take_gap(format, &all->found, d->steepest);
    for (size_t i = 0; i < BINS; i++)
        all->bins[i] += mine->bins[i];
}

static uint32_t percentile_of(const tally *t) {
    uint64_t left = t->found.vertices / 100; /* as many may be above */
    size_t bin = BINS - 1;
    while (bin > 0 && t->bins[bin] <= left)
        left -= t->bins[bin--];
    const uint32_t end = end_of_bin(bin);
    return end < t->found.most ? end : t->found.most;
}

static int threads_of(const vertex_request *r) {
#ifdef _OPENMP
    return r->threads > 0 ? r->threads : omp_get_max_threads();
#else
    return r->threads > 0 ? r->threads : 1;
#endif
}

/* False where there is no memory for a thread's own numbers. */
static bool compare_all(const vertex_request *r, const dp_pipeline *p, tally *all) {
    enum { BLOCK = 4096 };
    uint64_t done = 0;
    bool fine = true;
#pragma omp parallel num_threads(threads_of(r)) if (r->count > BLOCK)
    {
        tally *mine = calloc(r->others, sizeof *mine);
#pragma omp for schedule(dynamic)
        for (uint64_t from = 0; from < r->count; from += BLOCK) {
            const uint64_t end = r->count - from < BLOCK ? r->count : from + BLOCK;
            for (uint64_t i = from; i < end && mine != NULL; i++)
                compare_one(r, p, i, mine);
#pragma omp critical(vertex_progress)
            {
                done += end - from;
                if (r->progress != NULL)
                    r->progress(r->context, done);
            }
        }
#pragma omp critical(vertex_add)
        for (size_t k = 0; k < r->others; k++) {
            fine = fine && mine != NULL;
            if (mine != NULL)
                add_tally(&p->format, &all[k], &mine[k]);
        }
        free(mine);
    }
    return fine;
}

bool vertex_compare(const vertex_request *r, vertex_difference out[VERTEX_OTHERS]) {
    dp_pipeline p;
    tally *all = calloc(r->others, sizeof *all);
    bool fine = all != NULL && dp_pipeline_init(&p, r->setup) == DP_OK && compare_all(r, &p, all);
    for (size_t k = 0; k < r->others && fine; k++) {
        out[k] = all[k].found;
        out[k].percentile = percentile_of(&all[k]);
        out[k].most_z = out[k].most > 0 ? out[k].most_z : (double)NAN;
    }
    free(all);
    return fine;
}
