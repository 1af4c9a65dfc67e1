/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "raster/fight.h"

#include <math.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "core/elementary.h"
#include "raster/mesh.h"

enum { FARTHER = 1, NEARER = 2, BOTH = 3 };
enum { CHUNK = 32 /* pairs that share what was found */ };

/* Shares of the guarantee: where the walk ends at the latest, and from one to the next. Planes nearer to edge-on than
 * the last have no depth. */
static const double least_share = 0x1p-10, each = 0.8, least_facing = 1e-9;

/* Two planes and how they are parted into triangles. */
typedef struct pair {
    draw_plane plane; /* the farther one */
    draw_mesh mesh[2];
    draw_area area;
    double slant, guaranteed; /* at the pixel in the middle */
    double lead;              /* how much more of the guarantee the nearest pixel may use than that in the middle */
    double start;             /* the first share below the guarantee */
} pair;

/* ---- A pair at random -------------------------------------------------------------------------------------------- */

double draw_guaranteed(const dp_setup *setup, double slant, double z) {
    dp_setup at_slant = *setup;
    dp_budget budget;
    at_slant.spec.triangles.slant_lo = at_slant.spec.triangles.slant_hi = slant;
    return dp_budget_at(&at_slant, z, NULL, &budget) == DP_OK ? budget.separation : (double)INFINITY;
}

/* The least eye depth of the farther plane in the area, none below `lo`. */
static double nearest_of(const draw_camera *camera, const pair *p, double lo) {
    double most = 0.0;
    for (int corner = 0; corner < 4; corner++) {
        const double window[2] = {p->area.x + (corner & 1) * p->area.width, p->area.y + (corner >> 1) * p->area.height};
        most = fmax(most, draw_facing(camera, &p->plane, window));
    }
    return fmax(p->plane.distance / most, lo);
}

/* False where the plane is not seen at the pixel, or nothing in front of it is certain. */
static bool random_pair(const draw_fight_request *r, const draw_fight_band *band, uint64_t *state, pair *out) {
    const dp_triangles *t = &r->setup->spec.triangles;
    const int x = (int)(draw_random(state) % (uint64_t)r->camera->target.width);
    const int y = (int)(draw_random(state) % (uint64_t)r->camera->target.height);
    const double window[2] = {x + 0.5, y + 0.5};
    const double any = 360.0 * draw_uniform(state);
    const double azimuth = (isnan(r->azimuth) ? any : r->azimuth) * DP_DEGREE;
    out->slant = t->slant_lo + (t->slant_hi - t->slant_lo) * draw_uniform(state);
    const double angle = out->slant * DP_DEGREE, z = draw_log_uniform(state, band->lo, band->hi);
    out->plane =
        (draw_plane){.normal = {dp_sin(angle) * dp_cos(azimuth), dp_sin(angle) * dp_sin(azimuth), dp_cos(angle)}};
    for (int k = 0; k < 2; k++)
        out->mesh[k] = draw_mesh_random(t, window, state);
    out->area = draw_mesh_area(r->camera, x, y, out->mesh);
    const double facing = draw_facing(r->camera, &out->plane, window);
    out->plane.distance = z * facing;
    if (!(facing > least_facing))
        return false;
    out->guaranteed = draw_guaranteed(r->setup, out->slant, z);
    out->lead = out->guaranteed / draw_guaranteed(r->setup, out->slant, nearest_of(r->camera, out, band->lo));
    out->start = 1.0 - (1.0 - each) * draw_uniform(state);
    return isfinite(out->guaranteed);
}

/* ---- One drawing ------------------------------------------------------------------------------------------------- */

/* The eye depth of the nearest wrong pixel of the band; INFINITY where there is none. */
static double nearest_wrong(const draw_fight_request *r, const draw_buffer *b, const draw_plane *plane,
                            draw_fight_band *band) {
    const draw_area *area = &b->area;
    const double row_step[2] = {area->x + 1.5, area->y + 0.5};
    double least = INFINITY;
    for (int y = 0; y < area->height; y++) {
        const double first[2] = {area->x + 0.5, row_step[1] + y}, second[2] = {row_step[0], row_step[1] + y};
        const double facing = draw_facing(r->camera, plane, first);
        const double step = draw_facing(r->camera, plane, second) - facing;
        const size_t row = (size_t)y * (size_t)area->width;
        for (int x = 0; x < area->width; x++) {
            const double z = plane->distance / (facing + x * step);
            if (b->seen[row + (size_t)x] != BOTH || !(z >= band->lo && z < band->hi))
                continue;
            band->pixels++;
            if (b->winner[row + (size_t)x] == FARTHER && z < least)
                least = z;
        }
    }
    return least;
}

/* Draws a pair at a share of its guarantee; keeps the wrong pixel that uses the most. */
static void draw_pair(const draw_fight_request *r, draw_buffer *b, const pair *p, double share, draw_fight_band *band) {
    const double separation = share * p->guaranteed;
    const double left = 1.0 - separation / p->plane.distance;
    draw_plane nearer = p->plane;
    dp_triangles class = r->setup->spec.triangles;
    if (!(left > 0.0))
        return;
    draw_buffer_clear(b, p->area);
    draw_mesh_plane(b, r->camera, &p->plane, &p->mesh[0], &class, FARTHER);
    nearer.distance -= separation;
    class.depth *= left; /* that of the class is about the farther plane's depth */
    draw_mesh_plane(b, r->camera, &nearer, &p->mesh[1], &class, NEARER);
    const double z = nearest_wrong(r, b, &p->plane, band);
    if (isinf(z))
        return;
    const double guaranteed = draw_guaranteed(r->setup, p->slant, z);
    if (!(separation / guaranteed <= band->used))
        *band = (draw_fight_band){band->lo, band->hi, band->pixels, separation,
                                  z,        p->slant, guaranteed,   separation / guaranteed};
}

/* From the guarantee downwards, as long as a wrong pixel would use more of it than those before. */
static void walk_down(const draw_fight_request *r, draw_buffer *b, const pair *p, draw_fight_band *band) {
    double share = 1.0;
    draw_pair(r, b, p, share, band);
    for (share = p->start; share > least_share && !(share * p->lead <= band->used); share *= each)
        draw_pair(r, b, p, share, band);
}

/* ---- All of them ------------------------------------------------------------------------------------------------- */

static void merge_bands(draw_fight_band *to, const draw_fight_band *found) {
    const uint64_t pixels = to->pixels + found->pixels;
    if (found->used > to->used || (isnan(to->used) && !isnan(found->used)) ||
        (found->used == to->used && found->z < to->z))
        *to = *found;
    to->pixels = pixels;
}

static draw_fight_band band_of(double lo, double hi) {
    const double none = (double)NAN;
    return (draw_fight_band){lo, hi, 0, none, none, none, none, none};
}

/* The binades. */
static int bands_of(const draw_fight_request *r, draw_fight_band *bands) {
    int count = 0;
    for (double lo = r->lo; lo < r->hi && count < DRAW_BANDS_MAX; count++) {
        bands[count] = band_of(lo, fmin(ldexp(1.0, ilogb(lo) + 1), r->hi));
        lo = bands[count].hi;
    }
    return count;
}

draw_fight_band draw_fight_worst(const draw_fight_result *result) {
    const int last = result->band_count - 1;
    draw_fight_band worst = band_of(result->bands[0].lo, result->bands[last].hi);
    for (int i = 0; i <= last; i++) {
        draw_fight_band here = result->bands[i];
        here.lo = worst.lo;
        here.hi = worst.hi;
        merge_bands(&worst, &here);
    }
    return worst;
}

static uint64_t rounded_up(uint64_t count, uint64_t by) {
    return count / by + (count % by > 0);
}

uint64_t draw_fight_count(const draw_fight_request *request) {
    draw_fight_band bands[DRAW_BANDS_MAX];
    const uint64_t count = (uint64_t)bands_of(request, bands);
    return rounded_up(request->count, count) * count;
}

/* Pairs `from` to `to` of a band share what they find, so that it does not depend on the threads. */
static draw_fight_band work(const draw_fight_request *r, draw_buffer *b, const draw_fight_band *band, int index,
                            uint64_t from, uint64_t to) {
    draw_fight_band found = band_of(band->lo, band->hi);
    for (uint64_t i = from; i < to; i++) {
        uint64_t state = r->seed;
        uint64_t of_pair = draw_random(&state) ^ ((uint64_t)index << 48 | i);
        state = draw_random(&of_pair);
        pair p;
        if (random_pair(r, band, &state, &p))
            walk_down(r, b, &p, &found);
    }
    return found;
}

/* Adds what the pairs of a chunk found, and tells how many are done. Returns whether to stop. */
static int finish(const draw_fight_request *r, draw_fight_band *band, const draw_fight_band *found, uint64_t *done,
                  uint64_t count) {
    merge_bands(band, found);
    *done += count;
    return r->progress != NULL ? r->progress(r->context, *done) : 0;
}

static int threads_of(const draw_fight_request *r) {
#ifdef _OPENMP
    return r->threads > 0 ? r->threads : omp_get_max_threads();
#else
    (void)r;
    return 1;
#endif
}

/* The state that the threads share. */
typedef struct progress {
    uint64_t next, done; /* chunks that were begun, pairs that are done */
    int stop, failed;
    int threads;
} progress;

/* The next chunk; at least `count` where there is none, or no more is wanted. */
static uint64_t next_chunk(progress *p, uint64_t count) {
    uint64_t chunk;
    int stop;
#pragma omp atomic read
    stop = p->stop;
    if (stop)
        return count;
#pragma omp atomic capture
    chunk = p->next++;
    return chunk;
}

draw_fight_status draw_fight(const draw_fight_request *request, draw_fight_result *result) {
    const draw_fight_request *r = request;
    result->band_count = bands_of(r, result->bands);
    const uint64_t bands = (uint64_t)result->band_count, each_band = rounded_up(r->count, bands);
    const uint64_t chunks = rounded_up(each_band, CHUNK) * bands;
    progress p = {.threads = threads_of(r)};
#pragma omp parallel num_threads(p.threads)
    {
        draw_buffer buffer;
        const bool ready = draw_buffer_open(&buffer, DRAW_MESH_ROOM);
        for (uint64_t i = ready ? next_chunk(&p, chunks) : chunks; i < chunks; i = next_chunk(&p, chunks)) {
            draw_fight_band *band = &result->bands[i % bands];
            const uint64_t from = i / bands * CHUNK, to = from + CHUNK < each_band ? from + CHUNK : each_band;
            const draw_fight_band found = work(r, &buffer, band, (int)(i % bands), from, to);
#pragma omp critical(draw_fight_done)
            if (finish(r, band, &found, &p.done, to - from)) {
#pragma omp atomic write
                p.stop = 1;
            }
        }
        if (!ready) {
#pragma omp atomic write
            p.failed = 1;
        }
        draw_buffer_close(&buffer);
    }
    return p.failed ? DRAW_FIGHT_NO_MEMORY : p.stop ? DRAW_FIGHT_STOPPED : DRAW_FIGHT_DONE;
}
