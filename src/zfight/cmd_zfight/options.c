/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command zfight and its options. */
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "report/output.h"
#include "zfight/cmd_zfight/request.h"

#define GROUP_TYPE zfight_request

/* clang-format off */
static const option_row zfight_rows[] = {
    {"sample", 0, "N",
        "test N random pairs", WHOLE(sample, 1, 1e12, NULL),
        .without = "every depth; about 500 pairs of planes with --rasterize", .group = "Pairs of surfaces"},
    {"seed", 0, "S", /* JSON holds it exactly */
        "seed of --sample; the same seed gives the same pairs", WHOLE(seed, 0, 0x1p53, NULL), .standard = "0"},
    {"rasterize", 0, NULL,
        "rasterize pairs of slanted planes as random triangles: how close they get before a pixel is wrong, against "
        "the guarantee", FLAG(drawn)},
    {"separation", 0, "S",
        "find where surfaces S scene units apart tie or swap", POSITIVE(separation),
        .without = "neighbouring binary32 depths"},
    END};
/* clang-format on */

const option_table zfight_options = {.rows = zfight_rows};

/* clang-format off */
static const option_use uses[] = {
    ROWS(zfight_rows),
    OWN("slant", .argument = "LO:HI|SLANT,AZIMUTH", .parse = parse_slant_or_plane, DEFAULT("0:90"),
        HELP("angles between surface normal and view axis, degrees; 0 faces the camera, 90 is edge-on; with "
        "--rasterize also one angle and the direction of the normal on the screen, 0 right and 90 up")),
    OWN("format", DEFAULT("fp32")), OWN("mapping", HELP(CAMERA_PERSPECTIVE), DEFAULT("reversed")),
    OWN("range", HELP("the depths tested"), WITHOUT("near to far; needed where far is inf")),
    OWN("viewport", HELP("the viewport in pixels; without --rasterize the guarantee at any slant is printed beside the "
        "census"), WITHOUT("1920x1080 with --rasterize, else surfaces face the camera")),
    OWN("raster", HELP("the rasterizer or specification, as in 'depthprec list rasterizers'; with --rasterize one "
        "that draws: llvmpipe, lavapipe, softpipe or swiftshader"), WITHOUT("llvmpipe with --rasterize")),
    TAKE("threads"), TAKE("link"), TAKE("depth-range"),
    GROUP_OF(camera_slanted), GROUP_OF(camera_projected), GROUP_OF(output_written), END};

static const option_rule rules[] = {
    NEEDS("seed", "sample rasterize", NULL),
    CONFLICTS("separation", "rasterize", ", which looks for the separation"),
    {.option = NULL}};
/* clang-format on */

static const option_place places[] = {CAMERA_PLACES(zfight_request), OWN_PLACE(zfight_options), {.table = NULL}};

static int complete(void *request) {
    zfight_request *o = request;
    return camera_complete(&o->camera, &(camera_use){.drawn = o->drawn});
}

/* clang-format off */
const command_row command_zfight = {
    .name = "zfight", .request = sizeof(zfight_request), .places = places, .uses = uses, .rules = rules,
    .complete = complete, .operand = "",
    .summary = "where surfaces start to z-fight, by a census of every depth",
    .example = "  depthprec zfight -n 0.1 -f 1000 -F unorm24,fp32 -m d3d,reversed\n"
    "  depthprec zfight -F d24 -m gl --arith mesa --separation 0.01\n"
    "  depthprec zfight -f inf -F fp32 -m reversed --range 0.1:1e9 --sample 1000000\n"
    "  depthprec zfight --rasterize -F fp32 -m reversed --range 16:64\n"};
/* clang-format on */
