/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Code to take away: C that is printed, compiled by cc and loaded, has the bits of the library's own methods; and no
 * evaluation that a language allows is off by more than is said of it. The truth is the definition in long double.
 */
#include <dlfcn.h>

#include "code/code.h"
#include "method/bench.h"
#include "support.h"

enum { CAMERAS_MAX = 64, METHODS = 16, DEPTHS = 512 };

static const char *folder(void) {
    const char *b = getenv("B");
    return b != NULL ? b : "build";
}

static const method_row *method(const char *called) {
    size_t i = 0;
    while (strcmp(linearize_family.methods[i].name, called) != 0)
        i++;
    return &linearize_family.methods[i];
}

static const code_language *language(const char *called) {
    size_t i = 0;
    while (strcmp(code_language_get(i)->name, called) != 0)
        i++;
    return code_language_get(i);
}

/* Every third camera has no far plane. */
static dp_setup camera_of(rng *r, uint64_t k) {
    dp_setup setup;
    const double near = rng_log(r, 1e-12, 1e12),
                 far = k % 3 == 2 ? INFINITY : fmin(near * rng_log(r, 1.001, 1e9), 1e18);
    assert_int_equal(method_setup(&linearize_family, k % 2, near, far, false, &setup), DP_OK);
    return setup;
}

static void windows(rng *r, float d[DEPTHS]) {
    d[0] = 0;
    d[1] = 1;
    for (int i = 2; i < DEPTHS; i++)
        d[i] = (float)(i % 3 == 0 ? rng_unit(r) : i % 3 == 1 ? rng_log(r, 1e-38, 1) : 1 - rng_log(r, 0x1p-24, 1));
}

/* ---- The same bits ----------------------------------------------------------------------------------------------- */

static uint32_t bits(float x) {
    uint32_t b;
    memcpy(&b, &x, sizeof b);
    return b;
}

static void compare(tally *t, const method_row *row, const dp_setup *setup, float (*printed)(float), rng *r) {
    float d[DEPTHS], own[DEPTHS];
    const method_inputs in = {.count = DEPTHS, .d = d};
    const method_outputs out = {.eye = own};
    windows(r, d);
    row->run(&(method_call){row, setup, NULL, &in, &out});
    for (int i = 0; i < DEPTHS; i++) {
        const float got = printed(d[i]);
        TALLY(t, bits(got) == bits(own[i]) || (isnan(got) && isnan(own[i])),
              "%s, near %.17g, far %.17g, d %a: %a, own %a", row->name, setup->spec.znear, setup->spec.zfar,
              (double)d[i], (double)got, (double)own[i]);
    }
}

static void compare_codes(tally *t, const method_row *row, const dp_setup *setup, uint32_t (*printed)(float), rng *r) {
    float d[DEPTHS];
    uint32_t own[DEPTHS];
    const method_inputs in = {.count = DEPTHS, .d = d};
    const method_outputs out = {.code = own};
    windows(r, d);
    row->run(&(method_call){row, setup, NULL, &in, &out});
    for (int i = 0; i < DEPTHS; i++)
        TALLY(t, printed(d[i]) == own[i], "%s of %s, d %a: %u, own %u", row->name, setup->spec.format.name,
              (double)d[i], printed(d[i]), own[i]);
}

static dp_setup stored(const char *format) {
    dp_setup setup;
    size_t which = 0;
    while (strcmp(encode_family.cases[which].format, format) != 0)
        which++;
    assert_int_equal(method_setup(&encode_family, which, 0.1, 1000, false, &setup), DP_OK);
    return setup;
}

TEST(c_has_the_bits_of_the_library) {
    char source[512], object[512], command[2048], symbol[32];
    const code_language *c = language("c");
    const char *cc = getenv("CC");
    rng r = rng_make("code");
    tally t = {.name = "bits"};
    dp_setup setups[CAMERAS_MAX];
    static output out;
    const int count = (int)test_cases(8, 24, CAMERAS_MAX);
    const dp_setup formats[] = {stored("unorm16"), stored("unorm24")};
    const method_row *const codes[] = {&encode_family.methods[2], &encode_family.methods[3], &encode_family.methods[4]};
    snprintf(source, sizeof source, "%s/languages-%d.c", folder(), (int)test_effort());
    snprintf(object, sizeof object, "%s/languages-%d.so", folder(), (int)test_effort());
    assert_int_equal(output_open(&out, source), EXIT_FINE);
    output_text(&out, "#include <math.h>\n#include <stdint.h>\n");
    for (int k = 0; k < count; k++) {
        setups[k] = camera_of(&r, (uint64_t)k);
        for (size_t i = 0; i < *linearize_family.method_count; i++)
            if (code_lacks(c, &linearize_family.methods[i], &setups[k]) == NULL) {
                output_format(&out, "#define eye_depth body_%d_%zu\n", k, i);
                code_function(&out, c, &linearize_family.methods[i], &setups[k], false);
                output_format(&out, "float code_%d_%zu(float d) { return eye_depth(d); }\n#undef eye_depth\n", k, i);
            }
    }
    for (int k = 0; k < 6; k++)
        if (code_lacks(c, codes[k % 3], &formats[k / 3]) == NULL) {
            output_format(&out, "#define depth_code body_%d\n", k);
            code_function(&out, c, codes[k % 3], &formats[k / 3], false);
            output_format(&out, "uint32_t code_%d(float d) { return depth_code(d); }\n#undef depth_code\n", k);
        }
    assert_int_equal(output_close(&out), EXIT_FINE);
    snprintf(command, sizeof command,
             "%s -std=c99 -Wall -Wextra -Werror -ffp-contract=off -O1 -shared -fPIC -o %s %s -lm",
             cc != NULL ? cc : "cc", object, source);
    assert_int_equal(system(command), 0);
    snprintf(command, sizeof command, "%s%s", *object == '/' ? "" : "./", object);
    void *library = dlopen(command, RTLD_NOW);
    assert_non_null(library);
    for (int k = 0; k < count; k++)
        for (size_t i = 0; i < *linearize_family.method_count; i++) {
            float (*printed)(float);
            snprintf(symbol, sizeof symbol, "code_%d_%zu", k, i);
            *(void **)&printed = dlsym(library, symbol);
            if (printed != NULL)
                compare(&t, &linearize_family.methods[i], &setups[k], printed, &r);
        }
    for (int k = 0; k < 6; k++) {
        uint32_t (*printed)(float);
        snprintf(symbol, sizeof symbol, "code_%d", k);
        *(void **)&printed = dlsym(library, symbol);
        assert_non_null(printed);
        compare_codes(&t, codes[k % 3], &formats[k / 3], printed, &r);
    }
    assert_true(t.cases > (uint64_t)count * 6 * DEPTHS);
    dlclose(library);
    tally_end(&t);
}

/* ---- The bound --------------------------------------------------------------------------------------------------- */

/* What a language may make of an exact number: a binary32 number within so many units in the last place. */
typedef struct device {
    rng *r;
    double sums, quotients; /* ulp; 0.5: to nearest */
    bool fuses, flushes;
    int bias; /* -1, 1: always down, or up, as far as that goes; 0: any */
} device;

static float flushed(const device *v, float x) {
    return v->flushes && fabsf(x) < 0x1p-126f && v->bias <= 0 ? 0.0f : x;
}

static float rounded(const device *v, long double x, double ulps) {
    const float nearest = (float)x; /* of long double: rounded once */
    if (x == 0 || ulps < 1 || (ulps == 1 && (long double)nearest == x))
        return flushed(v, nearest);
    int exponent;
    frexpl(x, &exponent);
    const long double ulp = ldexpl(1, exponent - 24 > -149 ? exponent - 24 : -149), most = ulps * ulp;
    const double share = v->bias != 0 ? v->bias : rng_uniform(v->r, -1, 1);
    float y = (float)(x + share * most);
    while (fabsl((long double)y - x) > most || (ulps <= 1 && fabsl((long double)y - x) >= ulp))
        y = nextafterf(y, (float)x);
    return flushed(v, y);
}

static float multiply_add(const device *v, float base, float slope, float q) {
    const long double product = (long double)slope * q;
    return v->fuses ? rounded(v, base + product, v->sums)
                    : rounded(v, (long double)base + rounded(v, product, v->sums), v->sums);
}

static float divide(const device *v, float a, float b) {
    return rounded(v, (long double)a / b, v->quotients);
}

/* The formulas once more, as people write them down. */
static float complement(const device *v, double n, double f, bool reversed, float d) {
    const float q = reversed ? d : rounded(v, 1.0L - d, v->sums);
    return divide(v, (float)(n * f), multiply_add(v, (float)n, (float)(f - n), q));
}

static float textbook(const device *v, double n, double f, bool reversed, float d) {
    const float base = (float)(reversed ? n : f), slope = (float)(reversed ? f - n : n - f);
    return divide(v, (float)(n * f), multiply_add(v, base, slope, d));
}

static float unity(const device *v, double n, double f, bool reversed, float d) {
    const double across = isinf(f) ? 1 / n : (f - n) / n / f;
    return divide(v, 1, multiply_add(v, (float)(1 / (reversed ? f : n)), (float)(reversed ? across : -across), d));
}

static float complement_unity(const device *v, double n, double f, bool reversed, float d) {
    const double across = isinf(f) ? 1 / n : (f - n) / n / f;
    return divide(v, 1, multiply_add(v, (float)(1 / f), (float)across, reversed ? d : rounded(v, 1.0L - d, v->sums)));
}

static float linear_01(const device *v, double n, double f, bool reversed, float d) {
    const float base = (float)(reversed ? 1 : f / n), excess = (float)((f - n) / n);
    const float share = divide(v, 1, multiply_add(v, base, reversed ? excess : -excess, d));
    return rounded(v, (long double)(float)f * share, v->sums);
}

static float linear_01_near(const device *v, double n, double f, bool reversed, float d) {
    const float base = (float)(reversed ? 1 : f / n), excess = (float)((f - n) / n);
    const float x = multiply_add(v, base, reversed ? excess : -excess, d);
    return multiply_add(v, (float)n, (float)(f - n), divide(v, reversed ? rounded(v, 1.0L - d, v->sums) : d, x));
}

static const struct {
    const char *name;
    float (*of)(const device *v, double n, double f, bool reversed, float d);
} formulas[] = {{"complement", complement}, {"textbook", textbook},
                {"unity", unity},           {"complement-unity", complement_unity},
                {"linear-01", linear_01},   {"linear-01-near", linear_01_near}};

/* Written down apart from the rows of the languages. */
static const struct {
    const char *name;
    double sums, quotients;
    bool fuses, flushes;
} promises[] = {{"glsl", 1, 2.5, false, true}, {"hlsl", 1, 1, false, true},  {"wgsl", 1, 2.5, true, true},
                {"msl", 1, 1, true, true},     {"c", 0.5, 0.5, true, false}, {"numpy", 0.5, 0.5, false, false}};

/* Which fuses and rounds in turn as the language lets it. */
static device device_of(rng *r, size_t p, int i) {
    return (device){r,
                    promises[p].sums,
                    promises[p].quotients,
                    promises[p].fuses && i % 2 == 0,
                    promises[p].flushes,
                    i / 2 % 3 - 1};
}

static void perturb(tally *t, rng *r, const dp_setup *s, size_t p, size_t m, double *most) {
    const double n = s->spec.znear, f = s->spec.zfar;
    const bool reversed = s->reversed != 0;
    const method_row *row = method(formulas[m].name);
    if (isinf(f) && (row->domain & METHOD_INFINITE) == 0)
        return;
    const double bound = code_bound(language(promises[p].name), row, s);
    float d[DEPTHS];
    windows(r, d);
    for (int i = 0; i < DEPTHS; i++) {
        const long double at = d[i], q = reversed ? at : 1 - at,
                          z = isinf(f) ? n / q : n * (long double)f / (n + (f - n) * q);
        const device v = device_of(r, p, i);
        if (q <= (isinf(f) ? 0x1p-125L : -1) || z > 0x1p125L || isinf(bound))
            continue;
        const double error = (double)(fabsl(formulas[m].of(&v, n, f, reversed, d[i]) - z) / z);
        TALLY(t, error <= bound, "%s in %s, near %.17g, far %.17g, d %a: %g, bound %g", row->name, promises[p].name, n,
              f, (double)d[i], error, bound);
        if (bound < 0.1)
            *most = fmax(*most, error / bound);
    }
}

TEST(no_language_is_off_by_more_than_its_bound) {
    rng r = rng_make("languages");
    tally t = {.name = "bounds"};
    const size_t count = sizeof promises / sizeof promises[0];
    for (size_t p = 0; p < count; p++)
        for (size_t m = 0; m < sizeof formulas / sizeof formulas[0]; m++) {
            double most = 0;
            for (uint64_t k = 0; k < test_cases(12, 120, 2000); k++) {
                const dp_setup setup = camera_of(&r, k);
                perturb(&t, &r, &setup, p, m, &most);
            }
            printf("# %s in %s: up to %.3f of the bound\n", formulas[m].name, promises[p].name, most);
            TALLY(&t, most > 0.5, "%s in %s: slack, %g", formulas[m].name, promises[p].name, most);
        }
    tally_end(&t);
}

/* ---- Codes ------------------------------------------------------------------------------------------------------- */

/* d M rounded as the language lets it, then to a whole number in either way. */
static void perturb_code(tally *t, rng *r, const dp_setup *s, size_t p, bool even, double *most) {
    const method_row *row = even ? &encode_family.methods[3] : &encode_family.methods[2];
    const double bound = code_bound(language(promises[p].name), row, s), m = s->spec.format.code_max;
    float d[DEPTHS];
    assert_string_equal(row->name, even ? "rint" : "floor");
    windows(r, d);
    for (int i = 0; i < DEPTHS && !isnan(bound); i++) {
        const device v = {r, promises[p].sums, 0, i % 2 == 0, promises[p].flushes, i / 2 % 3 - 1};
        const float product = rounded(&v, (long double)d[i] * m, v.sums);
        const float sum =
            v.fuses ? rounded(&v, (long double)d[i] * m + 0.5L, v.sums) : rounded(&v, product + 0.5L, v.sums);
        const long double code = even ? rintl(product) : floorl(sum), off = fabsl(code - (long double)d[i] * m);
        TALLY(t, off <= bound && code <= m, "%s in %s of %s, d %a: %Lg, bound %g", row->name, promises[p].name,
              s->spec.format.name, (double)d[i], off, bound);
        *most = fmax(*most, (double)off);
    }
}

TEST(no_code_is_off_by_more_than_its_bound) {
    rng r = rng_make("codes");
    tally t = {.name = "codes"};
    const dp_setup setups[] = {stored("unorm16"), stored("unorm24")};
    for (size_t p = 0; p < sizeof promises / sizeof promises[0]; p++)
        for (int k = 0; k < 4; k++) {
            double most = 0;
            for (int again = 0; again < 100; again++)
                perturb_code(&t, &r, &setups[k / 2], p, k % 2 != 0, &most);
            printf("# %s in %s: up to %.6g\n", k % 2 ? "rint" : "floor", promises[p].name, most);
        }
    tally_end(&t);
}

/* A pixel's place: the slope of its centre, as the definition has it, times the depth. */
static void perturb_place(tally *t, rng *r, size_t p, double *most) {
    const double n = rng_log(r, 1e-6, 1e6), f = n * rng_log(r, 2, 1e6), half = rng_log(r, 1e-3, 100);
    dp_setup s;
    assert_int_equal(method_setup(&linearize_family, 0, n, f, false, &s), DP_OK);
    const double bound = code_place_bound(language(promises[p].name), method("complement"), &s);
    for (int i = 0; i < DEPTHS; i++) {
        const uint32_t width = 1 + (uint32_t)rng_below(r, 8192);
        const float centre = (float)rng_below(r, width) + 0.5f, d = (float)rng_unit(r), w = (float)width;
        const device v = device_of(r, p, i);
        const float z = complement(&v, n, f, false, d), slope = 2 * centre - w;
        const float across = rounded(&v, (long double)slope * (float)(half / width), v.sums);
        const float x = rounded(&v, (long double)across * z, v.sums);
        const long double depth = n * (long double)f / (n + (f - n) * (1 - (long double)d));
        const long double place = (2 * (long double)centre - width) / width * half * depth;
        const double error = place == 0 ? (double)fabsf(x) : (double)(fabsl(x - place) / fabsl(place));
        TALLY(t, error <= bound, "%s, near %.17g, far %.17g, d %a: %g, bound %g", promises[p].name, n, f, (double)d,
              error, bound);
        *most = fmax(*most, error / bound);
    }
}

TEST(no_place_is_off_by_more_than_its_bound) {
    rng r = rng_make("places");
    tally t = {.name = "places"};
    for (size_t p = 0; p < sizeof promises / sizeof promises[0]; p++) {
        double most = 0;
        for (uint64_t k = 0; k < test_cases(20, 100, 3000); k++)
            perturb_place(&t, &r, p, &most);
        printf("# places in %s: up to %.3f of the bound\n", promises[p].name, most);
        TALLY(&t, most > 0.5, "%s: slack, %g", promises[p].name, most);
    }
    tally_end(&t);
}

/* The least bound is what is printed without a name, and no method that a language lacks. */
TEST(the_best_has_the_least_bound) {
    rng r = rng_make("best");
    tally t = {.name = "best"};
    for (uint64_t k = 0; k < 60; k++) {
        const dp_setup setup = camera_of(&r, k);
        for (size_t p = 0; code_language_get(p) != NULL; p++) {
            const code_language *l = code_language_get(p);
            assert_non_null(code_best(l, &linearize_family, &setup));
            const double least = code_bound(l, code_best(l, &linearize_family, &setup), &setup);
            TALLY(&t, code_lacks(l, code_best(l, &linearize_family, &setup), &setup) == NULL, "%s", l->name);
            for (size_t i = 0; i < *linearize_family.method_count; i++) {
                const method_row *row = &linearize_family.methods[i];
                TALLY(&t, code_lacks(l, row, &setup) != NULL || code_bound(l, row, &setup) >= least, "%s: %s", l->name,
                      row->name);
            }
        }
    }
    tally_end(&t);
}

/* Digits read back, and one fewer does not. */
TEST(digits_are_the_fewest_that_read_back) {
    rng r = rng_make("digits");
    tally t = {.name = "digits"};
    char text[CODE_TEXT_SIZE], fewer[64];
    for (int k = 0; k < 20000; k++) {
        const bool wide = k % 2 == 0;
        const double x = (k % 4 < 2 ? 1 : -1) * rng_log(&r, 1e-37, 1e37), is = wide ? x : (double)(float)x;
        code_number(x, wide, text);
        int digits = 0;
        for (const char *at = text + strspn(text, "-0."); *at != '\0' && *at != 'e'; at++)
            digits += *at >= '0' && *at <= '9';
        snprintf(fewer, sizeof fewer, "%.*e", digits > 2 ? digits - 2 : 0, is);
        TALLY(&t, (wide ? strtod(text, NULL) : (double)strtof(text, NULL)) == is && strpbrk(text, ".e") != NULL, "%s",
              text);
        TALLY(&t,
              digits < 3 || (wide ? strtod(fewer, NULL) : (double)strtof(fewer, NULL)) != is ||
                  strstr(text, ".0") != NULL,
              "%s: %s suffices", text, fewer);
    }
    tally_end(&t);
}
