/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command table and its options. */
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "quantity/cmd_table/request.h"
#include "report/output.h"

#define GROUP_TYPE table_request

/* clang-format off */
static const option_row table_rows[] = {
    {"depth", 0, "D[,D...]|LO:HI:log|lin:COUNT",
        "the inverse: the eye depth of each of these window depths, and its cell",
        SEVERAL(parse_list, looked_up, 0, 1)},
    {"code", 0, "N[,N...]|LO:HI[:log|lin:COUNT]",
        "the same for stored codes, LO:HI for all from LO to HI; decimal or 0x...; the code of a float is its bit "
        "pattern",
        SEVERAL(parse_codes, looked_up, 0, 4294967295)},
    {"constants", 0, NULL,
        "instead: what shaders are given of the camera (_ZBufferParams, _ProjectionParams, UNITY_NEAR_CLIP_VALUE, "
        "corner rays), what LinearEyeDepth and its kin make of each depth, and what formulas read that are not right",
        FLAG(constants)},
    END};
/* clang-format on */

const option_table table_options = {.rows = table_rows};

/* Help shows it where it shows that of images. */
/* clang-format off */
static const option_row level_rows[] = {
    {"lattice", 0, "NAME[:NUMBERS]",
        "instead: how far apart the levels of a sensor or data set are, a name from 'depthprec list sensors', or as "
        "texture --lattice has them: stereo:FOCAL,BASELINE[,PIXELS], inverse:A, even:STEP, binary16", TEXT(lattice)},
    END};
/* clang-format on */

static const option_table level_options = {.rows = level_rows};

/* clang-format off */
/* Bits for the ways of `table`; the reverse has no use for some options. */
enum { TABLE_OF_DEPTHS = 1, TABLE_OF_CODES = 2, TABLE_OF_CONSTANTS = 4, TABLE_OF_LEVELS = 8 };
static const option_use of_depths[] = {
    OWN("tolerance", WITHOUT("5% for the model; intervals are exact")),
    TAKE("range"), OWN("viewport", ALSO("with --constants the shape of the view, 1920x1080 where not given")), END};
static const option_use of_stored[] = {
    OWN("format", ALSO(CAMERA_OF_RG)),
    OWN("model", DEFAULT("exact"), WITHOUT("for several set-ups the fullest that each supports")),
    TAKE("depth"), TAKE("code"), TAKE("log-c"), TAKE("link"),
    OWN("depth-range", .argument = "LO:HI[,LO:HI...]", ALSO("several are compared"), .parse = parse_depth_ranges),
    GROUP_OF(camera_slanted),
    GROUP_OF(camera_projected), END};
static const option_use asked_depths[] = {
    OWN("at", WITHOUT("nine, log-spaced from near to far, or to 1e6 times near; linear if near is 0 or negative; round "
        "numbers for several set-ups; with --constants five")), END};
static const option_use of_constants[] = {
    TAKE("near"), TAKE("far"), TAKE("mapping"), TAKE("unit"), TAKE("ortho"), TAKE("fov"), TAKE("hfov"),
    OWN("viewport", DEFAULT("1920x1080")), END};
static const option_use compared[] = {
    OWN("preset", .argument = "NAME[,NAME...]", ALSO(CAMERA_OF_VIEW "; several are compared"), .parse = parse_presets),
    END};
static const option_use of_levels[] = {
    OWN("at", WITHOUT("1, 2, 5 and 10")), TAKE("unit"), END};

static const option_use uses[] = {
    FOR(TABLE_OF_DEPTHS | TABLE_OF_CODES | TABLE_OF_CONSTANTS, compared),
    FOR(TABLE_OF_DEPTHS, of_depths), FOR(TABLE_OF_DEPTHS | TABLE_OF_CODES, of_stored),
    FOR(TABLE_OF_DEPTHS | TABLE_OF_CONSTANTS, asked_depths), FOR(TABLE_OF_CONSTANTS, of_constants), TAKE("constants"),
    FOR(TABLE_OF_LEVELS, of_levels), TAKE("lattice"),
    OWN("full", HELP("all columns, however wide, and the cell of each depth; a table for each set-up in place of a "
        "comparison")),
    GROUP_OF(output_written), END};

static const option_rule rules[] = {
    CONFLICTS("code", "depth", NULL),
    CONFLICTS("lattice", "constants", NULL),
    {.option = "fov", .relation = RULE_CONFLICTS, .others = "ortho", .parts = TABLE_OF_CONSTANTS},
    {.option = "hfov", .relation = RULE_CONFLICTS, .others = "ortho", .parts = TABLE_OF_CONSTANTS},
    {.option = "viewport", .relation = RULE_CONFLICTS, .others = "ortho", .parts = TABLE_OF_CONSTANTS},
    {.option = NULL}};
/* clang-format on */

static const option_place places[] = {
    CAMERA_PLACES(table_request), OWN_PLACE(table_options), OWN_PLACE(level_options), {.table = NULL}};

static const command_part parts[] = {{"to the table of depths", TABLE_OF_DEPTHS},
                                     {"with --depth or --code", TABLE_OF_CODES},
                                     {"with --constants", TABLE_OF_CONSTANTS},
                                     {"with --lattice", TABLE_OF_LEVELS},
                                     {NULL, 0}};

static size_t asked_part(const void *request) {
    const table_request *o = request;
    return o->lattice != NULL ? 3 : o->constants ? 2 : o->looked_up.count > 0;
}

static int complete(void *request) {
    table_request *o = request;
    return camera_complete(&o->camera, &(camera_use){.shape = o->constants, .counted = true, .compared = true});
}

/* clang-format off */
const command_row command_table = {
    .name = "table", .request = sizeof(table_request), .places = places, .uses = uses, .rules = rules,
    .complete = complete, .operand = "",
    .summary = "codes, errors, and how far surfaces are resolved",
    .example = "  depthprec table -n 0.1 -f 1000 -F unorm24 -m d3d,reversed\n"
    "  depthprec table -n 0.1 -f inf -F fp32 -m reversed --at 1,10,100,1000\n"
    "  depthprec table -n 0.1 -f inf -F fp32 -m reversed --viewport 1920x1080\n"
    "  depthprec table -F unorm24 -m d3d --depth 0.9987\n"
    "  depthprec table -F d32f --at 1:1000:log:10000 --csv -o depths.csv\n"
    "  depthprec table -n 0.3 -f 1000 -m reversed,gl --constants --at 1,10,100\n"
    "  depthprec table -n 0.1 -f 1000 -F d24 -m d3d --link\n",
    .group = "A camera", .part = asked_part, .parts = parts};
/* clang-format on */
