/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "camera/cmd/setups.h"
#include "cli/option/names.h"
#include "core/engine.h"
#include "report/number.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/texture.h"
#include "texture/normals.h"

/* UINT32_MAX stands for "no depth" among codes. */
enum { BITS_MAX = 31 };

const char *texture_origin_name(texture_origin origin) {
    static const char *const names[] = {"given", "found", "assumed"};
    return names[origin];
}

bool texture_scene_takes(const texture_request *o, const char *name) {
    return o->image.synthetic != NULL && parameter_find(o->image.synthetic->parameters, name) >= 0;
}

int texture_parameter_set(const char *whose, const texture_parameter *list, const named_number *given,
                          parameter_use unused, double *out) {
    const char *words[PARAMETERS_MAX + 1];
    const name_list known = {.words = words};
    const int index = parameter_find(list, given->name);
    char text[NAMES_SIZE];
    size_t count = 0;
    for (int i = 0; list[i].name != NULL; i++)
        if (list[i].use == PARAMETER_ALWAYS || list[i].use != unused)
            words[count++] = list[i].name;
    words[count] = NULL;
    if (index < 0 || (list[index].use != PARAMETER_ALWAYS && list[index].use == unused))
        return option_error("parameter", "of %s %s", whose, names_refuse(&known, given->name, text));
    const texture_parameter *p = &list[index];
    if (!(given->value >= p->lo && given->value <= p->hi) || (p->whole && given->value != floor(given->value)))
        return option_error("parameter", "%s must be %sfrom %s to %s, got %s", p->name,
                            p->whole ? "a whole number " : "", number_of(p->lo, 6).text, number_of(p->hi, 6).text,
                            number_full(given->value).text);
    out[index] = given->value;
    return EXIT_FINE;
}

/* Reads the parameters of the synthetic image; others may be the effect's. */
static int synthetic_parameters(const texture_request *o, const synthetic_row *synthetic, double *out) {
    int status = EXIT_FINE;
    parameter_defaults(synthetic->parameters, out);
    for (size_t i = 0; i < o->image.parameter_count && status == EXIT_FINE; i++)
        if (o->image.effect == NULL || texture_scene_takes(o, o->image.parameters[i].name))
            status = texture_parameter_set(synthetic->name, synthetic->parameters, &o->image.parameters[i],
                                           PARAMETER_ALWAYS, out);
    return status;
}

bool texture_far_known(const texture_request *o) {
    return o->image.metric == 0 || option_given(o->line, "far") || o->camera.preset_count > 0;
}

/* The focal length is the camera's, too: another one is refused, and so are planes without a use. */
static int check_stereo(const texture_request *o) {
    static const char *const planes[] = {"near", "far", "preset", "platform"};
    if (o->image.stereo.focal == 0)
        return EXIT_FINE;
    for (size_t i = 0; i < sizeof planes / sizeof planes[0]; i++)
        if (option_given(o->line, planes[i]) && o->image.product == NULL && !option_given(o->line, "pixel"))
            return option_error(planes[i], "is for --product and --pixel beside --stereo, whose depths have no planes");
    if (option_given(o->line, "intrinsics") && o->camera.intrinsics[0] != o->image.stereo.focal)
        return option_error("intrinsics", "FX must be the focal length of --stereo, %s, got %s",
                            number_full(o->image.stereo.focal).text, number_full(o->camera.intrinsics[0]).text);
    return EXIT_FINE;
}

/* Options that need another one, or have no meaning beside it. */
static int check_together(const texture_request *o) {
    const bool file = o->line->operand_count > 0;
    if (file && o->image.synthetic != NULL)
        return option_error("synthetic", "replaces FILE, got '%s' too", o->line->operands[0]);
    if (!file && o->image.synthetic == NULL)
        return usage_error(
            "texture: needs FILE, a PNG, PFM, npy, DDS, EXR, TIFF, PGM or raw image, or --synthetic NAME");
    if (file && o->image.effect == NULL && o->image.parameter_count > 0)
        return option_error("parameter", "needs --synthetic or --product effect");
    const bool disparity = o->image.stereo.focal > 0;
    if (o->image.metric > 0 && !file)
        return option_error(disparity ? "stereo" : "metric", "needs FILE");
    if (check_stereo(o) != EXIT_FINE)
        return EXIT_USAGE;
    if (o->image.channel != NULL && !file)
        return option_error("channel", "needs FILE");
    if (o->image.packing != NULL && !file)
        return option_error("packing", "needs FILE");
    const int status = texture_window_check(o);
    return status == EXIT_FINE ? texture_camera_check(o) : status;
}

void texture_source_close(texture_source *s) {
    image_free(&s->picture);
    image_free(&s->colours);
    free(s->unpacked.normals);
    frame_normals_free(&s->normals);
}

/* The format that the user gave, which may leave a choice; else the one found, else the usual one. */
static int choose_format(const texture_request *o, texture_source *s, dp_format *out) {
    const bool chosen = o->camera.preset_count > 0 || o->camera.platform != NULL;
    const bool given = texture_is_window(o) && (option_given(o->line, "format") || chosen);
    s->format_from = given ? ORIGIN_GIVEN : s->path != NULL && s->found.certain ? ORIGIN_FOUND : ORIGIN_ASSUMED;
    if (!given && s->path != NULL && !s->found.depth)
        return usage_error("%s: cannot be window depth: %s; --format NAME reads it all the same", s->path, s->why);
    if (given && o->camera.format_count > 1 && option_given(o->line, "format"))
        return option_error("format", "must be one format, got %zu", o->camera.format_count);
    dp_format usual[2];
    dp_format_parse("unorm24", usual);
    *out = given ? o->camera.formats[0] : s->path != NULL ? s->found.format : usual[0];
    bool told = false; /* of two formats of a preset or a platform */
    for (size_t i = 0; given && s->path != NULL && i < o->camera.format_count && !told; i++)
        if (strcmp(o->camera.formats[i].name, s->found.format.name) == 0) {
            *out = o->camera.formats[i];
            told = s->found.certain;
        }
    if (given && !told && setup_decided(&o->camera) != EXIT_FINE)
        return EXIT_USAGE;
    if (out->bits > BITS_MAX)
        return option_error("format", "must have at most %d bits in an image, got %s", BITS_MAX, out->name);
    return EXIT_FINE;
}

static int choose_mapping(const texture_request *o, texture_source *s, dp_mapping *out) {
    const bool given = option_given(o->line, "mapping") || o->camera.preset_count > 0;
    if (!texture_is_window(o)) { /* a packing that says so */
        *out = DP_MAPPING_LINEAR;
        s->mapping_from = s->direction_from = ORIGIN_FOUND;
        return EXIT_FINE;
    }
    if (given && o->camera.mapping_count > 1)
        return option_error("mapping", "must be one mapping, got %zu", o->camera.mapping_count);
    if (!given && s->path != NULL && dp_range_moves(o->camera.depth_range))
        return option_error("mapping", "must be given with --depth-range: what an image shows of it is of 0 to 1");
    /* Nothing in an image tells the curve; what is usual in perspective pictures tells nothing of orthographic ones. */
    const bool told = s->path != NULL && s->found.reversed >= 0 && !o->camera.ortho;
    s->mapping_from = s->noted ? ORIGIN_FOUND : given ? ORIGIN_GIVEN : ORIGIN_ASSUMED;
    s->direction_from = s->noted                     ? ORIGIN_FOUND
                        : given                      ? ORIGIN_GIVEN
                        : told && s->found.direction ? ORIGIN_FOUND
                                                     : ORIGIN_ASSUMED;
    const dp_mapping usual = o->camera.platform != NULL ? o->camera.mappings[0] : DP_MAPPING_D3D;
    *out = given ? o->camera.mappings[0] : told && s->found.reversed == 1 ? DP_MAPPING_REVERSED : usual;
    if (dp_mapping_get(*out)->log_from_near)
        return option_error(option_given(o->line, "mapping") ? "mapping" : "preset",
                            "texture reads logarithms that begin at the eye (log, three-webgl, osgearth), none that "
                            "begins at near; got %s",
                            dp_mapping_get(*out)->name);
    return EXIT_FINE;
}

static int make_setup(texture_request *o, texture_source *s, dp_setup *out) {
    texture_request one = *o;
    setups all = {0};
    const bool by_matrix = o->camera.matrix.count == MATRIX_ENTRIES;
    if (by_matrix && o->image.metric > 0)
        return option_error("matrix", "conflicts with --metric");
    if (by_matrix && o->image.packing != NULL && o->image.packing->linear)
        return option_error("matrix", "is for window depth, and %s holds eye depth: --fov says its camera", s->path);
    int status = o->image.metric > 0 ? EXIT_FINE : choose_format(o, s, &one.camera.formats[0]);
    if (status == EXIT_FINE && by_matrix) {
        status = texture_matrix_open(o, s);
        const dp_format format = one.camera.formats[0];
        one.camera = o->camera;
        one.camera.formats[0] = format;
    } else if (status == EXIT_FINE && o->image.metric == 0) {
        status = choose_mapping(o, s, &one.camera.mappings[0]);
    }
    one.camera.format_count = one.camera.mapping_count = 1;
    if (status == EXIT_FINE)
        status = setups_make(&one.camera, &all);
    if (status != EXIT_FINE)
        return status;
    *out = all.items[0];
    setups_release(&all);
    return EXIT_FINE;
}

/* Metric depth lies on a lattice of its own; the planes that were given are for effects alone. */
static int make_camera(texture_request *o, texture_source *s) {
    const bool is_metric = o->image.metric > 0;
    int status = make_setup(o, s, is_metric ? &s->planes : &s->setup);
    camera_spec spec = o->camera.spec;
    if (s->path != NULL) {
        spec.width = s->picture.width;
        spec.height = s->picture.height;
    }
    if (status == EXIT_FINE && o->camera.matrix.count == 0)
        status = view_vertical(&o->camera, (int)spec.width, (int)spec.height, &spec.fov_y);
    if (status == EXIT_FINE)
        status = texture_camera_place(o, &spec);
    if (status != EXIT_FINE)
        return status;
    const double focal = o->image.stereo.focal, middle[] = {focal, focal, 0.5 * spec.width, 0.5 * spec.height};
    const bool said = option_given(o->line, "intrinsics"), says_angle = o->camera.matrix.count > 0 || said || focal > 0;
    if (o->camera.matrix.count == MATRIX_TANGENTS)
        texture_tangents_take(&o->camera.matrix, &s->matrix);
    if (said || focal > 0)
        texture_intrinsics_take(said ? o->camera.intrinsics : middle, (double[]){spec.width, spec.height}, &s->matrix);
    s->fov_y = says_angle ? s->matrix.fov[1] : spec.fov_y;
    spec.matrix = says_angle ? &s->matrix.taken : NULL;
    spec.radial = o->image.radial;
    if (o->image.radial && o->camera.ortho)
        return option_error("radial", "does not apply to an orthographic camera, whose rays are parallel");
    const char *wrong = camera_init(&s->camera, is_metric ? &s->planes : &s->setup, &spec);
    if (wrong != NULL)
        return usage_error("texture: %s", wrong);
    if (is_metric) {
        dp_spec lattice = dp_spec_default();
        lattice.znear = s->metric.znear;
        lattice.zfar = s->metric.zfar;
        lattice.mapping = s->metric.mapping;
        lattice.format = s->metric.format;
        if (dp_setup_init(&s->setup, &lattice) != DP_OK)
            return usage_error("%s: no metric depth: its depths are too small or too large for --%s", s->path,
                               focal > 0 ? "stereo" : "metric");
        s->camera.setup = s->setup;
    }
    const bool moves = o->image.effect != NULL && (o->image.effect->needs & EFFECT_LAST_FRAME) != 0;
    return moves ? texture_last_camera(o, &s->setup, &spec, &s->last) : EXIT_FINE;
}

int texture_source_open(texture_request *o, texture_source *s) {
    int status = check_together(o);
    if (status == EXIT_FINE && o->image.synthetic != NULL)
        status = synthetic_parameters(o, o->image.synthetic, s->parameters);
    else if (status == EXIT_FINE)
        status = texture_image_read(o, s);
    if (status == EXIT_FINE)
        status = make_camera(o, s);
    if (status == EXIT_FINE && s->path != NULL)
        texture_read_on(o, s);
    s->frame =
        (frame){.camera = &s->camera,
                .last = o->image.effect != NULL && (o->image.effect->needs & EFFECT_LAST_FRAME) != 0 ? &s->last : NULL,
                .image = s->path != NULL ? &s->picture : NULL,
                .synthetic = o->image.synthetic,
                .parameters = s->parameters,
                .grain = s->path != NULL ? &s->grain : NULL,
                .metric = o->image.metric > 0,
                .sensor = o->image.metric > 0 && o->image.stereo.focal == 0 ? &s->metric.sensor : NULL,
                .planes = o->image.metric > 0 ? &s->planes : NULL,
                .sky = o->image.sky,
                .threads = o->out.threads};
    return status;
}
