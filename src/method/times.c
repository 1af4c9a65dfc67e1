/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_sort_double.h>
#include <gsl/gsl_statistics_double.h>

#include "method/bench.h"

bench_times bench_statistics(double *times, size_t count) {
    gsl_sort(times, 1, count);
    const double lower = gsl_stats_quantile_from_sorted_data(times, 1, count, 0.25);
    return (bench_times){times[0], (lower - times[0]) / times[0]};
}
