/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mappings: names, what the rows say, the window depth, and the way back from the pair (d, 1 - d). */
#include <ctype.h>

#include "oracle.h"
#include "support.h"

typedef struct known {
    const char *name;
    dp_curve curve;
    int reversed, ndc_signed, far_infinite, ortho;
} known;

static const known rows[DP_MAPPING_COUNT] = {
    [DP_MAPPING_D3D] = {"d3d", DP_CURVE_PERSPECTIVE, 0, 0, 1, 1},
    [DP_MAPPING_GL] = {"gl", DP_CURVE_PERSPECTIVE, 0, 1, 1, 1},
    [DP_MAPPING_REVERSED] = {"reversed", DP_CURVE_PERSPECTIVE, 1, 0, 1, 1},
    [DP_MAPPING_GL_REVERSED] = {"gl-reversed", DP_CURVE_PERSPECTIVE, 1, 1, 1, 1},
    [DP_MAPPING_LINEAR] = {"linear", DP_CURVE_LINEAR, 0, 0, 0, 0},
    [DP_MAPPING_LOG] = {"log", DP_CURVE_LOG, 0, 0, 0, 0},
    [DP_MAPPING_THREE_WEBGL] = {"three-webgl", DP_CURVE_LOG, 0, 0, 0, 0},
    [DP_MAPPING_THREE_WEBGPU] = {"three-webgpu", DP_CURVE_LOG, 0, 0, 0, 0},
    [DP_MAPPING_CESIUM] = {"cesium", DP_CURVE_LOG, 0, 0, 0, 0},
    [DP_MAPPING_OSGEARTH] = {"osgearth", DP_CURVE_LOG, 0, 1, 0, 0},
};

/* The names that depthprec-camera(7) and the pages of APIs and libraries give them. */
static const struct {
    dp_mapping mapping;
    const char *names[14];
} others[] = {
    {DP_MAPPING_D3D,
     {"zo", "vulkan", "vk", "metal", "webgpu", "standard", "directx", "direct3d", "d3d11", "d3d12", "rh_zo", "lh_zo",
      "GL_ZERO_TO_ONE"}},
    {DP_MAPPING_GL, {"no", "opengl", "gles", "webgl", "rh_no", "lh_no", "GL_NEGATIVE_ONE_TO_ONE"}},
    {DP_MAPPING_REVERSED,
     {"rev", "reverse", "reversed-z", "reverse-z", "reversedz", "inverted", "reversed_zo", "reversed-d3d",
      "d3d-reversed"}},
    {DP_MAPPING_GL_REVERSED, {"reversed-gl", "glrev", "gl_reversed", "reversed_no"}},
    {DP_MAPPING_LINEAR, {"w", "w-buffer", "wbuffer", "linear01"}},
    {DP_MAPPING_LOG, {"logarithmic", "logdepth"}},
    {DP_MAPPING_THREE_WEBGL, {"three", "threejs", "three.js"}},
    {DP_MAPPING_THREE_WEBGPU, {"ulrich"}},
    {DP_MAPPING_CESIUM, {"cesiumjs"}},
    {DP_MAPPING_OSGEARTH, {"osgearth-vertex"}},
};

static void check_parse(const char *name, dp_mapping want) {
    dp_mapping got = DP_MAPPING_COUNT;
    dp_status status = dp_mapping_parse(name, &got);
    if (status != DP_OK || got != want)
        fail_msg("'%s' gives status %d, mapping %d; should be %s", name, status, got, rows[want].name);
}

TEST(names) {
    for (int i = 0; i < DP_MAPPING_COUNT; i++) {
        const dp_mapping_row *row = dp_mapping_get((dp_mapping)i);
        assert_non_null(row);
        assert_string_equal(row->name, rows[i].name);
        assert_int_equal(row->curve, rows[i].curve);
        assert_int_equal(!!row->reversed, rows[i].reversed);
        assert_int_equal(!!row->ndc_signed, rows[i].ndc_signed);
        assert_int_equal(!!row->far_infinite, rows[i].far_infinite);
        assert_int_equal(!!row->ortho, rows[i].ortho);
        assert_non_null(row->note);
        assert_true(row->source && strlen(row->source) > 0);
        char list[1024], upper[1024];
        snprintf(list, sizeof list, "%s %s", row->name, row->aliases ? row->aliases : "");
        assert_null(strstr(list, "  "));
        for (size_t k = 0; k <= strlen(list); k++)
            upper[k] = (char)toupper((unsigned char)list[k]);
        char *const spellings[] = {list, upper};
        for (int k = 0; k < 2; k++) {
            char *rest = NULL;
            for (char *name = strtok_r(spellings[k], " ", &rest); name; name = strtok_r(NULL, " ", &rest))
                check_parse(name, (dp_mapping)i);
        }
    }
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        for (size_t k = 0; others[i].names[k] != NULL; k++)
            check_parse(others[i].names[k], others[i].mapping);
    assert_null(dp_mapping_get(DP_MAPPING_COUNT));
    assert_null(dp_mapping_get((dp_mapping)-1));
    static const char *const bad[] = {"", " ", "d3", "d3dx", "d3d ", " d3d", "reverse-gl-log", "fp32", "linear log"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        dp_mapping got = DP_MAPPING_LOG;
        if (dp_mapping_parse(bad[i], &got) != DP_ERROR_MAPPING)
            fail_msg("'%s' is taken for a mapping", bad[i]);
        assert_int_equal(got, DP_MAPPING_LOG);
    }
    dp_mapping got = DP_MAPPING_LINEAR;
    assert_int_not_equal(dp_mapping_parse(NULL, &got), DP_OK);
    assert_int_equal(got, DP_MAPPING_LINEAR);
    assert_int_not_equal(dp_mapping_parse("d3d", NULL), DP_OK);
}

/* ---- numbers ---- */

static void random_spec(rng *r, dp_spec *spec) {
    *spec = dp_spec_default();
    int kind = (int)rng_below(r, 16); /* 10 mappings, 4 orthographic, 2 infinite */
    spec->mapping = (dp_mapping)(kind < 10 ? kind : kind < 14 ? kind - 10 : (kind - 14) * 2);
    spec->ortho = kind >= 10 && kind < 14;
    if (rng_below(r, 2)) {
        spec->znear = rng_log(r, 0.01, 10);
        spec->zfar = spec->znear * rng_log(r, 2, 1e6);
    } else {
        spec->znear = rng_log(r, 1e-12, 1e12);
        spec->zfar = spec->znear * (1 + rng_log(r, 1.1e-6, 1e30));
    }
    if (kind >= 14)
        spec->zfar = INFINITY;
    if (spec->ortho && rng_below(r, 2))
        rng_planes(r, &spec->znear, &spec->zfar);
    spec->log_c = rng_below(r, 2) ? 1 : rng_log(r, 1e-12, 1e12);
    if (!isinf(spec->zfar))
        spec->zfar = fmin(spec->zfar, most_far(spec));
}

static double random_depth(rng *r, const dp_spec *spec) {
    double zfar = isinf(spec->zfar) ? spec->znear * 1e20 : spec->zfar;
    if (spec->znear <= 0)
        return rng_depth(r, spec->znear, spec->zfar);
    switch (rng_below(r, 5)) {
    case 0:
        return fmin(zfar, spec->znear * (1 + rng_log(r, 1e-17, 1)));
    case 1:
        return fmax(spec->znear, zfar * (1 - rng_log(r, 1e-17, 1)));
    case 2:
        return rng_uniform(r, spec->znear, zfar);
    default:
        return rng_log(r, spec->znear, zfar);
    }
}

/* z becomes what the two shares of a pair make of planes with depth 0 between them: neither stands for the other. */
static void eye_of_pair(mpq_t z, const oracle *o, double d, double q) {
    if (!(o->spec.znear < 0 && o->spec.zfar > 0))
        return;
    mpq_t part;
    mpq_init(part);
    mpq_set_d(z, o->reversed ? d : q);
    mpq_mul(z, z, o->znear);
    mpq_set_d(part, o->reversed ? q : d);
    mpq_mul(part, part, o->zfar);
    mpq_add(z, z, part);
    mpq_clear(part);
}

TEST(window_and_back) {
    rng r = rng_make("mapping");
    tally window = {.name = "window within 2^-50"}, eye = {.name = "eye within its bound"},
          trip = {.name = "z to the pair and back"};
    mpq_t d, q, want, at;
    mpq_inits(d, q, want, at, NULL);
    uint64_t cameras = test_cases(60, 300, 30000);
    for (uint64_t i = 0; i < cameras; i++) {
        char text[256];
        dp_spec spec;
        dp_setup setup;
        oracle o;
        random_spec(&r, &spec);
        oracle_describe(&spec, text, sizeof text);
        if (dp_setup_init(&setup, &spec) != DP_OK)
            fail_msg("refused: %s", text);
        oracle_init(&o, &spec);
        double bound = o.log ? 0x1p-45 : 0x1p-50;
        for (int k = 0; k < 40; k++) {
            double z = k == 0 ? spec.znear : k == 1 && !o.infinite ? spec.zfar : random_depth(&r, &spec);
            oracle_window(&o, d, z);
            double got = dp_window(&setup, z);
            double off = oracle_relative(got, d);
            TALLY(&window, off <= 0x1p-50 && got >= 0 && got <= 1, "%s: window(%a) = %a, off by %g of 2^-50", text, z,
                  got, off * 0x1p50);

            /* the pair, each member rounded once */
            mpq_set_ui(q, 1, 1);
            mpq_sub(q, q, d);
            double pair_d = oracle_double(d), pair_q = oracle_double(q);
            const int both = mpq_sgn(d) != 0 && mpq_sgn(q) != 0;
            if (both && fmin(pair_d, pair_q) < 0x1p-900) /* the pair itself loses digits */
                continue;
            got = dp_eye(&setup, pair_d, pair_q);
            mpq_set_d(at, z);
            eye_of_pair(at, &o, pair_d, pair_q);
            off = oracle_relative(got, at);
            TALLY(&trip, off <= bound + 0x1p-53, "%s: eye(%a, %a) = %a, off by %g of the bound", text, pair_d, pair_q,
                  got, off / bound);

            /* any d: the pair is d and the rounded 1 - d, which moves 1/z by 2^-53 at most */
            mpq_set_d(d, k & 1 ? rng_unit(&r) : 1 - rng_log(&r, 1e-16, 1));
            mpq_set_ui(q, 1, 1);
            mpq_sub(q, q, d);
            pair_d = oracle_double(d);
            pair_q = oracle_double(q);
            if (!oracle_eye(&o, want, d) || mpq_sgn(d) == 0)
                continue;
            got = dp_eye(&setup, pair_d, pair_q);
            eye_of_pair(want, &o, pair_d, pair_q);
            off = oracle_relative(got, want);
            TALLY(&eye, off <= bound + 0x1p-53, "%s: eye(%a, %a) = %a, off by %g of the bound", text, pair_d, pair_q,
                  got, off / bound);
        }
        oracle_clear(&o);
    }
    mpq_clears(d, q, want, at, NULL);
    tally_end(&window);
    tally_end(&trip);
    tally_end(&eye);
}

TEST(ends) {
    for (int m = 0; m < DP_MAPPING_COUNT; m++) {
        for (int ortho = 0; ortho <= rows[m].ortho; ortho++) {
            for (int infinite = 0; infinite <= (rows[m].far_infinite && !ortho); infinite++) {
                dp_spec spec = dp_spec_default();
                spec.mapping = (dp_mapping)m;
                spec.ortho = ortho;
                spec.zfar = infinite ? HUGE_VAL : 1234.5;
                dp_setup setup;
                assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
                double first = rows[m].reversed ? 1 : 0;
                if (rows[m].curve == DP_CURVE_PERSPECTIVE) {
                    assert_true(dp_window(&setup, spec.znear) == first);
                    assert_ulp(dp_eye(&setup, first, 1 - first), spec.znear, 4);
                }
                assert_true(dp_window(&setup, spec.zfar) == 1 - first);
                double last = dp_eye(&setup, 1 - first, first);
                if (infinite)
                    assert_true(isinf(last) && last > 0);
                else
                    assert_relative(last, spec.zfar, rows[m].curve == DP_CURVE_LOG ? 0x1p-45 : 0x1p-50);
            }
        }
    }
}

/* Messages list the rows. */
TEST(lists_of_names_are_the_rows) {
    char all[256] = "", perspective[256] = "";
    for (int i = 0; i < DP_MAPPING_COUNT; i++) {
        char *const lists[] = {all, rows[i].curve == DP_CURVE_PERSPECTIVE ? perspective : NULL};
        for (int k = 0; k < 2; k++)
            if (lists[k] != NULL)
                snprintf(lists[k] + strlen(lists[k]), sizeof all - strlen(lists[k]), "%s%s",
                         lists[k][0] != '\0' ? ", " : "", dp_mapping_get((dp_mapping)i)->name);
    }
    assert_string_equal(DP_MAPPING_NAMES, all);
    assert_string_equal(DP_MAPPING_NAMES_PERSPECTIVE, perspective);
}
