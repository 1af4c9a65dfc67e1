/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file option_texture.h  The parsers of the options of texture, for the option table. */
#ifndef CLI_OPTION_TEXTURE_H
#define CLI_OPTION_TEXTURE_H

#include "cli/options.h"

/* Each reads the argument of its option. EXIT_FINE, or EXIT_USAGE after one line on stderr. */
int parse_fov(options *o, const char *value);
int parse_half_height(options *o, const char *value);
int parse_yaw(options *o, const char *value);
int parse_pitch(options *o, const char *value);
int parse_origin(options *o, const char *value);
int parse_scene(options *o, const char *value);
int parse_size(options *o, const char *value);
int parse_parameter(options *o, const char *value);
int parse_sky(options *o, const char *value);
int parse_metric(options *o, const char *value);
int parse_eye(options *o, const char *value);
int parse_radial(options *o, const char *value);
int parse_position(options *o, const char *value);
int parse_normal(options *o, const char *value);
int parse_effect(options *o, const char *value);
int parse_error_map(options *o, const char *value);
int parse_figure(options *o, const char *value);

#endif
