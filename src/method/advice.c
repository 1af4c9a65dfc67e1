/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/advice.h"

static bool is_candidate(const bench_result *r) {
    return r->front && (r->row->domain & METHOD_PIPELINE) == 0;
}

/* The fastest of those that are off by at most that much. */
static const bench_result *fastest_within(const method_family_row *family, const bench_result *results, size_t count,
                                          double most) {
    const bench_result *best = NULL;
    for (size_t i = 0; i < count; i++)
        if (is_candidate(&results[i]) && measured_error(family, &results[i].measured) <= most &&
            (best == NULL || results[i].ns < best->ns))
            best = &results[i];
    return best;
}

const bench_result *advice_use(const method_family_row *family, const bench_result *results, size_t count) {
    const bench_result *best =
        fastest_within(family, results, count, family->steps ? STABILITY_LOST_STEPS : STABILITY_LOST);
    for (size_t i = 0; best == NULL && i < count; i++) {
        const double least = measured_error(family, &results[i].measured);
        const bench_result *r = is_candidate(&results[i]) ? fastest_within(family, results, count, least) : NULL;
        bool exact = r != NULL;
        for (size_t k = 0; k < count && exact; k++)
            exact = !is_candidate(&results[k]) || measured_error(family, &results[k].measured) >= least;
        best = exact ? r : NULL;
    }
    return best;
}

size_t advice_case(const method_family_row *family, double znear, double zfar, size_t *which, bench_result *results) {
    size_t count = 0;
    for (size_t i = 0; i < family->case_count && advice_use(family, results, count) == NULL; i++) {
        dp_setup setup;
        if (method_setup(family, i, znear, zfar, false, &setup) != DP_OK)
            continue;
        count = bench_run(family, i, &setup, BENCH_REPETITIONS, results);
        *which = i;
    }
    return count;
}

const bench_result *advice_next(const method_family_row *family, const bench_result *results, size_t count,
                                const bench_result *use) {
    const bench_result *best = NULL;
    for (size_t i = 0; i < count && use != NULL; i++)
        if (is_candidate(&results[i]) &&
            2 * measured_error(family, &results[i].measured) <= measured_error(family, &use->measured) &&
            &results[i] != use && (best == NULL || results[i].ns < best->ns))
            best = &results[i];
    return best;
}
