/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cameras of a depth texture: this frame's and, for effects that look back, last frame's. */
#include <string.h>

#include "cli/option/names.h"
#include "cli/texture/texture.h"
#include "core/append.h"

static const option_id last_options[] = {OPTION_LAST_EYE, OPTION_LAST_LOOK};
enum { LAST_OPTIONS = sizeof last_options / sizeof last_options[0] };

static bool needs_last_frame(const effect_row *row) {
    return row != NULL && (row->needs & EFFECT_LAST_FRAME) != 0;
}

/* "--product effect:motion-blur": those that look back. */
static const char *names_of_those(char out[NAMES_SIZE]) {
    out[0] = '\0';
    for (size_t i = 0; effect_get(i) != NULL; i++)
        if (needs_last_frame(effect_get(i)))
            append(out, NAMES_SIZE, "%s%s", out[0] == '\0' ? "--product effect:" : " or effect:", effect_get(i)->name);
    return out;
}

int texture_camera_check(const options *o) {
    const bool looks_back = needs_last_frame(o->image.effect);
    char names[NAMES_SIZE];
    bool any = false;
    for (option_id id = OPTION_FOV; id <= OPTION_HFOV; id++)
        if (o->camera.ortho && option_given(o, id))
            return option_error(id, "conflicts with --ortho; --ortho=H says half the height of the view");
    for (int i = 0; i < LAST_OPTIONS; i++) {
        any = any || option_given(o, last_options[i]);
        if (option_given(o, last_options[i]) && !looks_back)
            return option_error(last_options[i], "is for effects that need last frame's camera: %s",
                                names_of_those(names));
    }
    if (looks_back && !any)
        return option_error(OPTION_PRODUCT, "effect:%s needs last frame's camera: --last-eye or --last-look",
                            o->image.effect->name);
    return EXIT_FINE;
}

int texture_camera_place(const options *o, camera_spec *spec) {
    memcpy(spec->origin, o->view.eye, sizeof spec->origin);
    return option_given(o, OPTION_LOOK) && !camera_look(spec, o->view.look)
               ? option_error(OPTION_LOOK, "must differ from --eye, got '%s'", o->given[OPTION_LOOK])
               : EXIT_FINE;
}

int texture_last_camera(const options *o, const dp_setup *setup, const camera_spec *now, texture_camera *out) {
    camera_spec spec = *now;
    if (option_given(o, OPTION_LAST_EYE))
        memcpy(spec.origin, o->view.last_eye, sizeof spec.origin);
    if (option_given(o, OPTION_LAST_LOOK) && !camera_look(&spec, o->view.last_look))
        return option_error(OPTION_LAST_LOOK, "must differ from last frame's eye, got '%s'",
                            o->given[OPTION_LAST_LOOK]);
    const char *wrong = camera_init(out, setup, &spec);
    return wrong != NULL ? usage_error("texture: last frame: %s", wrong) : EXIT_FINE;
}
