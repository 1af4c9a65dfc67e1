/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command budget and its options. */
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "quantity/cmd_budget/request.h"
#include "report/output.h"

/* clang-format off */
static const option_use uses[] = {
    OWN("format", DEFAULT("fp32")),
    OWN("mapping", HELP(CAMERA_PERSPECTIVE ", " DP_MAPPING_NAMES_LOG),
        DEFAULT("reversed")),
    OWN("tolerance", HELP("a model suffices if it neglects no more of the separation, 0.05 or 5%"), DEFAULT("5%")),
    TAKE("at"), TAKE("log-c"), TAKE("depth-range"),
    OWN("scheme", HELP("with --from-origin: the world-to-view scheme, see 'depthprec list schemes'"),
        WITHOUT("absolute: as --composition says")),
    OWN("share", HELP("with --scheme: the meshes of both surfaces have one origin")),
    GROUP_OF(origin_terms), TAKE("viewport"), TAKE("link"), GROUP_OF(camera_slanted), GROUP_OF(camera_projected),
    GROUP_OF(output_written), END};

static const option_rule rules[] = {
    NEEDS("share", "scheme", ": without one no mesh has an origin"),
    {.option = NULL}};
/* clang-format on */

static const option_place places[] = {
    CAMERA_PLACES(budget_request), PLACE(budget_request, origin, origin_options), {.table = NULL}};

static int complete(void *request) {
    budget_request *o = request;
    const int status = camera_complete(&o->camera, &(camera_use){0});
    return status == EXIT_FINE ? origin_complete(o->line, &o->origin) : status;
}

/* clang-format off */
const command_row command_budget = {
    .name = "budget", .request = sizeof(budget_request), .places = places, .uses = uses, .rules = rules,
    .complete = complete, .operand = "",
    .summary = "how much of the separation each cause takes",
    .example = "  depthprec budget -n 0.1 -f 1000 -F unorm24 -m d3d\n"
    "  depthprec budget -F fp32 -m reversed --from-origin 5km --linearize --at 10m\n"
    "  depthprec budget -F fp32 -m reversed --viewport 1920x1080 --raster spec-d3d\n"};
/* clang-format on */
