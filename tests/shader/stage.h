/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file stage.h  A small picture of 16-bit depths, and effects over it: for the tests that look at pixels around. */
#ifndef TESTS_STAGE_H
#define TESTS_STAGE_H

#include "named.h"
#include "support.h"
#include "texture/frame.h"

enum { ACROSS = 23, DOWN = 17, PIXELS = ACROSS * DOWN, CODE_MAX = 65535 };

#define STAGE_NEAR 1.0
#define STAGE_FAR  100.0

typedef struct stage {
    dp_setup setup;
    texture_camera camera;
    uint32_t codes[PIXELS];
    image image;
    frame frame;
} stage;

/** The eye depth of a code, which may lie between two; and the nearest code. */
double eye_of(double code);
uint32_t code_of(double z);

/** x/z and y/z of a pixel. */
void stage_slopes(int pixel, double out[2]);

/** A field of view of 60 degrees, standard depth, codes that are 0. */
void stage_make(stage *s);
/** A few depths side by side, sky among them, and a hole. */
void stage_draw(rng *r, stage *s);

/** The output, or its error map. */
void stage_effect(const stage *s, const char *effect, const double *at, double reference, bool error,
                  float out[PIXELS]);
void stage_set(const char *effect, double *at, const char *name, double value);

/** The pixel a few columns and rows away; the outermost go on beyond the border. */
int beside(int pixel, int columns, int rows);
void corners_of(int pixel, int away, int out[4]);

#endif
