/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/option/uses.h"

#include "core/append.h"
#include "plot/figure.h"

const option_own option_plain = {0};

/* clang-format off */
/* An option as its row has it, or with a command's own words; a group of them, or a group for some parts alone. */
#define TAKE(option)     {.id = OPTION_##option, .own = &option_plain}
#define OWN(option, ...) {.id = OPTION_##option, .own = &(const option_own){__VA_ARGS__}}
#define GROUP(of)        {.group = (of)}
#define FOR(these, of)   {.group = (of), .parts = (these)}
#define END              {.id = OPTION_COUNT}

#define HELP(words)      .help = (words)
#define ALSO(words)      .also = (words)
#define DEFAULT(typed)   .standard = (typed)
#define WITHOUT(words)   .without = (words)

#define PERSPECTIVE     "mappings: " DP_MAPPING_NAMES_PERSPECTIVE
#define ALL_PERSPECTIVE PERSPECTIVE "; all are d3d and reversed"

#define OF_RG           "rg, of Unity's DepthNormals, is linear"

/* ---- What several commands take ---------------------------------------------------------------------------------- */

static const option_use always[] = {TAKE(HELP), TAKE(VERSION), END};

static const option_use written[] = {
    TAKE(JSON), TAKE(CSV), TAKE(OUTPUT), TAKE(QUIET), TAKE(FULL), TAKE(COLOR), END};

static const option_use planes[] = {
    TAKE(NEAR), TAKE(FAR), TAKE(FORMAT), TAKE(MAPPING), TAKE(UNIT), END};

static const option_use camera[] = {GROUP(planes), TAKE(PRESET), TAKE(ROUNDING), END};

/* Of either projection. */
static const option_use projected[] = {
    OWN(NEAR, ALSO("with --ortho also 0 or negative")), TAKE(ORTHO), TAKE(PLATFORM), GROUP(camera), END};

/* What a view changes of the camera, and what stands beside --viewport. */
#define OF_VIEW "with --viewport also its field of view and rasterizer"
static const option_use beside_viewport[] = {
    TAKE(FOV), TAKE(HFOV), TAKE(RASTER), TAKE(SUBPIXEL), TAKE(TRIANGLE_CLASS), END};
static const option_use slanted[] = {
    OWN(PRESET, ALSO(OF_VIEW)),
    OWN(PLATFORM, ALSO("with --viewport also its rasterizer")),
    OWN(ARITH, ALSO("by default that of --raster or --platform where known")),
    TAKE(SLANT), GROUP(beside_viewport), END};

static const option_use budget_terms[] = {
    TAKE(INTERPOLATION), TAKE(FROM_ORIGIN), TAKE(COMPOSITION), TAKE(LINEARIZE), TAKE(LOG2), END};

static const option_use shadow_map[] = {
    OWN(FROM_ORIGIN, HELP("no coordinate of a position exceeds R"), DEFAULT("0"),
        WITHOUT("positions are relative to the centre of the light's box")),
    OWN(SIZE, .argument = "WxH|N", HELP("texels of each shadow map; N is NxN"), DEFAULT("2048x2048"),
        .parse = parse_size_or_n),
    TAKE(LIGHT_BOX), TAKE(KERNEL), TAKE(ANGLE), END};
static const option_use cascades[] = {TAKE(CASCADES), TAKE(CASTERS), END};

static const option_use model[] = {
    OWN(SEPARATION, HELP("judge surfaces at most S scene units apart; 0: exactly coplanar"),
        WITHOUT("what the camera does not resolve as far as is judged"), .parse = parse_separation_or_0),
    OWN(ANGLE, HELP("judge surfaces whose planes meet at no more than this angle"), DEFAULT("1")),
    TAKE(EYE), TAKE(LOOK), TAKE(PATH), TAKE(CAMERA), TAKE(WITHIN), TAKE(ALSO), TAKE(TRANSFORMS),
    TAKE(THREADS), END};

static const option_use picture[] = {
    TAKE(TYPE), TAKE(THEME), TAKE(FIGURE_SIZE), TAKE(TITLE), END};

/* ---- The commands ------------------------------------------------------------------------------------------------ */

/* What the reverse has no use for. */
enum { TABLE_OF_DEPTHS = 1, TABLE_OF_CODES = 2, TABLE_OF_CONSTANTS = 4, TABLE_OF_LEVELS = 8 };
static const option_use of_depths[] = {
    OWN(TOLERANCE, WITHOUT("5% for the model; intervals are exact")),
    TAKE(RANGE), OWN(VIEWPORT, ALSO("with --constants the shape of the view, 1920x1080 where not given")), END};
static const option_use of_stored[] = {
    OWN(FORMAT, ALSO(OF_RG)),
    OWN(MODEL, DEFAULT("exact"), WITHOUT("for several set-ups the fullest that each supports")),
    TAKE(DEPTH), TAKE(CODE), TAKE(LOG_C), TAKE(LINK), GROUP(slanted), GROUP(projected), END};
static const option_use asked_depths[] = {
    OWN(AT, WITHOUT("nine, log-spaced from near to far, or to 1e6 times near; linear if near is 0 or negative; round "
        "numbers for several set-ups; with --constants five")), END};
static const option_use of_constants[] = {
    TAKE(NEAR), TAKE(FAR), TAKE(MAPPING), TAKE(UNIT), TAKE(ORTHO), TAKE(FOV), TAKE(HFOV),
    OWN(VIEWPORT, DEFAULT("1920x1080")), END};
static const option_use compared[] = {
    OWN(PRESET, .argument = "NAME[,NAME...]", ALSO(OF_VIEW "; several are compared"), .parse = parse_presets), END};
static const option_use of_levels[] = {
    OWN(AT, WITHOUT("1, 2, 5 and 10")), TAKE(UNIT), END};
const option_use table_uses[] = {
    FOR(TABLE_OF_DEPTHS | TABLE_OF_CODES | TABLE_OF_CONSTANTS, compared),
    FOR(TABLE_OF_DEPTHS, of_depths), FOR(TABLE_OF_DEPTHS | TABLE_OF_CODES, of_stored),
    FOR(TABLE_OF_DEPTHS | TABLE_OF_CONSTANTS, asked_depths), FOR(TABLE_OF_CONSTANTS, of_constants), TAKE(CONSTANTS),
    FOR(TABLE_OF_LEVELS, of_levels),
    OWN(LATTICE, HELP("instead: how far apart the levels of a sensor or data set are, a name from 'depthprec list "
        "sensors', or as texture --lattice has them: stereo:FOCAL,BASELINE[,PIXELS], inverse:A, even:STEP, binary16"),
        WITHOUT("")),
    OWN(FULL, HELP("all columns, however wide, and the cell of each depth; a table for each set-up in place of a "
        "comparison")),
    GROUP(written), END};

const option_use budget_uses[] = {
    OWN(FORMAT, DEFAULT("fp32")),
    OWN(MAPPING, HELP(PERSPECTIVE ", " DP_MAPPING_NAMES_LOG "; all are d3d and reversed"), DEFAULT("reversed")),
    OWN(TOLERANCE, HELP("a model suffices if it neglects no more of the separation, 0.05 or 5%"), DEFAULT("5%")),
    TAKE(AT), TAKE(LOG_C),
    OWN(SCHEME, HELP("with --from-origin: the world-to-view scheme, see 'depthprec list schemes'"),
        WITHOUT("absolute: as --composition says")),
    OWN(SHARE, HELP("with --scheme: the meshes of both surfaces have one origin")),
    GROUP(budget_terms), TAKE(VIEWPORT), TAKE(LINK), GROUP(slanted), GROUP(projected), GROUP(written), END};

enum { SOLVE_ONE = 1, SOLVE_FRUSTA = 2 };
static const option_use solve_one[] = {
    OWN(AT, HELP("the depth at which it must hold"), WITHOUT("")),
    OWN(RANGE, HELP("the depths throughout which it must hold"), WITHOUT("near to far for a distance, else --at")),
    TAKE(ERROR), TAKE(VIEWPORT), END};
const option_use solve_uses[] = {
    OWN(NEAR, ALSO("with --ortho also 0 or negative"),
        WITHOUT("solved for, or 0.1 where --for names another")),
    OWN(FAR, WITHOUT("inf; solved for where only near is given")),
    OWN(FORMAT, WITHOUT("solved for where near and far are given, else all")),
    OWN(MAPPING, WITHOUT("solved for where near, far and format are given, else all")),
    OWN(MODEL, WITHOUT("float: the guarantee; staged for an error, and for linear and log")),
    FOR(SOLVE_ONE, solve_one),
    TAKE(LOG_C), TAKE(FOR), TAKE(SEPARATION), TAKE(LINK),
    GROUP(slanted), GROUP(projected), GROUP(written), END};

const option_use check_uses[] = {
    TAKE(REPORT), TAKE(THREADS), OWN(QUIET, HELP("print only failures")),
    OWN(FULL, HELP("also say how each verdict was decided")), GROUP(written), END};

const option_use zfight_uses[] = {
    OWN(SLANT, .argument = "LO:HI|SLANT,AZIMUTH", .parse = parse_slant_or_plane, DEFAULT("0:90"),
        HELP("angles between surface normal and view axis, degrees; 0 faces the camera, 90 is edge-on; with "
        "--rasterize also one angle and the direction of the normal on the screen, 0 right and 90 up")),
    OWN(FORMAT, DEFAULT("fp32")), OWN(MAPPING, HELP(ALL_PERSPECTIVE), DEFAULT("reversed")),
    OWN(RANGE, HELP("the depths tested"), WITHOUT("near to far; needed where far is inf")),
    OWN(SEPARATION, HELP("find where surfaces S scene units apart tie or swap"),
        WITHOUT("neighbouring binary32 depths")),
    OWN(VIEWPORT, HELP("the viewport in pixels; without --rasterize the guarantee at any slant is printed beside the "
        "census"), WITHOUT("1920x1080 with --rasterize, else surfaces face the camera")),
    OWN(RASTER, HELP("the rasterizer or specification, as in 'depthprec list rasterizers'; with --rasterize one "
        "that draws: llvmpipe, lavapipe, softpipe or swiftshader"), WITHOUT("llvmpipe with --rasterize")),
    TAKE(SAMPLE), TAKE(SEED), TAKE(RASTERIZE), TAKE(THREADS), TAKE(LINK),
    GROUP(slanted), GROUP(projected), GROUP(written), END};

const option_use prepass_uses[] = {
    OWN(FORMAT, DEFAULT("fp32")), OWN(MAPPING, HELP(ALL_PERSPECTIVE), DEFAULT("reversed")),
    OWN(ARITH, ALSO("by default that of --platform where known")),
    OWN(RANGE, HELP("the eye depths of the vertices"), WITHOUT("near to far; needed where far is inf")),
    OWN(FROM_ORIGIN, HELP("no coordinate of a camera exceeds R"), DEFAULT("100")),
    OWN(SAMPLE, HELP("test N random vertices"), DEFAULT("1000000")),
    OWN(SEED, HELP("seed of the random vertices"), DEFAULT("0")),
    TAKE(AGAINST), TAKE(PROGRAM), TAKE(VERTICES), TAKE(THREADS), TAKE(LINK),
    GROUP(projected), GROUP(written), END};

const option_use bias_uses[] = {
    OWN(FORMAT, DEFAULT("fp32")),
    OWN(PRESET, ALSO("for a bias also the API of its users; " OF_VIEW)),
    OWN(PLATFORM, ALSO("for a bias also its API; with --viewport also its rasterizer")),
    OWN(SEPARATION, HELP("how much nearer the bias must bring a layer, in scene units"),
        WITHOUT("until it is resolved")),
    TAKE(AT), TAKE(RANGE), TAKE(LOG_C), TAKE(API), TAKE(UNITS), TAKE(FACTOR), TAKE(CLAMP),
    TAKE(SLOPE), TAKE(VIEWPORT), TAKE(LINK),
    OWN(FULL, HELP("all columns, however wide; and where a biased depth is clamped")),
    GROUP(slanted), GROUP(projected), GROUP(written), END};

const option_use world_uses[] = {
    OWN(FAR, DEFAULT("inf")), OWN(FORMAT, DEFAULT("fp32")),
    OWN(MAPPING, HELP(PERSPECTIVE), DEFAULT("reversed")),
    TAKE(ARITH),
    OWN(AT, HELP("distance of the surfaces ahead of the camera"), WITHOUT("10 m, or 10")),
    OWN(SEPARATION, HELP("separation of the surfaces along the view axis"), WITHOUT("1 cm, or 0.01")),
    OWN(FROM_ORIGIN, .argument = "R[,R...]|LO:HI:log|lin:COUNT",
        HELP("distance of the camera from the world's origin, at most 1e12 scene units"),
        WITHOUT("print how far each scheme is safe"), .parse = parse_distances),
    TAKE(SCHEME), TAKE(SHARE), TAKE(FOV), TAKE(HFOV),
    OWN(VIEWPORT, HELP("pixels of the view"), DEFAULT("1920x1080")),
    GROUP(camera), GROUP(written), END};

const option_use scene_uses[] = {
    OWN(FORMAT, DEFAULT("fp32")), OWN(MAPPING, DEFAULT("reversed")),
    OWN(PRESET, ALSO("for a bias also the API of its users; " OF_VIEW)),
    OWN(PLATFORM, ALSO("for a bias also its API; with --viewport also its rasterizer")),
    OWN(VIEWPORT, WITHOUT("1920x1080 from an eye, else surfaces face the camera")),
    TAKE(LOG_C), GROUP(model), TAKE(API), TAKE(RENDER), TAKE(EMIT_NEED), TAKE(REPORT),
    GROUP(slanted), GROUP(camera), GROUP(written), END};

enum { TEXTURE_EFFECT = 1, TEXTURE_PLACED = 2, TEXTURE_IMAGE = 4 };
static const option_use of_effect[] = {TAKE(AT), END};
static const option_use of_image[] = {
    TAKE(SKY), TAKE(METRIC), TAKE(STEREO), TAKE(LATTICE), TAKE(RADIAL), TAKE(INTRINSICS), TAKE(AS), TAKE(ERROR_MAP),
    TAKE(FIGURE), TAKE(HI_Z),
    GROUP(picture), TAKE(THREADS), TAKE(PACKING), TAKE(NORMAL_FORMAT), TAKE(CHANNEL), TAKE(OVERLAY),
    OWN(RANGE, HELP("the values of an effect that are black and white in its PNG"),
        WITHOUT("0:1, of a vector -1:1")),
    TAKE(PICTURE), TAKE(TINT), TAKE(HISTOGRAM), TAKE(MATRIX), END};
static const option_use of_position[] = {
    TAKE(FOV), TAKE(HFOV),
    OWN(EYE, HELP("the camera's place in the world"), DEFAULT("0,0,0")),
    OWN(LOOK, WITHOUT("along world z")), TAKE(SIZE), TAKE(PIXEL), END};
const option_use texture_uses[] = {
    OWN(FORMAT, WITHOUT("as the image has it; unorm24 with --synthetic; all with an effect alone")),
    OWN(MAPPING, WITHOUT("as the image has it; d3d with --synthetic; all with an effect alone")),
    OWN(ORTHO, .optional = "H", HELP("orthographic projection, H half the height of the view"),
        WITHOUT("perspective; of H 5 scene units")),
    TAKE(LOG_C), TAKE(LAST_EYE), TAKE(LAST_LOOK), TAKE(SYNTHETIC), TAKE(PARAMETER), TAKE(PRODUCT),
    FOR(TEXTURE_EFFECT | TEXTURE_PLACED, of_effect),
    FOR(TEXTURE_IMAGE, of_image), FOR(TEXTURE_PLACED | TEXTURE_IMAGE, of_position),
    OWN(OUTPUT, HELP("write the product to FILE: PNG, PFM or NPY by its ending; else what is printed"),
        WITHOUT("stdout")),
    OWN(FULL, HELP("all columns, however wide; of an image Unity's _ZBufferParams, the condition of its matrix and "
        "what decodings are off by, too")),
    GROUP(projected), GROUP(written), END};

enum { SHADOW_CASCADES = 1, SHADOW_BOX = 2 };
static const option_use of_cascades[] = {
    OWN(NEAR, HELP("near plane of the view"), DEFAULT("0.1")),
    OWN(FAR, HELP("shadow distance, greater than near and at most 1e12 scene units"),
        DEFAULT("1000")),
    TAKE(FOV), TAKE(HFOV),
    OWN(VIEWPORT, HELP("size of the view in pixels; sets its aspect ratio"), DEFAULT("1920x1080")),
    TAKE(CAMERA_DEPTH), GROUP(cascades), END};
static const option_use of_box[] = {
    OWN(RANGE, HELP("with --light-box: where receivers lie along the light, from the front of the box"),
        WITHOUT("the whole box, less 1/256 where units have no effect at window depth 0")), END};
const option_use shadow_uses[] = {
    OWN(FORMAT, DEFAULT("fp32")), OWN(MAPPING, HELP(ALL_PERSPECTIVE), DEFAULT("d3d")),
    OWN(UNIT, HELP("the length of a scene unit; any length can have a unit: 10cm"),
        WITHOUT("m where a length has a unit")),
    OWN(ARITH, ALSO("by default that of --raster where known")),
    FOR(SHADOW_CASCADES, of_cascades), FOR(SHADOW_BOX, of_box), GROUP(shadow_map),
    TAKE(RASTER), TAKE(SUBPIXEL), TAKE(TRIANGLE_CLASS), TAKE(CURVATURE), TAKE(API),
    GROUP(written), END};

static const option_use of_mine[] = {TAKE(MINE), TAKE(DEFINE),
    OWN(DEVICE, .argument = "N|NAME",
        HELP("the GPU that runs it: its number among the Vulkan devices, or part of its name")), END};
const option_use methods_uses[] = {
    GROUP(of_mine),
    OWN(FORMAT, WITHOUT("that of the family's first case")),
    OWN(MAPPING, WITHOUT("that of the family's first case")),
    OWN(UNIT, HELP("the length of a scene unit; any length can have a unit: 10cm"),
        WITHOUT("m where a length has a unit")),
    OWN(TOLERANCE, HELP("mark the cheapest method whose bound is at most 0.05, or 5%"), WITHOUT("none")),
    OWN(FULL, HELP("all columns, however wide; and methods that another beats in both speed and accuracy")),
    GROUP(planes), GROUP(written), END};

const option_use probe_uses[] = {
    OWN(SEED, HELP("seed of the random scene that is predicted"), DEFAULT("0")),
    TAKE(DEVICE), TAKE(KEEP), GROUP(written), END};

const option_use code_uses[] = {
    OWN(FORMAT, DEFAULT("fp32")), OWN(MAPPING, HELP("mappings: @"), DEFAULT("reversed")),
    OWN(FOV, ALSO("of a matrix and of places")),
    OWN(VIEWPORT, HELP("the pixels of the view, of a matrix their shape"), DEFAULT("1920x1080")),
    OWN(ORTHO, .optional = "H", HELP("orthographic projection, H half the height of the view; not with linear and log"),
        WITHOUT("perspective; H 5")),
    TAKE(LANGUAGE), TAKE(WHAT), TAKE(UNIFORMS), TAKE(LOG_C), TAKE(HFOV), GROUP(projected),
    TAKE(JSON), TAKE(OUTPUT), TAKE(QUIET), END};

enum { JUDGE_FILE = 1, JUDGE_PAIRS = 2, JUDGE_ASKED = 4 };
static const option_use judge_device[] = {
    TAKE(DEFINE), OWN(DEVICE, .argument = "N|NAME",
        HELP("the GPU that runs FILE: its number among the Vulkan devices, or part of its name")), END};
static const option_use judge_camera[] = {
    OWN(NEAR, ALSO("with --ortho also 0 or negative"),
        WITHOUT("with no --far either: the planes that fit; else 0.1")),
    OWN(FAR, WITHOUT("with no --near either: the planes that fit; else 1000")),
    OWN(FORMAT, DEFAULT("fp32")),
    OWN(MAPPING, HELP("what is right: @; all means d3d and reversed")),
    TAKE(LOG_C), TAKE(ORTHO), TAKE(PLATFORM), GROUP(planes), TAKE(PRESET), END};
const option_use judge_uses[] = {
    TAKE(PAIRS), TAKE(PAIRS_FOR), FOR(JUDGE_FILE, judge_device), FOR(JUDGE_FILE | JUDGE_PAIRS, judge_camera),
    GROUP(written), END};

const option_use list_uses[] = {
    OWN(TOLERANCE, HELP("list methods: the cases in which each is the cheapest whose bound is at most 0.05, or 5%"),
        WITHOUT("")), GROUP(written), END};

/* The figures: those of set-ups, and those of a model, of shadow maps and of a requirement file, whose options are
 * those of their own commands. */
enum { SLANTED = FIGURE_SLANTED | FIGURE_MODEL, VIEWED = SLANTED | FIGURE_DRAWN | FIGURE_SHADOW };
#define FARS OWN(FAR, .argument = "Z|inf[,Z...]", ALSO("several in the figure linear01"), .parse = parse_fars)
static const option_use of_fars[] = {TAKE(NEAR), FARS, TAKE(MAPPING), TAKE(LOG_C), END};
static const option_use of_cameras[] = {TAKE(NEAR), FARS, OWN(FORMAT, ALSO(OF_RG)), TAKE(MAPPING), END};
static const option_use of_setups[] = {
    OWN(NEAR, ALSO("with --ortho also 0 or negative")), TAKE(ORTHO), OWN(TOLERANCE,
        WITHOUT("5% for the model; intervals are as exact as the picture shows")),
    OWN(MODEL, DEFAULT("exact"), WITHOUT("what is guaranteed, over the lattice, in error and interval; float in "
        "figures of its pipeline; staged in distribution and share with gl and gl-reversed")), END};
static const option_use of_setups_and_models[] = {
    OWN(PRESET, ALSO(OF_VIEW)), OWN(PLATFORM, ALSO("with --viewport also its rasterizer")), TAKE(ROUNDING),
    OWN(ARITH, ALSO("by default that of --raster or --platform where known")),
    TAKE(LOG_C), END};
static const option_use of_one_depth[] = {
    OWN(AT, HELP("the depth, in figures of a single one"), WITHOUT("")), END};
static const option_use of_axes[] = {TAKE(BESIDE), TAKE(AXES), END};
static const option_use of_ranges[] = {
    OWN(RANGE, HELP("the depths shown"), WITHOUT("near to far, or to 1e6 times near")), END};
static const option_use of_scene[] = {OWN(FORMAT, DEFAULT("fp32")), OWN(MAPPING, DEFAULT("reversed")),
    GROUP(model), END};
static const option_use of_shadow[] = {OWN(FORMAT, DEFAULT("fp32")), OWN(MAPPING, DEFAULT("d3d")),
    OWN(VIEWPORT, HELP("size of the view in pixels; sets its aspect ratio"), DEFAULT("1920x1080")),
    GROUP(shadow_map), GROUP(cascades), END};
static const option_use of_fight[] = {OWN(SLANT, .argument = "SLANT,AZIMUTH", .parse = parse_slant_or_plane,
    DEFAULT("60,45"),
    HELP("the angle between the planes' normal and the view axis, and its direction on the screen, degrees, 0 right "
        "and 90 up")), END};
static const option_use of_views[] = {
    OWN(VIEWPORT, HELP("the viewport in pixels; budget and interval then include slanted triangles"),
        WITHOUT("1920x1080 in fight and shadow, else surfaces face the camera")), GROUP(beside_viewport), END};
static const option_use of_slants[] = {OWN(SLANT,
    ALSO("in fight SLANT,AZIMUTH, by default 60,45: one angle, and the direction of the normal on the screen, 0 right "
        "and 90 up")), END};
const option_use plot_uses[] = {
    FOR(FIGURE_MODEL, of_scene), FOR(FIGURE_SHADOW, of_shadow), FOR(FIGURE_DRAWN, of_fight),
    FOR(FIGURE_TERMS, budget_terms), FOR(FIGURE_MINE, of_mine),
    FOR(FIGURE_SETUPS, of_setups), FOR(FIGURE_SETUPS | FIGURE_MODEL, of_setups_and_models),
    FOR(FIGURE_SETUPS | FIGURE_MODEL | FIGURE_SHADOW, of_cameras),
    FOR(FIGURE_FARS, of_fars), FOR(FIGURE_AT, of_one_depth),
    FOR(FIGURE_SETUPS | FIGURE_SHADOW | FIGURE_FILE | FIGURE_FARS, of_ranges),
    FOR(VIEWED, of_views), FOR(SLANTED, of_slants), TAKE(UNIT), GROUP(picture), FOR(FIGURE_BESIDE, of_axes), TAKE(LINK),
    OWN(OUTPUT, HELP("draw to FILE: SVG, PDF or PNG by its ending; - is stdout, as --type says; the numbers of "
        "--json and --csv go to stdout, or to a FILE of another ending"), WITHOUT("")),
    TAKE(JSON), TAKE(CSV), TAKE(QUIET), TAKE(COLOR),
    OWN(FULL, HELP("also say how many values were computed")), END};

const option_use no_uses[] = {END};
/* clang-format on */

/* ---- Parts of commands ------------------------------------------------------------------------------------------- */

const command_part table_parts[] = {{"to the table of depths", TABLE_OF_DEPTHS},
                                    {"with --depth or --code", TABLE_OF_CODES},
                                    {"with --constants", TABLE_OF_CONSTANTS},
                                    {"with --lattice", TABLE_OF_LEVELS},
                                    {NULL, 0}};
const command_part solve_parts[] = {
    {"without --for frusta", SOLVE_ONE}, {"with --for frusta", SOLVE_FRUSTA}, {NULL, 0}};
const command_part shadow_parts[] = {{"to cascades", SHADOW_CASCADES}, {"with --light-box", SHADOW_BOX}, {NULL, 0}};
const command_part judge_parts[] = {
    {"with FILE", JUDGE_FILE}, {"with --pairs", JUDGE_PAIRS}, {"with --pairs-for", JUDGE_ASKED}, {NULL, 0}};
const command_part texture_parts[] = {{"to an effect alone that needs no position", TEXTURE_EFFECT},
                                      {"to an effect alone that needs the position", TEXTURE_PLACED},
                                      {"with FILE or --synthetic", TEXTURE_IMAGE},
                                      {NULL, 0}};

size_t table_asked(const options *o) {
    return o->image.lattice != NULL ? 3 : o->wanted.constants ? 2 : o->wanted.looked_up.count > 0;
}

size_t solve_asked(const options *o) {
    return o->wanted.target == SOLVE_FOR_FRUSTA;
}

size_t shadow_asked(const options *o) {
    return option_given(o, OPTION_LIGHT_BOX);
}

size_t judge_asked(const options *o) {
    return o->judge.depths > 0 ? 2 : o->judge.pairs != NULL;
}

size_t texture_asked(const options *o) {
    if (o->image.effect == NULL || o->operand_count > 0 || o->image.synthetic != NULL)
        return 2;
    return (o->image.effect->needs & EFFECT_POSITION) != 0;
}

/* A figure is a part of plot. */
size_t plot_asked(const options *o) {
    size_t i = 0;
    while (figure_get(i) != o->operand_row)
        i++;
    return i;
}

bool option_part_get(const command_row *v, size_t index, command_part *out) {
    const figure_row *figure = v->id == CMD_PLOT ? figure_get(index) : NULL;
    *out = figure != NULL     ? (command_part){figure->name, figure->takes}
           : v->parts != NULL ? v->parts[index]
                              : (command_part){NULL, 0};
    return out->words != NULL;
}

unsigned option_parts(const options *o) {
    command_part part;
    return o->command->part != NULL && option_part_get(o->command, o->command->part(o), &part) ? part.bits : ~0U;
}

/* ---- Which command takes what ------------------------------------------------------------------------------------ */

static const option_use *find(const option_use *uses, unsigned parts, option_id id) {
    for (; uses->group != NULL || uses->id != OPTION_COUNT; uses++) {
        const option_use *found = uses->group != NULL ? find(uses->group, parts, id) : uses->id == id ? uses : NULL;
        if (found != NULL && (uses->parts == 0 || (uses->parts & parts) != 0))
            return found;
    }
    return NULL;
}

const option_use *option_used(const command_row *v, unsigned parts, option_id id) {
    const option_use *found = find(v->uses, parts, id);
    return found != NULL ? found : find(always, parts, id);
}

enum { OTHERS_NAMED = 6 }; /* more parts are no help */

int option_check_parts(const options *o, const command_row *v) {
    char names[OPTION_TEXT_SIZE] = "";
    command_part now, part;
    const char *lead = v->id == CMD_PLOT ? "to the figure " : "";
    if (v->part == NULL || !option_part_get(v, v->part(o), &now))
        return EXIT_FINE;
    for (int id = 0; id < OPTION_COUNT; id++) {
        size_t others = 0;
        if (!option_given(o, (option_id)id) || option_used(v, now.bits, (option_id)id) != NULL)
            continue;
        for (size_t i = 0; option_part_get(v, i, &part); i++)
            if (option_used(v, part.bits, (option_id)id) != NULL)
                append(names, sizeof names, "%s%s", others++ > 0 ? ", " : "", part.words);
        if (others > OTHERS_NAMED)
            return option_refuse(&option_rows[id], "does not apply %s%s", lead, now.words);
        if (others > 0)
            return option_refuse(&option_rows[id], "does not apply %s%s, only %s%s%s", lead, now.words, lead, names,
                                 option_rows[id].instead != NULL ? option_rows[id].instead : "");
    }
    return EXIT_FINE;
}

void option_default(const option_use *use, const char **standard, const char **without) {
    const option_row *row = &option_rows[use->id];
    const bool own = use->own->standard != NULL || use->own->without != NULL;
    *standard = own ? use->own->standard : row->standard;
    *without = own ? use->own->without : row->without;
    if (*without != NULL && **without == '\0')
        *without = NULL;
}

const char *option_use_argument(const option_use *use, char out[OPTION_TEXT_SIZE]) {
    out[0] = '\0';
    append(out, OPTION_TEXT_SIZE, "%s", use->own->argument != NULL ? use->own->argument : "");
    return use->own->argument != NULL ? out : option_argument(&option_rows[use->id], out);
}

const char *option_use_optional(const option_use *use) {
    return use->own->optional != NULL ? use->own->optional : option_rows[use->id].optional;
}
