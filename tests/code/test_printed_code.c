/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Whatever `code` prints, row by row and in every language, is read back from its text and computed as loosely as the
 * language lets it, on what is special: axes, edges of octants, zeros of either sign, ends of ranges, numbers that
 * are flushed. No result is off by more than is said of it. The truth is the definition in long double.
 */
#include "allowed.h"
#include "code/code.h"
#include "code/write.h"
#include "oracle.h"

enum { VARIANTS = 8, EITHER = 6, SPECIAL = 64 };

/* From EITHER on each operation is off as far as it may be, in a direction of its own. */
static device variant(rng *r, size_t p, int i) {
    device v = device_of(r, p, i);
    v.bias = i < EITHER ? v.bias : 2;
    return v;
}

static output printed; /* what is printed, and never written */

static const code_language *begin(size_t p) {
    printed = (output){.fd = -1};
    const code_language *l = code_language_get(p);
    assert_string_equal(l->name, promises[p].name);
    return l;
}

static const char *text(void) {
    assert_true(printed.used < sizeof printed.buffer);
    printed.buffer[printed.used] = '\0';
    return printed.buffer;
}

static size_t special_depths(rng *r, float d[SPECIAL]) {
    static const float some[] = {0,           -0.0f,        0x1p-149f,      0x1p-140f,  0x1.fp-127f, 0x1p-126f,
                                 0x1.8p-126f, 0x1p-33f,     0x1p-25f,       0x1.8p-25f, 0x1p-24f,    0x1p-17f,
                                 0x1p-16f,    0x1p-8f,      0.25f,          0.4999999f, 0.5f,        0x1.000002p-1f,
                                 0.75f,       0x1.fep-1f,   0x1.fffffcp-1f, 1,          1 / 255.0f,  254 / 255.0f,
                                 0.5f / 255,  254.5f / 255, 0x1.fffffep-1f};
    size_t count = sizeof some / sizeof some[0];
    memcpy(d, some, sizeof some);
    for (int k = 0; count + 2 < SPECIAL; k++) { /* beside ties of channels */
        d[count++] = (float)(((double)rng_below(r, 65025) + 0.5) / 65025);
        d[count++] = (float)(((double)rng_below(r, 16777215) + 0.5) / 16777215);
    }
    return count;
}

/* ---- Expressions ------------------------------------------------------------------------------------------------- */

/* A random expression with all its parentheses, of some depth; a sign is behind no other. */
static void draw(rng *r, int depth, bool sign, char *out, size_t size) {
    static const char *const leaves[] = {"d", "n", "f", "N", "W", "2", "0.5"};
    static const char operators[] = "+-*/";
    char one[512], two[512];
    const uint64_t kind = depth > 0 ? rng_below(r, 10) : 9;
    if (kind == 9) {
        snprintf(out, size, "%s", leaves[rng_below(r, sizeof leaves / sizeof leaves[0])]);
    } else if (kind == 8 && sign) {
        draw(r, depth - 1, false, one, sizeof one);
        snprintf(out, size, "(-%s)", one);
    } else {
        draw(r, depth - 1, sign, one, sizeof one);
        draw(r, depth - 1, sign, two, sizeof two);
        snprintf(out, size, "(%s%c%s)", one, operators[rng_below(r, 4)], two);
    }
}

static bool same(const steps *a, int i, const steps *b, int j) {
    const steps_node *x = &a->node[i], *y = &b->node[j];
    if (x->kind != y->kind || x->value != y->value || strcmp(x->name, y->name) != 0)
        return false;
    const int operands = x->kind <= STEPS_NAME ? 0 : x->kind == STEPS_NEGATIVE ? 1 : 2;
    for (int k = 0; k < operands; k++)
        if (!same(a, x->of[k], b, y->of[k]))
            return false;
    return true;
}

/* What is written without the parentheses that it need not have is read as the same operations in the same order. */
TEST(test_expressions) {
    tally t = {.name = "expressions"};
    rng r = rng_make("expressions");
    for (uint64_t n = test_cases(2000, 5000, 50000); n > 0; n--) {
        static steps given, back;
        char full[2048] = "x=", written[CODE_TEXT_SIZE] = "x=";
        draw(&r, 1 + (int)rng_below(&r, 4), true, full + 2, sizeof full - 2);
        steps_read(full, &given);
        const code_writer w = {.l = code_language_find("glsl"), .steps = &given, .span = ""};
        code_expression(&w, given.step[0].is, 0, written);
        steps_read(written, &back);
        TALLY(&t, same(&given, given.step[0].is, &back, back.step[0].is), "%s is written as %s", full, written);
    }
    tally_end(&t);
}

/* ---- Cameras ----------------------------------------------------------------------------------------------------- */

static const double planes[][2] = {{0.1, 1000}, {0.1, INFINITY},   {1, 1.00001},     {1e-12, 1e18}, {1e12, 1e18},
                                   {1e-12, 1},  {1e-12, INFINITY}, {1e12, INFINITY}, {3, 3.5},      {0.25, 64}};
enum { PLANES = sizeof planes / sizeof planes[0] };

static long double eye_of(const dp_setup *s, float d) {
    const long double n = s->spec.znear, f = s->spec.zfar, q = s->reversed ? d : 1 - (long double)d;
    return isinf(s->spec.zfar) ? n / q : n * f / (n + (f - n) * q);
}

static bool is_promised(const dp_setup *s, float d, double bound) {
    const long double q = s->reversed ? d : 1 - (long double)d;
    return isfinite(bound) && (isfinite(s->spec.zfar) || q > 0x1p-125L) && eye_of(s, d) <= 0x1p125L;
}

static void check_eyes(tally *t, rng *r, size_t p, const method_row *row, const dp_setup *s) {
    float d[SPECIAL];
    const size_t count = special_depths(r, d);
    const code_said said = code_function(&printed, begin(p), row, s, false);
    const double bound = said.claims[0].bound;
    for (size_t i = 0; i < count * VARIANTS; i++) {
        const device v = variant(r, p, (int)(i / count));
        const float at = d[i % count];
        double z[4];
        if (!is_promised(s, at, bound))
            continue;
        printed_compute(text(), "eye_depth", p, &v, &at, z);
        const double off = (double)(fabsl(z[0] - eye_of(s, at)) / eye_of(s, at));
        TALLY(t, off <= bound, "%s in %s, %s, near %g, far %g, d %a: off by %g of %g", row->name, promises[p].name,
              dp_mapping_get(s->spec.mapping)->name, s->spec.znear, s->spec.zfar, (double)at, off, bound);
    }
}

TEST(every_eye_depth_keeps_its_bound) {
    rng r = rng_make("printed eyes");
    tally t = {.name = "eye depths"};
    for (size_t p = 0; p < PROMISES; p++)
        for (size_t k = 0; k < 2 * (size_t)PLANES; k++)
            for (size_t i = 0; i < *linearize_family.method_count; i++) {
                dp_setup s;
                assert_int_equal(method_setup(&linearize_family, k % 2, planes[k / 2][0], planes[k / 2][1], false, &s),
                                 DP_OK);
                if (code_lacks(begin(p), &linearize_family.methods[i], &s) == NULL)
                    check_eyes(&t, &r, p, &linearize_family.methods[i], &s);
            }
    assert_true(t.cases > 100000);
    tally_end(&t);
}

/* ---- Up to which depth ------------------------------------------------------------------------------------------- */

/* The depth that a comment names in "up to a depth of N"; NAN where it names none. */
static double said_depth(const char *comment) {
    static const char words[] = "up to a depth of ";
    char flat[4096];
    size_t used = 0;
    for (; *comment != '\0' && used + 1 < sizeof flat; comment++) { /* without the breaks of its lines */
        const bool blank = strchr(" \n/#", *comment) != NULL;
        if (!blank || (used > 0 && flat[used - 1] != ' '))
            flat[used++] = blank ? ' ' : *comment;
    }
    flat[used] = '\0';
    const char *found = strstr(flat, words);
    return found != NULL ? strtod(found + sizeof words - 1, NULL) : (double)NAN;
}

/*
 * With an infinite far plane the bound holds where the window depth near/z is no number that is flushed, twice the
 * least of the normal ones, or, where none is, the least of all; and z is no more than that from the largest. No depth
 * is promised beyond that, and none of three digits short of it is left out.
 */
TEST(no_depth_is_said_that_is_flushed) {
    rng r = rng_make("up to a depth");
    tally t = {.name = "depths"};
    for (uint64_t n = test_cases(20, 60, 3000); n > 0; n--)
        for (size_t p = 0; p < PROMISES; p++)
            for (size_t i = 0; i < *linearize_family.method_count; i++) {
                const method_row *row = &linearize_family.methods[i];
                const double znear = rng_log(&r, 1e-11, 1e11);
                dp_setup s;
                assert_int_equal(method_setup(&linearize_family, 1, znear, INFINITY, false, &s), DP_OK);
                if (code_lacks(begin(p), row, &s) != NULL)
                    continue;
                code_function(&printed, begin(p), row, &s, false);
                const double said = said_depth(text());
                const long double least = promises[p].flushes ? 0x1p-125L : 0x1p-149L;
                const long double most = fminl(s.spec.znear / least, promises[p].flushes ? 0x1p125L : 0x1p127L);
                TALLY(&t, isnan(said) || (said <= most && said >= 0.99L * most), "%s in %s, near %.17g: %.17g, not %Lg",
                      row->name, promises[p].name, znear, said, most);
            }
    assert_true(t.cases > 200);
    tally_end(&t);
}

/* ---- Depth ranges ------------------------------------------------------------------------------------------------ */

/* The eye depth of a window depth; the ends are those that binary32 has. */
static long double eye_in_range(const dp_setup *s, const float ends[2], float d) {
    const long double n = s->spec.znear, f = s->spec.zfar,
                      q = (s->reversed ? (long double)d - ends[0] : (long double)ends[1] - d) /
                          ((long double)ends[1] - ends[0]);
    return isinf(s->spec.zfar) ? n / q : n * f / (n + (f - n) * q);
}

/* A window depth in the range: an end, the numbers next to it, others close to it, or any. */
static float depth_in_range(rng *r, const float ends[2]) {
    const int kind = (int)rng_below(r, 7);
    const float width = ends[1] - ends[0], part = (float)rng_log(r, 0x1p-30, 1) * width;
    const float d = kind == 0   ? ends[0]
                    : kind == 1 ? ends[1]
                    : kind == 2 ? nextafterf(ends[0], 1)
                    : kind == 3 ? nextafterf(ends[1], 0)
                    : kind == 4 ? ends[0] + part
                    : kind == 5 ? ends[1] - part
                                : ends[0] + width * (float)rng_unit(r);
    return fminf(fmaxf(d, ends[0]), ends[1]);
}

/* @return the greatest share of its bound that it is off by */
static double check_range(tally *t, rng *r, size_t p, const method_row *row, const dp_setup *s) {
    const double *asked = s->spec.depth_range;
    const float ends[] = {(float)fmin(asked[0], asked[1]), (float)fmax(asked[0], asked[1])};
    const code_said said = code_function(&printed, begin(p), row, s, false);
    const double bound = said.claims[0].bound;
    double most = 0;
    for (int i = 0; i < 40 * VARIANTS && isfinite(bound); i++) {
        const device v = variant(r, p, i % VARIANTS);
        const float at = depth_in_range(r, ends);
        const long double is = eye_in_range(s, ends, at);
        double z[4];
        if (!isfinite(is) || is > 0x1p125L || (ends[0] == 0 && at < 0x1p-125f))
            continue;
        printed_compute(text(), "eye_depth", p, &v, &at, z);
        const double off = (double)(fabsl(z[0] - is) / is);
        most = fmax(most, off / bound);
        TALLY(t, off <= bound, "%s in %s, %s, near %g, far %g, range %.9g:%.9g, d %a: off by %g of %g", row->name,
              promises[p].name, dp_mapping_get(s->spec.mapping)->name, s->spec.znear, s->spec.zfar, asked[0], asked[1],
              (double)at, off, bound);
    }
    return most;
}

TEST(every_eye_depth_of_a_range_keeps_its_bound) {
    rng r = rng_make("printed ranges");
    tally t = {.name = "eye depths of depth ranges"}, loose = {.name = "slack of their bounds"};
    size_t functions = 0;
    for (uint64_t k = test_cases(60, 300, 2000); k > 0; k--) {
        const double *pair = planes[k % PLANES];
        dp_spec spec = dp_spec_default();
        dp_setup s;
        double best = 0, least = INFINITY;
        spec.mapping = (dp_mapping)rng_below(&r, DP_MAPPING_GL_REVERSED + 1);
        spec.format = oracle_float(8, 23, 127);
        spec.znear = k % 3 == 0 ? rng_log(&r, 1e-3, 1e3) : pair[0];
        spec.zfar = k % 3 == 0 ? spec.znear * rng_log(&r, 1.1, 1e7) : pair[1];
        rng_range(&r, spec.depth_range);
        if (dp_setup_init(&s, &spec) != DP_OK || !s.ranged)
            continue;
        for (size_t i = 0; i < *linearize_family.method_count; i++)
            for (size_t p = 0; p < PROMISES; p++) {
                const method_row *row = &linearize_family.methods[i];
                if (code_lacks(begin(p), row, &s) != NULL)
                    continue;
                functions++;
                best = fmax(best, check_range(&t, &r, p, row, &s));
                least = fmin(least, code_bound(begin(p), row, &s));
            }
        /* Some language and some depth come near the bound of the function. */
        TALLY(&loose, best >= 0.3, "near %g, far %g, range %.9g:%.9g: off by %g of the bound at most", spec.znear,
              spec.zfar, spec.depth_range[0], spec.depth_range[1], best);
        TALLY(&loose, least <= 2.5e-6, "near %g, far %g, range %.9g:%.9g: no function is better than %g", spec.znear,
              spec.zfar, spec.depth_range[0], spec.depth_range[1], least);
    }
    assert_true(functions > 200);
    tally_end(&t);
    tally_end(&loose);
}

/* ---- Codes ------------------------------------------------------------------------------------------------------- */

TEST(every_code_keeps_its_bound) {
    rng r = rng_make("printed codes");
    tally t = {.name = "codes"};
    float d[SPECIAL];
    const size_t count = special_depths(&r, d);
    for (size_t p = 0; p < PROMISES; p++)
        for (size_t k = 0; k < encode_family.case_count; k++)
            for (size_t i = 0; i < *encode_family.method_count; i++) {
                dp_setup s;
                const method_row *row = &encode_family.methods[i];
                assert_int_equal(method_setup(&encode_family, k, 0.1, 1000, false, &s), DP_OK);
                if (s.spec.format.kind != DP_FORMAT_UNORM || code_lacks(begin(p), row, &s) != NULL)
                    continue;
                const code_said said = code_function(&printed, begin(p), row, &s, false);
                for (size_t j = 0; j < count * VARIANTS && !isnan(said.claims[0].bound); j++) {
                    const device v = variant(&r, p, (int)(j / count));
                    double code[4];
                    printed_compute(text(), "depth_code", p, &v, &d[j % count], code);
                    const double exact = (double)d[j % count] * s.spec.format.code_max, off = fabs(code[0] - exact);
                    TALLY(&t, off <= said.claims[0].bound && code[0] <= s.spec.format.code_max,
                          "%s in %s of %s, d %a: off by %g of %g", row->name, promises[p].name, s.spec.format.name,
                          (double)d[j % count], off, said.claims[0].bound);
                }
            }
    assert_true(t.cases > 10000);
    tally_end(&t);
}

/* ---- Linear and logarithmic depth -------------------------------------------------------------------------------- */

static const struct {
    dp_mapping mapping;
    bool ortho;
} curves[] = {{DP_MAPPING_LINEAR, false},   {DP_MAPPING_LOG, false},         {DP_MAPPING_CESIUM, false},
              {DP_MAPPING_OSGEARTH, false}, {DP_MAPPING_THREE_WEBGL, false}, {DP_MAPPING_THREE_WEBGPU, false},
              {DP_MAPPING_D3D, true},       {DP_MAPPING_REVERSED, true},     {DP_MAPPING_GL, true}};

static void check_curve(tally *t, rng *r, size_t p, const dp_setup *s, bool there) {
    float d[SPECIAL];
    const size_t count = special_depths(r, d);
    const code_said said = code_curve(&printed, begin(p), s, there, false);
    const long double n = s->spec.znear, f = s->spec.zfar;
    const dp_mapping_row *mapping = dp_mapping_get(s->spec.mapping);
    const long double from = mapping->log_from_near || mapping->log_over_near ? n : 0,
                      c = mapping->log_over_near ? 1 / n : s->spec.log_c;
    for (size_t i = 0; i < count * VARIANTS && isfinite(said.claims[0].bound); i++) {
        const device v = variant(r, p, (int)(i / count));
        float at = d[i % count];
        double got[4];
        long double is, of = 1;
        if (s->spec.ortho)
            is = s->reversed ? f - (f - n) * at : n + (f - n) * at;
        else if (s->curve == DP_CURVE_LINEAR)
            is = f * at;
        else {
            is = from + (exp2l(at * log2l(c * (f - from) + 1)) - 1) / c;
            of = mapping->log_over_near ? is : is + 1 / c;
        }
        if (there) { /* from near to far */
            at = fminf(fmaxf((float)is, nextafterf((float)n, INFINITY)), nextafterf((float)f, 0));
            is = s->curve == DP_CURVE_LINEAR ? at / f : log2l(c * (at - from) + 1) / log2l(c * (f - from) + 1);
            of = 1;
        }
        printed_compute(text(), there ? "window_depth" : "eye_depth", p, &v, &at, got);
        const double off = (double)(fabsl(got[0] - is) / of);
        TALLY(t, off <= said.claims[0].bound, "%s %s in %s, near %g, far %g, C %g, %a: off by %g of %g", mapping->name,
              there ? "there" : "back", promises[p].name, s->spec.znear, s->spec.zfar, s->spec.log_c, (double)at, off,
              said.claims[0].bound);
    }
}

TEST(every_curve_keeps_its_bound) {
    static const double cs[] = {1, 1e-3, 1e3};
    rng r = rng_make("printed curves");
    tally t = {.name = "curves"};
    for (size_t p = 0; p < PROMISES; p++)
        for (size_t m = 0; m < sizeof curves / sizeof curves[0]; m++)
            for (size_t k = 0; k < 3 * (size_t)PLANES; k++) {
                dp_spec spec = dp_spec_default();
                dp_setup s;
                spec.mapping = curves[m].mapping;
                spec.ortho = curves[m].ortho;
                spec.znear = planes[k / 3][0];
                spec.zfar = planes[k / 3][1];
                spec.log_c = cs[k % 3];
                if (dp_setup_init(&s, &spec) != DP_OK)
                    continue;
                check_curve(&t, &r, p, &s, false);
                if (!spec.ortho)
                    check_curve(&t, &r, p, &s, true);
            }
    assert_true(t.cases > 100000);
    tally_end(&t);
}

/* ---- Places and matrices ----------------------------------------------------------------------------------------- */

static texture_camera view_of(const dp_setup *s) {
    texture_camera camera;
    camera_spec spec = camera_spec_default();
    spec.width = 1920;
    spec.height = 1080;
    assert_null(camera_init(&camera, s, &spec));
    return camera;
}

static void check_places(tally *t, rng *r, size_t p, const method_row *row, const texture_camera *camera) {
    float d[SPECIAL];
    const dp_setup *s = &camera->setup;
    const size_t count = special_depths(r, d);
    const code_said said = code_places(&printed, begin(p), row, camera, false);
    const double bound = said.claims[1].bound;
    for (size_t i = 0; i < count * VARIANTS; i++) {
        static const float centres[2][8] = {{0.5f, 1.5f, 959.5f, 960, 960.5f, 1919.5f, 0, 1920},
                                            {0.5f, 1.5f, 539.5f, 540, 540.5f, 1079.5f, 0, 1080}};
        const int side = (int)(i % 2),
                  size = (int)(side == 0 ? camera->width : camera->height); /* x to the right, y up */
        const device v = variant(r, p, (int)(i / count));
        float at = d[i % count], in[2] = {centres[side][rng_below(r, 8)], 0};
        double z[4], x[4];
        if (!is_promised(s, at, bound))
            continue;
        printed_compute(text(), "eye_depth", p, &v, &at, z);
        in[1] = (float)z[0];
        printed_compute(text(), side == 0 ? "view_x" : "view_y", p, &v, in, x);
        const long double share = 2 * (long double)in[0] / size - 1;
        const long double is = (side == 0 ? share : -share) * camera->half[side] * eye_of(s, at);
        const double off = (double)fabsl(x[0] - is);
        TALLY(t, off <= bound * fabsl(is), "places in %s, near %g, d %a, %s %g: off by %g of %Lg", promises[p].name,
              s->spec.znear, (double)at, side == 0 ? "column" : "row", (double)in[0], off, bound * fabsl(is));
    }
}

/* The entries by their definition, rounded once. */
static void check_matrix(tally *t, size_t p, const texture_camera *camera) {
    const dp_setup *s = &camera->setup;
    const long double n = s->spec.znear, f = s->spec.zfar, far = isinf(s->spec.zfar) ? 1 : f / (f - n),
                      off = isinf(s->spec.zfar) ? n : n * f / (f - n);
    const long double wanted[16] = {1 / camera->half[0],
                                    0,
                                    0,
                                    0,
                                    0,
                                    1 / camera->half[1],
                                    0,
                                    0,
                                    0,
                                    0,
                                    s->reversed ? (isinf(s->spec.zfar) ? 0 : n / (f - n)) : -far,
                                    s->reversed ? off : -off,
                                    0,
                                    0,
                                    -1,
                                    0};
    const code_language *l = begin(p);
    code_projection(&printed, l, camera);
    const char *at = strstr(text(), l->matrix);
    assert_non_null(at);
    at += strlen(l->matrix);
    for (int i = 0; i < 16; i++) {
        const long double is = wanted[l->by_rows ? i : i % 4 * 4 + i / 4];
        at += strcspn(at, "-0123456789");
        char *end;
        const float entry = strtof(at, &end);
        at = end;
        TALLY(t, fabsl(entry - is) <= 0x1p-24L * (1 + 1e-6L) * fabsl(is), "%s, near %g, far %g, entry %d: %a, %Lg",
              promises[p].name, s->spec.znear, s->spec.zfar, i, (double)entry, is);
    }
}

TEST(every_place_and_matrix_keeps_its_bound) {
    rng r = rng_make("printed places");
    tally t = {.name = "places"};
    for (size_t p = 0; p < PROMISES; p++)
        for (size_t k = 0; k < 2 * (size_t)PLANES; k++) {
            dp_setup s;
            assert_int_equal(method_setup(&linearize_family, k % 2, planes[k / 2][0], planes[k / 2][1], false, &s),
                             DP_OK);
            const texture_camera camera = view_of(&s);
            check_places(&t, &r, p, code_best(code_language_get(p), &linearize_family, &s), &camera);
            check_matrix(&t, p, &camera);
        }
    assert_true(t.cases > 50000);
    tally_end(&t);
}

/* Orthographic rays are parallel: no depth goes in. */
TEST(every_parallel_place_keeps_its_bound) {
    rng r = rng_make("printed parallel places");
    tally t = {.name = "parallel places"};
    for (size_t p = 0; p < PROMISES; p++)
        for (int k = 0; k < 20; k++) {
            dp_setup s;
            dp_spec spec = dp_spec_default();
            texture_camera camera;
            camera_spec view = camera_spec_default();
            spec.ortho = 1;
            assert_int_equal(dp_setup_init(&s, &spec), DP_OK);
            view.width = 1 + (uint32_t)rng_below(&r, 4000);
            view.height = 1 + (uint32_t)rng_below(&r, 4000);
            view.half_height = rng_log(&r, 1e-3, 1e3);
            assert_null(camera_init(&camera, &s, &view));
            const code_said said = code_places(&printed, begin(p), NULL, &camera, false);
            for (int i = 0; i < 40; i++) {
                const int side = i % 2;
                const uint32_t size = side == 0 ? view.width : view.height;
                const float in = (float)rng_below(&r, size) + 0.5f;
                const device v = variant(&r, p, i % VARIANTS);
                const long double half =
                    (long double)view.half_height * (side == 0 ? (long double)view.width / view.height : 1);
                const long double share = 2 * (long double)in / size - 1, is = (side == 0 ? share : -share) * half;
                double x[4];
                printed_compute(text(), side == 0 ? "view_x" : "view_y", p, &v, &in, x);
                TALLY(&t, fabsl(x[0] - is) <= said.claims[1].bound * fabsl(is), "%s, %u of %u: %g, is %Lg",
                      promises[p].name, (unsigned)in, size, x[0], is);
            }
        }
    tally_end(&t);
}

/* ---- Depth in channels ------------------------------------------------------------------------------------------- */

static int channels_of(const packing *p, int channel[4]) {
    int count = 0;
    for (uint32_t k = 0; k < p->channels; k++)
        if (p->weight[k] > 0)
            channel[count++] = (int)k;
    return count;
}

/* A depth outside the range is taken at its end. @return the share of the bound that is used, beyond half a step */
static double check_packing(tally *t, rng *r, size_t p, const packing *row) {
    enum { TIES = 120 };
    float d[SPECIAL + TIES + 4];
    double beyond = 0;
    size_t count = special_depths(r, d);
    int channel[4];
    const int channels = channels_of(row, channel);
    const code_said said = code_packing(&printed, begin(p), row);
    const double most = row->steps > 0x1p24 ? 255 : row->steps; /* the last channel alone, or all of them */
    for (int k = 0; k < TIES; k++) {                            /* in the last octaves, beside ties of codes */
        const double code = 0.5 + floor(rng_uniform(r, most / (2 << k % 2), most / (1 << k % 2)));
        d[count++] = nextafterf((float)(code / row->steps), k % 3 == 0   ? 0
                                                            : k % 3 == 1 ? 2
                                                                         : (float)(code / row->steps));
    }
    d[count++] = nextafterf(1, 2);
    d[count++] = 1.001f;
    d[count++] = -0x1p-149f;
    d[count++] = -0.001f;
    for (size_t i = 0; i < count * VARIANTS; i++) {
        const device v = variant(r, p, (int)(i / count));
        const float in = d[i % count];
        const long double at = fminf(fmaxf(in, 0), 1);
        long double made = 0;
        float read[4];
        double texel[4], again[4];
        assert_int_equal(printed_compute(text(), "pack_depth", p, &v, &in, texel), channels);
        for (int k = 0; k < channels; k++) {
            const float code = rintf((float)fmin(fmax(texel[k], 0), 1) * 255);
            made += (long double)row->weight[channel[k]] * code;
            read[k] = nextafterf(code / 255, i % 2 ? 2 : -1);
        }
        printed_compute(text(), "unpack_depth", p, &v, read, again);
        const long double all = row->steps, off = fabsl(made - at * all), is = fminl(made / all, 1);
        TALLY(t, off <= said.claims[0].bound && fabsl(again[0] - is) <= said.claims[1].bound * is,
              "%s in %s, d %a: off by %Lg steps of %g; back %a", row->name, promises[p].name, (double)in, off,
              said.claims[0].bound, again[0]);
        beyond = fmax(beyond, (double)off - 0.5);
    }
    return beyond / (said.claims[0].bound - 0.5);
}

TEST(every_packing_keeps_its_bound) {
    rng r = rng_make("printed packings");
    tally t = {.name = "packings"};
    for (size_t p = 0; p < PROMISES; p++)
        for (size_t i = 0; packing_get(i) != NULL; i++)
            if (packing_get(i)->steps > 0)
                TALLY(&t, check_packing(&t, &r, p, packing_get(i)) > 0.5, "%s in %s: little of the bound is used",
                      packing_get(i)->name, promises[p].name);
    assert_true(t.cases > 10000);
    tally_end(&t);
}

/* ---- Normals in channels ----------------------------------------------------------------------------------------- */

static double degrees_between(const float a[3], const double b[4]) {
    double cross = 0, dot = 0;
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double side = (double)a[i] * b[j] - (double)a[j] * b[i];
        cross += side * side;
        dot += (double)a[k] * b[k];
    }
    return atan2(sqrt(cross), dot) * (180 / M_PI);
}

/* Axes and edges, each component 0 of either sign, of flushed size, a share of the others', or nearly all; and where
 * the folded plane's ends lie, by chance. */
static bool special_direction(rng *r, const pack_row *row, int index, float n[3]) {
    static const double sizes[] = {0,        -0.0, 0x1p-149, -0x1p-149, 0x1p-130, -0x1p-130, 0x1p-24,
                                   -0x1p-24, 1e-4, -1e-4,    0.25,      -0.25,    1,         -1};
    enum { SIZES = sizeof sizes / sizeof sizes[0] };
    double in[3] = {sizes[index % SIZES], sizes[index / SIZES % SIZES], sizes[index / SIZES / SIZES % SIZES]};
    if (index >= SIZES * SIZES * SIZES) { /* beside an edge of the octahedron */
        for (int k = 0; k < 3; k++)
            in[k] = rng_uniform(r, -1, 1);
        in[rng_below(r, 3)] *= rng_below(r, 2) == 0 ? 0 : rng_log(r, 1e-12, 1e-2);
    }
    const double length = sqrt(in[0] * in[0] + in[1] * in[1] + in[2] * in[2]);
    for (int k = 0; k < 3; k++)
        n[k] = (float)(in[k] / length);
    if (index == 0) /* as it was found: packed as it is it comes back 160 degrees off */
        memcpy(n, (const float[]){-0.968185484f, 0, -0.25023365f}, 3 * sizeof *n);
    n[2] = row->sphere ? n[2] : fabsf(n[2]);
    return index == 0 || (length > 0.1 && isfinite(length));
}

static void check_normals(tally *t, rng *r, size_t p, const pack_row *row) {
    const bool either = row->layout == PACK_OCT || row->layout == PACK_XYZ;
    const float top = (float)((1 << (row->bits - either)) - 1), least = either ? -1 : 0;
    const code_said said = code_normal(&printed, begin(p), row);
    const int count = (int)test_cases(3500, 6000, 40000);
    for (int i = 0; i < count; i++) {
        const device v = variant(r, p, (int)rng_below(r, VARIANTS));
        float n[3], read[4];
        double texel[4], to[4];
        if (!special_direction(r, row, i, n))
            continue;
        assert_int_equal(printed_compute(text(), "pack_normal", p, &v, n, texel), row->channels);
        for (int k = 0; k < row->channels; k++) {
            const float code = rintf(fminf(fmaxf((float)texel[k], least), 1) * top);
            read[k] = nextafterf(code / top, i % 2 ? 2 : -2);
        }
        printed_compute(text(), "unpack_normal", p, &v, read, to);
        TALLY(t, degrees_between(n, to) <= said.claims[0].bound, "%s in %s, %.9g %.9g %.9g: off by %g degrees of %g",
              row->name, promises[p].name, (double)n[0], (double)n[1], (double)n[2], degrees_between(n, to),
              said.claims[0].bound);
    }
}

TEST(every_normal_keeps_its_bound) {
    rng r = rng_make("printed normals");
    tally t = {.name = "normals"};
    for (size_t p = 0; p < PROMISES; p++)
        for (size_t i = 0; pack_get(i) != NULL; i++)
            if (pack_get(i)->kind == PACK_NORMAL)
                check_normals(&t, &r, p, pack_get(i));
    assert_true(t.cases > 100000);
    tally_end(&t);
}
