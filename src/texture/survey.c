/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/survey.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/engine.h"
#include "shader/oblique.h"
#include "texture/strips.h"

/* Bands by rank: band i holds the ranks from start[i] up to start[i + 1]. */
typedef struct bands {
    size_t count;
    double edge[SURVEY_BANDS + 1];
    uint32_t start[SURVEY_BANDS + 1];
} bands;

typedef struct surveying {
    const frame *f;
    const dp_setup *setup;
    uint64_t *used; /* a bit a rank */
    uint32_t sky;
    bands bands;
    uint64_t pixels[SURVEY_BANDS];
    uint64_t sky_pixels, true_sky, invalid;
} surveying;

static double stored(const dp_setup *setup, uint32_t rank) {
    return dp_stored(setup, frame_code(setup, rank));
}

/* The first rank whose depth is z or more, at most `most`. */
static uint32_t rank_from(const dp_setup *setup, double z, uint32_t most) {
    uint32_t rank = frame_rank(setup, dp_code(setup, z));
    while (rank < most && stored(setup, rank) < z)
        rank++;
    while (rank > 0 && stored(setup, rank - 1) >= z)
        rank--;
    return rank < most ? rank : most;
}

/* Where even powers of ten are too many (a float stores depths up to 1e44), the last band takes what is left. */
static size_t edges_between(double lo, double hi, const int *factors, size_t factor_count, double *edge) {
    size_t count = 0;
    for (int power = (int)floor(dp_log10(lo)); power <= (int)ceil(dp_log10(hi)); power++)
        for (size_t i = 0; i < factor_count; i++) {
            const double at = power < 0 ? factors[i] / dp_pow(10, -power) : factors[i] * dp_pow(10, power);
            if (at > lo && at < hi) {
                if (edge != NULL && count < SURVEY_BANDS - 1)
                    edge[count] = at;
                count++;
            }
        }
    return count;
}

/* Depths of either sign: decades on both sides of 0, down to where they are small against the largest. */
static size_t edges_about_0(double lo, double hi, double *edge) {
    enum { DECADES = 5 };
    const double most = fmax(fabs(lo), fabs(hi));
    const int top = (int)floor(dp_log10(most));
    size_t count = 0;
    for (int i = -DECADES; i <= DECADES; i++) {
        const int power = top - DECADES + abs(i);
        const double size = power < 0 ? 1 / dp_pow(10, -power) : dp_pow(10, power);
        const double at = i < 0 ? -size : size;
        if (i != 0 && at > lo && at < hi)
            edge[count++] = at;
    }
    return count;
}

static void make_bands(surveying *s, double hi) {
    static const int factors[] = {1, 2, 5};
    const double lo = s->setup->spec.znear;
    bands *b = &s->bands;
    size_t fine = 3;
    while (lo > 0 && fine > 1 && edges_between(lo, hi, factors, fine, NULL) > SURVEY_BANDS - 1)
        fine = 1;
    b->edge[0] = lo;
    b->count = 1 + (lo > 0 ? edges_between(lo, hi, factors, fine, b->edge + 1) : edges_about_0(lo, hi, b->edge + 1));
    if (b->count > SURVEY_BANDS)
        b->count = SURVEY_BANDS;
    b->edge[b->count] = hi;
    for (size_t i = 1; i < b->count; i++)
        b->start[i] = rank_from(s->setup, b->edge[i], s->sky);
    b->start[0] = 0;
    b->start[b->count] = s->sky;
}

static void mark(uint64_t *used, uint32_t rank) {
    uint64_t *word = &used[rank >> 6];
    const uint64_t bit = UINT64_C(1) << (rank & 63);
    if ((__atomic_load_n(word, __ATOMIC_RELAXED) & bit) == 0)
        __atomic_fetch_or(word, bit, __ATOMIC_RELAXED);
}

/* Adds one row to the survey. Neighbours often share a code, and nearly always a band. */
static void visit_row(surveying *s, uint32_t row, uint32_t *codes, surveying *mine) {
    const uint32_t width = s->f->camera->width;
    uint32_t last = UINT32_MAX;
    size_t band = 0;
    frame_codes(s->f, row, codes);
    for (uint32_t x = 0; x < width; x++) {
        if (codes[x] == UINT32_MAX) {
            mine->invalid++;
            continue;
        }
        const uint32_t rank = frame_rank(s->setup, codes[x]);
        if (rank >= s->sky) {
            mine->sky_pixels++;
            continue;
        }
        if (rank != last) {
            while (rank < s->bands.start[band])
                band--;
            while (rank >= s->bands.start[band + 1])
                band++;
            mark(s->used, rank);
            last = rank;
        }
        mine->pixels[band]++;
    }
    for (uint32_t x = 0; x < width && s->f->synthetic != NULL; x++) {
        synthetic_hit hit;
        s->f->synthetic->hit(s->f->camera, s->f->parameters, x, row, &hit);
        mine->true_sky += hit.surface == 0;
    }
}

enum { ROWS = 16 };

/* A thread's own counts, and the codes of a row. */
typedef struct visitor {
    surveying counts;
    uint32_t *codes;
} visitor;

typedef struct visiting {
    surveying *s;
    visitor *visitors;
} visiting;

static void visit_strip(void *context, size_t index, size_t slot, int thread) {
    const visiting *v = context;
    visitor *mine = &v->visitors[thread];
    (void)slot;
    for (uint32_t row = (uint32_t)index * ROWS; row < v->s->f->camera->height && row / ROWS == index; row++)
        visit_row(v->s, row, mine->codes, &mine->counts);
}

static void add_counts(surveying *s, const surveying *counts) {
    for (size_t i = 0; i < s->bands.count; i++)
        s->pixels[i] += counts->pixels[i];
    s->sky_pixels += counts->sky_pixels;
    s->true_sky += counts->true_sky;
    s->invalid += counts->invalid;
}

static bool visit(surveying *s) {
    const int threads = frame_threads(s->f);
    visiting v = {s, calloc((size_t)threads, sizeof(visitor))};
    bool good = v.visitors != NULL;
    for (int i = 0; i < threads && good; i++)
        good = (v.visitors[i].codes = malloc((size_t)s->f->camera->width * sizeof(uint32_t))) != NULL;
    good = good && strips_run(&(strips){(s->f->camera->height + ROWS - 1) / ROWS, threads, 1, visit_strip, NULL, &v});
    for (int i = 0; i < threads && v.visitors != NULL; i++) {
        add_counts(s, &v.visitors[i].counts);
        free(v.visitors[i].codes);
    }
    free(v.visitors);
    return good;
}

/* The first used rank from `rank` on and below `end`; `end` when there is none. */
static uint32_t next_used(const surveying *s, uint32_t rank, uint32_t end) {
    while (rank < end) {
        const uint64_t word = s->used[rank >> 6] >> (rank & 63);
        if (word != 0) {
            rank += (uint32_t)__builtin_ctzll(word);
            return rank < end ? rank : end;
        }
        rank = (rank | 63) + 1;
    }
    return end;
}

static double span(const dp_setup *setup, uint32_t from, uint32_t to) {
    return dp_curve_span(setup, dp_point_of_code(&setup->spec.format, frame_code(setup, from)),
                         dp_point_of_code(&setup->spec.format, frame_code(setup, to)));
}

/* Counts levels: in metric depth on a lattice it is these, not the file's codes, that tell depths apart. */
static void of_levels(const sensor *lattice, survey_band *out) {
    out->available = (uint64_t)fmax(sensor_levels(lattice, out->lo, out->hi), 0);
    if (isnan(out->gap))
        return;
    out->interval = sensor_gap(lattice, out->gap_z);
    out->steps = (uint64_t)fmin(rint(out->gap / out->interval), 0x1p62);
}

/* Nor are they where the file's own numbers are fewer: halves, or steps. */
static void of_numbers(const frame *f, survey_band *out) {
    const double zfar = f->camera->setup.spec.zfar;
    out->available =
        (uint64_t)(grain_numbers_below(f->grain, out->hi / zfar) - grain_numbers_below(f->grain, out->lo / zfar));
    if (isnan(out->gap))
        return;
    out->interval = grain_number_gap(f->grain, out->gap_z / zfar) * zfar;
    out->steps = (uint64_t)rint(out->gap / out->interval);
}

static bool has_fewer(const frame *f) {
    const grain *g = f->metric ? f->grain : NULL;
    return g != NULL && (g->kind == GRAIN_STEPS ? g->steps != f->camera->setup.spec.format.code_max
                                                : g->kind == GRAIN_FLOATS && g->bits < 24);
}

static void finish_band(const surveying *s, size_t index, survey_band *out) {
    const uint32_t start = s->bands.start[index], end = s->bands.start[index + 1];
    uint32_t before = next_used(s, start, end), nearest = 0;
    *out = (survey_band){.lo = s->bands.edge[index],
                         .hi = s->bands.edge[index + 1],
                         .pixels = s->pixels[index],
                         .codes = before < end,
                         .available = end - start,
                         .gap = NAN,
                         .gap_z = NAN,
                         .interval = NAN};
    for (uint32_t rank = next_used(s, before + 1, end); before < end && rank < end;
         before = rank, rank = next_used(s, rank + 1, end)) {
        const double gap = span(s->setup, before, rank);
        out->codes++;
        if (isnan(out->gap) || gap < out->gap) {
            out->gap = gap;
            out->steps = rank - before;
            nearest = before;
        }
    }
    if (!isnan(out->gap)) {
        out->gap_z = stored(s->setup, nearest);
        out->interval = dp_cell_of(s->setup, frame_code(s->setup, nearest)).width;
    }
    if (s->f->sensor != NULL && s->f->sensor->row->levels != GRAIN_FINE)
        of_levels(s->f->sensor, out);
    else if (has_fewer(s->f))
        of_numbers(s->f, out);
}

typedef struct finishing {
    const surveying *s;
    survey *out;
    size_t first; /* band */
} finishing;

static void finish_one(void *context, size_t index, size_t slot, int thread) {
    const finishing *f = context;
    (void)slot, (void)thread;
    finish_band(f->s, f->first + index, &f->out->bands[index]);
}

static bool finish(const surveying *s, survey *out) {
    size_t first = s->bands.count, last = 0;
    for (size_t i = 0; i < s->bands.count; i++)
        if (s->pixels[i] > 0) {
            first = first < i ? first : i;
            last = i;
        }
    if (first == s->bands.count)
        return true;
    out->band_count = last + 1 - first;
    finishing by_band = {s, out, first};
    if (!strips_run(&(strips){out->band_count, frame_threads(s->f), 1, finish_one, NULL, &by_band}))
        return false;
    for (size_t i = 0; i < out->band_count; i++)
        out->codes += out->bands[i].codes;
    const uint32_t nearest = next_used(s, 0, s->sky);
    uint32_t farthest = s->bands.start[last + 1] - 1;
    while ((s->used[farthest >> 6] >> (farthest & 63) & 1) == 0)
        farthest--;
    out->lo = stored(s->setup, nearest);
    out->hi = stored(s->setup, farthest);
    return true;
}

/* Where a code has another depth in each pixel there are no bands of codes. */
static bool visit_pixels(surveying *s, survey *out) {
    const texture_camera *camera = s->f->camera;
    uint32_t *codes = malloc((size_t)camera->width * sizeof *codes);
    for (uint32_t row = 0; row < camera->height && codes != NULL; row++) {
        frame_codes(s->f, row, codes);
        for (uint32_t x = 0; x < camera->width; x++) {
            const bool hole = codes[x] == UINT32_MAX;
            const bool sky = !hole && frame_rank(s->setup, codes[x]) >= s->sky;
            const double z = hole || sky ? (double)INFINITY : pixel_stored(camera, x, row, codes[x]);
            out->sky += sky;
            out->invalid += isinf(z) && !sky;
            if (isinf(z))
                continue;
            mark(s->used, frame_rank(s->setup, codes[x]));
            out->lo = fmin(out->lo, z);
            out->hi = fmax(out->hi, z);
        }
    }
    for (uint32_t rank = next_used(s, 0, s->sky); rank < s->sky; rank = next_used(s, rank + 1, s->sky))
        out->codes++;
    free(codes);
    return codes != NULL;
}

/* The bands, and all else where depths are those of the codes. */
static bool visit_codes(surveying *s, const frame *f, double sky_from, survey *out) {
    const survey own = *out;
    s->f = f;
    make_bands(s, sky_from);
    const bool good = visit(s);
    out->codes = 0;
    out->sky = s->sky_pixels;
    out->true_sky = s->true_sky;
    out->invalid = s->invalid;
    out->sky_from = sky_from;
    if (!good || !finish(s, out))
        return false;
    out->lo = isnan(own.lo) ? out->lo : own.lo;
    out->hi = isnan(own.hi) ? out->hi : own.hi;
    return true;
}

/* Depths without a far plane end at the farthest pixel. @return what lies behind it */
static uint32_t find_end(const frame *f, const dp_setup *setup) {
    uint32_t *codes = malloc((size_t)f->camera->width * sizeof *codes), end = 1;
    for (uint32_t row = 0; row < f->camera->height && codes != NULL; row++) {
        frame_codes(f, row, codes);
        for (uint32_t x = 0; x < f->camera->width; x++)
            if (codes[x] != UINT32_MAX && frame_rank(setup, codes[x]) >= end)
                end = frame_rank(setup, codes[x]) + 1;
    }
    free(codes);
    return end;
}

bool survey_make(const frame *given, survey *out) {
    texture_camera camera;
    const frame along = frame_along(given, &camera), *f = &along;
    const dp_setup *setup = &camera.setup;
    const bool endless = f->metric && isinf(setup->spec.zfar);
    surveying s = {.f = given, .setup = setup, .sky = endless ? find_end(f, setup) : frame_sky_rank(f)};
    bool good = true;
    const double sky_from = endless     ? stored(setup, s.sky - 1)
                            : f->metric ? setup->spec.zfar
                                        : dp_cell_of(setup, frame_code(setup, s.sky)).lo;
    s.used = calloc((size_t)(setup->spec.format.code_max >> 6) + 2, sizeof *s.used);
    if (s.used == NULL)
        return false;
    *out = (survey){.pixels = (uint64_t)f->camera->width * f->camera->height, .lo = NAN, .hi = NAN, .sky_from = NAN};
    if (!camera_is_shared(given->camera))
        good = visit_pixels(&s, out);
    if (good && camera_is_shared(&camera))
        good = visit_codes(&s, f, sky_from, out);
    free(s.used);
    return good;
}

/* Does the camera see the pair as a whole? */
static bool is_seen(const dp_setup *setup, const synthetic_pair *pair) {
    return pair->front >= setup->spec.znear && pair->back <= setup->spec.zfar;
}

static bool is_tie(const dp_setup *setup, const synthetic_pair *pair) {
    return dp_code(setup, pair->front) == dp_code(setup, pair->back);
}

bool survey_pairs_make(const frame *f, survey_pairs *out) {
    const dp_setup *setup = &f->camera->setup;
    synthetic_pair pair;
    *out = (survey_pairs){.first_tie = NAN, .certain_to = NAN};
    double first_possible = INFINITY, certain = NAN;
    if (f->synthetic == NULL || f->synthetic->pair == NULL)
        return false;
    for (size_t i = 0; f->synthetic->pair(f->parameters, i, &pair); i++) {
        if (!is_seen(setup, &pair))
            continue;
        const bool tie = is_tie(setup, &pair);
        /* Doubles near each other: their difference is exact, and so is the comparison. */
        const bool possible = pair.back - pair.front < dp_separation(setup, pair.front);
        out->pairs++;
        out->ties += tie;
        out->possible += possible;
        if (tie && !(pair.front >= out->first_tie))
            out->first_tie = pair.front;
        if (possible)
            first_possible = fmin(first_possible, pair.front);
    }
    for (size_t i = 0; f->synthetic->pair(f->parameters, i, &pair); i++)
        if (is_seen(setup, &pair) && pair.front < first_possible && !(pair.front < certain))
            certain = pair.front;
    out->certain_to = certain;
    return true;
}

size_t survey_ties(const frame *f, size_t most, double (*at)[2]) {
    synthetic_pair pair;
    size_t count = 0;
    for (size_t i = 0;
         f->synthetic != NULL && f->synthetic->pair != NULL && f->synthetic->pair(f->parameters, i, &pair); i++)
        if (is_seen(&f->camera->setup, &pair) && is_tie(&f->camera->setup, &pair) && count++ < most) {
            at[count - 1][0] = pair.at[0] * f->camera->width;
            at[count - 1][1] = pair.at[1] * f->camera->height;
        }
    return count;
}
