/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/normals.h"

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "shader/packing.h"

typedef struct making {
    frame_normals *out;
    uint32_t width;
} making;

/* Packs the normals of rows. A pixel has an eye depth, unless it is sky, a normal, and the bound of that. */
static bool pack_rows(void *context, uint32_t row, uint32_t count, const float *const *values) {
    static const double to_camera[3] = {0, 0, 1};
    const making *m = context;
    const size_t first = (size_t)row * m->width;
    for (size_t i = 0; i < (size_t)count * m->width; i++) {
        const float *n = values[1] + 3 * i;
        const bool found = !isnan(n[0]);
        packing_normal_texel(found ? (const double[]){n[0], n[1], -n[2]} : to_camera, m->out->own + 2 * (first + i));
        if (m->out->off == NULL)
            continue;
        const double off = isnan(values[0][i]) ? 0 : found && !isnan(values[2][i]) ? (double)values[2][i] : 180;
        double back[3];
        packing_normal(m->out->own + 2 * (first + i), back);
        const double lost = found ? normal_angle((const double[]){n[0], n[1], -n[2]}, back) / DP_DEGREE : 0;
        const double all = off + (lost > pack_stereo()->normal.max ? lost : 0); /* beyond what the channels hold */
        m->out->off[first + i] = (uint16_t)ceil(fmin(all, 180) * FRAME_NORMAL_DEGREE);
    }
    return true;
}

bool frame_normals_make(const frame *f, const normal_row *method, bool error, frame_normals *out) {
    const bool bounded = error && f->synthetic == NULL;
    const size_t pixels = (size_t)f->camera->width * f->camera->height;
    const frame_product products[] = {{.kind = FRAME_EYE},
                                      {.kind = FRAME_NORMAL, .normal = method},
                                      {.kind = FRAME_NORMAL, .normal = method, .error = true}};
    *out = (frame_normals){.own = malloc(2 * pixels), .off = bounded ? malloc(pixels * sizeof *out->off) : NULL};
    out->texels = out->own;
    making m = {out, f->camera->width};
    return out->own != NULL && (!bounded || out->off != NULL) &&
           frame_run_all(f, products, bounded ? 3 : 2, false, pack_rows, &m);
}

void frame_normals_free(frame_normals *n) {
    free(n->own);
    free(n->off);
}
