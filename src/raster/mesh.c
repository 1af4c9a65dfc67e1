/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "raster/mesh.h"

#include <math.h>

#include "core/bits.h"
#include "core/elementary.h"

enum { CELLS = 4 };

/* How far a pixel's centre lies beyond an edge at most, pixels. */
static const double moved = 0.0625;

/* ---- Random numbers ---------------------------------------------------------------------------------------------- */

uint64_t draw_random(uint64_t *state) {
    return dp_mixed64(*state += UINT64_C(0x9E3779B97F4A7C15));
}

double draw_uniform(uint64_t *state) {
    return dp_uniform(draw_random(state));
}

double draw_log_uniform(uint64_t *state, double lo, double hi) {
    return lo * dp_pow(hi / lo, draw_uniform(state));
}

/* ---- The mesh ---------------------------------------------------------------------------------------------------- */

/* Less than a quarter of a side along each leaves every triangle the way round that it has in the grid. */
static void place_vertex(const draw_mesh *mesh, int i, int k, double window[2]) {
    const uint64_t random = dp_mixed64(mesh->seed + ((uint64_t)i << 32 | (uint64_t)k));
    const double u = i + 0.5 * ((double)(random >> 32) * 0x1p-32 - 0.5);
    const double v = k + 0.5 * ((double)(random & 0xFFFFFFFFU) * 0x1p-32 - 0.5);
    for (int axis = 0; axis < 2; axis++)
        window[axis] = mesh->corner[axis] + u * mesh->side[0][axis] + v * mesh->side[1][axis];
}

void draw_mesh_corners(const draw_mesh *mesh, int i, int k, int half, double window[3][2]) {
    static const signed char corners[2][2][3][2] = {{{{0, 0}, {1, 0}, {0, 1}}, {{1, 1}, {0, 1}, {1, 0}}},
                                                    {{{0, 0}, {1, 0}, {1, 1}}, {{1, 1}, {0, 1}, {0, 0}}}};
    const uint64_t diagonal = dp_mixed64(~mesh->seed + ((uint64_t)i << 32 | (uint64_t)k)) & 1U;
    for (int corner = 0; corner < 3; corner++) {
        const signed char *off = corners[diagonal][half][corner];
        place_vertex(mesh, i + off[0], k + off[1], window[corner]);
    }
}

draw_mesh draw_mesh_random(const dp_triangles *class, const double window[2], uint64_t *state) {
    const double wide = draw_log_uniform(state, 2.0, fmax(0.5 * class->pixels, 3.0));
    const double high = fmax(wide / draw_log_uniform(state, 1.0, 0.5 * class->slim), 1.0);
    const double turn = 2.0 * M_PI * draw_uniform(state);
    const double u = CELLS / 2 + draw_uniform(state), v = CELLS / 2 + draw_uniform(state);
    draw_mesh mesh = {.side = {{wide * dp_cos(turn), wide * dp_sin(turn)}, {-high * dp_sin(turn), high * dp_cos(turn)}},
                      .cells = {CELLS, CELLS}};
    for (int axis = 0; axis < 2; axis++)
        mesh.corner[axis] = window[axis] - u * mesh.side[0][axis] - v * mesh.side[1][axis];
    mesh.seed = draw_random(state);
    return mesh;
}

static int at_most(double x, int most) {
    return x < most ? (int)x : most;
}

static int at_least(int x, int least) {
    return x > least ? x : least;
}

draw_area draw_mesh_area(const draw_camera *camera, int x, int y, const draw_mesh mesh[2]) {
    const double reach =
        0.5 * CELLS *
        fmax(dp_hypot(mesh[0].side[0][0], mesh[0].side[0][1]), dp_hypot(mesh[1].side[0][0], mesh[1].side[0][1]));
    const int off = at_most(reach, DRAW_MESH_REACH);
    const int left = at_least(x - off, 0), low = at_least(y - off, 0);
    return (draw_area){left, low, at_most(x + off + 1, camera->target.width) - left,
                       at_most(y + off + 1, camera->target.height) - low};
}

/* How far a vertex moves: half a step of the grid, and what binary32 rounds before. */
static double step_of(int subpixel) {
    return (subpixel > 0 ? 0.5 / (1 << subpixel) : moved) + 0x1p-8;
}

/* Upon the longest edge. */
static double height_of(const double v[3][2]) {
    const double area = fabs((v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[2][0] - v[0][0]) * (v[1][1] - v[0][1]));
    double longest = 0.0;
    for (int i = 0; i < 3; i++)
        longest = fmax(longest, dp_hypot(v[(i + 1) % 3][0] - v[i][0], v[(i + 1) % 3][1] - v[i][1]));
    return area / longest;
}

draw_shape draw_shape_of(const double v[3][2], int subpixel) {
    const double m = step_of(subpixel), outward = 1.0 + 0x1p-40;
    const double area = fabs((v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) - (v[2][0] - v[0][0]) * (v[1][1] - v[0][1]));
    double longest = 0.0, widest = 0.0, around = 0.0;
    for (int i = 0; i < 3; i++) {
        const double *next = v[(i + 1) % 3];
        const double x = fabs(next[0] - v[i][0]), y = fabs(next[1] - v[i][1]);
        longest = fmax(longest, dp_hypot(x, y));
        widest = fmax(widest, fmax(x, y));
        around += x + y;
    }
    const double left = area - outward * (m * around + 4.0 * m * m), far = longest + 3.0 * m;
    return (draw_shape){.pixels = widest + 4.0 * m, .slim = left > 0.0 ? outward * far * far / left : (double)INFINITY};
}

static bool has_shape(const double v[3][2], const dp_triangles *class) {
    const draw_shape shape = draw_shape_of(v, class->subpixel);
    return shape.pixels <= class->pixels && shape.slim <= class->slim;
}

/* Whether vertices and pixels inside lie within a factor `depth` of each other; 1/z changes evenly on the screen. */
static bool has_depth(const draw_camera *camera, const draw_plane *plane, const double z[3],
                      const dp_triangles *class) {
    const double *n = plane->normal;
    const double facing[3] = {plane->distance / z[0], plane->distance / z[1], plane->distance / z[2]};
    const double step = 2.0 * (fabs(n[0]) / ((double)camera->p00 * camera->target.width) +
                               fabs(n[1]) / ((double)camera->p11 * camera->target.height));
    const double least = fmin(fmin(facing[0], facing[1]), facing[2]);
    const double most = fmax(fmax(facing[0], facing[1]), facing[2]);
    const double allowed = class->depth * (1.0 - 0x1p-20), m = fmax(moved, step_of(class->subpixel));
    return most + m * step <= allowed * least && most <= allowed * (least - m * step);
}

/* Whether a place is in view, and not next to an edge, for clip coordinates are rounded. */
static bool in_view(const draw_camera *camera, const double window[2], double z) {
    return window[0] >= moved && window[0] <= camera->target.width - moved && window[1] >= moved &&
           window[1] <= camera->target.height - moved && z >= (double)camera->pipeline.znear &&
           z <= (double)camera->pipeline.zfar && dp_pipeline_drawn(&camera->pipeline, (float)z);
}

/* Whether a triangle can reach pixels of the area. */
static bool is_near(const draw_area *area, const double v[3][2]) {
    const int lo[2] = {area->x, area->y}, size[2] = {area->width, area->height};
    for (int axis = 0; axis < 2; axis++) {
        const double least = fmin(fmin(v[0][axis], v[1][axis]), v[2][axis]);
        const double most = fmax(fmax(v[0][axis], v[1][axis]), v[2][axis]);
        if (most < lo[axis] - 1.0 || least > lo[axis] + size[axis] + 1.0)
            return false;
    }
    return true;
}

static bool draw_part(draw_buffer *buffer, const draw_camera *camera, const draw_plane *plane,
                      const double window[3][2], const dp_triangles *class, unsigned who) {
    double place[3][3], z[3];
    if (!is_near(&buffer->area, window))
        return false;
    for (int i = 0; i < 3; i++) {
        z[i] = draw_depth(camera, plane, window[i]);
        if (!in_view(camera, window[i], z[i]))
            return false;
        draw_at(camera, window[i], z[i], place[i]);
    }
    if (class != NULL &&
        !(has_shape(window, class) && (draw_is_ortho(camera) || has_depth(camera, plane, (const double *)z, class))))
        return false;
    return draw_triangle(buffer, camera, (const double(*)[3])place, who);
}

int draw_mesh_plane(draw_buffer *buffer, const draw_camera *camera, const draw_plane *plane, const draw_mesh *mesh,
                    const dp_triangles *class, unsigned who) {
    int drawn = 0;
    for (int i = 0; i < mesh->cells[0]; i++)
        for (int k = 0; k < mesh->cells[1]; k++)
            for (int half = 0; half < 2; half++) {
                double window[3][2];
                draw_mesh_corners(mesh, i, k, half, window);
                if (height_of((const double(*)[2])window) < mesh->lowest)
                    continue;
                drawn += draw_part(buffer, camera, plane, (const double(*)[2])window, class, who);
            }
    return drawn;
}
