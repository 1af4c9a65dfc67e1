/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions are recognised: in binary32, in the orders of operations of the test, for cameras of all kinds. */
#include <unistd.h>

#include "judge/judge.h"
#include "support.h"

enum { PAIRS = 48 };

/* A function of somebody's, of what it reads and its planes. */
typedef struct written {
    const char *computes, *from;
    bool reversed, far_infinite; /* what it is right for: far may be infinite */
    float (*of)(float d, float n, float f);
} written;

static float textbook(float d, float n, float f) {
    return n * f / (f - d * (f - n));
}
static float divided(float d, float n, float f) {
    return 1.0f / ((1.0f / f - 1.0f / n) * d + 1.0f / n);
}
static float by_ndc(float d, float n, float f) {
    return 2.0f * n * f / (f + n - (2.0f * d - 1.0f) * (f - n));
}
static float of_ndc(float ndc, float n, float f) {
    return 2.0f * n * f / (f + n - ndc * (f - n));
}
static float complemented(float d, float n, float f) {
    return n * f / (n + (1.0f - d) * (f - n));
}
static float view(float d, float n, float f) {
    return n * f / ((f - n) * d - f);
}
static float linear01(float d, float n, float f) {
    return 1.0f / ((1.0f - f / n) * d + f / n);
}
static float from_near(float d, float n, float f) {
    return d / ((1.0f - f / n) * d + f / n);
}
static float disparity(float d, float n, float f) {
    return (1.0f / f - 1.0f / n) * d + 1.0f / n;
}
static float reversed(float d, float n, float f) {
    return n * f / (n + d * (f - n));
}
static float reversed_swapped(float d, float n, float f) {
    return textbook(d, f, n);
}
static float reversed_difference(float d, float n, float f) {
    return textbook(1.0f - d, n, f);
}
static float reversed_endless(float d, float n, float f) {
    (void)f;
    return n / d;
}
static float stored(float z, float n, float f) {
    return f / (f - n) - f * n / (f - n) / z;
}
static float stored_reversed(float z, float n, float f) {
    return n / (f - n) * (f / z - 1.0f);
}
static float stored_view(float z, float n, float f) {
    return (n + z) * f / ((f - n) * z);
}
static float stored_view_reversed(float z, float n, float f) {
    return n * (z + f) / (z * (n - f));
}
static float unchanged(float d, float n, float f) {
    (void)n;
    (void)f;
    return d;
}
static float inverted(float d, float n, float f) {
    (void)n;
    (void)f;
    return 1.0f - d;
}

static const written functions[] = {
    {"eye depth", "window depth", false, false, textbook},
    {"eye depth", "window depth", false, false, divided},
    {"eye depth", "window depth", false, false, by_ndc},
    {"eye depth", "NDC depth", false, false, of_ndc},
    {"eye depth", "window depth", false, false, complemented},
    {"minus eye depth", "window depth", false, false, view},
    {"eye depth over far", "window depth", false, false, linear01},
    {"the way from near to far", "window depth", false, false, from_near},
    {"reciprocal of eye depth", "window depth", false, false, disparity},
    {"eye depth", "window depth", true, false, reversed},
    {"eye depth", "window depth", true, false, reversed_swapped},
    {"eye depth", "window depth", true, false, reversed_difference},
    {"eye depth", "window depth", true, true, reversed_endless},
    {"window depth", "eye depth", false, false, stored},
    {"window depth", "eye depth", true, false, stored_reversed},
    {"window depth", "minus eye depth", false, false, stored_view},
    {"window depth", "minus eye depth", true, false, stored_view_reversed},
    {"window depth", "window depth", false, false, unchanged},
    {"1 minus window depth", "window depth", false, false, inverted},
};
enum { FUNCTIONS = sizeof functions / sizeof functions[0], ENDLESS = 12, VIEW = 15, NO_PLANES = 17 };

static judge_pair pair_room[PAIRS];

static dp_setup camera(double znear, double zfar, dp_mapping mapping) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.znear = znear;
    spec.zfar = zfar;
    spec.mapping = mapping;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

/* Depths anywhere between the planes, as the function reads them, and its values; sorted as pairs are. */
static judge_pairs asked(rng *r, const written *w, double n, double f) {
    judge_pairs p = {.pairs = pair_room, .count = PAIRS, .distinct = PAIRS};
    const double last = isinf(f) ? 1e6 * n : f;
    for (int i = 0; i < PAIRS; i++) {
        const double t = (i + rng_unit(r)) / PAIRS, z = n * pow(last / n, t);
        const double d = isinf(f) ? n / z : (w->reversed ? n * (f - z) : f * (z - n)) / (z * (f - n));
        const bool eye = strcmp(w->from, "eye depth") == 0, behind = strcmp(w->from, "minus eye depth") == 0;
        const double x = eye ? z : behind ? -z : strcmp(w->from, "NDC depth") == 0 ? 2 * d - 1 : d;
        const int at = behind || (w->reversed && !eye) ? PAIRS - 1 - i : i;
        p.pairs[at] = (judge_pair){(double)(float)x, (double)w->of((float)x, (float)n, (float)f)};
    }
    return p;
}

static dp_mapping mapping_of(const written *w, bool reversed_one) {
    const bool is_ndc = strcmp(w->from, "NDC depth") == 0;
    return reversed_one ? (is_ndc ? DP_MAPPING_GL_REVERSED : DP_MAPPING_REVERSED)
                        : (is_ndc ? DP_MAPPING_GL : DP_MAPPING_D3D);
}

static bool is_named(const judgement *j, const written *w) {
    return j->named && strcmp(j->found.output->name, w->computes) == 0 && strcmp(j->found.input->name, w->from) == 0;
}

/* Right functions, each judged for its own camera, for the other direction, for another near plane, and for none. */
TEST(test_right) {
    tally own = {.name = "own camera"}, other = {.name = "another one"}, found = {.name = "planes found"};
    rng r = rng_make("judged");
    for (uint64_t i = 0; i < test_cases(200, 500, 20000); i++) {
        const written *w = &functions[rng_below(&r, FUNCTIONS)];
        const double n = (double)(float)rng_log(&r, 0.01, 10);
        const double f = w->far_infinite ? (double)INFINITY : (double)(float)(n * rng_log(&r, 20, 1e5));
        const judge_pairs p = asked(&r, w, n, f);
        dp_setup setup = camera(n, f, mapping_of(w, w->reversed));
        judgement j;
        judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
        TALLY(&own, j.verdict == JUDGE_RIGHT && is_named(&j, w),
              "%s from %s, near %g, far %g: %s %s, and %s from %s of %s, %g", w->computes, w->from, n, f,
              judge_verdict_name(j.verdict), j.named ? j.found.output->name : j.because,
              j.also ? j.other.output->name : "", j.also ? j.other.input->name : "",
              j.also ? dp_mapping_get(j.other.setup.spec.mapping)->name : "", j.decides);
        const bool has_planes = w - functions < NO_PLANES;
        if (!has_planes)
            continue;
        if (!w->far_infinite || rng_below(&r, 2)) {
            setup = camera(3 * n, 7 * n * 40, mapping_of(w, w->reversed));
        } else {
            setup = camera(n, 1000 * n, DP_MAPPING_D3D);
        }
        judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
        TALLY(&other, j.verdict == JUDGE_OTHER || j.verdict == JUDGE_UNKNOWN, "%s from %s, near %g, far %g: %s",
              w->computes, w->from, n, f, judge_verdict_name(j.verdict));
        if (strcmp(w->computes, "eye depth") != 0 && strcmp(w->from, "minus eye depth") != 0)
            continue;
        judge_function(&p, &setup, 1, JUDGE_OPEN, &j);
        TALLY(&found,
              j.named && fabs(j.found.setup.spec.znear / n - 1) < 1e-4 &&
                  (w->far_infinite || fabs(1 / j.found.setup.spec.zfar - 1 / f) < 1e-5 / n),
              "near %g, far %g: %s %g %g", n, f, judge_verdict_name(j.verdict), j.named ? j.found.setup.spec.znear : 0,
              j.named ? j.found.setup.spec.zfar : 0);
    }
    tally_end(&own);
    tally_end(&other);
    tally_end(&found);
}

/* In front of near a window depth may be clamped to its range: that is right, and loses nothing; the other end is not.
 */
TEST(test_clamped) {
    for (int way = 0; way < 4; way++) {
        const bool turned = way % 2 == 1, other = way / 2 == 1;
        const float n = 0.25F, f = 90;
        judge_pairs p = {.pairs = pair_room, .count = PAIRS, .distinct = PAIRS};
        const dp_setup setup = camera((double)n, (double)f, turned ? DP_MAPPING_REVERSED : DP_MAPPING_D3D);
        judgement j;
        int beyond = 0;
        for (int k = 0; k < PAIRS; k++) {
            const float z = n * (0.3F + 4 * ((float)k + 0.5F) / PAIRS);
            const float d = turned ? stored_reversed(z, n, f) : stored(z, n, f), held = fminf(fmaxf(d, 0), 1);
            const bool out = d != held;
            p.pairs[k] = (judge_pair){(double)z, (double)(out && other ? 1 - held : held)};
            beyond += out;
        }
        assert_true(beyond > 3 && beyond < PAIRS / 2);
        judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
        if ((j.verdict == JUDGE_RIGHT) == other || (!other && j.off > 0x1p-20))
            fail_msg("%s, %s: %s, off by %g", turned ? "reversed" : "d3d", other ? "at the other end" : "clamped",
                     judge_verdict_name(j.verdict), j.off);
    }
}

/* Orthographic planes are found from what is read and what is written: from window depth and to it, of either sign of
 * the axis, in either direction. */
TEST(test_orthographic_planes) {
    tally t = {.name = "orthographic planes"};
    rng r = rng_make("orthographic planes");
    for (uint64_t i = test_cases(100, 400, 4000); i > 0; i--) {
        const float n = (float)rng_log(&r, 0.01, 10), f = n + (float)rng_log(&r, 1, 1e4);
        const bool encodes = rng_below(&r, 2), minus = rng_below(&r, 2), turned = rng_below(&r, 2);
        judge_pairs p = {.pairs = pair_room, .count = PAIRS, .distinct = PAIRS};
        for (int k = 0; k < PAIRS; k++) {
            const float share = (float)((k + rng_unit(&r)) / PAIRS), d = turned ? 1 - share : share;
            const float z = n + share * (f - n), eye = minus ? -z : z;
            const bool from_last = encodes ? minus : turned; /* sorted by what is read */
            p.pairs[from_last ? PAIRS - 1 - k : k] =
                encodes ? (judge_pair){(double)eye, (double)(turned ? (f - z) / (f - n) : (z - n) / (f - n))}
                        : (judge_pair){(double)d, (double)eye};
        }
        dp_spec spec = dp_spec_default();
        dp_setup setup;
        spec.ortho = 1;
        spec.znear = 0.3;
        spec.zfar = 70;
        spec.mapping = turned ? DP_MAPPING_REVERSED : DP_MAPPING_D3D;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        judgement j;
        judge_function(&p, &setup, 1, JUDGE_OPEN, &j);
        const dp_spec *found = &j.found.setup.spec;
        TALLY(&t,
              j.named && found->ortho && fabs(found->znear - (double)n) < 1e-4 * (double)f &&
                  fabs(found->zfar / (double)f - 1) < 1e-4,
              "near %g, far %g, %s%s%s: %s, %g, %g", (double)n, (double)f, encodes ? "written" : "read",
              minus ? ", behind" : "", turned ? ", reversed" : "", judge_verdict_name(j.verdict),
              j.named ? found->znear : 0, j.named ? found->zfar : 0);
    }
    tally_end(&t);
}

/* One plane is given: what agrees with it is right and has the other plane; a plane that does not agree is another. */
TEST(test_one_plane_given) {
    tally t = {.name = "one plane given"};
    rng r = rng_make("one plane");
    for (int i = 0; i < 60; i++) {
        const int far_open = i % 2, k = i % 3 == 0 ? 7 : i % 3 == 1 ? 0 : VIEW; /* of a ratio, of eye depth, encoded */
        const double n = (double)(float)rng_log(&r, 0.01, 10), f = (double)(float)(n * rng_log(&r, 50, 5e3));
        const judge_pairs p = asked(&r, &functions[k], n, f);
        const double wrong = rng_log(&r, 1.5, 20);
        for (int agrees = 0; agrees < 2; agrees++) {
            const double near = far_open ? n * (agrees ? 1 : wrong) : n / 30, far = far_open ? 1e6 * n
                                                                                    : agrees ? f
                                                                                             : f * wrong;
            const dp_setup setup = camera(near, far, DP_MAPPING_D3D);
            judgement j;
            judge_function(&p, &setup, 1, far_open ? JUDGE_OPEN_FAR : JUDGE_OPEN_NEAR, &j);
            const dp_spec *found = &j.found.setup.spec;
            const bool ratio = k == 7, kept = j.named && (far_open ? found->znear == near : found->zfar == far);
            const bool fits = j.named && fabs(found->zfar / found->znear / (f / n) - 1) < 1e-2;
            TALLY(&t, agrees || ratio ? j.verdict == JUDGE_RIGHT && kept && fits : j.verdict != JUDGE_RIGHT,
                  "%s, near %.9g, far %.9g, given %.9g, %.9g: %s, near %.9g, far %.9g", functions[k].computes, n, f,
                  near, far, judge_verdict_name(j.verdict), found->znear, found->zfar);
        }
    }
    tally_end(&t);
}

/* Far is 10^4 times near and went in: a line that fits may have it a little nearer. */
TEST(test_far_plane_asked) {
    tally t = {.name = "far plane asked"};
    rng r = rng_make("far plane");
    for (int i = 0; i < 50; i++) {
        const double n = (double)(float)rng_log(&r, 0.01, 10), f = (double)(float)(n * rng_log(&r, 1e4, 1e5));
        judge_pairs p = asked(&r, &functions[VIEW], n, f);
        const dp_setup setup = camera(3 * n, 7 * n * 40, DP_MAPPING_D3D);
        judgement j;
        p.pairs[0] = (judge_pair){-f, (double)stored_view((float)-f, (float)n, (float)f)};
        judge_function(&p, &setup, 1, JUDGE_OPEN, &j);
        TALLY(&t, j.named && fabs(j.found.setup.spec.znear / n - 1) < 1e-4 && j.found.setup.spec.zfar >= f * (1 - 1e-6),
              "near %g, far %g: %g %g", n, f, j.named ? j.found.setup.spec.znear : 0,
              j.named ? j.found.setup.spec.zfar : 0);
    }
    tally_end(&t);
}

/* The other direction is another set-up, a factor is one, and both are named. */
TEST(test_other) {
    rng r = rng_make("judged otherwise");
    for (int i = 0; i < 200; i++) {
        const double n = (double)(float)rng_log(&r, 0.01, 10), f = (double)(float)(n * rng_log(&r, 50, 1e4));
        judge_pairs p = asked(&r, &functions[9], n, f);
        dp_setup setup = camera(n, f, DP_MAPPING_D3D);
        judgement j;
        judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
        assert_int_equal(j.verdict, JUDGE_OTHER);
        assert_true(j.found.setup.reversed && j.found.setup.spec.znear == n && !j.also);
        p = asked(&r, &functions[0], n, f);
        const double factor = rng_log(&r, 1e-3, 1e3);
        for (int k = 0; k < PAIRS; k++)
            p.pairs[k].out = (double)(float)(p.pairs[k].out * factor);
        judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
        assert_int_equal(j.verdict, JUDGE_OTHER);
        assert_true(fabs(j.found.factor / factor - 1) < 1e-6 || j.found.setup.spec.znear != n);
    }
}

/* An article's slip, and a depth that was made NDC first: each by its name. */
TEST(test_wrong) {
    rng r = rng_make("judged wrong");
    for (int i = 0; i < 200; i++) {
        const double n = (double)(float)rng_log(&r, 0.05, 5), f = (double)(float)(n * rng_log(&r, 100, 1e4));
        judge_pairs p = asked(&r, &functions[0], n, f);
        dp_setup setup = camera(n, f, DP_MAPPING_GL);
        judgement j;
        for (int k = 0; k < PAIRS; k++)
            p.pairs[k].out = f / ((1 - n / f) * p.pairs[k].in + f / n);
        judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
        assert_int_equal(j.verdict, JUDGE_WRONG);
        assert_string_equal(j.found.trap->name, "inverted-x");
        for (int k = 0; k < PAIRS; k++)
            p.pairs[k].out = n * f / (f - (2 * p.pairs[k].in - 1) * (f - n));
        judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
        assert_int_equal(j.verdict, JUDGE_WRONG);
        assert_string_equal(j.found.trap->name, "ndc-as-depth");
    }
}

/* d = f/(f - n) - 2 f n/((f - n) z): written it is wrong, read back a multiple, of which the slip is said besides. A
 * multiple by another number is none. */
TEST(test_doubled_product) {
    rng r = rng_make("judged doubled");
    for (int i = 0; i < 100; i++) {
        const double n = (double)(float)rng_log(&r, 0.05, 5), f = (double)(float)(n * rng_log(&r, 100, 1e4));
        const dp_setup setup = camera(n, f, DP_MAPPING_D3D);
        judge_pairs p = asked(&r, &functions[0], n, f);
        judgement j;
        for (int times = 2; times < 4; times++) {
            for (int k = 0; k < PAIRS; k++)
                p.pairs[k].out = (double)(float)(times * f * n / (f - p.pairs[k].in * (f - n)));
            judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
            assert_int_equal(j.verdict, JUDGE_OTHER);
            assert_true(j.same_count == (times == 2));
            assert_true(times != 2 || strcmp(j.same[0].trap->name, "doubled-product") == 0);
        }
        for (int k = 0; k < PAIRS; k++) {
            p.pairs[k].in = n * pow(f / n, (double)k / (PAIRS - 1));
            p.pairs[k].out = f / (f - n) - 2 * f * n / ((f - n) * p.pairs[k].in);
        }
        judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
        assert_int_equal(j.verdict, JUDGE_WRONG);
        assert_string_equal(j.found.trap->name, "doubled-product");
    }
}

/* Pairs that are none of them, too few, constant, out of order. */
TEST(test_unknown) {
    const dp_setup setup = camera(0.1, 1000, DP_MAPPING_D3D);
    rng r = rng_make("unknown");
    judge_pairs p = asked(&r, &functions[0], 0.1, 1000);
    judgement j;
    p.distinct = p.count = 2;
    judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
    assert_true(j.verdict == JUDGE_UNKNOWN && !j.named && strstr(j.because, "too few") != NULL);
    p.distinct = p.count = 4;
    judge_function(&p, &setup, 1, JUDGE_OPEN, &j);
    assert_true(j.verdict == JUDGE_UNKNOWN && strstr(j.because, "too few") != NULL);
    p.distinct = p.count = PAIRS;
    for (int k = 0; k < PAIRS; k++)
        p.pairs[k].out = 0.5;
    judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
    assert_true(j.verdict == JUDGE_UNKNOWN && strstr(j.because, "the same") != NULL);
    for (int i = 0; i < 300; i++) {
        const double power = rng_log(&r, 1.01, 8), add = rng_unit(&r);
        for (int k = 0; k < PAIRS; k++)
            p.pairs[k].out = i % 3 == 0   ? pow(p.pairs[k].in, power) + add
                             : i % 3 == 1 ? sqrt(p.pairs[k].in) * power
                                          : rng_unit(&r);
        judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
        assert_true(j.verdict == JUDGE_UNKNOWN && !j.named);
        assert_true((strstr(j.because, "neither") != NULL) == (i % 3 == 2));
    }
}

/* To eleven bits, as binary16 keeps a normal number. */
static double half_of_normal(double z) {
    int exponent;
    const double m = frexp(z, &exponent);
    return ldexp(rint(ldexp(m, 11)), exponent - 11);
}

/* The numbers of binary16 on either side: ten bits behind the first, of small ones those of 2^-14. */
static double half_beside(double v, bool up) {
    const double step = exp2(fmax(floor(log2(fabs(v))), -14) - 10), k = v / step;
    const double h = v == 0 ? 0 : (up ? ceil(k) : floor(k)) * step;
    return h > 65504 ? (up ? (double)INFINITY : 65504) : h < -65504 ? (up ? -65504 : -(double)INFINITY) : h;
}

enum { AS_BINARY32, AS_HALF, AS_CUT_HALF };

static double kept_as(int kind, double v) {
    const double lo = half_beside(v, false), hi = half_beside(v, true);
    return kind == AS_BINARY32   ? v
           : kind == AS_CUT_HALF ? (v > 0 ? lo : hi)
           : isinf(lo)           ? (v > -65520 ? hi : lo)
           : isinf(hi)           ? (v < 65520 ? lo : hi)
           : v - lo < hi - v     ? lo
                                 : hi;
}

/* Right functions, as they are and kept in binary16, rounded and cut, subnormal too, for the camera that is given: none
 * is accused, at depths spread evenly as they go in or by their logarithm. */
TEST(test_none_accused) {
    tally accused = {.name = "accused"}, right = {.name = "right"};
    rng r = rng_make("accused");
    for (uint64_t i = 0; i < test_cases(300, 600, 20000); i++) {
        const written *w = &functions[rng_below(&r, FUNCTIONS)];
        const double n = (double)(float)rng_log(&r, 0.01, 10);
        const double f = w->far_infinite ? (double)INFINITY : (double)(float)(n * rng_log(&r, 20, 1e6));
        const int kind = (int)(i % 3);
        const bool even = rng_below(&r, 2) == 0;
        judge_pairs p = asked(&r, w, n, f);
        dp_setup setup = camera(n, f, mapping_of(w, w->reversed));
        judgement j;
        for (int k = 0; k < PAIRS; k++) {
            const double lo = p.pairs[0].in, hi = p.pairs[PAIRS - 1].in;
            const float x = even ? (float)(lo + (hi - lo) * k / (PAIRS - 1)) : (float)p.pairs[k].in;
            p.pairs[k] = (judge_pair){(double)x, kept_as(kind, (double)w->of(x, (float)n, (float)f))};
        }
        p.distinct = 0;
        judge_pairs_look(&p);
        judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
        TALLY(&accused, j.verdict != JUDGE_OTHER && j.verdict != JUDGE_WRONG,
              "%s from %s, near %g, far %g, kept as %d: %s: %s from %s, %s, near %g", w->computes, w->from, n, f, kind,
              judge_verdict_name(j.verdict), j.found.output->name, j.found.input->name,
              judge_precision_name(j.precision), j.found.setup.spec.znear);
        const bool flat = j.because != NULL && strstr(j.because, "differ by") != NULL; /* or another fits alike */
        TALLY(&right, flat || j.also || (j.verdict == JUDGE_RIGHT && is_named(&j, w)),
              "%s from %s, near %g, far %g, kept as %d: %s, %s", w->computes, w->from, n, f, kind,
              judge_verdict_name(j.verdict), j.because != NULL ? j.because : j.found.output->name);
    }
    tally_end(&accused);
    tally_end(&right);
}

/* Stored in fewer bits, and printed with few digits: right still, and said. */
TEST(test_precision) {
    static const struct {
        const char *line;
        judge_precision precision;
    } prints[] = {{"%.9g,%.9g\n", JUDGE_BINARY32},
                  {"%.9g\t%.6g\n", JUDGE_PRINTED},
                  {"%.6f; %.4f\n", JUDGE_PRINTED},
                  {"%.9g,%.3e\n", JUDGE_PRINTED},
                  {"%.9g,%.2e\n", JUDGE_PRINTED}};
    const double n = 0.1, f = 1000;
    const dp_setup setup = camera(n, f, DP_MAPPING_D3D);
    char error[PAIRS_ERROR_SIZE], path[] = "/tmp/depthprec-judge-XXXXXX";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    enum { PRINTS = sizeof prints / sizeof prints[0], HALVES = PRINTS, BYTES };
    for (int i = 0; i <= BYTES; i++) {
        FILE *out = fopen(path, "w");
        judge_pairs p;
        judgement j;
        double worst = 0, at = 0;
        fprintf(out, "depth,value\n# a remark\n");
        for (int k = 0; k <= 64; k++) {
            const double d = k / 64.0, z = n * f / (f - d * (f - n)), share = z / f;
            const double byte = rint(share * 255) / 255;
            const double v = i == HALVES  ? half_of_normal(z)
                             : i == BYTES ? byte
                                          : (double)(float)z,
                         truth = i == BYTES ? share : z;
            fprintf(out, i < PRINTS ? prints[i].line : "%.9g,%.17g\n", d, v);
            if (i == HALVES && fabs(v - truth) > worst * truth) {
                worst = fabs(v - truth) / truth;
                at = d;
            }
        }
        fclose(out);
        assert_int_equal(judge_pairs_read(path, &p, error), 0);
        assert_true(p.count == 65 && p.distinct == 65 && p.nan_count == 0);
        judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
        assert_int_equal(j.verdict, JUDGE_RIGHT);
        assert_int_equal(j.precision, i < PRINTS ? prints[i].precision : i == HALVES ? JUDGE_BINARY16 : JUDGE_BYTES);
        if (i == HALVES) {
            assert_relative(j.error, worst, 1e-9);
            assert_true(j.at == at);
        }
        judge_pairs_free(&p);
    }
    unlink(path);
}

/* Beside the far plane two shares are the same in 8 bits; where it says that they part they do. */
TEST(test_decides) {
    const double n = 1, f = 10;
    const dp_setup setup = camera(n, f, DP_MAPPING_D3D);
    judge_pairs p = {.pairs = pair_room, .count = 4, .distinct = 4, .bytes = true};
    judgement j;
    for (int k = 0; k < 4; k++) { /* of 252.2 and its like 252 to 255 */
        const double share = fmin((252.2 + k) / 255, 1);
        p.pairs[k] = (judge_pair){(1 - n / (share * f)) / (1 - n / f), (252 + k) / 255.0};
    }
    judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
    assert_true(j.verdict == JUDGE_RIGHT && j.also && j.precision == JUDGE_BYTES);
    assert_string_equal(j.found.output->name, "eye depth over far");
    assert_string_equal(j.other.output->name, "the way from near to far");
    const double z = n * f / (f - j.decides * (f - n));
    assert_true(j.decides == 0 && z / f - (z - n) / (f - n) > 1.02 / 255); /* 0.1 and 0: nowhere more of the value */
}

static void write_npy(const char *path, const char *shape, const float values[6]) {
    FILE *out = fopen(path, "wb");
    const char *order = *(const char *)&(uint16_t){1} != 0 ? "<" : ">";
    char head[119];
    assert_non_null(out);
    snprintf(head, sizeof head, "{'descr': '%sf4', 'fortran_order': False, 'shape': %s, }", order, shape);
    memset(head + strlen(head), ' ', sizeof head - 2 - strlen(head));
    head[117] = '\n';
    fwrite("\x93NUMPY\x01\0\x76\0", 1, 10, out);
    fwrite(head, 1, 118, out);
    fwrite(values, sizeof *values, 6, out);
    fclose(out);
}

/* An npy file of two columns, and of two rows, and a text with values that are no numbers. */
TEST(test_read) {
    char error[PAIRS_ERROR_SIZE], path[] = "/tmp/depthprec-judge-XXXXXX.npy";
    static const struct {
        const char *shape;
        float values[6];
    } arrays[] = {{"(3, 2)", {0.5F, 2.0F, 0.25F, 3.0F, 1.0F, 4.0F}}, {"(2, 3)", {0.5F, 0.25F, 1.0F, 2.0F, 3.0F, 4.0F}}};
    const int file = mkstemps(path, 4);
    assert_true(file >= 0);
    close(file);
    judge_pairs p;
    for (size_t i = 0; i < 2; i++) {
        write_npy(path, arrays[i].shape, arrays[i].values);
        assert_int_equal(judge_pairs_read(path, &p, error), 0);
        assert_true(p.count == 3 && p.pairs[0].in == 0.25 && p.pairs[0].out == 3 && p.pairs[1].in == 0.5);
        assert_true(p.pairs[1].out == 2 && p.pairs[2].in == 1 && p.pairs[2].out == 4);
        assert_true(p.out_digits.absolute == 0 && p.out_digits.relative == 0);
        judge_pairs_free(&p);
    }
    write_npy(path, "(6, 1)", arrays[0].values);
    assert_int_equal(judge_pairs_read(path, &p, error), -1);
    assert_string_equal(error, "must have two columns, or two rows, got 6 x 1");
    unlink(path);
    FILE *out;
    path[strlen(path) - 4] = '\0';
    out = fopen(path, "w");
    fprintf(out, "0.5,nan\n0.25,1e-3\n0.75,NaN\n0.125,0.5\n");
    fclose(out);
    assert_int_equal(judge_pairs_read(path, &p, error), 0);
    assert_true(p.count == 2 && p.nan_count == 2 && p.nan_at == 0.5);
    assert_true(p.out_digits.absolute > 4.9e-4 && p.out_digits.absolute < 5.1e-4);
    judge_pairs_free(&p);
    unlink(path);
}

/* Inputs of four digits at the most were typed, and are what was meant; those of five were rounded. */
TEST(test_typed) {
    static const char *const rows[] = {"0.1234,1\n0.5,2\n", "0.12345,1\n0.5,2\n"};
    for (int i = 0; i < 2; i++) {
        char error[PAIRS_ERROR_SIZE], path[] = "/tmp/depthprec-judge-XXXXXX";
        judge_pairs p;
        FILE *out = fdopen(mkstemp(path), "w");
        fputs(rows[i], out);
        fclose(out);
        assert_int_equal(judge_pairs_read(path, &p, error), 0);
        unlink(path);
        assert_relative(p.in_digits.absolute + 1, 1 + (i == 0 ? 0 : 0.5e-5), 1e-12);
        judge_pairs_free(&p);
    }
}

/* The same pairs in every way that programs write them, and half a unit of the last digit of their values. */
TEST(test_forms) {
    static const struct {
        const char *text;
        double absolute, relative;
    } rows[] = {{"0.25,1.5\n0.5,2.25\n", 0.5e-2, 5e-3},
                {"\xEF\xBB\xBF"
                 "0.25,1.5\n0.5,2.25\n",
                 0.5e-2, 5e-3},
                {"\xEF\xBB\xBF"
                 "depth,value\n0.25,1.5\n0.5,2.25",
                 0.5e-2, 5e-3},
                {"0.25\t1.5\r\n\r\n0.5\t2.25\r\n", 0.5e-2, 5e-3},
                {"depth value\n# a remark\n  # 7 8\n0.25 1.5\n 0.5   2.25  \n", 0.5e-2, 5e-3},
                {"\"0.25\";\"1.5\"\n\"0.5\";\"2.25\"\n", 0.5e-2, 5e-3},
                {".25, +1.500e0\n5e-1, 225e-2\n", 0.5e-3, 5e-4},
                {"25.0e-2,1.50E+00\n0.0005e3,0.00225e+3\n", 0.5e-2, 5e-3},
                {"0.25,0.0015e3\n0.5,22500e-4\n", 0.5e-4, 5e-5}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char error[PAIRS_ERROR_SIZE], path[] = "/tmp/depthprec-judge-XXXXXX";
        judge_pairs p;
        FILE *out = fdopen(mkstemp(path), "w");
        fputs(rows[i].text, out);
        fclose(out);
        assert_int_equal(judge_pairs_read(path, &p, error), 0);
        unlink(path);
        if (p.count != 2 || p.pairs[0].in != 0.25 || p.pairs[0].out != 1.5 || p.pairs[1].in != 0.5 ||
            p.pairs[1].out != 2.25 || p.nan_count != 0)
            fail_msg("%zu pairs of: %s", p.count, rows[i].text);
        assert_relative(p.out_digits.absolute, rows[i].absolute, 1e-9);
        assert_relative(p.out_digits.relative, rows[i].relative, 1e-9);
        judge_pairs_free(&p);
    }
}

/* A function that loses a little more than it must is right still, and not right times 1.0000012. */
TEST(test_factor_of_one) {
    const double n = 0.1, f = 1000;
    const dp_setup setup = camera(n, f, DP_MAPPING_D3D);
    judge_pairs p = {.pairs = pair_room, .count = 9, .distinct = 9};
    judgement j;
    for (int k = 0; k < 9; k++)
        p.pairs[k] = (judge_pair){k / 8.0, n * f / (f - k / 8.0 * (f - n)) * (1 + 20 * 0x1p-24)};
    judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
    assert_int_equal(j.verdict, JUDGE_RIGHT);
    assert_int_equal(j.precision, JUDGE_DIFFERENCE);
}

/* A way from near to far tells their ratio alone. */
TEST(test_ratio) {
    rng r = rng_make("ratio");
    for (int i = 0; i < 50; i++) {
        const double n = rng_log(&r, 0.01, 10), f = n * rng_log(&r, 20, 1e4);
        const judge_pairs p = asked(&r, &functions[7], n, f);
        const dp_setup setup = camera(n, 777 * n, DP_MAPPING_D3D);
        judgement j;
        judge_function(&p, &setup, 1, JUDGE_OPEN, &j);
        assert_true(j.verdict == JUDGE_RIGHT && is_named(&j, &functions[7]));
        assert_relative(j.found.setup.spec.zfar / j.found.setup.spec.znear, f / n, 1e-3);
    }
}

/* The error in z-fighting intervals: one value that is off by a known number of them. */
TEST(test_intervals) {
    const double n = 0.5, f = 200, d = 0.75, z = n * f / (f - d * (f - n));
    dp_spec spec = dp_spec_default();
    dp_format found[2];
    dp_setup setup;
    judge_pairs p = {.pairs = pair_room, .count = 9, .distinct = 9};
    judgement j;
    dp_format_parse("unorm16", found);
    spec.format = found[0];
    spec.znear = n;
    spec.zfar = f;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    const double step = z * z * (1 / n - 1 / f) / 65535; /* dz/dd a code */
    for (int over = 0; over < 2; over++) {               /* z, and z/far */
        const double unit = over ? f : 1;
        for (int k = 0; k < 9; k++)
            p.pairs[k] = (judge_pair){k / 8.0, n * f / (f - k / 8.0 * (f - n)) / unit};
        p.pairs[6].out += 2e-3 * step / unit;
        judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
        assert_int_equal(j.verdict, JUDGE_RIGHT);
        assert_relative(j.intervals, 2e-3, 1e-3);
        assert_relative(j.z, z, 1e-12);
        assert_relative(j.error, 2e-3 * step / z, 1e-6);
        assert_true(j.at == d);
    }
}

/* Functions that are one for the camera at hand: both are named, that of the convention that was given first. */
TEST(test_same) {
    static const struct {
        double n, f;
        dp_mapping mapping;
        const char *first, *second;
        bool ortho, second_ortho;
        judge_verdict verdict;
    } cases[] = {
        {0.1, 10, DP_MAPPING_D3D, "eye depth", "reciprocal of eye depth", true, false, JUDGE_OTHER},
        {0.25, 4, DP_MAPPING_GL, "eye depth", "reciprocal of eye depth", true, false, JUDGE_OTHER},
        {0.1, 10, DP_MAPPING_REVERSED, "reciprocal of eye depth", "eye depth", false, true, JUDGE_RIGHT},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double n = cases[i].n, f = cases[i].f;
        const dp_setup setup = camera(n, f, cases[i].mapping);
        judge_pairs p = {.pairs = pair_room, .count = 33, .distinct = 33};
        judgement j;
        for (int k = 0; k < 33; k++)
            p.pairs[k] = (judge_pair){k / 32.0, n + (f - n) * (k / 32.0)};
        judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
        assert_int_equal(j.verdict, cases[i].verdict);
        assert_true(j.same_count >= 1 && !j.also);
        assert_string_equal(j.found.output->name, cases[i].first);
        assert_string_equal(j.same[0].output->name, cases[i].second);
        assert_true(j.found.setup.spec.ortho == cases[i].ortho && j.same[0].setup.spec.ortho == cases[i].second_ortho);
    }
}

/* (1 - d)/(x d + y) where little is left of 1 - d, in long double: what it is judged by loses nothing. Of rounded
 * depths that is the rounding of what went in, of exact ones next to nothing. */
TEST(test_exact_references) {
    const double n = 0.1, f = 1000;
    const dp_setup setup = camera(n, f, DP_MAPPING_REVERSED);
    judge_pairs p = {.pairs = pair_room, .count = 24, .distinct = 24};
    judgement j;
    for (int k = 0; k < 24; k++) {
        const double d = 1 - exp2(-1 - 2 * k);
        const long double q = 1 - (long double)d;
        p.pairs[k] = (judge_pair){d, (double)(q / (((long double)f / (long double)n - 1) * (long double)d + 1))};
    }
    judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
    assert_int_equal(j.verdict, JUDGE_RIGHT);
    assert_string_equal(j.found.output->name, "the way from near to far");
    assert_true(j.error < 1e-15);
    for (int k = 0; k < 24; k++) /* NDC depth where it is about 0, of eye depths: z = 2 f n/(f + n) */
    {
        const double z = 2 * f * n / (f + n) * (1 + (k - 12) * 0x1p-40);
        const long double at = (long double)z, a = (long double)n, b = (long double)f;
        p.pairs[k] = (judge_pair){z, (double)(((a + b) * at - 2 * a * b) / (at * (b - a)))};
    }
    const dp_setup gl = camera(n, f, DP_MAPPING_GL);
    const judge_candidate ndc = {
        .setup = gl, .input = judge_input_get(JUDGE_EYE), .output = judge_output_get(8), .factor = 1};
    assert_string_equal(ndc.output->name, "NDC depth");
    for (int k = 0; k < 24; k++)
        if (k < 9 || k > 15) /* long double has 11 bits more */
            assert_relative(judge_value(&ndc, p.pairs[k].in), p.pairs[k].out, 1e-7);
}

/* What each output is of an eye depth, in long double; NaN where a camera has no such thing. */
static long double output_at(const char *name, const dp_setup *s, long double z) {
    const long double n = (long double)s->spec.znear, f = (long double)s->spec.zfar;
    const bool log = s->curve == DP_CURVE_LOG;
    const long double matrix = isinf(s->spec.zfar) ? (z - n) / z : f * (z - n) / ((f - n) * z);
    const long double d = log ? (long double)NAN : s->reversed ? 1 - matrix : matrix;
    const struct {
        const char *name;
        long double value;
    } all[] = {{"eye depth", z},
               {"minus eye depth", -z},
               {"eye depth over far", z / f},
               {"the way from near to far", (z - n) / (f - n)},
               {"reciprocal of eye depth", 1 / z},
               {"window depth", d},
               {"1 minus window depth", 1 - d},
               {"window depth without the logarithm", log ? matrix : (long double)NAN},
               {"NDC depth", dp_mapping_get(s->spec.mapping)->ndc_signed ? 2 * d - 1 : (long double)NAN},
               {"code", rintl(d * 65535)}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (strcmp(all[i].name, name) == 0)
            return all[i].value;
    fail_msg("no output is called %s", name);
    return 0;
}

TEST(every_output) {
    static const dp_mapping mappings[] = {DP_MAPPING_D3D,         DP_MAPPING_GL,  DP_MAPPING_REVERSED,
                                          DP_MAPPING_GL_REVERSED, DP_MAPPING_LOG, DP_MAPPING_CESIUM};
    tally t = {.name = "outputs"};
    rng r = rng_make("outputs");
    for (uint64_t i = test_cases(100, 1000, 20000); i > 0; i--) {
        dp_spec spec = dp_spec_default();
        dp_setup s;
        dp_format format[2];
        spec.mapping = mappings[rng_below(&r, sizeof mappings / sizeof mappings[0])];
        spec.znear = rng_log(&r, 0.01, 10);
        const bool log = spec.mapping == DP_MAPPING_LOG || spec.mapping == DP_MAPPING_CESIUM;
        spec.zfar = !log && rng_below(&r, 4) == 0 ? (double)INFINITY : spec.znear * rng_log(&r, 3, 1e4);
        assert_int_equal(dp_format_parse("unorm16", format), 1);
        spec.format = format[0];
        assert_int_equal(dp_setup_init(&s, &spec), DP_OK);
        const double z = spec.znear * pow(fmin(spec.zfar / spec.znear, 1e5), rng_unit(&r));
        for (size_t k = 0; judge_output_get(k) != NULL; k++) {
            const judge_candidate c = {
                .setup = s, .input = judge_input_get(JUDGE_EYE), .output = judge_output_get(k), .factor = 1};
            const long double is = output_at(c.output->name, &s, (long double)z);
            const double got = judge_value(&c, z);
            const bool code = strcmp(c.output->name, "code") == 0; /* another one beside a tie */
            TALLY(&t,
                  isnan(is) || (isnan(got) && !isfinite((double)is)) || (is == 0 && fabs(got) < 1e-9) ||
                      fabsl(got - is) <= (code ? 1 : 1e-9L * (1 + fabsl(is))) || (isinf(spec.zfar) && !isfinite(got)),
                  "%s, %s, near %g, far %g, z %g: %g, is %Lg", c.output->name, dp_mapping_get(spec.mapping)->name,
                  spec.znear, spec.zfar, z, got, is);
        }
    }
    tally_end(&t);
}

/* A byte or two in which nothing is to be seen tell nothing, a wrong formula least of all. */
TEST(test_nearly_constant) {
    const dp_setup setup = camera(0.1, 1000, DP_MAPPING_D3D);
    judge_pairs p = {.pairs = pair_room, .count = 32};
    judgement j;
    for (int k = 0; k < 32; k++)
        p.pairs[k] = (judge_pair){k / 31.0, (128 + k % 2) / 255.0};
    judge_pairs_look(&p);
    judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
    assert_true(j.verdict == JUDGE_UNKNOWN && !j.named && strstr(j.because, "differ by") != NULL);
}

/* Digits k/256 in bytes n/255, with the lowest digit first, in 2 to 4 bytes, rounded and cut: known, and off by as much
 * as the formulas of the test say. Halfway between two bytes either may be meant. */
TEST(test_digits) {
    const dp_setup setup = camera(1, 20000, DP_MAPPING_GL);
    for (int count = 2; count <= 4; count++)
        for (int way = 0; way < 6; way++) { /* the last digit the rest, a whole one, less a 256th */
            const int cut = way % 2, last = way / 2;
            judge_pairs p = {.pairs = pair_room, .count = PAIRS};
            judgement j;
            double off = 0;
            for (int k = 0; k < PAIRS; k++) {
                const double d = (k + 0.37) / PAIRS;
                double v = 0;
                for (int i = 0; i < count; i++) {
                    const double rest = fmod(d * pow(256, i), 1);
                    const double digit = i + 1 < count || last == 1 ? floor(rest * 256) / 256
                                         : last == 2                ? rest - rest / 256
                                                                    : rest;
                    v += floor(digit * 255 + (cut ? 0 : 0.5)) / 255 / pow(256, i);
                }
                p.pairs[k] = (judge_pair){d, v};
                off = fmax(off, fabs(v - d));
            }
            judge_pairs_look(&p);
            judge_function(&p, &setup, 1, JUDGE_OPEN_NONE, &j);
            assert_int_equal(j.verdict, JUDGE_RIGHT);
            assert_string_equal(j.found.output->name, "window depth");
            assert_string_equal(judge_precision_name(j.precision), "digits k/256 in bytes n/255");
            assert_relative(j.off, off, 1e-12);
            assert_true(off > (cut ? 3.5e-3 : 1.7e-3) && off < (cut ? 1.01 / 255 : 2.02e-3));
        }
}

/* People are told what each candidate is called and where it is defined. */
TEST(candidates_have_sources) {
    for (size_t i = 0; judge_output_get(i) != NULL; i++) {
        const judge_output *o = judge_output_get(i);
        assert_true(o->formula[0] != '\0' && o->called[0] != NULL && o->source != NULL && o->source[0] != '\0');
        for (size_t k = 0; k < i; k++)
            assert_string_not_equal(o->name, judge_output_get(k)->name);
    }
}
