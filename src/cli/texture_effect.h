/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file texture_effect.h  depthprec texture --effect NAME without an image: a table over depths. */
#ifndef CLI_TEXTURE_EFFECT_H
#define CLI_TEXTURE_EFFECT_H

#include "texture/effect.h"

struct options;

/** The effect that --effect names. @return EXIT_FINE, or EXIT_USAGE after one line on stderr */
int texture_effect_resolve(const struct options *o, const effect_row **row, double parameters[TEXTURE_PARAMETERS]);

/** For each set-up and depth: the error in levels and the usable values of the wanted parameter. @return exit status */
int texture_effect_table(const struct options *o);

#endif
