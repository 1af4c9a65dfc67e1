/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file code.h  Code to take away: a method's row in a language, with its constants and its bound for a camera. */
#ifndef CODE_CODE_H
#define CODE_CODE_H

#include "code/write.h"
#include "method/method.h"
#include "report/output.h"
#include "shader/camera.h"

/** Why a language has no function for a row at a camera, "needs a finite far plane"; or null. */
const char *code_lacks(const code_language *l, const method_row *row, const dp_setup *setup);

/** The row of linearize or encode with the least bound in a language; null where it has none. */
const method_row *code_best(const code_language *l, const method_family_row *family, const dp_setup *setup);

/** The bound of a row in a language: of linearize relative, INFINITY where the divisor may come to 0; of encode in
 * steps of the format, NaN where none is known. */
double code_bound(const code_language *l, const method_row *row, const dp_setup *setup);

/** Eye depth, or code, of a window depth. With `uniforms` the constants are parameters. */
void code_function(output *out, const code_language *l, const method_row *row, const dp_setup *setup, bool uniforms);

/** The same, and two functions that take a pixel and its eye depth to its place in view space; a camera whose frustum
 * is centred. And how far it is off, of its distance. */
void code_places(output *out, const code_language *l, const method_row *row, const texture_camera *camera,
                 bool uniforms);
double code_place_bound(const code_language *l, const method_row *row, const dp_setup *setup);

/** The projection matrix, column vectors, of a camera that looks along -z; what it is cleared to and compared by. */
void code_projection(output *out, const code_language *l, const texture_camera *camera);

#endif
