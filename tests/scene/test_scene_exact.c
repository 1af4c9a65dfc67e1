/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The decisions about triangles, each against the same determinant in rationals (GMP): of numbers with all their bits,
 * where a point or a turn lies as near to none as rounding its coordinates leaves it; of the same with what is next to
 * nothing beside it; of whole numbers, where it is none; and in line with two corners, where rounding alone makes one.
 */
#include <gmp.h>

#include "scene/exact.h"
#include "support.h"

/* ---- In rationals ------------------------------------------------------------------------------------------------ */

typedef mpq_t vector[3];

static void begin(vector v) {
    for (int k = 0; k < 3; k++)
        mpq_init(v[k]);
}

static void end(vector v) {
    for (int k = 0; k < 3; k++)
        mpq_clear(v[k]);
}

static void difference(vector out, const double to[3], const double from[3]) {
    mpq_t x;
    mpq_init(x);
    for (int k = 0; k < 3; k++) {
        mpq_set_d(out[k], to[k]);
        mpq_set_d(x, from[k]);
        mpq_sub(out[k], out[k], x);
    }
    mpq_clear(x);
}

/* (b - a) x (c - a) */
static void cross(vector out, const double a[3], const double b[3], const double c[3]) {
    vector u, v;
    mpq_t x;
    begin(u);
    begin(v);
    mpq_init(x);
    difference(u, b, a);
    difference(v, c, a);
    for (int k = 0; k < 3; k++) {
        mpq_mul(out[k], u[(k + 1) % 3], v[(k + 2) % 3]);
        mpq_mul(x, u[(k + 2) % 3], v[(k + 1) % 3]);
        mpq_sub(out[k], out[k], x);
    }
    mpq_clear(x);
    end(u);
    end(v);
}

static int sign_of_dot(vector u, vector v) {
    mpq_t sum, x;
    mpq_inits(sum, x, (mpq_ptr)0);
    for (int k = 0; k < 3; k++) {
        mpq_mul(x, u[k], v[k]);
        mpq_add(sum, sum, x);
    }
    const int sign = mpq_sgn(sum);
    mpq_clears(sum, x, (mpq_ptr)0);
    return sign;
}

static int true_side(const double t[3][3], const double p[3]) {
    vector n, d;
    begin(n);
    begin(d);
    cross(n, t[0], t[1], t[2]);
    difference(d, p, t[0]);
    const int sign = sign_of_dot(n, d);
    end(n);
    end(d);
    return sign;
}

/* The direction of view is that of a and of b, or its opposite, together. */
static int true_turn(const double a[3][3], const double b[3][3], int sign, const double p[3][3]) {
    vector n, m, turned;
    begin(n);
    begin(m);
    begin(turned);
    cross(n, a[0], a[1], a[2]);
    cross(m, b[0], b[1], b[2]);
    for (int k = 0; k < 3; k++) {
        if (sign < 0)
            mpq_neg(m[k], m[k]);
        mpq_add(n[k], n[k], m[k]);
    }
    cross(turned, p[0], p[1], p[2]);
    const int turn = sign_of_dot(n, turned);
    end(n);
    end(m);
    end(turned);
    return turn;
}

/* ---- Points ------------------------------------------------------------------------------------------------------ */

enum { ROUNDED, WHOLE, TINY, LINED, KINDS };

static double number(rng *r, int kind) {
    return kind == ROUNDED || kind == LINED ? rng_uniform(r, -1, 1) : (double)rng_below(r, 17) - 8;
}

static void any_point(rng *r, int kind, double p[3]) {
    for (int k = 0; k < 3; k++)
        p[k] = number(r, kind);
}

static void any_triangle(rng *r, int kind, double t[3][3]) {
    for (int i = 0; i < 3; i++)
        any_point(r, kind, t[i]);
}

/* from + u (a - from) + v (b - from), rounded; whole numbers stay such. */
static void point_between(const double from[3], const double a[3], const double b[3], double u, double v, double p[3]) {
    for (int k = 0; k < 3; k++)
        p[k] = from[k] + u * (a[k] - from[k]) + v * (b[k] - from[k]);
}

/* What is next to nothing beside whole numbers, of either sign. */
static double tiny(rng *r) {
    const double size = rng_log(r, 1e-40, 1e-20);
    return rng_below(r, 2) == 0 ? size : -size;
}

/* In the plane of any triangle with two of these corners: on the line through them, a sixteenth of the way or more. */
static void line_of_two(rng *r, double a[3], double b[3], double p[3]) {
    const double share = (double)rng_below(r, 65) / 16 - 2;
    for (int k = 0; k < 3; k++) {
        a[k] = ldexp((double)rng_below(r, 1 << 24), -20);
        b[k] = ldexp((double)rng_below(r, 1 << 24), -20);
        p[k] = a[k] + share * (b[k] - a[k]);
    }
}

/* ---- Decisions --------------------------------------------------------------------------------------------------- */

TEST(sides_of_planes) {
    rng r = rng_make("sides of planes");
    tally t = {.name = "sides"};
    int seen[KINDS][3] = {{0}};
    for (uint64_t n = test_cases(3000, 30000, 1000000); n > 0; n--) {
        const int kind = (int)rng_below(&r, KINDS);
        double p[3], of[3][3];
        const size_t moved = (size_t)rng_below(&r, 3);
        any_triangle(&r, kind, of);
        of[0][moved] = kind == TINY ? 0 : of[0][moved];
        const double u = number(&r, kind);
        const double v = number(&r, kind);
        point_between(of[0], of[1], of[2], u, v, p);
        if (kind == TINY)
            of[0][moved] = tiny(&r);
        if (kind == LINED) {
            const size_t corner = (size_t)rng_below(&r, 3);
            line_of_two(&r, of[corner], of[(corner + 1) % 3], p);
        }
        const int is = true_side((const double(*)[3])of, p),
                  got = exact_above((exact_triangle){of[0], of[1], of[2]}, p);
        seen[kind][is + 1]++;
        TALLY(&t, got == is, "kind %d: %d, not %d", kind, got, is);
    }
    for (int k = 0; k < 3; k++) /* of rounded points few are in the plane, of whole ones all */
        assert_true((k == 1 || seen[ROUNDED][k] > 200) && seen[TINY][k] > 20);
    assert_true(seen[WHOLE][1] > 200 && seen[LINED][1] > 200);
    tally_end(&t);
}

/* Three points that are in line as the eye sees them, but for what rounding and next to nothing leave. */
static void line_up(rng *r, int kind, const double n[3], double p[3][3]) {
    any_point(r, kind, p[0]);
    any_point(r, kind, p[1]);
    const size_t moved = (size_t)rng_below(r, 3);
    p[0][moved] = kind == TINY ? 0 : p[0][moved];
    const double u = number(r, kind);
    const double along = number(r, kind);
    for (int k = 0; k < 3; k++)
        p[2][k] = p[0][k] + u * (p[1][k] - p[0][k]) + along * n[k];
    if (kind == TINY)
        p[0][moved] = tiny(r);
}

TEST(turns) {
    rng r = rng_make("turns");
    tally t = {.name = "turns"};
    int seen[KINDS][3] = {{0}};
    for (uint64_t n = test_cases(2000, 20000, 1000000); n > 0; n--) {
        const int kind = (int)rng_below(&r, LINED), sign = rng_below(&r, 2) == 0 ? 1 : -1;
        double a[3][3], b[3][3], p[3][3], eye[3];
        any_triangle(&r, kind, a);
        any_triangle(&r, kind, b);
        exact_view view;
        exact_look(&view, (exact_triangle){a[0], a[1], a[2]}, (exact_triangle){b[0], b[1], b[2]}, sign);
        for (int k = 0; k < 3; k++) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            eye[k] = (a[1][i] - a[0][i]) * (a[2][j] - a[0][j]) - (a[1][j] - a[0][j]) * (a[2][i] - a[0][i]) +
                     sign * ((b[1][i] - b[0][i]) * (b[2][j] - b[0][j]) - (b[1][j] - b[0][j]) * (b[2][i] - b[0][i]));
        }
        line_up(&r, kind, eye, p);
        const int is = true_turn((const double(*)[3])a, (const double(*)[3])b, sign, (const double(*)[3])p);
        const int got = exact_turn(&view, p[0], p[1], p[2]), quick = exact_turn_quick(&view, p[0], p[1], p[2]);
        seen[kind][is + 1]++;
        TALLY(&t, got == is, "kind %d, sign %d: %d, not %d", kind, sign, got, is);
        TALLY(&t, quick == is || quick == EXACT_UNSURE, "kind %d: quickly %d, not %d", kind, quick, is);
    }
    for (int k = 0; k < 3; k++)
        assert_true((k == 1 || seen[ROUNDED][k] > 200) && seen[TINY][k] > 20);
    assert_true(seen[WHOLE][1] > 200);
    tally_end(&t);
}

/* A point of the plane in which one coordinate is a power of two times another. */
static void point_in(rng *r, int kind, int i, double times, double p[3]) {
    any_point(r, kind, p);
    p[i] = times * p[(i + 1) % 3];
}

/* Surfaces in one plane: the eye looks along its normal, from the side that the first one shows. */
TEST(turns_in_one_plane) {
    rng r = rng_make("turns in one plane");
    tally t = {.name = "turns"};
    int seen[2][3] = {{0}};
    for (uint64_t n = test_cases(2000, 20000, 1000000); n > 0; n--) {
        const int kind = (int)rng_below(&r, 2), i = (int)rng_below(&r, 3);
        const double side = rng_below(&r, 2) == 0 ? 1 : -1;
        const double times = ldexp(side, (int)rng_below(&r, 7) - 3);
        double a[3][3], b[3][3], p[3][3];
        for (int k = 0; k < 3; k++) {
            point_in(&r, kind, i, times, a[k]);
            point_in(&r, kind, i, times, b[k]);
            point_in(&r, kind, i, times, p[k]);
        }
        const double u = number(&r, kind);
        for (int k = 0; k < 3; k++) /* nearly in line */
            p[2][k] = p[0][k] + u * (p[1][k] - p[0][k]);
        p[2][i] = times * p[2][(i + 1) % 3];
        vector na, nb;
        begin(na);
        begin(nb);
        cross(na, a[0], a[1], a[2]);
        cross(nb, b[0], b[1], b[2]);
        const int dot = sign_of_dot(na, nb);
        end(na);
        end(nb);
        if (dot == 0) /* one of them has no area */
            continue;
        exact_view view;
        exact_look(&view, (exact_triangle){a[0], a[1], a[2]}, (exact_triangle){b[0], b[1], b[2]}, dot);
        view.plane = true;
        const int is = true_turn((const double(*)[3])a, (const double(*)[3])b, dot, (const double(*)[3])p);
        const int got = exact_turn(&view, p[0], p[1], p[2]);
        seen[kind][is + 1]++;
        TALLY(&t, got == is, "kind %d, axis %d, times %g: %d, not %d", kind, i, times, got, is);
    }
    assert_true(seen[ROUNDED][0] > 200 && seen[ROUNDED][2] > 200 && seen[WHOLE][1] > 200);
    tally_end(&t);
}

/* Normals of triangles that are nearly lines: each component within 2^-42 of the length, and none of a line. */
TEST(normals) {
    rng r = rng_make("normals");
    tally t = {.name = "normals"};
    int lines = 0, others = 0;
    for (uint64_t n = test_cases(2000, 20000, 1000000); n > 0; n--) {
        const int kind = (int)rng_below(&r, KINDS);
        const double beside = kind == ROUNDED ? rng_log(&r, 1e-20, 1) : 0;
        double p[3][3], got[3], away[3];
        any_point(&r, kind, away);
        for (int k = 0; k < 3; k++)
            away[k] *= beside;
        line_up(&r, kind, away, p);
        vector is;
        begin(is);
        cross(is, p[0], p[1], p[2]);
        const bool none = mpq_sgn(is[0]) == 0 && mpq_sgn(is[1]) == 0 && mpq_sgn(is[2]) == 0;
        const bool some = exact_normal((exact_triangle){p[0], p[1], p[2]}, got);
        double length = 0, off = 0;
        mpq_t x;
        mpq_init(x);
        for (int k = 0; k < 3; k++) {
            length = fmax(length, fabs(mpq_get_d(is[k])));
            mpq_set_d(x, got[k]);
            mpq_sub(x, x, is[k]);
            off = fmax(off, fabs(mpq_get_d(x)));
        }
        mpq_clear(x);
        end(is);
        none ? lines++ : others++;
        TALLY(&t, some != none, "kind %d: %s", kind, some ? "a line has a normal" : "no normal");
        TALLY(&t, off <= 0x1p-42 * length, "kind %d: off by %g of %g", kind, off, length);
    }
    assert_true(lines > 200 && others > 200);
    tally_end(&t);
}
