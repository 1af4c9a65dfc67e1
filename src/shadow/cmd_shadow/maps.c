/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shadow/cmd_shadow/maps.h"

#include <math.h>

#include "camera/cmd/setups.h"
#include "report/number.h"
#include "shadow/cmd_shadow/request.h"

enum { SIDE_MAX = 32768 };

/* A box has no view, and the depths of cascades follow from it: for the figure, too. */
static int check_together(const shadow_request *o) {
    if (o->shadow.size[0] > SIDE_MAX || o->shadow.size[1] > SIDE_MAX)
        return option_error("size", "must be at most %d texels a side, got '%ux%u'", SIDE_MAX, o->shadow.size[0],
                            o->shadow.size[1]);
    return option_check_parts(o->line, &command_shadow, option_given(o->line, "light-box"));
}

/*
 * Where units follow the exponent of a depth they are worth nothing at window depth 0, so no bias is enough for what is
 * lit there. Where nobody said where that is, it lies farther from there than 1/256 of the box, and farther than twice
 * the way that a constant bias covers.
 */
static void keep_off_zero(shadow_light *light, const bias_api *api) {
    const dp_format *format = &light->setup.spec.format;
    const double depth = light->setup.spec.zfar;
    shadow_need need;
    if (!(bias_unit_at(api, format, 0.0).least < bias_unit_at(api, format, 1.0).least))
        return;
    shadow_need_of(light, &need);
    const double away = fmax(depth / 256.0, 2.0 * need.bias[SHADOW_CONSTANT].gap_light);
    if (!(away < depth / 2.0))
        return;
    if (dp_mapping_get(light->setup.spec.mapping)->reversed)
        light->receiver_hi = depth - away;
    else
        light->receiver_lo = away;
}

/* The light that all maps share; of a box, also its sides and planes. */
static shadow_light light_of(const shadow_request *o, const dp_format *format, dp_mapping mapping) {
    const bool box = option_given(o->line, "light-box");
    dp_spec spec = {.zfar = box ? o->shadow.light_box[2] : 1.0,
                    .ortho = true,
                    .format = *format,
                    .mapping = mapping,
                    .arith = o->camera.arith};
    shadow_light light = shadow_light_default();
    light.triangles = o->camera.triangles;
    light.triangles.width = (int)o->shadow.size[0];
    light.triangles.height = (int)o->shadow.size[1];
    light.triangles.slant_lo = 0.0;
    light.triangles.slant_hi = o->shadow.angle;
    light.kernel = 0.5 * o->shadow.kernel;
    light.world = o->shadow.world;
    if (option_given(o->line, "curvature"))
        light.radius = o->shadow.curvature;
    light.facet = o->shadow.facet;
    light.receiver_lo = 0.0;
    light.receiver_hi = spec.zfar;
    if (box) {
        light.width = o->shadow.light_box[0];
        light.height = o->shadow.light_box[1];
    }
    if (option_given(o->line, "range")) {
        light.receiver_lo = o->camera.range_lo;
        light.receiver_hi = o->camera.range_hi;
    }
    dp_setup_init(&light.setup, &spec); /* cannot fail: mapping and depth have been checked */
    if (box && !option_given(o->line, "range") && shadow_light_check(&light) == SHADOW_OK)
        keep_off_zero(&light, bias_asked_api(&o->bias, 0));
    return light;
}

static int split_of(const shadow_request *o, shadow_split *out) {
    const dp_triangles *t = &o->camera.triangles;
    shadow_split s = shadow_split_default();
    s.znear = o->camera.znear;
    s.zfar = o->camera.zfar;
    s.aspect = (double)t->width / t->height;
    s.count = (int)o->shadow.cascades;
    s.lambda = o->shadow.lambda;
    s.casters = o->shadow.casters;
    *out = s;
    return view_vertical(&o->camera, t->width, t->height, &out->fov_y);
}

/* The depth texture of --camera-depth: planes, picture and triangles of the view. */
static int read_depth_of(const shadow_request *o, shadow_maps *out) {
    dp_spec spec = dp_spec_default();
    spec.format = o->shadow.camera.format;
    spec.mapping = o->shadow.camera.mapping;
    spec.znear = o->camera.znear;
    spec.zfar = o->shadow.camera.zfar > 0.0 ? o->shadow.camera.zfar : o->camera.zfar;
    spec.triangles = o->camera.triangles;
    spec.triangles.fov_y = out->view.fov_y;
    spec.triangles.slant_lo = 0.0;
    spec.triangles.slant_hi = 90.0;
    if (!(spec.zfar >= o->camera.zfar) || dp_setup_init(&out->camera, &spec) != DP_OK)
        return option_error("camera-depth", "FAR must be at least --far and beyond --near, got '%s'",
                            option_text(o->line, "camera-depth"));
    out->view.camera = &out->camera;
    return EXIT_FINE;
}

/* Refuses options that are wrong only together. */
static int refused(const shadow_request *o, shadow_status status) {
    const uint32_t side = o->shadow.size[0] < o->shadow.size[1] ? o->shadow.size[0] : o->shadow.size[1];
    const uint32_t least = (5 * o->shadow.kernel + 6) / 2 + 1; /* a texel wider than both margins of a cascade */
    if (status == SHADOW_RECEIVERS)
        return option_error("range", "must lie in the box, from 0 to %s, got '%s:%s'",
                            number_full(o->shadow.light_box[2]).text, number_full(o->camera.range_lo).text,
                            number_full(o->camera.range_hi).text);
    if (status == SHADOW_CASCADES && !(o->camera.zfar > o->camera.znear && o->camera.zfar <= 1e12))
        return option_error("far", "must be greater than near and at most 1e12, got '%s'",
                            number_full(o->camera.zfar).text);
    if (status == SHADOW_CASCADES)
        return option_error("viewport", "must be from 0.001 to 1000 times as wide as high, got '%dx%d'",
                            o->camera.triangles.width, o->camera.triangles.height);
    if (status == SHADOW_BOX && side < least)
        return option_error("size", "must be at least %u texels a side for a filter of %ux%u, got '%ux%u'", least,
                            o->shadow.kernel, o->shadow.kernel, o->shadow.size[0], o->shadow.size[1]);
    if (status == SHADOW_POSITION && option_given(o->line, "camera-depth"))
        return option_error("camera-depth", "leaves nothing of a receiver's position at the far end, got '%s'",
                            option_text(o->line, "camera-depth"));
    return option_error("far", "makes a map too large or too small: %s", shadow_status_text(status));
}

int shadow_maps_make(const shadow_request *o, const dp_format *format, dp_mapping mapping, shadow_maps *out) {
    const bool box = option_given(o->line, "light-box");
    int status = check_together(o);
    if (status == EXIT_FINE)
        status = setup_kept(&o->camera, format);
    *out = (shadow_maps){.count = box ? 1 : o->shadow.cascades};
    if (status != EXIT_FINE)
        return status;
    if (dp_mapping_get(mapping)->curve != DP_CURVE_PERSPECTIVE)
        return option_error("mapping",
                            "must be one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE " for a shadow map, got '%s'",
                            dp_mapping_get(mapping)->name);
    const shadow_light light = light_of(o, format, mapping);
    if (!box)
        status = split_of(o, &out->view);
    if (status == EXIT_FINE && option_given(o->line, "camera-depth"))
        status = read_depth_of(o, out);
    if (status != EXIT_FINE)
        return status;
    shadow_status made = shadow_light_check(&light);
    out->items[0].light = light;
    for (size_t i = 0; i < out->count && !box && made == SHADOW_OK; i++)
        made = shadow_cascade_of(&out->view, &light, (int)i, &out->items[i]);
    return made == SHADOW_OK ? EXIT_FINE : refused(o, made);
}
