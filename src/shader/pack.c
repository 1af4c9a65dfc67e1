/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shader/pack.h"

#include <math.h>

#include "shader/pack_rg.h"

/* ---- Depth ------------------------------------------------------------------------------------------------------- */

/*
 * enc = frac(v (1, 255)), enc.x -= enc.y/255. In exact arithmetic that leaves whole 255ths in x, which are stored as
 * they are, and 255 frac(255 v) of 65025ths for y. 65025 v is formed as a sum of two doubles, so that ties are exact.
 */
static void rg_encode(const pack_row *row, const double *in, uint32_t codes[]) {
    const double v = in[0];
    const double coarse = PACK_BYTE * v, coarse_rest = fma(PACK_BYTE, v, -coarse);
    double x = floor(coarse);
    x -= x == coarse && coarse_rest < 0;
    const double fine = PACK_BYTE * PACK_BYTE * v, fine_rest = fma(PACK_BYTE * PACK_BYTE, v, -fine);
    const double half = row->truncates ? 0 : 0.5;
    double k = floor(fine);
    const double above = fine - k - half; /* exact, or too far from 0 to be in doubt */
    k += row->truncates ? (above == 0 && fine_rest < 0 ? -1 : 0) : above > -fine_rest || above == -fine_rest;
    codes[0] = x < PACK_BYTE ? (uint32_t)x : 0; /* v = 1 does not survive: frac(1) is 0 */
    codes[1] = x < PACK_BYTE ? (uint32_t)(k - PACK_BYTE * x) : 0;
}

static void rg_decode(const pack_row *row, const uint32_t codes[], double *out) {
    (void)row;
    out[0] = (PACK_BYTE * codes[0] + codes[1]) / (double)(PACK_BYTE * PACK_BYTE);
}

static void rg32_encode(const pack_row *row, const double *in, uint32_t codes[]) {
    const float v = (float)in[0];
    const uint32_t code = v < 1 ? pack_rg_code(v, row->truncates ? 0 : 0.5) : 0;
    codes[0] = code >> 8;
    codes[1] = code & PACK_BYTE;
}

static void rg32_decode(const pack_row *row, const uint32_t codes[], double *out) {
    (void)row;
    out[0] = (double)pack_rg_depth(codes[0] << 8 | codes[1]);
}

/* ---- Normals ----------------------------------------------------------------------------------------------------- */

static void stereo_encode(const pack_row *row, const double *in, uint32_t codes[]) {
    const double most = (double)((1U << row->bits) - 1);
    for (int i = 0; i < 2; i++) {
        const double e = in[i] / (in[2] + 1) / PACK_STEREO_SCALE * 0.5 + 0.5;
        codes[i] = (uint32_t)floor(fmin(fmax(e, 0), 1) * most + 0.5);
    }
}

static void stereo_decode(const pack_row *row, const uint32_t codes[], double *out) {
    const double most = (double)((1U << row->bits) - 1);
    const double x = 2 * PACK_STEREO_SCALE * codes[0] / most - PACK_STEREO_SCALE,
                 y = 2 * PACK_STEREO_SCALE * codes[1] / most - PACK_STEREO_SCALE;
    const double g = 2 / (x * x + y * y + 1);
    out[0] = g * x;
    out[1] = g * y;
    out[2] = g - 1;
}

/* SNORM of N bits: c/(2^(N-1) - 1), to the nearest, ties away from 0. */
static uint32_t snorm_encode(int bits, double x) {
    const double most = (double)((1U << (bits - 1)) - 1);
    const int code = (int)(fmin(fmax(x, -1), 1) * most + (x < 0 ? -0.5 : 0.5));
    return (uint32_t)code & ((1U << bits) - 1);
}

static double snorm_decode(int bits, uint32_t code) {
    const int most = (1 << (bits - 1)) - 1;
    const int value = (int)code > most ? (int)code - (1 << bits) : (int)code;
    return fmax((double)value / most, -1);
}

static void unit(const double in[3], double out[3]) {
    const double length = sqrt(in[0] * in[0] + in[1] * in[1] + in[2] * in[2]);
    for (int i = 0; i < 3; i++)
        out[i] = in[i] / length;
}

static void xyz_encode(const pack_row *row, const double *in, uint32_t codes[]) {
    for (int i = 0; i < 3; i++)
        codes[i] = snorm_encode(row->bits, in[i]);
}

static void xyz_decode(const pack_row *row, const uint32_t codes[], double *out) {
    double n[3];
    for (int i = 0; i < 3; i++)
        n[i] = snorm_decode(row->bits, codes[i]);
    unit(n, out);
}

/* Folds the lower half of the octahedron out over the upper one, and back. */
static void fold(double *x, double *y) {
    const double a = *x, b = *y;
    *x = copysign(1 - fabs(b), a);
    *y = copysign(1 - fabs(a), b);
}

static void oct_encode(const pack_row *row, const double *in, uint32_t codes[]) {
    const double s = fabs(in[0]) + fabs(in[1]) + fabs(in[2]);
    double x = in[0] / s, y = in[1] / s;
    if (in[2] < 0)
        fold(&x, &y);
    codes[0] = snorm_encode(row->bits, x);
    codes[1] = snorm_encode(row->bits, y);
}

static void oct_decode(const pack_row *row, const uint32_t codes[], double *out) {
    double x = snorm_decode(row->bits, codes[0]), y = snorm_decode(row->bits, codes[1]);
    const double z = 1 - fabs(x) - fabs(y);
    if (z < 0)
        fold(&x, &y);
    unit((const double[]){x, y, z}, out);
}

/* ---- Both -------------------------------------------------------------------------------------------------------- */

static void both_encode(const pack_row *row, const double *in, uint32_t codes[]) {
    stereo_encode(row, in, codes);
    rg_encode(row, in + 3, codes + 2);
}

static void both_decode(const pack_row *row, const uint32_t codes[], double *out) {
    stereo_decode(row, codes, out);
    rg_decode(row, codes + 2, out + 3);
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

#define UNITY   "UnityCG.cginc of Unity's built-in shaders, "
#define CIGOLLE "Cigolle et al. 2014, A survey of efficient representations for independent unit vectors"

enum { STEREO_8 = 4 };

/* clang-format off */
static const pack_row rows[] = {
    {.name = "rg-depth", .kind = PACK_DEPTH, .channels = 2, .bits = 8,
     .note = "linear depth in two channels: frac(v (1, 255)), x -= y/255; back by x + y/255. Steps of 1/65025; v = 1 "
             "decodes to 0. Exact arithmetic, channels to the nearest",
     .depth = {3.845e-6, 7.690e-6}, .source = UNITY "EncodeFloatRG, DecodeFloatRG",
     .encode = rg_encode, .decode = rg_decode},
    {.name = "rg-depth-zero", .kind = PACK_DEPTH, .channels = 2, .bits = 8, .truncates = true,
     .note = "the same, channels truncated: too near by half a step on average",
     .depth = {7.690e-6, 1.538e-5}, .source = UNITY "EncodeFloatRG, DecodeFloatRG",
     .encode = rg_encode, .decode = rg_decode},
    {.name = "rg-depth-fp32", .kind = PACK_DEPTH, .channels = 2, .bits = 8, .binary32 = true,
     .note = "the same in a binary32 shader, channels to the nearest",
     .depth = {3.846e-6, 7.750e-6}, .source = UNITY "EncodeFloatRG, DecodeFloatRG",
     .encode = rg32_encode, .decode = rg32_decode},
    {.name = "rg-depth-fp32-zero", .kind = PACK_DEPTH, .channels = 2, .bits = 8, .binary32 = true, .truncates = true,
     .note = "the same in a binary32 shader, channels truncated: x - y/255 often comes out just below a whole 255th, "
             "and the coarse channel then loses one",
     .depth = {1.058e-3, 3.938e-3}, .source = UNITY "EncodeFloatRG, DecodeFloatRG",
     .encode = rg32_encode, .decode = rg32_decode},
    [STEREO_8] = {.name = "stereo-8", .kind = PACK_NORMAL, .layout = PACK_STEREO, .channels = 2, .bits = 8,
     .note = "stereographic: n.xy/(n.z + 1)/1.7777 in two UNORM channels. Worst at the pole, which falls between codes",
     .normal = {0.459, 1.130}, .source = UNITY "EncodeViewNormalStereo, DecodeViewNormalStereo",
     .encode = stereo_encode, .decode = stereo_decode},
    {.name = "oct-8", .kind = PACK_NORMAL, .layout = PACK_OCT, .channels = 2, .bits = 8, .sphere = true,
     .note = "octahedral, two SNORM channels, each to the nearest", .normal = {0.3374, 0.9571},
     .source = CIGOLLE ", oct", .encode = oct_encode, .decode = oct_decode},
    {.name = "oct-10", .kind = PACK_NORMAL, .layout = PACK_OCT, .channels = 2, .bits = 10, .sphere = true,
     .note = "octahedral, two SNORM channels, each to the nearest", .normal = {0.0838, 0.2379},
     .source = CIGOLLE ", oct", .encode = oct_encode, .decode = oct_decode},
    {.name = "oct-12", .kind = PACK_NORMAL, .layout = PACK_OCT, .channels = 2, .bits = 12, .sphere = true,
     .note = "octahedral, two SNORM channels, each to the nearest", .normal = {0.02092, 0.05938},
     .source = CIGOLLE ", oct", .encode = oct_encode, .decode = oct_decode},
    {.name = "xyz-8", .kind = PACK_NORMAL, .layout = PACK_XYZ, .channels = 3, .bits = 8, .sphere = true,
     .note = "the three components in SNORM channels, normalized after reading", .normal = {0.1703, 0.3904},
     .source = CIGOLLE ", snorm", .encode = xyz_encode, .decode = xyz_decode},
    {.name = "xyz-10", .kind = PACK_NORMAL, .layout = PACK_XYZ, .channels = 3, .bits = 10, .sphere = true,
     .note = "the three components in SNORM channels, normalized after reading", .normal = {0.04235, 0.0971},
     .source = CIGOLLE ", snorm", .encode = xyz_encode, .decode = xyz_decode},
    {.name = "xyz-12", .kind = PACK_NORMAL, .layout = PACK_XYZ, .channels = 3, .bits = 12, .sphere = true,
     .note = "the three components in SNORM channels, normalized after reading", .normal = {0.01056, 0.02424},
     .source = CIGOLLE ", snorm", .encode = xyz_encode, .decode = xyz_decode},
    {.name = "depth-normal", .kind = PACK_DEPTH_NORMAL, .layout = PACK_STEREO, .channels = 4, .bits = 8,
     .note = "one texel for both: stereo-8 in xy, rg-depth in zw",
     .depth = {3.845e-6, 7.690e-6}, .normal = {0.459, 1.130}, .source = UNITY "EncodeDepthNormal, DecodeDepthNormal",
     .encode = both_encode, .decode = both_decode},
};
/* clang-format on */

const pack_row *pack_get(size_t index) {
    return index < sizeof rows / sizeof rows[0] ? &rows[index] : NULL;
}

const pack_row *pack_stereo(void) {
    return &rows[STEREO_8];
}
