/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file choice.h  Which model is enough at all depths asked about: dp_model_choose() for a million of them, in words.
 *
 *     choosing c = choosing_start(setup, o->tolerance);
 *     for each depth: choosing_add(&c, z);
 *     choosing_finish(&c);                               // c.choice says what it came to
 */
#ifndef QUANTITY_CMD_CHOICE_H
#define QUANTITY_CMD_CHOICE_H

#include <stdbool.h>
#include <stddef.h>

#include "camera/cmd/depths.h"
#include "camera/cmd/setups.h"
#include "depthprec/depthprec.h"
#include "report/report.h"

enum { CHOICE_BLOCK = 64 };

typedef struct choosing {
    const dp_setup *setup;
    double tolerance;
    dp_choice choice;
    size_t waiting;
    double z[CHOICE_BLOCK];
    bool begun;
    dp_setup exact, full;          /* of a logarithm: without any arithmetic, and with that of its shader */
    double shader_share, shader_z; /* by how much more the latter needs, at most, and where */
} choosing;

choosing choosing_start(const dp_setup *setup, double tolerance);
void choosing_add(choosing *c, double z); /**< z in [near, far] */
void choosing_finish(choosing *c);

/** All at once. */
choosing choose_at(const dp_setup *setup, double tolerance, const depths *at);

/** Under --model auto, gives a set-up the model that is enough at these depths; else leaves it as it is. */
void setup_choose(const camera_asked *c, const depths *at, dp_setup *setup);

/** Says which model is enough and what decides it, behind `before`. */
void choice_say(page *p, const choosing *c, const char *before);

/** The share of the separation that a model neglects, and the depth where it does; NaN where it neglects nothing. */
typedef struct choice_share {
    double share, z;
} choice_share;

/** The choice as an item of a report. */
typedef struct choice_fields {
    const char *model;
    choice_share of_model;
    double tolerance;
    choice_share exact, staged_share;
    const choice_share *staged; /**< null where it is the fullest model that there is */
    choice_share shader_share;
    const choice_share *shader; /**< what all models neglect of the arithmetic of a shader; null where it is none */
} choice_fields;

extern const column choice_columns[];

void choice_fields_of(const choosing *c, choice_fields *out);

#endif
