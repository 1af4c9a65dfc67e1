/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Code to take away: C that is printed, compiled by cc and loaded, has the bits of the library's own methods; and no
 * evaluation that a language allows is off by more than is said of it. The truth is the definition in long double. So
 * it is with GLSL that runs on a device.
 */
#include <dlfcn.h>

#include "allowed.h"
#include "code/code.h"
#include "method/bench.h"
#include "probe/compute.h"
#include "support.h"
#include "system/sandbox.h"

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

/* Every third camera has no far plane, and planes of every fourth are of few bits: then sums can be exact. */
static dp_setup camera_of(rng *r, uint64_t k) {
    dp_setup setup;
    double near = rng_log(r, 1e-12, 1e12), far = fmin(near * rng_log(r, 1.001, 1e9), 1e18);
    if (k % 4 == 3) {
        near = ldexp((double)(1 + rng_below(r, 8)), (int)rng_below(r, 8) - 4);
        far = near + ldexp((double)(1 + rng_below(r, 8)), (int)rng_below(r, 12) - 4);
    }
    far = k % 3 == 2 ? INFINITY : far;
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

/* Truncated: the whole number below d M, which a long double holds. */
static void compare_cut(tally *t, const dp_setup *setup, void *symbol, rng *r) {
    float d[DEPTHS];
    uint32_t (*printed)(float);
    *(void **)&printed = symbol;
    assert_non_null(symbol);
    windows(r, d);
    for (int i = 0; i < DEPTHS; i++)
        TALLY(t, (long double)printed(d[i]) == floorl((long double)d[i] * setup->spec.format.code_max),
              "truncated to %s, d %a: %u", setup->spec.format.name, (double)d[i], printed(d[i]));
}

static dp_setup stored(const char *format) {
    dp_setup setup;
    size_t which = 0;
    while (strcmp(encode_family.cases[which].format, format) != 0)
        which++;
    assert_int_equal(method_setup(&encode_family, which, 0.1, 1000, false, &setup), DP_OK);
    return setup;
}

/* C is written into a file and loaded. */
static void begin_c(output *out, const char *name, char path[512]) {
    snprintf(path, 512, "%s/%s-%d", folder(), name, (int)test_effort());
    char source[600];
    snprintf(source, sizeof source, "%s.c", path);
    assert_int_equal(output_open(out, source), EXIT_FINE);
    output_text(out, "#include <math.h>\n#include <stdint.h>\n#include <string.h>\n");
}

static void *load_c(output *out, const char *path) {
    const char *cc = getenv("CC");
    char command[2048];
    assert_int_equal(output_close(out), EXIT_FINE);
    snprintf(command, sizeof command,
             "%s -std=c99 -Wall -Wextra -Werror -ffp-contract=off -O1 -shared -fPIC -o %s.so %s.c -lm",
             cc != NULL ? cc : "cc", path, path);
    assert_int_equal(system(command), 0);
    snprintf(command, sizeof command, "%s%s.so", *path == '/' ? "" : "./", path);
    void *library = dlopen(command, RTLD_NOW);
    assert_non_null(library);
    return library;
}

TEST(c_has_the_bits_of_the_library) {
    char path[512], symbol[64];
    const code_language *c = code_language_find("c");
    rng r = rng_make("code");
    tally t = {.name = "bits"};
    dp_setup setups[CAMERAS_MAX];
    static output out;
    const int count = (int)test_cases(8, 24, CAMERAS_MAX);
    const dp_setup formats[] = {stored("unorm16"), stored("unorm24")};
    const method_row *const codes[] = {&encode_family.methods[2], &encode_family.methods[3], &encode_family.methods[4]};
    const method_row *const cut = &code_encoders(DP_ROUND_ZERO)->methods[1];
    begin_c(&out, "languages", path);
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
    for (int k = 0; k < 2; k++) {
        output_format(&out, "#define depth_code body_cut_%d\n", k);
        code_function(&out, c, cut, &formats[k], false);
        output_format(&out, "uint32_t cut_%d(float d) { return depth_code(d); }\n#undef depth_code\n", k);
    }
    void *library = load_c(&out, path);
    for (int k = 0; k < 2; k++) {
        snprintf(symbol, sizeof symbol, "cut_%d", k);
        compare_cut(&t, &formats[k], dlsym(library, symbol), &r);
    }
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

/* ---- Channels ---------------------------------------------------------------------------------------------------- */

static double degrees_between(const float a[3], const float b[3]) {
    double cross = 0, dot = 0;
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double side = (double)a[i] * (double)b[j] - (double)a[j] * (double)b[i];
        cross += side * side;
        dot += (double)a[k] * (double)b[k];
    }
    return atan2(sqrt(cross), dot) * (180 / M_PI);
}

static int channels_of(const packing *p, int channel[4]) {
    int count = 0;
    for (uint32_t k = 0; k < p->channels; k++)
        if (p->weight[k] > 0)
            channel[count++] = (int)k;
    return count;
}

/* Both functions of a packing, or of normals, from array to array. */
static void print_packed(output *out, int id, const packing *p, const pack_row *row) {
    static const char *const of[] = {"", "at[0]", "at[0], at[1]", "at[0], at[1], at[2]", "at[0], at[1], at[2], at[3]"};
    int channel[4];
    const char *name = p != NULL ? "depth" : "normal";
    const int count[] = {p != NULL ? 1 : 3, p != NULL ? channels_of(p, channel) : row->channels};
    output_format(out, "#define pack_%s there_of_%d\n#define unpack_%s back_of_%d\n", name, id, name, id);
    for (int i = 2; i <= 4; i++)
        output_format(out, "#undef vector%d\n#define vector%d vector%d_%d\n", i, i, i, id);
    if (p != NULL)
        code_packing(out, code_language_find("c"), p);
    else
        code_normal(out, code_language_find("c"), row);
    for (int back = 0; back < 2; back++)
        output_format(out,
                      "void %s_%d(const float *at, float *to) { __typeof__(%spack_%s(%s)) v = %spack_%s(%s); "
                      "memcpy(to, &v, sizeof v); }\n",
                      back ? "back" : "there", id, back ? "un" : "", name, of[count[back]], back ? "un" : "", name,
                      of[count[back]]);
    output_format(out, "#undef pack_%s\n#undef unpack_%s\n", name, name);
}

typedef void packer(const float *at, float *to);
static packer *symbol_of(void *library, const char *way, int id) {
    char symbol[64];
    packer *found;
    snprintf(symbol, sizeof symbol, "%s_%d", way, id);
    *(void **)&found = dlsym(library, symbol);
    assert_non_null(found);
    return found;
}

/* A texel is a number of steps. Any may be read, each channel one unit in the last place off. */
static void check_packing(tally *t, const packing *p, packer *there, packer *back, rng *r) {
    const double half = code_pack_bound(p, &bound_nearest), more = code_unpack_bound(p, &bound_nearest);
    int channel[4];
    const int count = channels_of(p, channel);
    double most = 0;
    float d[DEPTHS], at[4], again;
    windows(r, d);
    for (int i = 0; i < DEPTHS; i++) {
        long double made = 0, read = 0;
        there(&d[i], at);
        for (int k = 0; k < count; k++) {
            const float code = rintf(255 * at[k]), other = i % 4 == 0 ? 255 : (float)rng_below(r, 256);
            TALLY(t, code >= 0 && code <= 255 && fabsf(at[k] - code / 255) < 1e-6f, "%s, d %a: %a", p->name,
                  (double)d[i], (double)at[k]);
            made += (long double)p->weight[channel[k]] * code;
            read += (long double)p->weight[channel[k]] * other;
            at[k] = nextafterf(other / 255, i % 2 ? 2 : -1);
        }
        back(at, &again);
        const long double is = fminl(read / p->steps, 1), off = fabsl(made - d[i] * (long double)p->steps);
        TALLY(t, off <= half, "%s, d %a: off by %Lg steps", p->name, (double)d[i], off);
        TALLY(t, fabsl(again - is) <= is * more, "%s, %Lg: %a", p->name, read, (double)again);
        most = fmax(most, (double)off);
    }
    TALLY(t, most > 0.49, "%s: up to %g of a step", p->name, most);
}

static void direction(rng *r, const pack_row *row, float n[3]) {
    double in[3], length = 0;
    for (int k = 0; k < 3; k++) {
        in[k] = rng_uniform(r, -1, 1);
        length += in[k] * in[k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = (float)(in[k] / sqrt(length));
    n[2] = row->sphere ? n[2] : fabsf(n[2]);
}

static void check_normals(tally *t, const pack_row *row, packer *there, packer *back, rng *r) {
    const bool either = row->layout == PACK_OCT || row->layout == PACK_XYZ;
    const int whole = (1 << row->bits) - 1, top = either ? whole / 2 : whole;
    double most = 0;
    for (int i = 0; i < 40 * DEPTHS; i++) {
        double exact[3];
        float n[3], at[4], to[3];
        uint32_t codes[4];
        direction(r, row, n);
        there(n, at);
        for (int k = 0; k < row->channels; k++) {
            const float code = rintf(at[k] * (float)top);
            codes[k] = (uint32_t)(int)code & (uint32_t)whole;
            at[k] = nextafterf(code / (float)top, i % 2 ? 2 : -2);
        }
        back(at, to);
        row->decode(row, codes, exact);
        const float held[] = {(float)exact[0], (float)exact[1], (float)exact[2]};
        const double off = degrees_between(n, to);
        TALLY(t, off <= code_normal_bound(row, &bound_nearest) && degrees_between(to, held) < 1e-4,
              "%s, %a %a %a: off by %g", row->name, (double)n[0], (double)n[1], (double)n[2], off);
        most = fmax(most, off);
    }
    TALLY(t, most > 0.7 * row->normal.max, "%s: up to %g degrees", row->name, most);
}

TEST(c_packs_what_the_rows_say) {
    enum { NORMALS = 100 };
    rng r = rng_make("packed");
    tally t = {.name = "packed"};
    static output out;
    char path[512];
    void *library = NULL;
    begin_c(&out, "packed", path);
    for (int check = 0; check < 2; check++) {
        library = check ? load_c(&out, path) : NULL;
        for (int i = 0; packing_get((size_t)i) != NULL; i++)
            if (packing_get((size_t)i)->steps > 0 && check)
                check_packing(&t, packing_get((size_t)i), symbol_of(library, "there", i), symbol_of(library, "back", i),
                              &r);
            else if (packing_get((size_t)i)->steps > 0)
                print_packed(&out, i, packing_get((size_t)i), NULL);
        for (int i = 0; pack_get((size_t)i) != NULL; i++)
            if (pack_get((size_t)i)->kind == PACK_NORMAL && check)
                check_normals(&t, pack_get((size_t)i), symbol_of(library, "there", NORMALS + i),
                              symbol_of(library, "back", NORMALS + i), &r);
            else if (pack_get((size_t)i)->kind == PACK_NORMAL)
                print_packed(&out, NORMALS + i, NULL, pack_get((size_t)i));
    }
    dlclose(library);
    tally_end(&t);
}

/* ---- The bound --------------------------------------------------------------------------------------------------- */

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

/* A camera, the depth at which an evaluation of it was off by most, and by how much of the bound. */
typedef struct hardest {
    dp_setup setup;
    float d;
    double used;
} hardest;

static void perturb(tally *t, rng *r, size_t p, size_t m, const hardest *near, hardest *out) {
    const dp_setup *s = &out->setup;
    const double n = s->spec.znear, f = s->spec.zfar;
    const bool reversed = s->reversed != 0;
    const method_row *row = method(formulas[m].name);
    if (isinf(f) && (row->domain & METHOD_INFINITE) == 0)
        return;
    const double bound = code_bound(code_language_find(promises[p].name), row, s);
    float d[DEPTHS];
    windows(r, d);
    for (int i = 0; i < DEPTHS; i++) {
        if (near->used > 0 && i % 2 != 0)
            d[i] = fminf(near->d * (1 + (i % 4 == 1 ? -1 : 1) * (float)rng_log(r, 0x1p-25, 0x1p-8)), 1);
        const long double at = d[i], q = reversed ? at : 1 - at,
                          z = isinf(f) ? n / q : n * (long double)f / (n + (f - n) * q);
        const device v = device_of(r, p, i / 4);
        if (q <= (isinf(f) ? 0x1p-125L : -1) || z > 0x1p125L || isinf(bound))
            continue;
        const double error = (double)(fabsl(formulas[m].of(&v, n, f, reversed, d[i]) - z) / z);
        TALLY(t, error <= bound, "%s in %s, near %.17g, far %.17g, d %a: %g, bound %g", row->name, promises[p].name, n,
              f, (double)d[i], error, bound);
        if (bound < 0.1 && error > out->used * bound) {
            out->used = error / bound;
            out->d = d[i];
        }
    }
}

/* The same camera, or one a little beside it. */
static dp_setup beside(rng *r, const dp_setup *s) {
    dp_setup out = *s;
    if (rng_below(r, 2))
        return out;
    double plane[] = {s->spec.znear, s->spec.zfar};
    plane[rng_below(r, 2)] *= 1 + (rng_below(r, 2) ? 1 : -1) * rng_log(r, 0x1p-26, 0x1p-4);
    if (plane[1] < 1.0001 * plane[0] ||
        method_setup(&linearize_family, s->reversed ? 1 : 0, plane[0], plane[1], false, &out) != DP_OK)
        return *s;
    return out;
}

/* Climbed to: first any cameras, then those beside the hardest one. */
TEST(no_language_is_off_by_more_than_its_bound) {
    rng r = rng_make("languages");
    tally t = {.name = "bounds"};
    for (size_t p = 0; p < PROMISES; p++)
        for (size_t m = 0; m < sizeof formulas / sizeof formulas[0]; m++) {
            hardest most = {.used = 0};
            const uint64_t cases = test_cases(30, 120, 2000);
            for (uint64_t k = 0; k < cases; k++) {
                const bool any = k < cases / 3 || most.used == 0;
                hardest one = {.setup = any ? camera_of(&r, k) : beside(&r, &most.setup)};
                perturb(&t, &r, p, m, any ? &one : &most, &one);
                most = one.used > most.used ? one : most;
            }
            printf("# %s in %s: up to %.3f of the bound, near %.9g, far %.9g\n", formulas[m].name, promises[p].name,
                   most.used, most.setup.spec.znear, most.setup.spec.zfar);
            TALLY(&t, most.used > 0.5, "%s in %s: slack, %g", formulas[m].name, promises[p].name, most.used);
        }
    tally_end(&t);
}

/* Where a product may be fused into a sum that would be exact else, what is said is more than any evaluation that was
 * climbed to: smaller numbers than these, in units of 2^-24, need a proof of their own. */
TEST(no_claim_falls_without_a_proof) {
    static const struct {
        const char *language, *method;
        double near, far, least;
    } rows[] = {{"msl", "unity", 1, 8, 11.99},
                {"wgsl", "unity", 1, 8, 14.99},
                {"c", "unity", 1, 8, 5.49},
                {"c", "textbook", 0.25, 64, 129.49},
                {"msl", "complement", 1, 8, 6.74}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        dp_setup setup;
        assert_int_equal(method_setup(&linearize_family, 0, rows[i].near, rows[i].far, false, &setup), DP_OK);
        const double bound = code_bound(code_language_find(rows[i].language), method(rows[i].method), &setup) * 0x1p24;
        if (!(bound >= rows[i].least))
            fail_msg("%s in %s, near %g, far %g: %g", rows[i].method, rows[i].language, rows[i].near, rows[i].far,
                     bound);
    }
}

/* ---- Codes ------------------------------------------------------------------------------------------------------- */

/* d M rounded as the language lets it, then to a whole number in either way. */
static void perturb_code(tally *t, rng *r, const dp_setup *s, size_t p, int way, double *most) {
    static const char *const names[] = {"floor", "rint", "truncate"};
    const method_row *row = way == 2 ? &code_encoders(DP_ROUND_ZERO)->methods[0] : &encode_family.methods[2 + way];
    const double bound = code_bound(code_language_find(promises[p].name), row, s), m = s->spec.format.code_max;
    float d[DEPTHS];
    assert_string_equal(row->name, names[way]);
    windows(r, d);
    for (int i = 0; i < DEPTHS && !isnan(bound); i++) {
        const device v = {r, promises[p].sums, 0, i % 2 == 0, promises[p].flushes, i / 2 % 3 - 1};
        const float product = rounded(&v, (long double)d[i] * m, v.sums);
        const float sum =
            v.fuses ? rounded(&v, (long double)d[i] * m + 0.5L, v.sums) : rounded(&v, product + 0.5L, v.sums);
        const long double code = way == 0   ? floorl(sum)
                                 : way == 1 ? rintl(product)
                                            : floorl(product),
                          off = fabsl(code - (long double)d[i] * m);
        TALLY(t, off <= bound && code <= m, "%s in %s of %s, d %a: %Lg, bound %g", row->name, promises[p].name,
              s->spec.format.name, (double)d[i], off, bound);
        *most = fmax(*most, (double)off);
    }
}

TEST(no_code_is_off_by_more_than_its_bound) {
    rng r = rng_make("codes");
    tally t = {.name = "codes"};
    const dp_setup setups[] = {stored("unorm16"), stored("unorm24")};
    for (size_t p = 0; p < PROMISES; p++)
        for (int k = 0; k < 6; k++) {
            double most = 0;
            for (int again = 0; again < 100; again++)
                perturb_code(&t, &r, &setups[k / 3], p, k % 3, &most);
            printf("# way %d in %s: up to %.6g\n", k % 3, promises[p].name, most);
        }
    tally_end(&t);
}

/* A pixel's place: the slope of its centre, as the definition has it, times the depth. */
static void perturb_place(tally *t, rng *r, size_t p, double *most) {
    const double n = rng_log(r, 1e-6, 1e6), f = n * rng_log(r, 2, 1e6), half = rng_log(r, 1e-3, 100);
    dp_setup s;
    assert_int_equal(method_setup(&linearize_family, 0, n, f, false, &s), DP_OK);
    const double bound = code_place_bound(code_language_find(promises[p].name), method("complement"), &s);
    /* two products, each so many half units off, and a constant that is rounded to nearest */
    const double each = 1 + 2 * promises[p].sums * 0x1p-24;
    const double depths = code_bound(code_language_find(promises[p].name), method("complement"), &s);
    const double want = (1 + depths) * (1 + 0x1p-24) * each * each - 1;
    TALLY(t, fabs(bound / want - 1) < 1e-9, "%s: bound %.17g, not %.17g", promises[p].name, bound, want);
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
    for (size_t p = 0; p < PROMISES; p++) {
        double most = 0;
        for (uint64_t k = 0; k < test_cases(20, 100, 3000); k++)
            perturb_place(&t, &r, p, &most);
        printf("# places in %s: up to %.3f of the bound\n", promises[p].name, most);
        TALLY(&t, most > 0.5, "%s: slack, %g", promises[p].name, most);
    }
    tally_end(&t);
}

/* ---- Channels, as a language lets it ----------------------------------------------------------------------------- */

/* Whole numbers of 24 bits are exact; `parts` of one may stand in a channel more. */
static void perturb_packing(tally *t, rng *r, const packing *p, size_t which, double *most) {
    const bound_arithmetic *how = &code_language_find(promises[which].name)->how;
    const long double parts = p->steps > 0x1p24 ? p->steps / 0x1p24 : 1, whole = p->steps / parts;
    const double bound = code_unpack_bound(p, how);
    float d[DEPTHS];
    windows(r, d);
    for (int i = 0; i < DEPTHS; i++) {
        const device v = device_of(r, which, i);
        const float product = rounded(&v, d[i] * whole, v.sums);
        const float first = parts > 1 ? fminf(floorf(product), 0x1p24f - 1) : rintf(product);
        const float last = parts > 1 ? fminf(rintf(rounded(&v, (product - first) * parts, v.sums)), 255) : 0;
        const long double off = fabsl(first * parts + last - d[i] * (long double)p->steps);
        const float k = floorf((float)(rng_log(r, 1, (double)whole))), l = (float)rng_below(r, 256);
        const float rest = parts == 256 ? l / 256 : divide(&v, l, 255);
        const float sum = rounded(&v, (long double)k + rest, v.sums);
        const float again = parts > 1 ? sum * 0x1p-24f : divide(&v, k, (float)p->steps);
        const long double is = parts > 1 ? (k * parts + l) / p->steps : k / whole;
        TALLY(t, off <= code_pack_bound(p, how), "%s in %s, d %a: %Lg steps", p->name, promises[which].name,
              (double)d[i], off);
        TALLY(t, fabsl(again - is) <= bound * is, "%s in %s, %Lg: %a", p->name, promises[which].name, is,
              (double)again);
        *most = fmax(*most, (double)(fabsl(again - is) / is) / bound);
    }
}

#define R(x) rounded(v, (x), v->sums)
#define Q(x) rounded(v, (x), v->quotients)

/* There and back without channels between, but as they are read. */
static void oct_again(const device *v, const float n[3], float to[3]) {
    const float s = R((long double)R((long double)fabsf(n[0]) + fabsf(n[1])) + fabsf(n[2]));
    const float a = Q((long double)n[0] / s), b = Q((long double)n[1] / s), t = fmaxf(-Q((long double)n[2] / s), 0);
    const float x = nextafterf(R((long double)a + copysignf(t, a)), (float)v->bias),
                y = nextafterf(R((long double)b + copysignf(t, b)), (float)-v->bias);
    const float c = R((long double)R(1.0L - fabsf(x)) - fabsf(y)), fold = fmaxf(-c, 0);
    const float of[] = {R((long double)x - copysignf(fold, x)), R((long double)y - copysignf(fold, y)), c};
    for (int k = 0; k < 3; k++)
        to[k] = Q(of[k] / 1.7L);
}

static void stereo_again(const device *v, const float n[3], float to[3]) {
    const float c = (float)(0.5 / 1.7777), w = R(n[2] + 1.0L);
    float at[2];
    for (int k = 0; k < 2; k++) {
        const float channel = R((long double)R((long double)Q((long double)n[k] / w) * c) + 0.5L);
        at[k] = R((long double)R((long double)nextafterf(channel, (float)v->bias) * 3.5554f) - 1.7777f);
    }
    const float sum =
        R((long double)R((long double)R((long double)at[0] * at[0]) + R((long double)at[1] * at[1])) + 1.0L);
    const float g = Q(2.0L / sum);
    to[0] = R((long double)g * at[0]);
    to[1] = R((long double)g * at[1]);
    to[2] = R(g - 1.0L);
}

static void perturb_normal(tally *t, rng *r, bool stereo, size_t which, double *most) {
    pack_row row = *pack_stereo();
    row.layout = stereo ? PACK_STEREO : PACK_OCT;
    row.sphere = !stereo;
    row.normal.max = 0; /* what is left are the roundings */
    const double bound = code_normal_bound(&row, &code_language_find(promises[which].name)->how);
    for (int i = 0; i < DEPTHS; i++) {
        const device v = device_of(r, which, i);
        float n[3], to[3];
        direction(r, &row, n);
        (stereo ? stereo_again : oct_again)(&v, n, to);
        TALLY(t, degrees_between(n, to) <= bound, "normal in %s: %g degrees, %g", promises[which].name,
              degrees_between(n, to), bound);
        *most = fmax(*most, degrees_between(n, to) / bound);
    }
}

TEST(no_channel_is_off_by_more_than_its_bound) {
    rng r = rng_make("channels");
    tally t = {.name = "channels"};
    for (size_t which = 0; which < PROMISES; which++) {
        double most[2] = {0, 0};
        for (size_t i = 0; packing_get(i) != NULL; i++) {
            double slack = 0;
            for (uint64_t k = 0; k < test_cases(20, 100, 1000) && packing_get(i)->steps > 0; k++)
                perturb_packing(&t, &r, packing_get(i), which, &slack);
            TALLY(&t, packing_get(i)->steps == 0 || slack > 0.49, "%s in %s: slack, %g", packing_get(i)->name,
                  promises[which].name, slack);
        }
        for (uint64_t k = 0; k < test_cases(80, 400, 4000); k++)
            perturb_normal(&t, &r, k % 2 != 0, which, &most[k % 2]);
        printf("# normals in %s: up to %.3f, %.3f of the bound\n", promises[which].name, most[0], most[1]);
        TALLY(&t, most[0] > 0.15 && most[1] > 0.15, "%s: slack", promises[which].name);
    }
    tally_end(&t);
}

/* ---- Linear and logarithmic depth -------------------------------------------------------------------------------- */

/* As the mappings are defined: 0 log, 1 cesium, 2 three-webgpu, 3 orthographic, 4 that reversed. */
typedef struct curve {
    int kind;
    double n, f, c;
    long double span;
} curve;

static float eye_depth(const device *v, const curve *s, size_t p, float d) {
    if (s->kind >= 3)
        return multiply_add(v, (float)(s->kind > 3 ? s->f : s->n), (float)(s->kind > 3 ? s->n - s->f : s->f - s->n), d);
    const float x = R((long double)d * (float)s->span);
    const long double exact = exp2l(x);
    const float e = within(v, exact, exact * (powers[p].exp2 + powers[p].each * (double)fabsf(x)));
    const float base = (float)(s->kind == 2 ? s->n : 1 / s->c),
                z = R((long double)base * (s->kind == 2 ? e : R(e - 1.0L)));
    return s->kind == 1 ? R((long double)(float)s->n + z) : z;
}

static float window_depth(const device *v, const curve *s, size_t p, float z) {
    const float way = s->kind == 1 ? R((long double)z - (float)s->n) : z;
    const float y = s->kind == 2 ? R((long double)z * (float)(1 / s->n)) : multiply_add(v, 1, (float)s->c, way);
    const long double exact = log2l(y);
    const bool inside = y >= 0.5f && y <= 2 && powers[p].inside > 0;
    const float log2 = within(v, exact, inside ? powers[p].inside : fabsl(exact) * powers[p].log2);
    return R((long double)log2 * (float)(1 / s->span));
}

/* The planes and C of a curve, the window depth and the eye depth where it was off by most, and by how much of both
 * bounds. */
typedef struct hardest_curve {
    double plane[2], c;
    float d[2];
    double used[2];
} hardest_curve;

/* Just above a power of two, and so near the middle of two numbers of binary32 that its rounding weighs as much as one
 * can: up where `way` is positive, else down. */
static double heavy(rng *r, int power, double way) {
    return ldexp(1 + (2 * (double)(0x2000 + rng_below(r, 512)) + 1) * 0x1p-24 + way, power);
}

static hardest_curve any_curve(rng *r, int kind) {
    hardest_curve out = {.plane = {rng_log(r, 1e-3, 1e2) * (kind >= 3 && rng_below(r, 2) == 0 ? -1 : 1)},
                         .c = rng_log(r, 1e-3, 1e3)};
    out.plane[1] = fabs(out.plane[0]) * rng_log(r, 10, 1e8);
    if (kind < 3 && rng_below(r, 2)) {
        const double way = rng_below(r, 2) ? 0x1p-36 : -0x1p-36, span = heavy(r, 3 + (int)rng_below(r, 2), way);
        out.c = 1 / heavy(r, (int)rng_below(r, 20) - 10, way);
        out.plane[0] = kind == 2 ? 1 / out.c : out.plane[0];
        out.plane[1] = (kind == 0 ? 0 : out.plane[0]) + (exp2(span) - (kind < 2)) / out.c;
    }
    return out;
}

static hardest_curve curve_beside(rng *r, const hardest_curve *of) {
    hardest_curve out = *of;
    double *const part[] = {&out.plane[0], &out.plane[1], &out.c, NULL};
    double *at = part[rng_below(r, 4)];
    if (at != NULL)
        *at *= 1 + (rng_below(r, 2) ? 1 : -1) * rng_log(r, 0x1p-26, 0x1p-8);
    return out;
}

static void perturb_curve(tally *t, rng *r, dp_mapping mapping, int kind, size_t p, hardest_curve *one) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    const hardest_curve from = *one;
    float d[DEPTHS];
    spec.mapping = mapping;
    spec.ortho = kind >= 3;
    spec.znear = one->plane[0];
    spec.zfar = one->plane[1];
    spec.log_c = one->c;
    if (dp_setup_init(&setup, &spec) != DP_OK)
        return;
    const bound_arithmetic *how = &code_language_find(promises[p].name)->how;
    const long double n = kind == 0 ? 0 : spec.znear, f = spec.zfar, c = kind == 2 ? 1 / n : spec.log_c;
    const curve s = {kind, spec.znear, spec.zfar, (double)c, kind < 3 ? log2l(c * (f - n) + 1) : 0};
    const double back = code_curve_back(&setup, how), there = kind < 3 ? code_curve_there(&setup, how) : 1;
    one->used[0] = one->used[1] = 0;
    if (kind < 3) { /* roundings of one sign, as they are counted in depthprec(7) */
        const double once = 2 * promises[p].sums * 0x1p-24, both = once + 0x1p-24, span = (double)s.span;
        const double power = (M_LN2 * both + powers[p].each) * span + powers[p].exp2, sums[] = {once, both + once, 0};
        const double count = power + both + sums[kind];
        TALLY(t, fabs(back / (count * (1 + count)) - 1) < 1e-9, "%s in %s: bound %.17g, not %.17g",
              dp_mapping_get(mapping)->name, promises[p].name, back, count * (1 + count));
    }
    windows(r, d);
    for (int i = from.used[0] > 0 ? DEPTHS * 7 / 8 : 0; i < DEPTHS; i++) {
        const device v = device_of(r, p, i / 8);
        if (i % 16 == 2)
            d[i] = 1;
        else if (i % 2 != 0 && from.used[0] > 0)
            d[i] = fminf(from.d[i / 2 % 2] * (1 + (i % 8 < 4 ? 1 : -1) * (float)rng_log(r, 0x1p-25, 0x1p-6)), 1);
        const long double z = kind == 3   ? n + (f - n) * d[i]
                              : kind == 4 ? f - (f - n) * d[i]
                                          : n + (exp2l(d[i] * s.span) - 1) / c;
        const long double share = kind >= 3 ? 1 : kind == 2 ? z : z + 1 / c;
        const float at = fmaxf((float)z, nextafterf((float)spec.znear, INFINITY));
        const double off[] = {
            (double)(fabsl(eye_depth(&v, &s, p, d[i]) - z) / share) / back,
            kind < 3 ? (double)fabsl(window_depth(&v, &s, p, at) - log2l(c * (at - n) + 1) / s.span) / there : 0};
        TALLY(t, off[0] <= 1 && off[1] <= 1, "%s in %s, near %.17g, far %.17g, C %.17g, d %a: %g of %g, %g of %g",
              dp_mapping_get(mapping)->name, promises[p].name, spec.znear, spec.zfar, spec.log_c, (double)d[i], off[0],
              back, off[1], there);
        for (int k = 0; k < 2; k++)
            if (off[k] > one->used[k]) {
                one->used[k] = off[k];
                one->d[k] = d[i];
            }
    }
}

/* Climbed to, by turns back and there: first any cameras, then those beside the hardest one. */
TEST(no_curve_is_off_by_more_than_its_bound) {
    static const dp_mapping mappings[] = {DP_MAPPING_LOG, DP_MAPPING_CESIUM, DP_MAPPING_THREE_WEBGPU, DP_MAPPING_D3D,
                                          DP_MAPPING_REVERSED};
    rng r = rng_make("curves");
    tally t = {.name = "curves"};
    for (size_t p = 0; p < POWERS; p++)
        for (int m = 0; m < 5; m++) {
            hardest_curve most[2] = {0};
            const uint64_t cases = test_cases(30, 100, 2000);
            for (uint64_t k = 0; k < cases; k++) {
                const int way = m >= 3 ? 0 : (int)(k % 2);
                const bool any = k < cases / 2 || most[way].used[way] == 0;
                hardest_curve one = any ? any_curve(&r, m) : curve_beside(&r, &most[way]);
                perturb_curve(&t, &r, mappings[m], m, p, &one);
                for (int w = 0; w < 2; w++)
                    most[w] = one.used[w] > most[w].used[w] ? one : most[w];
            }
            printf("# %s in %s: up to %.3f, %.3f of the bound\n", dp_mapping_get(mappings[m])->name, promises[p].name,
                   most[0].used[0], most[1].used[1]);
            TALLY(&t, most[0].used[0] > 0.5 && (m >= 3 || most[1].used[1] > 0.4), "%s in %s: slack",
                  dp_mapping_get(mappings[m])->name, promises[p].name);
        }
    tally_end(&t);
}

/* ---- On a device ------------------------------------------------------------------------------------------------- */

static output functions; /* what is printed, and never written */
static float depths[DEPTHS], got[DEPTHS];

static float given_depth(const void *of, uint64_t i) {
    return ((const float *)of)[i];
}

/* The value of an expression of d for each depth, behind `functions`. */
static void run_glsl(const char *expression) {
    static char shader[OUTPUT_BUFFER_SIZE + 1024];
    compute_run run = {.count = DEPTHS, .depth = given_depth, .of = depths};
    shot_machine machine = {0};
    char error[COMPUTE_ERROR_SIZE];
    unsigned line;
    bool endless;
    FILE *values = NULL;
    snprintf(shader, sizeof shader,
             "#version 450\nlayout(local_size_x = 64) in;\n"
             "layout(std430, set = 0, binding = 0) readonly buffer In { float given[]; };\n"
             "layout(std430, set = 0, binding = 1) writeonly buffer Out { float made[]; };\n%.*s\n"
             "void main() { float d = given[gl_GlobalInvocationID.x]; made[gl_GlobalInvocationID.x] = %s; }\n",
             (int)functions.used, functions.buffer, expression);
    if (!compute_compile(shader, false, &run, &line, error) ||
        !compute_values(NULL, &run, 0, &machine, &values, &endless, error)) {
        printf("# %s\n", error);
        assert_true(strstr(error, "Debian's package") != NULL || strstr(error, "device") != NULL);
        skip();
    }
    assert_int_equal(fread(got, sizeof *got, DEPTHS, values), DEPTHS);
    sandbox_close(values);
    free(run.code);
    functions.used = 0;
}

static void run_method(tally *t, const method_row *row, const dp_setup *s) {
    float own[DEPTHS];
    const double n = s->spec.znear, f = s->spec.zfar, bound = code_bound(code_language_find("glsl"), row, s);
    const method_inputs in = {.count = DEPTHS, .d = depths};
    const method_outputs out = {.eye = own};
    int equal = 0;
    code_function(&functions, code_language_find("glsl"), row, s, false);
    run_glsl("eye_depth(d)");
    row->run(&(method_call){row, s, NULL, &in, &out});
    for (int i = 0; i < DEPTHS; i++) {
        const long double q = s->reversed ? depths[i] : 1 - (long double)depths[i],
                          z = isinf(f) ? n / q : n * (long double)f / (n + (f - n) * q);
        const bool same = bits(got[i]) == bits(own[i]); /* of what has no quotient */
        equal += same;
        TALLY(t, z > 0x1p125L || (fabsl(got[i] - z) <= bound * z && (same || strcmp(row->name, "magic") != 0)),
              "%s, d %a: %a, own %a", row->name, (double)depths[i], (double)got[i], (double)own[i]);
    }
    printf("# %s of %s: %d of %d bits\n", row->name, dp_mapping_get(s->spec.mapping)->name, equal, DEPTHS);
}

static void run_codes(tally *t, const method_row *row, const dp_setup *s) {
    uint32_t own[DEPTHS];
    const method_inputs in = {.count = DEPTHS, .d = depths};
    const method_outputs out = {.code = own};
    code_function(&functions, code_language_find("glsl"), row, s, false);
    run_glsl("float(depth_code(d))");
    row->run(&(method_call){row, s, NULL, &in, &out});
    for (int i = 0; i < DEPTHS; i++)
        TALLY(t, got[i] == (float)own[i], "%s, d %a: %g", row->name, (double)depths[i], (double)got[i]);
}

static void run_packing(tally *t, const packing *p) {
    const bound_arithmetic *how = &code_language_find("glsl")->how;
    const double bound = code_pack_bound(p, how) / p->steps + code_unpack_bound(p, how);
    int channel[4];
    const int count = channels_of(p, channel);
    code_packing(&functions, code_language_find("glsl"), p);
    output_format(&functions, "float again(vec4 v) { return unpack_depth(v.r%s); }\n",
                  count == 4   ? ", v.g, v.b, v.a"
                  : count == 3 ? ", v.g, v.b"
                  : count == 2 ? ", v.g"
                               : "");
    run_glsl(count == 4   ? "again(pack_depth(d))"
             : count == 3 ? "again(vec4(pack_depth(d), 0))"
             : count == 2 ? "again(vec4(pack_depth(d), 0, 0))"
                          : "again(vec4(pack_depth(d)))");
    for (int i = 0; i < DEPTHS; i++)
        TALLY(t, fabs((double)got[i] - (double)depths[i]) <= bound, "%s, d %a: %a", p->name, (double)depths[i],
              (double)got[i]);
}

/* Some directions, in channels of 8 bits. */
static void run_normal(tally *t, const pack_row *row) {
    static const char *const members[] = {"again(d).x", "again(d).y", "again(d).z"};
    static float n[DEPTHS][3];
    for (int k = 0; k < 3; k++) {
        code_normal(&functions, code_language_find("glsl"), row);
        output_format(&functions, "vec3 again(float d) { vec2 v = pack_normal(d - 0.5, 0.25, d - 0.75); "
                                  "v = roundEven(v * 127.0) / 127.0; return unpack_normal(v.x, v.y); }\n");
        run_glsl(members[k]);
        for (int i = 0; i < DEPTHS; i++)
            n[i][k] = got[i];
    }
    for (int i = 0; i < DEPTHS; i++) {
        const double off = degrees_between(n[i], (const float[]){depths[i] - 0.5f, 0.25f, depths[i] - 0.75f});
        TALLY(t, off <= code_normal_bound(row, &code_language_find("glsl")->how), "%s, d %a: %g degrees", row->name,
              (double)depths[i], off);
    }
}

static void run_logarithm(tally *t, dp_mapping mapping) {
    dp_spec spec = dp_spec_default();
    dp_setup s;
    spec.mapping = mapping;
    assert_int_equal(dp_setup_init(&s, &spec), DP_OK);
    const bound_arithmetic *how = &code_language_find("glsl")->how;
    code_curve(&functions, code_language_find("glsl"), &s, false, false);
    code_curve(&functions, code_language_find("glsl"), &s, true, false);
    run_glsl("window_depth(eye_depth(d))");
    for (int i = 0; i < DEPTHS; i++) { /* z + 1 is off by a share: its logarithm by so many parts of that of far + 1 */
        const double bound = code_curve_there(&s, how) + code_curve_back(&s, how) / log(spec.zfar + 1) * 1.001;
        TALLY(t, fabs((double)got[i] - (double)depths[i]) <= bound, "%s, d %a: %a", dp_mapping_get(mapping)->name,
              (double)depths[i], (double)got[i]);
    }
}

TEST(a_device_has_what_is_said_of_glsl) {
    rng r = rng_make("device");
    tally t = {.name = "device"};
    const dp_setup formats[] = {stored("unorm16"), stored("unorm24")};
    functions = (output){.fd = -1};
    windows(&r, depths);
    for (uint64_t k = 1; k < 4; k++) {
        const dp_setup s = camera_of(&r, k);
        for (size_t i = 0; i < *linearize_family.method_count; i++)
            if (code_lacks(code_language_find("glsl"), &linearize_family.methods[i], &s) == NULL)
                run_method(&t, &linearize_family.methods[i], &s);
    }
    for (int k = 0; k < 4; k++)
        run_codes(&t, &encode_family.methods[2 + k % 2], &formats[k / 2]);
    for (size_t i = 0; packing_get(i) != NULL; i++)
        if (packing_get(i)->steps > 0)
            run_packing(&t, packing_get(i));
    for (size_t i = 0; pack_get(i) != NULL; i++)
        if (strcmp(pack_get(i)->name, "oct-8") == 0)
            run_normal(&t, pack_get(i));
    run_logarithm(&t, DP_MAPPING_LOG);
    run_logarithm(&t, DP_MAPPING_OSGEARTH);
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

/* The numbers that the comment names are those that the language promises. */
TEST(rules_are_what_is_promised) {
    for (size_t p = 0; p < PROMISES; p++) {
        char said[96], rules[CODE_RULES_SIZE];
        const promise *l = &promises[p];
        snprintf(said, sizeof said,
                 l->sums < 1         ? "every operation to nearest"
                 : l->quotients == 1 ? "every operation within 1 ulp"
                                     : "sums and products within 1 ulp, quotients within %g",
                 l->quotients);
        assert_string_equal(code_language_rules(code_language_get(p), rules), said);
    }
}
