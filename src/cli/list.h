/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file list.h  What `depthprec list WHAT` can list: rows of topics, each a walk over somebody's table.
 */
#ifndef CLI_LIST_H
#define CLI_LIST_H

#include <stdbool.h>
#include <stddef.h>

enum { LIST_TEXT_SIZE = 768 };

/** One listed thing. Texts are static, except `bound`, which is written in place. */
typedef struct list_item {
    const char *name;
    const char *aliases;        /**< separated by one space; null or "" when there are none */
    const char *note;           /**< what it is, one line */
    char bound[LIST_TEXT_SIZE]; /**< the claim, "" when nothing is claimed */
    const char *source;         /**< null or "" when there is none */
    const void *row;            /**< the row itself; null where it has no pointer */
} list_item;

/** Writes what there is. @return true */
static inline bool list_fill(list_item *item, list_item what) {
    *item = what;
    return true;
}

/** Fills in thing `index`; false when there is none. */
typedef bool (*list_get)(size_t index, list_item *item);

/** The tables, and what options and operands may be called. */
bool list_format(size_t index, list_item *item);
bool list_mapping(size_t index, list_item *item);
bool list_rounding(size_t index, list_item *item); /**< of name alone */
bool list_command(size_t index, list_item *item);
bool list_language(size_t index, list_item *item);
bool list_family(size_t index, list_item *item);
bool list_model(size_t index, list_item *item);
bool list_arith(size_t index, list_item *item);
bool list_log2(size_t index, list_item *item);
bool list_composition(size_t index, list_item *item);
bool list_preset(size_t index, list_item *item);
bool list_platform(size_t index, list_item *item);
bool list_unit(size_t index, list_item *item); /**< of name alone */
bool list_api(size_t index, list_item *item);
bool list_rasterizer(size_t index, list_item *item);
bool list_program(size_t index, list_item *item);
bool list_scheme(size_t index, list_item *item);
bool list_vertices(size_t index, list_item *item);
bool list_filter(size_t index, list_item *item);
bool list_product(size_t index, list_item *item);
bool list_effect(size_t index, list_item *item);
bool list_parameter(size_t index, list_item *item);
bool list_topic(size_t index, list_item *item);
bool list_figure(size_t index, list_item *item);
bool list_synthetic(size_t index, list_item *item);
bool list_position(size_t index, list_item *item);
bool list_normal(size_t index, list_item *item);
bool list_packing(size_t index, list_item *item);
bool list_lattice(size_t index, list_item *item);
bool list_device(size_t index, list_item *item);
bool list_stereo(size_t index, list_item *item);  /**< of name alone: those of disparity */
bool list_samples(size_t index, list_item *item); /**< of name alone */
bool list_method(size_t index, list_item *item);

/** What can be listed: the row of a list_topic(). */
typedef struct topic {
    const char *name, *note;
    list_get get;
    const char *bound; /**< what a thing's bound is called in JSON and CSV */
    const char *shown; /**< and in text, where that says more; else null */
    const char *names; /**< what else the topic may be called, separated by one space; null when there is none */
} topic;

/** The names by which shaders know what 'table --constants' prints. */
#define LIST_CONSTANTS                                                                                                 \
    "_ZBufferParams _ProjectionParams UNITY_NEAR_CLIP_VALUE LinearEyeDepth Linear01Depth Linear01DepthFromNear "       \
    "LinearDepthToEyeDepth"

#endif
