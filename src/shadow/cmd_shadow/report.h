/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file report.h  The report of shadow: what its lists are of, and the words around them. */
#ifndef SHADOW_CMD_SHADOW_REPORT_H
#define SHADOW_CMD_SHADOW_REPORT_H

#include "report/report.h"
#include "shadow/cmd_shadow/given.h"
#include "shadow/cmd_shadow/request.h"
#include "shadow/cmd_shadow/rows.h"
#include "shadow/cmd_shadow/trial.h"

enum { DIGITS_GAP = 3, DIGITS = 4, DIGITS_Z = 6 };

typedef struct shadow {
    shadow_request o;    /* with what stands for options that were not given */
    const bias_api *api; /* null for several */
    const char *api_name, *unit, *camera_depth;
    const shadow_split *view; /* null where there is a box */
    size_t setup_count;
    struct {
        double lo, hi; /* of the box: what is lit */
    } lit;
    struct {
        const char *kind;
    } place;
    const char *format, *mapping, *arith;
    shadow_maps maps;
    shadow_row row;
    shadow_whole whole;
    shadow_engine_row engine;
    bool missed; /* in some set-up the first engine's bias is not enough */
    shadow_trial trial[SHADOW_TRIALS];
    size_t trials;
    int status; /* of what was drawn */
} shadow;

/** Text above a set-up; the item of all these is the report. */
void shadow_say_answer(page *p, void *item);

/** A line over the titles of the table of one API. */
void shadow_say_heads(page *p, void *item);

/** Text below them: of engines, of one API, of what was drawn, and of all APIs. */
void shadow_say_engines(page *p, void *item);
void shadow_say_notes(page *p, void *item);
void shadow_say_trials(page *p, void *item);
void shadow_say_calls(page *p, void *item);

#endif
