/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The speed of the engine, as ratios within one run: what is compared runs in turn, after a warm-up, several times,
 * and the least is shown with the spread (largest over smallest).
 *
 *     bench_core [DEPTHPREC]    the program to start; bench_empty is looked for beside bench_core
 */
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "aims.h"
#include "core/engine.h"
#include "depthprec/depthprec.h"
#include "timing.h"

extern char **environ;

static dp_setup make(const char *format, dp_mapping mapping) {
    dp_format formats[2];
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.mapping = mapping;
    if (dp_format_parse(format, formats) > 0)
        spec.format = formats[0];
    const dp_status status = dp_setup_init(&setup, &spec);
    if (status != DP_OK) {
        fprintf(stderr, "bench_core: %s: %s\n", format, dp_status_text(status));
        exit(2);
    }
    return setup;
}

static void measured(const char *what, double value, const char *unit, double spread) {
    printf("%-48s %9.4g %-8s %6.2f\n", what, value, unit, spread);
}

static void aimed(const char *what, double value, const char *unit, double spread, aim_id id, const char *of) {
    printf("%-48s %9.4g %-8s %6.2f", what, value, unit, spread);
    aim_judge(id, of, value);
    printf("\n");
}

/* ---- The certified worst case against all codes ---------------------------------------------------------------- */

typedef struct sweep {
    double error, interval;
} sweep;

/*
 * `count` codes with values value, value + step, ...: D = near_term + far_term d is 1/z times a constant. Two lane-wise
 * maxima, no branch, nothing carried from code to code.
 */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
__attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#endif
static sweep
sweep_piece(double value, double step, int count, double constant, double slope, double share) {
    double error = 0.0;
    double interval = 0.0;
#pragma omp simd reduction(max : error, interval)
    for (int i = 0; i < count; i++) {
        const double d = value + step * i;
        const double nearer = constant + slope * (d - 0.5 * step);
        const double middle = constant + slope * d;
        const double farther = constant + slope * (d + 0.5 * step);
        const double lo_error = share * 0.5 / (nearer * middle);
        const double hi_error = share * 0.5 / (middle * farther);
        const double worst = lo_error > hi_error ? lo_error : hi_error;
        const double width = lo_error + hi_error;
        error = worst > error ? worst : error;
        interval = width > interval ? width : interval;
    }
    return (sweep){error, interval};
}

/* All 1,065,353,217 codes of fp32; the one at the beginning of a binade, whose two half cells differ, apart. */
static sweep sweep_fp32(const dp_setup *setup) {
    const double n = setup->spec.znear;
    const double f = setup->spec.zfar;
    const double constant = setup->reversed ? n : f; /* z = n f / (constant + slope d) */
    const double slope = setup->reversed ? f - n : n - f;
    sweep all = {0.0, 0.0};
    double finer = 0.0; /* the step below */
    for (int e = -127; e <= 0; e++) {
        const double step = e == 0 ? 0.0 : dp_power2((e == -127 ? -126 : e) - 23);
        const double first = e == -127 ? 0.0 : dp_power2(e);
        const double half = n * f * (f - n) * 0.5 / (constant + slope * first);
        const double below = half * finer / (constant + slope * (first - 0.5 * finer));
        const double above = half * step / (constant + slope * (first + 0.5 * step));
        all.error = fmax(all.error, fmax(below, above));
        all.interval = fmax(all.interval, below + above);
        if (e == 0)
            break;
        const sweep piece = sweep_piece(first + step, step, (1 << 23) - 1, constant, slope, n * f * (f - n) * step);
        all.error = fmax(all.error, piece.error);
        all.interval = fmax(all.interval, piece.interval);
        finer = step;
    }
    return all;
}

static void bench_worst(void) {
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_REVERSED};
    enum { BATCH = 2000, RUNS = 3 };
    for (size_t m = 0; m < 2; m++) {
        const dp_setup setup = make("fp32", mappings[m]);
        const double n = setup.spec.znear;
        const double f = setup.spec.zfar;
        timing certified = {0};
        timing exhaustive = {0};
        dp_worst worst = {0};
        sweep all = {0};
        for (int i = 0; i < BATCH; i++)
            dp_worst_over(&setup, n, f, &worst);
        for (int run = 0; run < RUNS; run++) {
            const double start = timing_now();
            for (int i = 0; i < BATCH; i++)
                dp_worst_over(&setup, n, f, &worst);
            const double middle = timing_now();
            all = sweep_fp32(&setup);
            timing_add(&certified, (middle - start) / BATCH);
            timing_add(&exhaustive, timing_now() - middle);
        }
        char what[64];
        const char *name = dp_mapping_get(mappings[m])->name;
        const double times = timing_least(&exhaustive) / timing_least(&certified);
        snprintf(what, sizeof what, "fp32 %s: worst case, certified", name);
        measured(what, 1e6 * timing_least(&certified), "us", timing_spread(&certified));
        snprintf(what, sizeof what, "fp32 %s: all 1,065,353,217 codes", name);
        measured(what, timing_least(&exhaustive), "s", timing_spread(&exhaustive));
        snprintf(what, sizeof what, "fp32 %s: certified is faster by", name);
        aimed(what, times, "x", timing_spread(&certified), AIM_CERTIFIED, name);
        const double apart = fmax(fabs(worst.error / all.error - 1.0), fabs(worst.interval / all.interval - 1.0));
        printf("  the two agree to %.1e: error %.9g, interval %.9g\n", apart, worst.error, worst.interval);
    }
}

/* ---- One depth ------------------------------------------------------------------------------------------------- */

enum { DEPTHS = 4096, ROUNDS = 2442, TIMED_ROUNDS = 41 };

static uint64_t random_bits(uint64_t *state) {
    uint64_t x = *state += 0x9E3779B97F4A7C15U;
    x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9U;
    x = (x ^ x >> 27) * 0x94D049BB133111EBU;
    return x ^ x >> 31;
}

/* Depths whose window depths are even over [0, 1], so that no part of a format is left out. */
static void fill(const dp_setup *setup, double z[DEPTHS], uint64_t *state) {
    for (int i = 0; i < DEPTHS; i++) {
        const double t = (double)(random_bits(state) >> 11) * 0x1p-53;
        z[i] = fmin(fmax(dp_eye(setup, t, 1.0 - t), setup->spec.znear), setup->spec.zfar);
    }
}

/* How often the quick decision is not certain: counted, and what 2^-48 t predicts, t = d in steps of the format. */
static void count_unsure(const dp_setup *setup, const char *name) {
    double z[DEPTHS];
    uint64_t state = 1;
    uint64_t unsure = 0;
    double expected = 0.0;
    for (int round = 0; round < ROUNDS; round++) {
        fill(setup, z, &state);
        for (int i = 0; i < DEPTHS; i++) {
            int certain;
            dp_code_quick(setup, z[i], &certain);
            unsure += (uint64_t)!certain;
            expected += 0x1p-48 * dp_scale_depth(&setup->spec.format, dp_window(setup, z[i])).t;
        }
    }
    printf("%-44s %11llu in %.0e, expected %.3g (2^%.1f)\n", name, (unsigned long long)unsure, (double)ROUNDS * DEPTHS,
           expected, log2(expected / ((double)ROUNDS * DEPTHS)));
}

static void time_depth(const dp_setup *setup, const char *name) {
    static uint32_t code[DEPTHS];
    double z[DEPTHS];
    uint64_t state = 1;
    uint64_t wrong = 0;
    timing times[3] = {{.count = 0}};
    static const char *const labels[] = {"quick", "exact", "whole sample"};
    fill(setup, z, &state);
    for (int round = -1; round < TIMED_ROUNDS; round++) {
        double t[4];
        dp_sample sample;
        int certain;
        t[0] = timing_now();
        for (int i = 0; i < DEPTHS; i++)
            code[i] = dp_code_quick(setup, z[i], &certain);
        t[1] = timing_now();
        for (int i = 0; i < DEPTHS; i++)
            wrong += dp_code_exact(setup, z[i], code[i]) != code[i];
        t[2] = timing_now();
        for (int i = 0; i < DEPTHS; i++)
            wrong += dp_sample_at(setup, z[i], &sample) != DP_OK;
        t[3] = timing_now();
        for (int i = 0; i < 3 && round >= 0; i++)
            timing_add(&times[i], (t[i + 1] - t[i]) / DEPTHS);
    }
    char what[64];
    for (int i = 0; i < 3; i++) {
        snprintf(what, sizeof what, "%s: one depth, %s", name, labels[i]);
        measured(what, 1e9 * timing_least(&times[i]), "ns", timing_spread(&times[i]));
    }
    if (wrong > 0)
        printf("  %llu codes differ between the quick and the exact path\n", (unsigned long long)wrong);
}

/* A code of the model float beside the arithmetic alone, whose pipeline is at hand. */
static void bench_pipeline_code(void) {
    dp_setup setup = make("fp32", DP_MAPPING_D3D);
    dp_spec spec = setup.spec;
    dp_pipeline pipeline;
    double z[DEPTHS];
    uint64_t state = 1;
    uint32_t differ = 0;
    timing whole = {0}, alone = {0};
    spec.model = DP_MODEL_FLOAT;
    if (dp_setup_init(&setup, &spec) != DP_OK || dp_pipeline_init(&pipeline, &setup) != DP_OK)
        exit(2);
    fill(&setup, z, &state);
    for (int round = 0; round < TIMED_ROUNDS; round++) {
        const double start = timing_now();
        for (int i = 0; i < DEPTHS; i++)
            differ += dp_code(&setup, z[i]);
        const double middle = timing_now();
        for (int i = 0; i < DEPTHS; i++)
            differ -= dp_pipeline_code(&pipeline, (float)z[i]);
        timing_add(&whole, (middle - start) / DEPTHS);
        timing_add(&alone, (timing_now() - middle) / DEPTHS);
    }
    if (differ != 0)
        exit(2);
    measured("fp32 d3d: one depth in the model float", 1e9 * timing_least(&whole), "ns", timing_spread(&whole));
    aimed("  as many times its arithmetic alone", timing_least(&whole) / timing_least(&alone), "x",
          timing_spread(&alone), AIM_PIPELINE_CODE, "");
}

static void bench_depth(void) {
    static const struct {
        const char *name, *format;
        dp_mapping mapping;
        int timed;
    } rows[] = {
        {"fp16 d3d", "fp16", DP_MAPPING_D3D, 0},           {"fp32 d3d", "fp32", DP_MAPPING_D3D, 0},
        {"fp32 reversed", "fp32", DP_MAPPING_REVERSED, 1}, {"unorm16 d3d", "unorm16", DP_MAPPING_D3D, 0},
        {"unorm24 d3d", "unorm24", DP_MAPPING_D3D, 1},     {"unorm32 d3d", "unorm32", DP_MAPPING_D3D, 0},
        {"unorm24 log", "unorm24", DP_MAPPING_LOG, 1},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (rows[i].timed) {
            const dp_setup setup = make(rows[i].format, rows[i].mapping);
            time_depth(&setup, rows[i].name);
        }
    printf("\nExact decisions needed, window depths even over [0, 1]\n");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const dp_setup setup = make(rows[i].format, rows[i].mapping);
        count_unsure(&setup, rows[i].name);
    }
}

/* ---- Whole processes ------------------------------------------------------------------------------------------- */

/* Seconds from start to end of a program with its output thrown away; NaN when it did not run or failed. */
static double run(char *const argv[]) {
    posix_spawn_file_actions_t actions;
    pid_t pid;
    int status;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const double start = timing_now();
    const int failed = posix_spawn(&pid, argv[0], &actions, NULL, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0 || waitpid(pid, &status, 0) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        return (double)NAN;
    return timing_now() - start;
}

/* @param viewport  null: surfaces that face the camera */
static void bench_table(char *program, char *empty, char *viewport) {
    enum { PAIRS = 200 };
    char *const table[] = {program, "table", "-F", "all", "-m", "d3d,reversed", viewport, NULL};
    char *const nothing[] = {empty, NULL};
    timing ours = {0};
    timing theirs = {0};
    for (int i = -5; i < PAIRS; i++) {
        const double a = run(table);
        const double b = run(nothing);
        if (isnan(a) || isnan(b)) {
            printf("whole process, table: not measured: %s or %s does not run\n", program, empty);
            theirs.count = 0;
            break;
        }
        if (i < 0)
            continue;
        timing_add(&ours, a);
        timing_add(&theirs, b);
    }
    if (viewport == NULL)
        measured("whole process, an empty program", 1e3 * timing_least(&theirs), "ms", timing_spread(&theirs));
    measured(viewport == NULL ? "whole process, table, 4 formats x 2 mappings" : "  the same, at any slant",
             1e3 * timing_least(&ours), "ms", timing_spread(&ours));
    aimed("  as many empty programs", timing_least(&ours) / timing_least(&theirs), "x", timing_spread(&ours),
          viewport == NULL ? AIM_TABLE : AIM_TABLE_SLANTED, "");
}

/* The first line that a program says of what it lacks. */
static const char *said_by(char *const command[], char out[256]) {
    char line[1024];
    size_t used = 0;
    for (int i = 0; command[i] != NULL; i++)
        used += (size_t)snprintf(line + used, sizeof line - used, "'%s' ", command[i]);
    snprintf(line + used, sizeof line - used, "2>&1 >/dev/null");
    FILE *in = popen(line, "r");
    strcpy(out, "it does not run");
    if (in == NULL)
        return out;
    if (fgets(out, 256, in) != NULL)
        out[strcspn(out, "\n")] = '\0';
    pclose(in);
    return out;
}

/* In a folder of its own the program runs with a file that it reads, or writes. */
static void bench_file(char *program, const char *what, aim_id aim, const char *text, char *const words[]) {
    enum { RUNS = 5, WORDS = 16 };
    char folder[] = "/tmp/depthprec-bench-XXXXXX", file[64], operand[80];
    char *command[WORDS] = {program};
    if (mkdtemp(folder) == NULL)
        return;
    snprintf(file, sizeof file, "%s/%s", folder, text != NULL ? "depth.glsl" : "map.png");
    snprintf(operand, sizeof operand, "%s%s", file, text != NULL ? ":depth" : "");
    for (int i = 0; words[i] != NULL; i++)
        command[i + 1] = strcmp(words[i], "FILE") == 0 ? operand : words[i];
    FILE *out = text != NULL ? fopen(file, "w") : NULL;
    if (out != NULL && (fputs(text, out) < 0 || fclose(out) != 0))
        return;
    timing t = {0};
    double seconds = run(command);
    for (int i = 0; i < RUNS && !isnan(seconds); i++) {
        seconds = run(command);
        timing_add(&t, seconds);
    }
    char label[80], why[256];
    snprintf(label, sizeof label, "whole process, %s", what);
    if (isnan(seconds)) {
        printf("%s: ", label);
        aim_missing(aim, "", said_by(command, why));
    } else {
        aimed(label, timing_least(&t), "s", timing_spread(&t), aim, "");
    }
    unlink(file);
    rmdir(folder);
}

static void bench_files(char *program) {
    /* 400 x 300 set-ups, of the kind that costs most */
    static char *const map[] = {"plot", "map", "-F", "fp32", "-m", "reversed", "-o", "FILE", NULL};
    static char *const judge[] = {"judge", "FILE", "-F", "d24", "-m", "d3d", "-n", "0.1", "-f", "1000", NULL};
    bench_file(program, "the figure map, 400 x 300 set-ups", AIM_MAP, NULL, map);
    bench_file(program, "a shader judged by 2^24 codes", AIM_JUDGE,
               "uniform float near, far;\n"
               "float depth(float d) { return near * far / (far - d * (far - near)); }\n",
               judge);
}

int main(int argc, char **argv) {
    static char default_program[] = "build/depthprec";
    char *program = argc > 1 ? argv[1] : getenv("DEPTHPREC");
    if (program == NULL || *program == '\0')
        program = default_program;
    char empty[4096];
    const char *slash = strrchr(argv[0], '/');
    snprintf(empty, sizeof empty, "%.*sbench_empty", slash == NULL ? 0 : (int)(slash + 1 - argv[0]), argv[0]);

    setvbuf(stdout, NULL, _IOLBF, 0);
    printf("%-48s %9s %-8s %6s   %s\n", "least of runs in turn", "", "", "spread", "aim");
    bench_table(program, empty, NULL);
    bench_table(program, empty, (char[]){"--viewport=1920x1080"});
    bench_files(program);
    bench_worst();
    bench_depth();
    bench_pipeline_code();
    return 0;
}
