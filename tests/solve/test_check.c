/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Verdicts: against depths visited one by one, against published figures, and fast enough for thousands. */
#include <time.h>

#include "solve/check.h"
#include "support.h"

typedef struct judged {
    need_file file;
    size_t count;
    long failed;
    check_verdict *verdicts;
    int counted; /* how often ties had to be counted */
} judged;

/* In place of the census: a share that a test sets. */
static double share_to_find;

static bool count_ties(void *context, const dp_setup *setup, double lo, double hi, bool sample, double *share,
                       double *z) {
    (void)setup, (void)hi, (void)sample;
    ++*(int *)context;
    *share = share_to_find;
    *z = lo;
    return share_to_find >= 0.0;
}

static judged judge(const char *text) {
    judged j = {.count = 0};
    need_error e;
    if (!need_parse("x.need", text, strlen(text), &j.file, &e))
        fail_msg("line %d: %s\n%s", e.line, e.text, text);
    j.count = check_count(&j.file);
    j.verdicts = calloc(j.count, sizeof *j.verdicts);
    assert_non_null(j.verdicts);
    const check_request request = {&j.file, count_ties, &j.counted};
    j.failed = check_all(&request, j.verdicts);
    return j;
}

static void done(judged *j) {
    need_release(&j->file);
    free(j->verdicts);
}

/* One requirement of one camera. */
static judged judge_one(const char *camera, const char *what) {
    char text[1024];
    snprintf(text, sizeof text,
             "unit = \"m\"; cameras = { a = { %s }; }; requirements = { r = { camera = \"a\"; %s }; };", camera, what);
    return judge(text);
}

/* The cell of unorm24 at 5 km with near 0.01 and far 10 km is 147 m wide; the separation is one whole step from 5 km.
 */
TEST(known_answers) {
    static const struct {
        const char *camera, *what;
        bool passed;
        double value, z;
    } cases[] = {
        {"near = 0.01; far = \"10 km\"; mapping = \"d3d\"; format = \"unorm24\";", "at = \"5 km\"; separation = 150;",
         false, 153.588769, 5000},
        {"near = 0.1; far = \"10 km\"; mapping = \"d3d\"; format = \"unorm24\";", "at = \"5 km\"; separation = 15;",
         true, 14.9454, 5000},
        {"near = 147.2; far = \"10 km\"; mapping = \"d3d\"; format = \"unorm24\";",
         "range = [\"1 km\", \"5 km\"]; separation = \"1 cm\";", true, 0.0099743, 5000},
        {"near = 146; far = \"10 km\"; mapping = \"d3d\"; format = \"unorm24\";",
         "range = [\"1 km\", \"5 km\"]; separation = \"1 cm\";", false, 0.010057, 5000},
        {"near = 0.1; far = \"inf\"; mapping = \"reversed\"; format = \"fp32\";",
         "range = [\"1 m\", \"5 km\"]; separation = \"1 mm\";", true, 0.00045474739, 5000},
        {"near = 0.1; far = \"inf\"; mapping = \"reversed\"; format = \"unorm24\";",
         "range = (1, \"inf\"); separation = 1e6;", false, INFINITY, INFINITY},
        {"near = 0.1; far = 1000; mapping = \"reversed\"; format = \"fp32\";", "range = (0.1, 1000); error = 1.476e-5;",
         true, 1.47541248e-05, 450.33},
        {"near = 0.1; far = 1000; mapping = \"d3d\"; format = \"unorm16\";", "range = (0.1, 1000); error = 70;", false,
         70.880207558, 0},
        {"near = 0.1; far = 1000; mapping = \"d3d\"; format = \"unorm24\";", "at = 100; error = 2.2e-5;", true,
         2.14576780e-05, 100},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char camera[256];
        snprintf(camera, sizeof camera, "%s model = \"exact\";", cases[i].camera);
        judged j = judge_one(camera, cases[i].what);
        assert_int_equal(j.count, 1);
        const check_verdict *v = &j.verdicts[0];
        if (v->passed != cases[i].passed || j.failed != !cases[i].passed)
            fail_msg("%s %s: %g at %g", cases[i].camera, cases[i].what, v->value, v->z);
        if (isinf(cases[i].value))
            assert_true(isinf(v->value));
        else
            assert_relative(v->value, cases[i].value, 1e-3);
        if (cases[i].z > 0.0 && isfinite(cases[i].z))
            assert_relative(v->z, cases[i].z, 1e-4);
        done(&j);
    }
}

/* Without a word about the model the guarantee decides: 15 m at 5 km pass in the lattice alone. */
TEST(the_default_is_a_guarantee) {
    static const char camera[] = "near = 0.1; far = \"10 km\"; mapping = \"d3d\"; format = \"unorm24\";";
    static const char what[] = "at = \"5 km\"; separation = 15;";
    static const char *const words[] = {"", " model = \"auto\";", " model = \"float\";", " model = \"exact\";"};
    for (int i = 0; i < 4; i++) {
        char with[256];
        snprintf(with, sizeof with, "%s%s", camera, words[i]);
        judged j = judge_one(with, what);
        dp_setup setup;
        dp_spec spec = j.verdicts[0].setup.spec;
        assert_int_equal(j.verdicts[0].passed, i == 3);
        assert_int_equal(spec.model, i == 3 ? DP_MODEL_EXACT : DP_MODEL_FLOAT);
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        assert_true(j.verdicts[0].value == dp_separation(&setup, 5000.0));
        done(&j);
    }
}

/* The error of a logarithmic depth is that of the shader: 5 m at 1000 km are enough for the model staged, not for a
 * shader's log2.
 */
TEST(of_a_shader) {
    static const char camera[] = "near = 1; far = 1e9; mapping = \"log\"; format = \"unorm24\";";
    static const struct {
        const char *model, *what;
        check_method method;
        bool passed;
    } cases[] = {
        {"", "at = 1e6; separation = 1;", CHECK_LATTICE, false},
        {"", "at = 1e6; separation = 5;", CHECK_GUARANTEE, false},
        {"", "at = 1e6; separation = 10;", CHECK_GUARANTEE, true},
        {" model = \"staged\";", "at = 1e6; separation = 5;", CHECK_STAGED, true},
        {" model = \"auto\";", "range = [10.0, 1e6]; separation = 5;", CHECK_GUARANTEE, false},
        {" model = \"auto\";", "range = [10.0, 1e6]; separation = 10;", CHECK_GUARANTEE, true},
        {" model = \"float\";", "at = 1e6; separation = 5;", CHECK_GUARANTEE, false},
        {" model = \"float\";", "at = 1e6; separation = 10;", CHECK_GUARANTEE, true},
        {"", "at = 1e6; error = 2.5;", CHECK_GUARANTEE, false},
        {"", "at = 1e6; error = 6;", CHECK_GUARANTEE, true},
        {" model = \"float\";", "range = [10.0, 1e6]; error = 2.5;", CHECK_GUARANTEE, false},
        {" model = \"staged\";", "at = 1e6; error = 2.5;", CHECK_STAGED, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[256];
        dp_budget b;
        snprintf(text, sizeof text, "%s%s", camera, cases[i].model);
        judged j = judge_one(text, cases[i].what);
        const check_verdict *v = &j.verdicts[0];
        assert_int_equal(dp_budget_at(&v->setup, 1e6, NULL, &b), DP_OK);
        if (v->method != cases[i].method || v->passed != cases[i].passed)
            fail_msg("%s, %s: %s, %g", cases[i].model, cases[i].what, check_method_name(v->method), v->value);
        const bool error = v->asked->kind == QUANTITY_ERROR; /* one of two depths, that of test_log_budget.c */
        assert_true(
            v->method != CHECK_GUARANTEE ||
            (error ? v->value > 0.5 * b.separation && v->value < 0.75 * b.separation : v->value == b.separation));
        done(&j);
    }
}

static const char *const mappings[] = {"d3d", "gl", "reversed", "gl-reversed", "linear", "log"};
static const char *const formats[] = {"fp32", "unorm24", "unorm16", "fp16"};
static const char *const models[] = {"exact", "staged", "float", "auto"};

/* Random cameras and ranges: a requirement that passes holds at every depth tried, one that fails fails at its z. */
TEST(ranges_against_single_depths) {
    tally holds = {.name = "what passes holds at each depth of the range"};
    tally fails = {.name = "what fails does so at the depth that is named"};
    rng r = rng_make("check ranges");
    for (uint64_t i = 0; i < test_cases(40, 1500, 20000); i++) {
        char camera[256];
        char what[256];
        const char *model = models[rng_below(&r, 4)];
        const char *mapping = mappings[rng_below(&r, strcmp(model, "float") == 0 ? 4 : 6)];
        const double znear = rng_log(&r, 0.01, 10.0);
        const double zfar = znear * rng_log(&r, 2.0, 1e6);
        const double lo = rng_log(&r, znear, zfar);
        const double hi = rng_log(&r, lo, zfar);
        const double limit = hi * rng_log(&r, 1e-9, 1.0);
        if (!(lo >= znear && lo < hi && hi <= zfar))
            continue;
        snprintf(camera, sizeof camera, "near = %.17e; far = %.17e; mapping = \"%s\"; format = \"%s\"; model = \"%s\";",
                 znear, zfar, mapping, formats[rng_below(&r, 4)], model);
        snprintf(what, sizeof what, "range = [%.17e, %.17e]; separation = %.17e;", lo, hi, limit);
        judged j = judge_one(camera, what);
        const check_verdict *v = &j.verdicts[0];
        if (!v->passed) {
            TALLY(&fails,
                  v->value > limit && (isinf(v->value) || dp_separation(&v->setup, v->z) >= v->value * (1 - 1e-9)),
                  "%s %s: %g at %g", camera, what, v->value, v->z);
        }
        for (int k = 0; k < 100 && v->passed; k++) {
            const double z = fmin(fmax(k % 2 == 0 ? rng_log(&r, lo, hi) : rng_uniform(&r, lo, hi), lo), hi);
            TALLY(&holds, dp_separation(&v->setup, z) <= limit * (v->method == CHECK_GUARANTEE ? 1.031 : 1.0),
                  "%s %s: %g at %g", camera, what, dp_separation(&v->setup, z), z);
        }
        done(&j);
    }
    tally_end(&holds);
    tally_end(&fails);
}

/* The error at one depth is what is stored less what is, without its sign: half of them point towards the camera. */
TEST(errors_at_single_depths) {
    tally t = {.name = "an error has no sign"};
    rng r = rng_make("check errors");
    int nearer = 0;
    for (uint64_t i = 0; i < test_cases(100, 1000, 10000); i++) {
        char camera[256], what[256];
        const double znear = rng_log(&r, 0.01, 10.0), zfar = znear * rng_log(&r, 2.0, 1e4);
        const double z = fmin(fmax(rng_log(&r, znear, zfar), znear), zfar);
        snprintf(camera, sizeof camera,
                 "near = %.17e; far = %.17e; mapping = \"%s\"; format = \"%s\"; model = \"exact\";", znear, zfar,
                 mappings[rng_below(&r, 6)], formats[rng_below(&r, 4)]);
        snprintf(what, sizeof what, "at = %.17e; error = 1e-9;", z);
        judged j = judge_one(camera, what);
        const check_verdict *v = &j.verdicts[0];
        const long double off = (long double)dp_stored(&v->setup, dp_code(&v->setup, z)) - (long double)z;
        nearer += off < -1e-9L;
        TALLY(&t, fabsl((long double)v->value - fabsl(off)) <= 0x1p-48L * (long double)z, "%s %s: %g, not %Lg", camera,
              what, v->value, fabsl(off));
        if (fabsl(off) > 1e-9L + 0x1p-48L * (long double)z)
            TALLY(&t, !v->passed, "%s %s: passes with %Lg", camera, what, off);
        done(&j);
    }
    assert_true(nearer > 20);
    tally_end(&t);
}

/* The models' answers for one camera, and which of them is asked. */
TEST(the_quick_model_first) {
    static const char camera[] = "near = 0.1; far = 1000; mapping = \"d3d\"; format = \"unorm24\"; model = \"%s\";";
    static const struct {
        const char *model, *what;
        check_method method;
        bool passed;
    } cases[] = {
        {"exact", "at = 100; separation = 0.01;", CHECK_LATTICE, true},
        {"staged", "at = 100; separation = 0.01;", CHECK_STAGED, false},
        {"float", "at = 100; separation = 0.001;", CHECK_GUARANTEE, false},
        {"float", "at = 100; separation = 0.0062;", CHECK_GUARANTEE, false},
        {"float", "at = 100; separation = 0.1;", CHECK_GUARANTEE, true},
        {"auto", "at = 100; separation = 0.004;", CHECK_LATTICE, false},    /* the lattice alone has 0.006 */
        {"auto", "at = 100; separation = 0.0062;", CHECK_GUARANTEE, false}, /* 0.0066 with the arithmetic */
        {"auto", "at = 100; separation = 0.1;", CHECK_GUARANTEE, true},
        {"auto", "at = 100; error = 1e-9;", CHECK_STAGED, false},
        {"auto", "at = 100; error = 1;", CHECK_STAGED, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, camera, cases[i].model);
        judged j = judge_one(text, cases[i].what);
        const check_verdict *v = &j.verdicts[0];
        if (v->method != cases[i].method || v->passed != cases[i].passed)
            fail_msg("%s, %s: %s, %g", cases[i].model, cases[i].what, check_method_name(v->method), v->value);
        done(&j);
    }
}

/* What a random camera of the fullest model is asked, beside the verdict of that model, computed by itself. */
typedef struct alike {
    tally verdicts, nested, errors;
    int passed, failed, by_lattice, below_staged;
} alike;

static void separations_alike(alike *a, const char *camera, double lo, double hi, rng *r) {
    static const char *const asked[] = {"", " model = \"auto\";", " model = \"float\";"};
    char with[512], what[128];
    snprintf(with, sizeof with, "%s%s", camera, asked[rng_below(r, strstr(camera, "linear") == NULL ? 3 : 2)]);
    snprintf(what, sizeof what, "at = %.17e; separation = 1;", lo);
    judged j = judge_one(with, what);
    dp_setup exact, staged, full = dp_setup_guaranteed(&j.verdicts[0].camera->setups[0]);
    dp_spec spec = full.spec;
    spec.model = DP_MODEL_EXACT;
    spec.triangles.width = 0;
    assert_int_equal(dp_setup_init(&exact, &spec), DP_OK);
    spec.model = DP_MODEL_STAGED;
    assert_int_equal(dp_setup_init(&staged, &spec), DP_OK);
    done(&j);
    dp_separation_worst lattice = {.bound = 0}, worst = {.bound = 0};
    const double at[] = {lo, hi, rng_log(r, lo, hi), rng_uniform(r, lo, hi)};
    for (int i = 0; i < 4; i++) {
        const double z = fmin(fmax(at[i], lo), hi);
        const double of_lattice = dp_separation(&exact, z), of_staged = dp_separation(&staged, z);
        TALLY(&a->nested, fmin(dp_separation(&full, z), of_staged) >= of_lattice, "%s z = %a", with, z);
        a->below_staged += dp_separation(&full, z) < of_staged;
    }
    assert_int_equal(dp_separation_over(&exact, lo, hi, 0.0, &lattice), DP_OK);
    const double limit = lattice.separation * rng_log(r, 0.5, 8.0); /* about where the models differ */
    if (!isfinite(limit))
        return;
    assert_int_equal(dp_separation_over(&full, lo, hi, limit, &worst), DP_OK);
    const bool passes = (lo < hi ? worst.bound : dp_separation(&full, lo)) <= limit;
    snprintf(what, sizeof what, "range = [%.17e, %.17e]; separation = %.17e;", lo, hi, limit);
    if (lo == hi)
        snprintf(what, sizeof what, "at = %.17e; separation = %.17e;", lo, limit);
    j = judge_one(with, what);
    TALLY(&a->verdicts, j.verdicts[0].passed == passes, "%s %s: %d, %g", with, what, passes, worst.bound);
    a->passed += passes;
    a->failed += !passes;
    a->by_lattice += j.verdicts[0].method == CHECK_LATTICE;
    assert_true(j.verdicts[0].method == CHECK_GUARANTEE || j.verdicts[0].method == CHECK_STAGED || !passes);
    done(&j);
}

/* Errors of the model auto are those of staged, which is named here; of a logarithm those of its shader. */
static void errors_alike(alike *a, const char *camera, double lo, double hi, rng *r) {
    char with[512], named[512], what[128], at[64];
    snprintf(with, sizeof with, "%s model = \"auto\";", camera);
    snprintf(named, sizeof named, "%s model = \"%s\";", camera, strstr(camera, "\"log\"") != NULL ? "float" : "staged");
    snprintf(at, sizeof at, lo < hi ? "range = [%.17e, %.17e];" : "at = %.17e;", lo, hi);
    snprintf(what, sizeof what, "%s error = 1;", at);
    judged j = judge_one(named, what);
    const double limit = j.verdicts[0].value * rng_log(r, 0.25, 4.0);
    done(&j);
    if (!(limit > 0.0 && isfinite(limit)))
        return;
    snprintf(what, sizeof what, "%s error = %.17e;", at, limit);
    judged one = judge_one(with, what), other = judge_one(named, what);
    TALLY(&a->errors,
          one.verdicts[0].passed == other.verdicts[0].passed && one.verdicts[0].value == other.verdicts[0].value,
          "%s %s: %g, %g", with, what, one.verdicts[0].value, other.verdicts[0].value);
    done(&one);
    done(&other);
}

/*
 * Nobody's verdict depends on which model was tried first: a file's camera without a word, with auto and with float
 * gets that of the fullest model, computed outright. For the lattice is below every model at each depth.
 */
TEST(each_model_outright) {
    static const char *const views[] = {"", "", " rounding = \"zero\";",
                                        " viewport = [1920, 1080]; raster = \"llvmpipe\"; fov = 60;",
                                        " viewport = [640, 480]; subpixel = 8; fov = 20; slant = [60, 85];"};
    static const char *const ariths[] = {"ieee", "fused", "reciprocal", "product", "mesa", "nvidia", "ieee-remap"};
    alike a = {.verdicts = {.name = "the verdict is that of the fullest model"},
               .nested = {.name = "no model resolves less than the lattice"},
               .errors = {.name = "an error's verdict is that of the model that is named"}};
    rng r = rng_make("check each model");
    for (uint64_t i = 0; i < test_cases(120, 800, 20000); i++) {
        char camera[320], far[40];
        const size_t mapping = rng_below(&r, 6);
        const double znear = rng_log(&r, 0.01, 10.0), zfar = znear * rng_log(&r, 2.0, 1e6);
        const double lo = fmin(fmax(rng_log(&r, znear, zfar), znear), zfar);
        const double hi = rng_below(&r, 3) == 0 ? lo : fmin(fmax(rng_log(&r, lo, zfar), lo), zfar);
        const bool flat = mapping < 4 && rng_below(&r, 6) == 0;
        const bool endless = mapping < 4 && !flat && rng_below(&r, 6) == 0;
        snprintf(far, sizeof far, endless ? "\"inf\"" : "%.17e", zfar);
        snprintf(camera, sizeof camera, "near = %.17e; far = %s; mapping = \"%s\"; format = \"%s\";%s", znear, far,
                 mappings[mapping], formats[rng_below(&r, 4)], flat ? " ortho = true;" : "");
        errors_alike(&a, camera, lo, hi, &r);
        if (!flat && mapping < 4)
            strcat(camera, views[rng_below(&r, 5)]);
        if (mapping < 4 && strstr(camera, "viewport") == NULL)
            snprintf(camera + strlen(camera), sizeof camera - strlen(camera), " arith = \"%s\";",
                     ariths[rng_below(&r, 7)]);
        separations_alike(&a, camera, lo, hi, &r);
    }
    assert_true(a.passed > 20 && a.failed > 20 && a.by_lattice > 20 && a.below_staged > 0);
    tally_end(&a.verdicts);
    tally_end(&a.nested);
    tally_end(&a.errors);
}

/* A bias: what is met, by numbers that test_bias_verdict has proven; D24 by hand. */
TEST(biases) {
    static const struct {
        const char *camera, *what;
        bool passed;
        double value; /* the least units; NaN: none */
    } cases[] = {
        {"", "range = [1, 100]; bias = { api = \"gl\"; units = -2; factor = -1; };", true, -1},
        {"", "range = [1, 100]; bias = { api = \"gl\"; units = 0; };", false, -1},
        {"", "range = [1, 100]; bias = { api = \"gl\"; units = 2; };", false, -1},
        {"", "at = 5; bias = { api = \"d3d11\"; units = -2; };", true, -2},
        {"", "at = 5; bias = { api = \"d3d12\"; units = -5; clamp = -1e-8; };", false, -2},
        {"viewport = [1920, 1080]; subpixel = 8; fov = 60;",
         "range = [1, 100]; bias = { api = \"gl\"; units = -10; factor = -1; };", true, -10},
        {"viewport = [1920, 1080]; subpixel = 8; fov = 60;",
         "range = [1, 100]; bias = { api = \"gl\"; units = -2; factor = -1; };", false, -10},
        {"viewport = [1920, 1080]; subpixel = 8; fov = 60;",
         "range = [1, 100]; bias = { api = \"gl\"; units = -9; factor = -1; };", false, -10},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, "near = 0.1; far = 1000; mapping = \"gl\"; format = \"unorm24\"; %s",
                 cases[i].camera);
        judged j = judge_one(text, cases[i].what);
        const check_verdict *v = &j.verdicts[0];
        if (v->passed != cases[i].passed || v->value != cases[i].value || j.failed != !v->passed)
            fail_msg("%s: %d, least %.17g", cases[i].what, v->passed, v->value);
        if (v->answer == BIAS_NOT_ENOUGH)
            assert_true(v->z >= v->asked->lo && v->z <= v->asked->hi && v->code == dp_code(&v->setup, v->z));
        done(&j);
    }
    /* A fragment shader's depth has none. */
    judged j = judge_one("near = 0.1; far = 1000; mapping = \"log\"; log_c = 1; format = \"unorm24\";",
                         "at = 5; bias = { api = \"gl\"; units = -100; };");
    assert_true(!j.verdicts[0].passed && isnan(j.verdicts[0].value));
    done(&j);
    /* The slope decides, where surfaces that face the camera have enough; or these do. */
    for (int i = 0; i < 4; i++) {
        char what[128];
        snprintf(what, sizeof what, "at = 10; bias = { api = \"gl\"; units = -%d; slope = 0.001; };", i % 2 ? 0 : 2000);
        j = judge_one(i < 2 ? "near = 0.1; far = 1000; mapping = \"gl\"; format = \"unorm24\";"
                            : "near = 0.1; far = 1000; mapping = \"gl\"; format = \"unorm24\"; viewport = [640, 480]; "
                              "fov = 60; subpixel = 8;",
                      what);
        assert_int_equal(j.verdicts[0].sloped, i % 2 == 0);
        assert_int_equal(j.verdicts[0].passed, i % 2 == 0);
        done(&j);
    }
    /* A gap: 1 cm at 10 m is n dz/z^2 of the window and 16777 codes and more. */
    j = judge_one("near = 0.1; far = 1000; mapping = \"gl\"; format = \"unorm24\";",
                  "at = 10; bias = { api = \"gl\"; units = -167; separation = \"1 cm\"; };");
    assert_true(!j.verdicts[0].passed && j.verdicts[0].value == -168);
    done(&j);
}

/* With a separation, from the near plane on. */
TEST(biases_from_near) {
    /* From the near plane on no layer lies 5 cm in front of what is nearer than 15 cm, where it takes (1 - n/z)/(1 -
     * n/f) of the window: a third. */
    judged j = judge_one("near = 0.1; far = 1000; mapping = \"gl\"; format = \"unorm24\";",
                         "range = [0.1, 10.0]; bias = { api = \"gl\"; units = -5700000; separation = \"5 cm\"; };");
    assert_true(j.verdicts[0].passed && fabs(j.verdicts[0].value / (-0x1p24 / 3) - 1) < 1e-3);
    done(&j);
    /* Where no bias is proven, nothing that lies there is a witness against it. */
    j = judge_one("near = 0.1; far = 1000; mapping = \"d3d\"; format = \"unorm24\"; viewport = [640, 480]; "
                  "subpixel = 1; fov = 60;",
                  "range = [0.1, 10.0]; bias = { api = \"gl\"; units = -5700000; separation = \"5 cm\"; };");
    assert_true(!j.verdicts[0].passed && j.verdicts[0].answer == BIAS_NOT_PROVEN);
    done(&j);
}

TEST(ties_are_counted_when_needed) {
    static const char reversed[] =
        "near = 0.1; far = \"inf\"; mapping = \"reversed\"; format = \"fp32\"; model = \"float\";";
    static const char d3d[] = "near = 0.1; far = 1000; mapping = \"d3d\"; format = \"unorm24\"; model = \"float\";";
    share_to_find = 0.25;
    judged j = judge_one(d3d, "range = [1, 2]; ties = 0.3;");
    assert_true(j.counted == 1 && j.failed == 0 && j.verdicts[0].method == CHECK_CENSUS && j.verdicts[0].value == 0.25);
    done(&j);
    j = judge_one(d3d, "range = [1, 2]; ties = \"20 %\";");
    assert_true(j.counted == 1 && j.failed == 1);
    done(&j);
    j = judge_one(reversed, "range = (0.1, 1e30); ties = 0.5;"); /* more depths than a census is for */
    assert_true(j.counted == 1 && j.verdicts[0].method == CHECK_SAMPLED);
    done(&j);
    static const char sun[] =
        "near = -10; far = 50; ortho = true; mapping = \"d3d\"; format = \"unorm16\"; model = \"float\";";
    j = judge_one(sun, "range = [-10, 50]; ties = 0.5;"); /* 0 is in the midst of all binary32 numbers */
    assert_true(j.counted == 1 && j.verdicts[0].method == CHECK_SAMPLED);
    done(&j);
    j = judge_one(sun, "range = [-9, -8]; ties = 0.5;");
    assert_true(j.counted == 1 && j.verdicts[0].method == CHECK_CENSUS);
    done(&j);
    share_to_find = 0.0; /* none found, and none allowed */
    j = judge_one(d3d, "range = [1, 2]; ties = 0;");
    assert_true(j.counted == 1 && j.failed == 0 && j.verdicts[0].passed);
    done(&j);
    share_to_find = -1.0; /* the caller gives up */
    j = judge_one(d3d, "range = [1, 2]; ties = 0.3;");
    assert_int_equal(j.failed, -1);
    done(&j);
}

/* Ten thousand requirements in one file: all are judged; the processor time that it takes is shown, not judged. */
TEST(thousands) {
    enum { COUNT = 10000 };
    const char *const heads[] = {"mapping = \"reversed\"; format = \"fp32\";",
                                 "mapping = \"gl\"; format = \"unorm24\"; model = \"staged\";",
                                 "mapping = \"d3d\"; format = \"fp32\"; model = \"float\";"};
    for (size_t h = 0; h < sizeof heads / sizeof heads[0]; h++) {
        char *text = malloc(COUNT * 128);
        assert_non_null(text);
        size_t used =
            (size_t)sprintf(text, "cameras = { a = { near = 0.1; far = 1000; %s }; };\nrequirements = (\n", heads[h]);
        for (int i = 0; i < COUNT; i++)
            used += (size_t)sprintf(text + used,
                                    "%s{ name = \"r%d\"; camera = \"a\"; range = (%.3f, 900); separation = 0.01; }",
                                    i > 0 ? ",\n" : "", i, 0.1 + 0.001 * i);
        strcpy(text + used, ");\n");
        const clock_t start = clock();
        judged j = judge(text);
        const double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
        printf("# %d requirements, %s: %.3f s\n", COUNT, heads[h], seconds);
        assert_int_equal(j.count, COUNT);
        done(&j);
        free(text);
    }
}
