/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file texture_source.h  What texture works on: the image or scene, its format and mapping, the camera. */
#ifndef CLI_TEXTURE_SOURCE_H
#define CLI_TEXTURE_SOURCE_H

#include "cli/options.h"
#include "texture/frame.h"
#include "texture/recognise.h"

/** How a name came about. */
typedef enum texture_origin { ORIGIN_GIVEN = 0, ORIGIN_FOUND, ORIGIN_ASSUMED } texture_origin;

typedef struct texture_source {
    const char *path; /**< null for a scene */
    image picture;
    recognised found;
    texture_origin format_from, mapping_from;
    double parameters[SCENE_PARAMETERS];
    dp_setup setup;
    texture_camera camera;
    frame frame; /**< points into this struct, which must stay where it is */
} texture_source;

/** "given", "found", "assumed". */
const char *texture_origin_name(texture_origin origin);

/** Reads the image or prepares the scene. @return an exit status, after one line on stderr */
int texture_source_open(const options *o, texture_source *out);
void texture_source_close(texture_source *s);

/** Does the scene of --scene have a parameter of this name? Then parameters not taken are the effect's. */
bool texture_scene_takes(const options *o, const char *name);

#endif
