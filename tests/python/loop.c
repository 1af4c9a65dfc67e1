/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The batch loop in C, nanoseconds an element, the best of many: what a door is measured by (bench.py). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "depthprec/depthprec.h"

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

/* loop FORMAT MAPPING TASK REAL WORD COUNT REPEATS, the elements as stdin; TASK "windows": dp_batch_windows() */
int main(int argc, char **argv) {
    dp_spec spec = dp_spec_default();
    dp_format format[2];
    dp_setup setup;
    dp_batch batch;
    if (argc != 8 || dp_format_parse(argv[1], format) == 0 || dp_mapping_parse(argv[2], &spec.mapping) != DP_OK)
        return 2;
    spec.format = format[0];
    const int windows = strcmp(argv[3], "windows") == 0;
    const dp_task task = windows ? DP_TASK_WINDOW : (dp_task)atoi(argv[3]); /* elements of the same sizes */
    const size_t count = (size_t)atol(argv[6]);
    if (dp_setup_init(&setup, &spec) != DP_OK ||
        dp_batch_init(&batch, &setup, task, (dp_real)atoi(argv[4]), (dp_word)atoi(argv[5]), dp_path_best()) != DP_OK)
        return 2;
    void *in = malloc(count * batch.in_size), *out = malloc(count * batch.out_size);
    if (in == NULL || out == NULL || fread(in, batch.in_size, count, stdin) != count)
        return 2;
    double best = 1e300;
    for (int i = atoi(argv[7]); i > 0; i--) {
        const double from = now();
        if (windows)
            dp_batch_windows(&setup, batch.real, in, out, NULL, NULL, count);
        else
            dp_batch_run(&batch, in, out, count);
        const double took = now() - from;
        best = took < best ? took : best;
    }
    printf("%.6f\n", best / (double)count);
    return 0;
}
