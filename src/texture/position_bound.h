/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bounds of the position rows, in units of 2^-24: position_bound() says what they mean, depthprec(7) derives them. */
#ifndef TEXTURE_POSITION_BOUND_H
#define TEXTURE_POSITION_BOUND_H

#include "texture/camera.h"

double matrix_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d);
double rays_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d);
double extents_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d);
double half_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d);
double view_bound(const texture_camera *camera, uint32_t row, uint32_t column, double d);

#endif
