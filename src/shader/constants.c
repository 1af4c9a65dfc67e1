/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shader/constants.h"

#include <math.h>
#include <string.h>

#include "core/elementary.h"
#include "depthprec/pipeline.h"
#include "shader/packing.h"

shader_constants shader_constants_of(const dp_setup *setup) {
    const double n = setup->spec.znear, f = setup->spec.zfar;
    const bool ndc_signed = dp_mapping_get(setup->spec.mapping)->ndc_signed;
    return (shader_constants){.zbuffer = zbuffer_params_of(setup),
                              .projection = {1, (float)n, (float)f, (float)(1 / f)},
                              .near_clip = setup->reversed ? 1.0f
                                           : ndc_signed    ? -1.0f
                                                           : 0.0f};
}

static const char unity[] = "UnityShaderVariables.cginc", common[] = "the Core package's Common.hlsl";

/* clang-format off */
static const constant_row constants[] = {
    {"_ZBufferParams", NULL, "(1 - far/near, far/near, x/far, y/far); reversed (far/near - 1, 1, x/far, 1/far)",
     unity},
    {"_ProjectionParams", NULL, "(1, or -1 where the target is flipped; near; far; 1/far)", unity},
    {"UNITY_NEAR_CLIP_VALUE", NULL, "NDC depth of the near plane: 0, of OpenGL -1, reversed 1",
     "the Core package's API headers"},
    {"LinearEyeDepth", NULL, "1/(z d + w) of _ZBufferParams: eye depth in perspective", common},
    {"Linear01Depth", NULL, "1/(x d + y): eye depth over far, 0 at the camera", common},
    {"Linear01DepthFromNear", NULL, "d/(x d + y), reversed (1 - d)/(x d + y): 0 at near, 1 at far", common},
    {"LinearDepthToEyeDepth", NULL, "near + (far - near) d, reversed far - (far - near) d: orthographic eye depth",
     common},
};
/* clang-format on */

NAMED_TABLE(constant, constants);

static float decoded(const dp_setup *setup, const decode_row *row, float d) {
    float out = NAN;
    if (decode_applies(row, setup))
        decode_run(row, setup, &d, &out, 1);
    return out;
}

bool shader_depth_of(const dp_setup *setup, double z, shader_depth *out) {
    dp_pipeline p;
    if (dp_pipeline_init(&p, setup) != DP_OK)
        return false;
    const float at = (float)z, w = p.ortho ? 1.0f : at, clip = dp_pipeline_clip(&p, at);
    const float window = fminf(fmaxf(dp_pipeline_window(&p, at), 0), 1); /* as the viewport clamps it */
    *out = (shader_depth){.clip_z = clip,
                          .clip_w = w,
                          .ndc = clip / w,
                          .window = window,
                          .eye = decoded(setup, decode_usual(setup), window),
                          .linear01 = decoded(setup, &decode_rows[DECODE_LINEAR_01], window),
                          .from_near = decoded(setup, &decode_rows[DECODE_LINEAR_01_NEAR], window)};
    return true;
}

float shader_stored_eye(const dp_setup *setup, const dp_format *format, float window) {
    const uint32_t code = dp_format_encode(format, DP_ROUND_NEAREST, (double)window);
    return decoded(setup, decode_usual(setup), (float)dp_format_value(format, code));
}

float shader_depth_normals_eye(const dp_setup *setup, double z) {
    const float far = (float)setup->spec.zfar, share = (float)z * (float)(1 / setup->spec.zfar);
    const packing *rg = packing_find("rg");
    const uint64_t number = share < 1 || !rg->wraps ? packing_nearest(rg, (double)share) : 0;
    return isinf(far) ? NAN : (float)packing_depth(rg, number) * far;
}

shader_corners shader_corners_of(const texture_camera *c) {
    const double n = c->setup.spec.znear, scale = c->ortho ? 1 : n;
    shader_corners out = {.to_right = c->half[0] * scale, .to_top = c->half[1] * scale};
    for (int i = 0; i < 4; i++) {
        out.ray[i][0] = ((i % 2 == 0 ? -1 : 1) - c->centre[0]) * c->half[0];
        out.ray[i][1] = ((i < 2 ? 1 : -1) - c->centre[1]) * c->half[1];
        out.ray[i][2] = c->ortho ? n : 1;
    }
    return out;
}

/* ---- Traps ------------------------------------------------------------------------------------------------------- */

/* 1/((1 - n/f) d + f/n) f with d = f (z - n)/((f - n) z): the first product is (z - n)/z. */
static double inverted_x(const dp_setup *s, const trap_depth *at) {
    const double n = s->spec.znear, f = s->spec.zfar;
    return f / (at->behind / at->z + f / n);
}

static double doubled_product(const dp_setup *s, const trap_depth *at) {
    (void)s;
    return 2 * at->z;
}

/* The formula writes 2 n where n is right, all as of half the depth. */
static double halved(const dp_setup *s, const trap_depth *at) {
    (void)s;
    return at->z / 2;
}

/* The code of 4 bits: which is nearest to d is told from d = f (z - n)/((f - n) z), or from 1 - d of a reversed one. */
static double in_four_bits(const dp_setup *s, const trap_depth *at) {
    enum { MOST = 15 };
    const double n = s->spec.znear, f = s->spec.zfar;
    const double standard = at->behind / at->z * (isinf(f) ? 1 : f / (f - n));
    const double code = floor((s->reversed ? 1 - standard : standard) * MOST + 0.5) / MOST;
    const double share = s->reversed ? 1 - code : code; /* of the way from 1/n to 1/f */
    return 1 / ((1 - share) / n + share / f);
}

/* n + f v with v = (z - n)/(f - n). */
static double shrunk_by_far(const dp_setup *s, const trap_depth *at) {
    const double n = s->spec.znear, f = s->spec.zfar;
    return n + f * at->behind / (f - n);
}

/* 1/z is linear in d, and 2 d - 1 is as far before d as d is before 1: 2/z - 1/f. */
static double ndc_as_depth(const dp_setup *s, const trap_depth *at) {
    return 1 / (2 / at->z - 1 / s->spec.zfar);
}

static double other_direction(const dp_setup *s, const trap_depth *at) {
    const double n = s->spec.znear, f = s->spec.zfar;
    return 1 / (at->behind / (n * at->z) + 1 / f);
}

/* 1/z is 1/n at near and 1/f at far; depth is as far from both. */
static double perspective_of_ortho(const dp_setup *s, const trap_depth *at) {
    const double n = s->spec.znear, f = s->spec.zfar;
    return (f - n) / (at->left / n + at->behind / f);
}

static double linear_of_perspective(const dp_setup *s, const trap_depth *at) {
    return s->spec.znear + s->spec.zfar * at->behind / at->z;
}

/* x + y/255 of the stereographic normal (1/2, 1/2) of what faces the camera. */
static double normal_as_depth(const dp_setup *s, const trap_depth *at) {
    (void)at;
    return 128.0 / 255 * s->spec.zfar;
}

/* A near plane at 45 degrees through where the axis meets near, and a far plane through the frustum's farthest corner,
 * as Lengyel clips: in the middle of the picture d = (z - n)/z / (1 - n/f + half). */
static double perspective_of_oblique(const dp_setup *s, const trap_depth *at) {
    const double n = s->spec.znear, f = s->spec.zfar, d = at->behind / (at->z * (1 - n / f + at->half));
    return 1 / ((1 - d) / n + d / f);
}

/* Half way it is cos(apart/2) long, and EncodeViewNormalStereo divides n.xy by 1 + n.z: the tangent of half the angle.
 */
static double of_short_normal(double off, double apart) {
    const double degree = DP_DEGREE, length = dp_cos(apart / 2 * degree), theta = off * degree;
    return off - 2 * dp_atan(length * dp_sin(theta) / (1 + length * dp_cos(theta))) / degree;
}

static const char slip[] = "an article's slip";

/* clang-format off */
static const trap_row traps[] = {
    {.name = "inverted-x", .note = "_ZBufferParams.x = 1 - near/far", .right = "1 - far/near", .source = slip,
     .standard = true, .reads = inverted_x},
    {.name = "doubled-product", .note = "d = f/(f - n) - 2 f n/((f - n) z)", .right = "f n in place of 2 f n",
     .source = slip, .standard = true, .far_infinite = true, .reads = doubled_product, .writes = halved},
    {.name = "four-bits", .note = "depth uses 4 bits", .right = "4 bytes or less; 4 bits are those of Reed's figures",
     .source = "an article's slip after Reed, Depth precision visualized, 2015", .standard = true, .reversed = true,
     .far_infinite = true, .coarse = true, .reads = in_four_bits},
    {.name = "shrunk-by-far", .note = "near + far Linear01DepthFromNear(d)",
     .right = "near + (far - near) Linear01DepthFromNear(d): from near shrinks by far - near", .source = slip,
     .standard = true, .reversed = true, .reads = shrunk_by_far},
    {.name = "ndc-as-depth", .note = "LinearEyeDepth(lerp(UNITY_NEAR_CLIP_VALUE, 1, d))",
     .right = "LinearEyeDepth(d)",
     .source = "shaders that need NDC for a position, and go on with it", .standard = true, .ndc_signed = true,
     .far_infinite = true, .reads = ndc_as_depth},
    {.name = "other-direction", .note = "LinearEyeDepth(1 - d)", .right = "LinearEyeDepth(d)",
     .source = "constants or a depth of the other direction, UNITY_REVERSED_Z mixed up",
     .standard = true, .reversed = true, .far_infinite = true, .reads = other_direction},
    {.name = "near-is-one", .note = "d = f/(f - n) - f n/((f - n) z), near gives 1, far 0",
     .right = "near gives 0, far 1; reversed, d = n (f - z)/((f - n) z), near gives 1, far 0", .source = slip,
     .standard = true, .far_infinite = true, .reads = other_direction},
    {.name = "perspective-of-ortho", .note = "LinearEyeDepth(d)", .right = "LinearDepthToEyeDepth(d)",
     .source = "Common.hlsl: does not work with orthographic projection", .ortho = true, .reads = perspective_of_ortho},
    {.name = "linear-of-perspective", .note = "near + (far - near) d, reversed far - (far - near) d",
     .right = "LinearEyeDepth(d)", .source = "a raw depth taken for a linear one", .standard = true, .reversed = true,
     .reads = linear_of_perspective},
    {.name = "perspective-of-oblique", .note = "LinearEyeDepth(d), mid-picture, near plane tilted by 45 degrees",
     .right = "the inverse projection matrix", .source = "Common.hlsl: does not handle oblique view frustums",
     .standard = true, .reversed = true, .far_infinite = true, .reads = perspective_of_oblique},
    {.name = "normal-as-depth", .note = "DecodeFloatRG(enc.xy) of DepthNormals, of a surface that faces the camera",
     .right = "enc.zw: the normal is in xy", .source = slip, .standard = true, .reversed = true,
     .reads = normal_as_depth},
    {.name = "unnormalized-normal", .aliases = "interpolated-normal",
     .note = "EncodeViewNormalStereo(normal), interpolated and not normalized", .right = "normalize(normal) first",
     .source = "shaders that write DepthNormals by hand", .turns = of_short_normal},
};
/* clang-format on */

NAMED_TABLE(trap, traps);

/* Whether the formula is wrong in this set-up. */
static bool is_trap_of(const trap_row *row, const dp_setup *setup) {
    const dp_mapping_row *mapping = dp_mapping_get(setup->spec.mapping);
    const bool kind = setup->spec.ortho ? row->ortho : setup->reversed ? row->reversed : row->standard;
    const bool far = !isinf(setup->spec.zfar) || row->far_infinite;
    return kind && far && mapping->curve == DP_CURVE_PERSPECTIVE && setup->spec.znear > 0 &&
           (mapping->ndc_signed || !row->ndc_signed);
}

double trap_reads_at(const trap_row *row, const dp_setup *setup, const trap_depth *at) {
    return row->reads != NULL && is_trap_of(row, setup) ? row->reads(setup, at) : (double)NAN;
}

double trap_writes_at(const trap_row *row, const dp_setup *setup, const trap_depth *at) {
    return row->writes != NULL && is_trap_of(row, setup) ? row->writes(setup, at) : (double)NAN;
}

double trap_reads(const trap_row *row, const dp_setup *setup, double half, double z) {
    return trap_reads_at(row, setup, &(trap_depth){z, z - setup->spec.znear, setup->spec.zfar - z, half});
}
