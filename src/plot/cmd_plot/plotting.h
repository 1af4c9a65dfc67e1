/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file plotting.h  The figure that plot is asked for: options and operands made set-ups, methods, a model or maps. */
#ifndef PLOT_CMD_PLOT_PLOTTING_H
#define PLOT_CMD_PLOT_PLOTTING_H

#include "camera/cmd/setups.h"
#include "method/cmd_methods/methods.h"
#include "method/cmd_methods/mine.h"
#include "plot/cmd_plot/request.h"
#include "plot/figure.h"
#include "scene/cmd_scene/drawing.h"
#include "shadow/cmd_shadow/maps.h"
#include "solve/requirement.h"

typedef struct plotting {
    const plot_request *o;
    const figure_row *row;
    figure_request request;
    setups all;
    const char *names[CHART_SETUPS];
    char text[CHART_SETUPS][SETUP_LABEL_SIZE];
    methods_asked asked;
    char where[2 * SHADER_TEXT_SIZE]; /* of what is timed */
    judge_request judge;              /* what their methods, */
    scene_request scene;              /* a model, */
    shadow_request shadow;            /* and shadow maps are asked */
    mine *mine;                       /* null: none is given */
    need_file file;
    shadow_maps maps;
    scene model;
    fights_asked fights;
    chart *chart;
    struct plotting *beside; /* another camera's curves in the same figure; else null */
} plotting;

/** With an empty chart, null when out of memory; nothing of it is resolved. */
plotting plotting_of(const plot_request *o);

/** Refuses far planes and files that the figure has no use for. @return an exit status, as all here do */
int plotting_check(const plotting *p);

/** Fills in what the figure shows. */
int plotting_resolve(plotting *p);

/** Makes *q of the options of --beside, which are `text` and are cut up, and p->beside of that. @param line  released
 * by the caller, in any case */
int plotting_beside(plotting *p, char *text, asked_line *line, plotting *q);

#endif
