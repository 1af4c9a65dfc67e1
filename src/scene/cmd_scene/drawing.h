/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file drawing.h  From what scene finds to the figure of it. */
#ifndef SCENE_CMD_SCENE_DRAWING_H
#define SCENE_CMD_SCENE_DRAWING_H

#include "draw/chart.h"
#include "scene/cmd_scene/scene.h"
#include "scene/figure.h"

/** As scene_begin(), of the figure's options. */
int scene_figure_begin(scene *s, const scene_request *o);

/** The data of the figure, and the chart's subtitle and unit. @return false when out of memory */
bool scene_figure_take(const scene *s, fights_asked *out, chart *c);

/** The height that suits the views of a chart at a width, px. */
int scene_figure_height(const chart *c, int width);

#endif
