/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "zfight/range.h"

#include <float.h>
#include <math.h>
#ifdef _OPENMP
#include <omp.h>
#endif

/* Next to 0 binary32 has more depths than anywhere, and none says more than its neighbours: from 2^-10 of the farther
 * end on they are one band. */
static int ends_of(double lo, double hi, census_range *out) {
    enum { OCTAVES = 10 };
    if (!(lo <= hi && lo >= -(double)FLT_MAX && hi <= (double)FLT_MAX))
        return 0;
    out->first = dp_rank32(dp_float_up(lo));
    out->last = dp_rank32(dp_float_down(hi));
    const uint32_t farthest = dp_bits32((float)fmax(-lo, hi)) >> 23;
    out->folded = lo > 0.0 || farthest < OCTAVES ? 0 : farthest - OCTAVES;
    return out->first <= out->last;
}

int census_threads(const census_request *request) {
#ifdef _OPENMP
    return request->threads > 0 ? request->threads : omp_get_max_threads();
#else
    (void)request;
    return 1;
#endif
}

uint64_t census_count(double lo, double hi) {
    census_range range;
    return ends_of(lo, hi, &range) ? (uint64_t)range.last - range.first + 1 : 0;
}

/* A guarantee that reaches beyond far promises nothing there: no two surfaces are farther apart than that. */
static double bound_at(const census_request *request, double z) {
    return fmin(request->bound(request->setup, z), request->setup->spec.zfar - z);
}

/* The guarantee is neither monotone nor smooth: look at it all over the band, and at its last depth. */
static double greatest_bound(const census_request *request, const census_band *band, int last) {
    enum { LOOKS = 1024 };
    const double end = last ? band->hi : (double)nextafterf((float)band->hi, -HUGE_VALF);
    double greatest = bound_at(request, end);
    for (int i = 0; i < LOOKS && band->lo < end; i++)
        greatest = fmax(greatest, bound_at(request, band->lo + (end - band->lo) * i / LOOKS));
    return greatest;
}

census_status census_open(const census_request *request, census_plan *plan, census_result *result,
                          census_range *range) {
    dp_pipeline pipeline;
    if (dp_pipeline_init(&pipeline, request->setup) != DP_OK)
        return CENSUS_MODEL;
    if (!ends_of(request->lo, request->hi, range))
        return CENSUS_RANGE;
    *plan = census_plan_make(&pipeline);
    *result = (census_result){.band_count = census_band_of(range, range->last) + 1};
    uint32_t binade = range->first >> 23;
    for (int i = 0; i < result->band_count; i++) {
        census_band *band = &result->bands[i];
        band->lo = i == 0 ? request->lo : (double)dp_ranked32(binade << 23);
        do
            binade++;
        while (census_band_of(range, binade << 23) == i);
        band->hi = i == result->band_count - 1 ? request->hi : (double)dp_ranked32(binade << 23);
        band->longest_z = band->slack_z = band->bound = band->first = band->last_apart = (double)NAN;
        if (request->bound != NULL)
            band->bound = greatest_bound(request, band, i == result->band_count - 1);
    }
    return CENSUS_DONE;
}

/* Compares with the guarantee: surfaces are real, each up to half a step away from the depth that stands for it. */
static void note_used(const census_request *request, census_band *band, float z1, float z2) {
    const double half1 = 0.5 * census_ulp(z1);
    const double half2 = 0.5 * census_ulp(z2);
    const double bound = request->bound(request->setup, (double)z1);
    const double apart = (double)z2 - (double)z1 + half1 + half2;
    const double slack = bound > 0.0 ? apart / bound : HUGE_VAL; /* no bound at all is a broken one */
    if (slack > band->slack || (slack == band->slack && !((double)z1 >= band->slack_z))) {
        band->slack = slack;
        band->slack_z = (double)z1;
    }
}

void census_note(const census_request *request, census_band *band, float z1, float z2) {
    const double length = (double)z2 - (double)z1;
    /* A place is NaN while it is not known: anything is nearer. */
    if (length > band->longest || (length == band->longest && !((double)z1 >= band->longest_z))) {
        band->longest = length;
        band->longest_z = (double)z1;
    }
    if (request->bound == NULL)
        return;
    note_used(request, band, z1, z2);
}

void census_add(census_band *to, const census_band *from) {
    to->pairs += from->pairs;
    to->ties += from->ties;
    to->swaps += from->swaps;
    to->clipped += from->clipped;
    to->first = fmin(to->first, from->first); /* the number, where one of them is none */
    to->last_apart = fmax(to->last_apart, from->last_apart);
    if (from->longest > to->longest || (from->longest == to->longest && from->longest_z < to->longest_z)) {
        to->longest = from->longest;
        to->longest_z = from->longest_z;
    }
    if (from->slack > to->slack || (from->slack == to->slack && from->slack_z < to->slack_z)) {
        to->slack = from->slack;
        to->slack_z = from->slack_z;
    }
}

/* How many depths of the range lie outside [lo, hi]; all, when these are NaN. */
static uint64_t outside(const census_range *range, double lo, double hi) {
    return isnan(lo) ? (uint64_t)range->last - range->first + 1
                     : (uint64_t)(dp_rank32((float)lo) - range->first) + (range->last - dp_rank32((float)hi));
}

void census_close(const census_request *request, const census_plan *plan, const census_range *range,
                  census_result *result) {
    census_band *all = &result->all;
    *all = (census_band){.lo = request->lo, .hi = request->hi};
    all->longest_z = all->slack_z = all->bound = all->first = all->last_apart = (double)NAN;
    for (int i = 0; i < result->band_count; i++) {
        census_band *band = &result->bands[i];
        if (request->bound != NULL && band->longest > 0.0)
            band->bound = fmax(band->bound, bound_at(request, band->longest_z));
        all->bound = fmax(all->bound, band->bound);
        census_add(all, band);
    }
    /* The planes of a part of the camera's range: the same search between its ends. */
    dp_pipeline part = plan->pipeline;
    float znear, zfar;
    part.znear = dp_ranked32(range->first);
    part.zfar = dp_ranked32(range->last);
    dp_pipeline_planes(&part, &znear, &zfar);
    result->near_effective = (double)znear;
    result->far_effective = (double)zfar;
    const uint64_t lost = outside(range, result->near_effective, result->far_effective);
    result->holes = all->clipped > lost ? all->clipped - lost : 0;
}
