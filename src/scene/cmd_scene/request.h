/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request about a model, of scene and of its figure. */
#ifndef SCENE_CMD_SCENE_REQUEST_H
#define SCENE_CMD_SCENE_REQUEST_H

#include "bias/cmd_bias/request.h"
#include "cli/output/output.h"

typedef struct scene_asked {
    double eye[3], look[3]; /**< places: of an eye, and what it looks at */
    const char *path;       /**< file of eyes; or null */
    const char *camera;     /**< of the model, by name; or null */
    double separation;      /**< scene units; 0 also when not given */
    double angle;           /**< between the planes of surfaces, degrees */
    double within;          /**< eye depth; 0 when not given */
    unsigned transforms;    /**< of a model's nodes: a model_transforms */
    unsigned filters_off;   /**< of a model's pairs: 1 << finder_filter, or-ed */
    const char *render;     /**< file of a picture; null when not given */
    const char *emit_need;  /**< file of requirements; null when not given */
} scene_asked;

/** Whence it is seen; and the rest. */
extern const option_table scene_eye_options, scene_options;

/** The options that a figure of a model takes. */
extern const option_use scene_model[];
#define SCENE_ANGLE "judge surfaces whose planes meet at no more than this angle"

typedef struct scene_request {
    CAMERA_REQUEST;
    scene_asked scene;
    bias_asked bias;
} scene_request;

/** Whether the model is seen from an eye. */
static inline bool scene_is_seen(const asked_line *line) {
    return option_given(line, "eye") || option_given(line, "path") || option_given(line, "camera");
}

#endif
