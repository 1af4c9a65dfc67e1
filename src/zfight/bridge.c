/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Intervals that leave a segment, from the least and the greatest key of each block. */
#include <math.h>

#include "zfight/ground.h"
#include "zfight/parts.h"

static uint32_t block_last(const census_parts *c, size_t block) {
    return block + 1 < c->block_count ? c->block_first[block + 1] - 1 : c->range.last;
}

static void keys_of_block(const census_parts *c, size_t block, int32_t key[CENSUS_BLOCK]) {
    float z[CENSUS_BLOCK];
    const uint32_t first = c->block_first[block];
    const uint32_t last = block_last(c, block);
    for (uint32_t i = 0; i < CENSUS_BLOCK; i++)
        z[i] = dp_ranked32(first + i < last ? first + i : last);
    c->level->keys(&c->plan, z, CENSUS_BLOCK, key);
}

static size_t last_block(const census_parts *c, size_t from, int32_t v) {
    return census_down_to(c->least, from, c->block_count - 1, v);
}

/* The intervals that begin in a block and end in or behind block `from`; keys up to `highest` were met nearer, with a
 * guarantee that was no greater. */
static void look_at_block(const census_parts *c, size_t block, size_t from, int64_t highest, int falling,
                          census_band *band) {
    int32_t home[CENSUS_BLOCK];
    int32_t away[CENSUS_BLOCK];
    size_t away_block = SIZE_MAX;
    const uint32_t count = block_last(c, block) - c->block_first[block] + 1;
    keys_of_block(c, block, home);
    for (uint32_t i = 0; i < count; i++) {
        const int32_t v = home[i];
        if ((v <= highest && !falling) || c->least[from] > v)
            continue;
        highest = v;
        const size_t other = last_block(c, from, v);
        if (other != away_block)
            keys_of_block(c, away_block = other, away);
        uint32_t end = block_last(c, other) - c->block_first[other];
        while (end > 0 && away[end] > v)
            end--;
        census_note(c->request, band, dp_ranked32(c->block_first[block] + i), dp_ranked32(c->block_first[other] + end));
    }
}

/* @param least_bound  the smaller guarantee of the block's ends */
static int worth_a_look(const census_parts *c, size_t block, size_t from, double least_bound, const census_band *band) {
    const double z1 = (double)dp_ranked32(c->block_first[block]);
    const double most = (double)dp_ranked32(block_last(c, last_block(c, from, c->greatest[block]))) - z1;
    const double halves = fmax(census_ulp((float)z1), census_ulp((float)(z1 + most)));
    return most >= band->longest || most + halves >= band->slack * least_bound;
}

void census_bridge(const census_parts *c, census_result *result) {
    int band = -1;
    int64_t highest = INT64_MIN;
    double highest_bound = 0.0; /* the greatest where it may have been met */
    for (size_t i = 0; i + 1 < c->segment_count; i++) {
        const census_segment *s = &c->segments[i];
        const size_t from = c->segments[i + 1].block;
        census_ground ground = census_ground_make(c->request, s->first, s->first + s->count - 1);
        if (s->band != band) {
            band = s->band;
            highest = INT64_MIN;
        }
        for (size_t block = s->block; block < from; block++) {
            const int32_t top = c->greatest[block];
            if (top < c->least[from] ||
                !worth_a_look(c, block, from, census_ground_at(&ground, c->block_first[block]), &result->bands[band]))
                continue;
            const double here = census_bound_at(c->request, c->block_first[block]);
            const double last = census_bound_at(c->request, block_last(c, block));
            const double least = census_least(c->request, fmin(here, last), c->block_first[block], CENSUS_BLOCK);
            const bool falls = c->request->falls;
            if (falls || census_falls(highest_bound, least))
                highest = INT64_MIN;
            if (top <= highest)
                continue;
            if (worth_a_look(c, block, from, least, &result->bands[band]))
                look_at_block(c, block, from, highest, falls || census_falls(here, last), &result->bands[band]);
            highest = top;
            highest_bound = fmax(here, last);
        }
    }
}
