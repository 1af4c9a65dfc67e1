/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "core/bits.h"
#include "zfight/range.h"

enum { BATCH = CENSUS_BLOCK, LADDER = 31 };

typedef struct sample {
    const census_sample_request *request;
    const census_level *level;
    census_plan plan;
    census_range range;
} sample;

static uint32_t depth_of_draw(const sample *s, uint64_t i) {
    const census_sample_request *r = s->request;
    if (r->count == 0)
        return s->range.first + (uint32_t)i;
    const uint64_t count =
        (uint64_t)s->range.last - s->range.first + 1; /* below 2^32, so the product of halves cannot overflow */
    return s->range.first + (uint32_t)((dp_draw64(r->seed, i) >> 32) * count >> 32);
}

static float partner(const sample *s, uint32_t rank) {
    if (s->request->gap > 0.0)
        return (float)((double)dp_ranked32(rank) + s->request->gap);
    return dp_ranked32(rank + 1);
}

static int out_of_order(const sample *s, int32_t key, uint32_t rank) {
    return census_key(&s->plan, dp_ranked32(rank)) <= key;
}

/*
 * Steps away from a depth in doubling strides, keeps the last place out of order, and closes in on the change from
 * there. Codes are not monotone, so a longer interval may be missed, but what is found is one.
 */
static void walk(const sample *s, uint32_t rank, int32_t key, census_band *band) {
    uint64_t wrong = 0;
    uint64_t right = 0;
    const uint64_t room = s->range.last - rank;
    for (int i = 0; i < LADDER; i++) {
        const uint64_t stride = UINT64_C(1) << i < room ? UINT64_C(1) << i : room;
        if (out_of_order(s, key, rank + (uint32_t)stride)) {
            wrong = stride;
            right = 0;
        } else if (right == 0) {
            right = stride;
        }
        if (stride == room)
            break;
    }
    if (right == 0)
        right = wrong + 1;
    while (right > wrong + 1) {
        const uint64_t middle = wrong + (right - wrong) / 2;
        if (out_of_order(s, key, rank + (uint32_t)middle))
            wrong = middle;
        else
            right = middle;
    }
    if (wrong > 0)
        census_note(&s->request->common, band, dp_ranked32(rank), dp_ranked32(rank + (uint32_t)wrong));
}

static void count_pairs(const sample *s, uint64_t from, size_t count, census_band *bands) {
    uint32_t rank[BATCH];
    float near_z[BATCH], far_z[BATCH];
    int32_t near_key[BATCH], far_key[BATCH];
    const float end = dp_ranked32(s->range.last);
    for (size_t i = 0; i < count; i++) {
        rank[i] = depth_of_draw(s, from + i);
        near_z[i] = dp_ranked32(rank[i]);
        const float z = partner(s, rank[i]);
        far_z[i] = z <= end ? z : NAN; /* leaves the range: not a pair */
    }
    s->level->keys(&s->plan, near_z, count, near_key);
    s->level->keys(&s->plan, far_z, count, far_key);
    for (size_t i = 0; i < count; i++) {
        if (isnan(far_z[i]))
            continue;
        census_band *band = &bands[census_band_of(&s->range, rank[i])];
        band->pairs++;
        band->ties += far_key[i] == near_key[i];
        band->swaps += far_key[i] < near_key[i];
        if (far_key[i] > near_key[i])
            band->last_apart = fmax(band->last_apart, (double)near_z[i]);
        else
            band->first = fmin(band->first, (double)near_z[i]);
        if (s->request->gap <= 0.0)
            walk(s, rank[i], near_key[i], band);
    }
}

static int judge_all(const sample *s, uint64_t total, census_result *result) {
    const census_request *r = &s->request->common;
    uint64_t done = 0;
    int stop = 0;
#pragma omp parallel num_threads(census_threads(r)) if (total > 16 * BATCH)
    {
        census_band mine[CENSUS_BANDS_MAX];
        memset(mine, 0, sizeof mine);
        for (int i = 0; i < CENSUS_BANDS_MAX; i++)
            mine[i].first = mine[i].last_apart = (double)NAN;
#pragma omp for schedule(dynamic, 16)
        for (uint64_t from = 0; from < total; from += BATCH) {
            int stopped;
#pragma omp atomic read
            stopped = stop;
            if (stopped)
                continue;
            const size_t count = total - from < BATCH ? (size_t)(total - from) : (size_t)BATCH;
            count_pairs(s, from, count, mine);
            if (r->progress == NULL)
                continue;
#pragma omp critical(sample_progress)
            {
                done += count;
                if (r->progress(r->context, done)) {
#pragma omp atomic write
                    stop = 1;
                }
            }
        }
#pragma omp critical(sample_add)
        for (int i = 0; i < result->band_count; i++)
            census_add(&result->bands[i], &mine[i]);
    }
    return stop;
}

census_status census_sample(const census_sample_request *request, census_result *result) {
    const census_request *r = &request->common;
    sample s = {.request = request, .level = r->level != NULL ? r->level : census_level_best()};
    if (!(request->gap >= 0.0) || (request->count == 0 && request->gap <= 0.0))
        return CENSUS_RANGE;
    const census_status status = census_open(r, &s.plan, result, &s.range);
    if (status != CENSUS_DONE)
        return status;
    const uint64_t all = (uint64_t)s.range.last - s.range.first + 1;
    const uint64_t total = request->count > 0                         ? request->count
                           : request->most > 0 && request->most < all ? request->most
                                                                      : all;
    if (judge_all(&s, total, result))
        return CENSUS_STOPPED;
    census_close(r, &s.plan, &s.range, result);
    return CENSUS_DONE;
}
