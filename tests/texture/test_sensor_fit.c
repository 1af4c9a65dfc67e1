/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The lattice of levels is what common values lie on: values of one pixel between them, however many and to whichever
 * side, neither hide it nor move it. Lattices made here, whose levels have many pixels, are found as they were made.
 */
#include "support.h"
#include "texture/sensor_fit.h"

enum { LEVELS = 120, MOST = 2 * LEVELS };

static int by_place(const void *a, const void *b) {
    const fit_value *x = a, *y = b;
    return (x->at > y->at) - (x->at < y->at);
}

/* Levels whose values are rounded to 2 off, and a rare value for each so many levels: anywhere, or all by as much above
 * one. */
static size_t make(rng *r, double step, double offset, double off, int rare, double above, fit_value *out) {
    size_t count = 0;
    int k = 0;
    for (int i = 0; i < LEVELS; i++) {
        k += 1 + (int)rng_below(r, 3);
        const double pixels = rng_uniform(r, 40, 400);
        out[count++] = (fit_value){2 * off * rint((offset + k * step) / (2 * off)), off, pixels};
        if (rare > 0 && i % rare == 0) {
            const double share = above > 0 ? above * rng_uniform(r, 0.9, 1.1) : rng_unit(r);
            out[count++] = (fit_value){2 * off * rint((offset + (k + share) * step) / (2 * off)), off, 1};
        }
    }
    qsort(out, count, sizeof *out, by_place);
    size_t kept = 0;
    for (size_t i = 1; i < count; i++) {
        if (out[i].at == out[kept].at)
            out[kept].pixels += out[i].pixels;
        else
            out[++kept] = out[i];
    }
    return kept + 1;
}

/* @param least  the share of lattices that must be found: few levels and much noise may leave one open */
static void check_lattices(const char *name, int rare, double above, double least) {
    rng r = rng_make(name);
    tally t = {.name = name};
    const uint64_t rounds = test_cases(10, 30, 400);
    uint64_t seen = 0;
    for (uint64_t n = 0; n < rounds; n++) {
        static fit_value values[MOST];
        const double step = rng_log(&r, 1e-3, 1e-1);
        const double offset = step * rng_uniform(&r, 100, 200);
        const double off = step * rng_log(&r, 1.0 / 500, 1.0 / 60);
        const size_t count = make(&r, step, offset, off, rare, above, values);
        fit found = {.step = 0};
        const bool is_found = fit_find(values, count, &found);
        if (!is_found || !fit_explains(&found))
            continue;
        seen++;
        fit_bound(values, count, &found);
        const double levels = (found.offset - offset) / step;
        TALLY(&t, fabs(found.step - step) <= found.step_off, "steps of %.12g, found %.12g within %.3g", step,
              found.step, found.step_off);
        TALLY(&t, fabs(levels - rint(levels)) * step <= found.offset_off, "levels from %.12g, found %.12g within %.3g",
              offset, found.offset, found.offset_off);
        TALLY(&t, found.pixels > 0.9, "%g of the pixels are on it", found.pixels);
    }
    print_message("# %s: %d of %d found\n", name, (int)seen, (int)rounds);
    tally_end(&t);
    assert_true((double)seen >= least * (double)rounds);
}

TEST(levels_alone) {
    check_lattices("levels", 0, 0, 0.9);
}

TEST(rare_values_anywhere) {
    check_lattices("rare values", 4, 0, 0.7);
}

TEST(rare_values_above_each_level) {
    check_lattices("rare values to one side", 4, 0.025, 0.5);
}
