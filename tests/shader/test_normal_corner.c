/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The bound of normals that are cross products: the three true places may be anywhere within reach of what is stored,
 * so each combination of ends is tried, and one by chance; none may be farther off, and some must come near. Where what
 * is stored is true there is only what binary32 and binary16 lose.
 */
#include "named.h"
#include "shader/normal_corner.h"
#include "views.h"

enum { SIDE = 9, MIDDLE = 4 };

/* The plane's normal in long double, towards the camera where that is how the pixels are seen. */
static void normal_through(const texture_camera *c, const normal_tap taps[3], const double z[3], double out[3]) {
    long double p[3][3], n[3], size = 0;
    for (int i = 0; i < 3; i++) {
        double sx, sy;
        view_slopes(c, taps[i].column, taps[i].row, &sx, &sy);
        p[i][0] = (long double)sx * (c->ortho ? 1 : z[i]);
        p[i][1] = (long double)sy * (c->ortho ? 1 : z[i]);
        p[i][2] = z[i];
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = (p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) - (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]);
        size += n[i] * n[i];
    }
    const bool left = taps[1].column<taps[0].column, below = taps[2].row> taps[0].row;
    for (int i = 0; i < 3; i++)
        out[i] = (double)(n[i] / sqrtl(size)) * (left == below ? -1 : 1);
}

/* A picture of a plane, stored in a format, with the neighbours that the method takes in its middle. */
static bool take_taps(rng *r, const texture_camera *c, const normal_row *method, view_picture *p, normal_tap taps[3]) {
    double n[3];
    float slope[SIDE];
    uint8_t sides;
    const double z = c->setup.spec.znear * rng_log(r, 2, 1000);
    const double d = view_tilted(r, c, MIDDLE, MIDDLE, z, rng_uniform(r, 0, 1.2), n);
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const double at = view_plane(c, n, d, i % SIDE, i / SIDE);
        if (!(at > c->setup.spec.znear && at < c->setup.spec.zfar))
            return false;
        p->eye[i] = (float)dp_stored(&c->setup, dp_code(&c->setup, at));
        slope[i % SIDE] = (float)camera_slope_x(c, i % SIDE);
    }
    normal_rows in = {.camera = c, .row = MIDDLE, .column = MIDDLE, .count = 1, .slope_x = slope + MIDDLE};
    for (int k = 0; k < SIDE; k++)
        in.rows[k] = p->eye + k * SIDE + MIDDLE;
    method->sides(&in, &sides);
    view_run(method, c, p);
    const int x = (sides & NORMAL_LEFT) != 0 ? -method->step : method->step;
    const int y = (sides & NORMAL_BELOW) != 0 ? method->step : -method->step;
    const int at[3][2] = {{0, 0}, {x, 0}, {0, y}};
    for (int i = 0; i < 3; i++) {
        const double column = MIDDLE + at[i][0], row = MIDDLE + at[i][1];
        const uint32_t code = dp_code(&c->setup, view_plane(c, n, d, column, row));
        const dp_cell cell = dp_cell_of(&c->setup, code);
        const double reach = fmin(cell.stored - cell.lo, cell.hi - cell.stored);
        taps[i] = (normal_tap){column, row, cell.stored, reach};
    }
    return true;
}

/* The bound where the true places are those that are stored. */
static double share_without_cells(tally *t, const texture_camera *c, const normal_row *method, const normal_tap at[3],
                                  const double found[3]) {
    normal_tap taps[3];
    double z[3], truth[3];
    for (int i = 0; i < 3; i++) {
        taps[i] = (normal_tap){at[i].column, at[i].row, at[i].stored, 0};
        z[i] = at[i].stored;
    }
    normal_through(c, taps, z, truth);
    const double bound = normal_corner_bound(c, method, taps, DP_BATCH_EYE_ERROR), angle = normal_angle(found, truth);
    TALLY(t, angle <= bound, "%s of true depths: off by %.9g, not %.9g", method->name, angle, bound);
    return bound < 1 ? angle / bound : 0;
}

/* The bound where one place alone may lie anywhere within its reach, at either end of it. */
static double share_of_one(tally *t, const texture_camera *c, const normal_row *method, const normal_tap at[3], int one,
                           const double found[3]) {
    double most = 0;
    for (int end = -1; end <= 1; end += 2) {
        normal_tap taps[3];
        double z[3], truth[3];
        for (int i = 0; i < 3; i++) {
            taps[i] = (normal_tap){at[i].column, at[i].row, at[i].stored, i == one ? at[i].reach : 0};
            z[i] = at[i].stored + end * taps[i].reach;
        }
        normal_through(c, taps, z, truth);
        const double bound = normal_corner_bound(c, method, taps, DP_BATCH_EYE_ERROR);
        const double angle = normal_angle(found, truth);
        TALLY(t, angle <= bound, "%s, tap %d alone: off by %.9g, not %.9g", method->name, one, angle, bound);
        most = bound < 1 ? fmax(most, angle / bound) : most;
    }
    return most;
}

TEST(no_true_plane_is_farther_off) {
    static const struct {
        const char *format;
        dp_mapping mapping;
    } kinds[] = {{"unorm16", DP_MAPPING_REVERSED}, {"unorm24", DP_MAPPING_D3D}, {"fp32", DP_MAPPING_REVERSED}};
    double share[NORMAL_METHODS][2] = {{0}}, lost[NORMAL_METHODS][2] = {{0}}, ones[3] = {0};
    rng r = rng_make("normal corner");
    tally t = {.name = "corners"};
    for (uint64_t n = test_cases(10000, 30000, 300000); n > 0; n--) {
        const bool ortho = rng_below(&r, 3) == 0;
        const size_t k = rng_below(&r, 3), m = rng_below(&r, NORMAL_METHODS);
        const normal_row *method = normal_get(m);
        const double near = rng_log(&r, 0.01, 10);
        if (strcmp(method->name, "projective") == 0)
            continue;
        texture_camera c = view_camera(kinds[k].format, kinds[k].mapping, near, near * 1e4, ortho, SIDE, SIDE,
                                       ortho ? near * rng_log(&r, 0.01, 3) : rng_log(&r, 0.1, 60));
        view_picture p = view_picture_of(&c);
        normal_tap taps[3];
        double found[3];
        if (take_taps(&r, &c, method, &p, taps)) {
            view_normal(&p, MIDDLE, MIDDLE, found);
            const double bound = normal_corner_bound(&c, method, taps, DP_BATCH_EYE_ERROR);
            for (int i = 0; i < 9 && !isnan(found[0]); i++) {
                double z[3], truth[3];
                for (int j = 0; j < 3; j++)
                    z[j] = taps[j].stored + taps[j].reach * (i == 8              ? rng_uniform(&r, -1, 1)
                                                             : (i >> j & 1) != 0 ? 1
                                                                                 : -1);
                normal_through(&c, taps, z, truth);
                const double angle = normal_angle(found, truth);
                TALLY(&t, angle <= bound, "%s %s %s: off by %.9g, not %.9g", method->name, kinds[k].format,
                      ortho ? "orthographic" : "perspective", angle, bound);
                if (bound < 1 && angle > share[m][ortho] * bound)
                    share[m][ortho] = angle / bound;
            }
            if (!isnan(found[0]))
                lost[m][ortho] = fmax(lost[m][ortho], share_without_cells(&t, &c, method, taps, found));
            for (int i = 0; i < 3 && !isnan(found[0]); i++)
                ones[i] = fmax(ones[i], share_of_one(&t, &c, method, taps, i, found));
        }
        view_picture_free(&p);
    }
    print_message("# of one place: %.3f, %.3f and %.3f of the bound\n", ones[0], ones[1], ones[2]);
    assert_true(ones[0] > 0.95 && ones[1] > 0.95 && ones[2] > 0.95);
    for (size_t m = 0; m < NORMAL_METHODS; m++)
        if (m != NORMAL_PROJECTIVE) {
            const double least = normal_get(m)->half ? 0.15 : 0.025;
            print_message("# %s: %.2f of the bound, orthographic %.2f; without cells %.2f, %.2f\n", normal_get(m)->name,
                          share[m][0], share[m][1], lost[m][0], lost[m][1]);
            assert_true(share[m][0] > 0.6 && share[m][1] > 0.6);
            assert_true(lost[m][0] > least && lost[m][1] > least);
        }
    tally_end(&t);
}

static double half_of(double x) {
    const int e = x != 0 ? ilogb(x) : 0;
    return ldexp(rint(ldexp(x, 10 - e)), e - 10);
}

/* What the neighbours' shares of the picture and depths lose in binary16 before all else: by places moved so, in long
 * double. It is as much as the bound is above that of a method whose places alone are of binary16. */
TEST(shares_of_the_picture_in_binary16) {
    const normal_row *shares = normal_find("medium-half"), *places = normal_find("low-half");
    rng r = rng_make("normal shares");
    tally t = {.name = "shares in binary16"};
    double most = 0;
    for (uint64_t n = test_cases(2000, 20000, 200000); n > 0; n--) {
        const bool ortho = rng_below(&r, 3) == 0;
        const double near = rng_log(&r, 0.01, 10);
        const texture_camera c = view_camera("fp32", DP_MAPPING_REVERSED, near, near * 1e4, ortho, SIDE, SIDE,
                                             ortho ? near * rng_log(&r, 0.01, 3) : rng_uniform(&r, 5, 120));
        view_picture p = view_picture_of(&c);
        normal_tap taps[3], moved[3];
        double z[3], half[3], exact[3], rounded[3];
        if (take_taps(&r, &c, shares, &p, taps)) {
            for (int i = 0; i < 3; i++) {
                taps[i].reach = 0;
                moved[i] = taps[i];
                z[i] = half[i] = taps[i].stored;
                if (i == 0)
                    continue;
                moved[i].column = half_of((taps[i].column + 0.5) / SIDE) * SIDE - 0.5;
                moved[i].row = SIDE - 0.5 - half_of((SIDE - taps[i].row - 0.5) / SIDE) * SIDE;
                half[i] = half_of(z[i]);
            }
            normal_through(&c, taps, z, exact);
            normal_through(&c, moved, half, rounded);
            const double off = normal_angle(exact, rounded), bound = normal_corner_bound(&c, shares, taps, 0);
            const double without = normal_corner_bound(&c, places, taps, 0);
            TALLY(&t, !(bound < 1) || off <= (bound - without) * (1 + 1e-9), "off by %.9g, not %.9g", off,
                  bound - without);
            most = bound < 1 ? fmax(most, off / (bound - without)) : most;
        }
        view_picture_free(&p);
    }
    print_message("# at most %.2f of it\n", most);
    assert_true(most > 0.3);
    tally_end(&t);
}
