/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file scene_made.h  Models made in a test, triangle by triangle. */
#ifndef TESTS_SCENE_MADE_H
#define TESTS_SCENE_MADE_H

#include <stddef.h>
#include <stdint.h>

#include "model/model.h"

enum { SCENE_MADE = 8192 };

typedef struct scene_made {
    double position[3 * SCENE_MADE][3];
    uint32_t triangle[SCENE_MADE][3];
    uint32_t of[SCENE_MADE];
    model_surface surface[SCENE_MADE];
    model m; /**< points into the arrays */
} scene_made;

/** Empties it. */
void scene_made_begin(scene_made *made);
/** Triangles added from here on are of a new surface: its number. */
uint32_t scene_made_surface(scene_made *made, const char *node, const char *material);
void scene_made_triangle(scene_made *made, const double a[3], const double b[3], const double c[3]);
/** Two triangles, a parallelogram: at, at + u, at + u + v, at + v. */
void scene_made_quad(scene_made *made, const double at[3], const double u[3], const double v[3]);
/** Twelve triangles that face outward. */
void scene_made_box(scene_made *made, const double lo[3], const double hi[3]);

#endif
