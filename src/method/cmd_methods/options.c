/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command methods and its options. */
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "method/cmd_methods/request.h"
#include "report/output.h"

static const name_list families = {.get = list_family};

/* clang-format off */
static const option_use uses[] = {
    GROUP_OF(judge_mine),
    OWN("format", WITHOUT("that of the family's first case")),
    OWN("mapping", WITHOUT("that of the family's first case")),
    CAMERA_UNIT_ALONE,
    OWN("tolerance", HELP("mark the cheapest method whose bound is at most 0.05, or 5%"), WITHOUT("none")),
    OWN("full", HELP("all columns, however wide; and methods that another beats in both speed and accuracy")),
    TAKE("ortho"), GROUP_OF(camera_planes), GROUP_OF(output_written), END};

static const option_rule rules[] = {
    NEEDS("define", "mine", ", a function of yours"),
    CONFLICTS("ortho", "mine", NULL),
    CONFLICTS("ortho", "device", NULL),
    {.option = NULL}};
/* clang-format on */

static const option_place places[] = {
    CAMERA_PLACES(methods_request), PLACE(methods_request, judge, judge_options), {.table = NULL}};

/* clang-format off */
const command_row command_methods = {
    .name = "methods", .request = sizeof(methods_request), .places = places, .uses = uses, .rules = rules,
    .complete = camera_request_complete,
    .operand = "FAMILY", .operand_min = 0, .operand_max = 1, .names = &families,
    .summary = "methods compared: time, worst error, where each fails",
    .example = "  depthprec methods\n"
    "  depthprec methods linearize -n 0.1 -f 1000\n"
    "  depthprec methods interval -F fp32 -m reversed --tolerance 1e-6\n"
    "  depthprec plot pareto linearize -o pareto.svg\n"
    "  depthprec plot stability interval -o stability.svg\n",
    .group = "Methods and hardware"};
/* clang-format on */
