/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file views.h  Cameras, planes and images in memory for the tests of normals, without the rooms under test. */
#ifndef TESTS_VIEWS_H
#define TESTS_VIEWS_H

#include "printed.h"
#include "shader/normal.h"

/** A checked camera; `extent` is the field of view in degrees or half the height. */
texture_camera view_camera(const char *format, dp_mapping mapping, double znear, double zfar, bool ortho,
                           uint32_t width, uint32_t height, double extent);

/** That of a command line, but for its direction: set-up, --fov, --ortho=H and --eye. */
texture_camera view_placed(const char *line, uint32_t width, uint32_t height, double yaw, double pitch);

/** The pixel grid from the definition in camera.h. */
void view_slopes(const texture_camera *c, double column, double row, double *sx, double *sy);

/** Makes a vector one of length 1. */
void view_unit(double v[3]);

/** The eye depth of the plane n . p = d at a pixel. */
double view_plane(const texture_camera *c, const double n[3], double d, double column, double row);

/** A random plane through a pixel at depth z, its unit normal `tilt` away from the direction to the eye. @return d */
double view_tilted(rng *r, const texture_camera *c, double column, double row, double z, double tilt, double n[3]);

/** Eye depths and the normals that a method makes of them. */
typedef struct view_picture {
    uint32_t width, height;
    float *eye;
    float *normal[3];
} view_picture;

view_picture view_picture_of(const texture_camera *c);
void view_picture_free(view_picture *p);

/** Rows `first` to first + count - 1, or all. */
void view_run_rows(const normal_row *m, const texture_camera *c, view_picture *p, uint32_t first, uint32_t count);
void view_run(const normal_row *m, const texture_camera *c, view_picture *p);

/** The normal and the eye depth at a pixel; beyond the border the depth is NaN. */
void view_normal(const view_picture *p, uint32_t column, uint32_t row, double out[3]);
float view_eye(const view_picture *p, int64_t column, int64_t row);

#endif
