/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What functions of depth take and give: rows. */
#include <math.h>

#include "judge/judge.h"

/* ---- What goes in ------------------------------------------------------------------------------------------------ */

static double itself(double x) {
    return x;
}

static double of_ndc(double x) {
    return 0.5 + 0.5 * x;
}

static double eye_of(const dp_setup *s, double d, double q) {
    const double z = dp_eye(s, d, q);
    return s->curve == DP_CURVE_PERSPECTIVE && !(z > 0) ? (double)INFINITY : z;
}

static double eye_of_window(const dp_setup *s, double x) {
    return eye_of(s, x, 1 - x);
}

static double eye_of_ndc(const dp_setup *s, double x) {
    return dp_mapping_get(s->spec.mapping)->ndc_signed ? eye_of(s, 0.5 + 0.5 * x, 0.5 - 0.5 * x) : (double)NAN;
}

static double eye_of_code(const dp_setup *s, double x) {
    if (!(x >= 0 && x <= s->spec.format.code_max && x == floor(x)))
        return (double)NAN;
    return eye_of_window(s, dp_format_value(&s->spec.format, (uint32_t)x));
}

static double eye_of_eye(const dp_setup *s, double x) {
    (void)s;
    return x;
}

static double eye_of_view(const dp_setup *s, double x) {
    (void)s;
    return -x;
}

static const judge_input inputs[] = {
    [JUDGE_WINDOW] = {"window depth", eye_of_window, itself, 0},
    [JUDGE_NDC] = {"NDC depth", eye_of_ndc, of_ndc, 0},
    [JUDGE_CODES] = {"codes", eye_of_code, NULL, 0},
    [JUDGE_EYE] = {"eye depth", eye_of_eye, NULL, 1},
    [JUDGE_VIEW] = {"minus eye depth", eye_of_view, NULL, -1},
};

const judge_input *judge_input_get(size_t index) {
    return index < sizeof inputs / sizeof inputs[0] ? &inputs[index] : NULL;
}

/* ---- What comes out ---------------------------------------------------------------------------------------------- */

static double eye(const dp_setup *s, double z) {
    (void)s;
    return z;
}

static double behind(const dp_setup *s, double z) {
    (void)s;
    return -z;
}

static double over_far(const dp_setup *s, double z) {
    return isinf(s->spec.zfar) ? (double)NAN : z / s->spec.zfar;
}

static double from_near(const dp_setup *s, double z) {
    return isinf(s->spec.zfar) ? (double)NAN : (z - s->spec.znear) / (s->spec.zfar - s->spec.znear);
}

static double eye_over_far(const dp_setup *s, double v) {
    return v * s->spec.zfar;
}

static double eye_from_near(const dp_setup *s, double v) {
    return s->spec.znear + v * (s->spec.zfar - s->spec.znear);
}

static double reciprocal(const dp_setup *s, double z) {
    (void)s;
    return 1 / z;
}

/* Slightly beyond the planes it goes on as a depth clamp does. */
static double window(const dp_setup *s, double z) {
    return dp_window(s, fmin(fmax(z, s->spec.znear), s->spec.zfar));
}

static double complement(const dp_setup *s, double z) {
    return 1 - window(s, z);
}

static double ndc(const dp_setup *s, double z) {
    return dp_mapping_get(s->spec.mapping)->ndc_signed ? 2 * window(s, z) - 1 : (double)NAN;
}

/* What the matrix of a logarithmic depth gives. */
static double of_matrix(const dp_setup *s, double z) {
    const double n = s->spec.znear, f = s->spec.zfar;
    return s->curve != DP_CURVE_LOG ? (double)NAN : isinf(f) ? 1 - n / z : f * (z - n) / ((f - n) * z);
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
    {.name = "eye depth", .formula = "z", .called = "LinearEyeDepth of Unity, ConvertFromDeviceZ of Unreal",
     .source = "com.unity.render-pipelines.core, Common.hlsl; Unreal Engine, Common.ush",
     .of = eye, .eye = eye, .planes = JUDGE_PLANES_BOTH, .line = eye_line},
    {.name = "minus eye depth", .formula = "-z",
     .called = "perspectiveDepthToViewZ of three.js: view z of a camera that looks along -z",
     .source = "three.js, packing.glsl.js",
     .of = behind, .eye = behind, .planes = JUDGE_PLANES_BOTH, .line = behind_line},
    {.name = "eye depth over far", .formula = "z/far", .called = "Linear01Depth of Unity",
     .source = "com.unity.render-pipelines.core, Common.hlsl",
     .of = over_far, .eye = eye_over_far, .planes = JUDGE_PLANES_RATIO, .line = eye_line},
    {.name = "the way from near to far", .formula = "(z - near)/(far - near)",
     .called = "Linear01DepthFromNear of Unity, viewZToOrthographicDepth of three.js",
     .source = "com.unity.render-pipelines.core, Common.hlsl; three.js, packing.glsl.js",
     .of = from_near, .eye = eye_from_near, .planes = JUDGE_PLANES_RATIO, .line = from_near_line},
    {.name = "reciprocal of eye depth", .formula = "1/z", .called = "inverse depth, disparity",
     .source = "Civera et al., Inverse depth parametrization for monocular SLAM, 2008",
     .of = reciprocal, .eye = reciprocal, .planes = JUDGE_PLANES_BOTH, .line = reciprocal_line},
    {.name = "window depth", .formula = "d",
     .called = "gl_FragCoord.z, SV_Position.z, viewZToPerspectiveDepth of three.js",
     .source = "GLSL 4.60, 7.1.5; three.js, packing.glsl.js",
     .of = window, .window = itself},
    {.name = "1 minus window depth", .formula = "1 - d", .called = "depth of the other direction",
     .source = "Reed, Depth precision visualized, 2015",
     .of = complement,
     .of_windows = true},
    {.name = "window depth without the logarithm", .formula = "far (z - near)/((far - near) z)",
     .called = "czm_reverseLogDepth of CesiumJS", .source = "CesiumJS, reverseLogDepth.glsl",
     .of = of_matrix},
    {.name = "NDC depth", .formula = "2 d - 1", .called = "clip z over clip w",
     .source = "OpenGL 4.6, Coordinate Transformations",
     .of = ndc, .window = of_ndc},
};
/* clang-format on */

const judge_output *judge_output_get(size_t index) {
    return index < sizeof outputs / sizeof outputs[0] ? &outputs[index] : NULL;
}
