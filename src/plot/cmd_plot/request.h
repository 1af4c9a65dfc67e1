/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  The request of plot: about a camera, a model, shadow maps or methods. */
#ifndef PLOT_CMD_PLOT_REQUEST_H
#define PLOT_CMD_PLOT_REQUEST_H

#include "cli/output/output.h"
#include "judge/cmd_judge/request.h"
#include "plot/cmd/request.h"
#include "scene/cmd_scene/request.h"
#include "shadow/cmd_shadow/request.h"
#include "world/cmd/origin.h"

typedef struct plot_request {
    CAMERA_REQUEST;
    figure_asked figure;
    origin_asked origin;
    shadow_asked shadow; /**< its angle is the model's, too, and its from-origin that of `origin` */
    scene_asked scene;
    judge_asked judge;
    bias_asked bias; /**< as it is where nothing is said */
} plot_request;

#endif
