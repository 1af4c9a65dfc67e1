/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command check and its options. */
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "report/output.h"
#include "solve/cmd_check/request.h"

/* clang-format off */
static const option_use uses[] = {
    TAKE("report"), TAKE("threads"), OWN("quiet", HELP("print only failures")),
    OWN("full", HELP("also say how each verdict was decided")), GROUP_OF(output_written), END};
/* clang-format on */

static const option_place places[] = {PLACE(checks_request, out, output_options), {.table = NULL}};

/* clang-format off */
const command_row command_check = {
    .name = "check", .request = sizeof(checks_request), .places = places, .uses = uses,
    .operand = "FILE...", .operand_min = 1, .operand_max = 1000,
    .summary = "cameras against requirement files; exit 1 if one is missed",
    .example = "  depthprec check engine.need\n"
    "  depthprec check --report junit -o depth.xml engine.need\n"
    "  generate | depthprec check -\n",
    .files_from = 1};
/* clang-format on */
