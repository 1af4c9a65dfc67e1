/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which method to use, and which comes next: of timings and errors by hand. */
#include "method/advice.h"
#include "support.h"

enum { ROWS = 5 };

/* Methods of a family whose errors are relative, that answer for the lattice. */
static void make(bench_result out[ROWS], const double ns[ROWS], const double error[ROWS]) {
    static method_row row;
    for (int i = 0; i < ROWS; i++) {
        out[i] = (bench_result){.row = &row, .ns = ns[i], .front = true};
        out[i].measured.worst = (method_error){error[i], error[i], error[i]};
    }
}

TEST(the_next_has_half_the_error) {
    bench_result r[ROWS];
    make(r, (double[]){1, 2, 3, 4, 5}, (double[]){8e-5, 5e-5, 4e-5, 1e-5, 1e-6});
    assert_ptr_equal(advice_use(&linearize_family, r, ROWS), &r[0]);
    assert_ptr_equal(advice_next(&linearize_family, r, ROWS, &r[0]), &r[2]); /* just half; what is above it is not */
    r[2].front = false;
    assert_ptr_equal(advice_next(&linearize_family, r, ROWS, &r[0]), &r[3]);
    assert_null(advice_next(&linearize_family, r, ROWS, &r[4]));
    assert_null(advice_next(&linearize_family, r, ROWS, NULL));
}

TEST(the_fastest_with_four_digits_is_used) {
    bench_result r[ROWS];
    make(r, (double[]){1, 2, 3, 4, 5}, (double[]){2e-4, 1.1e-4, 0.9e-4, 1e-5, 1e-6});
    assert_ptr_equal(advice_use(&linearize_family, r, ROWS), &r[2]);
    r[2].front = false;
    assert_ptr_equal(advice_use(&linearize_family, r, ROWS), &r[3]);
    r[3].ns = 6; /* what is faster and better still */
    assert_ptr_equal(advice_use(&linearize_family, r, ROWS), &r[4]);
}

TEST(else_the_most_exact) {
    bench_result r[ROWS];
    make(r, (double[]){1, 2, 3, 4, 5}, (double[]){0.5, 0.1, 0.3, 0.1, 0.2});
    assert_ptr_equal(advice_use(&linearize_family, r, ROWS), &r[1]); /* of two that are alike the faster */
    for (int i = 0; i < ROWS; i++)
        r[i].front = false;
    assert_null(advice_use(&linearize_family, r, ROWS));
}

/* Codes: one step is well. */
TEST(steps) {
    bench_result r[ROWS];
    make(r, (double[]){1, 2, 3, 4, 5}, (double[]){1.5, 1, 0.9, 0.5, 0.4});
    assert_ptr_equal(advice_use(&encode_family, r, ROWS), &r[1]);
    assert_ptr_equal(advice_next(&encode_family, r, ROWS, &r[1]), &r[3]);
}

int main(void) {
    return run_listed(NULL, NULL);
}
