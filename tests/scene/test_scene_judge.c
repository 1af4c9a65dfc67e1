/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From where surfaces fight: ties against every code of small formats, the guarantee at and behind the depth named. */
#include "depthprec/depthprec.h"
#include "scene/judge.h"
#include "setups.h"
#include "support.h"

static dp_setup setup_of(const char *format, dp_mapping mapping, double znear, double zfar, dp_model model) {
    return SETUP(format, .mapping = mapping, .znear = znear, .zfar = zfar, .model = model);
}

/* Every code between near and the depth, the cut off ones at the ends left out: the end of the last narrow cell. */
static double ties_by_all(const dp_setup *setup, double most, double within) {
    const uint32_t first = setup->code_near, last = dp_code(setup, within);
    const int64_t step = first < last ? 1 : -1;
    double from = setup->spec.znear;
    if (llabs((int64_t)last - (int64_t)first) < 3)
        return NAN;
    for (int64_t code = (int64_t)first + step; code != (int64_t)last; code += step) {
        const dp_cell cell = dp_cell_of(setup, (uint32_t)code);
        if (!(cell.width > most))
            from = code + step == (int64_t)last ? NAN : cell.hi;
    }
    return from;
}

TEST(ties) {
    static const struct {
        const char *format;
        dp_mapping mapping;
        double znear, zfar;
    } rows[] = {
        {"unorm16", DP_MAPPING_D3D, 0.1, 1000},
        {"unorm16", DP_MAPPING_REVERSED, 0.25, INFINITY},
        {"unorm12", DP_MAPPING_GL, 1, 50},
        {"fp16", DP_MAPPING_REVERSED, 0.1, 1000},
        {"fp16", DP_MAPPING_REVERSED, 0.5, INFINITY},
        {"fp16", DP_MAPPING_D3D, 0.1, 100},
        {"unorm10", DP_MAPPING_LINEAR, 1, 100},
    };
    tally t = {.name = "where ties begin"};
    rng r = rng_make("ties");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const dp_setup setup = setup_of(rows[i].format, rows[i].mapping, rows[i].znear, rows[i].zfar, DP_MODEL_EXACT);
        const double end = fmin(rows[i].zfar, 2000 * rows[i].znear);
        for (uint64_t run = 0; run < test_cases(5, 40, 1000); run++) {
            const double within = rng_log(&r, 2 * rows[i].znear, end);
            const double most = run == 0 ? 0.0 : rng_log(&r, 1e-6, 100);
            const double got = scene_judge(&setup, most, most, within).ties_from;
            const double want = ties_by_all(&setup, most, within);
            TALLY(&t, isnan(got) ? isnan(want) : got == want, "%s %d: %.17g, not %.17g, for %g within %g",
                  rows[i].format, (int)rows[i].mapping, got, want, most, within);
        }
    }
    tally_end(&t);
}

TEST(certain) {
    tally t = {.name = "how far it is certain"};
    rng r = rng_make("certain");
    for (uint64_t run = 0; run < test_cases(30, 200, 5000); run++) {
        static const char *const formats[] = {"fp32", "unorm24", "unorm16"};
        dp_setup setup =
            setup_of(formats[run % 3], run % 2 == 0 ? DP_MAPPING_REVERSED : DP_MAPPING_D3D, 0.1, 1000, DP_MODEL_FLOAT);
        dp_spec spec = setup.spec;
        if (run % 5 == 0) {
            spec.triangles = dp_triangles_default();
            assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        }
        const double gap = rng_log(&r, 1e-5, 1), within = rng_uniform(&r, 1, 900);
        const scene_verdict v = scene_judge(&setup, gap, 3 * gap, within);
        dp_separation_worst worst;
        if (isnan(v.certain_to)) {
            TALLY(&t, dp_separation(&setup, 0.1) > gap, "%g apart at near", gap);
        } else {
            assert_int_equal(dp_separation_over(&setup, 0.1, v.certain_to, gap, &worst), DP_OK);
            TALLY(&t, worst.bound <= gap, "%g apart to %g: %g", gap, v.certain_to, worst.bound);
            const double beyond = fmin(1000, v.certain_to * (1 + 2e-5) + 1e-6);
            dp_separation_over(&setup, 0.1, beyond, gap, &worst);
            TALLY(&t, v.certain_to >= 1000 || worst.bound > gap, "%g apart beyond %g, too", gap, v.certain_to);
        }
        assert_int_equal(dp_separation_over(&setup, 0.1, within, 0, &worst), DP_OK);
        TALLY(&t, gap + v.lift >= worst.separation && (v.lift == 0.0 || gap + v.lift <= 1.002 * worst.separation),
              "%g and %g more, for %g", gap, v.lift, worst.separation);
    }
    tally_end(&t);
}

TEST(nothing_between) {
    const dp_setup setup = setup_of("fp32", DP_MAPPING_REVERSED, 0.1, 1000, DP_MODEL_FLOAT);
    const scene_verdict v = scene_judge(&setup, 0, 0, 100);
    assert_true(isnan(v.certain_to) && v.ties_from == 0.1 && v.lift > 0);
}
