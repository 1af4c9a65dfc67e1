/* SPDX-License-Identifier: MIT */
#include "depthprec/depth.h"

#include "core/boundary.h"
#include "core/curve.h"
#include "core/elementary.h"
#include "core/engine.h"
#include "depthprec/pipeline.h"

/* The window depth of [0, 1], before a viewport moves it: that from its lesser end. */
static inline double unmoved(const dp_setup *setup, double z) {
    const double n = setup->spec.znear;
    const double f = setup->spec.zfar;
    double d;
    if (setup->reversed ? z <= n : z >= f)
        return 1.0;
    if (setup->curve == DP_CURVE_LOG)
        d = dp_log1p(setup->log_c * (z - setup->anchor)) / setup->kappa;
    else if (setup->curve == DP_CURVE_LINEAR)
        d = (setup->reversed ? f - z : z - setup->anchor) / (setup->kappa * setup->span);
    else if (isinf(f))
        d = setup->reversed ? n / z : (z - n) / z;
    else
        d = (setup->reversed ? f - z : z - n) / z * setup->scale;
    return d < 1.0 ? d : 1.0;
}

double dp_window(const dp_setup *setup, double z) {
    const double d = unmoved(setup, z);
    return setup->ranged ? setup->low + setup->span * d : d;
}

double dp_eye(const dp_setup *setup, double d, double q) {
    if (setup->spans_zero &&
        !setup->ranged) /* both are taken as they are given: next to 0 neither stands for the other */
        return dp_exact_residual(1.0, setup->reversed ? d : q, setup->spec.znear, 0.0, 1.0, setup->reversed ? q : d,
                                 setup->spec.zfar, 0.0);
    return dp_curve_eye(setup, (dp_point){d, q, 1.0});
}

/* The stages are monotone: where both ends of the error interval of d get one code, so does d. */
static uint32_t staged_quick(const dp_setup *setup, double d, int *certain) {
    /* The second term is for 2d - 1. */
    const double slack = d * DP_WINDOW_ERROR + (dp_mapping_get(setup->spec.mapping)->ndc_signed ? 0x1p-52 : 0.0);
    const uint32_t low = dp_staged_code(setup, d - slack > 0.0 ? d - slack : 0.0);
    const uint32_t high = dp_staged_code(setup, d + slack < 1.0 ? d + slack : 1.0);
    *certain = low == high;
    return low;
}

uint32_t dp_code_quick(const dp_setup *setup, double z, int *certain) {
    const double d = dp_window(setup, z);
    if (setup->spec.model != DP_MODEL_EXACT)
        return staged_quick(setup, d, certain);
    const dp_scaled s = dp_scale_depth(&setup->spec.format, d);
    const double slack = s.t * DP_WINDOW_ERROR;
    const double whole = floor(s.t);
    const double part = s.t - whole;
    const uint32_t floor_code = s.base + (uint32_t)whole;
    if (setup->spec.rounding == DP_ROUND_ZERO) {
        *certain = part > slack && 1.0 - part > slack;
        return floor_code;
    }
    *certain = fabs(part - 0.5) > slack;
    return floor_code + (part > 0.5);
}

/* Whether z is stored as a code below the boundary. */
static int stored_below(const dp_setup *setup, double z, const dp_boundary *boundary) {
    const double gap = dp_curve_gap(setup, boundary->point, z);
    return gap == 0.0 ? !boundary->ties_up : (gap > 0.0) != setup->reversed;
}

uint32_t dp_code_exact(const dp_setup *setup, double z, uint32_t start) {
    const uint32_t code_max = setup->spec.format.code_max;
    uint32_t code = start < code_max ? start : code_max;
    while (code > 0) {
        const dp_boundary b = dp_boundary_below(setup, code);
        if (!stored_below(setup, z, &b))
            break;
        code = b.below;
    }
    while (code < code_max) {
        const dp_boundary b = dp_boundary_below(setup, code + 1);
        if (stored_below(setup, z, &b))
            break;
        code = b.above;
    }
    return code;
}

/* The pipeline's code of the binary32 depth that a shader has for z. */
static uint32_t pipeline_code(const dp_setup *setup, double z) {
    dp_pipeline pipeline;
    if (dp_pipeline_init(&pipeline, setup) != DP_OK)
        return 0;
    const double clamped = z < setup->spec.znear ? setup->spec.znear : z < setup->spec.zfar ? z : setup->spec.zfar;
    return dp_pipeline_code(&pipeline, (float)clamped);
}

uint32_t dp_code(const dp_setup *setup, double z) {
    if (setup->spec.model == DP_MODEL_FLOAT)
        return pipeline_code(setup, z);
    if (!(z > setup->spec.znear))
        return setup->code_near;
    if (z >= setup->spec.zfar)
        return setup->code_far;
    int certain;
    const uint32_t code = dp_code_quick(setup, z, &certain);
    return certain ? code : dp_code_exact(setup, z, code);
}

double dp_stored(const dp_setup *setup, uint32_t code) {
    return dp_curve_eye(setup, dp_point_of_code(&setup->spec.format, code));
}

double dp_error(const dp_setup *setup, uint32_t code, double z) {
    if (isinf(z))
        return isinf(dp_stored(setup, code)) ? 0.0 : -HUGE_VAL;
    return dp_curve_gap(setup, dp_point_of_code(&setup->spec.format, code), z);
}

dp_cell dp_cell_of(const dp_setup *setup, uint32_t code) {
    const dp_spec *spec = &setup->spec;
    const int reversed = setup->reversed;
    dp_cell cell = {.code = code, .stored = dp_stored(setup, code)};
    if (spec->model == DP_MODEL_FLOAT) {
        cell.lo = cell.hi = cell.width = (double)NAN;
        return cell;
    }
    const int nearer = reversed ? code > setup->code_near : code < setup->code_near;
    const int farther = reversed ? code < setup->code_far : code > setup->code_far;
    if (nearer || farther) {
        cell.lo = cell.hi = nearer ? spec->znear : spec->zfar;
        return cell;
    }
    /* From the near plane or a boundary to a boundary or the far plane. Planes lie on the lattice, but for the near
       plane of the linear and logarithmic mappings, and both where a viewport moves depth, of which dp_curve_span()
       knows one at a time. */
    const int first = code == setup->code_near;
    const int last = code == setup->code_far;
    const int off_lattice = first && !setup->ranged && !spec->ortho && setup->curve != DP_CURVE_PERSPECTIVE;
    const double end = setup->den;
    const dp_point to_near =
        first ? dp_point_make(reversed ? end : 0.0, end) : dp_boundary_below(setup, code + (uint32_t)reversed).point;
    const dp_point to_far =
        last ? dp_point_make(reversed ? 0.0 : end, end) : dp_boundary_below(setup, code + (uint32_t)!reversed).point;
    /* An end rounded beyond a plane, or before the other end, belongs on it. */
    cell.lo = first ? spec->znear : fmin(fmax(dp_curve_eye(setup, to_near), spec->znear), spec->zfar);
    cell.hi = last ? spec->zfar : fmin(fmax(dp_curve_eye(setup, to_far), cell.lo), spec->zfar);
    cell.width = isinf(cell.hi)                   ? HUGE_VAL
                 : off_lattice                    ? dp_curve_gap(setup, to_far, spec->znear)
                 : setup->ranged && first && last ? spec->zfar - spec->znear
                                                  : dp_curve_span(setup, to_near, to_far);
    return cell;
}
