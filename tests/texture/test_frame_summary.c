/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statistics of frames: those of a plain count. */
#include "named.h"
#include "support.h"
#include "synthetic_stage.h"

static int by_value(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

TEST(summaries_are_those_of_sorted_numbers) {
    synthetic_stage s;
    synthetic_stage_set(&s, "plane", "unorm16", "d3d", 1000, false, 700, 400);
    s.parameters[1] = 60;
    const frame_product p = {.kind = FRAME_EYE, .error = true};
    frame_summary sum;
    float *values = frame_made(&s.frame, &p, false);
    size_t count = 0, greatest = 0;
    long double total = 0;
    for (size_t i = 0; i < 700 * 400; i++)
        if (!isnan(values[i]) && !(values[i] <= values[greatest]))
            greatest = i;
    const uint32_t greatest_column = (uint32_t)(greatest % 700), greatest_row = (uint32_t)(greatest / 700);
    for (size_t i = 0; i < 700 * 400; i++)
        if (!isnan(values[i])) {
            total += (long double)values[i];
            values[count++] = values[i];
        }
    qsort(values, count, sizeof *values, by_value);
    assert_true(frame_summarise(&s.frame, &p, &sum));
    assert_int_equal(sum.count, count);
    assert_true(count > 100000 && count < 700 * 400); /* some is sky */
    assert_true(sum.lo == (double)values[0] && sum.hi == (double)values[count - 1]);
    assert_relative(sum.mean, (double)(total / count), 1e-12);
    assert_true(sum.hi_column == greatest_column && sum.hi_row == greatest_row && greatest_row % 8 != 0);
    const double p99 = (double)values[(size_t)ceil(0.99 * (double)count) - 1];
    assert_true(sum.p99 >= p99 && sum.p99 <= p99 * (1 + 0x1p-11));
    free(values);
}

/* Samples of binary16 that are off by 2^-24: one is the far plane's own, one may be infinitely far, one is near. */
TEST(summaries_leave_out_sky_and_what_has_no_bound) {
    static uint32_t codes[] = {0, 1, 0x3800};
    const image depths = {.width = 3, .height = 1, .channels = 1, .type = IMAGE_U32, .data = codes};
    const grain g = {.kind = GRAIN_FLOATS, .bits = 11, .margin = 0x1p-24, .least = 0x1p-24};
    const frame_product error = {.kind = FRAME_EYE, .error = true};
    frame_summary sum;
    synthetic_stage s;
    synthetic_stage_set(&s, "plane", "fp16", "reversed", INFINITY, false, 3, 1);
    s.frame.synthetic = NULL;
    s.frame.image = &depths;
    s.frame.grain = &g;
    s.frame.sky = 0;
    assert_true(frame_summarise(&s.frame, &error, &sum));
    assert_int_equal(sum.count, 1);
    assert_int_equal(sum.infinite, 1);
    assert_int_equal(sum.hi_column, 2);
    assert_true(frame_summarise_decoding(&s.frame, decode_find("linear-eye"), false, &sum));
    assert_int_equal(sum.count, 2);
    assert_int_equal(sum.infinite, 0);
}
