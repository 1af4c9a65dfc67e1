/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file list.h  Topics of `depthprec list`: rows of topics, each a walk over somebody's table.
 */
#ifndef CLI_LIST_H
#define CLI_LIST_H

#include "cli/option/names.h"

/** Lists of words for options and operands that are no table of named rows. */
bool list_format(size_t index, list_item *item);
bool list_mapping(size_t index, list_item *item);
bool list_rounding(size_t index, list_item *item); /**< of name alone */
bool list_command(size_t index, list_item *item);
bool list_family(size_t index, list_item *item);
bool list_model(size_t index, list_item *item);
bool list_arith(size_t index, list_item *item);
bool list_log2(size_t index, list_item *item);
bool list_composition(size_t index, list_item *item);
bool list_vertices(size_t index, list_item *item);
bool list_parameter(size_t index, list_item *item);
bool list_topic(size_t index, list_item *item);
bool list_lattice(size_t index, list_item *item);
bool list_device(size_t index, list_item *item);
bool list_stereo(size_t index, list_item *item);  /**< of name alone: those of disparity */
bool list_samples(size_t index, list_item *item); /**< of name alone */
bool list_method(size_t index, list_item *item);

/** A topic that can be listed: the row of a list_topic(). */
typedef struct topic {
    const char *name, *note;
    name_list of;
    const char *bound; /**< what a thing's bound is called in JSON and CSV */
    const char *shown; /**< and in text, where that says more; else null */
    const char *names; /**< what else the topic may be called, separated by one space; null when there is none */
} topic;

/** The names by which shaders know what 'table --constants' prints. */
#define LIST_CONSTANTS                                                                                                 \
    "_ZBufferParams _ProjectionParams UNITY_NEAR_CLIP_VALUE LinearEyeDepth Linear01Depth Linear01DepthFromNear "       \
    "LinearDepthToEyeDepth"

#endif
