/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An effect in real arithmetic beside the same in binary32, of small whole numbers and quarters, which neither rounds:
 * at the ends of ramps and on the edges of steps, where depths are equal, too, they are the same. */
#include "shader/effect.h"
#include "support.h"

/* One of a few that a parameter may be, most of them equal to some depth or difference of depths. */
static double some(rng *r, const texture_parameter *p) {
    static const double values[] = {0, 0.25, 0.5, 1, 1, 2, 3, 4, -1, -0.5};
    return fmin(fmax(values[rng_below(r, sizeof values / sizeof values[0])], p->lo), p->hi);
}

TEST(twins) {
    rng r = rng_make("twins");
    tally t = {.name = "twins"};
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.znear = 0.5;
    spec.zfar = 8;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    size_t rows = 0;
    for (size_t i = 0; effect_get(i) != NULL; i++) {
        const effect_row *row = effect_get(i);
        uint64_t steps[2] = {0};
        if ((row->needs & (EFFECT_LAST_FRAME | EFFECT_NORMALS)) != 0)
            continue;
        rows++;
        for (uint64_t n = test_cases(3000, 20000, 200000); n > 0; n--) {
            double p[PARAMETERS_MAX] = {0};
            float p32[PARAMETERS_MAX] = {0};
            const effect_view view = {.setup = &setup, .base = {0, 1, 0}, .along = {0.5, -0.25, 1}, .stretch = 1.125};
            effect_pixel pixel[2];
            double z[2];
            for (size_t k = 0; row->parameters[k].name != NULL; k++) {
                const bool yaw = strcmp(row->parameters[k].name, "yaw") == 0; /* whose sine would be rounded */
                p[k] = yaw ? 0 : some(&r, &row->parameters[k]);
                p32[k] = (float)p[k];
            }
            for (int k = 0; k < 2; k++) {
                z[k] = 1 + (double)rng_below(&r, 8);
                pixel[k] = (effect_pixel){.eye = (float)z[k], .eye01 = (float)(z[k] / 8), .stretch = 1.125f};
                for (int axis = 0; axis < 3; axis++)
                    pixel[k].world[axis] = (float)(view.base[axis] + view.along[axis] * z[k]);
            }
            const double exact = row->output(&view, p, z[0], z[1]);
            const double single = (double)row->shader(&pixel[0], p32, &pixel[1]);
            if (isnan(exact) || isnan(single))
                continue;
            TALLY(&t, fabs(exact - single) <= 1e-5 * fmax(1, fabs(exact)),
                  "%s of %g and %g, parameters %g, %g, %g: %g, in binary32 %g", row->name, z[0], z[1], p[0], p[1], p[2],
                  exact, single);
            if (exact == 0 || exact == 1)
                steps[(int)exact]++;
        }
        print_message("# %s: %lu times 0, %lu times 1\n", row->name, (unsigned long)steps[0], (unsigned long)steps[1]);
    }
    assert_true(rows >= 12);
    tally_end(&t);
}
