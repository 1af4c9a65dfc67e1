/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The projection matrix of --matrix, as an image has it. */
#include <math.h>

#include "core/elementary.h"
#include "report/number.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/texture.h"

static void name_edges(texture_matrix *t) {
    const dp_projection *p = &t->taken;
    t->oblique = p->oblique != 0;
    t->looks = p->backwards ? "-z" : "+z";
    for (int i = 0; i < 4; i++)
        t->edges[i] = ((i % 2 != 0 ? 1 : -1) - p->centre[i / 2]) * p->half[i / 2];
    for (int k = 0; k < 2; k++)
        t->fov[k] = p->ortho ? (double)NAN : (dp_atan(t->edges[2 * k + 1]) - dp_atan(t->edges[2 * k])) / DP_DEGREE;
}

void texture_intrinsics_take(const double intrinsics[4], const double size[2], texture_matrix *t) {
    dp_projection *p = &t->taken;
    for (int k = 0; k < 2; k++) {
        p->half[k] = size[k] / (2 * intrinsics[k]);
        p->scale[k] = 1 / p->half[k];
        p->centre[k] = (k == 0 ? 1 : -1) * (2 * intrinsics[2 + k] - size[k]) / size[k];
    }
    name_edges(t);
}

void texture_tangents_take(const camera_matrix *m, texture_matrix *t) {
    t->taken = m->taken;
    name_edges(t);
}

int texture_matrix_open(texture_request *o, texture_source *s) {
    const bool given = option_given(o->line, "mapping");
    camera_fault fault = {.key = NULL};
    if (!camera_take_matrix(&o->camera.said, DP_MAPPING_D3D, true, &fault))
        return camera_refuse(&fault);
    const camera_matrix *m = &o->camera.matrix;
    if (m->taken.oblique && o->image.synthetic != NULL)
        return option_error("matrix", "has planes that differ from pixel to pixel, which --synthetic cannot draw");
    s->matrix.path = option_text(o->line, "matrix");
    s->matrix.taken = m->taken;
    name_edges(&s->matrix);
    s->mapping_from = given ? ORIGIN_GIVEN : m->assumed ? ORIGIN_ASSUMED : ORIGIN_FOUND;
    s->direction_from = m->taken.ortho && !given ? ORIGIN_ASSUMED : given ? ORIGIN_GIVEN : ORIGIN_FOUND;
    return EXIT_FINE;
}

void texture_matrix_say(const texture_matrix *t, page *p) {
    const dp_projection *x = &t->taken;
    const bool centred = x->centre[0] == 0 && x->centre[1] == 0;
    page_note(p, "matrix", "%s: looks along %s%s%s", t->path, t->looks, centred ? "" : ", not centred",
              t->oblique ? ", planes of each pixel's own: near is the nearest, far the farthest" : "");
    if (x->ortho)
        page_note(p, "picture", "from %s to %s, %s to %s scene units", number_of(t->edges[0], 6).text,
                  number_of(t->edges[1], 6).text, number_of(t->edges[2], 6).text, number_of(t->edges[3], 6).text);
    else
        page_note(p, "field of view", "%s x %s degrees; slopes from %s to %s, %s to %s", number_of(t->fov[0], 6).text,
                  number_of(t->fov[1], 6).text, number_of(t->edges[0], 6).text, number_of(t->edges[1], 6).text,
                  number_of(t->edges[2], 6).text, number_of(t->edges[3], 6).text);
}

const column texture_matrix_columns[] = {
    {FIELD(texture_matrix, path, "file", "")},           {FIELD(texture_matrix, looks, "looks_along", "")},
    {FIELD(texture_matrix, oblique, "oblique", "")},     {FIELD(texture_matrix, edges[0], "left", "")},
    {FIELD(texture_matrix, edges[1], "right", "")},      {FIELD(texture_matrix, edges[2], "bottom", "")},
    {FIELD(texture_matrix, edges[3], "top", "")},        {FIELD(texture_matrix, fov[0], "fov_x", "degrees")},
    {FIELD(texture_matrix, fov[1], "fov_y", "degrees")}, {.kind = COLUMN_END}};
