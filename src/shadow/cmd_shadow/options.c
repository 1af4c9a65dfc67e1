/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command shadow and its options. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/list.h"
#include "cli/option/kinds.h"
#include "core/append.h"
#include "report/output.h"
#include "shadow/cmd_shadow/request.h"
#include "shadow/engine.h"
#include "shadow/filter.h"
#include "shadow/shadow.h"

/* N, or N:LAMBDA. */
static int parse_cascades(asked_line *line, const option_row *row, const char *value, void *group) {
    shadow_asked *o = group;
    (void)line;
    enum { MOST = 8 }; /* as many as a figure has panels */
    const size_t length = strcspn(value, ":");
    char number[8];
    uint64_t count;
    snprintf(number, sizeof number, "%.*s", (int)length, value);
    if (length >= sizeof number || !number_parse_count(number, MOST, &count) || count < 1 ||
        (value[length] != '\0' &&
         (!number_parse(value + length + 1, NUMBER_FINITE, &o->lambda) || !(o->lambda >= 0.0 && o->lambda <= 1.0))))
        return option_refuse(row, "must be N or N:LAMBDA, N a whole number from 1 to %d, LAMBDA from 0 to 1, got '%s'",
                             MOST, value);
    o->cascades = (unsigned)count;
    return EXIT_FINE;
}

/* Z, or Z:FACET. */
static int parse_curvature(asked_line *line, const option_row *row, const char *value, void *group) {
    shadow_asked *o = group;
    const size_t split = strcspn(value, ":");
    length_reader seen = {.in = line->lengths};
    const bool faceted = value[split] != '\0';
    double radius, facet = 0.0;
    if (!length_read(&seen, value, split, NUMBER_FINITE, &radius) || !(radius >= 1e-12 && radius <= 1e18) ||
        (faceted && (!length_read(&seen, value + split + 1, strlen(value + split + 1), NUMBER_FINITE, &facet) ||
                     !(facet >= 0.0 && facet <= 1e18))))
        return option_refuse(row, "must be Z or Z:FACET, Z from 1e-12 and FACET from 0 to 1e18 scene units, got '%s'%s",
                             value, length_hint(value, split));
    o->curvature = radius;
    o->facet = facet;
    return length_check_mixed(&seen, row, value);
}

/* FORMAT:MAPPING or FORMAT:MAPPING:FAR. */
static int parse_camera_depth(asked_line *line, const option_row *row, const char *value, void *group) {
    shadow_asked *o = group;
    char text[80] = "", *rest = NULL;
    append(text, sizeof text, "%s", value);
    const char *format = strtok_r(text, ":", &rest), *mapping = strtok_r(NULL, ":", &rest);
    const char *far = strtok_r(NULL, "", &rest);
    dp_spec *camera = &o->camera;
    dp_format formats[2];
    if (mapping == NULL || dp_format_parse(format, formats) != 1 ||
        dp_mapping_parse(mapping, &camera->mapping) != DP_OK ||
        dp_mapping_get(camera->mapping)->curve != DP_CURVE_PERSPECTIVE)
        return option_refuse(
            row, "must be FORMAT:MAPPING[:FAR], MAPPING one of " DP_MAPPING_NAMES_PERSPECTIVE ", got '%s'", value);
    camera->format = formats[0];
    camera->zfar = 0.0;
    return far != NULL ? camera_read_far(line, row, far, &camera->zfar) : EXIT_FINE;
}

static const name_list filters = {.rows = &shadow_filter_table};

/* NAME, or NAME:X where it has a number: sets --kernel to a whole number that covers it. */
static int parse_filter(asked_line *line, const option_row *row, const char *value, void *group) {
    shadow_asked *o = group;
    list_item found;
    const char *x;
    double number = 0.0;
    (void)line;
    if (option_read_named(row, value, &found, &x) != EXIT_FINE)
        return EXIT_USAGE;
    const shadow_filter *f = found.row;
    const bool numbered = f->amount[0] != '\0';
    if (f->instead[0] != '\0')
        return option_refuse(row, "must be a filter that compares depths, got '%s': %s", f->name, f->instead);
    if (!numbered && x != NULL)
        return option_refuse(row, "must be %s, which has no number, got '%s'", f->name, value);
    if (numbered && (x == NULL || !number_parse(x, NUMBER_FINITE, &number) ||
                     !(number >= f->least && number <= f->most) || (f->whole && number != floor(number))))
        return option_refuse(row, "must be %s:%s, %s %s from %g to %g, got '%s'", f->name, f->amount, f->amount,
                             f->whole ? "a whole number" : "a number", f->least, f->most, value);
    o->filter = (unsigned)ceil(2.0 * shadow_filter_radius(f, number));
    return EXIT_FINE;
}

static const name_list engines = {.rows = &shadow_engine_table};

static int add_engine(asked_line *line, const option_row *row, const char *name, void *group) {
    shadow_asked *o = group;
    (void)line;
    list_item found;
    if (strchr(name, ':') != NULL)
        return option_refuse(row, "takes names alone, got '%s': numbers are those of --bias and --normal-bias", name);
    if (!names_find(row->names, name, NULL, &found))
        return option_unknown(row, name);
    const shadow_engine *engine = found.row;
    if (engine->instead[0] != '\0')
        return option_refuse(row, "must be an engine whose numbers are known in depth, got '%s': %s", engine->name,
                             engine->instead);
    o->engine = o->engine != NULL ? o->engine : found.row;
    for (size_t i = 0; shadow_engine_get(i) != NULL; i++)
        if (found.row == shadow_engine_get(i))
            o->engines |= 1U << i;
    return EXIT_FINE;
}

static int parse_engines(asked_line *line, const option_row *row, const char *value, void *group) {
    shadow_asked *o = group;
    o->engines = 0;
    o->engine = NULL;
    return parse_names(line, row, value, group, add_engine);
}

static void begin(asked_line *line, void *group) {
    shadow_asked *o = group;
    (void)line;
    o->curvature = o->bias = o->normal_bias = (double)NAN;
}

#define GROUP_TYPE shadow_asked

/* clang-format off */
static const option_row shadow_rows[] = {
    {"cascades", 0, "N[:LAMBDA]",
        "number of shadow maps, 1 to 8, that cover the view from near to far; LAMBDA 0 splits it uniformly, 1 "
        "logarithmically",
        .parse = parse_cascades, SIZED(cascades), .standard = "4:0.5", .group = "The shadow map"},
    {"light-box", 0, "WxHxD",
        "one shadow map of a box: width, height, and depth along the light", .parse = parse_box,
        INTO(double, light_box[0]),
        .without = "cascades of the view"},
    {"spot", 0, "DEG",
        "one shadow map in perspective of a spot light, DEG the angle across it",
        NUMBER(spot, 0.001, 170, "degrees"), .without = "cascades of the view"},
    {"point", 0, NULL,
        "six shadow maps of a point light, the faces of a cube", FLAG(point)},
    {"distance", 0, NULL,
        "with --spot or --point: a fragment shader writes (distance - near)/(far - near) in place of the depth",
        FLAG(distance)},
    {"casters", 0, "Z",
        "how far towards the light from a cascade casters are included",
        LENGTH(casters, 0, 1e12, "scene units"), .standard = "100"},
    {"kernel", 0, "N",
        "the filter reads NxN texels: 1 nearest, 2 bilinear, 3 and more percentage-closer filtering",
        WHOLE(kernel, 1, 64, "texels"), .standard = "3"},
    {"filter", 0, "NAME[:X]",
        "in place of --kernel: a filter by name, with its number of taps or radius in texels: @",
        .parse = parse_filter, SIZED(filter), .names = &filters, .without = "--kernel"},
    {"angle", 0, "DEG",
        "receivers stay free of acne up to this angle between their normal and the light",
        NUMBER(angle, 0, SHADOW_SLANT_MAX, "degrees"), .standard = "75"},
    {"curvature", 0, "Z[:FACET]",
        "receivers curve away from the light with a radius of at least Z; tessellated into triangles of circumradius "
        "FACET or less, or smooth", .parse = parse_curvature, INTO(double, curvature), .without = "flat"},
    {"camera-depth", 0, "FORMAT:MAPPING[:FAR]",
        "screen-space shadows: receivers are rebuilt from the camera's depth texture in this format and mapping, of "
        "the view's near plane and FAR, else --far", .parse = parse_camera_depth, INTO(dp_spec, camera)},
    {"engine", 0, "NAME[,NAME...]",
        "whether the bias of an engine is enough, in its own numbers: @; those of others do the same where receivers "
        "are nearest", .parse = parse_engines, INTO(unsigned, engines), .names = &engines},
    {"bias", 0, "B",
        "with --engine: its bias", NUMBER(bias, -1e12, 1e12, NULL), .without = "the engine's default",
        .also = "shadow_depth_bias shadowBias shadow_bias constantBias"},
    {"normal-bias", 0, "N",
        "with --engine: its normal bias", NUMBER(normal_bias, 0, 1e12, NULL), .without = "the engine's default",
        .also = "normalBias shadow_normal_bias"},
    {"check", 0, NULL,
        "with --engine: exit with status 1 unless its bias is enough up to --angle, in every map", FLAG(checked)},
    {"rasterize", 0, NULL,
        "also draw random planes and casters into the map by --raster, and look their points up: how many have acne "
        "without a bias, or with the engine's, and with each that is enough; and how many lose their shadow",
        FLAG(drawn)},
    {"render", 0, "FILE",
        "with --rasterize: write a PNG of one plane and its casters with each bias in turn; acne is black, a lost "
        "shadow yellow", FILE_WRITTEN(render)},
    {"from-origin", 0, "R",
        SHADOW_FROM_ORIGIN, LENGTH(world, 0, 1e18, "scene units"), .standard = "0", .without = SHADOW_FROM_ORIGIN_OUT},
    END};
/* clang-format on */

static const option_rule shadow_rules[] = {CONFLICTS("spot", "point", NULL),
                                           CONFLICTS("light-box", "spot point", NULL),
                                           CONFLICTS("filter", "kernel", NULL),
                                           NEEDS("bias", "engine", NULL),
                                           NEEDS("check", "engine", ": it is its bias that is judged"),
                                           NEEDS("normal-bias", "engine", NULL),
                                           NEEDS("render", "rasterize", NULL),
                                           CONFLICTS("rasterize", "distance", ", which a fragment shader writes"),
                                           CONFLICTS("rasterize", "curvature", ": it draws planes"),
                                           CONFLICTS("rasterize", "arith", ": the rasterizer has its own"),
                                           CONFLICTS("distance", "api", ": no API biases what a shader writes"),
                                           {.option = NULL}};

const option_table shadow_options = {.rows = shadow_rows, .begin = begin, .rules = shadow_rules};

/* clang-format off */
static const option_row size_rows[] = {
    {"size", 0, "WxH|N",
        "texels of each shadow map; N is NxN", .parse = parse_size_or_n, INTO(uint32_t, size[0]),
        .standard = "2048x2048", .instead = "; a figure's size is --figure-size"},
    END};
/* clang-format on */

const option_table shadow_size_options = {.rows = size_rows};

/* clang-format off */
const option_use shadow_map_uses[] = {
    TAKE("size"), TAKE("light-box"), TAKE("kernel"), TAKE("angle"), END};
const option_use shadow_cascade_uses[] = {TAKE("cascades"), TAKE("casters"), END};
enum { PART_CASCADES = 1 << SHADOW_CASCADED, PART_BOX = 1 << SHADOW_BOXED, PART_PLACE = 1 << SHADOW_PLACED };
static const option_use of_planes[] = {
    OWN("near", HELP("near plane of the view, or of a light that has a place"), DEFAULT("0.1")),
    OWN("far", HELP("shadow distance, greater than near and at most 1e12 scene units; with --spot or --point the far "
        "plane of the map, or inf"), DEFAULT("1000")), END};
static const option_use of_cascades[] = {
    TAKE("fov"), TAKE("hfov"),
    OWN("viewport", HELP("size of the view in pixels; sets its aspect ratio"), DEFAULT("1920x1080")),
    TAKE("camera-depth"), GROUP_OF(shadow_cascade_uses), END};
static const option_use of_ranges[] = {
    OWN("range", HELP("where receivers lie: with --light-box along the light from the front of the box, with --spot "
        "and --point their depths in front of the light, or distances from it"),
        WITHOUT("the whole box, less 1/256 where units have no effect at window depth 0; or near to far, less an "
        "octave there")), END};
static const option_use of_place[] = {
    OWN("at", HELP("with --spot or --point: the depths or distances shown, up to 16"),
        WITHOUT("five, log-spaced")), TAKE("distance"), END};
static const option_use of_flat[] = {TAKE("curvature"), END};

static const option_use uses[] = {
    TAKE("from-origin"), TAKE("filter"),
    OWN("format", DEFAULT("fp32")), OWN("mapping", HELP(CAMERA_PERSPECTIVE), DEFAULT("d3d")),
    CAMERA_UNIT_ALONE,
    OWN("arith", ALSO("by default that of --raster where known")),
    FOR(PART_CASCADES | PART_PLACE, of_planes), FOR(PART_CASCADES, of_cascades),
    FOR(PART_BOX | PART_PLACE, of_ranges), FOR(PART_PLACE, of_place), FOR(PART_CASCADES | PART_BOX, of_flat),
    GROUP_OF(shadow_map_uses), TAKE("spot"), TAKE("point"), TAKE("engine"), TAKE("bias"), TAKE("check"),
    TAKE("normal-bias"), TAKE("rasterize"), TAKE("render"),
    OWN("raster", ALSO("with --rasterize one that draws: llvmpipe, lavapipe, softpipe or swiftshader; by default "
        "llvmpipe")), TAKE("subpixel"), TAKE("triangle-class"), TAKE("api"),
    GROUP_OF(output_written), END};
/* clang-format on */

static const option_place places[] = {CAMERA_PLACES(shadow_request),
                                      PLACE(shadow_request, shadow, shadow_options),
                                      PLACE(shadow_request, shadow, shadow_size_options),
                                      PLACE(shadow_request, bias, bias_options),
                                      {.table = NULL}};

/* A figure's data tell of an engine in CSV, too. */
static const option_rule rules[] = {CONFLICTS("csv", "engine rasterize", ", which text and JSON tell of"),
                                    {.option = NULL}};

static const command_part parts[] = {
    {"to cascades", PART_CASCADES}, {"with --light-box", PART_BOX}, {"with --spot or --point", PART_PLACE}, {NULL, 0}};

size_t shadow_part_asked(const asked_line *line) {
    return option_given(line, "light-box")                             ? SHADOW_BOXED
           : option_given(line, "spot") || option_given(line, "point") ? SHADOW_PLACED
                                                                       : SHADOW_CASCADED;
}

static size_t asked_part(const void *request) {
    return shadow_part_asked(((const shadow_request *)request)->line);
}

static int complete(void *request) {
    shadow_request *o = request;
    if (o->shadow.drawn && !option_given(o->line, "raster"))
        option_set(o->line, "raster", "llvmpipe");
    bias_bring(o->line, &o->bias, &o->camera, false);
    if (o->shadow.filter > 0)
        o->shadow.kernel = o->shadow.filter;
    return camera_complete(&o->camera, &(camera_use){.mapped = true});
}

/* An edge is seen as a great circle, and drawn in the paraboloid, a disc of SIZE texels, as a circle of at least that
 * radius: over a chord of N texels it rises by N^2/(4 SIZE) of them. */
static const command_word words[] = {
    {"paraboloid paraboloids dual-paraboloid dualParaboloid",
     "paraboloids bend edges, and triangles are drawn with straight ones: at the rim an edge of N texels is about "
     "N^2/(4 SIZE) of them off, of which no bias follows; --point takes the six faces of a cube"},
    {"matrix",
     "a light's orthographic one is --light-box WxHxD, 2/m00 by 2/m11 by far - near, one in perspective --spot DEG, "
     "twice the arc tangent of 1/m00; of the view it is --near, --far and --fov"},
    {NULL, NULL}};

/* clang-format off */
const command_row command_shadow = {
    .name = "shadow", .request = sizeof(shadow_request), .places = places, .uses = uses,
    .complete = complete, .rules = rules, .words = words, .operand = "",
    .summary = "shadow maps: the bias that prevents acne, and its gap",
    .example = "  depthprec shadow -n 0.1 -f 150 --size 2048 --unit m\n"
    "  depthprec shadow --light-box 40x40x200 -F d16 --kernel 5 --angle 70 --api gl\n"
    "  depthprec shadow -f 300 --cascades 3:0.8 --api all\n"
    "  depthprec shadow --spot 90 -n 0.5 -f 20 --size 1024 --engine three,bevy --bias -0.001\n"
    "  depthprec shadow --spot 60 -n 0.5 -f 50 --range 2:40 --size 1024 -F d16\n"
    "  depthprec plot shadow -f 150 -o shadow.svg\n",
    .part = asked_part, .parts = parts};
/* clang-format on */
