/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sutherland and Hodgman's clipping, one plane after the other; the order and the formulas are the rule's. */
#include "raster/clip.h"

#include <math.h>
#include <string.h>

float raster_right(const raster_vertex *v) {
    return v->w - v->x;
}

float raster_left(const raster_vertex *v) {
    return v->w + v->x;
}

float raster_top(const raster_vertex *v) {
    return v->w - v->y;
}

float raster_bottom(const raster_vertex *v) {
    return v->w + v->y;
}

float raster_near(const raster_vertex *v) {
    return v->z;
}

float raster_far(const raster_vertex *v) {
    return v->w - v->z;
}

unsigned raster_outside(const raster_clip_rule *rule, const raster_vertex vertex[3], unsigned *all) {
    unsigned any = 0;
    *all = ~0U;
    for (int i = 0; i < 3; i++) {
        unsigned outside = 0;
        for (unsigned k = 0; k < RASTER_PLANES; k++)
            outside |= (rule->distance[k](&vertex[i]) < 0.0F ? 1U : 0U) << k;
        any |= outside;
        *all &= outside;
    }
    return any;
}

/* One plane. An edge yields its first corner when that is inside, then where it crosses. */
static int clip_plane(const raster_clip_rule *rule, unsigned plane, const raster_corner *in, int count,
                      raster_corner *out) {
    int made = 0;
    for (int i = 0; i < count; i++) {
        const raster_corner *from = &in[i];
        const raster_corner *to = &in[(i + 1) % count];
        const float d_from = rule->distance[plane](&from->at);
        const float d_to = rule->distance[plane](&to->at);
        if (!isfinite(d_from) || made + 2 > RASTER_CORNERS)
            return 0;
        if (d_from >= 0.0F)
            out[made++] = *from;
        if (d_from >= 0.0F && d_to < 0.0F)
            out[made++] = (raster_corner){rule->cut(&from->at, &to->at, d_from, d_to), -1};
        else if (d_from < 0.0F && (d_to > 0.0F || (rule->touching && d_to == 0.0F)))
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
    for (unsigned plane = 0; plane < RASTER_PLANES && count >= 3; plane++)
        if ((outside >> plane & 1U) != 0) {
            memcpy(before, corner, (size_t)count * sizeof *corner);
            count = clip_plane(rule, plane, before, count, corner);
        }
    return count >= 3 ? count : 0;
}
