/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The number that solve prints, typed in again, passes: rounded to the safe side and tried, not concluded. */
#include <unistd.h>

#include "cli/option/option.h"
#include "support.h"

int cmd_solve(void *request);

typedef struct asked {
    const char *format, *mapping, *model;
    int target; /* 0 near, 1 far, 2 distance */
    double znear, zfar, z, separation;
} asked;

static dp_setup setup_of(const asked *a, double plane) {
    dp_format found[2];
    dp_setup setup;
    dp_spec spec = dp_spec_default();
    dp_format_parse(a->format, found);
    spec.format = found[0];
    dp_mapping_parse(a->mapping, &spec.mapping);
    spec.znear = a->target == 0 ? plane : a->znear;
    spec.zfar = a->target == 1 ? plane : a->zfar;
    for (int m = 0; m < DP_MODEL_COUNT; m++)
        if (strcmp(dp_model_name((dp_model)m), a->model) == 0)
            spec.model = (dp_model)m;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

static asked draw(rng *r) {
    static const char *const formats[] = {"fp32", "unorm16", "unorm24", "unorm24", "fp16"};
    static const char *const mappings[] = {"d3d", "gl", "reversed", "gl-reversed"};
    static const char *const models[] = {"exact", "staged", "float", "float", "float"};
    asked a = {.format = formats[rng_below(r, 5)],
               .mapping = mappings[rng_below(r, 4)],
               .model = models[rng_below(r, 5)],
               .target = (int)rng_below(r, 3),
               .znear = rng_log(r, 1e-2, 10.0)};
    a.zfar = a.znear * rng_log(r, 10.0, 1e5);
    a.z = rng_log(r, a.znear * 2.0, a.zfar * 0.5);
    const double plane = a.target == 0 ? a.znear : a.zfar;
    const dp_setup setup = setup_of(&a, plane);
    a.separation = dp_separation(&setup, a.z) * rng_log(r, 0.8, 1.5);
    return a;
}

static char passing[512]; /* "  passes  every near from 3 to 500"; "" where none does */

/* The words of the command line, and what the command printed first. */
static int ask(const asked *a, const char *path, char line[512]) {
    static const char *const targets[] = {"near", "far", "distance"};
    char planes[2][32], z[32], separation[32];
    char *argv[24] = {"depthprec",
                      "solve",
                      "-q",
                      "-F",
                      (char *)(uintptr_t)a->format,
                      "-m",
                      (char *)(uintptr_t)a->mapping,
                      "--model",
                      (char *)(uintptr_t)a->model,
                      "--for",
                      (char *)(uintptr_t)targets[a->target],
                      "--separation",
                      separation,
                      "--full",
                      "-o",
                      (char *)(uintptr_t)path};
    int argc = 16;
    snprintf(separation, sizeof separation, "%.17g", a->separation);
    snprintf(planes[0], sizeof planes[0], "%.17g", a->znear);
    snprintf(planes[1], sizeof planes[1], "%.17g", a->zfar);
    snprintf(z, sizeof z, "%.17g", a->z);
    for (int k = 0; k < 2; k++)
        if (a->target != k) {
            argv[argc++] = k == 0 ? "-n" : "-f";
            argv[argc++] = planes[k];
        }
    if (a->target != 2) {
        argv[argc++] = "--at";
        argv[argc++] = z;
    }
    static asked_line o;
    int status = options_parse(&o, argc, argv);
    if (status == EXIT_FINE)
        status = cmd_solve(o.request);
    options_release(&o);
    FILE *in = fopen(path, "r");
    if (in == NULL || fgets(line, 512, in) == NULL)
        line[0] = '\0';
    do
        passing[0] = '\0';
    while (in != NULL && fgets(passing, sizeof passing, in) != NULL && strncmp(passing, "  passes ", 9) != 0);
    if (in != NULL)
        fclose(in);
    return status;
}

/* The number behind the first of these words. */
static double printed(const char *line) {
    static const char *const words[] = {"must be at least ", "may be at most ", "Near ", "Far ", "up to z = "};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        const char *at = strstr(line, words[i]);
        if (at != NULL)
            return strtod(at + strlen(words[i]), NULL);
    }
    return NAN;
}

static int digits_of(const char *line) {
    const char *at = strpbrk(strstr(line, "at most ") != NULL    ? strstr(line, "at most ")
                             : strstr(line, "at least ") != NULL ? strstr(line, "at least ")
                                                                 : line,
                             "123456789");
    int count = 0;
    for (; at != NULL && (*at == '.' || (*at >= '0' && *at <= '9')); at++)
        count += *at != '.';
    return count;
}

TEST(test_printed) {
    rng r = rng_make("solve printed");
    tally passes = {.name = "what is printed passes, typed in again"};
    tally tight = {.name = "and is not rounded by more than its digits"};
    tally few = {.name = "six digits are mostly enough"};
    uint64_t longer = 0;
    char path[] = "/tmp/depthprec-printed-XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    const uint64_t cases = test_cases(40, 400, 6000);
    for (uint64_t i = 0; i < cases; i++) {
        const asked a = draw(&r);
        if (isinf(a.separation))
            continue;
        char line[512];
        const int status = ask(&a, path, line);
        const double value = printed(line);
        if (strncmp(line, "Any ", 4) == 0 || status == EXIT_FAILED)
            continue;
        const dp_setup setup = setup_of(&a, a.target == 0 ? value : a.target == 1 ? value : a.znear);
        dp_separation_worst worst = {.bound = dp_separation(&setup, a.z)};
        if (a.target == 2)
            dp_separation_over(&setup, a.znear, value, a.separation, &worst);
        TALLY(&passes, status == EXIT_FINE && worst.bound <= a.separation, "%s %s %s near %.17g far %.17g: %s",
              a.format, a.mapping, a.model, a.znear, a.zfar, line);
        longer += (uint64_t)(digits_of(line) > 6);
        if (a.target == 2 && value < a.zfar * 0.9999) {
            dp_separation_over(&setup, a.znear, value * 1.00002 + 1e-6 * value, a.separation, &worst);
            TALLY(&tight, worst.bound > a.separation, "%s %s %s near %.17g far %.17g: %s", a.format, a.mapping, a.model,
                  a.znear, a.zfar, line);
        }
    }
    unlink(path);
    TALLY(&few, longer * 5 < passes.cases, "%llu of %llu have more", (unsigned long long)longer,
          (unsigned long long)passes.cases);
    tally_end(&passes);
    tally_end(&tight);
    tally_end(&few);
}

/* The number that leads is the one to use: no plane between it and the depth fails, many of few bits among them. */
TEST(test_all_beyond) {
    rng r = rng_make("solve beyond");
    tally all = {.name = "every plane on the safe side of what is printed first passes"};
    char path[] = "/tmp/depthprec-beyond-XXXXXX", line[512];
    const int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    const uint64_t cases = test_cases(30, 300, 3000);
    for (uint64_t i = 0; i < cases; i++) {
        asked a = {"unorm24", "d3d", "fp32", 0, 0, i == 0 ? 10000 : INFINITY,
                   5000,      0.01}; /* the examples of README.md */
        if (i > 1)
            a = draw(&r);
        a.model = "float";
        if (a.target == 2 || isinf(a.separation) || ask(&a, path, line) != EXIT_FINE || strncmp(line, "Any ", 4) == 0)
            continue;
        const double value = printed(line);
        double lo = NAN, hi = NAN;
        assert_true(*passing == '\0' || sscanf(passing, " passes every %*s from %lf to %lf", &lo, &hi) == 2);
        assert_true(i > 1 || hi == 5000.0);
        const double end = a.target == 0 ? hi : lo;
        for (int k = 0; k < 400 && isfinite(end); k++) {
            const double x = value * pow(end / value, rng_unit(&r)), grid = ldexp(1.0, ilogb(x) - k % 20);
            const double coarse = fmin(fmax(rint(x / grid) * grid, fmin(value, end)), fmax(value, end));
            const double plane = k % 2 == 0 ? x : coarse;
            const dp_setup setup = setup_of(&a, plane);
            TALLY(&all, dp_separation(&setup, a.z) <= a.separation,
                  "%s %s near %.17g far %.17g z %.17g: %.17g fails: %s", a.format, a.mapping, a.znear, a.zfar, a.z,
                  plane, line);
        }
    }
    unlink(path);
    tally_end(&all);
}
