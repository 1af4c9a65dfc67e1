/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How much of the bound is used: a whole binade of z, depth by depth. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "reference.h"

enum { PROBES = 256, PART = 4096, SWEEP_MAX = 3 << 23 };

typedef struct sweep {
    reference_pipe pipe;
    uint32_t first;
    const uint32_t *keys;
    const uint32_t *least; /* the smallest key from here on */
    size_t nearer, count;
} sweep;

static uint32_t farthest(const sweep *s, size_t i, size_t *other) {
    while (*other + 1 < s->count && s->least[*other + 1] <= s->keys[i])
        ++*other;
    return s->first + (uint32_t)*other;
}

/*
 * The longest interval that begins in the band. Only a depth with a key above all before it can begin it: the others
 * begin later and reach no farther. The longest of each 4096 depths is held against the bound.
 */
static void longest_of(const sweep *s, reference_band *b) {
    size_t best = 0;
    size_t other = 0;
    for (size_t from = 0; from < s->nearer; from += PART) {
        double most = -1.0;
        uint32_t x1 = 0;
        uint32_t x2 = 0;
        for (size_t i = from; i < s->nearer && i < from + PART; i++) {
            if (i > 0 && s->keys[i] <= s->keys[best])
                continue;
            best = i;
            const uint32_t end = farthest(s, i, &other);
            const double interval = reference_depth(end) - reference_depth(s->first + (uint32_t)i);
            if (interval > most)
                most = interval, x1 = s->first + (uint32_t)i, x2 = end;
        }
        if (most > b->longest)
            b->longest = most, b->longest_z = reference_depth(x1);
        if (most >= 0.0)
            reference_judge_pair(&b->setup, &s->pipe, x1, x2, &b->worst);
    }
}

static bool sweep_band(reference_band *b, uint32_t first, uint32_t last, uint32_t end) {
    const size_t count = (size_t)end - first + 1;
    uint32_t *keys = malloc(2 * count * sizeof *keys);
    if (!keys)
        return false;
    uint32_t *least = keys + count;
    const sweep s = {reference_pipe_make(&b->setup, false), first, keys, least, (size_t)last - first + 1, count};
    reference_keys(&s.pipe, first, count, keys);
    uint32_t smallest = UINT32_MAX;
    for (size_t i = count; i-- > 0;)
        least[i] = smallest = keys[i] < smallest ? keys[i] : smallest;
    longest_of(&s, b);
    free(keys);
    return true;
}

reference_band reference_measure_band(const dp_setup *setup, double z) {
    const reference_range range = reference_range_of(setup);
    const uint32_t zero = reference_rank(0.0);
    const uint32_t binade = zero + ((reference_rank(fabs(z)) - zero) & 0x7f800000U);
    const uint32_t begin = z < 0.0 ? zero - (binade + 0x7fffffU - zero) : binade;
    const uint32_t first = begin > range.first ? begin : range.first;
    const uint32_t behind = begin + 0x7fffffU;
    const uint32_t last = behind < range.last ? behind : range.last;
    reference_band b = {
        .setup = *setup, .slack = NAN, .slack_held = NAN, .slack_lattice = NAN, .cut = range.last < behind};
    b.lo = fmax(range.znear, reference_depth(first));
    b.hi = b.cut ? range.zfar : reference_depth(last);
    dp_setup exact = *setup;
    exact.spec.model = DP_MODEL_EXACT;
    double held = 0.0; /* no two depths of the range are farther apart than far lets them be */
    double lattice = 0.0;
    for (int i = 0; i <= PROBES; i++) {
        const double at = fmin(b.hi, b.lo + (b.hi - b.lo) * i / PROBES);
        const double s = reference_bound(setup, at);
        if (s > b.bound)
            b.bound = s, b.bound_z = at;
        held = fmax(held, fmin(s, range.zfar - at));
        lattice = fmax(lattice, fmin(dp_separation(&exact, at), range.zfar - at));
    }
    const uint32_t end = reference_rank(fmin(range.zfar, b.hi + b.bound));
    if (end - first >= SWEEP_MAX || isinf(b.bound) || !sweep_band(&b, first, last, end))
        return b;
    const double step = reference_depth(binade + 1) - reference_depth(binade);
    b.slack = b.bound / (b.longest + step);
    b.slack_held = held / (b.longest + step);
    b.slack_lattice = held / (fmax(b.longest, lattice) + step);
    return b;
}
