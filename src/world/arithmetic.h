/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steps of each row of world.c, in binary32. */
#ifndef WORLD_ARITHMETIC_H
#define WORLD_ARITHMETIC_H

#include "world/world.h"

/* An offset in a cell is up to half an edge and a twentieth of it, before the mesh moves to the next cell. */
#define WORLD_CELL_MOST 0.55

typedef void world_arithmetic(const world_scheme *s, const world_camera *camera, const world_place *place,
                              float out[3]);

world_arithmetic arithmetic_world, arithmetic_local, arithmetic_camera_float, arithmetic_camera_double,
    arithmetic_split, arithmetic_tile, arithmetic_two_sum, arithmetic_cell;

#endif
