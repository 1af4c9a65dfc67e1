/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * One pass in two levels. The range is cut into segments inside one binade, and each is swept from its far end, block
 * after block. For every run of 64 depths the sweep keeps the greatest key and the least key from it on to the
 * segment's end. Two depths at least D steps apart that are out of order show themselves there, so a run is looked at
 * one by one only when it may hold an interval longer than the longest so far; where D is below a run's length, the
 * depths themselves are compared with what lies D steps behind, a vector at a time. Far to near is the right way
 * round: intervals mostly grow with distance, so the longest is met early and little is looked at twice.
 *
 * Intervals that leave a segment are found afterwards from the least and greatest key of each block. Both parts
 * compute again the few keys that they need: no code is stored.
 */
#include "zfight/census.h"

#include <math.h>
#include <stdlib.h>

#include "zfight/ground.h"
#include "zfight/parts.h"

enum { SEGMENT = 1 << 18, SEGMENT_RUNS = SEGMENT / CENSUS_RUN };

/* ---- A segment --------------------------------------------------------------------------------------------------- */

typedef struct sweep {
    const census_parts *c;
    census_segment *s;
    uint32_t last;                    /* of the segment */
    uint32_t runs;                    /* with those that fill the last block up */
    double per_step;                  /* 1 over the step of the segment, a power of two */
    double halves;                    /* steps that the surfaces may be farther apart than the depths they round to */
    double steps_known;               /* what is not above it tells nothing new */
    double slack_known;               /* the same of shares; HUGE_VAL: they are not asked about */
    census_ground ground;             /* of the guarantee */
    double bound;                     /* the least guaranteed separation in the block at hand */
    uint32_t edge;                    /* where it was asked for last: the near end of a block */
    double bound_edge;                /* and what it is there */
    int falling;                      /* it is less than at the near end */
    int32_t beyond[SEGMENT_RUNS + 1]; /* least key from a run on to the end */
    int32_t peak[SEGMENT_RUNS];       /* greatest key of a run */
    int32_t key[CENSUS_BLOCK] __attribute__((aligned(64)));
    int32_t reach[CENSUS_BLOCK] __attribute__((aligned(64)));
    int32_t before[CENSUS_RUN]; /* from the block behind the one at hand */
} sweep;

static void run_keys(const sweep *w, uint32_t run, int32_t key[CENSUS_RUN]) {
    float z[CENSUS_RUN];
    for (uint32_t i = 0; i < CENSUS_RUN; i++) {
        const uint32_t bits = w->s->first + run * CENSUS_RUN + i;
        z[i] = dp_ranked32(bits < w->last ? bits : w->last);
    }
    w->c->level->keys(&w->c->plan, z, CENSUS_RUN, key);
}

/* Only intervals of more than this many steps tell anything new. Where the guarantee is infinite a share of it is NaN,
 * which leaves nothing out. */
static uint32_t known_steps(const sweep *w) {
    const double longest = w->s->found.longest * w->per_step, per_slack = w->bound * w->per_step;
    const double found = w->s->found.slack * per_slack + 1e-6, known = w->slack_known * per_slack - 1e-6;
    const double by_slack = (known > found || isnan(found) ? known : found) - w->halves;
    double steps = longest > w->steps_known ? longest : w->steps_known;
    if (!(by_slack >= steps))
        steps = by_slack > 0.0 ? floor(by_slack) : 0.0;
    return steps < SEGMENT ? (uint32_t)steps : SEGMENT;
}

/* Looks at a run's depths. One whose key a nearer depth of the run reaches has the shorter interval: left out, unless
 * it takes a greater share because the guarantee has fallen. */
static void look_at_run(sweep *w, uint32_t run) {
    int32_t home[CENSUS_RUN];
    int32_t away[CENSUS_RUN];
    uint32_t away_run = UINT32_MAX;
    int64_t highest = INT64_MIN; /* below all keys */
    census_segment *s = w->s;
    uint32_t known = known_steps(w);
    run_keys(w, run, home);
    for (uint32_t i = 0; i < CENSUS_RUN; i++) {
        const uint32_t place = run * CENSUS_RUN + i;
        const uint32_t from = place + known + 1;
        const int32_t v = home[i];
        if (from >= s->count)
            return;
        if ((v <= highest && !w->falling) || w->beyond[from / CENSUS_RUN] > v)
            continue;
        highest = v;
        const uint32_t other = (uint32_t)census_down_to(w->beyond, from / CENSUS_RUN, w->runs - 1, v);
        if (other != away_run)
            run_keys(w, away_run = other, away);
        uint32_t end = CENSUS_RUN - 1;
        while (end > 0 && away[end] > v)
            end--;
        end += other * CENSUS_RUN;
        if (end >= s->count)
            end = s->count - 1;
        if (end < from)
            continue;
        census_note(w->c->request, &s->found, dp_ranked32(s->first + place), dp_ranked32(s->first + end));
        known = known_steps(w);
    }
}

/* Which runs of the block that begins with run `base` may hold something new: bit i for the i-th from the far end. */
static uint32_t suspects(sweep *w, uint32_t base) {
    const uint32_t known = known_steps(w);
    const uint32_t ahead = (known + 1) / CENSUS_RUN;
    uint32_t mask = 0;
    for (uint32_t i = 0; i < CENSUS_RUNS; i++) {
        const uint32_t run = base + CENSUS_RUNS - 1 - i;
        const uint32_t other = run + ahead < w->runs ? run + ahead : w->runs;
        mask |= (uint32_t)(w->beyond[other] <= w->peak[run]) << i;
    }
    if (known + 1 >= CENSUS_RUN) { /* else each run suspects itself */
        for (uint32_t i = 0; i < CENSUS_RUN; i++)
            w->before[i] = INT32_MIN; /* not looked at: anything may be there */
        return mask;
    }
    int32_t beyond[CENSUS_RUNS];
    for (uint32_t i = 0; i < CENSUS_RUNS; i++)
        beyond[i] = w->beyond[base + CENSUS_RUNS - i];
    w->c->level->reach(w->key, beyond, w->reach);
    mask &= w->c->level->far_disorder(w->key, w->reach, w->before, known + 1);
    for (uint32_t i = 0; i < CENSUS_RUN; i++)
        w->before[i] = w->reach[i * CENSUS_RUNS + CENSUS_RUNS - 1];
    return mask;
}

/* The guarantee in a block, which begins with the depth `first`. */
static void update_bound(sweep *w, uint32_t first) {
    const uint32_t end = w->last - first < CENSUS_BLOCK ? w->last : first + CENSUS_BLOCK;
    const double above = end == w->edge ? w->bound_edge : census_bound_at(w->c->request, end);
    const double here = census_bound_at(w->c->request, first);
    w->falling = w->c->request->falls || census_falls(here, above);
    w->bound = census_least(w->c->request, here < above ? here : above, first, end - first);
    w->edge = first;
    w->bound_edge = here;
}

/* The runs of a block that may hold something new; the guarantee is asked for only where its floor leaves some. */
static uint32_t suspects_of_block(sweep *w, uint32_t base) {
    const uint32_t first = w->s->first + base * CENSUS_RUN;
    if (w->slack_known == HUGE_VAL)
        return suspects(w, base);
    w->bound = census_ground_at(&w->ground, first);
    if (known_steps(w) + 1 >= CENSUS_RUN && suspects(w, base) == 0)
        return 0;
    update_bound(w, first);
    return suspects(w, base);
}

static void count_block(sweep *w, const census_sight *sight, uint32_t offset) {
    census_band *found = &w->s->found;
    const uint32_t real = w->s->count - offset < CENSUS_BLOCK ? w->s->count - offset : CENSUS_BLOCK;
    const uint32_t filling = CENSUS_BLOCK - real; /* copies of the last depth, each a tie */
    found->ties += sight->ties - filling;
    found->swaps += sight->swaps;
    found->clipped += sight->clipped;
    if (filling > 0 && !dp_pipeline_drawn(&w->c->plan.pipeline, dp_ranked32(w->last)))
        found->clipped -= filling;
}

/*
 * Finds the segment's longest interval if it is at least as long as what is known, and its greatest slack likewise. As
 * long, and not only longer: so whichever segment of a band comes first, all that reach the band's longest know it in
 * the end, and the nearest can be named.
 */
static void sweep_segment(const census_parts *c, census_segment *s, const census_band *known, sweep *w) {
    const uint32_t blocks = (s->count + CENSUS_BLOCK - 1) / CENSUS_BLOCK;
    w->c = c;
    w->s = s;
    w->last = s->first + s->count - 1;
    w->runs = blocks * CENSUS_RUNS;
    w->per_step = 1.0 / census_step(s->first);
    w->halves = 0.5 * (census_ulp(dp_ranked32(s->first)) + census_ulp(dp_ranked32(w->last))) * w->per_step;
    w->steps_known = known->longest * w->per_step - 1.0;
    w->slack_known = c->request->bound == NULL ? HUGE_VAL : known->slack * (1.0 - 1e-9);
    w->ground = census_ground_make(c->request, s->first, w->last);
    w->bound = HUGE_VAL;
    w->edge = UINT32_MAX;
    w->falling = 0;
    w->beyond[w->runs] = INT32_MAX;
    for (uint32_t i = 0; i < CENSUS_RUN; i++)
        w->before[i] = INT32_MAX;
    s->found = (census_band){.longest_z = (double)NAN, .slack_z = (double)NAN};
    const int has_next = w->last < c->range.last;
    int32_t next = has_next ? census_key(&c->plan, dp_ranked32(w->last + 1)) : 0;
    for (uint32_t b = blocks; b-- > 0;) {
        census_sight sight;
        c->level->block(&c->plan, s->first + b * CENSUS_BLOCK, w->last, w->key, &sight);
        count_block(w, &sight, b * CENSUS_BLOCK);
        if (has_next || b + 1 < blocks) {
            s->found.ties += next == w->key[0];
            s->found.swaps += next < w->key[0];
        }
        next = w->key[CENSUS_BLOCK - 1];
        const uint32_t base = b * CENSUS_RUNS;
        int32_t greatest = INT32_MIN, least = INT32_MAX;
        for (uint32_t i = 0; i < CENSUS_RUNS; i++) {
            const uint32_t run = base + CENSUS_RUNS - 1 - i;
            w->peak[run] = sight.greatest[i];
            w->beyond[run] = sight.least[i] < w->beyond[run + 1] ? sight.least[i] : w->beyond[run + 1];
            greatest = sight.greatest[i] > greatest ? sight.greatest[i] : greatest;
            least = sight.least[i] < least ? sight.least[i] : least;
        }
        c->greatest[s->block + b] = greatest;
        c->least[s->block + b] = least;
        c->block_first[s->block + b] = s->first + b * CENSUS_BLOCK;
        uint32_t mask = suspects_of_block(w, base);
        for (uint32_t i = 0; mask != 0; i++, mask >>= 1)
            if (mask & 1)
                look_at_run(w, base + CENSUS_RUNS - 1 - i);
    }
}

/*
 * The sweep met the farthest of the longest intervals first; the nearest is wanted. With what the sweep has left, a
 * walk from the near end stops at the first run that has one.
 */
static double nearest_longest(const census_parts *c, census_segment *s, sweep *w) {
    const census_band found = s->found;
    sweep_segment(c, s, &(census_band){.longest = found.longest, .slack = HUGE_VAL}, w);
    s->found.longest = 0.0;
    for (uint32_t run = 0; run < w->runs && s->found.longest < found.longest; run++) {
        const uint32_t other = run + (known_steps(w) + 1) / CENSUS_RUN;
        if (w->beyond[other < w->runs ? other : w->runs] <= w->peak[run])
            look_at_run(w, run);
    }
    const double z = s->found.longest_z;
    s->found = found;
    return z;
}

/* ---- The whole --------------------------------------------------------------------------------------------------- */

static size_t cut(census_parts *c, census_segment *segments) {
    const uint32_t asked = c->request->segment;
    const uint32_t longest = asked > 0 && asked < SEGMENT ? asked : SEGMENT;
    size_t count = 0, block = 0;
    for (uint64_t first = c->range.first; first <= c->range.last; count++) {
        uint64_t end = (first | 0x7FFFFFU) + 1; /* of the binade */
        if (end > (uint64_t)c->range.last + 1)
            end = (uint64_t)c->range.last + 1;
        if (end - first > longest)
            end = first + longest;
        if (segments != NULL)
            segments[count] = (census_segment){.first = (uint32_t)first,
                                               .count = (uint32_t)(end - first),
                                               .block = block,
                                               .band = census_band_of(&c->range, (uint32_t)first)};
        block += (end - first + CENSUS_BLOCK - 1) / CENSUS_BLOCK;
        first = end;
    }
    c->segment_count = count;
    c->block_count = block;
    return count;
}

static int allocate(census_parts *c) {
    c->segments = malloc(cut(c, NULL) * sizeof *c->segments);
    c->block_first = malloc(c->block_count * sizeof *c->block_first);
    c->least = malloc(c->block_count * sizeof *c->least);
    c->greatest = malloc(c->block_count * sizeof *c->greatest);
    const int good = c->segments != NULL && c->block_first != NULL && c->least != NULL && c->greatest != NULL;
    if (good)
        cut(c, c->segments);
    return good;
}

static void release(census_parts *c) {
    free(c->segments);
    free(c->block_first);
    free(c->least);
    free(c->greatest);
}

/* @return whether it was stopped */
static int sweep_all(census_parts *c) {
    const census_request *r = c->request;
    uint64_t done = 0;
    int stop = 0;
#pragma omp parallel num_threads(census_threads(r)) if (c->segment_count > 1)
    {
        sweep w;
#pragma omp for schedule(dynamic)
        for (size_t i = 0; i < c->segment_count; i++) {
            census_segment *s = &c->segments[c->segment_count - 1 - i];
            int stopped;
            census_band known;
#pragma omp critical(census_progress)
            {
                stopped = stop;
                known = c->known[s->band];
                known.slack = isinf(known.slack) ? 0.0 : known.slack;
            }
            if (stopped)
                continue;
            sweep_segment(c, s, &known, &w);
#pragma omp critical(census_progress)
            {
                census_add(&c->known[s->band], &s->found);
                done += s->count;
                if (r->progress != NULL && r->progress(r->context, done))
                    stop = 1;
            }
        }
    }
    return stop;
}

static void gather(census_parts *c, census_result *result) {
    for (size_t i = 0; i < c->segment_count; i++) {
        const census_segment *s = &c->segments[i];
        census_band *band = &result->bands[s->band];
        band->pairs += s->count;
        census_add(band, &s->found);
    }
    result->bands[result->band_count - 1].pairs--; /* the last depth has no neighbour behind it */
    for (size_t i = c->block_count - 1; i-- > 0;)
        if (c->least[i + 1] < c->least[i])
            c->least[i] = c->least[i + 1];
    census_bridge(c, result);
}

/* Where a band's longest interval is inside a segment, the first such segment knows the nearest. */
static void locate(census_parts *c, census_result *result) {
    sweep w;
    int band = -1;
    for (size_t i = 0; i < c->segment_count; i++) {
        census_segment *s = &c->segments[i];
        census_band *b = &result->bands[s->band];
        if (s->band == band || b->longest <= 0.0 || s->found.longest < b->longest)
            continue;
        band = s->band;
        const double z = nearest_longest(c, s, &w);
        b->longest_z = b->longest_z < z ? b->longest_z : z;
    }
}

census_status census_run(const census_request *request, census_result *result) {
    census_parts c = {.request = request, .level = request->level != NULL ? request->level : census_level_best()};
    census_status status = census_open(request, &c.plan, result, &c.range);
    if (status != CENSUS_DONE)
        return status;
    if (!allocate(&c)) {
        status = CENSUS_NO_MEMORY;
    } else if (sweep_all(&c)) {
        status = CENSUS_STOPPED;
    } else {
        gather(&c, result);
        locate(&c, result);
        census_close(request, &c.plan, &c.range, result);
    }
    release(&c);
    return status;
}
