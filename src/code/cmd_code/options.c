/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command code and its options. */
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "code/cmd_code/request.h"
#include "report/output.h"

static const name_list languages = {.rows = &code_language_table};
static const name_list code_parts = {
    .words = (const char *const[]){"linearize", "projection", "encode", "position", "pack", "normal", NULL}};

#define GROUP_TYPE code_request

/* clang-format off */
static const option_row code_rows[] = {
    {"language", 0, NULL,
        "the language: @; 'depthprec list languages' has what each promises of its arithmetic",
        ROW(language, languages), .standard = "glsl", .group = "The code"},
    {"what", 0, NULL,
        "linearize: eye depths of window depths; projection: the matrix; encode: codes of --format, of a linear or "
        "logarithmic mapping the window depth that a shader writes; position: places of pixels in view space; pack: "
        "depths in channels of a texture, METHOD as 'depthprec list packings'; normal: normals, METHOD as 'depthprec "
        "list encodings'",
        WORD(what, code_parts),
        .standard = "linearize"},
    {"uniforms", 0, NULL,
        "constants of the camera are parameters of the function", FLAG(uniforms)},
    END};
/* clang-format on */

const option_table code_options = {.rows = code_rows};

/* clang-format off */
static const option_use uses[] = {
    ROWS(code_rows),
    OWN("format", HELP("with --what encode: the format of the codes, unormN of at most 24 bits"), DEFAULT("unorm24")),
    OWN("mapping", HELP("mappings: @"), DEFAULT("reversed")),
    OWN("preset", ALSO("for code also the language of its users")),
    OWN("platform", ALSO("for code also the language of its API")),
    OWN("matrix", ALSO(CAMERA_OF_TANGENTS)),
    OWN("fov", ALSO("of a matrix and of places")),
    OWN("viewport", HELP("the pixels of the view, of a matrix their shape"), DEFAULT("1920x1080")),
    OWN("ortho", .optional = "H",
        HELP("orthographic projection, H half the height of the view; not with linear and log"),
        WITHOUT("perspective; H 5")),
    OWN("depth-range", ALSO("the function undoes it")),
    TAKE("log-c"), TAKE("hfov"), GROUP_OF(camera_projected),
    TAKE("link"), TAKE("json"), TAKE("output"), TAKE("quiet"), END};

static const option_rule rules[] = {
    CONFLICTS("fov", "ortho", ": --ortho=H says how high the view is"),
    CONFLICTS("hfov", "ortho", ": --ortho=H says how high the view is"),
    {.option = NULL}};
/* clang-format on */

static const option_place places[] = {CAMERA_PLACES(code_request), OWN_PLACE(code_options), {.table = NULL}};

static int complete(void *request) {
    code_request *o = request;
    const char *language = camera_language(&o->camera);
    if (language != NULL && !option_given(o->line, "language"))
        option_set(o->line, "language", language);
    return camera_complete(&o->camera, &(camera_use){.shape = true});
}

/* clang-format off */
const command_row command_code = {
    .name = "code", .request = sizeof(code_request), .places = places, .uses = uses, .rules = rules,
    .complete = complete,
    .operand = "[METHOD]", .operand_min = 0, .operand_max = 1,
    .summary = "a method or a projection matrix as code to take away",
    .example = "  depthprec code -n 0.1 -f inf -m reversed\n"
    "  depthprec code complement -n 0.1 -f 1000 -m d3d --language wgsl\n"
    "  depthprec code --what projection -n 0.3 -f 1000 -m gl --fov 50 --language c\n"
    "  depthprec code rgba --what pack --language hlsl\n"};
/* clang-format on */
