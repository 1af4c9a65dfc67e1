/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A whole image: the rows that a method looks at go round in a ring, so an image of any height takes the same room. */
#include <math.h>
#include <stdlib.h>

#include "texture/normal.h"

enum { RING = 2 * NORMAL_REACH + 1 };

typedef struct ring {
    size_t stride;
    float *empty;       /* stands for the rows beyond the border */
    float *slope;       /* with margins */
    float *lines[RING]; /* row r is in lines[r % RING]; margins are NaN */
    float *normal[3];
    float *block;
} ring;

static bool ring_open(ring *r, const texture_camera *camera) {
    r->stride = (size_t)camera->width + 2 * NORMAL_REACH;
    const size_t blocks = RING + 5;
    r->block = malloc(blocks * r->stride * sizeof *r->block);
    if (r->block == NULL)
        return false;
    for (size_t i = 0; i < (RING + 1) * r->stride; i++)
        r->block[i] = NAN;
    for (int i = 0; i < RING; i++)
        r->lines[i] = r->block + (size_t)i * r->stride + NORMAL_REACH;
    r->empty = r->block + RING * r->stride + NORMAL_REACH;
    for (int i = 0; i < 3; i++)
        r->normal[i] = r->block + (size_t)(RING + 1 + i) * r->stride;
    r->slope = r->block + (RING + 4) * r->stride + NORMAL_REACH;
    for (int i = -NORMAL_REACH; i < (int)camera->width + NORMAL_REACH; i++)
        r->slope[i] = (float)camera_slope_x(camera, i);
    return true;
}

bool normal_run(const normal_row *method, const texture_camera *camera, uint32_t first, uint32_t count,
                normal_source source, normal_sink sink, void *context) {
    ring r;
    if (!ring_open(&r, camera))
        return false;
    const int64_t reach = method->reach, height = camera->height;
    int64_t filled = (int64_t)first - reach > 0 ? (int64_t)first - reach : 0;
    for (int64_t row = first; row < (int64_t)first + count && row < height; row++) {
        for (; filled <= row + reach && filled < height; filled++)
            source(context, (uint32_t)filled, r.lines[filled % RING]);
        normal_rows in = {.camera = camera, .row = (uint32_t)row, .count = camera->width, .slope_x = r.slope};
        for (int64_t k = -NORMAL_REACH; k <= NORMAL_REACH; k++) {
            const int64_t at = row + k;
            const bool there = at >= 0 && at < height && k >= -reach && k <= reach;
            in.rows[NORMAL_REACH + k] = there ? r.lines[at % RING] : r.empty;
        }
        method->run(&in, r.normal[0], r.normal[1], r.normal[2]);
        sink(context, &in, (const float *const *)r.normal);
    }
    free(r.block);
    return true;
}
