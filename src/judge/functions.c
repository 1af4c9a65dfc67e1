/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inputs and outputs of functions of depth: rows. */
#include <math.h>

#include "core/curve.h"
#include "core/elementary.h"
#include "judge/judge.h"

/* ---- What goes in ------------------------------------------------------------------------------------------------ */

static double itself(double x) {
    return x;
}

static double of_ndc(double x) {
    return 0.5 + 0.5 * x;
}

static judge_depth of_point(const dp_setup *s, dp_point p, double ndc) {
    return (judge_depth){.z = dp_curve_eye(s, p), .num = p.num, .comp = p.comp, .den = p.den, .ndc = ndc};
}

static judge_depth depth_of_window(const dp_setup *s, double x) {
    return of_point(s, (dp_point){x, 1 - x, 1}, x - (1 - x));
}

static judge_depth depth_of_ndc(const dp_setup *s, double x) {
    if (!dp_mapping_get(s->spec.mapping)->ndc_signed)
        return (judge_depth){.z = (double)NAN};
    return of_point(s, (dp_point){1 + x, 1 - x, 2}, x);
}

static judge_depth depth_of_code(const dp_setup *s, double x) {
    if (!(x >= 0 && x <= s->spec.format.code_max && x == floor(x)))
        return (judge_depth){.z = (double)NAN};
    const dp_point p = dp_point_of_code(&s->spec.format, (uint32_t)x);
    return of_point(s, p, (p.num - p.comp) / p.den);
}

judge_depth judge_depth_of(const dp_setup *s, double z) {
    (void)s;
    return (judge_depth){.z = z};
}

/* Exact gaps take ten times as long as all the rest: few functions need them. */
static double gap(const dp_setup *s, const judge_depth *at, double z) {
    return at->den > 0 ? dp_curve_gap(s, (dp_point){at->num, at->comp, at->den}, z) : at->z - z;
}

double judge_behind(const dp_setup *s, const judge_depth *at) {
    return gap(s, at, s->spec.znear);
}

double judge_left(const dp_setup *s, const judge_depth *at) {
    return isinf(s->spec.zfar) ? (double)INFINITY : -gap(s, at, s->spec.zfar);
}

static judge_depth depth_of_view(const dp_setup *s, double x) {
    return judge_depth_of(s, -x);
}

static const judge_input inputs[] = {
    [JUDGE_WINDOW] = {"window depth", depth_of_window, itself, 0},
    [JUDGE_NDC] = {"NDC depth", depth_of_ndc, of_ndc, 0},
    [JUDGE_CODES] = {"codes", depth_of_code, NULL, 0},
    [JUDGE_EYE] = {"eye depth", judge_depth_of, NULL, 1},
    [JUDGE_VIEW] = {"minus eye depth", depth_of_view, NULL, -1},
};

const judge_input *judge_input_get(size_t index) {
    return index < sizeof inputs / sizeof inputs[0] ? &inputs[index] : NULL;
}

/* ---- What comes out ---------------------------------------------------------------------------------------------- */

static double eye(const dp_setup *s, const judge_depth *at) {
    (void)s;
    return at->z;
}

static double behind(const dp_setup *s, const judge_depth *at) {
    (void)s;
    return -at->z;
}

static double over_far(const dp_setup *s, const judge_depth *at) {
    return isinf(s->spec.zfar) ? (double)NAN : at->z / s->spec.zfar;
}

static double from_near(const dp_setup *s, const judge_depth *at) {
    return isinf(s->spec.zfar) ? (double)NAN : judge_behind(s, at) / (s->spec.zfar - s->spec.znear);
}

static double minus(const dp_setup *s, double v) {
    (void)s;
    return -v;
}

static double same(const dp_setup *s, double v) {
    (void)s;
    return v;
}

static double eye_over_far(const dp_setup *s, double v) {
    return v * s->spec.zfar;
}

static double eye_from_near(const dp_setup *s, double v) {
    return s->spec.znear + v * (s->spec.zfar - s->spec.znear);
}

static double over(const dp_setup *s, double v) {
    (void)s;
    return 1 / v;
}

static double reciprocal(const dp_setup *s, const judge_depth *at) {
    (void)s;
    return 1 / at->z;
}

/* Beyond the planes as the formula goes on: whoever clamps it is told by the clamp. */
static double window(const dp_setup *s, const judge_depth *at) {
    if (at->den > 0)
        return at->num / at->den;
    const double way = s->reversed ? judge_left(s, at) : judge_behind(s, at);
    if (s->curve == DP_CURVE_LOG)
        return dp_log1p(s->log_c * (at->z - s->anchor)) / s->kappa;
    if (s->curve == DP_CURVE_LINEAR)
        return (s->reversed || s->spec.ortho ? way : at->z) / s->kappa;
    return isinf(s->spec.zfar) && s->reversed ? s->spec.znear / at->z : way / at->z * s->scale;
}

static double complement(const dp_setup *s, const judge_depth *at) {
    return at->den > 0 ? at->comp / at->den : 1 - window(s, at);
}

/* NDC depth, from the depth in the middle of the buffer, where it is 0. */
static double ndc(const dp_setup *s, const judge_depth *at) {
    if (!dp_mapping_get(s->spec.mapping)->ndc_signed)
        return (double)NAN;
    if (at->den > 0)
        return at->ndc;
    const dp_point middle = {1, 1, 2};
    const double nearer = dp_curve_gap(s, middle, at->z), sign = s->reversed ? 2 : -2;
    if (s->curve == DP_CURVE_LOG)
        return sign * dp_log1p(nearer / (at->z - s->anchor + 1 / s->log_c)) / s->kappa;
    return sign * nearer / s->kappa / (s->curve == DP_CURVE_LINEAR ? 1 : at->z * dp_curve_eye(s, middle));
}

static double code(const dp_setup *s, const judge_depth *at) {
    const double d = window(s, at);
    return isnan(d) ? d : (double)dp_format_encode(&s->spec.format, s->spec.rounding, fmin(fmax(d, 0), 1));
}

/* The depth that the matrix gives where the shader then writes a logarithm. */
static double of_matrix(const dp_setup *s, const judge_depth *at) {
    const double n = s->spec.znear, f = s->spec.zfar;
    return s->curve != DP_CURVE_LOG ? (double)NAN : judge_behind(s, at) / at->z * (isinf(f) ? 1 : f / (f - n));
}

static double eye_line(double v, double share, bool ortho) {
    (void)share;
    return ortho ? v : 1 / v;
}

static double behind_line(double v, double share, bool ortho) {
    return eye_line(-v, share, ortho);
}

static double reciprocal_line(double v, double share, bool ortho) {
    return eye_line(1 / v, share, ortho);
}

static double from_near_line(double v, double share, bool ortho) {
    return ortho ? (double)NAN : share / v;
}

/* clang-format off */
static const judge_output outputs[] = {
    {.name = "eye depth", .formula = "z",
     .called = {"LinearEyeDepth of Unity, ConvertFromDeviceZ of Unreal", "LinearDepthToEyeDepth of Unity",
                "the depth along the view axis, w of clip space"},
     .source = "com.unity.render-pipelines.core, Common.hlsl; Unreal Engine, Common.ush",
     .of = eye, .unbounded = true, .eye = same, .planes = JUDGE_PLANES_BOTH, .line = eye_line},
    {.name = "minus eye depth", .formula = "-z",
     .called = {"perspectiveDepthToViewZ of three.js: view z of a camera that looks along -z",
                "orthographicDepthToViewZ of three.js: view z of a camera that looks along -z",
                "logarithmicDepthToViewZ of three.js: view z of a camera that looks along -z"},
     .source = "three.js, packing.glsl.js; ViewportDepthNode.js",
     .of = behind, .unbounded = true, .eye = minus, .planes = JUDGE_PLANES_BOTH, .line = behind_line},
    {.name = "eye depth over far", .formula = "z/far",
     .called = {"Linear01Depth of Unity", "depth as a share of far", "linear depth, that of a W-buffer"},
     .source = "com.unity.render-pipelines.core, Common.hlsl",
     .of = over_far, .unbounded = true, .eye = eye_over_far, .planes = JUDGE_PLANES_RATIO, .line = eye_line},
    {.name = "the way from near to far", .formula = "(z - near)/(far - near)",
     .called = {"Linear01DepthFromNear of Unity, viewZToOrthographicDepth of three.js",
                "viewZToOrthographicDepth of three.js", "viewZToOrthographicDepth of three.js"},
     .source = "com.unity.render-pipelines.core, Common.hlsl; three.js, packing.glsl.js",
     .of = from_near, .unbounded = true, .eye = eye_from_near, .planes = JUDGE_PLANES_RATIO, .line = from_near_line},
    {.name = "reciprocal of eye depth", .formula = "1/z", .called = {"inverse depth, disparity"},
     .source = "Civera et al., Inverse depth parametrization for monocular SLAM, 2008",
     .of = reciprocal, .eye = over, .planes = JUDGE_PLANES_BOTH, .line = reciprocal_line},
    {.name = "window depth", .formula = "d",
     .called = {"gl_FragCoord.z, SV_Position.z, viewZToPerspectiveDepth of three.js",
                "gl_FragCoord.z, SV_Position.z, viewZToOrthographicDepth of three.js",
                "gl_FragDepth, SV_Depth, viewZToLogarithmicDepth of three.js"},
     .source = "GLSL 4.60, 7.1.5; three.js, packing.glsl.js",
     .of = window, .window = itself},
    {.name = "1 minus window depth", .formula = "1 - d", .called = {"depth of the other direction"},
     .source = "Reed, Depth precision visualized, 2015",
     .of = complement,
     .of_windows = true},
    {.name = "window depth without the logarithm", .formula = "far (z - near)/((far - near) z)",
     .called = {"czm_reverseLogDepth of CesiumJS"}, .source = "CesiumJS, reverseLogDepth.glsl",
     .of = of_matrix},
    {.name = "NDC depth", .formula = "2 d - 1", .called = {"clip z over clip w"},
     .source = "OpenGL 4.6, Coordinate Transformations",
     .of = ndc, .window = of_ndc},
    {.name = "code", .formula = "d in codes of the format",
     .called = {"what the buffer holds, as an unsigned integer"},
     .source = "Vulkan 1.3, Fixed-Point Data Conversions",
     .of = code, .whole = true},
};
/* clang-format on */

const judge_output *judge_output_get(size_t index) {
    return index < sizeof outputs / sizeof outputs[0] ? &outputs[index] : NULL;
}
