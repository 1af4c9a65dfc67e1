/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file steps.h  A formula as a text of a few operations: what is proven of its error (bound.h) and the code that is
 * printed of it (code.h) come from the same row.
 *
 *     steps      name = expression [: what it is in exact arithmetic]; ...     the last is the result
 *     constants  name = expression in n, f, across (1/n - 1/f) and excess (f/n - 1); ...;
 *                of codes in `most`, of places in `pixels` and `half`, which stand in the place of near and far;
 *                of a logarithmic mapping in `scale` and `span`, too, of a depth range in `lo` and `hi`
 *
 * Expressions have + - * / and parentheses, numbers, names, and calls: fma(a, b, c); estimate(x) and magic(x), which
 * are about 1/x; newton(x, y), which is y (2 - x y); whole(x), an integer, and even(x), the nearest one as a number;
 * signed(t, x), which is t with the sign of x; abs, floor, sqrt, min, max, exp2 and log2.
 */
#ifndef METHOD_STEPS_H
#define METHOD_STEPS_H

#include <stdbool.h>

typedef enum steps_kind {
    STEPS_NUMBER = 0,
    STEPS_NAME,
    STEPS_SUM,
    STEPS_DIFFERENCE,
    STEPS_PRODUCT,
    STEPS_QUOTIENT,
    STEPS_NEGATIVE,
    STEPS_CALL
} steps_kind;

enum { STEPS_NODES = 128, STEPS_MAX = 16, STEPS_NAME_SIZE = 12, STEPS_ARGUMENTS = 3 };

typedef struct steps_node {
    steps_kind kind;
    double value;
    char name[STEPS_NAME_SIZE];
    int of[STEPS_ARGUMENTS]; /* nodes; of a sign the first alone, -1 behind the last */
} steps_node;

typedef struct steps {
    steps_node node[STEPS_NODES];
    int nodes, count;
    struct {
        char name[STEPS_NAME_SIZE];
        int is, exact; /* nodes; exact is -1 where the text has none */
    } step[STEPS_MAX];
} steps;

/** The text of a row, which is right. */
void steps_read(const char *text, steps *out);

/** The numbers that form constants: binary64 planes or what stands in their place; of a logarithmic mapping C and
 * log2(C far + 1); the lower and the upper end of the depth range. */
typedef struct steps_given {
    double n, f, scale, span, lo, hi;
} steps_given;

/** A constant in double. */
double steps_value(const steps *s, int node, const steps_given *given);

#endif
