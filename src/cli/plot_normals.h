/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file plot_normals.h  What the figure normals asks for: methods measured on a plane and on a sphere at a depth. */
#ifndef CLI_PLOT_NORMALS_H
#define CLI_PLOT_NORMALS_H

#include "plot/figure.h"

extern const figure_normals plot_normals;

/** What holds for all of it, appended to a subtitle. */
const char *plot_normals_view(bool ortho);

#endif
