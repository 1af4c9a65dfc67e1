/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file request.h  How a figure looks, and what is drawn in it. */
#ifndef PLOT_CMD_REQUEST_H
#define PLOT_CMD_REQUEST_H

#include "cli/option/option.h"

typedef struct figure_asked {
    unsigned type;      /**< a canvas_format, where the name of a file does not say it */
    unsigned theme;     /**< index of theme_get() */
    int width, height;  /**< px; 0 when not given, so that each figure has its own default */
    const char *title;  /**< null when not given, */
    const char *beside; /**< as is this */
    double axes[4];     /**< the ends of x and those of y, where given */
} figure_asked;

extern const option_table figure_options;

/** The options that a picture of any kind takes. */
extern const option_use figure_picture[];

#endif
