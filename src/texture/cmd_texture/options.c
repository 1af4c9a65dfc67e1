/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command texture and its options. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/list.h"
#include "cli/option/kinds.h"
#include "core/append.h"
#include "image/image.h"
#include "report/output.h"
#include "texture/cmd_texture/request.h"
#include "texture/device.h"
#include "texture/metric.h"

static const name_list synthetics = {.rows = &synthetic_table};
static const name_list products = {.rows = &product_table};
static const name_list normal_formats = {.words = (const char *const[]){"opengl", "directx", NULL}};
static const name_list samples = {.get = list_samples};
static const name_list stereos = {.get = list_stereo};
static const name_list packings = {.rows = &packing_table};

/* The length of 1 in a sample of metric depth. */
static const struct sample_unit {
    const char *name, *length, *moved; /* moved: a row of moved_get(), or null */
} sample_units[] = {
    {"mm", "1mm", NULL},         {"tum", "0.2mm", NULL},         {"kitti", "3.90625mm", NULL},
    {"sun3d", "1mm", "rotated"}, {"nyu-raw", "1m", "disparity"},
};

bool list_samples(size_t index, list_item *item) {
    return index < sizeof sample_units / sizeof sample_units[0] &&
           list_fill(item, (list_item){.name = sample_units[index].name, .row = &sample_units[index]});
}

static int parse_metric(asked_line *line, const option_row *row, const char *value, void *group) {
    texture_asked *o = group;
    list_item item;
    char unit[32];
    const size_t length = strcspn(value, ",");
    snprintf(unit, sizeof unit, "%.*s", (int)length, value);
    const bool named = names_find(row->names, unit, NULL, &item);
    const struct sample_unit *const known = named ? item.row : NULL;
    const char *const way = value[length] == ',' ? value + length + 1 : named ? known->moved : NULL;
    char ways[OPTION_TEXT_SIZE] = "";
    o->moved = NULL;
    for (size_t i = 0; moved_get(i) != NULL; i++) {
        if (moved_get(i)->reading == NULL || moved_get(i)->lattice != NULL)
            continue;
        append(ways, sizeof ways, "%s%s", ways[0] != '\0' ? ", " : "", moved_get(i)->name);
        if (way != NULL && strcmp(moved_get(i)->name, way) == 0)
            o->moved = moved_get(i);
    }
    if (value[length] == ',' && (o->moved == NULL || (named && known->moved != NULL)))
        return option_refuse(row, "must have one of %s behind the comma of a unit, got '%s'", ways, value);
    for (size_t i = 0; named && known->moved != NULL && moved_get(i) != NULL; i++)
        if (strcmp(moved_get(i)->name, known->moved) == 0)
            o->moved = moved_get(i);
    return parse_length(line, row, named ? known->length : length < sizeof unit ? unit : value, group);
}

bool list_stereo(size_t index, list_item *item) {
    size_t left = index;
    for (size_t i = 0; device_get(i) != NULL; i++)
        if (device_get(i)->focal > 0 && left-- == 0)
            return list_fill(item, (list_item){.name = device_get(i)->name, .row = device_get(i)});
    return false;
}

static int take_device(length_reader *seen, const device_row *d, stereo_spec *out) {
    const unit_row *metre = unit_find("m");
    if (seen->in->unit == NULL)
        seen->in->unit = metre;
    *out = (stereo_spec){d->focal, unit_convert(d->baseline, metre, seen->in->unit), d->offset, d->step};
    return EXIT_FINE;
}

/* A number, or a quotient of two. */
static bool read_quotient(const char *text, size_t length, double *out) {
    const char *const over = memchr(text, '/', length);
    const size_t whole = over != NULL ? (size_t)(over - text) : length;
    double divisor = 1;
    const bool good =
        number_parse_part(text, whole, NUMBER_FINITE, out) &&
        (over == NULL || (number_parse_part(over + 1, length - whole - 1, NUMBER_FINITE, &divisor) && divisor != 0.0));
    *out /= divisor;
    return good;
}

/* Numbers in this order, or behind their names in any. */
static const struct stereo_part {
    const char *name, *limits;
    double least, most;
    size_t place;
} stereo_parts[] = {
    {"focal", "a number from 0.001 to 1e9", 1e-3, 1e9, offsetof(stereo_spec, focal)},
    {"baseline", "a length from 1e-9 to 1e9", 1e-9, 1e9, offsetof(stereo_spec, baseline)},
    {"offset", "a number from -1e6 to 1e6", -1e6, 1e6, offsetof(stereo_spec, offset)},
    {"step", "a number from -1e6 to 1e6, and not within 1e-6 of 0", -1e6, 1e6, offsetof(stereo_spec, step)}};
enum { STEREO_PARTS = sizeof stereo_parts / sizeof stereo_parts[0], STEREO_BASELINE = 1, STEREO_STEP = 3 };
static const double STEREO_STEP_LEAST = 1e-6;

static int stereo_part_set(length_reader *seen, const option_row *row, const char *text, size_t length, size_t place,
                           stereo_spec *out) {
    const char *const equals = memchr(text, '=', length);
    const size_t name = equals != NULL ? (size_t)(equals - text) : 0, from = equals != NULL ? name + 1 : 0;
    for (size_t i = 0; equals != NULL && (place = i) < STEREO_PARTS; i++)
        if (strlen(stereo_parts[i].name) == name && memcmp(stereo_parts[i].name, text, name) == 0)
            break;
    char names[NAMES_SIZE];
    if (place >= STEREO_PARTS || (place == 0 && equals == NULL && isalpha((unsigned char)text[0])))
        return option_refuse(row, "must be focal=F,baseline=B[,offset=O][,step=S], or begin with %s, got '%.*s'",
                             names_join(row->names, ", ", " or ", names), (int)length, text);
    const struct stereo_part *p = &stereo_parts[place];
    double value;
    const bool read = place == STEREO_BASELINE ? length_read(seen, text + from, length - from, NUMBER_FINITE, &value)
                                               : read_quotient(text + from, length - from, &value);
    if (!read || !(value >= p->least && value <= p->most) || (place == STEREO_STEP && fabs(value) < STEREO_STEP_LEAST))
        return option_refuse(row, "%s must be %s, got '%.*s'%s", p->name, p->limits, (int)(length - from), text + from,
                             place == STEREO_BASELINE ? length_hint(text + from, length - from) : "");
    memcpy((char *)out + p->place, &value, sizeof value);
    return EXIT_FINE;
}

static int parse_stereo(asked_line *line, const option_row *row, const char *value, void *group) {
    texture_asked *o = group;
    length_reader seen = {.in = line->lengths};
    stereo_spec *out = option_field(row, group);
    int status = EXIT_FINE;
    *out = (stereo_spec){.step = 1};
    o->metric = 1; /* of scene units */
    for (size_t place = 0; status == EXIT_FINE; place++) {
        const size_t length = strcspn(value, ",");
        char name[32];
        list_item item;
        snprintf(name, sizeof name, "%.*s", (int)length, value);
        if (place == 0 && length < sizeof name && names_find(row->names, name, NULL, &item))
            status = take_device(&seen, item.row, out);
        else
            status = stereo_part_set(&seen, row, value, length, place, out);
        if (value[length] == '\0')
            break;
        value += length + 1;
    }
    if (status == EXIT_FINE && !(out->focal > 0 && out->baseline > 0))
        return option_refuse(row, "needs focal=F and baseline=B, got '%s'", option_text(line, "stereo"));
    return status;
}

/* None is below 0. */
static int parse_sky(asked_line *line, const option_row *row, const char *value, void *group) {
    texture_asked *o = group;
    (void)line;
    char limits[OPTION_TEXT_SIZE];
    o->sky = -1;
    if (strcmp(value, "none") == 0 ||
        (number_parse(value, NUMBER_FINITE, &o->sky) && o->sky >= row->least && o->sky <= row->most))
        return EXIT_FINE;
    return option_refuse(row, "must be a number from %s, or none, got '%s'", option_limits(row, limits), value);
}

static int parse_tint(asked_line *line, const option_row *row, const char *value, void *group) {
    texture_asked *o = group;
    (void)line;
    static const double limits[][2] = {{0, 1}, {0, 1}, {0, 1}, {0, 1}};
    o->tint[3] = 1;
    return option_read_numbers(value, 4, limits, o->tint) >= 3
               ? EXIT_FINE
               : option_refuse(row, "must be %s, each from 0 to 1, got '%s'", row->argument, value);
}

#define GROUP_TYPE texture_asked

/* clang-format off */
static const option_row texture_rows[] = {
    {"last-eye", 0, "X,Y,Z",
        "last frame's --eye, for motion blur", ORIGIN(last_eye), .without = "as in this frame",
        .group = "The depth texture"},
    {"last-look", 0, "X,Y,Z",
        "last frame's --look", ORIGIN(last_look), .without = "as in this frame"},
    {"synthetic", 0, "NAME",
        "a synthetic image in place of FILE: @; 'depthprec list synthetic' has their parameters",
        ROW(synthetic, synthetics)},
    {"size", 0, "WxH",
        "size of the image in pixels: for --synthetic, for a raw FILE, and for an effect alone that needs positions",
        SIZE(size),
        .standard = "640x360",
        .instead = "; a figure's size is --figure-size"},
    {"parameter", 0, "NAME=VALUE[,NAME=VALUE...]",
        "parameters of the synthetic image or the effect; may be repeated", .parse = parse_parameter, .repeats = true},
    {"sky", 0, "T|none",
        "window depths within T of the far plane are sky, which no product has; 0: only the far plane itself; none: "
        "sky lies at the far plane, as shaders read it, and fog covers it",
        .parse = parse_sky, INTO(double, sky), LIMITS(0, 0.5, NULL), .standard = "0.0001",
        .without = "as in Unity's shaders"},
    {"metric", 0, "SCALE|mm|tum|kitti|sun3d|nyu-raw",
        "the samples are eye depths in units of SCALE, 1 of COMPUTE_EYEDEPTH; of TUM there are 5000 to the metre, of "
        "KITTI 256; of SUN3D and NYU's raw files the bits are moved back, of others behind a comma: rotated, swapped, "
        "halves; 0, negative numbers, NaN and infinity are holes",
        .parse = parse_metric, .names = &samples, INTO(double, metric),
        LIMITS(METRIC_SCALE_MIN, METRIC_SCALE_MAX, "scene units")},
    {"stereo", 0, "focal=F,baseline=B[,offset=O][,step=S]|NAME",
        "the samples are disparities: O + S x sample is that in pixels, of a focal length of F pixels and a baseline "
        "B, a length; S may be a quotient, 1/256, and is below 0 where larger samples are farther; NAME is one of "
        "'depthprec list sensors', of which others of these may follow; 0 and what is not finite are holes",
        .parse = parse_stereo, .names = &stereos, INTO(stereo_spec, stereo)},
    {"lattice", 0, "NAME[:NUMBERS]",
        "what metric depth was rounded to before, in place of what the image shows: stereo:FOCAL,BASELINE[,PIXELS] "
        "with the step of disparity in pixels, inverse:A[,B] with steps of 1/A in 1/z, even:STEP[,FROM] in z, "
        "inverse-levels:N or levels:N from the nearest to the farthest depth, binary16, file, or a name from "
        "'depthprec list sensors'; @STEP behind it if it was rounded to that before it was stored",
        TEXT(lattice), .without = "as found"},
    {"radial", 0, NULL,
        "with --metric: the samples are distances along the rays, which --fov, --hfov or --intrinsics says",
        FLAG(radial)},
    {"packing", 0, "NAME",
        "how the channels of FILE together hold the depth: @; see 'depthprec list packings'",
        ROW(packing, packings)},
    {"channel", 0, "NAME",
        "the channel to read, of an EXR by its name, of others R, G, B or A", TEXT(channel),
        .without = "the first, where red, green and blue are the same; of an EXR the first there is of Z, depth and R"},
    {"pixel", 0, "X,Y[;X,Y...]",
        "describe single pixels: code, eye depth and its range, neighbours, position, normal; 0,0 is the "
        "top left. With an effect alone: the pixel that sees the depths",
        SEVERAL(parse_pixels, pixels, 0, IMAGE_SIDE_MAX - 1)},
    {"product", 0, "KIND[:METHOD[:NORMALS]]",
        "what is made of the depths: @; position:METHOD and normal:METHOD say how, effect:NAME and pack:NAME which; "
        "NORMALS is the method of those that effect:outline compares and pack:depth-normals holds, else those that "
        "FILE holds or, for effect:outline, the scene has, else projective; see 'depthprec list products'. An effect "
        "without an image: the usable values of its parameter",
        .parse = parse_product, INTO(const product_row *, product), .names = &products},
    {"as", 0, "NAME[:NUMBERS]",
        "eye depths as another sensor or format would have stored them: the nearest levels of what --lattice has names "
        "for, which begin at 0 where nothing else is said; a PNG counts those of even:STEP",
        TEXT(as), .without = "not rounded"},
    {"picture", 0, "FILE",
        "a PNG of colours of the same size, onto which --product effect is composed as shaders do; sky then lies at "
        "the far plane unless --sky is given", FILE_READ(picture)},
    {"tint", 0, "R,G,B[,A]",
        "with --picture: the colour of the fog, line, water, ..., each part from 0 to 1", .parse = parse_tint,
        INTO(double, tint[0]), .without = "that of the effect"},
    {"hi-z", 0, "LEVEL[:nearest][:FORMAT]",
        "write a level of the conservative pyramid of the farthest depths, or of the nearest, as window depth: 0 is "
        "the image, each further one half as wide and high; in FORMAT rounded to the safe side",
        .parse = parse_hi_z, INTO(unsigned, hi_z)},
    {"normal-format", 0, NULL,
        "direction of y in a PNG of normals: up, or down", WORD(normal_format, normal_formats),
        .standard = "opengl"},
    {"error-map", 0, NULL,
        "write the error of the product instead; with =FILE, beside the product in the same pass",
        .parse = parse_error_map, INTO(const char *, error_file), .written = true, .optional = "FILE"},
    {"figure", 0, "FILE",
        "draw the product: SVG, PDF or PNG; up to 256 surfaces of a synthetic image that share a code with what is "
        "behind are marked", FILE_WRITTEN(figure)},
    {"overlay", 0, "E",
        "with --figure: depth in grey, coloured where the error of eye depth is, or may be, more than E scene units",
        POSITIVE(overlay)},
    {"histogram", 0, "FILE",
        "draw a histogram of eye depth beside the codes available there: SVG, PDF or PNG",
        FILE_WRITTEN(histogram)},
    {"eye", 0, "X,Y,Z",
        "the camera's place in the world", ORIGIN(eye), .standard = "0,0,0"},
    {"look", 0, "X,Y,Z",
        "the point that --eye looks at, y up", ORIGIN(look), .without = "along world z"},
    END};
/* clang-format on */

const option_table texture_options = {.rows = texture_rows};

/* clang-format off */
enum { TEXTURE_EFFECT = 1, TEXTURE_PLACED = 2, TEXTURE_IMAGE = 4 };
static const option_use of_effect[] = {
    OWN("at", INSTEAD("; the levels of a sensor there are those of 'depthprec table --lattice NAME --at Z'")), END};
static const option_use of_image[] = {
    TAKE("sky"), TAKE("depth-range"), TAKE("metric"), TAKE("stereo"), TAKE("lattice"), TAKE("radial"),
    TAKE("intrinsics"), TAKE("as"), TAKE("error-map"),
    TAKE("figure"),
    TAKE("hi-z"),
    GROUP_OF(figure_picture), TAKE("threads"), TAKE("packing"), TAKE("normal-format"), TAKE("channel"), TAKE("overlay"),
    OWN("range", HELP("the values of an effect that are black and white in its PNG"),
        WITHOUT("0:1, of a vector -1:1")),
    TAKE("picture"), TAKE("tint"), TAKE("histogram"), END};
static const option_use of_position[] = {
    TAKE("fov"), TAKE("hfov"),
    TAKE("eye"), TAKE("look"), TAKE("size"), TAKE("pixel"), END};

static const option_use uses[] = {
    OWN("format", WITHOUT("as the image has it; unorm24 with --synthetic; all with an effect alone")),
    OWN("matrix", ALSO(CAMERA_OF_TANGENTS "; of an image also with an oblique near plane")),
    OWN("mapping", WITHOUT("as the image has it; d3d with --synthetic; d3d and reversed with an effect alone")),
    OWN("ortho", .optional = "H", HELP("orthographic projection, H half the height of the view"),
        WITHOUT("perspective; of H 5 scene units")),
    TAKE("log-c"), TAKE("last-eye"), TAKE("last-look"), TAKE("synthetic"), TAKE("parameter"), TAKE("product"),
    FOR(TEXTURE_EFFECT | TEXTURE_PLACED, of_effect),
    FOR(TEXTURE_IMAGE, of_image), FOR(TEXTURE_PLACED | TEXTURE_IMAGE, of_position),
    OWN("output", HELP("write the product to FILE: PNG, PFM or NPY by its ending; else what is printed"),
        WITHOUT("stdout")),
    OWN("full", HELP("all columns, however wide; of an image Unity's _ZBufferParams, the condition of its matrix and "
        "what decodings are off by, too")),
    GROUP_OF(camera_projected), GROUP_OF(output_written), END};

static const option_rule rules[] = {
    CONFLICTS("product", "hi-z", ", which keeps window depth"),
    CONFLICTS("figure", "hi-z", ", which keeps window depth"),
    CONFLICTS("histogram", "hi-z", ", which keeps window depth"),
    CONFLICTS("pixel", "hi-z", ", which keeps window depth"),
    CONFLICTS("metric", "hi-z", ", which keeps window depth"),
    CONFLICTS("stereo", "hi-z", ", which keeps window depth"),
    CONFLICTS("radial", "hi-z", ", which keeps window depth"),
    CONFLICTS("csv", "hi-z", ", which keeps window depth"),
    CONFLICTS("as", "hi-z", ", which keeps window depth"),
    CONFLICTS("error-map", "hi-z", ", which keeps window depth"),
    CONFLICTS("metric", "stereo", ", which makes depths of disparities"),
    CONFLICTS("packing", "stereo", NULL),
    CONFLICTS("lattice", "stereo", ", whose step it is"),
    CONFLICTS("radial", "stereo", ", which gives depths along the view axis"),
    CONFLICTS("ortho", "stereo", ", whose camera is a perspective one"),
    CONFLICTS("matrix", "stereo", ", whose focal length says the angle; --intrinsics says the rest"),
    CONFLICTS("fov", "stereo", ", whose focal length says it"),
    CONFLICTS("hfov", "stereo", ", whose focal length says it"),
    NEEDS("radial", "metric", NULL),
    NEEDS("lattice", "metric", NULL),
    CONFLICTS("metric", "packing", NULL),
    NEEDS("tint", "picture", NULL),
    CONFLICTS("histogram", "pixel", NULL),
    CONFLICTS("matrix", "intrinsics log-c", NULL),
    {.option = NULL}};
/* clang-format on */

static const option_place places[] = {CAMERA_PLACES(texture_request),
                                      PLACE(texture_request, figure, figure_options),
                                      PLACE(texture_request, image, texture_options),
                                      {.table = NULL}};

static const command_part parts[] = {{"to an effect without FILE", TEXTURE_EFFECT},
                                     {"to an effect without FILE that needs positions", TEXTURE_PLACED},
                                     {"with FILE or --synthetic", TEXTURE_IMAGE},
                                     {NULL, 0}};

static size_t asked_part(const void *request) {
    const texture_request *o = request;
    const effect_row *effect = o->image.effect;
    if (effect == NULL || o->line->operand_count > 0 || o->image.synthetic != NULL)
        return 2;
    return (effect->needs & EFFECT_POSITION) != 0;
}

static int complete(void *request) {
    texture_request *o = request;
    const effect_row *effect = o->image.effect;
    o->camera.spec.width = o->image.size[0];
    o->camera.spec.height = o->image.size[1];
    const int status = camera_complete(&o->camera, &(camera_use){.imaged = asked_part(o) == 2});
    if (status == EXIT_FINE && effect != NULL && effect->eye01 && o->camera.znear < 0.0)
        return option_error("product",
                            "effect:%s sees eye depth as a share of far, which needs near not less than 0, got '%s'",
                            effect->name, number_full(o->camera.znear).text);
    return status;
}

/* clang-format off */
const command_row command_texture = {
    .name = "texture", .request = sizeof(texture_request), .places = places, .uses = uses, .rules = rules,
    .complete = complete,
    .operand = "[FILE]", .operand_min = 0, .operand_max = 1,
    .summary = "a depth image: depths, positions, normals, effects, errors",
    .example = "  depthprec texture depth.png -n 0.3 -f 1000\n"
    "  capture | depthprec texture - -n 0.3 -f 1000\n"
    "  depthprec texture depth.png -n 0.3 -f 1000 --pixel 320,180\n"
    "  depthprec texture depth.png -f 1000 --product normal:high -o normals.npy\n"
    "  depthprec texture --synthetic decals --parameter gap=0.01 -F d24 -m reversed\n",
    .files_from = 1,
    .part = asked_part, .parts = parts};
/* clang-format on */
