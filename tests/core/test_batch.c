/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arrays against the scalar functions: each path, each task, each type, to the bit where the header says so. */
#include <float.h>

#include "depthprec/depthprec.h"
#include "parallel.h"
#include "setups.h"
#include "support.h"

enum { CHUNK = 4096, GUARD = 64 };

typedef struct camera {
    double znear, zfar;
    int ortho;
    dp_mapping mapping;
} camera;

static const camera cameras[] = {
    {0.1, 1000.0, 0, DP_MAPPING_D3D},
    {0.1, 1000.0, 0, DP_MAPPING_REVERSED},
    {0.1, HUGE_VAL, 0, DP_MAPPING_D3D},
    {0.1, HUGE_VAL, 0, DP_MAPPING_REVERSED},
    {1e-12, 1e18, 0, DP_MAPPING_GL},
    {1e12, 1e18, 0, DP_MAPPING_GL_REVERSED},
    {1.0, 1.0000011, 0, DP_MAPPING_D3D},
    {0.3, 0.31, 0, DP_MAPPING_REVERSED},
    {0.5, 8.0, 0, DP_MAPPING_D3D},
    {0.25, 4.0, 0, DP_MAPPING_REVERSED},
    {1e12, HUGE_VAL, 0, DP_MAPPING_REVERSED},
    {0.1, 1000.0, 0, DP_MAPPING_LINEAR},
    {0.1, 1000.0, 1, DP_MAPPING_D3D},
    {1.0, 4.0, 1, DP_MAPPING_REVERSED},
    {0.0, 500.0, 1, DP_MAPPING_D3D},
    {-100.0, 500.0, 1, DP_MAPPING_D3D},
    {-100.0, 500.0, 1, DP_MAPPING_REVERSED},
    {-1e12, 0.0, 1, DP_MAPPING_REVERSED},
    {-4.0, -1.0, 1, DP_MAPPING_GL},
    {0.1, 1000.0, 0, DP_MAPPING_LOG},
};
static const char *const formats[] = {"fp16",    "fp32",    "unorm16", "unorm24",    "unorm1",        "unorm2",
                                      "unorm10", "unorm23", "unorm32", "float3.3b5", "float8.23b255", "float5.11"};
enum { CAMERAS = sizeof cameras / sizeof cameras[0], FORMATS = sizeof formats / sizeof formats[0] };

static dp_setup make(const camera *c, const char *name, dp_rounding rounding, dp_model model) {
    return SETUP(name, .znear = c->znear, .zfar = c->zfar, .ortho = c->ortho, .mapping = c->mapping,
                 .rounding = rounding, .model = model);
}

static const char *label(const dp_batch *b) {
    static char text[160];
    const dp_spec *s = &b->setup.spec;
    static const char *const tasks[] = {"code", "eye", "width",  "encode",     "decode",
                                        "lo",   "hi",  "window", "separation", "interval"};
    snprintf(text, sizeof text, "%s %s%s %s %.17g..%.17g %s, %zu to %zu bytes, %s", tasks[b->task],
             dp_mapping_get(s->mapping)->name, s->ortho ? " ortho" : "", s->format.name, s->znear, s->zfar,
             dp_rounding_name(s->rounding), b->in_size, b->out_size, dp_path_name(b->path));
    return text;
}

static int reads_codes(const dp_batch *b) {
    return b->task == DP_TASK_EYE || (b->task >= DP_TASK_WIDTH && b->task <= DP_TASK_HI && b->task != DP_TASK_ENCODE);
}

static int writes_codes(const dp_batch *b) {
    return b->task == DP_TASK_CODE || b->task == DP_TASK_ENCODE;
}

static float real32(const void *at, size_t i) {
    return ((const float *)at)[i];
}

static double real_at(const dp_batch *b, const void *at, size_t i) {
    return b->real == DP_REAL_FLOAT ? (double)real32(at, i) : ((const double *)at)[i];
}

static uint32_t code_at(const dp_batch *b, const void *at, size_t i) {
    return b->word == DP_WORD_16 ? ((const uint16_t *)at)[i] : ((const uint32_t *)at)[i];
}

static int same_real(double a, double b) {
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

/* An eye depth that becomes a number is so by dp_sample_at(). A plane of floats may be the float beside it. */
static int number_as_promised(const dp_batch *b, double z, double got) {
    const dp_spec *s = &b->setup.spec;
    const int narrow = b->real == DP_REAL_FLOAT;
    dp_sample at;
    if (narrow && z < s->znear && (double)nextafterf((float)z, FLT_MAX) > s->znear)
        z = s->znear;
    if (narrow && z > s->zfar && (double)nextafterf((float)z, -FLT_MAX) < s->zfar)
        z = s->zfar;
    const dp_status status = dp_sample_at(&b->setup, z, &at);
    if (status != DP_OK)
        return status == DP_ERROR_BINARY32 ? isinf(got) : isnan(got);
    const double want = b->task == DP_TASK_WINDOW     ? at.depth
                        : b->task == DP_TASK_INTERVAL ? at.interval
                                                      : at.separation;
    if (!narrow || b->task != DP_TASK_SEPARATION)
        return same_real(got, narrow ? (double)(float)want : want);
    return got >= want && (isinf(got) || (double)nextafterf((float)got, 0) < want || got == want);
}

/* A cell's end: never inside of the cell, and the next float is. */
static int end_as_promised(const dp_batch *b, uint32_t code, double got) {
    const dp_cell cell = dp_cell_of(&b->setup, code);
    const double want = b->task == DP_TASK_LO ? cell.lo : cell.hi;
    const float inward = nextafterf((float)got, b->task == DP_TASK_LO ? INFINITY : -INFINITY);
    if (b->real == DP_REAL_DOUBLE || isnan(want) || got == want)
        return same_real(got, want);
    return b->task == DP_TASK_LO ? got < want && (double)inward > want : got > want && (double)inward < want;
}

/* The header's promise for one element. */
static int as_promised(const dp_batch *b, const void *in, const void *out, size_t i) {
    const dp_spec *s = &b->setup.spec;
    if (b->task == DP_TASK_CODE)
        return code_at(b, out, i) == dp_code(&b->setup, real_at(b, in, i));
    if (b->task == DP_TASK_ENCODE)
        return code_at(b, out, i) == dp_format_encode(&s->format, s->rounding, real_at(b, in, i));
    if (!reads_codes(b))
        return number_as_promised(b, real_at(b, in, i), real_at(b, out, i));
    const uint32_t given = code_at(b, in, i);
    const uint32_t code = given < s->format.code_max ? given : s->format.code_max;
    const double got = real_at(b, out, i);
    const int narrow = b->real == DP_REAL_FLOAT;
    if (b->task == DP_TASK_LO || b->task == DP_TASK_HI)
        return end_as_promised(b, code, got);
    if (b->task == DP_TASK_DECODE) {
        const double want = dp_format_value(&s->format, code);
        return same_real(got, narrow ? (double)(float)want : want);
    }
    if (b->task == DP_TASK_EYE) {
        const double want = dp_stored(&b->setup, code);
        return narrow ? got == (double)(float)want || fabs(got - want) <= DP_BATCH_EYE_ERROR * want
                      : same_real(got, want);
    }
    const double want = dp_cell_of(&b->setup, code).width;
    const double bound = narrow ? 0x1.00001p-24 : DP_BATCH_WIDTH_ERROR;
    return same_real(got, narrow ? (double)(float)want : want) || fabs(got - want) <= bound * want ||
           (narrow && fabs(want) < 1e-37);
}

static char *buffer(int which) {
    static double space[4][CHUNK + 2 * GUARD];
    return (char *)space[which];
}

/* One array on every path: the first path as promised, the others as the first. */
static void check_array(tally *t, const dp_setup *setup, dp_task task, dp_real real, dp_word word, const void *in,
                        size_t count) {
    dp_batch b;
    for (int path = 0; path < DP_PATH_COUNT; path++) {
        char *const out = buffer(path == 0 ? 1 : 2);
        if (!dp_path_available((dp_path)path))
            continue;
        assert_int_equal(dp_batch_init(&b, setup, task, real, word, (dp_path)path), DP_OK);
        memset(out, 0xA5, CHUNK * sizeof(double));
        dp_batch_run(&b, in, out, count);
        if (path > 0) {
            size_t bad = 0;
            while (bad < count && memcmp(out + bad * b.out_size, buffer(1) + bad * b.out_size, b.out_size) == 0)
                bad++;
            t->cases += count - 1;
            TALLY(t, bad == count, "%s: element %zu differs from the baseline", label(&b), bad);
            continue;
        }
        for (size_t i = 0; i < count; i++)
            TALLY(t, as_promised(&b, in, out, i), "%s: element %zu, %.17g / %u gives %.17g / %u", label(&b), i,
                  reads_codes(&b) ? 0.0 : real_at(&b, in, i), reads_codes(&b) ? code_at(&b, in, i) : 0,
                  writes_codes(&b) ? 0.0 : real_at(&b, out, i), writes_codes(&b) ? code_at(&b, out, i) : 0);
    }
}

/* ---- Codes to depths --------------------------------------------------------------------------------------------- */

static void codes_of(tally *t, const dp_setup *setup, uint32_t first, uint32_t step, size_t count) {
    uint32_t *wide = (uint32_t *)(void *)buffer(0);
    uint16_t *narrow = (uint16_t *)(void *)buffer(3);
    for (size_t i = 0; i < count; i++) {
        wide[i] = first + (uint32_t)i * step;
        narrow[i] = (uint16_t)wide[i];
    }
    static const dp_task tasks[] = {DP_TASK_EYE, DP_TASK_WIDTH, DP_TASK_DECODE, DP_TASK_LO, DP_TASK_HI};
    for (int k = 0; k < 5; k++)
        for (int real = 0; real < DP_REAL_COUNT; real++) {
            check_array(t, setup, tasks[k], (dp_real)real, DP_WORD_32, wide, count);
            if (setup->spec.format.bits <= 16)
                check_array(t, setup, tasks[k], (dp_real)real, DP_WORD_16, narrow, count);
        }
}

/* The codes around the planes' and around the least and the greatest, some beyond it. */
static void codes_at_ends(tally *t, const dp_setup *s) {
    const uint32_t max = s->spec.format.code_max;
    codes_of(t, s, max < 40 ? 0 : max - 40, 1, 45);
    codes_of(t, s, 0, 1, 45);
    codes_of(t, s, s->code_near < 20 ? 0 : s->code_near - 20, 1, 40);
    codes_of(t, s, s->code_far < 20 ? 0 : s->code_far - 20, 1, 40);
}

/* All codes of the 16-bit formats, and all of unorm24 when asked for; else a walk through them. */
static void walk_codes(tally *t, const dp_setup *s, int all) {
    const uint32_t max = s->spec.format.code_max;
    const uint32_t chunks = (uint32_t)test_cases(2, 4, 64);
    const int full = test_effort() == EFFORT_FULL;
    if (max < 65536 ? all || full : max < 1U << 24 && all && full) {
        for (uint32_t first = 0; first <= max; first += CHUNK)
            codes_of(t, s, first, 1, max - first < CHUNK ? max - first + 1 : CHUNK);
        return;
    }
    const uint32_t step = max / (CHUNK * chunks) + 1;
    for (uint32_t k = 0; k < chunks; k++)
        codes_of(t, s, k * CHUNK * step, step, CHUNK);
}

TEST(test_codes) {
    for (int f = 0; f < FORMATS; f++) {
        tally t = {.name = formats[f]};
        for (int c = 0; c < CAMERAS; c++)
            for (int rounding = 0; rounding < DP_ROUNDING_COUNT; rounding++) {
                const dp_setup s = make(&cameras[c], formats[f], (dp_rounding)rounding, DP_MODEL_EXACT);
                codes_at_ends(&t, &s);
                if (rounding == c % DP_ROUNDING_COUNT)
                    walk_codes(&t, &s, c < 2);
            }
        tally_end(&t);
    }
}

/* The value of every code in binary32: the two-term form must round as the quotient does. */
TEST(test_values) {
    static const char *const names[] = {"unorm16", "unorm17", "unorm18", "unorm19", "unorm20",
                                        "unorm21", "unorm22", "unorm23", "unorm24"};
    static float value[CHUNK];
    tally t = {.name = "values"};
    for (size_t f = 0; f < sizeof names / sizeof names[0]; f++) {
        const dp_setup s = make(&cameras[0], names[f], DP_ROUND_NEAREST, DP_MODEL_EXACT);
        uint32_t *code = (uint32_t *)(void *)buffer(0);
        const uint32_t stride = test_effort() == EFFORT_QUICK && f > 0 ? 61 : 1;
        dp_batch b;
        assert_int_equal(dp_batch_init(&b, &s, DP_TASK_DECODE, DP_REAL_FLOAT, DP_WORD_32, dp_path_best()), DP_OK);
        for (uint32_t first = 0; first <= s.spec.format.code_max; first += CHUNK * stride) {
            for (uint32_t i = 0; i < CHUNK; i++)
                code[i] = first + i * stride;
            dp_batch_run(&b, code, value, CHUNK);
            const double top = (double)s.spec.format.code_max;
            for (uint32_t i = 0; i < CHUNK && code[i] <= s.spec.format.code_max; i++)
                TALLY(&t, value[i] == (float)((double)code[i] / top), "%s code %u: %a", names[f], code[i],
                      (double)value[i]);
        }
    }
    tally_end(&t);
}

/* ---- Depths to codes --------------------------------------------------------------------------------------------- */

static const double specials[] = {0.0,
                                  -0.0,
                                  1.0,
                                  -1.0,
                                  0.5,
                                  0x1p-1074,
                                  DBL_MIN,
                                  FLT_MAX,
                                  DBL_MAX,
                                  1e30,
                                  1e24,
                                  1e25,
                                  1e300,
                                  -DBL_MAX,
                                  0x1p-149,
                                  0x1p-126,
                                  0x1p-24,
                                  0x1.fffffep-1,
                                  0x1.fffffffffffffp-1};

/* Depths of all kinds: anywhere, at the lattice and its boundaries and beside them, at the planes, and nonsense. */
static double any_depth(rng *r, const dp_setup *s, int window) {
    const double far_end = isinf(s->spec.zfar) ? s->spec.znear * 1e9 : s->spec.zfar;
    const uint64_t kind = rng_below(r, 16);
    double x;
    if (kind == 0) {
        const uint64_t which = rng_below(r, sizeof specials / sizeof specials[0] + 3);
        return which == 0 ? NAN : which == 1 ? INFINITY : which == 2 ? -INFINITY : specials[which - 3];
    }
    if (kind < 5) {
        const uint32_t code = 1 + (uint32_t)rng_below(r, s->spec.format.code_max);
        const dp_cell cell = dp_cell_of(s, code);
        const double value = dp_format_value(&s->spec.format, code);
        const double middle = 0.5 * (value + dp_format_value(&s->spec.format, code - 1));
        x = kind == 1 ? (window ? value : cell.stored) : (window ? middle : kind == 2 ? cell.lo : cell.hi);
    } else if (kind == 5) {
        x = window ? (double)(rng_next(r) & 1U) : rng_next(r) & 1U ? s->spec.znear : s->spec.zfar;
    } else if (window) {
        x = kind < 10 ? rng_unit(r) : rng_log(r, 1e-9, 1.0);
    } else {
        x = s->spec.znear <= 0.0 ? rng_depth(r, s->spec.znear, far_end)
            : kind < 10          ? rng_log(r, s->spec.znear, far_end)
                                 : rng_uniform(r, s->spec.znear, far_end);
    }
    const int64_t shift = kind < 6 ? (int64_t)rng_below(r, 5) - 2 : 0;
    for (int64_t i = shift; i != 0; i += i < 0 ? 1 : -1)
        x = nextafter(x, i < 0 ? -INFINITY : INFINITY);
    return x;
}

static void depths_to_codes(tally *t, const dp_setup *s, rng *r, int window, size_t count) {
    const dp_task task = window ? DP_TASK_ENCODE : DP_TASK_CODE;
    double *wide = (double *)(void *)buffer(0);
    float *narrow = (float *)(void *)buffer(3);
    for (size_t i = 0; i < count; i++) {
        wide[i] = any_depth(r, s, window);
        narrow[i] = (float)wide[i];
    }
    for (int word = s->spec.format.bits <= 16 ? DP_WORD_16 : DP_WORD_32; word < DP_WORD_COUNT; word++) {
        check_array(t, s, task, DP_REAL_DOUBLE, (dp_word)word, wide, count);
        check_array(t, s, task, DP_REAL_FLOAT, (dp_word)word, narrow, count);
    }
}

TEST(test_depths) {
    const uint64_t rounds = test_cases(1, 1, 24);
    for (int f = 0; f < FORMATS; f++) {
        tally t = {.name = formats[f]};
        rng r = rng_make(formats[f]);
        for (int c = 0; c < CAMERAS; c++)
            for (int rounding = 0; rounding < DP_ROUNDING_COUNT; rounding++) {
                const dp_setup s = make(&cameras[c], formats[f], (dp_rounding)rounding, DP_MODEL_EXACT);
                for (uint64_t k = 0; k < rounds; k++) {
                    depths_to_codes(&t, &s, &r, 0,
                                    s.curve == DP_CURVE_LOG ? 256 : (size_t)test_cases(300, 1500, CHUNK));
                    if (c == 0)
                        depths_to_codes(&t, &s, &r, 1, CHUNK);
                }
            }
        tally_end(&t);
    }
}

/* As many codes as no power of two has: no sum of powers is their value. */
TEST(test_rg) {
    tally t = {.name = "rg"};
    rng r = rng_make("rg");
    const dp_setup s = SETUP("rg", .mapping = DP_MAPPING_LINEAR);
    walk_codes(&t, &s, 1);
    depths_to_codes(&t, &s, &r, 1, CHUNK);
    depths_to_codes(&t, &s, &r, 0, CHUNK);
    tally_end(&t);
}

/* Depths that become numbers: in each model, surfaces that face and slant; at the planes' floats, too. */
TEST(test_numbers) {
    tally t = {.name = "numbers"};
    rng r = rng_make("numbers");
    for (int f = 0; f < FORMATS; f++)
        for (int c = 0; c < CAMERAS; c++) {
            const dp_setup exact = make(&cameras[c], formats[f], DP_ROUND_NEAREST, DP_MODEL_EXACT);
            const dp_setup guaranteed = dp_setup_guaranteed(&exact);
            double *z = (double *)(void *)buffer(0);
            float *narrow = (float *)(void *)buffer(3);
            for (int task = DP_TASK_WINDOW; task <= DP_TASK_INTERVAL; task++) {
                const size_t count = (size_t)test_cases(10, 30, 1000);
                for (size_t i = 0; i < count; i++) {
                    z[i] = i < 2 ? (i == 0 ? exact.spec.znear : exact.spec.zfar) : any_depth(&r, &exact, 0);
                    narrow[i] = (float)z[i];
                }
                for (int wide = 0; wide < 2; wide++) {
                    const void *in = wide ? (const void *)z : (const void *)narrow;
                    check_array(&t, &exact, (dp_task)task, (dp_real)wide, DP_WORD_32, in, count);
                    if (guaranteed.spec.model == DP_MODEL_FLOAT && task == DP_TASK_SEPARATION)
                        check_array(&t, &guaranteed, (dp_task)task, (dp_real)wide, DP_WORD_32, in, count);
                }
            }
        }
    tally_end(&t);
}

/* What is read back of each code, exactly or as a float, is that code again, in every rounding; NaN stays NaN. */
TEST(test_windows) {
    static double out[3][CHUNK], in[CHUNK];
    tally t = {.name = "windows"};
    rng r = rng_make("windows");
    for (int f = 0; f < FORMATS; f++)
        for (int c = 0; c < CAMERAS * 2; c++) {
            const int narrow = c % 2;
            const dp_setup s = make(&cameras[c / 2], formats[f], (dp_rounding)(c % DP_ROUNDING_COUNT), DP_MODEL_EXACT);
            const size_t count = (size_t)test_cases(20, 100, CHUNK);
            uint32_t codes[CHUNK];
            for (size_t i = 0; i < count; i++) {
                codes[i] = (uint32_t)rng_below(&r, (uint64_t)s.spec.format.code_max + 1);
                const double d = i % 10 == 9 ? NAN : dp_format_value(&s.spec.format, codes[i]);
                if (narrow && i % 10 != 9) /* a float may be that of another code where the format is finer */
                    codes[i] = dp_format_encode(&s.spec.format, DP_ROUND_NEAREST, (double)(float)d);
                if (narrow)
                    ((float *)(void *)in)[i] = (float)d;
                else
                    in[i] = d;
            }
            const dp_real real = narrow ? DP_REAL_FLOAT : DP_REAL_DOUBLE;
            assert_int_equal(dp_batch_windows(&s, real, in, out[0], out[1], out[2], count), DP_OK);
            for (int k = 0; k < 3; k++) {
                static const dp_task tasks[] = {DP_TASK_EYE, DP_TASK_LO, DP_TASK_HI};
                dp_batch b;
                assert_int_equal(dp_batch_init(&b, &s, tasks[k], real, DP_WORD_32, dp_path_best()), DP_OK);
                for (size_t i = 0; i < count; i++)
                    TALLY(&t, i % 10 == 9 ? isnan(real_at(&b, out[k], i)) : as_promised(&b, codes, out[k], i),
                          "%s: code %u, %.17g", label(&b), codes[i], real_at(&b, out[k], i));
            }
        }
    const dp_setup s = make(&cameras[0], "unorm24", DP_ROUND_NEAREST, DP_MODEL_EXACT);
    assert_int_equal(dp_batch_windows(NULL, DP_REAL_DOUBLE, in, out[0], NULL, NULL, 1), DP_ERROR_NULL);
    assert_int_equal(dp_batch_windows(&s, DP_REAL_DOUBLE, NULL, out[0], NULL, NULL, 1), DP_ERROR_NULL);
    assert_int_equal(dp_batch_windows(&s, DP_REAL_COUNT, in, out[0], NULL, NULL, 1), DP_ERROR_BATCH);
    tally_end(&t);
}

/* The direct kernels over many plain depths; with DEPTHPREC_FULL a hundred million of each kind. */
TEST(test_many) {
    static const struct {
        const char *format;
        int camera;
    } rows[] = {{"unorm24", 0}, {"unorm24", 1}, {"unorm16", 0}, {"unorm16", 1},
                {"fp16", 1},    {"fp32", 1},    {"unorm24", 4}};
    static float z[CHUNK];
    static uint32_t code[CHUNK];
    tally t = {.name = "many"};
    rng r = rng_make("many");
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        const dp_setup s = make(&cameras[rows[k].camera], rows[k].format, DP_ROUND_NEAREST, DP_MODEL_EXACT);
        for (uint64_t n = 0; n < test_cases(10, 100, 24415); n++) {
            for (int i = 0; i < CHUNK; i++)
                z[i] = (float)rng_log(&r, s.spec.znear, s.spec.zfar);
            for (int path = 0; path < DP_PATH_COUNT; path++) {
                dp_batch b;
                if (dp_batch_init(&b, &s, DP_TASK_CODE, DP_REAL_FLOAT, DP_WORD_32, (dp_path)path) != DP_OK)
                    continue;
                static uint32_t first[CHUNK];
                dp_batch_run(&b, z, path == 0 ? first : code, CHUNK);
                for (int i = 0; i < CHUNK && path == 0; i++)
                    TALLY(&t, first[i] == dp_code(&s, (double)z[i]), "%s: %.9g gives %u", label(&b), (double)z[i],
                          first[i]);
                t.cases += path > 0 ? CHUNK : 0;
                if (path > 0 && memcmp(first, code, sizeof code) != 0)
                    tally_fail(&t, "%s differs from the baseline", label(&b));
            }
        }
    }
    tally_end(&t);
}

/* The other models, element by element. */
TEST(test_models) {
    tally t = {.name = "models"};
    rng r = rng_make("models");
    for (int model = DP_MODEL_STAGED; model < DP_MODEL_COUNT; model++)
        for (int f = 0; f < 4; f++)
            for (int c = 0; c < 2; c++) {
                const dp_setup s = make(&cameras[c], formats[f], DP_ROUND_NEAREST, (dp_model)model);
                const dp_setup exact = make(&cameras[c], formats[f], DP_ROUND_NEAREST, DP_MODEL_EXACT);
                double *z = (double *)(void *)buffer(0);
                for (int i = 0; i < 500; i++)
                    z[i] = any_depth(&r, &exact, 0);
                check_array(&t, &s, DP_TASK_CODE, DP_REAL_DOUBLE, DP_WORD_32, z, 500);
                codes_of(&t, &s, 12000, 1, 500);
            }
    tally_end(&t);
}

/* ---- Shapes of arrays -------------------------------------------------------------------------------------------- */

/* Every length, at every offset of a vector, with nothing written outside; then in place. */
TEST(test_shapes) {
    tally t = {.name = "shapes"};
    for (int f = 0; f < 4; f++)
        for (int task = 0; task < DP_TASK_COUNT; task++)
            for (int real = 0; real < DP_REAL_COUNT; real++)
                for (int word = 0; word < DP_WORD_COUNT; word++)
                    for (int path = 0; path < DP_PATH_COUNT; path++) {
                        const dp_setup s = make(&cameras[f % 2], formats[f], DP_ROUND_NEAREST, DP_MODEL_EXACT);
                        dp_batch b;
                        if (dp_batch_init(&b, &s, (dp_task)task, (dp_real)real, (dp_word)word, (dp_path)path) != DP_OK)
                            continue;
                        char *const in = buffer(0);
                        char *const want = buffer(1);
                        char *const out = buffer(2);
                        for (size_t i = 0; i < CHUNK; i++) {
                            const double x = task == DP_TASK_ENCODE ? (double)i / CHUNK : 0.1 + (double)i * 0.25;
                            const uint32_t c = s.spec.format.code_max - (uint32_t)i * 3U;
                            if (reads_codes(&b) && b.word == DP_WORD_16)
                                ((uint16_t *)(void *)in)[i] = (uint16_t)c;
                            else if (reads_codes(&b))
                                ((uint32_t *)(void *)in)[i] = c;
                            else if (b.real == DP_REAL_FLOAT)
                                ((float *)(void *)in)[i] = (float)x;
                            else
                                ((double *)(void *)in)[i] = x;
                        }
                        dp_batch_run(&b, in, want, CHUNK);
                        for (size_t count = 0; count <= 67; count++) {
                            const size_t at = count * 5 % 17;
                            memset(out, 0x5A, (CHUNK + 2 * GUARD) * sizeof(double));
                            dp_batch_run(&b, in + at * b.in_size, out + at * b.out_size, count);
                            int clean = memcmp(out + at * b.out_size, want + at * b.out_size, count * b.out_size) == 0;
                            for (size_t i = 0; i < GUARD * sizeof(double); i++)
                                clean &= out[(at + count) * b.out_size + i] == 0x5A;
                            for (size_t i = 0; i < at * b.out_size; i++)
                                clean &= out[i] == 0x5A;
                            TALLY(&t, clean, "%s: %zu elements at %zu", label(&b), count, at);
                        }
                        memset(out, 0, CHUNK * sizeof(double));
                        parallel_batch(&b, in, out, CHUNK, 2);
                        TALLY(&t, memcmp(out, want, CHUNK * b.out_size) == 0, "%s: two threads", label(&b));
                        if (b.out_size <= b.in_size) {
                            dp_batch_run(&b, in, in, CHUNK);
                            TALLY(&t, memcmp(in, want, CHUNK * b.out_size) == 0, "%s: in place", label(&b));
                        }
                    }
    tally_end(&t);
}

/* Threads: pieces of a large array, in place too, on any number of them. */
TEST(test_threads) {
    enum { COUNT = 300001 };
    const dp_setup s = make(&cameras[1], "unorm24", DP_ROUND_NEAREST, DP_MODEL_EXACT);
    float *z = malloc(COUNT * sizeof *z);
    uint32_t *want = malloc(COUNT * sizeof *want);
    uint32_t *got = malloc(COUNT * sizeof *got);
    rng r = rng_make("threads");
    dp_batch b;
    assert_true(z != NULL && want != NULL && got != NULL);
    assert_int_equal(dp_batch_init(&b, &s, DP_TASK_CODE, DP_REAL_FLOAT, DP_WORD_32, dp_path_best()), DP_OK);
    for (int i = 0; i < COUNT; i++)
        z[i] = (float)rng_log(&r, 0.1, 1000.0);
    dp_batch_run(&b, z, want, COUNT);
    for (int threads = 0; threads <= 5; threads++) {
        memset(got, 0, COUNT * sizeof *got);
        parallel_batch(&b, z, got, COUNT, threads);
        assert_memory_equal(got, want, COUNT * sizeof *got);
    }
    memcpy(got, z, COUNT * sizeof *got);
    parallel_batch(&b, got, got, COUNT, 3);
    assert_memory_equal(got, want, COUNT * sizeof *got);
    free(z);
    free(want);
    free(got);
}

/* What a batch keeps changes no result, of as many elements as pay for it in one call or not, and nothing of others. */
TEST(test_kept) {
    enum { MANY = 5000 };
    static const int counts[] = {1, 200, MANY};
    static double memory[DP_BATCH_KEEP / sizeof(double)], z[MANY], want[MANY], got[MANY];
    tally t = {.name = "kept"};
    rng r = rng_make("kept");
    for (int c = 0; c < CAMERAS; c++)
        for (int f = 0; f < 4; f++) {
            const dp_setup exact = make(&cameras[c], formats[f], DP_ROUND_NEAREST, DP_MODEL_EXACT);
            const dp_setup s = dp_setup_guaranteed(&exact);
            dp_batch b;
            assert_int_equal(dp_batch_init(&b, &s, DP_TASK_SEPARATION, DP_REAL_DOUBLE, DP_WORD_32, dp_path_best()),
                             DP_OK);
            for (int i = 0; i < MANY; i++)
                z[i] = any_depth(&r, &s, 0);
            for (int i = 0; i < MANY; i++)
                dp_batch_run(&b, &z[i], &want[i], 1);
            for (int kept = 0; kept < 2; kept++) {
                for (int k = 0; k < 3; k++) {
                    dp_batch_run(&b, z, got, (size_t)counts[k]);
                    TALLY(&t, memcmp(got, want, (size_t)counts[k] * sizeof *got) == 0, "%s: %d elements, kept %d",
                          label(&b), counts[k], kept);
                }
                dp_batch_keep(&b, memory);
            }
        }
    dp_batch other;
    const dp_setup s = make(&cameras[0], "unorm24", DP_ROUND_NEAREST, DP_MODEL_FLOAT);
    assert_int_equal(dp_batch_init(&other, &s, DP_TASK_WINDOW, DP_REAL_DOUBLE, DP_WORD_32, dp_path_best()), DP_OK);
    const dp_batch before = other;
    dp_batch_keep(&other, memory);
    assert_memory_equal(&other, &before, sizeof other);
    tally_end(&t);
}

TEST(test_door) {
    const dp_setup s = make(&cameras[0], "unorm24", DP_ROUND_NEAREST, DP_MODEL_EXACT);
    dp_batch b;
    memset(&b, 0x77, sizeof b);
    const dp_batch before = b;
    const dp_path path = dp_path_best();
    assert_int_equal(dp_batch_init(NULL, &s, DP_TASK_CODE, DP_REAL_FLOAT, DP_WORD_32, path), DP_ERROR_NULL);
    assert_int_equal(dp_batch_init(&b, NULL, DP_TASK_CODE, DP_REAL_FLOAT, DP_WORD_32, path), DP_ERROR_NULL);
    assert_int_equal(dp_batch_init(&b, &s, DP_TASK_COUNT, DP_REAL_FLOAT, DP_WORD_32, path), DP_ERROR_BATCH);
    assert_int_equal(dp_batch_init(&b, &s, DP_TASK_CODE, DP_REAL_COUNT, DP_WORD_32, path), DP_ERROR_BATCH);
    assert_int_equal(dp_batch_init(&b, &s, DP_TASK_CODE, DP_REAL_FLOAT, DP_WORD_COUNT, path), DP_ERROR_BATCH);
    assert_int_equal(dp_batch_init(&b, &s, DP_TASK_CODE, DP_REAL_FLOAT, DP_WORD_32, DP_PATH_COUNT), DP_ERROR_BATCH);
    assert_int_equal(dp_batch_init(&b, &s, DP_TASK_CODE, DP_REAL_FLOAT, DP_WORD_16, path), DP_ERROR_FORMAT);
    assert_memory_equal(&b, &before, sizeof b);
    assert_string_equal(dp_path_name(DP_PATH_BASELINE), "baseline");
    assert_null(dp_path_name(DP_PATH_COUNT));
    assert_true(dp_path_available(DP_PATH_BASELINE));
    assert_false(dp_path_available(DP_PATH_COUNT));
}
