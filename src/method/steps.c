/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/steps.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Reading: by descent, a function for each precedence ----------------------------------------------------------
 */

typedef struct reader {
    const char *at;
    steps *out;
} reader;

static bool took(reader *r, char c) {
    while (*r->at == ' ')
        r->at++;
    const bool is = *r->at == c;
    r->at += is;
    return is;
}

static int node(reader *r, steps_kind kind, int a, int b) {
    r->out->node[r->out->nodes] = (steps_node){.kind = kind, .of = {a, b, -1}};
    return r->out->nodes++;
}

static void read_name(reader *r, char out[STEPS_NAME_SIZE]) {
    size_t length = 0;
    took(r, ' ');
    for (; isalnum((unsigned char)*r->at) || *r->at == '_'; r->at++)
        out[length++] = *r->at;
    out[length] = '\0';
}

static int read_sum(reader *r);

static int read_factor(reader *r) {
    if (took(r, '-'))
        return node(r, STEPS_NEGATIVE, read_factor(r), -1);
    if (took(r, '(')) {
        const int inner = read_sum(r);
        took(r, ')');
        return inner;
    }
    const int leaf = node(r, STEPS_NUMBER, -1, -1);
    steps_node *const of = &r->out->node[leaf];
    if (isdigit((unsigned char)*r->at)) {
        char *end;
        of->value = strtod(r->at, &end);
        r->at = end;
        return leaf;
    }
    of->kind = STEPS_NAME;
    read_name(r, of->name);
    if (took(r, '(')) {
        of->kind = STEPS_CALL;
        for (int i = 0; i == 0 || took(r, ','); i++)
            of->of[i] = read_sum(r);
        took(r, ')');
    }
    return leaf;
}

static int read_product(reader *r) {
    int left = read_factor(r);
    for (;;)
        if (took(r, '*'))
            left = node(r, STEPS_PRODUCT, left, read_factor(r));
        else if (took(r, '/'))
            left = node(r, STEPS_QUOTIENT, left, read_factor(r));
        else
            return left;
}

static int read_sum(reader *r) {
    int left = read_product(r);
    for (;;)
        if (took(r, '+'))
            left = node(r, STEPS_SUM, left, read_product(r));
        else if (took(r, '-'))
            left = node(r, STEPS_DIFFERENCE, left, read_product(r));
        else
            return left;
}

void steps_read(const char *text, steps *out) {
    reader r = {text, out};
    out->nodes = out->count = 0;
    do {
        read_name(&r, out->step[out->count].name);
        took(&r, '=');
        out->step[out->count].is = read_sum(&r);
        out->step[out->count++].exact = took(&r, ':') ? read_sum(&r) : -1;
    } while (took(&r, ';'));
}

/* ---- Values ------------------------------------------------------------------------------------------------------ */

/* f/n - 1, without the cancellation of it, and 1/n - 1/f. */
static double named(const char *name, const steps_given *g) {
    const double excess = (g->f - g->n) / g->n;
    const struct {
        const char *name;
        double value;
    } names[] = {{"n", g->n},         {"most", g->n},    {"pixels", g->n},   {"f", g->f},   {"half", g->f},
                 {"scale", g->scale}, {"span", g->span}, {"excess", excess}, {"lo", g->lo}, {"hi", g->hi}};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(name, names[i].name) == 0)
            return names[i].value;
    return isinf(g->f) ? 1 / g->n : excess / g->f;
}

double steps_value(const steps *s, int index, const steps_given *given) {
    const steps_node *of = &s->node[index];
    if (of->kind == STEPS_NUMBER)
        return of->value;
    if (of->kind == STEPS_NAME)
        return named(of->name, given);
    const double a = steps_value(s, of->of[0], given), b = of->of[1] < 0 ? 0 : steps_value(s, of->of[1], given);
    return of->kind == STEPS_SUM          ? a + b
           : of->kind == STEPS_DIFFERENCE ? a - b
           : of->kind == STEPS_PRODUCT    ? a * b
           : of->kind == STEPS_QUOTIENT   ? a / b
                                          : -a;
}
