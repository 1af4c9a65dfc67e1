/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Each loop runs over the columns of a row without a branch: both neighbours are read and one is selected, and what is
 * missing is NaN, which carries itself through. On each axis there is a first side, left or below, and a second one.
 */
#include "shader/normal.h"

#include <math.h>

#include "core/bits.h"
#include "core/clones.h"
#include "shader/half.h"

/* Selection: compilers make jumps of conditions as it suits them, and then no vectors; masks stay what they are */

typedef int32_t mask; /* all bits set or none */

DP_INLINE int32_t bits_of(float x) {
    return (int32_t)dp_bits32(x);
}

DP_INLINE float float_of(int32_t bits) {
    return dp_float32((uint32_t)bits);
}

DP_INLINE float select(mask m, float yes, float no) {
    return float_of((bits_of(yes) & m) | (bits_of(no) & ~m));
}

DP_INLINE float negate(mask m, float x) {
    return float_of(bits_of(x) ^ (m & INT32_MIN));
}

DP_INLINE mask missing(float x) {
    return -(x != x);
}

/* 2^(lift - e) with 2^e the power of two in a number: scales without rounding, so that no unit of length overflows. */
DP_INLINE float unit_of(int32_t bits, int lift) {
    return float_of((int32_t)(((254u + (uint32_t)lift) << 23) - ((uint32_t)bits & 0x7f800000u)));
}

/* Which side: set for the first. a is the nearer neighbour of it and a2 the one behind; b and b2 of the second */

typedef mask (*side_rule)(mask within, float z, float a, float a2, float b, float b2);

/* The other pixel of the 2 x 2 quad. */
DP_INLINE mask side_quad(mask within, float z, float a, float a2, float b, float b2) {
    (void)z, (void)a, (void)a2, (void)b, (void)b2;
    return within;
}

DP_INLINE mask side_farther(mask within, float z, float a, float a2, float b, float b2) {
    (void)within, (void)z, (void)a2, (void)b2;
    return -(a > b) | missing(b);
}

/* Whether a < b, both not negative, as their bits are ordered: NaN is greater than infinity. */
DP_INLINE mask less(float a, float b) {
    return -(mask)((dp_bits32(a) - dp_bits32(b)) >> 31);
}

DP_INLINE float missing_is_far(float x) {
    const uint32_t bits = dp_bits32(x);
    return dp_float32(bits < 0x7f800000u ? bits : 0x7f800000u);
}

/* A side without a neighbour behind it is the last choice but for one without any: infinitely far off, and beyond. */
DP_INLINE mask side_straight(mask within, float z, float a, float a2, float b, float b2) {
    (void)within;
    const float off_a = fabsf(2.0f * a - a2 - z), off_b = fabsf(2.0f * b - missing_is_far(b2) - z);
    return less(missing_is_far(off_a), off_b);
}

/* The same in w = 1/z, which is straight along a plane: |2/a - 1/a2 - 1/z| without a division. Depths of the second
 * side multiply the first's error and the other way round; 0 stands for a missing one, whose 1/z no line meets. In
 * units of z, or nearly, four depths can be multiplied. */
DP_INLINE mask side_projective(mask within, float z, float a, float a2, float b, float b2) {
    (void)within;
    const float unit = unit_of(bits_of(z), 0), z1 = z * unit, a1 = a * unit, b1 = b * unit;
    const float behind_a = select(missing(a2), 0.0f, a2 * unit), behind_b = select(missing(b2), 0.0f, b2 * unit);
    const float off_a = fabsf(z1 * (behind_a - a1) - behind_a * (a1 - z1));
    const float off_b = fabsf(z1 * (behind_b - b1) - behind_b * (b1 - z1));
    return -(off_a * b1 * behind_b < off_b * a1 * behind_a) | missing(b);
}

/* ---- The normal ------------------------------------------------------------------------------------------------- */

typedef struct vector {
    float x, y, z;
    mask back; /* it points away from the camera */
} vector;

/* A pixel and the two neighbours: their depths and places, and the signs of the differences. */
typedef struct corner {
    float z, h, v;
    float sx, sy, sx_h, sy_h, sx_v, sy_v;
    float per_x, per_y; /* 1 over the step of sx towards h and of sy towards v, with their signs */
    mask opposed;       /* left and above, or right and below */
} corner;

typedef vector (*corner_rule)(const corner *c);

/* How a method keeps numbers: in binary32 or in binary16. */
typedef float (*float_rule)(float x);

DP_INLINE float single_of(float x) {
    return x;
}

DP_INLINE float unit_at(const corner *c, int lift) {
    const int32_t z = bits_of(c->z), h = bits_of(c->h), v = bits_of(c->v); /* ordered as what they stand for */
    const int32_t zh = z > h ? z : h;
    return unit_of(zh > v ? zh : v, lift);
}

DP_INLINE vector cross(vector a, vector b, mask back) {
    return (vector){a.z * b.y - a.y * b.z, a.x * b.z - a.z * b.x, a.y * b.x - a.x * b.y, back};
}

/* The cross product of two differences of places. */
DP_INLINE vector corner_cross(const corner *c) {
    const float unit = unit_at(c, 20), z = c->z * unit, h = c->h * unit, v = c->v * unit;
    const float px = c->sx * z, py = c->sy * z;
    const vector a = {c->sx_h * h - px, c->sy_h * h - py, h - z, 0};
    const vector b = {c->sx_v * v - px, c->sy_v * v - py, v - z, 0};
    return cross(a, b, c->opposed);
}

/* The same of places in binary16, so narrow that nothing overflows; a place is at the depth times the slopes, or at the
 * slopes where `z`, `h` and `v` are 1. */
DP_INLINE vector half_cross(const corner *c, float z, float h, float v) {
    const float p[3] = {half_of(c->sx * z), half_of(c->sy * z), half_below(c->z)};
    const vector a = {half_of(c->sx_h * h) - p[0], half_of(c->sy_h * h) - p[1], half_below(c->h) - p[2], 0};
    const vector b = {half_of(c->sx_v * v) - p[0], half_of(c->sy_v * v) - p[1], half_below(c->v) - p[2], 0};
    return cross(a, b, c->opposed);
}

DP_INLINE vector corner_half(const corner *c) {
    return half_cross(c, c->z, c->h, c->v);
}

/* The cross product of neighbours whose depths were kept in binary16 before. */
DP_INLINE vector corner_kept(const corner *c) {
    return half_cross(c, c->z, half_below(c->h), half_below(c->v));
}

DP_INLINE vector corner_half_ortho(const corner *c) {
    return half_cross(c, 1, 1, 1);
}

/* On a plane 1/z = a sx + b sy + c, and (a, b, c) is its normal; here times z h v, so that nothing is divided, and z -
 * h has no rounding error where the two are close. */
DP_INLINE vector corner_projective(const corner *c) {
    const float unit = unit_at(c, 0), z = c->z * unit, h = c->h * unit, v = c->v * unit;
    const float a = (z - h) * v * c->per_x, b = (z - v) * h * c->per_y;
    return (vector){a, b, h * v - (c->sx * a + c->sy * b), -1};
}

DP_INLINE float within_1e18(float x) { /* whose square is a binary32 number; NaN stays */
    const float least = select(-(x > 1e18f), 1e18f, x);
    return select(-(x < -1e18f), -1e18f, least);
}

/* Orthographic: the cross product, whose differences of places are multiples of the axes. */
DP_INLINE vector corner_ortho(const corner *c) {
    return (vector){within_1e18((c->h - c->z) * c->per_x), within_1e18((c->v - c->z) * c->per_y), -1.0f, 0};
}

/* The slope of a neighbour, which is at the share u of the picture, `extent` across in slopes. */
typedef float (*uv_rule)(float slope, float u, float extent);

DP_INLINE float uv_single(float slope, float u, float extent) {
    (void)u, (void)extent;
    return slope;
}

/* That share was kept in binary16. */
DP_INLINE float uv_half(float slope, float u, float extent) {
    return slope + (half_within(u) - u) * extent;
}

/* ---- A row of pixels -------------------------------------------------------------------------------------------- */

/* The five pixels of a column or row through a pixel. */
typedef struct line {
    const float *first2, *first, *mid, *second, *second2;
} line;

DP_INLINE line across(const normal_rows *in, int step) {
    const float *mid = in->rows[NORMAL_REACH];
    return (line){mid - 2 * step, mid - step, mid, mid + step, mid + 2 * step};
}

DP_INLINE line upwards(const normal_rows *in, int step) {
    const float *const *rows = in->rows + NORMAL_REACH;
    return (line){rows[2 * step], rows[step], rows[0], rows[-step], rows[-2 * step]};
}

DP_INLINE mask side_at(const line *l, uint32_t i, mask within, side_rule rule) {
    return rule(within, l->mid[i], l->first[i], l->first2[i], l->second[i], l->second2[i]);
}

DP_INLINE void normals(const normal_rows *in, float *restrict nx, float *restrict ny, float *restrict nz, int step,
                       side_rule side, corner_rule rule, float_rule kept, uv_rule uv) {
    const texture_camera *camera = in->camera;
    const line x = across(in, step), y = upwards(in, step);
    const float *s = in->slope_x, *s_left = s - step, *s_right = s + step;
    const float sy = (float)camera_slope_y(camera, in->row);
    const float sy_below = (float)camera_slope_y(camera, (double)in->row + step);
    const float sy_above = (float)camera_slope_y(camera, (double)in->row - step);
    const float per_x = (float)(camera->width / (2 * step * camera->half[0]));
    const float per_y = (float)(camera->height / (2 * step * camera->half[1]));
    const uint32_t count = in->count, column = in->column;
    /* of the picture, from the left and from below */
    const float wide = (float)(2 * camera->half[0]), high = (float)(2 * camera->half[1]);
    const float inverse_width = 1.0f / (float)camera->width, away = (float)step * inverse_width;
    const float v = (float)((camera->height - in->row - 0.5) / camera->height);
    const float v_step = (float)((double)step / camera->height);
    const float sy_h = uv(sy, v, high);
    const float sy_first = uv(sy_below, v - v_step, high), sy_second = uv(sy_above, v + v_step, high);
    const mask even_row = -(in->row % 2 == 0);
#pragma omp simd
    for (uint32_t i = 0; i < count; i++) {
        const mask left = side_at(&x, i, -(int32_t)((column + i) & 1), side), below = side_at(&y, i, even_row, side);
        const float u = ((float)(int32_t)(column + i) + 0.5f) * inverse_width;
        const corner c = {.z = x.mid[i],
                          .h = select(left, x.first[i], x.second[i]),
                          .v = select(below, y.first[i], y.second[i]),
                          .sx = s[i],
                          .sy = sy,
                          .sx_h = uv(select(left, s_left[i], s_right[i]), u + negate(left, away), wide),
                          .sy_h = sy_h,
                          .sx_v = uv(s[i], u, wide),
                          .sy_v = select(below, sy_first, sy_second),
                          .per_x = negate(left, per_x),
                          .per_y = negate(below, per_y),
                          .opposed = left ^ below};
        const vector n = rule(&c);
        const float unit = negate(n.back, 1.0f) / sqrtf(n.x * n.x + n.y * n.y + n.z * n.z);
        nx[i] = kept(n.x * unit);
        ny[i] = kept(n.y * unit);
        nz[i] = kept(n.z * unit);
    }
}

DP_INLINE void sides_of(const normal_rows *in, uint8_t *sides, int step, side_rule side) {
    const line x = across(in, step), y = upwards(in, step);
    for (uint32_t i = 0; i < in->count; i++) {
        const mask left = side_at(&x, i, -(int32_t)((in->column + i) & 1), side);
        const mask below = side_at(&y, i, -(in->row % 2 == 0), side);
        sides[i] = (uint8_t)((left & NORMAL_LEFT) | (below & NORMAL_BELOW));
    }
}

/* Along an orthographic camera's plane z itself is straight: the extrapolation of `high` is then exact. */
#define METHOD(name, step, side, ortho_side, rule, ortho_rule, kept, uv)                                               \
    CLONES static void name##_perspective(const normal_rows *in, float *nx, float *ny, float *nz) {                    \
        normals(in, nx, ny, nz, step, side, rule, kept, uv);                                                           \
    }                                                                                                                  \
    CLONES static void name##_ortho(const normal_rows *in, float *nx, float *ny, float *nz) {                          \
        normals(in, nx, ny, nz, step, ortho_side, ortho_rule, kept, uv);                                               \
    }                                                                                                                  \
    static void name##_run(const normal_rows *in, float *nx, float *ny, float *nz) {                                   \
        (in->camera->ortho ? name##_ortho : name##_perspective)(in, nx, ny, nz);                                       \
    }                                                                                                                  \
    static void name##_sides(const normal_rows *in, uint8_t *sides) {                                                  \
        if (in->camera->ortho)                                                                                         \
            sides_of(in, sides, step, ortho_side);                                                                     \
        else                                                                                                           \
            sides_of(in, sides, step, side);                                                                           \
    }

#define SINGLE(name, step, side) METHOD(name, step, side, side, corner_cross, corner_ortho, single_of, uv_single)
#define HALF(name, step, side)   METHOD(name, step, side, side, corner_kept, corner_half_ortho, half_within, uv_half)

SINGLE(low, 1, side_quad)
SINGLE(medium, 2, side_farther)
SINGLE(medium_1, 1, side_farther)
SINGLE(high, 2, side_straight)
SINGLE(high_1, 1, side_straight)
METHOD(projective, 1, side_projective, side_straight, corner_projective, corner_ortho, single_of, uv_single)
METHOD(low_half, 1, side_quad, side_quad, corner_half, corner_half_ortho, half_within, uv_single)
HALF(medium_half, 2, side_farther)
HALF(high_half, 2, side_straight)

static const char urp[] = "Universal RP, SSAO.hlsl, ReconstructNormal";

/* clang-format off */
const normal_row normal_methods[] = {
    [NORMAL_LOW] = {"low", NULL, "the 2 x 2 quad of the pixel, as ddx and ddy; sky is at far", urp, 1, 1, low_run,
     low_sides, .sees_sky = true},
    [NORMAL_MEDIUM] = {"medium", NULL, "on each axis the farther of the pixels 2 away, sky at far before all others",
     urp, 2, 2, medium_run, medium_sides, .sees_sky = true},
    [NORMAL_MEDIUM_1] = {"medium-1", NULL, "of the pixels next to it the farther on each axis, but sky last", "", 1,
     1, medium_1_run, medium_1_sides, .half = false},
    [NORMAL_HIGH] = {"high", NULL,
     "on each axis the side, 2 pixels away, whose line through two pixels meets the depth "
     "best; sky is at far", urp, 2, 4, high_run, high_sides, .sees_sky = true},
    [NORMAL_HIGH_1] = {"high-1", NULL, "the same with the pixels next to it, but sky last", "", 1, 2, high_1_run,
     high_1_sides, .half = false},
    [NORMAL_PROJECTIVE] = {"projective", NULL,
     "as high-1, lines in 1/z, and the normal from the differences of 1/z: exact on planes", "depthprec(7)", 1, 2,
     projective_run, projective_sides, .half = false},
    [NORMAL_LOW_HALF] = {"low-half", NULL, "low of places in binary16, as half3 is; so is the normal", urp, 1, 1,
     low_half_run, low_half_sides, .half = true, .sees_sky = true},
    [NORMAL_MEDIUM_HALF] = {"medium-half", NULL,
     "medium likewise, of neighbours whose uv and depth were half3 before", urp, 2, 2, medium_half_run,
     medium_half_sides, .half = true, .half_uv = true, .sees_sky = true},
    [NORMAL_HIGH_HALF] = {"high-half", NULL, "high likewise, of neighbours whose uv and depth were half3 before",
     urp, 2, 4, high_half_run, high_half_sides, .half = true, .half_uv = true, .sees_sky = true},
};
/* clang-format on */

NAMED_TABLE(normal, normal_methods);
