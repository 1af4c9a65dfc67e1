/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth written per vertex: no triangle of the class is off by more than is said, some are by all of it, and the span
 * that keeps an error is that. In long double, vertex by vertex. */
#include "depthprec/depthprec.h"
#include "printed.h"

static dp_setup setup_of(dp_mapping mapping, double n, double f, double c) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.mapping = mapping;
    spec.znear = n;
    spec.zfar = f;
    spec.log_c = c;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

/* d over the same at far, less that of the surface: window depth of the class page, so that the difference is exact. */
static long double rises(const dp_setup *s, long double z, long double from) {
    const long double c = s->spec.log_c, f = s->spec.zfar;
    if (s->spec.mapping == DP_MAPPING_LINEAR)
        return (z - from) / f;
    return log1pl(c * (z - from) / (c * from + 1)) / log1pl(c * f);
}

/* The eye depth that lies `window` behind z, less z. */
static long double moved(const dp_setup *s, long double z, long double window) {
    const long double c = s->spec.log_c, f = s->spec.zfar;
    if (s->spec.mapping == DP_MAPPING_LINEAR)
        return window * f;
    return (z + 1 / c) * expm1l(window * log1pl(c * f));
}

/* A pixel of depth z inside a triangle of random depths, by its weights: what is interpolated is so much too far. */
static long double error_of_triangle(const dp_setup *s, rng *r, long double z, long double lo, long double hi,
                                     bool at_ends) {
    const long double v1 = at_ends ? lo : (long double)rng_uniform(r, (double)lo, (double)z);
    const long double v2 = at_ends ? hi : (long double)rng_uniform(r, (double)z, (double)hi);
    const long double v3 = at_ends ? hi : (long double)rng_uniform(r, (double)lo, (double)hi);
    /* 1/z of the vertices, so weighted, is that of the pixel: the third vertex takes what may be taken */
    const long double most = v3 > z ? (1 / v1 - 1 / z) / (1 / v1 - 1 / v3) : (1 / z - 1 / v2) / (1 / v3 - 1 / v2);
    const long double l3 = at_ends ? 0.5L * most : (long double)rng_unit(r) * most;
    const long double l1 = (1 / z - 1 / v2 - l3 * (1 / v3 - 1 / v2)) / (1 / v1 - 1 / v2);
    const long double l2 = 1 - l1 - l3;
    return l1 * rises(s, v1, z) + l2 * rises(s, v2, z) + l3 * rises(s, v3, z);
}

TEST(test_error) {
    tally t = {.name = "error"};
    rng r = rng_make("log vertices");
    for (uint64_t i = test_cases(500, 20000, 400000); i > 0; i--) {
        const double n = rng_log(&r, 1e-3, 10), f = n * rng_log(&r, 10, 1e6);
        const dp_setup s =
            setup_of(rng_below(&r, 3) == 0 ? DP_MAPPING_LINEAR : DP_MAPPING_LOG, n, f, rng_log(&r, 1e-6, 1e6));
        const double z = rng_log(&r, n, f), k = 1.0 + rng_log(&r, 1e-5, 1e3);
        const long double lo = fmaxl((long double)z / k, n), hi = fminl((long double)z * k, f);
        dp_vertex_error e;
        assert_int_equal(dp_vertex_error_at(&s, z, k, &e), DP_OK);
        const long double any = error_of_triangle(&s, &r, z, lo, hi, false);
        const long double most = error_of_triangle(&s, &r, z, lo, hi, true);
        const long double slack = 1e-17L * (1 + 1 / (k - 1)); /* of the weights, relative to the range of the class */
        const long double range = rises(&s, hi, z) - rises(&s, lo, z);
        TALLY(&t, any <= e.window + slack * range && most <= e.window + slack * range,
              "z %g, k %g: %Lg and %Lg, not below %g", z, k, any, most, e.window);
        TALLY(&t, e.window <= most * (1 + 1e-14L * z / fminl(z - lo, hi - z)) + slack * range,
              "z %g, k %g: %g, not %Lg", z, k, e.window, most);
        TALLY(&t, fabsl(e.eye - moved(&s, z, e.window)) <= 1e-13L * e.eye + 1e-12L * slack * z,
              "z %g, k %g: %.17g scene units, not %.17Lg; C %g", z, k, e.eye, moved(&s, z, e.window), s.spec.log_c);
    }
    tally_end(&t);
}

/* The error is kept up to the depth that is said, and beyond it is not. */
TEST(test_depth) {
    tally t = {.name = "depth"};
    rng r = rng_make("log spans");
    for (uint64_t i = test_cases(100, 5000, 50000); i > 0; i--) {
        const double n = rng_log(&r, 1e-3, 10), f = n * rng_log(&r, 1e3, 1e6);
        const dp_setup s = setup_of(i % 3 == 0 ? DP_MAPPING_LINEAR : DP_MAPPING_LOG, n, f, rng_log(&r, 1e-3, 1e3));
        const double z = rng_log(&r, n * 2, f / 2), eye = z * rng_log(&r, 1e-12, 1e6);
        double k;
        dp_vertex_error at, beyond;
        assert_int_equal(dp_vertex_depth_at(&s, z, eye, &k), DP_OK);
        assert_int_equal(dp_vertex_error_at(&s, z, k, &at), DP_OK);
        TALLY(&t, at.eye <= eye && k >= 1, "z %g, %g: %.17g is off by %g", z, eye, k, at.eye);
        if (k < 1e6) {
            assert_int_equal(dp_vertex_error_at(&s, z, fmin(1 + 1.0001 * (k - 1), 1e6), &beyond), DP_OK);
            TALLY(&t, beyond.eye > eye, "z %g, %g: more than %.17g is off by %g", z, eye, k, beyond.eye);
        } else {
            assert_int_equal(dp_vertex_error_at(&s, z, 1e6, &beyond), DP_OK);
            TALLY(&t, beyond.eye <= eye, "z %g, %g: 1e6 is off by %g", z, eye, beyond.eye);
        }
    }
    tally_end(&t);
}

/* Numbers of depthprec(7): from z to 2 z 6.0 %, to 1.1 z 0.11 %; from z/2 to 2 z 26 % at z, and of linear 50 %. */
TEST(known_numbers) {
    static const double ends[2] = {2.0, 1.1}, shares[2] = {0.0597, 0.00113};
    dp_vertex_error e;
    double k;
    for (int i = 0; i < 2; i++) {
        const double m = ends[i] * log(ends[i]) / (ends[i] - 1), z = 1e3;
        const dp_setup s = setup_of(DP_MAPPING_LOG, z, ends[i] * z, 1e6);
        assert_int_equal(dp_vertex_error_at(&s, m * z, 1e3, &e), DP_OK); /* the planes are the ends */
        /* m - 1 - log m is of first order */
        assert_scene(log1p(e.eye / (m * z)), shares[i], 0.5e-4);
    }
    dp_setup s = setup_of(DP_MAPPING_LOG, 0.1, 1e5, 1e6);
    assert_int_equal(dp_vertex_error_at(&s, 100, 2, &e), DP_OK);
    assert_relative(e.eye, 100 * (pow(2, 1.0 / 3) - 1), 1e-5);
    assert_relative(e.window, log(2) / 3 / log1p(1e6 * 1e5), 1e-6);
    s = setup_of(DP_MAPPING_LINEAR, 0.1, 1e5, 1);
    assert_int_equal(dp_vertex_error_at(&s, 100, 2, &e), DP_OK);
    assert_relative(e.eye, 50, 1e-14);
    assert_relative(e.window, 50 / 1e5, 1e-14);
    assert_int_equal(dp_vertex_depth_at(&s, 100, 50, &k), DP_OK);
    assert_relative(k, 2, 1e-9);
}

TEST(test_none) {
    dp_vertex_error e = {1, 1};
    double k = 0;
    const dp_setup osg = setup_of(DP_MAPPING_OSGEARTH, 0.1, 1000, 1), one = setup_of(DP_MAPPING_LOG, 0.1, 1000, 1);
    const dp_mapping fragment[] = {DP_MAPPING_THREE_WEBGL, DP_MAPPING_THREE_WEBGPU, DP_MAPPING_CESIUM};
    dp_vertex_error a, b;
    assert_int_equal(dp_vertex_error_at(&osg, 10, 2, &a), DP_OK);
    assert_int_equal(dp_vertex_error_at(&one, 10, 2, &b), DP_OK);
    assert_true(a.eye == b.eye && a.window == b.window && a.eye > 0);
    for (int i = 0; i < 3; i++) {
        const dp_setup s = setup_of(fragment[i], 0.1, 1000, 1);
        assert_int_equal(dp_vertex_error_at(&s, 10, 2, &a), DP_OK);
        assert_true(a.eye == 0 && a.window == 0);
    }
    const dp_setup d3d = setup_of(DP_MAPPING_D3D, 0.1, 1000, 1), log_depth = setup_of(DP_MAPPING_LOG, 0.1, 1000, 1);
    assert_int_equal(dp_vertex_error_at(&d3d, 10, 5, &e), DP_OK);
    assert_true(e.window == 0 && e.eye == 0);
    for (int i = 0; i < 3; i++) { /* a plane, and a triangle of one depth */
        assert_int_equal(dp_vertex_error_at(&log_depth, (double[]){0.1, 1000, 7}[i], i < 2 ? 5 : 1, &e), DP_OK);
        assert_true(e.window == 0 && e.eye == 0);
    }
    assert_int_equal(dp_vertex_depth_at(&d3d, 10, 0, &k), DP_OK);
    assert_true(k == 1e6);
    assert_int_equal(dp_vertex_depth_at(&log_depth, 10, 0, &k), DP_OK);
    assert_true(k == 1);
    e = (dp_vertex_error){3, 4};
    k = 5;
    assert_int_equal(dp_vertex_error_at(NULL, 10, 2, &e), DP_ERROR_NULL);
    assert_int_equal(dp_vertex_error_at(&log_depth, 10, 2, NULL), DP_ERROR_NULL);
    assert_int_equal(dp_vertex_depth_at(NULL, 10, 2, &k), DP_ERROR_NULL);
    assert_int_equal(dp_vertex_depth_at(&log_depth, 10, 2, NULL), DP_ERROR_NULL);
    for (int i = 0; i < 4; i++) {
        const double z[] = {0.09, 1001, NAN, INFINITY}, depth[] = {0.99, 1.1e6, NAN, -1},
                     eye[] = {-1, NAN, -INFINITY, -0x1p-1074};
        assert_int_equal(dp_vertex_error_at(&log_depth, z[i], 2, &e), DP_ERROR_DEPTH);
        assert_int_equal(dp_vertex_error_at(&log_depth, 10, depth[i], &e), DP_ERROR_TRIANGLES);
        assert_int_equal(dp_vertex_depth_at(&log_depth, z[i], 2, &k), DP_ERROR_DEPTH);
        assert_int_equal(dp_vertex_depth_at(&log_depth, 10, eye[i], &k), DP_ERROR_DEPTH);
    }
    assert_true(e.window == 3 && e.eye == 4 && k == 5);
}

/* ---- What table prints ------------------------------------------------------------------------------------------- */

/* The error by its formula, and beside it the class that keeps it below the separation. */
TEST(test_printed) {
    static const struct {
        const char *options;
        dp_mapping mapping;
        double c, k;
    } rows[] = {{"-m log", DP_MAPPING_LOG, 1, 2},
                {"-m log --log-c 0.01 --triangle-class depth=1.25", DP_MAPPING_LOG, 0.01, 1.25},
                {"-m linear --triangle-class depth=3", DP_MAPPING_LINEAR, 1, 3}};
    static const double depths[] = {0.1, 0.15, 7, 90, 999, 1000};
    tally t = {.name = "printed"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        printed p = print_of("table -F d24 %s --viewport 64x48 --at 0.1,0.15,7,90,999,1000 --json", rows[i].options);
        json_t *json = json_of(p.out);
        const dp_setup s = setup_of(rows[i].mapping, 0.1, 1000, rows[i].c);
        const json_t *list = json_object_get(json_array_get(json_object_get(json, "setups"), 0), "rows");
        for (size_t j = 0; j < sizeof depths / sizeof depths[0]; j++) {
            const json_t *row = json_array_get(list, j);
            const double error = json_real_value(json_object_get(row, "per_vertex"));
            const double depth = json_number_value(json_object_get(row, "per_vertex_depth"));
            const double separation = json_number_value(json_object_get(row, "guaranteed"));
            const long double z = depths[j], lo = fmaxl(z / rows[i].k, 0.1L), hi = fminl(z * rows[i].k, 1000);
            const long double l = z < 1000 ? lo * (hi - z) / (z * (hi - lo)) : 0;
            const long double want = moved(&s, z, l * rises(&s, lo, z) + (1 - l) * rises(&s, hi, z));
            dp_vertex_error at;
            TALLY(&t, fabsl(error - want) <= 1e-12L * z, "%s, z %Lg: %.15g, not %.15Lg", rows[i].options, z, error,
                  want);
            assert_int_equal(dp_vertex_error_at(&s, (double)z, depth, &at), DP_OK);
            TALLY(&t, at.eye <= separation && (depth == 1e6 || at.eye >= 0.99 * separation),
                  "%s, z %Lg: triangles to %.15g are off by %g", rows[i].options, z, depth, at.eye);
        }
        json_decref(json);
        printed_free(&p);
    }
    tally_end(&t);
}

/* The sentence names the depth that is off by the largest share, and the smallest class that is not too far off. */
TEST(test_sentence) {
    const dp_setup s = setup_of(DP_MAPPING_LOG, 0.1, 1000, 1);
    dp_spec full = s.spec;
    dp_format found[2];
    dp_setup stored;
    dp_budget b;
    dp_vertex_error e;
    double least = INFINITY, said;
    assert_int_equal(dp_format_parse("unorm24", found), 1);
    full.format = found[0];
    assert_int_equal(dp_setup_init(&stored, &full), DP_OK);
    for (int i = 0; i < 3; i++) {
        const double z = (double[]){5, 50, 900}[i];
        double k;
        assert_int_equal(dp_budget_at(&stored, z, NULL, &b), DP_OK);
        assert_int_equal(dp_vertex_depth_at(&s, z, b.separation, &k), DP_OK);
        least = fmin(least, k - 1);
    }
    assert_int_equal(dp_vertex_error_at(&s, 5, 2, &e), DP_OK);
    values v = values_of("table");
    want(&v, "error=%f z=%f", e.eye, 5.0);
    printed p = print_of("table -F d24 -m log --viewport 64x48 --at 5,50,900");
    check_line(&v, p.out, "written per vertex, depth is up to", "error:4, z:4");
    assert_int_equal(sscanf(strstr(p.out, "k = 1 +"), "k = 1 + %lf", &said), 1);
    assert_true(said <= least && said > 0.9 * least);
    printed_free(&p);
    p = print_of("table -F d24 -m log --viewport 64x48 --at 5,50,900 --triangle-class depth=1.0001");
    assert_non_null(strstr(p.out, "resolved"));
    assert_null(strstr(p.out, "per fragment"));
    printed_free(&p);
    check_says(0, "!per vertex", "table -F d24 -m log --at 5,50,900");
    values_free(&v);
}
