/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The library's own answers, bit for bit, for the doors to be compared with: walk.py and walk.mjs print the same lines.
 *
 *     walk SEED COUNT     random set-ups, a line each: near far format mapping ortho rounding model arith z...
 *     walk <SETUPS        a line of answers each, or why it is refused
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/bits.h"
#include "depthprec/depthprec.h"

enum { DEPTHS = 6 };

static uint64_t state;

static unsigned below(unsigned n) {
    state = dp_mixed64(state + 0x9e3779b97f4a7c15u);
    return (unsigned)(state >> 33) % n;
}

static double unit(void) {
    state = dp_mixed64(state + 0x9e3779b97f4a7c15u);
    return (double)(state >> 11) * 0x1p-53;
}

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void make(void) {
    static const char *const formats[] = {"unorm16", "unorm24", "fp32", "fp16", "unorm10", "unorm32", "float3.3b5"};
    const int infinite = below(8) == 0, ortho = below(5) == 0;
    const double near = unit() * (double)(1U << below(12)) + 1e-3,
                 far = near * (1.001 + unit() * (double)(1U << below(20)));
    double z[DEPTHS];
    const char *const format = formats[below(7)], *const mapping =
                                                      dp_mapping_get((dp_mapping)below(DP_MAPPING_COUNT))->name;
    const char *const rounding = dp_rounding_name((dp_rounding)below(3));
    const char *const model = dp_model_name((dp_model)below(DP_MODEL_COUNT));
    printf(infinite ? "%.17g inf" : "%.17g %.17g", near, far);
    printf(" %s %s %d %s %s %s", format, mapping, ortho, rounding, model, dp_arith_get(below(3))->name);
    for (int i = 0; i < DEPTHS; i++)
        z[i] = near + (far - near) * unit() * unit() * unit();
    qsort(z, DEPTHS, sizeof *z, by_size);
    for (int i = 0; i < DEPTHS; i++)
        printf(" %.17g", z[i]);
    printf("\n");
}

static void show(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    if (x == x)
        printf(" %016llx", (unsigned long long)bits);
    else
        printf(" nan");
}

static void run(const dp_setup *s, dp_task task, dp_real real, const void *in, void *out, size_t count) {
    dp_batch batch;
    if (dp_batch_init(&batch, s, task, real, DP_WORD_32, dp_path_best()) != DP_OK)
        exit(2);
    dp_batch_run(&batch, in, out, count);
}

/* Walks over depths in either type; floats are shown as the doubles that they are. */
static void show_depths(const dp_setup *own, const dp_setup *const of[4], dp_real real, const double z[DEPTHS]) {
    static const dp_task tasks[] = {DP_TASK_WINDOW, DP_TASK_SEPARATION, DP_TASK_SEPARATION, DP_TASK_INTERVAL};
    float narrow[DEPTHS], few[DEPTHS];
    double many[DEPTHS];
    uint32_t codes[DEPTHS];
    for (int i = 0; i < DEPTHS; i++)
        narrow[i] = (float)z[i];
    const void *in = real == DP_REAL_FLOAT ? (const void *)narrow : z;
    run(own, DP_TASK_CODE, real, in, codes, DEPTHS);
    for (int i = 0; i < DEPTHS; i++)
        printf(" %u", codes[i]);
    for (int t = 0; t < 4; t++) {
        run(of[t], tasks[t], real, in, real == DP_REAL_FLOAT ? (void *)few : many, DEPTHS);
        for (int i = 0; i < DEPTHS; i++)
            show(real == DP_REAL_FLOAT ? (double)few[i] : many[i]);
    }
    for (dp_task t = DP_TASK_EYE; t <= DP_TASK_HI; t = t == DP_TASK_EYE ? DP_TASK_LO : t + 1) {
        run(own, t, real, codes, real == DP_REAL_FLOAT ? (void *)few : many, DEPTHS);
        for (int i = 0; i < DEPTHS; i++)
            show(real == DP_REAL_FLOAT ? (double)few[i] : many[i]);
    }
}

static void show_windows(const dp_setup *own, const double z[DEPTHS]) {
    double d[DEPTHS], out[3][DEPTHS];
    run(own, DP_TASK_WINDOW, DP_REAL_DOUBLE, z, d, DEPTHS);
    dp_batch_windows(own, DP_REAL_DOUBLE, d, out[0], out[1], out[2], DEPTHS);
    for (int i = 0; i < 3 * DEPTHS; i++)
        show(out[i / DEPTHS][i % DEPTHS]);
}

static void show_worst(const dp_setup *own, const dp_setup *guaranteed, double lo, double hi) {
    dp_worst w;
    dp_separation_worst s;
    dp_status status = dp_worst_over(own, lo, hi, &w);
    if (status == DP_OK)
        status = dp_separation_over(guaranteed, lo, hi, 0, &s);
    if (status != DP_OK) {
        printf(" %s", dp_status_text(status));
        return;
    }
    const double all[] = {w.lo,          w.hi,          w.error,         w.error_z,    w.error_code, w.interval,
                          w.interval_lo, w.interval_hi, w.interval_code, w.blind_from, s.bound,      s.z};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        show(all[i]);
}

static void answer(const char *line) {
    char format[32], mapping[32], rounding[16], model[16], arith[64], far[40];
    double z[DEPTHS];
    dp_spec spec = dp_spec_default();
    dp_format formats[2];
    dp_setup own, lattice;
    if (sscanf(line, "%lf %39s %31s %31s %d %15s %15s %63s %lf %lf %lf %lf %lf %lf", &spec.znear, far, format, mapping,
               &spec.ortho, rounding, model, arith, &z[0], &z[1], &z[2], &z[3], &z[4], &z[5]) != 14 ||
        dp_format_parse(format, formats) == 0 || dp_mapping_parse(mapping, &spec.mapping) != DP_OK ||
        dp_arith_parse(arith, &spec.arith) != DP_OK)
        exit(2);
    spec.zfar = strtod(far, NULL);
    spec.format = formats[0];
    while (strcmp(dp_rounding_name(spec.rounding), rounding) != 0)
        spec.rounding++;
    while (strcmp(dp_model_name(spec.model), model) != 0)
        spec.model++;
    dp_status status = dp_setup_init(&own, &spec);
    spec.model = DP_MODEL_EXACT;
    if (status != DP_OK || dp_setup_init(&lattice, &spec) != DP_OK) {
        printf("%s\n", dp_status_text(status));
        return;
    }
    const dp_setup guaranteed = dp_setup_guaranteed(&own);
    const dp_setup *const of[] = {&own, &guaranteed, &lattice, &own};
    show_depths(&own, of, DP_REAL_DOUBLE, z);
    show_depths(&own, of, DP_REAL_FLOAT, z);
    show_windows(&own, z);
    show_worst(&own, &guaranteed, z[0], z[DEPTHS - 1]);
    printf("\n");
}

int main(int argc, char **argv) {
    char line[1024];
    state = argc == 3 ? strtoull(argv[1], NULL, 10) : 0;
    for (int i = argc == 3 ? atoi(argv[2]) : 0; i > 0; i--)
        make();
    while (argc != 3 && fgets(line, sizeof line, stdin) != NULL)
        answer(line);
    return 0;
}
