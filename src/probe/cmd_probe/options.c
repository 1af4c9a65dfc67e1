/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command probe and its options. */
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "probe/cmd_probe/request.h"
#include "report/output.h"

#define GROUP_TYPE probe_request

/* clang-format off */
static const option_row probe_rows[] = {
    {"device", 0, "N|NAME|gl",
        "the GPU: its number among the Vulkan devices, or part of its name; gl: the OpenGL device, through EGL",
        SOME_TEXT(device),
        .without = "the first Vulkan device that is not a CPU", .group = "The GPU"},
    {"keep", 0, "FILE",
        "write a CSV of every stored code beside what was drawn", FILE_WRITTEN(keep)},
    {"seed", 0, "S",
        "seed of the random scene that is predicted", WHOLE(seed, 0, 0x1p53, NULL), .standard = "0"},
    END};
/* clang-format on */

const option_table probe_options = {.rows = probe_rows};

/* clang-format off */
static const option_use uses[] = {
    ROWS(probe_rows),
    GROUP_OF(output_written), END};
/* clang-format on */

static const option_place places[] = {
    PLACE(probe_request, out, output_options), OWN_PLACE(probe_options), {.table = NULL}};

/* clang-format off */
const command_row command_probe = {
    .name = "probe", .request = sizeof(probe_request), .places = places, .uses = uses,
    .operand = "",
    .summary = "what this machine's GPU does to depth, measured",
    .example = "  depthprec probe\n"
    "  depthprec probe --device 1 --keep codes.csv\n"
    "  depthprec probe --device gl\n"
    "  depthprec probe --json -o gpu.json\n"};
/* clang-format on */
