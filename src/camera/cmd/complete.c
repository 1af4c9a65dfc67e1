/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values that follow from other options: those of presets, platforms and rasterizers where the user gave none. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/cmd/camera.h"
#include "report/output.h"

const char *camera_api(const camera_asked *c) {
    return camera_said_api(&c->said);
}

const char *camera_language(const camera_asked *c) {
    return c->preset_count == 1  ? c->presets[0]->language
           : c->platform != NULL ? bias_api_find(c->platform->api)->language
                                 : NULL;
}

static int make(camera_asked *c) {
    static const char *const chosen[] = {"near", "far", "mapping", "format", NULL};
    camera_fault fault = {.key = NULL};
    if (c->preset_count == 1)
        option_chosen(c->line, "preset", c->values[0].words, chosen);
    static const char *const by_matrix[] = {"near", "far", "ortho", NULL};
    if (c->matrix.count == MATRIX_ENTRIES)
        option_chosen(c->line, "matrix", option_text(c->line, "matrix"), by_matrix);
    if (c->platform != NULL) /* a preset's mapping stays */
        option_chosen(c->line, "platform", c->platform->name, chosen + (c->preset_count > 0 ? 3 : 2));
    return camera_make(&c->said, c->lengths.unit, &fault) ? EXIT_FINE : camera_refuse(&fault);
}

/* The camera as it would be with that preset alone, all lengths in its own unit where that is known and --unit was not
 * given. */
static camera_asked with_preset(const camera_asked *c, size_t index) {
    const preset *p = c->presets[index];
    camera_asked out = *c;
    const unit_row *own = option_given(c->line, "unit") ? NULL : unit_find(p->unit), *from = c->lengths.unit;
    double *const converted[] = {&out.znear, &out.zfar, &out.range_lo, &out.range_hi, &out.at.lo, &out.at.hi};
    out.lengths.unit = own != NULL ? own : from;
    out.lengths.typed_count = 0; /* none of them is converted */
    for (size_t i = 0; i < sizeof converted / sizeof converted[0]; i++)
        *converted[i] = unit_convert(*converted[i], from, out.lengths.unit);
    out.at.from = from;
    out.at.to = out.lengths.unit;
    out.presets[0] = p;
    out.values[0] = c->values[index];
    out.preset_count = 1;
    return out;
}

/* Several presets are resolved once. */
static int resolve_each(camera_asked *c) {
    const size_t count = c->preset_count;
    camera_asked *each = asked_allocate(c->line, count * sizeof *each);
    if (each == NULL)
        return usage_error("no memory for %zu presets", count);
    int status = EXIT_FINE;
    for (size_t i = 0; i < count && status == EXIT_FINE; i++) {
        each[i] = with_preset(c, i);
        status = make(&each[i]);
    }
    c->each = each;
    return status;
}

int camera_complete(camera_asked *c, const camera_use *use) {
    char name[CAMERA_NAME_SIZE];
    c->use = *use;
    for (int k = 0; k < CAMERA_KEYS; k++)
        c->words[k] = option_text(c->line, camera_option(camera_keys[k], name));
    if (c->platform != NULL && c->platform->remap == PLATFORM_SPREADS)
        return option_error(
            "platform",
            "has no guarantee for %s, whose vertex shader spreads [0, 1] to [-1, 1] by 2 z - w: a small "
            "z loses its digits; -F %s tells of the format alone",
            c->platform->name, c->platform->stored);
    camera_fault fault = {.key = NULL};
    int status = camera_canvas(&c->said, &fault) ? range_complete(c) : camera_refuse(&fault);
    if (status == EXIT_FINE)
        status = slant_complete(c);
    if (status == EXIT_FINE)
        status = make(c);
    return status == EXIT_FINE && c->preset_count > 1 ? resolve_each(c) : status;
}

const char *camera_preset_label(const camera_asked *c, size_t index, char out[PRESET_WORDS_SIZE]) {
    enum { SHORT = 28 };
    size_t alike = 0;
    for (size_t i = 0; i < c->preset_count; i++)
        alike += c->presets[i] == c->presets[index];
    if (alike > 1 && strlen(c->values[index].words) > SHORT)
        snprintf(out, PRESET_WORDS_SIZE, "%s (%zu)", c->presets[index]->name, index + 1);
    else
        snprintf(out, PRESET_WORDS_SIZE, "%s", alike > 1 ? c->values[index].words : c->presets[index]->name);
    return out;
}

bool camera_names_arith(const camera_asked *c) {
    const option_row *row = option_find(c->line->command, "arith");
    return option_given(c->line, "arith") && names_find(row->names, option_text(c->line, "arith"), NULL, NULL);
}
