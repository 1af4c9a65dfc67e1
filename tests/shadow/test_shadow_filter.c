/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Filters of shadow maps: what each reads, tap by tap, against the radius of its row; what moments and exponentials
 * lose, by numbers that are rounded here.
 */
#include "printed.h"
#include "shadow/filter.h"

/* How far the farthest texel centre is that a tap at x reads, from a point at p: one texel, or two on each axis. */
static double reads(double x, bool pair, double p) {
    const double first = pair ? floor(x - 0.5) + 0.5 : floor(x) + 0.5, last = pair ? first + 1.0 : first;
    return fmax(fabs(first - p), fabs(last - p));
}

TEST(radii) {
    rng r = rng_make("shadow filters");
    tally t = {.name = "filters"};
    for (size_t f = 0; shadow_filter_get(f) != NULL; f++) {
        const shadow_filter *row = shadow_filter_get(f);
        const bool pair = strstr(row->name, "2x2") != NULL || strcmp(row->name, "bilinear") == 0;
        const bool square = strncmp(row->name, "pcf", 3) == 0, disk = row->per == 1.0;
        if (row->instead[0] != '\0')
            continue;
        for (int n = 0; n < 200; n++) {
            const double x = square ? (double)(1 + rng_below(&r, 9)) : disk ? rng_uniform(&r, 0.0, 5.0) : 0.0;
            const double radius = shadow_filter_radius(row, x);
            double most = 0.0;
            for (int i = 0; i < 4000; i++) {
                const double p = rng_uniform(&r, 5.0, 6.0);
                const double off = square ? (double)rng_below(&r, (uint64_t)x) - (x - 1.0) / 2.0
                                   : disk ? rng_uniform(&r, -x, x)
                                          : 0.0;
                most = fmax(most, reads(p + off, pair, p));
            }
            TALLY(&t, most <= radius + 1e-9 && most >= radius - 0.05 * (1.0 + x), "%s:%g reads %g, not %g", row->name,
                  x, most, radius);
        }
    }
    tally_end(&t);
}

/* A number of that many significant bits. */
static double rounded(double x, int bits) {
    int e;
    const double m = frexp(x, &e);
    return x == 0.0 ? 0.0 : ldexp(nearbyint(ldexp(m, bits)), e - bits);
}

TEST(lost) {
    rng r = rng_make("shadow filters lost");
    const shadow_filter *moments = shadow_filter_find("vsm"), *factor = shadow_filter_find("exponential");
    for (int bits = 11; bits <= 24; bits += 13) {
        const double c = bits == 11 ? 11.08 : 88.7, largest = bits == 11 ? 65504.0 : 0x1.fffffep127;
        const double lost = bits == 11 ? moments->lost16 : moments->lost32;
        double deviation = 0.0, off = 0.0;
        for (int i = 0; i < 200000; i++) {
            const double d = rng_uniform(&r, 0.5, 1.0), m1 = rounded(d, bits), m2 = rounded(d * d, bits);
            deviation = fmax(deviation, sqrt(fmax(m2 - m1 * m1, 0.0)));
            off = fmax(off, fabs(log(rounded(exp(c * d), bits)) / c - d));
        }
        assert_true(deviation <= lost && deviation >= 0.6 * lost);
        assert_true(off <= (bits == 11 ? factor->lost16 : factor->lost32) * 1.001);
        assert_true(off >= (bits == 11 ? factor->lost16 : factor->lost32) * 0.9);
        assert_true(exp(c) < largest && exp(c + 0.1) > largest);
    }
}

/* By name and by kernel it is the same; engines are judged with a status. */
TEST(named) {
    static const char *const same[][2] = {{"nearest", "1"},   {"bilinear", "2"},    {"pcf:5", "5"},
                                          {"pcf-2x2:5", "6"}, {"poisson:2.5", "6"}, {"vogel:2.5", "7"},
                                          {"pcss:7.2", "16"}};
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++) {
        json_t *a = json_printed(0, "shadow --light-box 10x10x10 --filter %s", same[i][0]);
        json_t *b = json_printed(0, "shadow --light-box 10x10x10 --kernel %s", same[i][1]);
        assert_true(json_equal(a, b));
        json_decref(a);
        json_decref(b);
    }
    static const refused_row rows[] = {{"--filter vsm", "0.0383 in 16 bits", 2},
                                       {"--filter esm", "c = 88.7", 2},
                                       {"--filter pcf", "pcf:N", 2},
                                       {"--filter pcf:2.5", "whole", 2},
                                       {"--filter nearest:1", "no number", 2},
                                       {"--filter mist", "nearest", 2},
                                       {"--filter pcf:3 --kernel 3", "--kernel", 2},
                                       {"--engine three:-0.005", "--bias and --normal-bias", 2},
                                       {"--engine three --csv", "text and JSON", 2},
                                       {"--rasterize --csv", "text and JSON", 2},
                                       {"--check", "--engine", 2}};
    CHECK_REFUSED("shadow --light-box 10x10x10", rows);
    check_says(1, "not enough", "shadow --light-box 10x10x10 --engine three --check");
    check_says(0, "enough up to", "shadow --light-box 10x10x10 --engine three --shadowBias -0.01 --check");
    check_says(1, "", "shadow --light-box 10x10x10 --engine three --check --json");
}
