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
    if (shadow_part_asked(o->line) == SHADOW_PLACED && o->shadow.size[0] != o->shadow.size[1])
        return option_error("size", "must be square with --spot and --point, as %u, got '%ux%u'", o->shadow.size[0],
                            o->shadow.size[0], o->shadow.size[1]);
    return option_check_parts(o->line, &command_shadow, shadow_part_asked(o->line));
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

static dp_spec map_spec(const shadow_request *o, const dp_format *format, dp_mapping mapping, double znear, double zfar,
                        bool ortho) {
    return (dp_spec){
        .znear = znear, .zfar = zfar, .ortho = ortho, .format = *format, .mapping = mapping, .arith = o->camera.arith};
}

/* Columns that lights of all kinds share. */
static shadow_light light_shared(const shadow_request *o) {
    shadow_light light = shadow_light_default();
    light.triangles = o->camera.triangles;
    light.triangles.width = (int)o->shadow.size[0];
    light.triangles.height = (int)o->shadow.size[1];
    light.triangles.slant_lo = 0.0;
    light.triangles.slant_hi = o->shadow.angle;
    light.kernel = 0.5 * o->shadow.kernel;
    light.world = o->shadow.world;
    return light;
}

/* The light that all maps share; of a box, also its sides and planes. */
static shadow_light light_of(const shadow_request *o, const dp_format *format, dp_mapping mapping) {
    const bool box = option_given(o->line, "light-box");
    const dp_spec spec = map_spec(o, format, mapping, 0.0, box ? o->shadow.light_box[2] : 1.0, true);
    shadow_light light = light_shared(o);
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

/* ---- Lights that have a place ------------------------------------------------------------------------------------ */

const bias_api *shadow_asked_api(const shadow_request *o, size_t index) {
    if (!o->shadow.distance)
        return bias_asked_api(&o->bias, index);
    return index == 0 ? bias_api_find("vulkan-float") : NULL; /* r = 1 */
}

/* Where units are worth nothing at window depth 0, an octave of receivers there is left out, if there are two. */
static void leave_octave(shadow_light *light, const bias_api *api) {
    const dp_format *format = &light->setup.spec.format;
    if (!(bias_unit_at(api, format, 0.0).least < bias_unit_at(api, format, 1.0).least) ||
        !(light->receiver_hi > 4.0 * light->receiver_lo))
        return;
    if (dp_mapping_get(light->setup.spec.mapping)->reversed)
        light->receiver_hi /= 2.0;
    else
        light->receiver_lo *= 2.0;
}

static int refused_place(const shadow_request *o, const shadow_light *light, shadow_status status) {
    if (status == SHADOW_RECEIVERS && !option_given(o->line, "range"))
        return option_error("range", "LO:HI says where receivers lie where --far is %s, got none",
                            number_full(o->camera.zfar).text);
    if (status == SHADOW_RECEIVERS)
        return option_error("range", "must lie from near to far, %s to %s, and within 60 octaves and 1e12, got '%s:%s'",
                            number_full(o->camera.znear).text, number_full(o->camera.zfar).text,
                            number_full(light->receiver_lo).text, number_full(light->receiver_hi).text);
    if (status == SHADOW_POSITION)
        return option_error(o->shadow.world > 0.0 ? "from-origin" : "range",
                            "leaves too little of positions in binary32 at %s in front of the light",
                            number_full(light->receiver_lo).text);
    if (status == SHADOW_COARSE)
        return option_error("size", "must be larger for a filter of %ux%u, got '%ux%u': %s", o->shadow.kernel,
                            o->shadow.kernel, o->shadow.size[0], o->shadow.size[1], shadow_status_text(status));
    return option_error("far", "makes a map too large or too small: %s", shadow_status_text(status));
}

/* A depth at which the map is shown. */
static int show_at(double z, size_t i, shadow_maps *out) {
    if (!(z >= out->whole.receiver_lo && z <= out->whole.receiver_hi))
        return option_error("at", "must lie where receivers do, from %s to %s, got %s",
                            number_full(out->whole.receiver_lo).text, number_full(out->whole.receiver_hi).text,
                            number_full(z).text);
    out->items[i].from = z;
    out->items[i].light = out->whole;
    out->items[i].light.receiver_lo = out->items[i].light.receiver_hi = z;
    return EXIT_FINE;
}

static int show_depths(const shadow_request *o, shadow_maps *out) {
    enum { USUAL = 5 };
    const shadow_light *l = &out->whole;
    const depths spaced = {.kind = DEPTHS_LOG, .lo = l->receiver_lo, .hi = l->receiver_hi, .count = USUAL};
    const depths *at = option_given(o->line, "at") ? &o->camera.at : &spaced;
    int status = EXIT_FINE;
    if (at->count > SHADOW_CASCADES_MAX)
        return option_error("at", "must be at most %d depths with --spot and --point, got %zu", SHADOW_CASCADES_MAX,
                            at->count);
    out->count = at->count;
    for (size_t i = 0; i < at->count && status == EXIT_FINE; i++)
        status = show_at(depths_get(at, i), i, out);
    return status;
}

static int place_maps(const shadow_request *o, const dp_format *format, dp_mapping mapping, shadow_maps *out) {
    const dp_spec spec = map_spec(o, format, mapping, o->camera.znear, o->camera.zfar, o->shadow.distance);
    shadow_light light = light_shared(o);
    if (o->shadow.distance && isinf(spec.zfar))
        return option_error("far", "must be finite with --distance, which divides by it, got 'inf'");
    if (dp_setup_init(&light.setup, &spec) != DP_OK)
        return option_error("far", "must be greater than near, got '%s'", number_full(spec.zfar).text);
    light.kind = o->shadow.point ? SHADOW_POINT : SHADOW_SPOT;
    light.fov = o->shadow.point ? 90.0 : o->shadow.spot;
    light.receiver_lo = option_given(o->line, "range") ? o->camera.range_lo : spec.znear;
    light.receiver_hi = option_given(o->line, "range") ? o->camera.range_hi : spec.zfar;
    if (!option_given(o->line, "range"))
        leave_octave(&light, shadow_asked_api(o, 0));
    const shadow_status status = shadow_light_check(&light);
    out->whole = light;
    return status == SHADOW_OK ? show_depths(o, out) : refused_place(o, &light, status);
}

int shadow_maps_make(const shadow_request *o, const dp_format *format, dp_mapping mapping, shadow_maps *out) {
    const size_t asked = shadow_part_asked(o->line);
    const bool box = asked == SHADOW_BOXED;
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
    if (asked == SHADOW_PLACED)
        return place_maps(o, format, mapping, out);
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
