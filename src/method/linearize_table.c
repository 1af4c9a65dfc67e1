/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eye depth from what was worked out before: a table in binary32, a cubic spline and a Chebyshev series of GSL, all
 * three over [0, 1] in equal steps of d. z(d) has a pole just beyond its far end, which is why they do so badly. */
#include "method/linearize.h"

#include <math.h>
#include <stdlib.h>

#include <gsl/gsl_chebyshev.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_spline.h>

void method_start(void) {
    gsl_set_error_handler_off();
}

typedef struct table {
    float z[LINEARIZE_TABLE + 1]; /* the last once more, so that the end needs no test */
} table;

void *table_open(const dp_setup *setup) {
    table *t = malloc(sizeof *t);
    for (int i = 0; t != NULL && i < LINEARIZE_TABLE; i++) {
        double last = LINEARIZE_TABLE - 1;
        t->z[i] = (float)dp_eye(setup, i / last, (last - i) / last);
    }
    if (t != NULL)
        t->z[LINEARIZE_TABLE] = t->z[LINEARIZE_TABLE - 1];
    return t;
}

void table_close(void *state) {
    free(state);
}

void table_nearest(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const table *t = state;
    (void)setup;
    for (size_t i = 0; i < in->count; i++)
        out->eye[i] = t->z[(int)(in->d[i] * (LINEARIZE_TABLE - 1) + 0.5f)];
}

void table_linear(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const table *t = state;
    (void)setup;
    for (size_t i = 0; i < in->count; i++) {
        float at = in->d[i] * (LINEARIZE_TABLE - 1);
        int k = (int)at;
        float part = at - (float)k;
        out->eye[i] = t->z[k] + part * (t->z[k + 1] - t->z[k]);
    }
}

typedef struct spline {
    gsl_spline *curve;
    gsl_interp_accel *memory;
} spline;

void spline_close(void *state) {
    spline *s = state;
    gsl_spline_free(s->curve);
    gsl_interp_accel_free(s->memory);
    free(s);
}

void *spline_open(const dp_setup *setup) {
    spline *s = calloc(1, sizeof *s);
    double *x = malloc(2 * LINEARIZE_KNOTS * sizeof *x), *y = x + LINEARIZE_KNOTS;
    bool good = s != NULL && x != NULL;
    method_start();
    for (int i = 0; good && i < LINEARIZE_KNOTS; i++) {
        double last = LINEARIZE_KNOTS - 1;
        x[i] = i / last;
        y[i] = dp_eye(setup, x[i], (last - i) / last);
    }
    if (good) {
        s->curve = gsl_spline_alloc(gsl_interp_cspline, LINEARIZE_KNOTS);
        s->memory = gsl_interp_accel_alloc();
        good = s->curve != NULL && s->memory != NULL && gsl_spline_init(s->curve, x, y, LINEARIZE_KNOTS) == 0;
    }
    if (!good && s != NULL) {
        spline_close(s);
        s = NULL;
    }
    free(x);
    return s;
}

void spline_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    const spline *s = state;
    (void)setup;
    for (size_t i = 0; i < in->count; i++)
        out->eye[i] = (float)gsl_spline_eval(s->curve, (double)in->d[i], s->memory);
}

static double eye_of(double d, void *setup) {
    return dp_eye(setup, d, 1 - d);
}

void *chebyshev_open(const dp_setup *setup) {
    method_start();
    gsl_cheb_series *c = gsl_cheb_alloc(LINEARIZE_ORDER);
    const gsl_function f = {eye_of, (void *)setup};
    if (c != NULL)
        gsl_cheb_init(c, &f, 0, 1);
    return c;
}

void chebyshev_close(void *state) {
    gsl_cheb_free(state);
}

void chebyshev_run(const dp_setup *setup, const void *state, const method_inputs *in, const method_outputs *out) {
    (void)setup;
    for (size_t i = 0; i < in->count; i++)
        out->eye[i] = (float)gsl_cheb_eval(state, (double)in->d[i]);
}
