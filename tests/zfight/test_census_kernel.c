/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which runs of a block hold a depth that is out of order with one far behind it: by looking at all depths. */
#include "support.h"
#include "zfight/kernel.h"

/* Depths from the far end: a run behind the block, then the block, run after run. */
enum { BEHIND = CENSUS_RUN, ALL = BEHIND + CENSUS_BLOCK };

typedef struct depths {
    int32_t beyond; /* the least key behind all of them */
    int32_t key[ALL];
} depths;

/* Bit i: run i has a key that is not below that of some depth at least so many steps farther. */
static uint32_t disordered(const depths *d, unsigned delay) {
    uint32_t mask = 0;
    for (size_t i = BEHIND; i < ALL; i++) {
        bool found = d->key[i] >= d->beyond;
        for (size_t k = 0; k + delay <= i && !found; k++)
            found = d->key[i] >= d->key[k];
        mask |= (uint32_t)found << (i - BEHIND) / CENSUS_RUN;
    }
    return mask;
}

static uint32_t seen_by(const census_level *level, const depths *d, unsigned delay) {
    static int32_t key[CENSUS_BLOCK] __attribute__((aligned(64))), reach[CENSUS_BLOCK] __attribute__((aligned(64)));
    int32_t beyond[CENSUS_RUNS], before[CENSUS_RUN], least = d->beyond;
    for (size_t i = 0; i < ALL; i++) {
        if (i >= BEHIND && i % CENSUS_RUN == 0)
            beyond[(i - BEHIND) / CENSUS_RUN] = least;
        least = d->key[i] < least ? d->key[i] : least;
        if (i < BEHIND)
            before[i] = least;
        else
            key[i % CENSUS_RUN * CENSUS_RUNS + (i - BEHIND) / CENSUS_RUN] = d->key[i];
    }
    level->reach(key, beyond, reach);
    return level->far_disorder(key, reach, before, delay);
}

/* Keys that fall towards the viewer, but for one here and there; the border of the block among the places. */
TEST(test_disorder) {
    rng r = rng_make("disorder");
    tally t = {.name = "disorder"};
    uint64_t far_run = 0, none = 0;
    for (uint64_t n = 0; n < test_cases(300, 4000, 100000); n++) {
        static depths d;
        const unsigned delay = 1 + (unsigned)rng_below(&r, CENSUS_RUN - 1);
        d.beyond = 2 * ALL + (int32_t)rng_below(&r, 3);
        for (int i = 0; i < ALL; i++)
            d.key[i] = 2 * (ALL - i) - (int32_t)rng_below(&r, 2);
        for (uint64_t k = rng_below(&r, 3); k > 0; k--) { /* a key as that of a depth some steps farther */
            const size_t at =
                BEHIND + (rng_below(&r, 2) == 0 ? rng_below(&r, CENSUS_RUN) : rng_below(&r, CENSUS_BLOCK));
            const size_t steps = delay + rng_below(&r, 3) - (delay > 1 ? 1 : 0);
            if (steps <= at)
                d.key[at] = d.key[at - steps] - (int32_t)rng_below(&r, 2);
        }
        const uint32_t want = disordered(&d, delay);
        far_run += want == 1;
        none += want == 0;
        for (size_t i = 0; i < census_level_count; i++)
            if (dp_path_available(census_levels[i].path))
                TALLY(&t, seen_by(&census_levels[i], &d, delay) == want, "%s, %u steps: %04x, not %04x",
                      census_levels[i].name, delay, seen_by(&census_levels[i], &d, delay), want);
    }
    print_message("# %llu in the farthest run alone, %llu in none\n", (unsigned long long)far_run,
                  (unsigned long long)none);
    assert_true(far_run > t.cases / 40 && none > t.cases / 40);
    tally_end(&t);
}
