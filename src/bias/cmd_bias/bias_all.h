/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file bias_all.h  The bias that is needed, in the terms of every API. */
#ifndef BIAS_CMD_BIAS_BIAS_ALL_H
#define BIAS_CMD_BIAS_BIAS_ALL_H

#include "bias/cmd_bias/request.h"

enum { BIAS_CALL_SIZE = 128 };

/** The call that sets a bias, "glPolygonOffset(0, -1528)". Lives until the statement ends. */
typedef struct bias_call_text {
    char text[BIAS_CALL_SIZE];
} bias_call_text;

bias_call_text bias_call(const bias_api *api, double units, double factor);

/** The units of bias_needed(), with the sign that brings a layer nearer; NaN where none are enough. */
double bias_signed(const dp_setup *setup, double units);

/** With a viewport: the surfaces that are told apart, in text. */
#define BIAS_DRAWN_TWICE "resolved: one plane drawn as different triangles, each at least a pixel high"

/** Where the least factor that is enough at any slant is INFINITY. */
#define BIAS_NO_FACTOR "at any slant no factor suffices; --slope says how steep surfaces are"

/** Where a fragment shader writes the depth: the bias went to the interpolated one, which that replaces. */
#define BIAS_MISSED "no API biases a depth that a fragment shader writes: add units times r there"

/** Whether it may: an orthographic depth is interpolated, and so is the clip z that osgearth's vertices have. */
static inline bool bias_is_missed(const dp_setup *setup) {
    return setup->curve != DP_CURVE_PERSPECTIVE && !setup->spec.ortho &&
           !dp_mapping_get(setup->spec.mapping)->ndc_signed;
}

/** Whether each set-up's factor is the least that is enough at any slant: a viewport, and neither factor nor slope. */
static inline bool bias_chooses_factor(const bias_request *o) {
    return o->camera.triangles.width > 0 && !option_given(o->line, "factor") && !option_given(o->line, "slope");
}

/** The measured r of an API in that format on the GPU of a profile: a sentence, "" where none was. @return
 * out */
const char *bias_of_gpu(const bias_request *o, const bias_api *api, const dp_format *format, char out[BIAS_CALL_SIZE]);

/** Refuses what no bias can be about: a viewport with a mapping that is not affine. @return an exit status */
int bias_check_slant(const bias_request *o);

/** Writes it for the depths of --at, or the range. @return an exit status */
int bias_all_write(const bias_request *o);

#endif
