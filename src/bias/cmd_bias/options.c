/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command bias and its options. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bias/cmd_bias/request.h"
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "report/output.h"

static const name_list apis = {.words = (const char *const[]){"all", NULL}, .rows = &bias_api_table};

const bias_api *bias_asked_api(const bias_asked *b, size_t index) {
    size_t i = 0;
    while (bias_api_get(i) != NULL && ((b->apis >> i & 1U) == 0 || index-- > 0))
        i++;
    return bias_api_get(i);
}

static int add_api(asked_line *line, const option_row *row, const char *name, void *group) {
    bias_asked *o = group;
    (void)line;
    list_item found;
    if (!names_find(row->names, name, NULL, &found))
        return option_unknown(row, name);
    for (size_t i = 0; bias_api_get(i) != NULL; i++)
        if (found.row == NULL || found.row == bias_api_get(i))
            o->apis |= 1U << i;
    return EXIT_FINE;
}

/* One is named, however often; of several there is no one. */
static int parse_apis(asked_line *line, const option_row *row, const char *value, void *group) {
    bias_asked *o = group;
    o->apis = 0;
    const int status = parse_names(line, row, value, group, add_api);
    o->api = bias_asked_api(o, 1) == NULL ? bias_asked_api(o, 0) : NULL;
    return status;
}

/* Some engines set an infinite one, of either sign. */
static int parse_units(asked_line *line, const option_row *row, const char *value, void *group) {
    double endless;
    if (!number_parse(*value == '-' ? value + 1 : value, NUMBER_FAR, &endless) || !isinf(endless))
        return parse_number(line, row, value, group);
    *(double *)option_field(row, group) = *value == '-' ? -endless : endless;
    return EXIT_FINE;
}

#define GROUP_TYPE bias_asked

/* clang-format off */
static const option_row bias_rows[] = {
    {"api", 0, "NAME[,NAME...]",
        "the API whose depth-bias rule applies: @; several, or all, are compared, each with its call. It brings its "
        "mapping, and the format of its windows, where they are not given",
        .parse = parse_apis, INTO(unsigned, apis), .names = &apis, .standard = "d3d11",
        .group = "The bias"},
    {"units", 0, "U",
        "constant bias in units of r, a whole number for d3d11, d3d12 and webgpu; in window depth for d3d9 and "
        "vulkan-float; inf or -inf as a program sets it that casts it",
        .parse = parse_units, INTO(double, units), LIMITS(-1e12, 1e12, NULL),
        .without = "the units needed", .also = "polygonOffsetUnits depthBias depthBiasConstantFactor DepthBias "
        "depth_bias zOffsetUnits"},
    {"factor", 0, "F",
        "bias in units of the window slope", NUMBER(factor, -1e12, 1e12, NULL), .standard = "0",
        .also = "polygonOffsetFactor depthBiasSlopeScale depthBiasSlopeFactor SlopeScaledDepthBias slopeDepthBias "
        "slopeScale slope_scale zOffset"},
    {"clamp", 0, "C",
        "greatest bias, or least when negative, in window depth", NUMBER(clamp, -1e12, 1e12, NULL),
        .standard = "0", .without = "none", .also = "depthBiasClamp DepthBiasClamp"},
    {"slope", 0, "S",
        "change of eye depth from one pixel to the next", LENGTH(slope, 0, 1e12, "scene units per pixel"),
        .standard = "0", .without = "facing the camera"},
    {"separation", 0, "S",
        "how much nearer the bias must bring a layer, in scene units", POSITIVE(separation),
        .without = "until it is resolved"},
    END};

static const name_list remedies = {.rows = &remedy_table};

/* NAME, or NAME:X where it has a number. */
static int parse_remedy(asked_line *line, const option_row *row, const char *value, void *group) {
    bias_request *o = group;
    list_item found;
    const char *x;
    (void)line;
    if (option_read_named(row, value, &found, &x) != EXIT_FINE)
        return EXIT_USAGE;
    o->remedy = found.row;
    const bool numbered = o->remedy->amount[0] != '\0';
    if (!numbered && x == NULL)
        return EXIT_FINE;
    if (!numbered)
        return option_refuse(row, "must be %s, which has no number, got '%s'", o->remedy->name, value);
    if (x == NULL || !number_parse(x, NUMBER_FINITE, &o->amount) ||
        !(o->amount >= o->remedy->least && o->amount <= o->remedy->most))
        return option_refuse(row, "must be %s:X, X from %g to %g (%s), got '%s'", o->remedy->name, o->remedy->least,
                             o->remedy->most, o->remedy->amount, value);
    return EXIT_FINE;
}

#undef GROUP_TYPE
#define GROUP_TYPE bias_request
static const option_row check_rows[] = {
    {"check", 0, NULL,
        "exit with status 1 unless the bias is enough all over the range, at the slants asked about, too",
        FLAG(checked)},
    {"remedy", 0, "NAME:X",
        "in place of a bias: another means, and its number, judged as a bias is: @",
        .parse = parse_remedy, INTO(const remedy *, remedy), .names = &remedies, .without = "a bias"},
    {"rasterize", 0, NULL,
        "also draw random planes at any slant, or of --slope, by --raster: how many pixels fight, and one that does",
        FLAG(drawn)},
    {"render", 0, "FILE",
        "with --rasterize: write a PNG of the plane where most pixels fight, which are yellow; the layer is blue",
        FILE_WRITTEN(render)},
    END};
/* clang-format on */

const option_table bias_options = {.rows = bias_rows};
static const option_table check_options = {.rows = check_rows};

/* Sets an option that nobody has given, and remembers who chose it. */
static void bring(asked_line *line, const bias_asked *b, const char *option, const char *value) {
    const char *const chosen[] = {option, NULL};
    if (value == NULL || option_given(line, option))
        return;
    option_chosen(line, "api", bias_asked_api(b, 0)->name, chosen);
    option_set(line, option, value);
}

static const char *common(const char *a, const char *b) {
    return a != NULL && b != NULL && strcmp(a, b) == 0 ? a : NULL;
}

void bias_bring(asked_line *line, const bias_asked *b, camera_asked *camera, bool window) {
    if (!option_given(line, "api") || camera->preset_count > 0 || camera->platform != NULL)
        return;
    const bias_api *api = bias_asked_api(b, 0);
    const char *mapping = api->mapping, *format = api->format;
    for (size_t i = 1; (api = bias_asked_api(b, i)) != NULL; i++) {
        mapping = common(mapping, api->mapping);
        format = common(format, api->format);
    }
    bring(line, b, "mapping", mapping);
    camera->mapping_brought = mapping != NULL && !option_given(line, "mapping");
    bring(line, b, "format", window ? format : NULL);
}

int bias_complete(asked_line *line, const camera_asked *camera) {
    const char *api = camera_api(camera);
    return api == NULL || option_given(line, "api") ? EXIT_FINE : option_set(line, "api", api);
}

/* clang-format off */
const option_use bias_brought[] = {
    OWN("preset", ALSO("for a bias also the API of its users; " CAMERA_OF_VIEW)),
    OWN("platform", ALSO("for a bias also its API; with --viewport also its rasterizer")), END};

static const option_use uses[] = {
    ROWS(bias_rows), ROWS(check_rows), GROUP_OF(bias_brought),
    OWN("format", DEFAULT("fp32")),
    TAKE("at"), TAKE("range"), TAKE("log-c"), TAKE("depth-range"), TAKE("link"),
    OWN("viewport", WITHOUT("surfaces face the camera; 1920x1080 with --rasterize")),
    OWN("raster", HELP("the rasterizer or specification, as in 'depthprec list rasterizers', or the profile of a GPU; "
        "with --rasterize one that draws: llvmpipe, lavapipe, softpipe or swiftshader"),
        WITHOUT("llvmpipe with --rasterize")),
    OWN("full", HELP("all columns, however wide; and where a biased depth is clamped")),
    GROUP_OF(camera_slanted), GROUP_OF(camera_projected), GROUP_OF(output_written), END};

static const option_rule rules[] = {
    CONFLICTS("remedy", "api units factor clamp viewport raster rasterize", ", which are of a bias"),
    CONFLICTS("csv", "rasterize", ", which text and JSON tell of"),
    NEEDS("check", "units remedy", ": it is a bias that is judged"),
    NEEDS("rasterize", "units", ": it is a bias that is drawn"),
    NEEDS("render", "rasterize", NULL),
    {.option = NULL}};
/* clang-format on */

static const command_word words[] = {
    {"sortPriority sortOrder sortingOrder sortKey renderOrder render_priority renderPriority renderQueue drawOrder "
     "zIndex alphaIndex translucencySortPriority",
     "it says what is drawn first, and moves no depth: --units does, and --remedy stencil needs none"},
    {"polygonOffset glPolygonOffset offset", "it has two numbers, in this order: --factor F --units U"},
    {NULL, NULL}};

static const option_place places[] = {
    CAMERA_PLACES(bias_request), PLACE(bias_request, bias, bias_options), OWN_PLACE(check_options), {.table = NULL}};

static int complete(void *request) {
    bias_request *o = request;
    bias_bring(o->line, &o->bias, &o->camera, true);
    const int status = camera_complete(&o->camera, &(camera_use){.measured = true, .drawn = o->drawn});
    return status == EXIT_FINE ? bias_complete(o->line, &o->camera) : status;
}

/* clang-format off */
const command_row command_bias = {
    .name = "bias", .request = sizeof(bias_request), .places = places, .uses = uses, .rules = rules,
    .complete = complete, .words = words, .operand = "",
    .summary = "what a depth bias does and how much is needed, per API",
    .example = "  depthprec bias --api gl -F d24 -m gl --units -1 --at 1,10,100\n"
    "  depthprec bias --api all --separation 0.02 --at 300\n"
    "  depthprec bias --api webgpu -F depth24plus --separation 0.01 --range 1:100\n"
    "  depthprec bias -F d24 -m gl --remedy ndc:1e-5 --at 20,500\n"
    "  depthprec bias --preset bevy --api vulkan --units 4 --factor 1 --slope 0.02\n"};
/* clang-format on */
