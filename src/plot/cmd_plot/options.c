/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command plot and its options. */
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "plot/cmd_plot/request.h"
#include "plot/figure.h"
#include "report/output.h"

static const name_list figures = {.rows = &figure_table};

/* clang-format off */
/* The figures: those of set-ups, and those of a model, of shadow maps and of a requirement file, whose options are
 * those of their own commands. */
enum { SLANTED = FIGURE_SLANTED | FIGURE_MODEL, VIEWED = SLANTED | FIGURE_DRAWN | FIGURE_SHADOW };
#define FARS OWN("far", .argument = "Z|inf[,Z...]", \
    ALSO("several in the figure linear01, where it is 20 by default"), .parse = parse_fars)
static const option_use of_fars[] = {OWN("near", DEFAULT("1")), OWN("far", .argument = "Z[,Z...]", DEFAULT("20"),
    HELP("distance of the far plane; several are drawn together"), .parse = parse_fars), TAKE("preset"),
    TAKE("mapping"), TAKE("log-c"), END};
static const option_use of_small[] = {OWN("near", DEFAULT("1")),
    OWN("far", .argument = "Z|inf[,Z...]", DEFAULT("20"), .parse = parse_fars),
    OWN("format", DEFAULT("unorm4,float3.3b5")), END};
static const option_use of_methods[] = {TAKE("format"), TAKE("mapping"), END};
static const option_use of_planes[] = {TAKE("near"), TAKE("far"), TAKE("ortho"), END};
static const option_use of_cameras[] = {TAKE("near"), FARS, OWN("format", ALSO(CAMERA_OF_RG)), TAKE("mapping"), END};
static const option_use of_setups[] = {
    OWN("near", ALSO("with --ortho also 0 or negative; in linear01 1 by default")), TAKE("ortho"), OWN("tolerance",
        WITHOUT("5% for the model; intervals are as exact as the picture shows")),
    OWN("model", DEFAULT("exact"), WITHOUT("what is guaranteed, over the lattice, in error and interval; float in "
        "figures of its pipeline; staged in distribution and share with gl and gl-reversed")), END};
static const option_use of_setups_and_models[] = {
    OWN("matrix", ALSO(CAMERA_OF_TANGENTS)),
    OWN("preset", ALSO(CAMERA_OF_VIEW)), OWN("platform", ALSO("with --viewport also its rasterizer")), TAKE("rounding"),
    OWN("arith", ALSO("by default that of --raster or --platform where known")),
    TAKE("log-c"), END};
static const option_use of_one_depth[] = {
    OWN("at", HELP("the depth, in figures of a single one"), WITHOUT("")), END};
static const option_use of_cost[] = {OWN("at", WITHOUT("a tenth of far")),
    OWN("mapping", WITHOUT("all that the projection and far allow, of engines none")), END};
static const option_use of_axes[] = {TAKE("beside"), TAKE("axes"), END};
static const option_use of_ranges[] = {
    OWN("range", HELP("the depths shown"), WITHOUT("near to far, or to 1e6 times near")), END};
static const option_use of_moved[] = {TAKE("depth-range"), END};
static const option_use of_scene[] = {OWN("format", DEFAULT("fp32")), OWN("mapping", DEFAULT("reversed")),
    OWN("angle", HELP(SCENE_ANGLE), DEFAULT("1")), GROUP_OF(scene_model), END};
static const option_use of_shadow[] = {OWN("format", DEFAULT("fp32")), OWN("mapping", DEFAULT("d3d")),
    OWN("viewport", HELP("size of the view in pixels; sets its aspect ratio"), DEFAULT("1920x1080")),
    OWN("from-origin", HELP(SHADOW_FROM_ORIGIN), DEFAULT("0"), WITHOUT(SHADOW_FROM_ORIGIN_OUT)),
    TAKE("spot"), TAKE("point"), TAKE("distance"), TAKE("engine"), TAKE("bias"), TAKE("normal-bias"),
    GROUP_OF(shadow_map_uses), GROUP_OF(shadow_cascade_uses), END};
static const option_use of_fight[] = {OWN("slant", .argument = "SLANT,AZIMUTH", .parse = parse_slant_or_plane,
    DEFAULT("60,45"),
    HELP("the angle between the planes' normal and the view axis, and its direction on the screen, degrees, 0 right "
        "and 90 up")), END};
static const option_use of_views[] = {
    OWN("viewport", HELP("the viewport in pixels; budget and interval then include slanted triangles"),
        WITHOUT("1920x1080 in fight and shadow, else surfaces face the camera")), GROUP_OF(camera_beside_viewport),
        END};
static const option_use of_slants[] = {OWN("slant",
    ALSO("in fight SLANT,AZIMUTH, by default 60,45: one angle, and the direction of the normal on the screen, 0 right "
        "and 90 up")), END};

static const option_use uses[] = {
    FOR(FIGURE_SMALL, of_small), FOR(FIGURE_COST, of_cost),
    FOR(FIGURE_MODEL, of_scene), FOR(FIGURE_SHADOW, of_shadow), FOR(FIGURE_DRAWN, of_fight),
    FOR(FIGURE_TERMS, origin_terms), FOR(FIGURE_MINE, judge_mine),
    FOR(FIGURE_SETUPS, of_setups), FOR(FIGURE_SETUPS | FIGURE_MODEL, of_setups_and_models),
    FOR(FIGURE_SETUPS | FIGURE_MODEL | FIGURE_SHADOW, of_cameras),
    FOR(FIGURE_RANGED, of_moved), FOR(FIGURE_METHODS, of_methods), FOR(FIGURE_TIMED, of_planes),
    FOR(FIGURE_FARS, of_fars), FOR(FIGURE_AT, of_one_depth),
    FOR(FIGURE_SETUPS | FIGURE_SHADOW | FIGURE_FILE | FIGURE_FARS, of_ranges),
    FOR(VIEWED, of_views), FOR(SLANTED, of_slants), TAKE("unit"), GROUP_OF(figure_picture),
    FOR(FIGURE_BESIDE, of_axes), TAKE("link"),
    OWN("output", HELP("draw to FILE: SVG, PDF or PNG by its ending; - is stdout, as --type says; the numbers of "
        "--json and --csv go to stdout, or to a FILE of another ending"), WITHOUT("")),
    TAKE("json"), TAKE("csv"), TAKE("quiet"), TAKE("color"),
    OWN("full", HELP("also say how many values were computed")), END};

static const option_rule rules[] = {
    NEEDS("define", "mine", ", a function of yours"),
    CONFLICTS("at", "range", NULL),
    {.option = NULL}};
/* clang-format on */

static const option_place places[] = {CAMERA_PLACES(plot_request),
                                      PLACE(plot_request, figure, figure_options),
                                      PLACE(plot_request, origin, origin_options),
                                      PLACE(plot_request, shadow, shadow_options),
                                      PLACE(plot_request, shadow, shadow_size_options),
                                      PLACE(plot_request, scene, scene_eye_options),
                                      PLACE(plot_request, scene, scene_options),
                                      PLACE(plot_request, judge, judge_options),
                                      PLACE(plot_request, bias, bias_options),
                                      {.table = NULL}};

/* A figure is a part of plot. */
static size_t asked_part(const void *request) {
    const plot_request *o = request;
    size_t i = 0;
    while (figure_get(i) != o->line->operand_row)
        i++;
    return i;
}

static bool part_get(size_t index, command_part *out) {
    const figure_row *figure = figure_get(index);
    if (figure != NULL)
        *out = (command_part){figure->name, figure->takes};
    return figure != NULL;
}

static int complete(void *request) {
    plot_request *o = request;
    const figure_row *figure = o->line->operand_row;
    const bool compared = (figure->takes & FIGURE_SETUPS) != 0;
    return camera_complete(&o->camera,
                           &(camera_use){.mapped = true, .compared = compared, .seen = scene_is_seen(o->line)});
}

/* clang-format off */
const command_row command_plot = {
    .name = "plot", .request = sizeof(plot_request), .places = places, .uses = uses, .rules = rules,
    .complete = complete, .part_get = part_get, .part_of = "to the figure ",
    .operand = "FIGURE [FILE|FAMILY]", .operand_min = 1, .operand_max = 2, .names = &figures,
    .summary = "a figure: SVG, PDF or PNG by the ending of -o, or --type",
    .example = "  depthprec plot error -F all -m d3d,reversed -o error.svg\n"
    "  depthprec plot error -F fp32 -m d3d,reversed -o - --type png >error.png\n"
    "  depthprec plot distribution -F unorm4 -n 1 -f 10 -o staircase.png --theme dark\n"
    "  depthprec plot fight -F fp32 -m reversed --at 500 -o fight.svg\n"
    "  depthprec plot needs engine.need -o needs.svg\n"
    "  depthprec plot scene house.glb -F d24 -m d3d -o house.svg\n",
    .files_from = 2, .group = "Figures, lists and help", .part = asked_part,
    .shown = FIGURE_SETUPS | FIGURE_AT | FIGURE_SLANTED | FIGURE_BESIDE};
/* clang-format on */
