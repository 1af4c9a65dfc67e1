/* SPDX-License-Identifier: MIT */
#include "depthprec/setup.h"

#include "core/engine.h"
#include "core/lattice.h"
#include "core/logarithm.h"

static const char *const model_names[DP_MODEL_COUNT] = {
    [DP_MODEL_EXACT] = "exact",
    [DP_MODEL_STAGED] = "staged",
    [DP_MODEL_FLOAT] = "float",
};

const char *dp_model_name(dp_model model) {
    return (unsigned)model < DP_MODEL_COUNT ? model_names[model] : NULL;
}

dp_spec dp_spec_default(void) {
    dp_spec spec = {.znear = 0.1, .zfar = 1000.0, .mapping = DP_MAPPING_D3D, .log_c = 1.0};
    dp_format formats[2];
    dp_format_parse("fp32", formats);
    spec.format = formats[0];
    return spec;
}

/* The fields that everything behind the door relies on; they may come from a caller's own hand. */
static int format_is_sound(const dp_format *f) {
    if (f->kind == DP_FORMAT_UNORM)
        return f->bits >= 1 && f->bits <= 32 &&
               (f->code_max == 0xFFFFFFFFU >> (32 - f->bits) || (f->bits == 16 && dp_format_is_rg(f)));
    return f->kind == DP_FORMAT_FLOAT && f->exponent_bits >= 2 && f->exponent_bits <= 8 && f->mantissa_bits >= 1 &&
           f->mantissa_bits <= 23 && f->bits == f->exponent_bits + f->mantissa_bits && f->bias >= 1 &&
           f->bias < 1 << f->exponent_bits && f->code_max == (uint32_t)f->bias << f->mantissa_bits;
}

static int within(double value, double lowest, double highest) {
    return value >= lowest && value <= highest;
}

/* 0, or of a magnitude whose last bits no product behind the door loses. */
static int is_plane(double z, double most) {
    return z == 0.0 || within(fabs(z), 1e-12, most);
}

/* Above 1e18 products that binary32 and logarithms form may be no larger than those of all near planes and constants
 * with that. */
static int far_is_held(const dp_spec *spec, const dp_mapping_row *row) {
    const double by = row->curve != DP_CURVE_LOG ? spec->znear : row->log_over_near ? 1.0 / spec->znear : spec->log_c;
    return spec->zfar <= 1e18 || (spec->zfar <= 1e28 && spec->znear * spec->zfar <= 1e30 && by * spec->zfar <= 1e30);
}

int dp_range_moves(const double range[2]) {
    return range[0] != 0.0 || (range[1] != 0.0 && range[1] != 1.0);
}

static int is_end(double d) {
    return d == 0.0 || within(d, DP_RANGE_LEAST, 1.0);
}

int dp_range_fits(const double range[2]) {
    return !dp_range_moves(range) ||
           (is_end(range[0]) && is_end(range[1]) && fabs(range[1] - range[0]) >= DP_RANGE_LEAST);
}

static int range_is_sound(const double range[2], const dp_mapping_row *row) {
    return !dp_range_moves(range) || (dp_range_fits(range) && row->curve == DP_CURVE_PERSPECTIVE);
}

static dp_status check(const dp_spec *spec) {
    const dp_mapping_row *row = dp_mapping_get(spec->mapping);
    if (row == NULL)
        return DP_ERROR_MAPPING;
    const int any_sign = spec->ortho != 0;
    const struct {
        int good;
        dp_status status;
    } rules[] = {
        {format_is_sound(&spec->format), DP_ERROR_FORMAT},
        {dp_rounding_name(spec->rounding) != NULL, DP_ERROR_ROUNDING},
        {!dp_format_is_rg(&spec->format) || (spec->mapping == DP_MAPPING_LINEAR && spec->rounding == DP_ROUND_NEAREST),
         DP_ERROR_FORMAT},
        {dp_model_name(spec->model) != NULL, DP_ERROR_MODEL},
        {dp_arith_get(spec->arith) != NULL, DP_ERROR_ARITH},
        {any_sign || within(spec->znear, 1e-12, 1e12), DP_ERROR_NEAR},
        {!any_sign || is_plane(spec->znear, 1e12), DP_ERROR_ORTHO_NEAR},
        {(spec->zfar > spec->znear && (any_sign || far_is_held(spec, row))) || spec->zfar == HUGE_VAL,
         spec->znear > 0.0 ? DP_ERROR_FAR : DP_ERROR_ORTHO_FAR},
        {!any_sign || isinf(spec->zfar) || is_plane(spec->zfar, 1e18), DP_ERROR_ORTHO_FAR},
        {spec->znear == 0.0 || (spec->zfar - spec->znear) / fabs(spec->znear) >= 1e-6, DP_ERROR_PLANES},
        {!spec->ortho || row->ortho, DP_ERROR_ORTHO},
        {!isinf(spec->zfar) || (row->far_infinite && !spec->ortho), DP_ERROR_INFINITE},
        {spec->model != DP_MODEL_FLOAT || row->curve == DP_CURVE_PERSPECTIVE, DP_ERROR_MODEL},
        {row->curve != DP_CURVE_LOG || row->log_over_near || within(spec->log_c, 1e-12, 1e12), DP_ERROR_LOG_C},
        {range_is_sound(spec->depth_range, row), DP_ERROR_WINDOW},
        {spec->model != DP_MODEL_STAGED || !dp_range_moves(spec->depth_range), DP_ERROR_MODEL},
        {spec->triangles.width == 0 || (!spec->ortho && dp_triangles_check(&spec->triangles) == DP_OK),
         DP_ERROR_TRIANGLES},
    };
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++)
        if (!rules[i].good)
            return rules[i].status;
    return DP_OK;
}

dp_setup dp_setup_facing(const dp_setup *setup) {
    dp_setup facing = *setup;
    facing.spec.triangles.width = 0;
    return facing;
}

dp_setup dp_setup_guaranteed(const dp_setup *setup) {
    const int fp32 = dp_mapping_get(setup->spec.mapping)->curve == DP_CURVE_PERSPECTIVE;
    const dp_model model = fp32 ? DP_MODEL_FLOAT : DP_MODEL_STAGED;
    dp_setup out = *setup;
    if (model != setup->spec.model) /* cannot fail: the set-up was made, and its mapping has that model */
        dp_setup_in(setup, model, &out);
    out.shader = out.curve == DP_CURVE_LOG;
    return out;
}

/* The ends of the window depths, exactly: binary32 numbers of which none is small. */
static void set_range(dp_setup *setup, const dp_mapping_row *row) {
    double *range = setup->spec.depth_range;
    setup->ranged = dp_range_moves(range);
    range[1] = setup->ranged ? range[1] : 1.0;
    for (int i = 0; i < 2; i++)
        setup->ends[i] = (double)(float)(range[row->reversed ? 1 - i : i] + 0.0); /* -0 is 0 */
    setup->reversed = setup->ends[1] < setup->ends[0];
    setup->low = setup->ends[!setup->reversed ? 0 : 1];
    setup->span = fabs(setup->ends[1] - setup->ends[0]);
}

dp_status dp_setup_init(dp_setup *setup, const dp_spec *spec) {
    if (setup == NULL || spec == NULL)
        return DP_ERROR_NULL;
    const dp_status status = check(spec);
    if (status != DP_OK)
        return status;

    const dp_mapping_row *row = dp_mapping_get(spec->mapping);
    const double n = spec->znear + 0.0; /* -0 is 0 */
    const double f = spec->zfar + 0.0;
    *setup = (dp_setup){.spec = *spec,
                        .curve = spec->ortho ? DP_CURVE_LINEAR : row->curve,
                        .spans_zero = n < 0.0 && f > 0.0,
                        .den = dp_point_den(&spec->format)};
    set_range(setup, row);
    setup->spec.znear = n;
    setup->spec.zfar = f;
    if (setup->curve == DP_CURVE_PERSPECTIVE) {
        setup->kappa = isinf(f) ? 1.0 / n : (f - n) / n / f;
        setup->scale = isinf(f) ? 1.0 : (setup->reversed ? n : f) / (f - n);
    } else if (setup->curve == DP_CURVE_LINEAR) {
        setup->anchor = spec->ortho ? n : 0.0;
        setup->kappa = f - setup->anchor;
    } else {
        setup->anchor = row->log_from_near ? n : 0.0;
        setup->log_c = row->log_over_near ? 1.0 / n : spec->log_c;
        setup->log_by = row->log_over_near ? 0.0 : spec->log_c;
        const dp_pair top = dp_log1p_excess(f, setup->anchor, setup->log_by);
        setup->kappa = top.hi;
        setup->log_hi = top.hi;
        setup->log_lo = top.lo;
    }
    if (setup->ranged)
        setup->kappa /= setup->span;
    if (row->curve == DP_CURVE_PERSPECTIVE)
        dp_pipeline_prepare(setup);
    /* Only linear and logarithmic mappings can store near as something else than an end. */
    setup->code_near = dp_format_encode(&spec->format, spec->rounding, setup->ends[0]);
    if (!spec->ortho && row->curve != DP_CURVE_PERSPECTIVE) {
        int certain;
        setup->code_near = dp_code_exact(setup, n, dp_code_quick(setup, n, &certain));
    }
    setup->code_far = dp_format_encode(&spec->format, spec->rounding, setup->ends[1]);
    if (spec->model == DP_MODEL_FLOAT) {
        setup->code_near = dp_code(setup, n);
        setup->code_far = dp_code(setup, f);
    }
    return DP_OK;
}
