/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mesa 22.3.6: the clipper that its software rasterizers share, llvmpipe's planes, and softpipe's planes and spans. */
#include <math.h>
#include <string.h>

#include "raster/clip.h"
#include "raster/model.h"

enum { SNAP_BITS = 8, RUN = 16 /* pixels that softpipe draws at once, from a multiple of it on */ };

static const float window_max = 65536.0F; /* pixels; snapped, far inside 32 bits */

/* ---- Clipping ---------------------------------------------------------------------------------------------------- */

static float between(float t, float out, float in) {
    return out + t * (in - out);
}

/* Cuts an edge from the vertex nearer to the plane: `t` is at most 1/2. */
static raster_vertex cut(const raster_vertex *inside, const raster_vertex *outside, float d_inside, float d_outside) {
    const bool nearer = -d_outside < d_inside;
    const raster_vertex *from = nearer ? outside : inside;
    const raster_vertex *to = nearer ? inside : outside;
    const float t = nearer ? d_outside / (d_outside - d_inside) : d_inside / (d_inside - d_outside);
    return (raster_vertex){between(t, from->x, to->x), between(t, from->y, to->y), between(t, from->z, to->z),
                           between(t, from->w, to->w)};
}

static const raster_clip_rule rule = {{RASTER_RIGHT, RASTER_LEFT, RASTER_TOP, RASTER_BOTTOM, RASTER_NEAR, RASTER_FAR},
                                      cut};

/* New vertices are made by the clipper, which has no fma. */
static raster_point window(const raster_target *target, const raster_vertex *v, bool fused) {
    const float r = 1.0F / v->w;
    const float x = v->x * r;
    const float y = v->y * r;
    const float z = v->z * r;
    const float half_x = (float)target->width / 2.0F;
    const float half_y = (float)target->height / 2.0F;
    return (raster_point){fused ? raster_fma(x, half_x, half_x) : x * half_x + half_x,
                          fused ? raster_fma(y, half_y, half_y) : y * half_y + half_y,
                          fused ? raster_fma(z, target->span, target->lo) : z * target->span + target->lo};
}

static bool in_window(const raster_point *p) {
    return fabsf(p->x) <= window_max && fabsf(p->y) <= window_max && isfinite(p->z);
}

raster_status raster_mesa_draw(const raster_target *target, const raster_vertex vertex[3], raster_triangle *drawn) {
    const raster_model *model = target->row->model;
    raster_corner corner[RASTER_CORNERS];
    raster_point point[RASTER_CORNERS];
    unsigned all;
    const unsigned outside = raster_outside(vertex, &all);
    const int count = all != 0 ? 0 : outside == 0 ? 3 : raster_clip(&rule, vertex, outside, corner);
    for (int i = 0; i < count; i++) {
        const bool given = outside == 0 || corner[i].given >= 0;
        point[i] = window(target, outside == 0 ? &vertex[i] : &corner[i].at, model->fused && given);
        if (!in_window(&point[i]))
            return RASTER_RANGE;
    }
    for (int i = 2; i < count; i++) {
        /* A fan, turned so that the vertex which leads stays where it was. */
        const bool turned = outside != 0 && model->last_leads;
        const raster_point fan[3] = {point[turned ? i - 1 : 0], point[turned ? i : i - 1], point[turned ? 0 : i]};
        const raster_status status = model->piece(target, fan, &drawn->piece[drawn->count]);
        if (status == RASTER_RANGE)
            return status;
        drawn->count += status == RASTER_OK;
    }
    return drawn->count > 0 ? RASTER_OK : RASTER_EMPTY;
}

/* Both anchor the plane at the centre of pixel (0, 0). */
static raster_plane anchored(float a, float b, const raster_point *v) {
    return (raster_plane){a, b, v->z - (a * (v->x - 0.5F) + b * (v->y - 0.5F)), 0.0F, 0.0F};
}

/* ---- llvmpipe and lavapipe --------------------------------------------------------------------------------------- */

static void swap(raster_point *a, raster_point *b) {
    const raster_point kept = *a;
    *a = *b;
    *b = kept;
}

/* A and B of the plane through three points, from the first one's differences to the second and of the third to it. */
static raster_plane llvmpipe_plane(const raster_point *v) {
    const float x01 = v[0].x - v[1].x, y01 = v[0].y - v[1].y, d01 = v[0].z - v[1].z;
    const float x20 = v[2].x - v[0].x, y20 = v[2].y - v[0].y, d20 = v[2].z - v[0].z;
    const float o = 1.0F / (x01 * y20 - y01 * x20);
    const float ox01 = x01 * o, oy01 = y01 * o, ox20 = x20 * o, oy20 = y20 * o;
    const float a = d01 * oy20 - d20 * oy01;
    const float b = d20 * ox01 - d01 * ox20;
    return anchored(a, b, &v[0]);
}

/* Snapped copies decide what is covered, and which way round; the plane keeps to the points. */
raster_status raster_llvmpipe_piece(const raster_target *target, const raster_point point[3], raster_piece *piece) {
    raster_point v[3];
    memcpy(v, point, sizeof v);
    piece->corners = 3;
    piece->bits = SNAP_BITS;
    for (int i = 0; i < 3; i++) {
        piece->x[i] = (int32_t)rintf((v[i].x - 0.5F) * (float)(1 << SNAP_BITS));
        piece->y[i] = (int32_t)rintf((v[i].y - 0.5F) * (float)(1 << SNAP_BITS));
    }
    const int64_t area = (int64_t)(piece->x[0] - piece->x[1]) * (piece->y[2] - piece->y[0]) -
                         (int64_t)(piece->y[0] - piece->y[1]) * (piece->x[2] - piece->x[0]);
    if (area < 0)
        swap(&v[1], &v[target->row->model->last_leads ? 0 : 2]);
    piece->plane = llvmpipe_plane(v);
    if (area == 0 || !raster_snapped_rows(target, piece))
        return RASTER_EMPTY;
    return raster_plane_finite(target, &piece->plane) ? RASTER_OK : RASTER_RANGE;
}

/* ---- softpipe ---------------------------------------------------------------------------------------------------- */

/* One edge upwards from `low`: where it meets the first centre of a row, and its slope. */
static void softpipe_edge(raster_piece *piece, int edge, const raster_point *low, const raster_point *high) {
    const float dx = high->x - low->x, dy = high->y - low->y;
    const float first = ceilf(low->y - 0.5F);
    piece->edge_y[edge] = (int)first;
    piece->edge_slope[edge] = dy != 0.0F ? dx / dy : 0.0F;
    piece->edge_x[edge] = low->x + 0.5F + (first - (low->y - 0.5F)) * piece->edge_slope[edge];
}

/* The points by y, the least first; among equal ones as softpipe leaves them. */
static void softpipe_sort(const raster_point point[3], raster_point v[3]) {
    static const signed char orders[2][3][3] = {{{0, 1, 2}, {2, 0, 1}, {0, 2, 1}}, {{1, 0, 2}, {2, 1, 0}, {1, 2, 0}}};
    const float y0 = point[0].y, y1 = point[1].y, y2 = point[2].y;
    const int swapped = !(y0 <= y1);
    const float low = swapped ? y1 : y0, high = swapped ? y0 : y1;
    const signed char *order = orders[swapped][high <= y2 ? 0 : y2 <= low ? 1 : 2];
    for (int i = 0; i < 3; i++)
        v[i] = point[order[i]];
}

raster_status raster_softpipe_piece(const raster_target *target, const raster_point point[3], raster_piece *piece) {
    raster_point v[3];
    const float det =
        (point[0].x - point[2].x) * (point[1].y - point[2].y) - (point[0].y - point[2].y) * (point[1].x - point[2].x);
    if (det == 0.0F)
        return RASTER_EMPTY;
    softpipe_sort(point, v);
    const float low_x = v[1].x - v[0].x, low_y = v[1].y - v[0].y, low_z = v[1].z - v[0].z;
    const float long_x = v[2].x - v[0].x, long_y = v[2].y - v[0].y, long_z = v[2].z - v[0].z;
    const float o = 1.0F / (long_x * low_y - low_x * long_y);
    const float a = (low_y * long_z - low_z * long_y) * o;
    const float b = (long_x * low_z - long_z * low_x) * o;
    piece->plane = anchored(a, b, &v[0]);
    if (!raster_plane_finite(target, &piece->plane))
        return RASTER_RANGE;
    piece->long_left = o < 0.0F;
    softpipe_edge(piece, 0, &v[0], &v[2]);
    softpipe_edge(piece, 1, &v[0], &v[1]);
    softpipe_edge(piece, 2, &v[1], &v[2]);
    const int last = piece->edge_y[2] + (int)ceilf(v[2].y - 0.5F - (float)piece->edge_y[2]);
    piece->y0 = piece->edge_y[0] > 0 ? piece->edge_y[0] : 0;
    piece->y1 = last < target->height ? last : target->height;
    return piece->y0 < piece->y1 ? RASTER_OK : RASTER_EMPTY;
}

static int clamped(float x, int most) {
    return x < 0.0F ? 0 : x > (float)most ? most : (int)x;
}

/* The lower part of the triangle, then the upper one, for which the long edge starts anew where the first one ended. */
bool raster_softpipe_span(const raster_target *target, const raster_piece *piece, int y, int *from, int *to) {
    if (y < piece->y0 || y >= piece->y1)
        return false;
    const int lower = piece->edge_y[2] - piece->edge_y[1];
    const bool upper = y >= piece->edge_y[2];
    const int other = upper ? 2 : 1;
    const float start = upper ? piece->edge_x[0] + (float)lower * piece->edge_slope[0] : piece->edge_x[0];
    const float along = start + (float)(y - (upper ? piece->edge_y[2] : piece->edge_y[0])) * piece->edge_slope[0];
    const float across = piece->edge_x[other] + (float)(y - piece->edge_y[other]) * piece->edge_slope[other];
    *from = clamped(piece->long_left ? along : across, target->width);
    *to = clamped(piece->long_left ? across : along, target->width);
    return *from < *to;
}

/*
 * Depths of 16 bits: two rows in runs of 16 pixels. The first quad of two by two that has a pixel is converted, each
 * half of its width by itself; from there on whole codes are added. All as the processor does it, modulo 2^16.
 */
static uint16_t truncated16(float value) {
    return (uint16_t)(fabsf(value) < 0x1p31F ? (int32_t)value : 0);
}

static int first_quad(const raster_target *target, const raster_piece *piece, int y, int run) {
    int first = run + RUN;
    for (int row = y & ~1; row <= (y | 1); row++) {
        int from, to;
        if (!raster_softpipe_span(target, piece, row, &from, &to) || to <= run)
            continue;
        from = from < run ? run : from & ~1;
        first = from < first ? from : first;
    }
    return first;
}

void raster_softpipe_stepped(const raster_target *target, const raster_piece *piece, int y, int from, int to,
                             uint32_t *code) {
    const raster_plane *p = &piece->plane;
    const uint16_t step = truncated16(p->a * target->scale);
    uint16_t start[2] = {0, 0};
    int quad = 0;
    for (int x = from; x < to; x++) {
        if (x == from || x % RUN == 0) {
            quad = first_quad(target, piece, y, x & ~(RUN - 1));
            float z[2];
            raster_softpipe_depths[DP_PATH_BASELINE](p, y, quad, quad + 2, z);
            start[0] = truncated16(z[0] * target->scale);
            start[1] = truncated16(z[1] * target->scale);
        }
        code[x - from] = (uint16_t)(start[x & 1] + ((x & ~1) - quad) * step);
    }
}
