/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command prepass and its options. */
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "report/output.h"
#include "zfight/cmd_prepass/request.h"

static const name_list programs = {.rows = &vertex_program_table};
static const name_list programs_or_all = {.words = (const char *const[]){"all", NULL}, .rows = &vertex_program_table};
static const name_list spreads = {.get = list_vertices};

static int add_program(asked_line *line, const option_row *row, const char *name, void *group) {
    prepass_request *o = group;
    list_item found;
    if (!names_find(row->names, name, NULL, &found))
        return option_unknown(row, name);
    for (size_t i = 0; found.row == NULL && vertex_program_get(i) != NULL; i++)
        add_program(line, row, vertex_program_get(i)->name, group);
    for (size_t i = 0; i < o->against_count; i++)
        if (o->against[i] == found.row)
            return EXIT_FINE;
    if (found.row != NULL)
        o->against[o->against_count++] = found.row; /* there is room for every row */
    return EXIT_FINE;
}

static int parse_against(asked_line *line, const option_row *row, const char *value, void *group) {
    prepass_request *o = group;
    o->against_count = 0;
    return parse_names(line, row, value, group, add_program);
}

#define GROUP_TYPE prepass_request

/* clang-format off */
static const option_row prepass_rows[] = {
    {"against", 0, "PROGRAM[,PROGRAM...]|all",
        "the vertex programs of the main pass: @", .parse = parse_against, .names = &programs_or_all, .standard = "all",
        .group = "Two vertex programs"},
    {"program", 0, "PROGRAM",
        "the vertex program of the depth prepass", ROW(program, programs), .standard = "once"},
    {"vertices", 0, NULL,
        "distribution of the vertices: eye depth log-uniform over --range, in a round view of 90 degrees; or uniform "
        "in the box of --from-origin", WORD(vertices, spreads), .standard = "eye-log"},
    {"from-origin", 0, "R",
        "no coordinate of a camera exceeds R", LENGTH(world, 0, 1e18, "scene units"), .standard = "100"},
    {"sample", 0, "N",
        "test N random vertices", WHOLE(sample, 1, 1e12, NULL), .standard = "1000000"},
    {"seed", 0, "S",
        "seed of the random vertices", WHOLE(seed, 0, 0x1p53, NULL), .standard = "0"},
    END};
/* clang-format on */

const option_table prepass_options = {.rows = prepass_rows};

/* clang-format off */
static const option_use uses[] = {
    ROWS(prepass_rows),
    OWN("format", DEFAULT("fp32")), OWN("mapping", HELP(CAMERA_PERSPECTIVE), DEFAULT("reversed")),
    OWN("arith", ALSO("by default that of --platform where known")),
    OWN("range", HELP("the eye depths that are drawn"), WITHOUT("near to far; needed where far is inf")),
    TAKE("threads"), TAKE("link"), GROUP_OF(stored_uses),
    GROUP_OF(camera_projected), GROUP_OF(output_written), END};
/* clang-format on */

static const option_place places[] = {CAMERA_PLACES(prepass_request),
                                      OWN_PLACE(prepass_options),
                                      PLACE(prepass_request, stored, stored_options),
                                      {.table = NULL}};

/* clang-format off */
const command_row command_prepass = {
    .name = "prepass", .request = sizeof(prepass_request), .places = places, .uses = uses,
    .complete = camera_request_complete, .operand = "",
    .summary = "is EQUAL safe after a depth prepass, and what LEQUAL needs",
    .example = "  depthprec prepass -F d24 -m d3d\n"
    "  depthprec prepass --program once --against separate,fma -F fp32 -m reversed\n"
    "  depthprec list programs\n"};
/* clang-format on */
