/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command judge and its options. */
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "judge/cmd_judge/request.h"
#include "report/output.h"

static int parse_mine(asked_line *line, const option_row *row, const char *value, void *group) {
    judge_asked *o = group;
    (void)line;
    if (o->mine_count == JUDGE_MINE_MAX)
        return option_refuse(row, "must not be more than %d, got '%s' too", JUDGE_MINE_MAX, value);
    o->mine[o->mine_count++] = value;
    return EXIT_FINE;
}

#define GROUP_TYPE judge_asked

/* clang-format off */
static const option_row judge_rows[] = {
    {"pairs", 0, "FILE",
        "what went into the function and what came out, two columns: CSV, or npy", FILE_READ(pairs),
        .group = "Code of your own"},
    {"pairs-for", 0, "N",
        "print N window depths to put into the function", WHOLE(depths, 8, 1e6, NULL)},
    {"define", 0, "NAME=VALUE",
        "what a uniform or parameter of the function is: near, far, near_far, z_buffer_params, projection_params, "
        "camera_params, inv_device_z, projection, inverse_projection, either with _lh for a camera that looks along "
        "+z, or a number; of a member of a structure with its name, camera.near=near; of a macro 1 or 0; may be "
        "repeated", .parse = parse_define, .without = "guessed by common names",
        .repeats = true},
    {"mine", 0, "FILE:FUNCTION",
        "a function of yours from a window depth to its eye depth, in GLSL, HLSL or FILE.spv, stands beside the "
        "methods of linearize, timed on this machine's GPU as ours are; may be repeated",
        .parse = parse_mine, .repeats = true},
    {"device", 0, "N|NAME",
        "the GPU that runs it: its number among the Vulkan devices, or part of its name", SOME_TEXT(device),
        .without = "the first Vulkan device that is not a CPU"},
    END};
/* clang-format on */

const option_table judge_options = {.rows = judge_rows};

/* clang-format off */
const option_use judge_mine[] = {TAKE("mine"), TAKE("define"), TAKE("device"), END};

enum { PART_FILE = 1, PART_PAIRS = 2, PART_ASKED = 4 };
static const option_use of_device[] = {
    TAKE("define"), OWN("device",
        HELP("the GPU that runs FILE: its number among the Vulkan devices, or part of its name")), END};
static const option_use of_camera[] = {
    OWN("near", ALSO("with --ortho also 0 or negative"),
        WITHOUT("with no --far either: the planes that fit; else 0.1, or what fits")),
    OWN("far", WITHOUT("with no --near either: the planes that fit; else 1000, or what fits")),
    OWN("format", DEFAULT("fp32")),
    OWN("mapping", HELP("what is right: @")),
    TAKE("log-c"), TAKE("ortho"), TAKE("platform"), GROUP_OF(camera_planes), TAKE("preset"), END};
static const option_use uses[] = {
    TAKE("pairs"), TAKE("pairs-for"), FOR(PART_FILE, of_device), FOR(PART_FILE | PART_PAIRS, of_camera),
    GROUP_OF(output_written), END};
/* clang-format on */

static const option_place places[] = {
    CAMERA_PLACES(judge_request), PLACE(judge_request, judge, judge_options), {.table = NULL}};

static const command_part parts[] = {
    {"with FILE", PART_FILE}, {"with --pairs", PART_PAIRS}, {"with --pairs-for", PART_ASKED}, {NULL, 0}};

static size_t asked_part(const void *request) {
    const judge_request *o = request;
    return o->judge.depths > 0 ? 2 : o->judge.pairs != NULL;
}

/* clang-format off */
const command_row command_judge = {
    .name = "judge", .request = sizeof(judge_request), .places = places, .uses = uses,
    .complete = camera_request_complete,
    .operand = "[FILE]", .operand_min = 0, .operand_max = 1,
    .summary = "what a function of yours computes, and what it loses",
    .example = "  depthprec judge depth.glsl:linearDepth -n 0.1 -f 1000 -F d24\n"
    "  depthprec judge fog.hlsl:EyeDepth --define _Planes=near_far -m reversed\n"
    "  depthprec judge --pairs-for 64 -o depths.csv\n"
    "  depthprec judge --pairs pairs.csv -n 0.1 -f 1000 -F d24 -m d3d\n"
    "  my-program | depthprec judge --pairs - --json\n",
    .part = asked_part, .parts = parts};
/* clang-format on */
