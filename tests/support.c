/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "support.h"

#include <errno.h>
#include <time.h>

/* ---- tests ---- */

enum { TESTS_MAX = 64 };

static struct CMUnitTest tests[TESTS_MAX];
static size_t test_count;

void list_test(struct CMUnitTest test) {
    if (test_count == TESTS_MAX)
        abort();
    tests[test_count++] = test;
}

int run_listed(CMFixtureFunction before, CMFixtureFunction after) {
    cmocka_set_message_output(CM_OUTPUT_TAP);
    cmocka_set_test_filter(getenv("DEPTHPREC_TEST"));
    return _cmocka_run_group_tests("tests", tests, test_count, before, after);
}

int __attribute__((weak)) main(void) {
    return run_listed(NULL, NULL);
}

/* ---- numbers ---- */

static uint64_t mix(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}

static uint64_t seed_of_run(void) {
    static uint64_t seed;
    static int known;
    if (!known) {
        const char *text = getenv("DEPTHPREC_SEED");
        if (!text || !*text)
            text = getenv("SEED"); /* make check SEED=5 */
        seed = 20150707;
        if (text && strcmp(text, "time") == 0)
            seed = mix((uint64_t)time(NULL));
        else if (text && *text)
            seed = strtoull(text, NULL, 0);
        known = 1;
        printf("# seed %llu\n", (unsigned long long)seed);
    }
    return seed;
}

rng rng_make(const char *name) {
    rng r = {mix(seed_of_run() + 0x9E3779B97F4A7C15u)};
    for (; *name; name++)
        r.state = mix(r.state ^ (unsigned char)*name);
    return r;
}

uint64_t rng_next(rng *r) {
    return mix(r->state += 0x9E3779B97F4A7C15u);
}

uint64_t rng_below(rng *r, uint64_t count) {
    return (uint64_t)(((unsigned __int128)rng_next(r) * count) >> 64);
}

double rng_unit(rng *r) {
    return (double)(rng_next(r) >> 11) * 0x1p-53;
}

double rng_uniform(rng *r, double lo, double hi) {
    return fmin(hi, lo + (hi - lo) * rng_unit(r));
}

double rng_log(rng *r, double lo, double hi) {
    double x = exp(rng_uniform(r, log(lo), log(hi)));
    return fmin(hi, fmax(lo, x));
}

static double sign_of(rng *r) {
    return rng_below(r, 2) ? 1.0 : -1.0;
}

static double rng_end(rng *r) {
    switch (rng_below(r, 4)) {
    case 0:
        return (double)(rng_below(r, 101)) / 100;
    case 1:
        return rng_below(r, 2) ? 1 - rng_log(r, 1e-6, 1) : rng_log(r, 1e-6, 1);
    case 2:
        return ldexp(1, -(int)rng_below(r, 19));
    default:
        return (double)rng_below(r, 2);
    }
}

void rng_range(rng *r, double range[2]) {
    do {
        range[0] = rng_end(r);
        range[1] = rng_below(r, 3) ? rng_end(r) : range[0] + (rng_below(r, 2) ? 1 : -1) * rng_log(r, 1e-6, 1e-2);
    } while (!(fabs(range[0] - range[1]) >= 1e-6) || (range[0] != 0 && !(range[0] >= 1e-6 && range[0] <= 1)) ||
             (range[1] != 0 && !(range[1] >= 1e-6 && range[1] <= 1)));
}

double most_far(const dp_spec *spec) {
    const char *name = dp_mapping_get(spec->mapping)->name;
    const double own = strcmp(name, "three-webgpu") == 0 ? 1 / spec->znear : spec->log_c;
    const double by = dp_mapping_get(spec->mapping)->curve != DP_CURVE_LOG ? 0 : own;
    return spec->ortho ? 1e18 : fmax(1e18, fmin(1e28, 1e30 / fmax(spec->znear, by) * (1 - 1e-9)));
}

void rng_planes(rng *r, double *znear, double *zfar) {
    const double size = rng_below(r, 2) ? rng_log(r, 1e-2, 1e3) : rng_log(r, 1e-12, 1e12);
    const uint64_t kind = rng_below(r, 8);
    *znear = kind < 2 ? 0.0 : rng_below(r, 2) ? -size : -ceil(size);
    const double other = -*znear > 0.0 ? -*znear : size;
    if (kind == 2)
        *zfar = 0.0;
    else if (kind == 3)
        *zfar = fmin(*znear * (1.0 - rng_log(r, 1.1e-6, 0.9)), -1e-12);
    else if (kind == 4)
        *zfar = other;
    else
        *zfar = fmin(fmax(other * rng_log(r, 1e-6, rng_below(r, 2) ? 10.0 : 1e12), 1e-12), 1e18);
    if (!(*zfar - *znear >= 1.1e-6 * other))
        *zfar = *znear < 0.0 ? 0.0 : other;
}

double rng_depth(rng *r, double znear, double zfar) {
    const double extent = zfar - znear;
    double z = znear + extent * rng_unit(r);
    switch (rng_below(r, 8)) {
    case 0:
        z = znear + extent * rng_log(r, 1e-17, 1.0);
        break;
    case 1:
        z = zfar - extent * rng_log(r, 1e-17, 1.0);
        break;
    case 2:
        z = sign_of(r) * extent * rng_log(r, 1e-40, 1.0);
        break;
    case 3:
        z = rng_below(r, 8) ? sign_of(r) * rng_log(r, 1e-320, extent) : 0.0;
        break;
    default:
        break;
    }
    return fmin(fmax(z, znear), zfar);
}

/* ---- effort ---- */

enum { TIMES = 4 }; /* as many cases as usual at most: make check-full ends in an hour or two */

static int is_set(const char *name) {
    const char *text = getenv(name);
    return text && *text && strcmp(text, "0") != 0;
}

effort test_effort(void) {
    if (is_set("DEPTHPREC_QUICK"))
        return EFFORT_QUICK;
    return is_set("DEPTHPREC_FULL") ? EFFORT_FULL : EFFORT_CHECK;
}

uint64_t test_cases(uint64_t quick, uint64_t check, uint64_t full) {
    const char *text = getenv("DEPTHPREC_FULL");
    const uint64_t times = text != NULL && atoi(text) > 1 ? (uint64_t)atoi(text) : TIMES;
    const uint64_t cases[] = {quick, check, full < times * check ? full : times * check};
    return cases[test_effort()];
}

/* ---- tallies ---- */

void tally_fail(tally *t, const char *format, ...) {
    if (t->failures++ == 0) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(t->first, sizeof t->first, format, arguments);
        va_end(arguments);
    }
    if (is_set("DEPTHPREC_TRACE") && t->failures <= 20) {
        va_list arguments;
        va_start(arguments, format);
        printf("# ");
        vprintf(format, arguments);
        printf("\n");
        va_end(arguments);
    }
}

void tally_end_at(const tally *t, const char *file, int line) {
    if (is_set("DEPTHPREC_TRACE"))
        printf("# %s: %llu cases, %llu failed, %llu skipped\n", t->name, (unsigned long long)t->cases,
               (unsigned long long)t->failures, (unsigned long long)t->skipped);
    if (t->cases == 0) {
        print_error("%s: no case was tested\n", t->name);
        _fail(file, line);
    }
    if (t->failures > 0) {
        print_error("%s: %llu of %llu failed, the first: %s\n", t->name, (unsigned long long)t->failures,
                    (unsigned long long)t->cases, t->first);
        _fail(file, line);
    }
}

/* ---- comparisons ---- */

void assert_codes_at(uint32_t got, uint32_t want, const char *what, const char *file, int line) {
    if (got == want)
        return;
    print_error("%s is code %u, should be %u (off by %lld codes)\n", what, got, want, (long long)got - (long long)want);
    _fail(file, line);
}

double ulp_distance(double a, double b) {
    if (a == b)
        return 0;
    if (!isfinite(a) || !isfinite(b))
        return INFINITY;
    double larger = fmax(fabs(a), fabs(b));
    double ulp = larger - nextafter(larger, 0);
    return fabs(a - b) / ulp;
}

static void compare(double got, double want, double distance, double bound, const char *unit, const char *what,
                    const char *file, int line) {
    if (distance <= bound)
        return;
    print_error("%s is %.17g (%a), should be %.17g (%a): off by %.3g %s, allowed %.3g\n", what, got, got, want, want,
                distance, unit, bound);
    _fail(file, line);
}

void assert_ulp_at(double got, double want, double ulps, const char *what, const char *file, int line) {
    compare(got, want, ulp_distance(got, want), ulps, "ulp", what, file, line);
}

void assert_relative_at(double got, double want, double bound, const char *what, const char *file, int line) {
    double distance = got == want ? 0 : fabs(got - want) / fabs(want);
    compare(got, want, distance, bound, "relative", what, file, line);
}

void assert_scene_at(double got, double want, double bound, const char *what, const char *file, int line) {
    compare(got, want, got == want ? 0 : fabs(got - want), bound, "scene units", what, file, line);
}

/* ---- vectors ---- */

static int split(char *text, vector_row *row) {
    char *comment = strchr(text, '#');
    if (comment)
        *comment = 0;
    row->count = 0;
    char *rest = NULL;
    for (char *field = strtok_r(text, " \t\r\n", &rest); field; field = strtok_r(NULL, " \t\r\n", &rest)) {
        if (row->count < VECTOR_FIELDS)
            row->field[row->count++] = field;
    }
    return row->count;
}

void vectors_read(const char *file, void (*visit)(const vector_row *row, void *context), void *context) {
    const char *folder = getenv("DEPTHPREC_VECTORS");
    char path[1024], text[1024];
    snprintf(path, sizeof path, "%s/%s", folder && *folder ? folder : "tests/vectors", file);
    FILE *in = fopen(path, "r");
    if (!in)
        fail_msg("cannot read %s: %s", path, strerror(errno));
    vector_row row = {.file = file};
    int rows = 0;
    while (fgets(text, sizeof text, in)) {
        row.line++;
        if (split(text, &row) == 0)
            continue;
        rows++;
        visit(&row, context);
    }
    fclose(in);
    if (rows == 0)
        fail_msg("%s has no rows", path);
}

const char *vector_text(const vector_row *row, int index) {
    if (index >= row->count)
        fail_msg("%s:%d: column %d is missing", row->file, row->line, index + 1);
    return row->field[index];
}

double vector_number(const vector_row *row, int index) {
    const char *text = vector_text(row, index);
    char *end = NULL;
    double value = strtod(text, &end);
    if (end == text || *end)
        fail_msg("%s:%d: column %d: '%s' is not a number", row->file, row->line, index + 1, text);
    return value;
}
