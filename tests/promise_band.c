/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How much of the bound is used: a whole binade of z, depth by depth. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "promise.h"

enum { PROBES = 256, SWEEP_MAX = 3 << 23 };

/* The longest interval that begins in the first `nearer` depths; only depths with a key above all before can begin
 * it, as the others begin later and reach no farther. */
static double longest_of(uint32_t first, const uint32_t *keys, const uint32_t *least, size_t nearer, size_t count,
                         double *at) {
    double most = 0.0;
    size_t other = 0;
    for (size_t i = 0, best = 0; i < nearer; i++) {
        if (i > 0 && keys[i] <= keys[best])
            continue;
        best = i;
        while (other + 1 < count && least[other + 1] <= keys[i])
            other++;
        const double z = promise_depth(first + (uint32_t)i);
        const double interval = promise_depth(first + (uint32_t)other) - z;
        if (interval > most)
            most = interval, *at = z;
    }
    return most;
}

static bool sweep(promise_band *b, uint32_t first, uint32_t last, uint32_t end) {
    const promise_pipe p = promise_pipe_make(&b->setup, false);
    const size_t count = (size_t)end - first + 1;
    uint32_t *keys = malloc(2 * count * sizeof *keys);
    if (!keys)
        return false;
    uint32_t *least = keys + count;
    promise_keys(&p, first, count, keys);
    uint32_t smallest = UINT32_MAX;
    for (size_t i = count; i-- > 0;)
        least[i] = smallest = keys[i] < smallest ? keys[i] : smallest;
    b->longest = longest_of(first, keys, least, (size_t)last - first + 1, count, &b->longest_z);
    free(keys);
    return true;
}

promise_band promise_measure_band(const dp_setup *setup, double z) {
    const promise_range range = promise_range_of(setup);
    const uint32_t binade = promise_bits(z) & 0x7f800000U;
    const uint32_t first = binade > range.first ? binade : range.first;
    const uint32_t behind = binade + 0x7fffffU;
    const uint32_t last = behind < range.last ? behind : range.last;
    promise_band b = {.setup = *setup, .slack = NAN, .slack_held = NAN, .cut = range.last < behind};
    b.lo = fmax(range.znear, promise_depth(first));
    b.hi = b.cut ? range.zfar : promise_depth(last);
    double held = 0.0; /* no two depths of the range are farther apart than far lets them be */
    for (int i = 0; i <= PROBES; i++) {
        const double at = fmin(b.hi, b.lo + (b.hi - b.lo) * i / PROBES);
        const double s = promise_bound(setup, at);
        if (s > b.bound)
            b.bound = s, b.bound_z = at;
        held = fmax(held, fmin(s, range.zfar - at));
    }
    const uint32_t end = promise_bits(fmin(range.zfar, b.hi + b.bound));
    if (end - first >= SWEEP_MAX || isinf(b.bound) || !sweep(&b, first, last, end))
        return b;
    const double step = promise_depth(binade + 1) - promise_depth(binade);
    b.slack = b.bound / (b.longest + step);
    b.slack_held = held / (b.longest + step);
    return b;
}
