/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Plans of several frusta: each keeps the separation between all its codes, and none has fewer frusta: the least number
 * lies between two dynamic programs over a grid of planes, whose separations are in closed form.
 */
#include "solve/frusta.h"
#include "support.h"

enum { GRID = 600 };

/* UNORM under perspective: f^2 u (1/n - 1/f) / (1 - f u (1/n - 1/f)) at far, where it is largest; u is a code. */
static double separation_of(double n, double f, double codes) {
    const double step = (f / n - 1.0) / codes;
    return step < 1.0 ? f * step / (1.0 - step) : (double)INFINITY;
}

/* The fewest steps over the grid; `inner`: a frustum is let off the last step, which bounds every plan from below. */
static int fewest(const dp_spec *spec, double limit, double codes, int inner) {
    static double plane[GRID + 1];
    static int least[GRID + 1];
    for (int i = 0; i <= GRID; i++)
        plane[i] = spec->znear * pow(spec->zfar / spec->znear, (double)i / GRID);
    for (int j = 1; j <= GRID; j++) {
        least[j] = GRID;
        for (int i = 0; i < j; i++)
            if (separation_of(plane[i], plane[j - inner], codes) <= limit && least[i] + 1 < least[j])
                least[j] = least[i] + 1;
    }
    return least[GRID];
}

static void check_plan(const char *format, double codes, dp_model model, double far_plane, double limit) {
    dp_spec spec = dp_spec_default();
    static frusta_plan plan;
    dp_format formats[2];
    assert_int_not_equal(dp_format_parse(format, formats), 0);
    spec.format = formats[0];
    spec.mapping = DP_MAPPING_D3D;
    spec.model = model;
    spec.znear = 0.5;
    spec.zfar = far_plane;
    assert_int_equal(frusta_solve(&spec, limit, &plan), DP_OK);
    assert_true(plan.possible && plan.count > 1);
    assert_true(plan.frusta[0].znear == 0.5 && plan.frusta[plan.count - 1].zfar == far_plane);
    const size_t at_least = frusta_at_least(&spec, limit);
    assert_true((int)at_least >= fewest(&spec, limit, codes, 1) && (int)at_least <= fewest(&spec, limit, codes, 0));
    assert_true(model == DP_MODEL_EXACT ? plan.count == at_least : plan.count >= at_least);
    for (size_t i = 0; i < plan.count; i++) {
        const double n = plan.frusta[i].znear, f = plan.frusta[i].zfar;
        assert_true(i == 0 || plan.frusta[i - 1].zfar == n);
        assert_true(plan.frusta[i].reached.passed && plan.frusta[i].reached.value <= limit);
        for (double k = 1; k <= codes; k++) /* the depths of neighbouring codes */
            assert_true(1.0 / (1.0 / n - k / codes * (1.0 / n - 1.0 / f)) -
                            1.0 / (1.0 / n - (k - 1.0) / codes * (1.0 / n - 1.0 / f)) <=
                        limit * (1.0 + 1e-9));
    }
}

TEST(test_plans) {
    check_plan("unorm8", 255, DP_MODEL_EXACT, 50, 1);
    check_plan("unorm8", 255, DP_MODEL_EXACT, 20, 0.25);
    check_plan("unorm12", 4095, DP_MODEL_EXACT, 1000, 1.5);
    check_plan("unorm16", 65535, DP_MODEL_EXACT, 1000, 0.05);
    check_plan("unorm16", 65535, DP_MODEL_FLOAT, 1000, 0.05);
}

/* Every frustum of a depth that a shader writes keeps the separation whatever log2 is, at any depth of it. */
TEST(test_logarithmic) {
    static frusta_plan plan;
    dp_spec spec = dp_spec_default();
    dp_format formats[2];
    const double limit = 0.003;
    rng r = rng_make("logarithmic frusta");
    assert_int_not_equal(dp_format_parse("unorm24", formats), 0);
    spec.format = formats[0];
    spec.mapping = DP_MAPPING_THREE_WEBGPU;
    spec.model = DP_MODEL_FLOAT;
    spec.zfar = 1000;
    assert_int_equal(frusta_solve(&spec, limit, &plan), DP_OK);
    assert_true(plan.possible && plan.count > 1);
    spec.model = DP_MODEL_STAGED;
    for (size_t i = 0; i < plan.count; i++) {
        dp_setup setup;
        spec.znear = plan.frusta[i].znear;
        spec.zfar = plan.frusta[i].zfar;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        for (int k = 0; k < 2000; k++) {
            dp_budget b;
            const double z = rng_log(&r, spec.znear, spec.zfar);
            assert_int_equal(dp_budget_at(&setup, fmin(fmax(z, spec.znear), spec.zfar), NULL, &b), DP_OK);
            assert_true(b.separation <= limit);
        }
    }
}

TEST(test_refused) {
    static frusta_plan plan;
    dp_spec spec = dp_spec_default();
    assert_int_equal(frusta_solve(NULL, 1, &plan), DP_ERROR_NULL);
    assert_int_equal(frusta_solve(&spec, 1, NULL), DP_ERROR_NULL);
    assert_int_equal(frusta_solve(&spec, 0, &plan), DP_ERROR_RANGE);
    assert_int_equal(frusta_by_ratio(&spec, 1, &plan), DP_ERROR_RANGE);
    assert_int_equal(frusta_by_ratio(&spec, 1000, &plan), DP_OK);
    spec.zfar = INFINITY;
    assert_int_equal(frusta_solve(&spec, 1, &plan), DP_ERROR_RANGE);
}

/* The lattice alone, by hand: behind far the next code is that of n f/(n - (f - n)/N). */
TEST(test_lattice) {
    const double n = 0.1, f = 100.0, codes = 65535.0;
    dp_spec spec = dp_spec_default();
    spec.znear = n;
    spec.zfar = f;
    dp_format formats[2];
    assert_int_equal(dp_format_parse("unorm16", formats), 1);
    spec.format = formats[0];
    spec.mapping = DP_MAPPING_D3D;
    spec.model = DP_MODEL_FLOAT;
    const double apart = n * f / (n - (f - n) / codes) - f;
    assert_relative(frusta_lattice(&spec, apart * 0.9999).value, apart, 1e-9);
    assert_relative(frusta_lattice(&spec, apart * 0.9999).z, f, 1e-9);
    assert_false(frusta_lattice(&spec, apart * 0.9999).passed);
    assert_true(frusta_lattice(&spec, apart * 1.0001).passed);
    assert_relative(frusta_lattice_near(&spec, f, 1.0), (f + 1.0) * f / (codes + f + 1.0), 1e-9);
    assert_true(isnan(frusta_lattice_near(&spec, f, 1e-9)));
    assert_int_equal(frusta_at_least(&spec, 1e-9), 1); /* which does not do */
}
