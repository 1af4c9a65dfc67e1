/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Codes: no mismatch with exact arithmetic, at rounding boundaries above all.
 *
 * A case is one dp_code() compared with the oracle's code. Of the cases at least half are doubles at or next to a
 * rounding boundary: the boundary's depth is computed exactly, cut to a double, and that double, the two below and
 * the two above are taken. Cameras with exact ties come on top.
 */
#include "oracle.h"
#include "support.h"

typedef struct pair {
    const char *name;
    dp_mapping mapping;
    int ortho, infinite;
    int either_sign; /* near <= 0 */
    int moved;       /* a viewport has a depth range of its own */
} pair;

static const pair pairs[] = {
    {"d3d", DP_MAPPING_D3D, 0, 0, 0, 0},
    {"gl", DP_MAPPING_GL, 0, 0, 0, 0},
    {"reversed", DP_MAPPING_REVERSED, 0, 0, 0, 0},
    {"gl-reversed", DP_MAPPING_GL_REVERSED, 0, 0, 0, 0},
    {"linear", DP_MAPPING_LINEAR, 0, 0, 0, 0},
    {"ortho d3d", DP_MAPPING_D3D, 1, 0, 0, 0},
    {"ortho reversed", DP_MAPPING_REVERSED, 1, 0, 0, 0},
    {"ortho d3d, near <= 0", DP_MAPPING_D3D, 1, 0, 1, 0},
    {"ortho reversed, near <= 0", DP_MAPPING_REVERSED, 1, 0, 1, 0},
    {"infinite d3d", DP_MAPPING_D3D, 0, 1, 0, 0},
    {"infinite reversed", DP_MAPPING_REVERSED, 0, 1, 0, 0},
    {"moved d3d", DP_MAPPING_D3D, 0, 0, 0, 1},
    {"moved reversed", DP_MAPPING_REVERSED, 0, 0, 0, 1},
    {"moved ortho gl", DP_MAPPING_GL, 1, 0, 0, 1},
    {"moved ortho reversed, near <= 0", DP_MAPPING_REVERSED, 1, 0, 1, 1},
    {"moved infinite d3d", DP_MAPPING_D3D, 0, 1, 0, 1},
    {"moved infinite reversed", DP_MAPPING_REVERSED, 0, 1, 0, 1},
    {"log", DP_MAPPING_LOG, 0, 0, 0, 0},
    {"three-webgpu", DP_MAPPING_THREE_WEBGPU, 0, 0, 0, 0},
    {"cesium", DP_MAPPING_CESIUM, 0, 0, 0, 0},
};
enum { PAIRS = sizeof pairs / sizeof *pairs };

static void formats(dp_format out[6]) {
    out[0] = oracle_float(5, 10, 15);
    out[1] = oracle_float(8, 23, 127);
    out[2] = oracle_unorm(16);
    out[3] = oracle_unorm(24);
    out[4] = oracle_float(3, 3, 5);
    out[5] = oracle_unorm(32);
}

typedef struct bench {
    dp_spec spec;
    dp_setup setup;
    oracle o;
    uint64_t aimed, cases;
    tally *t;
} bench;

static int open_bench(bench *b, tally *t) {
    b->t = t;
    b->aimed = b->cases = 0;
    if (dp_setup_init(&b->setup, &b->spec) != DP_OK)
        return 0;
    oracle_init(&b->o, &b->spec);
    return 1;
}

static void close_bench(bench *b) {
    oracle_clear(&b->o);
}

/* log is exempt within 2^-90 of a boundary; d is then not told from an exact tie. */
static int log_exempt(bench *b, double z, uint32_t got, uint32_t want) {
    if (!b->o.log || (got + 1 != want && want + 1 != got))
        return 0;
    mpq_t d, boundary;
    mpq_inits(d, boundary, NULL);
    oracle_window(&b->o, d, z);
    oracle_boundary(boundary, &b->spec.format, b->spec.rounding, got > want ? got : want);
    mpq_sub(boundary, boundary, d);
    mpq_div(boundary, boundary, d);
    int near = fabs(oracle_double(boundary)) < 0x1p-90;
    mpq_clears(d, boundary, NULL);
    return near;
}

static void check(bench *b, double z) {
    if (!(z >= b->spec.znear && z <= b->spec.zfar))
        return;
    uint32_t got = dp_code(&b->setup, z);
    uint32_t want = oracle_code(&b->o, z);
    b->cases++;
    if (got != want && log_exempt(b, z, got, want)) {
        b->t->skipped++;
        return;
    }
    char text[256];
    TALLY(b->t, got == want, "%s: code(%a) = %u, should be %u", oracle_describe(&b->spec, text, sizeof text), z, got,
          want);
}

static void check_around(bench *b, double z) {
    if (!(z > 0 || b->spec.znear <= 0) || isinf(z))
        return;
    uint64_t before = b->cases;
    check(b, z);
    double down = z, up = z;
    for (int i = 0; i < 2; i++) {
        check(b, down = nextafter(down, -INFINITY));
        check(b, up = nextafter(up, INFINITY));
    }
    b->aimed += b->cases - before;
}

/* The doubles around the boundary below a code. */
static void check_boundary(bench *b, uint32_t code) {
    mpq_t boundary;
    mpq_init(boundary);
    oracle_boundary(boundary, &b->spec.format, b->spec.rounding, code);
    check_around(b, oracle_eye_below(&b->o, mpq_numref(boundary), mpq_denref(boundary)));
    mpq_clear(boundary);
}

static double random_depth(rng *r, const dp_spec *spec) {
    double zfar = isinf(spec->zfar) ? spec->znear * 1e20 : spec->zfar;
    if (spec->znear <= 0)
        return rng_depth(r, spec->znear, spec->zfar);
    switch (rng_below(r, 6)) {
    case 0:
        return spec->znear * (1 + rng_log(r, 1e-17, 1));
    case 1:
        return zfar * (1 - rng_log(r, 1e-17, 1));
    case 2:
        return rng_uniform(r, spec->znear, zfar);
    default:
        return rng_log(r, spec->znear, zfar);
    }
}

static void random_camera(rng *r, const pair *p, dp_spec *spec) {
    spec->mapping = p->mapping;
    spec->ortho = p->ortho;
    switch (rng_below(r, 4)) {
    case 0: /* round numbers, as people type them */
        spec->znear = (double)(1 + rng_below(r, 100)) / 100;
        spec->zfar = (double)(10 + rng_below(r, 100000));
        break;
    case 1:
        spec->znear = rng_log(r, 0.001, 100);
        spec->zfar = spec->znear * rng_log(r, 1.5, 1e7);
        break;
    case 2: /* anything that the door lets through */
        spec->znear = rng_log(r, 1e-12, 1e12);
        spec->zfar = fmin(1e18, spec->znear * (1 + rng_log(r, 1.0001e-6, 1e30)));
        break;
    default: /* the extremes */
        spec->znear = rng_below(r, 2) ? 1e-12 : rng_below(r, 2) ? 1e12 : 1;
        spec->zfar = rng_below(r, 2) ? 1e18 : spec->znear * (1 + rng_log(r, 1.0001e-6, 1e-3));
    }
    if (p->infinite)
        spec->zfar = INFINITY;
    if (p->either_sign)
        rng_planes(r, &spec->znear, &spec->zfar);
    if (p->moved)
        rng_range(r, spec->depth_range);
    spec->log_c = rng_below(r, 2) ? 1 : rng_below(r, 2) ? rng_log(r, 1e-4, 1e3) : rng_log(r, 1e-12, 1e12);
    spec->rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
}

/* A code whose boundary lies in [near, far] most of the time. */
static uint32_t random_code(rng *r, bench *b) {
    uint32_t max = b->spec.format.code_max;
    switch (rng_below(r, 8)) {
    case 0:
        return 1 + (uint32_t)rng_below(r, max);
    case 1:
        return 1 + (uint32_t)rng_below(r, max < 32 ? max : 32);
    case 2:
        return max - (uint32_t)rng_below(r, max < 32 ? max : 32);
    default: {
        double z = fmin(b->spec.zfar, fmax(b->spec.znear, random_depth(r, &b->spec)));
        uint32_t code = oracle_code(&b->o, z);
        return code < max ? code + 1 : max;
    }
    }
}

static void random_cases(rng *r, const pair *p, const dp_format *format, uint64_t cases, tally *t) {
    enum { PER_CAMERA = 1000 };
    uint64_t aimed = 0, done = 0;
    while (done < cases) {
        bench b = {.spec = dp_spec_default()};
        b.spec.format = *format;
        random_camera(r, p, &b.spec);
        if (!open_bench(&b, t))
            fail_msg("%s: a camera was refused: near %a, far %a", p->name, b.spec.znear, b.spec.zfar);
        check_around(&b, b.spec.znear);
        check_around(&b, b.spec.zfar);
        b.aimed = 0;
        for (int tries = 0; b.cases < PER_CAMERA && tries < PER_CAMERA; tries++) {
            check_boundary(&b, random_code(r, &b));
            for (int k = 0; k < 4 && 5 * b.cases < 8 * b.aimed; k++)
                check(&b, random_depth(r, &b.spec));
        }
        if (b.o.infinite)
            check(&b, INFINITY);
        aimed += b.aimed;
        done += b.cases;
        close_bench(&b);
    }
    if (2 * aimed < done && !p->moved) /* a slice may have hardly a boundary */
        fail_msg("%s %s: only %llu of %llu cases lie at boundaries", format->name, p->name, (unsigned long long)aimed,
                 (unsigned long long)done);
}

/* ---- exact ties ---- */

static int set_exact(double *x, const mpz_t value) {
    *x = mpz_get_d(value);
    if (mpz_sizeinbase(value, 2) > 1000)
        return 0;
    mpz_t back;
    mpz_init_set_d(back, *x);
    int same = mpz_cmp(back, value) == 0;
    mpz_clear(back);
    return same;
}

/*
 * A camera and a depth with d(z) = p/r exactly: from 1/z = (1-d)/n + d/f with f = t n follow, up to a scale,
 * n = (r-p) t + p and z = t r; the reversed one has p and r-p swapped; t infinite, n = r-p and z = r.
 * @return whether all three are doubles
 */
static int tie_camera(rng *r, const pair *p, const mpq_t boundary, dp_spec *spec, double *z) {
    mpz_t a, t, n, at, f;
    mpz_inits(a, t, n, at, f, NULL);
    const __mpz_struct *num = mpq_numref(boundary), *den = mpq_denref(boundary);
    if (p->mapping == DP_MAPPING_LINEAR) { /* z = p, f = r */
        mpz_set(at, num);
        mpz_set(f, den);
        mpz_set_ui(n, 1);
    } else {
        int reversed = p->mapping == DP_MAPPING_REVERSED || p->mapping == DP_MAPPING_GL_REVERSED;
        mpz_set(a, num); /* d, or 1-d, times r */
        if (reversed)
            mpz_sub(a, den, a);
        if (p->ortho) { /* z = n + a, f = n + r */
            mpz_set_ui(n, 1 + rng_below(r, 1000));
            if (p->either_sign) /* the depth of the tie itself at 0 now and then */
                rng_below(r, 8) ? mpz_neg(n, rng_below(r, 2) ? n : a) : mpz_set_ui(n, 0);
            mpz_add(at, n, a);
            mpz_add(f, n, den);
        } else {
            mpz_sub(n, den, a);
            mpz_set(at, den);
            if (!p->infinite) {
                mpz_set_ui(t, 2 + rng_below(r, rng_below(r, 2) ? 10 : 100000));
                mpz_mul(n, n, t);
                mpz_add(n, n, a);
                mpz_mul(at, at, t);
                mpz_mul(f, n, t);
            }
        }
    }
    int exact = set_exact(&spec->znear, n) && set_exact(z, at) && set_exact(&spec->zfar, f);
    int exponent, scale = (int)rng_below(r, 20);
    frexp(*z != 0 ? *z : spec->zfar, &exponent);
    spec->znear = ldexp(spec->znear, scale - exponent);
    spec->zfar = p->infinite ? HUGE_VAL : ldexp(spec->zfar, scale - exponent);
    *z = ldexp(*z, scale - exponent);
    mpz_clears(a, t, n, at, f, NULL);
    return exact && (spec->znear >= 1e-12 || p->either_sign);
}

static void ties_of(rng *r, const pair *p, const dp_format *format, uint64_t cameras, tally *t) {
    mpq_t boundary, d;
    mpq_inits(boundary, d, NULL);
    uint64_t found = 0;
    for (uint64_t i = 0; i < 20 * cameras && found < cameras; i++) {
        double z = 0;
        bench b = {.spec = dp_spec_default()};
        b.spec.format = *format;
        b.spec.mapping = p->mapping;
        b.spec.ortho = p->ortho;
        b.spec.rounding = (dp_rounding)rng_below(r, DP_ROUNDING_COUNT);
        uint32_t max = format->code_max, code;
        if (format->kind == DP_FORMAT_FLOAT) /* the top binades: below them the numbers are too long for doubles */
            code =
                max - (uint32_t)rng_below(r, max < 20u << format->mantissa_bits ? max : 20u << format->mantissa_bits);
        else
            code = 1 + (uint32_t)rng_below(r, max);
        oracle_boundary(boundary, format, b.spec.rounding, code);
        if (!tie_camera(r, p, boundary, &b.spec, &z) || !open_bench(&b, t))
            continue;
        oracle_window(&b.o, d, z);
        if (!mpq_equal(d, boundary))
            fail_msg("the test is wrong: not a tie");
        check_around(&b, z);
        close_bench(&b);
        found++;
    }
    mpq_clears(boundary, d, NULL);
    if (found < cameras)
        fail_msg("%s %s: only %llu ties found", format->name, p->name, (unsigned long long)found);
}

/* ---- tests ---- */

static void random_codes(void **state) {
    const pair *p = *state;
    rng r = rng_make(p->name);
    tally t = {.name = p->name};
    dp_format format[6];
    formats(format);
    const int slow = p->mapping >= DP_MAPPING_LOG || p->either_sign;
    const int slowest = p->mapping > DP_MAPPING_LOG; /* two logarithms a depth */
    const uint64_t cases = test_cases(slow ? 600 : 4000, slowest ? 5000 : 50000, 1000000);
    for (int i = 0; i < 6; i++)
        random_cases(&r, p, &format[i], i < 4 ? cases : cases / 50, &t);
    tally_end(&t);
}

/* Boundaries of the 16-bit formats, all at full effort, of what browsers and globes write. */
TEST(small_boundaries) {
    tally t = {.name = "boundaries of 16 bits"};
    static const dp_mapping written[] = {DP_MAPPING_THREE_WEBGL, DP_MAPPING_THREE_WEBGPU, DP_MAPPING_CESIUM,
                                         DP_MAPPING_OSGEARTH};
    const dp_format format[] = {oracle_unorm(16), oracle_float(5, 10, 15)};
    const uint32_t step = (uint32_t)test_cases(61, 7, 1);
    for (int i = 0; i < 8; i++) {
        bench b = {.spec = dp_spec_default()};
        b.spec.mapping = written[i / 2];
        b.spec.format = format[i % 2];
        b.spec.znear = 0.1;
        b.spec.zfar = 1e9;
        assert_true(open_bench(&b, &t));
        for (uint32_t code = 1; code <= b.spec.format.code_max; code += step)
            check_boundary(&b, code);
        assert_true(b.cases >= b.spec.format.code_max / step / 2);
        close_bench(&b);
    }
    tally_end(&t);
}

TEST(exact_ties) {
    rng r = rng_make("ties");
    tally t = {.name = "exact ties"};
    dp_format format[6];
    formats(format);
    for (int k = 0; k < PAIRS; k++) {
        if (pairs[k].mapping >= DP_MAPPING_LOG || pairs[k].moved)
            continue;
        for (int i = 0; i < 6; i++)
            ties_of(&r, &pairs[k], &format[i], test_cases(20, 2000, 20000), &t);
    }
    tally_end(&t);
}

/* Outside [near, far] a depth is clamped. */
TEST(clamped) {
    tally t = {.name = "clamped"};
    for (int k = 0; k < PAIRS; k++) {
        dp_setup setup;
        dp_spec spec = dp_spec_default();
        spec.mapping = pairs[k].mapping;
        spec.ortho = pairs[k].ortho;
        spec.zfar = pairs[k].infinite ? INFINITY : 1000;
        spec.depth_range[0] = pairs[k].moved ? 0.75 : 0;
        spec.depth_range[1] = pairs[k].moved ? 0.3 : 1;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        static const double before[] = {0.0999, 0.01, 0.0, -1.0, -INFINITY, 0x1p-1074, -1e300};
        static const double behind[] = {1000.1, 1e6, 1e300, INFINITY};
        uint32_t first = dp_code(&setup, spec.znear), last = dp_code(&setup, spec.zfar);
        for (int i = 0; i < 7; i++)
            TALLY(&t, dp_code(&setup, before[i]) == first, "%s: code(%g) is not near's", pairs[k].name, before[i]);
        for (int i = 0; i < 4 && !pairs[k].infinite; i++)
            TALLY(&t, dp_code(&setup, behind[i]) == last, "%s: code(%g) is not far's", pairs[k].name, behind[i]);
    }
    tally_end(&t);
}

int main(void) {
    for (int k = 0; k < PAIRS; k++)
        list_test((struct CMUnitTest){pairs[k].name, random_codes, NULL, NULL, (void *)(uintptr_t)&pairs[k]});
    return run_listed(NULL, NULL);
}
