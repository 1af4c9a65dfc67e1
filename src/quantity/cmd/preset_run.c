/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd/preset_run.h"

#include <math.h>
#include <stdlib.h>

preset_problem preset_problem_of(const asked_line *line, const camera_asked *c, bool chosen) {
    preset_problem p = {.spec = camera_to_spec(&c->said),
                        .row = c->presets[0],
                        .values = c->values[0],
                        .unit = c->lengths.unit,
                        .near_given = option_given(line, "near"),
                        .far_given = option_given(line, "far"),
                        .lo = (double)NAN,
                        .hi = (double)NAN};
    if (!chosen)
        p.spec.model = dp_mapping_get(c->mappings[0])->curve == DP_CURVE_LINEAR ? DP_MODEL_STAGED : DP_MODEL_FLOAT;
    return p;
}

number_text preset_typed(const preset_problem *p, const preset_answer *a, double number, bool up, int digits) {
    for (; digits < 16; digits++) {
        const number_text few = up ? number_up(number, digits) : number_down(number, digits);
        const double read = strtod(few.text, NULL);
        if (read >= a->from && read <= a->to && preset_passes(p, read))
            return number_brief(few);
    }
    return number_full(number);
}

const char *preset_run_text(const preset_problem *p, const preset_answer *a, int digits, char out[PRESET_RUN_SIZE]) {
    const char *name = preset_sought(p->row)->name;
    if (!a->possible || (!a->below && !a->above)) {
        snprintf(out, PRESET_RUN_SIZE, "at %s %s from %s to %s", a->possible ? "each" : "no", name,
                 number_full(a->least).text, number_full(a->most).text);
        return out;
    }
    const number_text from = preset_typed(p, a, a->from, true, digits), to = preset_typed(p, a, a->to, false, digits);
    if (!a->above)
        snprintf(out, PRESET_RUN_SIZE, "from %s %s on", name, from.text);
    else if (!a->below)
        snprintf(out, PRESET_RUN_SIZE, "up to %s %s", name, to.text);
    else
        snprintf(out, PRESET_RUN_SIZE, "from %s %s to %s", name, from.text, to.text);
    return out;
}
