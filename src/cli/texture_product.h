/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file texture_product.h  What --eye, --position, --normal and --effect make: an image of numbers, or a figure. */
#ifndef CLI_TEXTURE_PRODUCT_H
#define CLI_TEXTURE_PRODUCT_H

#include "cli/texture_source.h"

enum { PRODUCT_NAME_SIZE = 96 };

typedef struct texture_product {
    frame_product made;
    double settings[TEXTURE_PARAMETERS];
    char name[PRODUCT_NAME_SIZE]; /**< "normals by high, error" */
    const char *unit;             /**< "scene units", "degrees", "levels of 1/255", "" */
} texture_product;

/** Is one asked for? */
bool texture_product_wanted(const options *o);

/** Names and combinations, before anything is read. @return an exit status, after one line on stderr */
int texture_product_resolve(const options *o, texture_product *out);

/** Whether it can be made of this source, likewise. */
int texture_product_check(const texture_source *s, texture_product *p);

/** Writes the file of -o. */
int texture_product_write(const options *o, const texture_source *s, const texture_product *p);

/** The depth image of a scene, to the file of -o: integers or floats as the format has them. */
int texture_depth_write(const options *o, const texture_source *s);

/** Draws the file of --figure. */
int texture_figure_draw(const options *o, const texture_source *s, const texture_product *p);

#endif
