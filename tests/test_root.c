/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A root: what is found lies beside the change of sign, in few steps, also where the function is flat, steep or jumps.
 */
#include "requirement/root.h"
#include "support.h"

enum { MOST = 202 }; /* both ends and 200 steps */

typedef struct counted {
    double (*f)(double x, double at);
    double at; /* where it changes its sign */
    int calls;
} counted;

static double count(double x, void *context) {
    counted *c = context;
    c->calls++;
    return c->f(x, c->at);
}

static double line(double x, double at) {
    return x - at;
}

static double cube(double x, double at) {
    return (x - at) * (x - at) * (x - at);
}

static double falling(double x, double at) {
    return at * at * at - x * x * x;
}

static double jump(double x, double at) {
    return x < at ? -1e-9 : 1;
}

static double flat(double x, double at) {
    return x < at ? -1 : (x - at) * 1e-12 + 1e-300;
}

TEST(test_enclosed) {
    static double (*const all[])(double, double) = {line, cube, falling, jump, flat};
    static const int steps[] = {8, MOST, 16, MOST, MOST}; /* what converges fast must */
    static const double places[] = {0x1p-60, 1e-3, 0.1, 1.0 / 3, 0.999999, 17, 1e6 + 0.1, 0x1p40 + 3};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        for (size_t k = 0; k < sizeof places / sizeof *places; k++) {
            counted c = {.f = all[i], .at = places[k]};
            const double lo = places[k] / 7, hi = places[k] * 5, apart = 0x1p-50 * places[k];
            const double x = root_find(count, &c, lo, hi, apart);
            assert_true(fabs(x - places[k]) <= apart || c.f(x, places[k]) == 0 ||
                        (all[i] == cube && fabs(c.f(x, places[k])) < 0x1p-100 * places[k] * places[k] * places[k]));
            if (c.calls > steps[i])
                fail_msg("function %zu at %g: %d calls", i, places[k], c.calls);
        }
}

/* No two doubles are that close: it ends where none is left between the ends. */
TEST(test_nothing_between) {
    counted c = {.f = jump, .at = 3};
    const double x = root_find(count, &c, 1, 4, 1e-300);
    assert_true(x == 3 || x == nextafter(3, 0));
    assert_in_range(c.calls, 3, MOST);
}

TEST(test_ends) {
    counted c = {.f = line, .at = 2};
    assert_true(root_find(count, &c, 2, 9, 1e-9) == 2);
    assert_true(root_find(count, &c, -9, 2, 1e-9) == 2);
    assert_true(root_find(count, &c, 3, 9, 1e-9) == 3); /* no change of sign */
}
