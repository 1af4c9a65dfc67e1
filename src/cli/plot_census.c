/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/plot_census.h"

#include <stdio.h>
#include <stdlib.h>

#include "census/census.h"

/* One block for everything. */
typedef struct found {
    figure_census shown[PLOT_CENSUS_SETUPS_MAX];
    double z[PLOT_CENSUS_SETUPS_MAX][CENSUS_BANDS_MAX], longest[PLOT_CENSUS_SETUPS_MAX][CENSUS_BANDS_MAX];
    census_result result;
} found;

static size_t fp32_count(const setups *all) {
    size_t count = 0;
    for (size_t i = 0; i < all->count; i++)
        count += all->items[i].spec.model == DP_MODEL_FP32;
    return count;
}

/* Bands without an interval have no point. */
static bool take(found *f, size_t i, const dp_setup *setup, double lo, double hi) {
    const census_request q = {.setup = setup, .lo = lo, .hi = hi};
    size_t used = 0;
    if (census_run(&q, &f->result) != CENSUS_DONE)
        return false;
    for (int b = 0; b < f->result.band_count; b++)
        if (f->result.bands[b].longest > 0) {
            f->z[i][used] = f->result.bands[b].longest_z;
            f->longest[i][used++] = f->result.bands[b].longest;
        }
    f->shown[i] = (figure_census){used, f->z[i], f->longest[i]};
    return true;
}

int plot_census_make(const setups *all, const figure_request *request, plot_census *out) {
    double lo, hi;
    bool good = true;
    figure_range(request, &lo, &hi);
    *out = (plot_census){NULL, NULL};
    const uint64_t visited = census_count(lo, hi);
    if (fp32_count(all) == 0 || all->count > PLOT_CENSUS_SETUPS_MAX || visited < 2 || visited > PLOT_CENSUS_DEPTHS_MAX)
        return EXIT_FINE;
    found *f = calloc(1, sizeof *f);
    for (size_t i = 0; i < all->count && f != NULL && good; i++)
        if (all->items[i].spec.model == DP_MODEL_FP32)
            good = take(f, i, &all->items[i], lo, hi);
    if (f == NULL || !good) {
        free(f);
        fprintf(stderr, "depthprec: no memory for the census\n");
        return EXIT_IO;
    }
    *out = (plot_census){f->shown, f};
    return EXIT_FINE;
}

void plot_census_free(plot_census *c) {
    free(c->memory);
    *c = (plot_census){NULL, NULL};
}
