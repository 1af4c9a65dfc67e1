/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows: binary32 loops over the pixels of a line. */
#include "core/bits.h"
#include "core/clones.h"
#include "shader/half.h"
#include "shader/position.h"

/* The constants along a line of pixels, and where the planes go. */
typedef struct line {
    const position_state *s;
    float base[3], step[3]; /* rows differ in what they keep here */
    float y;
} line;

typedef void (*line_loop)(const line *l, int first, const float *restrict in, int count, float *restrict x,
                          float *restrict y, float *restrict z);

/* Eye depths of a piece at a time, which stays in the nearest cache; null: the loop takes the window depths. The first
 * piece ends where x lies on a whole cache line, because stores across lines take half as long again. */
enum { PIECE = 512, LINE = 64 };

static void in_pieces(const line *l, const decode_constants *c, line_loop loop, uint32_t column, const float *d,
                      size_t count, float *x, float *y, float *z) {
    _Alignas(LINE) float eye[PIECE];
    size_t most = PIECE - (uintptr_t)x % LINE / sizeof *x;
    for (size_t at = 0; at < count; at += most, most = PIECE) {
        const size_t piece = count - at < most ? count - at : most;
        if (c != NULL)
            decode_apply(c, d + at, eye, piece);
        loop(l, (int)(column + at), c != NULL ? eye : d + at, (int)piece, x + at, y + at, z + at);
    }
}

/* ---- Inverse view-projection matrix ------------------------------------------------------------------------------ */

CLONES static void matrix_loop(const line *l, int first, const float *restrict d, int count, float *restrict x,
                               float *restrict y, float *restrict z) {
    const position_state s = *l->s;
    const float *m = s.inverse, v = l->y;
#pragma omp simd
    for (int i = 0; i < count; i++) {
        const float u = 2.0f * (((float)(first + i) + 0.5f) * s.inverse_width) - 1.0f;
        const float t = s.ndc_scale * d[i] + s.ndc_base;
        const float w = m[12] * u + m[13] * v + m[14] * t + m[15];
        x[i] = (m[0] * u + m[1] * v + m[2] * t + m[3]) / w;
        y[i] = (m[4] * u + m[5] * v + m[6] * t + m[7]) / w;
        z[i] = (m[8] * u + m[9] * v + m[10] * t + m[11]) / w;
    }
}

/* The height in NDC, upwards. */
static void matrix_run(const position_state *s, uint32_t row, uint32_t column, const float *d, size_t count, float *x,
                       float *y, float *z) {
    const line l = {.s = s, .y = 1.0f - 2.0f * (((float)row + 0.5f) * s->inverse_height)};
    in_pieces(&l, NULL, matrix_loop, column, d, count, x, y, z);
}

/* ---- Camera rays ------------------------------------------------------------------------------------------------- */

CLONES static void rays_loop(const line *l, int first, const float *restrict eye, int count, float *restrict x,
                             float *restrict y, float *restrict z) {
    const position_state s = *l->s;
    const line c = *l;
#pragma omp simd
    for (int i = 0; i < count; i++) {
        const float u = ((float)(first + i) + 0.5f) * s.inverse_width, t = eye[i] / s.znear;
        x[i] = s.origin[0] + (c.base[0] + u * c.step[0]) * t;
        y[i] = s.origin[1] + (c.base[1] + u * c.step[1]) * t;
        z[i] = s.origin[2] + (c.base[2] + u * c.step[2]) * t;
    }
}

/* The left and the right edge first, then between them. */
static void rays_run(const position_state *s, uint32_t row, uint32_t column, const float *d, size_t count, float *x,
                     float *y, float *z) {
    const float v = 1.0f - ((float)row + 0.5f) * s->inverse_height;
    line l = {.s = s};
    for (int k = 0; k < 3; k++) {
        const float right = s->corner[1][k] + v * (s->corner[3][k] - s->corner[1][k]);
        l.base[k] = s->corner[0][k] + v * (s->corner[2][k] - s->corner[0][k]);
        l.step[k] = right - l.base[k];
    }
    in_pieces(&l, &s->usual, rays_loop, column, d, count, x, y, z);
}

/* ---- Top left and extents ---------------------------------------------------------------------------------------- */

/* Each component is view-relative first, in binary16 where the row says so, and is then moved to the world. */
#define EXTENTS(name, rounded)                                                                                         \
    CLONES static void name(const line *l, int first, const float *restrict eye, int count, float *restrict x,         \
                            float *restrict y, float *restrict z) {                                                    \
        const position_state s = *l->s;                                                                                \
        const line c = *l;                                                                                             \
        const float *tl = s.top_left, *xe = s.x_extent;                                                                \
        _Pragma("omp simd") for (int i = 0; i < count; i++) {                                                          \
            const float u = ((float)(first + i) + 0.5f) * s.inverse_width, t = eye[i] * s.inverse_near;                \
            x[i] = rounded((tl[0] + xe[0] * u + c.base[0]) * t) + s.origin[0];                                         \
            y[i] = rounded((tl[1] + xe[1] * u + c.base[1]) * t) + s.origin[1];                                         \
            z[i] = rounded((tl[2] + xe[2] * u + c.base[2]) * t) + s.origin[2];                                         \
        }                                                                                                              \
    }                                                                                                                  \
    CLONES static void name##_ortho(const line *l, int first, const float *restrict eye, int count, float *restrict x, \
                                    float *restrict y, float *restrict z) {                                            \
        const position_state s = *l->s;                                                                                \
        const line c = *l;                                                                                             \
        const float *tl = s.top_left, *xe = s.x_extent, *ze = s.z_extent;                                              \
        _Pragma("omp simd") for (int i = 0; i < count; i++) {                                                          \
            const float u = ((float)(first + i) + 0.5f) * s.inverse_width, t = eye[i] * s.inverse_far;                 \
            x[i] = rounded(tl[0] + xe[0] * u + c.base[0] + ze[0] * t) + s.origin[0];                                   \
            y[i] = rounded(tl[1] + xe[1] * u + c.base[1] + ze[1] * t) + s.origin[1];                                   \
            z[i] = rounded(tl[2] + xe[2] * u + c.base[2] + ze[2] * t) + s.origin[2];                                   \
        }                                                                                                              \
    }

EXTENTS(extents_loop, )
EXTENTS(half_loop, half_of)

static line extents_line(const position_state *s, uint32_t row) {
    const float v = ((float)row + 0.5f) * s->inverse_height;
    line l = {.s = s};
    for (int k = 0; k < 3; k++)
        l.base[k] = s->y_extent[k] * v;
    return l;
}

static void extents_run(const position_state *s, uint32_t row, uint32_t column, const float *d, size_t count, float *x,
                        float *y, float *z) {
    const line l = extents_line(s, row);
    in_pieces(&l, &s->usual, s->camera->ortho ? extents_loop_ortho : extents_loop, column, d, count, x, y, z);
}

static void half_run(const position_state *s, uint32_t row, uint32_t column, const float *d, size_t count, float *x,
                     float *y, float *z) {
    const line l = extents_line(s, row);
    in_pieces(&l, &s->usual, s->camera->ortho ? half_loop_ortho : half_loop, column, d, count, x, y, z);
}

/* ---- Ours: rays counted from the image's middle, eye depth without cancellation ---------------------------------- */

CLONES static void view_loop(const line *l, int first, const float *restrict eye, int count, float *restrict x,
                             float *restrict y, float *restrict z) {
    const position_state s = *l->s;
    const line c = *l;
#pragma omp simd
    for (int i = 0; i < count; i++) {
        const float u = (float)(first + i) - s.middle;
        x[i] = s.origin[0] + (s.step[0] * u + c.base[0]) * eye[i];
        y[i] = s.origin[1] + (s.step[1] * u + c.base[1]) * eye[i];
        z[i] = s.origin[2] + (s.step[2] * u + c.base[2]) * eye[i];
    }
}

CLONES static void view_ortho_loop(const line *l, int first, const float *restrict eye, int count, float *restrict x,
                                   float *restrict y, float *restrict z) {
    const position_state s = *l->s;
    const line c = *l;
#pragma omp simd
    for (int i = 0; i < count; i++) {
        const float u = (float)(first + i) - s.middle;
        x[i] = s.origin[0] + (s.step[0] * u + c.base[0] + s.forward[0] * eye[i]);
        y[i] = s.origin[1] + (s.step[1] * u + c.base[1] + s.forward[1] * eye[i]);
        z[i] = s.origin[2] + (s.step[2] * u + c.base[2] + s.forward[2] * eye[i]);
    }
}

static line view_line(const position_state *s, uint32_t row) {
    const texture_camera *camera = s->camera;
    const double up = camera_slope_y(camera, row);
    line l = {.s = s};
    for (int k = 0; k < 3; k++)
        l.base[k] = (float)(up * camera->axis[1][k] + (camera->ortho ? 0 : camera->axis[2][k]));
    return l;
}

static void view_run(const position_state *s, uint32_t row, uint32_t column, const float *d, size_t count, float *x,
                     float *y, float *z) {
    const line l = view_line(s, row);
    in_pieces(&l, &s->best, s->camera->ortho ? view_ortho_loop : view_loop, column, d, count, x, y, z);
}

/* ---- Table ------------------------------------------------------------------------------------------------------- */

/* clang-format off */
const position_row position_rows[] = {
    [POSITION_MATRIX] = {.name = "matrix", .note = "inverse view-projection matrix times NDC, divided by w",
     .perspective = true, .ortho = true, .source = "ComputeWorldSpacePosition, the Core package's Common.hlsl",
     .run = matrix_run, .bound = matrix_bound},
    [POSITION_RAYS] = {.name = "rays",
     .note = "camera + ray eye/n, the ray between the rays through the near plane's four corners",
     .perspective = true, .curved = true, .source = "image effects with _FrustumCornersRay",
     .run = rays_run, .bound = rays_bound},
    [POSITION_EXTENTS] = {.name = "extents",
     .note = "(top left + x extent u + y extent v) eye/n; orthographic: + z extent eye/f instead of the factor",
     .perspective = true, .ortho = true, .curved = true, .by_far = true,
     .source = "URP, ReconstructViewPos in SSAO.hlsl",
     .run = extents_run, .bound = extents_bound},
    [POSITION_EXTENTS_HALF] = {.name = "extents-half",
     .note = "the same, returned in binary16 before the camera's position is added",
     .perspective = true, .ortho = true, .curved = true, .by_far = true,
     .source = "URP, ReconstructViewPos in SSAO.hlsl",
     .run = half_run, .bound = half_bound},
    [POSITION_VIEW] = {.name = "view",
     .note = "camera + ray z, the ray from the image's middle, z without cancellation",
     .perspective = true, .ortho = true, .curved = true, .source = "depthprec(7)",
     .run = view_run, .bound = view_bound},
};
/* clang-format on */

NAMED_TABLE(position, position_rows);
