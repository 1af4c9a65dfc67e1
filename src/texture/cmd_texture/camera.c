/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cameras of a depth texture: this frame's and, for effects that look back, last frame's. */
#include <string.h>

#include "cli/option/names.h"
#include "core/append.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/texture.h"

static const char *const last_options[] = {"last-eye", "last-look"};
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

int texture_camera_check(const texture_request *o) {
    const bool looks_back = needs_last_frame(o->image.effect);
    char names[NAMES_SIZE];
    bool any = false;
    int angles = 0;
    static const char *const of_view[] = {"fov", "hfov", "intrinsics"};
    for (size_t i = 0; i < sizeof of_view / sizeof of_view[0]; i++) {
        if (o->camera.ortho && option_given(o->line, of_view[i]))
            return option_error(of_view[i], "conflicts with --ortho; --ortho=H says half the height of the view");
        angles += option_given(o->line, of_view[i]);
    }
    angles += o->camera.matrix.count == MATRIX_TANGENTS;
    if (angles > 1 && option_given(o->line, "intrinsics"))
        return option_error("intrinsics", "conflicts with --fov and --hfov");
    if (o->image.radial && angles == 0)
        return option_error("radial", "needs the rays: --fov, --hfov, --intrinsics or four tangents as --matrix");
    for (int i = 0; i < LAST_OPTIONS; i++) {
        any = any || option_given(o->line, last_options[i]);
        if (option_given(o->line, last_options[i]) && !looks_back)
            return option_error(last_options[i], "is for effects that need last frame's camera: %s",
                                names_of_those(names));
    }
    if (looks_back && !any)
        return option_error("product", "effect:%s needs last frame's camera: --last-eye or --last-look",
                            o->image.effect->name);
    return EXIT_FINE;
}

int texture_camera_place(const texture_request *o, camera_spec *spec) {
    memcpy(spec->origin, o->image.eye, sizeof spec->origin);
    return option_given(o->line, "look") && !camera_look(spec, o->image.look)
               ? option_error("look", "must differ from --eye, got '%s'", option_text(o->line, "look"))
               : EXIT_FINE;
}

int texture_last_camera(const texture_request *o, const dp_setup *setup, const camera_spec *now, texture_camera *out) {
    camera_spec spec = *now;
    if (option_given(o->line, "last-eye"))
        memcpy(spec.origin, o->image.last_eye, sizeof spec.origin);
    if (option_given(o->line, "last-look") && !camera_look(&spec, o->image.last_look))
        return option_error("last-look", "must differ from last frame's eye, got '%s'",
                            option_text(o->line, "last-look"));
    const char *wrong = camera_init(out, setup, &spec);
    return wrong != NULL ? usage_error("texture: last frame: %s", wrong) : EXIT_FINE;
}
