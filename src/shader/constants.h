/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file constants.h  What a shader is given of a camera, what it makes of a depth, and formulas that are nearly right.
 */
#ifndef SHADER_CONSTANTS_H
#define SHADER_CONSTANTS_H

#include "core/named.h"
#include "shader/camera.h"
#include "shader/decode.h"

/** Unity's, in binary32 as the shader sees them; what an infinite far plane makes infinite is. */
typedef struct shader_constants {
    zbuffer_params zbuffer; /**< _ZBufferParams */
    struct {
        float flip, znear, zfar, per_far;
    } projection;    /**< _ProjectionParams; flip: 1, -1 in a flipped target */
    float near_clip; /**< UNITY_NEAR_CLIP_VALUE: NDC depth of the near plane */
} shader_constants;

shader_constants shader_constants_of(const dp_setup *setup);

/** A constant or function by the name that shaders have for it. */
typedef struct constant_row {
    NAMED_FIELDS; /**< the note is the formula */
} constant_row;

NAMED_ROWS(constant_row, constant);

/** A depth on its way into the buffer and back, each in binary32. */
typedef struct shader_depth {
    float clip_z, clip_w, ndc, window;
    float eye;                 /**< LinearEyeDepth, orthographic LinearDepthToEyeDepth */
    float linear01, from_near; /**< Linear01Depth, Linear01DepthFromNear; NaN where they are not defined */
} shader_depth;

/** @return false for a mapping without a matrix */
bool shader_depth_of(const dp_setup *setup, double z, shader_depth *out);

/** A window depth in a depth texture of that format, and LinearEyeDepth of it, orthographic LinearDepthToEyeDepth. */
float shader_stored_eye(const dp_setup *setup, const dp_format *format, float window);

/** Eye depth as DepthNormals holds it, by EncodeFloatRG: 0 at the far plane, whose frac is that of the camera. NaN
 * without a far plane. */
float shader_depth_normals_eye(const dp_setup *setup, double z);

/** The frustum's corners in view space: top left, top right, bottom left, bottom right. */
typedef struct shader_corners {
    double ray[4][3];        /**< at eye depth 1, by which a depth is multiplied; orthographic: at near */
    double to_right, to_top; /**< half the width and half the height of the near plane */
} shader_corners;

shader_corners shader_corners_of(const texture_camera *camera);

/** A depth between the planes: z, and without cancellation what lies in front of it and what is left behind it. */
typedef struct trap_depth {
    double z, behind, left; /**< z, z - near, far - z */
    double half;
} trap_depth;

/** A formula that is found in articles and shaders, and is not right: what it reads is an eye depth. */
typedef struct trap_row {
    NAMED_FIELDS;                   /**< the note is the formula, */
    const char *right;              /**< and this is what is right */
    bool standard, reversed, ortho; /**< which set-ups it is a trap of */
    bool ndc_signed, far_infinite;  /**< of OpenGL's NDC alone; of an infinite far plane, too */
    bool coarse;                    /**< reads few depths: of values that are rounded, too, it may seem to be right */
    double (*reads)(const dp_setup *setup, const trap_depth *at); /**< null of a formula of a normal */
    /** By how many degrees a formula of normals turns one, `off` degrees off the view axis, half way between two
     * vertices whose normals are `apart` degrees apart; null of a formula of depth. */
    double (*turns)(double off, double apart);
    /** The eye depth whose right window depth the formula writes for one at z; null: it reads depths alone. */
    double (*writes)(const dp_setup *setup, const trap_depth *at);
} trap_row;

NAMED_ROWS(trap_row, trap);

/** The depth that the trap reads of a surface at z, within 2^-40, but where 4 bits round to a neighbour; NaN where it
 * is no trap of the set-up. Between the planes, near above 0; `half` is the tangent of half the vertical field of view,
 * INFINITY what has no depth left. */
double trap_reads(const trap_row *row, const dp_setup *setup, double half, double z);
/** The same of a depth that is known better than by z. */
double trap_reads_at(const trap_row *row, const dp_setup *setup, const trap_depth *at);
/** The depth that it writes one at z for; NaN where it is no trap of the set-up, and where it writes none. */
double trap_writes_at(const trap_row *row, const dp_setup *setup, const trap_depth *at);

#endif
