/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shader/pack.h"

#include <math.h>

#include "core/elementary.h"
#include "shader/normal.h"
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

/* Places of the unfolded octahedron, from -1 to 1. */
static void oct_place(const double *in, double *x, double *y) {
    const double s = fabs(in[0]) + fabs(in[1]) + fabs(in[2]);
    *x = in[0] / s;
    *y = in[1] / s;
    if (in[2] < 0)
        fold(x, y);
}

static void oct_normal(double x, double y, double *out) {
    const double z = 1 - fabs(x) - fabs(y);
    if (z < 0)
        fold(&x, &y);
    unit((const double[]){x, y, z}, out);
}

static void oct_encode(const pack_row *row, const double *in, uint32_t codes[]) {
    double x, y;
    oct_place(in, &x, &y);
    codes[0] = snorm_encode(row->bits, x);
    codes[1] = snorm_encode(row->bits, y);
}

static void oct_decode(const pack_row *row, const uint32_t codes[], double *out) {
    oct_normal(snorm_decode(row->bits, codes[0]), snorm_decode(row->bits, codes[1]), out);
}

/* 12 bits each, cut off after a factor of 4095.5: the low bytes, then both high halves in the third. */
static void oct_888_encode(const pack_row *row, const double *in, uint32_t codes[]) {
    double x, y;
    (void)row;
    oct_place(in, &x, &y);
    const uint32_t i = (uint32_t)((0.5 * x + 0.5) * 4095.5), j = (uint32_t)((0.5 * y + 0.5) * 4095.5);
    codes[0] = i & PACK_BYTE;
    codes[1] = j & PACK_BYTE;
    codes[2] = i >> 8 | j >> 8 << 4;
}

static double oct_888_number(const uint32_t codes[], int axis) {
    return codes[axis] | (axis == 0 ? codes[2] & 15 : codes[2] >> 4) << 8;
}

static void oct_888_decode(const pack_row *row, const uint32_t codes[], double *out) {
    (void)row;
    oct_normal(oct_888_number(codes, 0) / 4095 * 2 - 1, oct_888_number(codes, 1) / 4095 * 2 - 1, out);
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
#define URP     "Packing.hlsl of Unity's Core RP library, "
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
    {.name = "oct-888", .kind = PACK_NORMAL, .layout = PACK_OCT_888, .channels = 3, .bits = 8, .sphere = true,
     .note = "octahedral, 0.5 x + 0.5 times 4095.5 cut off to 12 bits each, both in three UNORM "
             "channels; back by k/4095",
     .normal = {0.02901, 0.1090}, .source = URP "PackNormalOctQuadEncode, PackFloat2To888, of _GBUFFER_NORMALS_OCT",
     .encode = oct_888_encode, .decode = oct_888_decode},
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

NAMED_TABLE(pack, rows);

const pack_row *pack_stereo(void) {
    return &rows[STEREO_8];
}

/* ---- The largest angle of a code --------------------------------------------------------------------------------- */

/* Outweighs the roundings of a shader: a part of the plane or of the cube. */
static const double wider = 0x1p-20;

typedef struct reach {
    double back[3], most; /* radians */
} reach;

static void offer(reach *r, const double n[3]) {
    r->most = fmax(r->most, normal_angle(r->back, n));
}

/* Corners of the square; its angles are largest there. */
static void stereo_reach(const pack_row *row, const uint32_t codes[], double half, reach *r) {
    const double most = (double)((1U << row->bits) - 1);
    for (int k = 0; k < 4; k++) {
        double v[2];
        for (int i = 0; i < 2; i++) {
            const double code = codes[i] + (k >> i & 1 ? half : -half);
            v[i] = PACK_STEREO_SCALE * (2 * code / most - 1 + (k >> i & 1 ? wider : -wider));
            r->most = codes[i] == 0 || codes[i] == (uint32_t)most ? M_PI : r->most;
        }
        offer(r, (const double[]){2 * v[0], 2 * v[1], 1 - v[0] * v[0] - v[1] * v[1]});
    }
}

/* Corners of the rectangle, and where its sides meet the folds: on each face its piece is convex. */
static void rectangle_reach(const double x[2], const double y[2], reach *r) {
    double n[3];
    for (int k = 0; k < 4; k++) {
        oct_normal(x[k & 1], y[k >> 1], n);
        offer(r, n);
    }
    for (int side = 0; side < 4; side++) {
        const bool along = side >= 2;
        const double at = along ? y[side & 1] : x[side & 1], *other = along ? x : y;
        const double folds[] = {0, 1 - fabs(at), fabs(at) - 1};
        for (int k = 0; k < 3; k++) {
            if (!(folds[k] > other[0] && folds[k] < other[1]))
                continue;
            oct_normal(along ? folds[k] : at, along ? at : folds[k], n);
            offer(r, n);
        }
    }
}

static void oct_reach(const pack_row *row, const uint32_t codes[], double half, reach *r) {
    const double most = (double)((1U << (row->bits - 1)) - 1);
    double side[2][2];
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++) {
            const double whole = row->layout == PACK_OCT_888
                                     ? (oct_888_number(codes, i) + k) / 4095.5 * 2 - 1
                                     : snorm_decode(row->bits, codes[i]) + (2 * k - 1) * half / most;
            side[i][k] = fmin(fmax(whole + (2 * k - 1) * wider, -1), 1);
        }
    rectangle_reach(side[0], side[1], r);
}

/* Places of the sphere on the twelve edges of the cube. */
static void xyz_reach(const pack_row *row, const uint32_t codes[], double half, reach *r) {
    const double most = (double)((1U << (row->bits - 1)) - 1);
    double side[3][2];
    bool met = false;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++)
            side[i][k] = snorm_decode(row->bits, codes[i]) + (2 * k - 1) * (half / most + wider);
    for (int edge = 0; edge < 24; edge++) {
        const int axis = edge / 8, i = (axis + 1) % 3, j = (axis + 2) % 3;
        double n[3];
        n[i] = side[i][edge & 1];
        n[j] = side[j][edge >> 1 & 1];
        n[axis] = sqrt(1 - n[i] * n[i] - n[j] * n[j]) * ((edge & 4) != 0 ? 1 : -1);
        if (!(n[axis] >= side[axis][0] && n[axis] <= side[axis][1]))
            continue;
        met = true;
        offer(r, n);
    }
    r->most = met ? r->most : M_PI;
}

double pack_reach(const pack_row *row, const uint32_t codes[], bool truncated) {
    static void (*const reaches[])(const pack_row *, const uint32_t *, double, reach *) = {
        [PACK_STEREO] = stereo_reach, [PACK_OCT] = oct_reach, [PACK_OCT_888] = oct_reach, [PACK_XYZ] = xyz_reach};
    reach r = {.most = 0};
    row->decode(row, codes, r.back);
    reaches[row->layout](row, codes, truncated ? 1 : 0.5, &r);
    return r.most / DP_DEGREE * DP_OUTWARD;
}
