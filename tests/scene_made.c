/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene_made.h"

#include <stdlib.h>
#include <string.h>

void scene_made_begin(scene_made *made) {
    memset(&made->m, 0, sizeof made->m);
    made->m.position = made->position;
    made->m.triangle = made->triangle;
    made->m.of = made->of;
    made->m.surface = made->surface;
}

uint32_t scene_made_surface(scene_made *made, const char *node, const char *material) {
    made->surface[made->m.surfaces] = (model_surface){.node = node, .mesh = "", .material = material};
    return (uint32_t)made->m.surfaces++;
}

void scene_made_triangle(scene_made *made, const double a[3], const double b[3], const double c[3]) {
    model *m = &made->m;
    const double *corner[3] = {a, b, c};
    if (m->triangles == SCENE_MADE || m->surfaces == 0)
        abort();
    for (uint32_t k = 0; k < 3; k++) {
        memcpy(m->position[m->vertices], corner[k], sizeof *m->position);
        m->triangle[m->triangles][k] = (uint32_t)m->vertices++;
    }
    m->of[m->triangles++] = (uint32_t)m->surfaces - 1;
}

void scene_made_quad(scene_made *made, const double at[3], const double u[3], const double v[3]) {
    double p[4][3];
    for (int k = 0; k < 3; k++) {
        p[0][k] = at[k];
        p[1][k] = at[k] + u[k];
        p[2][k] = at[k] + u[k] + v[k];
        p[3][k] = at[k] + v[k];
    }
    scene_made_triangle(made, p[0], p[1], p[2]);
    scene_made_triangle(made, p[0], p[2], p[3]);
}

void scene_made_box(scene_made *made, const double lo[3], const double hi[3]) {
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3;
        const int j = (k + 2) % 3;
        double u[3] = {0};
        double v[3] = {0};
        double at[3] = {lo[0], lo[1], lo[2]};
        u[i] = hi[i] - lo[i];
        v[j] = hi[j] - lo[j];
        scene_made_quad(made, at, v, u);
        at[k] = hi[k];
        scene_made_quad(made, at, u, v);
    }
}
