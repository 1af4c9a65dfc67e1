/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file code.h  Code to take away: a method's row in a language, with its constants and its bound for a camera. */
#ifndef CODE_CODE_H
#define CODE_CODE_H

#include "code/write.h"
#include "method/method.h"
#include "report/output.h"
#include "shader/camera.h"
#include "shader/packing.h"

/** The claim of a function that has been written: it is off by at most `bound`, of what it gives or in what is
 * named, and by `nearest` where all operations are rounded to nearest; NaN or INFINITY where nothing is. */
typedef struct code_claim {
    const char *function;
    double bound, nearest;
    const char *of;
} code_claim;

typedef struct code_said {
    code_claim claims[2];
    size_t count;
} code_said;

/** Why a language has no function for a row at a camera, "needs a finite far plane"; or null. Depth ranges are of
 * perspective cameras, and not of scripts. */
const char *code_lacks(const code_language *l, const method_row *row, const dp_setup *setup);

/** The ways from window depth to code that round so: of nearest the family of methods. */
const method_family_row *code_encoders(dp_rounding rounding);

/** The row of linearize or encode with the least bound in a language; null where it has none. */
const method_row *code_best(const code_language *l, const method_family_row *family, const dp_setup *setup);

/** The bound of a row in a language: of linearize relative, INFINITY where the divisor may come to 0; of encode in
 * steps of the format, NaN where none is known. */
double code_bound(const code_language *l, const method_row *row, const dp_setup *setup);

/** Eye depth, or code, of a window depth. With `uniforms` the constants are parameters. */
code_said code_function(output *out, const code_language *l, const method_row *row, const dp_setup *setup,
                        bool uniforms);

/** The same, without a row that of code_curve(), and two functions that take a pixel and its eye depth to its place in
 * view space; a camera whose frustum is centred. And how far it is off, of its distance. */
code_said code_places(output *out, const code_language *l, const method_row *row, const texture_camera *camera,
                      bool uniforms);
double code_place_bound(const code_language *l, const method_row *row, const dp_setup *setup);

/** The projection matrix, column vectors, of a camera that looks along -z; what it is cleared to and compared by. */
code_said code_projection(output *out, const code_language *l, const texture_camera *camera);

/** Eye depth of a window depth that is linear or logarithmic, or `there`: the window depth that a shader writes. The
 * bounds are in scene units of linear depth, of z + 1/C of logarithmic, of the depth where the logarithm is that of
 * z/n; there of the range from 0 to 1; NaN where the language promises nothing. */
code_said code_curve(output *out, const code_language *l, const dp_setup *setup, bool there, bool uniforms);
double code_curve_back(const dp_setup *setup, const bound_arithmetic *how);
double code_curve_there(const dp_setup *setup, const bound_arithmetic *how);

/** A depth of the channels of a packing, and those channels of a depth; the bounds, in steps and of the depth. */
code_said code_packing(output *out, const code_language *l, const packing *p);
double code_pack_bound(const packing *p, const bound_arithmetic *how);
double code_unpack_bound(const packing *p, const bound_arithmetic *how);

/** The same of a normal: degrees between what goes in and what comes back. */
code_said code_normal(output *out, const code_language *l, const pack_row *row);
double code_normal_bound(const pack_row *row, const bound_arithmetic *how);

#endif
