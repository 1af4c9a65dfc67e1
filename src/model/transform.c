/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/transform.h"

#include "core/elementary.h"

/* ---- Numbers of either kind -------------------------------------------------------------------------------------- */

static dp_pair number(model_transforms kind, double x) {
    return (dp_pair){kind == MODEL_BINARY32 ? (double)(float)x : x, 0.0};
}

/* In binary32 sums and products of doubles are rounded once to it: double has more than twice its bits. */
static dp_pair plus(model_transforms kind, dp_pair a, dp_pair b) {
    if (kind == MODEL_BINARY32)
        return number(kind, a.hi + b.hi);
    return dp_pair_sum(a, b);
}

static dp_pair times(model_transforms kind, dp_pair a, dp_pair b) {
    if (kind == MODEL_BINARY32)
        return number(kind, a.hi * b.hi);
    return dp_pair_product(a, b);
}

static dp_pair negative(dp_pair a) {
    return (dp_pair){-a.hi, -a.lo};
}

/* ---- Matrices ---------------------------------------------------------------------------------------------------- */

transform transform_identity(model_transforms kind) {
    transform t = {.kind = kind};
    for (int i = 0; i < 3; i++)
        t.m[i][i].hi = 1.0;
    return t;
}

transform transform_of_matrix(model_transforms kind, const double m[16]) {
    transform t = {.kind = kind};
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            t.m[row][column] = number(kind, m[4 * column + row]);
    return t;
}

/* The matrix of a quaternion, which is a rotation where its length is 1: 1 - 2 (b b + c c) on the diagonal. */
transform transform_of_parts(model_transforms kind, const double t[3], const double q[4], const double s[3]) {
    transform out = {.kind = kind};
    const dp_pair one = number(kind, 1.0), two = number(kind, 2.0), w = number(kind, q[3]);
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const dp_pair a = number(kind, q[i]), b = number(kind, q[j]), c = number(kind, q[k]);
        const dp_pair squares = plus(kind, times(kind, b, b), times(kind, c, c));
        const dp_pair product = times(kind, a, b), cross = times(kind, c, w);
        out.m[i][i] = plus(kind, one, negative(times(kind, two, squares)));
        out.m[j][i] = times(kind, two, plus(kind, product, cross));
        out.m[i][j] = times(kind, two, plus(kind, product, negative(cross)));
        out.m[i][3] = number(kind, t[i]);
    }
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            out.m[row][column] = times(kind, out.m[row][column], number(kind, s[column]));
    return out;
}

transform transform_times(const transform *outer, const transform *inner) {
    transform out = {.kind = outer->kind};
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++) {
            dp_pair sum = times(out.kind, outer->m[row][0], inner->m[0][column]);
            for (int k = 1; k < 3; k++)
                sum = plus(out.kind, sum, times(out.kind, outer->m[row][k], inner->m[k][column]));
            out.m[row][column] = column == 3 ? plus(out.kind, sum, outer->m[row][3]) : sum;
        }
    return out;
}

void transform_point(const transform *t, const double from[3], double to[3]) {
    for (int row = 0; row < 3; row++) {
        dp_pair sum = times(t->kind, t->m[row][0], number(t->kind, from[0]));
        for (int k = 1; k < 3; k++)
            sum = plus(t->kind, sum, times(t->kind, t->m[row][k], number(t->kind, from[k])));
        to[row] = plus(t->kind, sum, t->m[row][3]).hi;
    }
}

void transform_axis(const transform *t, int k, double to[3]) {
    const double length = dp_hypot(dp_hypot(t->m[0][k].hi, t->m[1][k].hi), t->m[2][k].hi);
    for (int row = 0; row < 3; row++)
        to[row] = length > 0.0 ? t->m[row][k].hi / length : 0.0;
}

bool transform_mirrors(const transform *t) {
    double sum = 0.0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += t->m[0][i].hi * (t->m[1][j].hi * t->m[2][k].hi - t->m[1][k].hi * t->m[2][j].hi);
    }
    return sum < 0.0;
}

bool transform_finite(const transform *t) {
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            if (!isfinite(t->m[row][column].hi))
                return false;
    return true;
}
