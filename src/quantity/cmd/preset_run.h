/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file preset_run.h  The numbers of a preset that keep a separation, as an answer in the engine's own terms. */
#ifndef QUANTITY_CMD_PRESET_RUN_H
#define QUANTITY_CMD_PRESET_RUN_H

#include "camera/cmd/setups.h"
#include "report/number.h"
#include "solve/preset.h"

enum { PRESET_RUN_SIZE = 128 };

/** The one preset, format and mapping of a camera, where it looks; the separation is the caller's to set. @param line
 * whose planes replace the preset's @param chosen  in the camera's own model, else in the fullest */
preset_problem preset_problem_of(const asked_line *line, const camera_asked *c, bool chosen);

/** The fewest digits, `digits` or more, that pass as they are typed. @param up  rounded upwards */
number_text preset_typed(const preset_problem *p, const preset_answer *a, double number, bool up, int digits);

/** "from zoom 15.2 on", "up to radius 20", "at each zoom from 0 to 26", "at no zoom from 0 to 26". @return out */
const char *preset_run_text(const preset_problem *p, const preset_answer *a, int digits, char out[PRESET_RUN_SIZE]);

#endif
