/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file zfight_triangles.h  zfight --rasterize: pairs of slanted planes, drawn by the model of a rasterizer. */
#ifndef ZFIGHT_CMD_ZFIGHT_ZFIGHT_TRIANGLES_H
#define ZFIGHT_CMD_ZFIGHT_ZFIGHT_TRIANGLES_H

#include "zfight/cmd_zfight/request.h"

/** @return an exit status, after one line on stderr where it is not fine */
int zfight_triangles(const zfight_request *o);

#endif
