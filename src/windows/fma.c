/* SPDX-License-Identifier: MIT */
/* fma() and fmaf(), which are rounded twice in mingw-w64: by the instruction, or else by whole numbers. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "windows/fma.h"

typedef unsigned __int128 wide;

/* Shifted down, an odd last bit for what is lost: it then rounds as all of it would. */
static wide down(wide x, int by) {
    if (by <= 0)
        return x << -by;
    return by > 127 ? x != 0 : x >> by | ((x & (((wide)1 << by) - 1)) != 0);
}

static int width_of(wide x) {
    int width = 0;
    for (; x != 0; x >>= 1)
        width++;
    return width;
}

/* (negative ? -m : m) 2^exponent, rounded once to what the exponent leaves of 53 bits, to the even one of two. */
static double rounded(wide m, int exponent, int negative) {
    const int width = width_of(m), least = -1074 - exponent;
    const int lost = width - 53 > least ? width - 53 : least;
    const uint64_t kept = (uint64_t)down(m, lost - 2); /* two bits more, the last of them for all that follow */
    const uint64_t up = (kept & 3) == 3 || (kept & 7) == 6;
    const double result = ldexp((double)((kept >> 2) + up), exponent + lost);
    return negative ? -result : result;
}

static wide whole(double x, int *exponent) {
    const double m = frexp(fabs(x), exponent);
    *exponent -= 53;
    return (wide)(uint64_t)ldexp(m, 53);
}

double windows_fma(double x, double y, double z) {
    if (!isfinite(x) || !isfinite(y) || x == 0 || y == 0)
        return x * y + z;
    if (!isfinite(z))
        return z;
    int ex, ey, ez;
    wide p = whole(x, &ex) * whole(y, &ey), q = whole(z, &ez);
    int exponent = ex + ey - 2; /* of both, as low as leaves 126 bits to the larger */
    const int minus_p = (signbit(x) != 0) != (signbit(y) != 0), minus_q = signbit(z) != 0;
    if (z == 0)
        return rounded(p, exponent + 2, minus_p);
    if (ez + 53 > exponent + 126)
        exponent = ez + 53 - 126;
    p = down(p, exponent - (ex + ey));
    q = down(q, exponent - ez);
    const wide sum = minus_p == minus_q ? p + q : p > q ? p - q : q - p;
    return sum == 0 ? 0 : rounded(sum, exponent, p > q ? minus_p : minus_q);
}

/* The sum of two doubles whose last bit is odd where it is not exact: rounded again it is what one rounding makes. */
float windows_fmaf(float x, float y, float z) {
    const double p = (double)x * (double)y, q = (double)z, sum = p + q;
    const double back = sum - p, rest = (p - (sum - back)) + (q - back);
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    if (isfinite(sum) && rest != 0 && (bits & 1) == 0)
        bits += (rest > 0) == (sum > 0) ? 1 : (uint64_t)-1;
    double odd;
    memcpy(&odd, &bits, sizeof odd);
    return (float)odd;
}

#ifdef _WIN32
#define FMA __attribute__((target("fma")))
FMA static double fused(double x, double y, double z) {
    return __builtin_fma(x, y, z);
}

FMA static float fusedf(float x, float y, float z) {
    return __builtin_fmaf(x, y, z);
}

double fma(double x, double y, double z) {
    return __builtin_cpu_supports("fma") ? fused(x, y, z) : windows_fma(x, y, z);
}

float fmaf(float x, float y, float z) {
    return __builtin_cpu_supports("fma") ? fusedf(x, y, z) : windows_fmaf(x, y, z);
}
#endif
