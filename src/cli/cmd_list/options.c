/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command list and its options. */
#include "cli/cmd_list/request.h"
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "report/output.h"

static const name_list topics = {.get = list_topic};

#define GROUP_TYPE list_request

/* clang-format off */
static const option_row list_rows[] = {

    {"tolerance", 0, "SHARE",
        "list methods: the cases in which each is the cheapest whose bound is at most 0.05, or 5%", SHARE(tolerance)},
    END};
/* clang-format on */

static const option_table list_options = {.rows = list_rows};

/* clang-format off */
static const option_use uses[] = {
    ROWS(list_rows),
    GROUP_OF(output_written), END};
/* clang-format on */

static const option_place places[] = {
    PLACE(list_request, out, output_options), OWN_PLACE(list_options), {.table = NULL}};

/* clang-format off */
const command_row command_list = {
    .name = "list", .request = sizeof(list_request), .places = places, .uses = uses, .open = true,
    .operand = "WHAT", .operand_min = 0, .operand_max = 1, .names = &topics,
    .summary = "formats, mappings, presets, methods, or what a word means",
    .example = "  depthprec list\n"
    "  depthprec list formats\n"
    "  depthprec list mappings --json\n"
    "  depthprec list polygonOffset\n"};
/* clang-format on */
