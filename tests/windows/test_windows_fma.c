/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stand-in for a fused operation on Windows, against the C library's own: numbers of every size, near each other
 * and near what cancels or cannot be held. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "support.h"
#include "windows/fma.h"

static uint64_t seed = 1;

static uint64_t drawn(void) {
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return seed;
}

static double any(void) { /* often few bits, so that halves are met */
    const uint64_t bits = drawn(), few = drawn() % 3 == 0 ? ~0ULL << drawn() % 53 : ~0ULL;
    double x;
    memcpy(&x, &(uint64_t){bits & few}, sizeof x);
    return drawn() % 8 == 0 ? ldexp(x, -(int)(drawn() % 2000)) : x;
}

static float anyf(void) {
    const uint32_t bits = (uint32_t)(drawn() >> 20) & (drawn() % 3 == 0 ? ~0U << drawn() % 24 : ~0U);
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static bool same(double a, double b) {
    return (isnan(a) && isnan(b)) || memcmp(&a, &b, sizeof a) == 0;
}

TEST(a_fused_operation_is_rounded_once) {
    for (int i = 0; i < 2000000; i++) {
        const double x = any(), y = i % 2 == 0 ? any() : ldexp(1.0, (int)(drawn() % 2000) - 1000) + DBL_MIN;
        const double near = -x * y * (1 + (double)((int)(drawn() % 9) - 4) * DBL_EPSILON);
        const double z = i % 3 == 0 ? any() : i % 3 == 1 ? near : ldexp(near, (int)(drawn() % 260) - 130);
        if (!same(windows_fma(x, y, z), fma(x, y, z)))
            fail_msg("fma(%a, %a, %a) is %a, want %a", x, y, z, windows_fma(x, y, z), fma(x, y, z));
    }
}

TEST(a_fused_operation_of_floats_is_rounded_once) {
    for (int i = 0; i < 2000000; i++) {
        const float x = anyf(), y = anyf(), near = -x * y * (1 + (float)((int)(drawn() % 9) - 4) * FLT_EPSILON);
        const float z = i % 3 == 0 ? anyf() : i % 3 == 1 ? near : ldexpf(near, (int)(drawn() % 120) - 60);
        if (!same((double)windows_fmaf(x, y, z), (double)fmaf(x, y, z)))
            fail_msg("fmaf(%a, %a, %a) is %a, want %a", (double)x, (double)y, (double)z, (double)windows_fmaf(x, y, z),
                     (double)fmaf(x, y, z));
    }
}
