/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every pair of a window against the guaranteed separation. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "reference.h"

enum { BLOCK = 64, BROKEN_MAX = 64 };

double reference_bound(const dp_setup *setup, double z) {
    dp_budget budget;
    return dp_budget_at(setup, z, NULL, &budget) == DP_OK ? budget.separation : (double)INFINITY;
}

bool reference_beyond(double z1, double s, double z2) {
    const double sum = z1 + s;
    const double v = sum - z1;
    const double lost = (z1 - (sum - v)) + (s - v); /* z1 + s = sum + lost */
    return isfinite(sum) && z2 - sum >= lost;       /* exact where it is close */
}

typedef struct judge {
    const dp_setup *setup;
    const reference_pipe *pipe;
    reference_range range;
    size_t count;
    uint32_t *ranks, *keys;
    uint32_t *least; /* the smallest key from here to the far end of the window */
    uint64_t broken; /* of this window */
    reference_result *result;
    struct {
        size_t from, to;
        double smallest, ratio;
    } loosest; /* of the blocks that the bound at their ends settled, the one that came nearest to it */
} judge;

/* The farthest depth that is not stored strictly behind `key`. */
static size_t farthest(const judge *j, size_t i, uint32_t key) {
    size_t lo = i;
    size_t hi = j->count - 1;
    while (lo < hi) {
        const size_t middle = lo + (hi - lo + 1) / 2;
        if (j->least[middle] <= key)
            lo = middle;
        else
            hi = middle - 1;
    }
    return lo;
}

/* A cause that is cut to half and lets the pair break the promise has been noticed. */
static void notice(judge *j, double z1, double z2) {
    dp_budget budget;
    if (dp_budget_at(j->setup, z1, NULL, &budget) != DP_OK || !isfinite(budget.separation))
        return;
    for (int c = 0; c < DP_CAUSE_COUNT; c++)
        if (budget.cause[c] > 0.0) {
            j->result->present[c] = true;
            j->result->noticed[c] |= reference_beyond(z1, budget.separation - 0.5 * budget.cause[c], z2);
        }
}

void reference_judge_pair(const dp_setup *setup, const reference_pipe *p, uint32_t x1, uint32_t x2,
                          reference_pair *worst) {
    const reference_range range = reference_range_of(setup);
    const double z2 = reference_cell_hi(&range, x2);
    const double lo = reference_cell_lo(&range, x1);
    const double hi = reference_cell_hi(&range, x1);
    const double depths[] = {lo, fmin(hi, fmax(lo, reference_depth(x1))), hi};
    for (int k = 0; k < 3; k++) {
        const double z1 = depths[k];
        const double s = fmin(reference_bound(setup, z1), dp_separation(setup, z1));
        const bool beyond = z1 < z2 && reference_beyond(z1, s, z2);
        const double ratio = s > 0.0 ? (z2 - z1) / s : z2 > z1 ? (double)INFINITY : 0.0;
        if (ratio > worst->ratio || (beyond && !worst->broken))
            *worst = (reference_pair){.setup = *setup,
                                      .flush = p->flush,
                                      .x1 = x1,
                                      .x2 = x2,
                                      .code1 = reference_code(p, reference_key(p, x1)),
                                      .code2 = reference_code(p, reference_key(p, x2)),
                                      .z1 = z1,
                                      .z2 = z2,
                                      .bound = s,
                                      .ratio = ratio,
                                      .broken = beyond};
        if (k == 0 && z2 - lo < 0.9 * s)
            break;
    }
}

static void judge_pair(judge *j, size_t i1, size_t i2) {
    reference_pair pair = {.ratio = 0.0};
    reference_judge_pair(j->setup, j->pipe, j->ranks[i1], j->ranks[i2], &pair);
    j->broken += pair.broken;
    if (pair.ratio > j->result->worst.ratio || (pair.broken && !j->result->worst.broken))
        j->result->worst = pair;
}

/* Every depth of a block as the nearer one. All that may be above the bound are judged with their own, and the longest
 * in any case; once many have failed, only what is worse than those. */
static void judge_block(judge *j, size_t from, size_t to, double limit) {
    double most = 0.0;
    size_t most_at[2] = {from, from};
    for (size_t i = from; i < to; i++) {
        const size_t other = farthest(j, i, j->keys[i]);
        const double interval =
            reference_cell_hi(&j->range, j->ranks[other]) - reference_cell_lo(&j->range, j->ranks[i]);
        const bool longest = interval > most;
        if (longest)
            most = interval, most_at[0] = i, most_at[1] = other;
        if (interval >= limit && (longest || j->broken < BROKEN_MAX))
            judge_pair(j, i, other);
    }
    judge_pair(j, most_at[0], most_at[1]);
    notice(j, reference_cell_lo(&j->range, j->ranks[most_at[0]]), reference_cell_hi(&j->range, j->ranks[most_at[1]]));
}

/*
 * The bound is evaluated at both ends of 64 neighbouring depths and taken to lie between the two in the block, less
 * 10 %; where the two differ by more than 10 % every depth with half of it is judged by its own.
 */
static void judge_run(judge *j, size_t from, size_t to) {
    for (size_t end; from < to; from = end) {
        end = from + BLOCK < to ? from + BLOCK : to;
        uint32_t key = 0;
        for (size_t i = from; i < end; i++)
            key = j->keys[i] > key ? j->keys[i] : key;
        const double lo = reference_cell_lo(&j->range, j->ranks[from]);
        const double first = reference_bound(j->setup, lo);
        const double last = reference_bound(j->setup, reference_cell_hi(&j->range, j->ranks[end - 1]));
        const double smallest = fmin(first, last);
        const double reach = reference_cell_hi(&j->range, j->ranks[farthest(j, from, key)]) - lo;
        if (isinf(smallest))
            continue;
        const bool even = fmax(first, last) <= 1.1 * smallest;
        if (!even || reach > 0.9 * smallest)
            judge_block(j, from, end, even ? smallest : 0.5 * smallest);
        else if (reach > j->loosest.ratio * smallest) {
            j->loosest.from = from, j->loosest.to = end;
            j->loosest.smallest = smallest, j->loosest.ratio = reach / smallest;
        }
    }
}

void reference_judge(const dp_setup *setup, const reference_pipe *p, const reference_window_plan *plan,
                     reference_result *result) {
    size_t count = 0;
    for (int k = 0; k < plan->count; k++)
        count += plan->run[k].count;
    uint32_t *memory = malloc(3 * count * sizeof *memory);
    if (!memory)
        abort();
    judge j = {.setup = setup,
               .pipe = p,
               .range = reference_range_of(setup),
               .count = count,
               .ranks = memory,
               .keys = memory + count,
               .least = memory + 2 * count,
               .result = result};
    for (size_t k = 0, at = 0; k < (size_t)plan->count; at += plan->run[k++].count) {
        for (uint32_t i = 0; i < plan->run[k].count; i++)
            j.ranks[at + i] = plan->run[k].first + i;
        reference_keys(p, plan->run[k].first, plan->run[k].count, j.keys + at);
    }
    uint32_t least = UINT32_MAX;
    for (size_t i = count; i-- > 0;)
        j.least[i] = least = j.keys[i] < least ? j.keys[i] : least;
    for (size_t k = 0, at = 0; k < (size_t)plan->count; at += plan->run[k++].count)
        judge_run(&j, at, at + plan->run[k].count);
    if (j.loosest.to > j.loosest.from && j.broken == 0)
        judge_block(&j, j.loosest.from, j.loosest.to, j.loosest.smallest);
    result->depths += count;
    result->broken += j.broken;
    free(memory);
}

/* ---- Words ------------------------------------------------------------------------------------------------------- */

const char *reference_class(const reference_pair *pair) {
    const reference_pipe p = reference_pipe_make(&pair->setup, pair->flush);
    const reference_range range = reference_range_of(&pair->setup);
    const double step = reference_depth(pair->x1 + 1) - reference_depth(pair->x1);
    const double between = reference_depth(pair->x2) - reference_depth(pair->x1);
    const double w1 = (double)reference_window(&p, pair->x1);
    const double w2 = (double)reference_window(&p, pair->x2);
    const dp_format *f = &pair->setup.spec.format;
    if (pair->x1 == pair->x2)
        return "one binary32 depth";
    if (pair->x1 == range.first)
        return between >= pair->bound ? "from near, binary32" : "from near, real";
    if (fmax(w1, w2) > 1.0 || fmin(w1, w2) < 0.0)
        return between >= pair->bound ? "clamped, binary32" : "clamped, real";
    if (between < pair->bound)
        return "real depths only";
    if (reference_subnormal(&p, pair->x2))
        return "subnormal numbers";
    if (f->kind == DP_FORMAT_FLOAT ? f->mantissa_bits == 23 && f->bias < 24 : f->bits > 24)
        return "format as wide as binary32";
    return between >= pair->bound + step ? "binary32, a step or more" : "binary32, less than a step";
}

void reference_line(const reference_pair *pair, char *text, size_t size) {
    const dp_spec *s = &pair->setup.spec;
    static const char *const roundings[] = {"nearest", "even", "zero"};
    snprintf(text, size,
             "depthprec budget -n %.17g -f %.17g -F %s -m %s%s --arith %s --rounding %s --at %.17g  # %.9g..%.9g codes "
             "%u, %u: %.9g apart, bound %.9g, ratio %.6f, %s%s",
             s->znear, s->zfar, s->format.name, dp_mapping_get(s->mapping)->name, s->ortho ? " --ortho" : "",
             dp_arith_get(s->arith)->name, roundings[s->rounding], pair->z1, reference_depth(pair->x1),
             reference_depth(pair->x2), pair->code1, pair->code2, pair->z2 - pair->z1, pair->bound, pair->ratio,
             reference_class(pair), pair->flush ? ", flushed" : "");
}
