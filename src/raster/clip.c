/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sutherland and Hodgman's clipping, one plane after the other; the order and the formulas are the rule's. */
#include "raster/clip.h"

#include <math.h>
#include <string.h>

unsigned raster_outside(const raster_vertex vertex[3], unsigned *all) {
    unsigned any = 0;
    *all = ~0U;
    for (int i = 0; i < 3; i++) {
        const raster_vertex *v = &vertex[i];
        const unsigned outside = (unsigned)(v->x > v->w) << RASTER_RIGHT | (unsigned)(v->x < -v->w) << RASTER_LEFT |
                                 (unsigned)(v->y > v->w) << RASTER_TOP | (unsigned)(v->y < -v->w) << RASTER_BOTTOM |
                                 (unsigned)(v->z < 0.0F) << RASTER_NEAR | (unsigned)(v->z > v->w) << RASTER_FAR;
        any |= outside;
        *all &= outside;
    }
    return any;
}

/* Two terms at most are not zero, so it is rounded once. */
static float distance(unsigned plane, const raster_vertex *v) {
    static const float planes[RASTER_PLANES][4] = {
        [RASTER_RIGHT] = {-1, 0, 0, 1}, [RASTER_LEFT] = {1, 0, 0, 1}, [RASTER_TOP] = {0, -1, 0, 1},
        [RASTER_BOTTOM] = {0, 1, 0, 1}, [RASTER_NEAR] = {0, 0, 1, 0}, [RASTER_FAR] = {0, 0, -1, 1},
    };
    const float *p = planes[plane];
    return p[0] * v->x + p[1] * v->y + p[2] * v->z + p[3] * v->w;
}

/* One plane. An edge yields its first corner when that is inside, then where it crosses. */
static int clip_plane(const raster_clip_rule *rule, unsigned plane, const raster_corner *in, int count,
                      raster_corner *out) {
    int made = 0;
    for (int i = 0; i < count; i++) {
        const raster_corner *from = &in[i];
        const raster_corner *to = &in[(i + 1) % count];
        const float d_from = distance(plane, &from->at);
        const float d_to = distance(plane, &to->at);
        if (!isfinite(d_from) || made + 2 > RASTER_CORNERS)
            return 0;
        if (d_from >= 0.0F)
            out[made++] = *from;
        if (d_from >= 0.0F && d_to < 0.0F)
            out[made++] = (raster_corner){rule->cut(&from->at, &to->at, d_from, d_to), -1};
        else if (d_from < 0.0F && d_to >= 0.0F)
            out[made++] = (raster_corner){rule->cut(&to->at, &from->at, d_to, d_from), -1};
    }
    return made;
}

int raster_clip(const raster_clip_rule *rule, const raster_vertex vertex[3], unsigned outside,
                raster_corner corner[RASTER_CORNERS]) {
    raster_corner before[RASTER_CORNERS];
    int count = 3;
    for (int i = 0; i < 3; i++)
        corner[i] = (raster_corner){vertex[i], i};
    for (int i = 0; i < RASTER_PLANES && count >= 3; i++)
        if ((outside >> rule->order[i] & 1U) != 0) {
            memcpy(before, corner, (size_t)count * sizeof *corner);
            count = clip_plane(rule, rule->order[i], before, count, corner);
        }
    return count >= 3 ? count : 0;
}
