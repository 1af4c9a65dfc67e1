/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/sensor_levels.h"

#include <math.h>

#include "core/elementary.h"
#include "core/recognise_lattice.h"

enum { MODULUS_MOST = 64 };

static int residue_of(double k, int modulus) {
    return (int)(k - modulus * floor(k / modulus));
}

/* Counts the levels, or their pixels, that have each residue. @return the fullest one */
static int count_residues(const level_set *levels, int modulus, const double *pixels, double of[MODULUS_MOST]) {
    int fullest = 0;
    for (int i = 0; i < modulus; i++)
        of[i] = 0;
    for (size_t i = 0; i < levels->count; i++)
        of[residue_of(levels->k[i], modulus)] += pixels != NULL ? pixels[i] : 1;
    for (int i = 1; i < modulus; i++)
        fullest = of[i] > of[fullest] ? i : fullest;
    return fullest;
}

/* Whether levels avoid some residues, by chi squared and its bound for a chance of e^-15. */
static bool is_uneven(const level_set *levels, int modulus) {
    double of[MODULUS_MOST], squares = 0, all = (double)levels->count;
    count_residues(levels, modulus, NULL, of);
    for (int i = 0; i < modulus; i++)
        squares += of[i] * of[i];
    return modulus * squares > all * (all + modulus - 1 + 2 * sqrt(15.0 * (modulus - 1)) + 30);
}

/* Where averages of neighbours lie half way between levels few pixels have them. */
static bool is_half(const level_set *levels) {
    enum { HALVES = 3 };
    double of[MODULUS_MOST], sum = 0;
    for (size_t i = 0; i < levels->count; i++)
        sum += levels->pixels[i];
    for (int q = 2; q <= HALVES; q++) {
        const int fullest = count_residues(levels, q, levels->pixels, of);
        if (of[fullest] >= 0.875 * sum)
            return true;
    }
    return false;
}

/* -log2 of the chance that `on` or more of `all` events of one chance happen: Chernoff's bound at its best. */
static double bits_of(double on, double all, double chance) {
    const double share = on / all, off = 1 - share;
    return share > chance ? all * (share * dp_log2(share / chance) + (off > 0 ? off * dp_log2(off / (1 - chance)) : 0))
                          : 0;
}

/*
 * Two lattices that were put together lie on a finer one, on every q-th level and every p-th: without a common divisor,
 * or it would be a coarser one. Levels of one lattice lie on those by chance, Chernoff's bound for some of 70,000 pairs
 * of residues.
 */
static bool is_of_two(const level_set *levels, level_set *left) {
    enum { FIRST_MOST = 8, PAIR_BITS = 38 };
    const double all = (double)levels->count;
    for (int q = 2; q <= FIRST_MOST; q++) {
        double of[MODULUS_MOST];
        const int first = count_residues(levels, q, NULL, of);
        left->count = 0;
        for (size_t i = 0; i < levels->count; i++)
            if (residue_of(levels->k[i], q) != first)
                left->k[left->count++] = levels->k[i];
        for (int p = 2; p <= MODULUS_MOST; p++) {
            const double on = all - (double)left->count + of[count_residues(left, p, NULL, of)];
            if (dp_common_divisor((size_t)q, (size_t)p) == 1 && bits_of(on, all, (1 + (q - 1.0) / p) / q) > PAIR_BITS)
                return true;
        }
    }
    return false;
}

bool levels_are_mixed(const level_set *levels, double *room) {
    level_set left = {.k = room};
    bool mixed = false;
    for (int q = 2; q <= MODULUS_MOST && !mixed; q++)
        mixed = is_uneven(levels, q);
    return mixed || is_half(levels) || is_of_two(levels, &left);
}
