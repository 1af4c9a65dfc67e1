/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command world and its options. */
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "report/output.h"
#include "world/cmd_world/request.h"

#define GROUP_TYPE world_request

/* clang-format off */
static const option_row world_rows[] = {

    {"separation", 0, "S",
        "separation of the surfaces along the view axis", POSITIVE(separation), .without = "1 cm, or 0.01"},
    {"from-origin", 0, "R[,R...]|LO:HI:log|lin:COUNT",
        "distance of the camera from the world's origin, at most 1e12 scene units",
        .parse = parse_depths, INTO(depths, distances), .without = "print how far each scheme is safe"},
    END};
/* clang-format on */

const option_table world_options = {.rows = world_rows};

/* clang-format off */
static const option_use uses[] = {
    ROWS(world_rows),
    OWN("far", DEFAULT("inf")), OWN("format", DEFAULT("fp32")),
    OWN("mapping", HELP(CAMERA_PERSPECTIVE), DEFAULT("reversed")),
    TAKE("arith"),
    OWN("at", HELP("distance of the surfaces ahead of the camera"), WITHOUT("10 m, or 10")),
    TAKE("scheme"), TAKE("share"), TAKE("fov"), TAKE("hfov"),
    OWN("viewport", HELP("pixels of the view"), DEFAULT("1920x1080")),
    GROUP_OF(camera_uses), GROUP_OF(output_written), END};
/* clang-format on */

static const option_place places[] = {CAMERA_PLACES(world_request),
                                      OWN_PLACE(world_options),
                                      PLACE(world_request, origin, origin_options),
                                      {.table = NULL}};

static int complete(void *request) {
    world_request *o = request;
    const int status = camera_complete(&o->camera, &(camera_use){0});
    return status == EXIT_FINE ? origin_complete(o->line, &o->origin) : status;
}

/* clang-format off */
const command_row command_world = {
    .name = "world", .request = sizeof(world_request), .places = places, .uses = uses,
    .complete = complete, .operand = "",
    .summary = "precision far from the origin, by world-to-view scheme",
    .example = "  depthprec world --from-origin 100km --separation 1cm --at 10m\n"
    "  depthprec world --scheme camera-float,split --at 1m\n"};
/* clang-format on */
