/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file stored.h  What a prepass may store beside the depths that the pass draws: the options, and their report. */
#ifndef ZFIGHT_CMD_PREPASS_STORED_H
#define ZFIGHT_CMD_PREPASS_STORED_H

#include "cli/option/option.h"
#include "raster/resolve.h"

enum { STORED_MOST = 16, STORED_NAME_SIZE = 32 };

typedef struct stored_case {
    char name[STORED_NAME_SIZE]; /**< "unorm16", "min:4" */
    const resolve_way *way;      /**< null: depths in another format */
    int samples;                 /**< of a way that has no places of its own */
    dp_format format;            /**< of the prepass, where `way` is null */
} stored_case;

/** Several of one option. */
typedef struct stored_asked {
    stored_case cases[STORED_MOST]; /**< in the order given, each once */
    size_t count;                   /**< 0: two vertex programs are compared */
} stored_asked;

extern const option_table stored_options;
extern const option_use stored_uses[];

struct prepass_request;

/** The report of these cases. @return an exit status */
int prepass_stored(const struct prepass_request *o);

#endif
