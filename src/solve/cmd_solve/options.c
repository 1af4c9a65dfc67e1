/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command solve and its options. */
#include <math.h>

#include "cli/list.h"
#include "cli/option/kinds.h"
#include "report/output.h"
#include "solve/cmd_solve/request.h"
#include "solve/preset.h"

static const name_list targets = {
    .words = (const char *const[]){"near", "far", "format", "mapping", "separation", "distance", "frusta", NULL}};

static void begin(asked_line *line, void *group) {
    solve_request *o = group;
    (void)line;
    o->target = SOLVE_FOR_ANY;
}

#define GROUP_TYPE solve_request

/* clang-format off */
static const option_row solve_rows[] = {
    {"for", 0, NULL,
        "what to solve for; distance: the depth up to which --separation or --error holds; frusta: the fewest "
        "that resolve --separation from near to far", WORD(target, targets),
        .without = "the first of near, far, format and mapping that is not given", .group = "What is wanted"},
    {"separation", 0, "S",
        "surfaces S scene units apart must be resolved, however they are aligned",
        POSITIVE(separation)},
    {"error", 0, "E",
        "instead: the largest error of the decoded depth, in scene units: at --at for the codes that lie there, or at "
        "every depth of --range", POSITIVE(error)},
    END};
/* clang-format on */

const option_table solve_options = {.rows = solve_rows, .begin = begin};

/* clang-format off */
enum { SOLVE_ONE = 1, SOLVE_FRUSTA = 2 };
static const option_use solve_one[] = {
    OWN("at", HELP("the depth at which it must hold"), WITHOUT("")),
    OWN("range", HELP("the depths throughout which it must hold"), WITHOUT("near to far for a distance, else --at")),
    TAKE("error"), TAKE("viewport"), END};

static const option_use uses[] = {
    OWN("near", ALSO("with --ortho also 0 or negative"),
        WITHOUT("solved for, or 0.1 where --for names another")),
    OWN("far", WITHOUT("inf; solved for where only near is given")),
    OWN("format", WITHOUT("solved for where near and far are given, else all")),
    OWN("mapping", WITHOUT("solved for where near, far and format are given, else d3d and reversed")),
    OWN("model", WITHOUT("float: the guarantee; staged for an error, and for linear and log")),
    FOR(SOLVE_ONE, solve_one),
    TAKE("log-c"), TAKE("depth-range"), TAKE("for"), TAKE("separation"), TAKE("link"),
    GROUP_OF(camera_slanted), GROUP_OF(camera_projected), GROUP_OF(output_written), END};

/* A preset without the first number that it needs is asked about that. */
static int complete(void *request) {
    solve_request *o = request;
    const preset_parameter *x = o->camera.preset_count == 1 ? preset_sought(o->camera.presets[0]) : NULL;
    o->camera.values[0].sought = x != NULL && isnan(o->camera.values[0].given[0]);
    return camera_request_complete(request);
}

static const option_rule rules[] = {
    CONFLICTS("error", "separation", NULL),
    CONFLICTS("range", "at", NULL),
    {.option = NULL}};
/* clang-format on */

static const option_place places[] = {CAMERA_PLACES(solve_request), OWN_PLACE(solve_options), {.table = NULL}};

static const command_part parts[] = {
    {"without --for frusta", SOLVE_ONE}, {"with --for frusta", SOLVE_FRUSTA}, {NULL, 0}};

static size_t asked_part(const void *request) {
    const solve_request *o = request;
    return o->target == SOLVE_FOR_FRUSTA;
}

/* clang-format off */
const command_row command_solve = {
    .name = "solve", .request = sizeof(solve_request), .places = places, .uses = uses, .rules = rules,
    .complete = complete, .operand = "",
    .summary = "near, far, format, mapping or distance for a separation",
    .example = "  depthprec solve --for distance -n 0.1 -f 1000 -F d24 -m d3d --separation 0.01\n"
    "  depthprec solve -F unorm24 -m d3d -f 10000 --separation 0.01 --at 5000\n"
    "  depthprec solve -n 0.1 -f 4000 --separation 0.001 --range 0.1:100\n"
    "  depthprec solve --for far -n 0.1 -F d24 -m d3d --error 0.05 --at 500\n"
    "  depthprec solve --preset maplibre:pitch=60,height=800 --separation 10cm\n",
    .part = asked_part, .parts = parts};
/* clang-format on */
