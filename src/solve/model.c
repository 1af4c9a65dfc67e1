/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/model.h"

const char *model_word(size_t model) {
    return model == DP_MODEL_COUNT ? "auto" : dp_model_name((dp_model)model);
}
