/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cameras of a depth texture: this frame's and, for effects that look back, last frame's. */
#include <string.h>

#include "cli/names.h"
#include "cli/texture.h"
#include "core/append.h"

static const option_id last_options[] = {OPTION_LAST_ORIGIN, OPTION_LAST_YAW, OPTION_LAST_PITCH, OPTION_LAST_FOV};
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
    const bool looks_back = needs_last_frame(o->effect);
    char names[NAMES_SIZE];
    bool any = false;
    for (option_id id = OPTION_FOV; id <= OPTION_HFOV; id++)
        if (o->ortho && option_given(o, id))
            return option_error(id, "does not apply with --ortho; --half-height does");
    if (!o->ortho && option_given(o, OPTION_HALF_HEIGHT))
        return option_error(OPTION_HALF_HEIGHT, "needs --ortho");
    for (int i = 0; i < LAST_OPTIONS; i++) {
        any = any || option_given(o, last_options[i]);
        if (option_given(o, last_options[i]) && !looks_back)
            return option_error(last_options[i], "is for effects that need last frame's camera: %s",
                                names_of_those(names));
    }
    if (o->ortho && option_given(o, OPTION_LAST_FOV))
        return option_error(OPTION_LAST_FOV, "does not apply with --ortho");
    if (looks_back && !any)
        return option_error(OPTION_PRODUCT,
                            "effect:%s needs last frame's camera: --last-origin, --last-yaw, --last-pitch or "
                            "--last-fov",
                            o->effect->name);
    return EXIT_FINE;
}

int texture_last_camera(const options *o, const dp_setup *setup, const camera_spec *now, texture_camera *out) {
    camera_spec spec = *now;
    if (option_given(o, OPTION_LAST_ORIGIN))
        memcpy(spec.origin, o->last.origin, sizeof spec.origin);
    if (option_given(o, OPTION_LAST_YAW))
        spec.yaw = o->last.yaw;
    if (option_given(o, OPTION_LAST_PITCH))
        spec.pitch = o->last.pitch;
    if (option_given(o, OPTION_LAST_FOV))
        spec.fov_y = o->last.fov_y;
    const char *wrong = camera_init(out, setup, &spec);
    return wrong != NULL ? usage_error("texture: last frame: %s", wrong) : EXIT_FINE;
}
