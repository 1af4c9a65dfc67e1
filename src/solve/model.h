/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file model.h  Names that people give the models of arithmetic. */
#ifndef SOLVE_MODEL_H
#define SOLVE_MODEL_H

#include "depthprec/depthprec.h"

/**
 * The word for a model: dp_model_name(), and "auto" for DP_MODEL_COUNT, the simplest that is enough.
 * @return NULL beyond
 */
const char *model_word(size_t model);

#endif
