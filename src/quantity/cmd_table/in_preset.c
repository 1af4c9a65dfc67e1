/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd_table/in_preset.h"

#include <math.h>

#include "core/append.h"
#include "quantity/cmd/preset_run.h"

/* The camera of several set-ups has no one answer. */
static const preset_parameter *sought(const camera_asked *c) {
    const bool one = c->preset_count == 1 && c->format_count == 1 && c->mapping_count == 1;
    return one && !isnan(camera_focus(c)) ? preset_sought(c->presets[0]) : NULL;
}

void in_preset_find(const table_request *o, in_preset *out) {
    const unit_row *unit = o->camera.lengths.unit;
    const preset_parameter *parameter = sought(&o->camera);
    *out = (in_preset){.parameter = parameter != NULL ? parameter->name : NULL};
    if (parameter == NULL)
        return;
    preset_problem p = preset_problem_of(o->line, &o->camera, false);
    for (size_t i = 0; i < RESOLVED_LIMITS; i++) {
        preset_answer a;
        char run[PRESET_RUN_SIZE];
        p.limit = resolved_limit(i, unit);
        preset_solve(&p, &a);
        out->from[i] = a.possible ? a.from : (double)NAN;
        out->to[i] = a.possible ? a.to : (double)NAN;
        if (a.possible)
            append(out->text, sizeof out->text, "%s%s %s", *out->text != '\0' ? ", " : "",
                   resolved_limit_text(i, unit).text, preset_run_text(&p, &a, RESOLVED_DIGITS, run));
    }
}
