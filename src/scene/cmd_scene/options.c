/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command scene and its options. */
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "report/output.h"
#include "scene/cmd_scene/request.h"
#include "scene/find.h"
#include "shadow/shadow.h"

static const name_list filters_or_all = {.words = (const char *const[]){"all", NULL}, .rows = &finder_filter_table};
static const name_list transforms = {.words = (const char *const[]){"exact", "binary32", NULL}};

static int add_filter(asked_line *line, const option_row *row, const char *name, void *group) {
    scene_asked *o = group;
    (void)line;
    list_item found;
    if (!names_find(row->names, name, NULL, &found))
        return option_unknown(row, name);
    for (size_t i = 0; finder_filter_get(i) != NULL; i++)
        if (found.row == NULL || found.row == finder_filter_get(i))
            o->filters_off |= 1U << i;
    return EXIT_FINE;
}

static int parse_also(asked_line *line, const option_row *row, const char *value, void *group) {
    scene_asked *o = group;
    o->filters_off = 0;
    return parse_names(line, row, value, group, add_filter);
}

#define GROUP_TYPE scene_asked

/* clang-format off */
static const option_row scene_rows[] = {
    {"within", 0, "Z",
        "exit 1 if surfaces may z-fight nearer than this depth; and print the separation that fixes it",
        POSITIVE(within),
        .without = "10 times the model's extent, or as far as the camera resolves 1 % of it; from eyes, as far as the "
                   "model reaches", .group = "The model"},
    {"also", 0, "NAME[,NAME...]|all",
        "also judge pairs of triangles that are left out by default: @", .parse = parse_also, .names = &filters_or_all},
    {"transforms", 0, NULL,
        "how node transforms are applied: exactly, or rounded at each step, as an engine does",
        WORD(transforms, transforms), .standard = "exact"},
    {"render", 0, "FILE",
        "write a PNG of what the camera sees, as --raster draws it; pixels that show the wrong surface are red",
        FILE_WRITTEN(render)},
    {"emit-need", 0, "FILE",
        "write a requirement file for check: what the camera must resolve up to --within",
        FILE_WRITTEN(emit_need)},
    {"separation", 0, "S",
        "judge surfaces at most S scene units apart; 0: exactly coplanar", .parse = parse_length_or_0,
        INTO(double, separation), .without = "what the camera does not resolve as far as is judged"},
    {"angle", 0, "DEG",
        SCENE_ANGLE, NUMBER(angle, 0, SHADOW_SLANT_MAX, "degrees"), .standard = "1"},
    END};
/* clang-format on */

const option_table scene_options = {.rows = scene_rows};

/* clang-format off */
static const option_row scene_eye_rows[] = {
    {"eye", 0, "X,Y,Z",
        "view the model from this point; needs --look", ORIGIN(eye),
        .without = "from every point, at every distance", .group = "The view"},
    {"look", 0, "X,Y,Z",
        "the point that --eye looks at, y up", ORIGIN(look)},
    {"path", 0, "FILE",
        "view the model from several points: six numbers a line, the eye and the point that it looks at",
        FILE_READ(path)},
    {"camera", 0, "NAME",
        "view the model from one of its own cameras; near, far and field of view are that camera's where not given",
        TEXT(camera)},
    END};

static const option_rule eye_rules[] = {
    CONFLICTS("path", "eye camera", NULL),
    CONFLICTS("camera", "eye", NULL),
    NEEDS("eye", "look", NULL),
    NEEDS("look", "eye", NULL),
    {.option = NULL}};
/* clang-format on */

const option_table scene_eye_options = {.rows = scene_eye_rows, .rules = eye_rules};

/* clang-format off */
const option_use scene_model[] = {
    TAKE("separation"), TAKE("angle"),
    TAKE("eye"), TAKE("look"), TAKE("path"), TAKE("camera"), TAKE("within"), TAKE("also"), TAKE("transforms"),
    TAKE("threads"), END};

static const option_use uses[] = {
    OWN("format", DEFAULT("fp32")), OWN("mapping", DEFAULT("reversed")), GROUP_OF(bias_brought),
    OWN("viewport", WITHOUT("1920x1080 from an eye, else surfaces face the camera")),
    TAKE("log-c"), GROUP_OF(scene_model), TAKE("api"), TAKE("render"), TAKE("emit-need"), TAKE("report"),
    OWN("full", HELP("all columns, however wide; and how long each model takes to judge all findings")),
    GROUP_OF(camera_slanted), GROUP_OF(camera_uses), GROUP_OF(output_written), END};

static const option_rule rules[] = {
    CONFLICTS("render", "path", ": a picture has one eye"),
    {.option = NULL}};
/* clang-format on */

static const option_place places[] = {CAMERA_PLACES(scene_request),
                                      PLACE(scene_request, scene, scene_eye_options),
                                      PLACE(scene_request, scene, scene_options),
                                      PLACE(scene_request, bias, bias_options),
                                      {.table = NULL}};

static int complete(void *request) {
    scene_request *o = request;
    const camera_use use = {.pictured = o->scene.render != NULL, .seen = scene_is_seen(o->line)};
    bias_bring(o->line, &o->bias, &o->camera, true);
    const int status = camera_complete(&o->camera, &use);
    return status == EXIT_FINE ? bias_complete(o->line, &o->camera) : status;
}

/* clang-format off */
const command_row command_scene = {
    .name = "scene", .request = sizeof(scene_request), .places = places, .uses = uses, .rules = rules,
    .complete = complete,
    .operand = "MODEL", .operand_min = 1, .operand_max = 1,
    .summary = "surfaces of a 3D model that z-fight, and from where on",
    .example = "  depthprec scene house.glb -n 0.1 -f 500\n"
    "  depthprec scene house.glb --viewport 1920x1080 --within 50\n"
    "  depthprec scene house.glb --eye 0,2,30 --look 0,2,0 --render seen.png\n"
    "  depthprec scene city.obj -F d24 -m d3d --separation 0.001 --json\n",
    .files_from = 1, .group = "A model, an image, a shadow map"};
/* clang-format on */
