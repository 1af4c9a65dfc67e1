/* SPDX-License-Identifier: MIT */
/* The steps of the binary32 pipeline, each float in, float out: what a vertex at w becomes. */
#ifndef CORE_CLIP_H
#define CORE_CLIP_H

#include <math.h>

#include "core/reciprocal.h"
#include "depthprec/pipeline.h"

/* The shader's remap turns [-1, 1] into [0, 1]; everything behind it then is zero-to-one. */
static inline int dp_clip_is_signed(const dp_pipeline *p) {
    return p->ndc_signed && !p->arith->remap;
}

/* fl(fl(A z) + B), or fused */
static inline float dp_clip_project(const dp_pipeline *p, float z) {
    if (p->arith->fused)
        return fmaf(p->a, z, p->b);
    const float product = p->a * z;
    return product + p->b;
}

static inline float dp_clip_remap(const dp_pipeline *p, float clip, float w) {
    if (!(p->ndc_signed && p->arith->remap))
        return clip;
    const float sum = clip + w;
    return sum * 0.5f;
}

/* fl(fl(S ndc) + O), or fused */
static inline float dp_clip_viewport(const dp_pipeline *p, float ndc) {
    const float product = p->scale * ndc;
    return p->arith->fused ? fmaf(p->scale, ndc, p->offset) : product + p->offset;
}

static inline float dp_clip_window(const dp_pipeline *p, float clip, float w) {
    float ndc;
    if (p->arith->reciprocal != DP_RECIPROCAL_NONE) {
        const float inverse = p->arith->reciprocal == DP_RECIPROCAL_UNIT ? dp_reciprocal_unit(w) : 1.0f / w;
        ndc = clip * inverse;
    } else {
        ndc = clip / w;
    }
    return p->moved ? dp_clip_viewport(p, ndc) : ndc;
}

#endif
