/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/option/rows.h"

#include "frame/metric.h"
#include "plot/draw.h"
#include "shadow/shadow.h"

/* What an option can be called by name. */
static const name_list formats = {.words = (const char *const[]){"all", "depth24plus", NULL},
                                  .get = list_format,
                                  .more = " (or a name from 'depthprec list formats'), unormN or floatE.M[bB]"};
static const name_list mappings = {.words = (const char *const[]){"all", NULL},
                                   .get = list_mapping,
                                   .more = " (or a name from 'depthprec list mappings')"};
static const name_list presets = {.get = list_preset};
static const name_list platforms = {.get = list_platform};
static const name_list units = {.get = list_unit};
static const name_list roundings = {.get = list_rounding};
static const name_list models = {.get = list_model};
static const name_list ariths = {.get = list_arith};
static const name_list log2_rules = {.get = list_log2};
static const name_list compositions = {.get = list_composition};
static const name_list apis = {.words = (const char *const[]){"all", NULL}, .get = list_api};
static const name_list programs = {.get = list_program};
static const name_list programs_or_all = {.words = (const char *const[]){"all", NULL}, .get = list_program};
static const name_list schemes_or_all = {.words = (const char *const[]){"all", NULL}, .get = list_scheme};
static const name_list spreads = {.get = list_vertices};
static const name_list rasters = {.get = list_rasterizer};
static const name_list filters_or_all = {.words = (const char *const[]){"all", NULL}, .get = list_filter};
static const name_list transforms = {.words = (const char *const[]){"exact", "binary32", NULL}};
static const name_list synthetics = {.get = list_synthetic};
static const name_list products = {.get = list_product};
static const name_list normals = {.get = list_normal};
static const name_list normal_formats = {.words = (const char *const[]){"opengl", "directx", NULL}};
static const name_list packings = {.get = list_packing};
/* In the order of their enumerators. */
static const name_list targets = {
    .words = (const char *const[]){"near", "far", "format", "mapping", "separation", "distance", "frusta", NULL}};
static const name_list themes = {.words = (const char *const[]){"light", "dark", "print", NULL}};
static const name_list types = {.words = (const char *const[]){"svg", "pdf", "png", NULL}};
static const name_list colours = {.words = (const char *const[]){"auto", "always", "never", NULL}};
static const name_list reports = {.words = (const char *const[]){"text", "json", "junit", NULL}};

/* Which commands take what. */
enum {
    MODELLED = CMD_TABLE | CMD_PLOT,
    BUDGETED = CMD_BUDGET | CMD_PLOT,
    SLANTED = CMD_TABLE | CMD_BUDGET | CMD_SOLVE | CMD_ZFIGHT | CMD_BIAS | CMD_SCENE,
    DRAWS = CMD_ZFIGHT | CMD_PLOT,
    SHADOWED = CMD_SHADOW | CMD_PLOT,
    VIEWED = SLANTED | SHADOWED,
    ASKED = MODELLED | CMD_BUDGET,
    CAMERA = ASKED | CMD_ZFIGHT | CMD_PREPASS | CMD_SCENE | CMD_WORLD,
    PLACED = CAMERA | CMD_METHODS,
    HOSTED = SLANTED | CMD_PREPASS | CMD_PLOT | CMD_TEXTURE,
    TAKEN = CMD_TEXTURE | CMD_BIAS | CMD_SOLVE,
    MAPPED = TAKEN | CMD_SHADOW,
    ORTHO = (CAMERA & ~(CMD_SCENE | CMD_WORLD)) | TAKEN,
    COUNTED = CMD_ZFIGHT | CMD_PREPASS,
    SEARCHED = CMD_SCENE | CMD_PLOT,
    SPREAD = COUNTED | CMD_CHECK | CMD_TEXTURE | SEARCHED,
    DRAWN = CMD_PLOT | CMD_TEXTURE,
    WRITTEN = PLACED | MAPPED | CMD_LIST | CMD_CHECK | CMD_PROBE,
    PAGED = CMD_TABLE | CMD_PLOT | CMD_ZFIGHT | CMD_PREPASS | CMD_BUDGET | CMD_SOLVE | CMD_BIAS,
    EVERY = ~0
};

/* The field of an option; one of another type than its kind reads does not compile. Whole numbers have several widths.
 */
#define FIELD(type, field) .place = offsetof(options, field) + 0 * sizeof(1 ? &((options *)0)->field : (type *)0)
#define SIZED(field)       .place = offsetof(options, field), .size = sizeof((options *)0)->field

#define FLAG(field)                  .parse = parse_flag, SIZED(field)
#define TEXT(field)                  .parse = parse_text, FIELD(const char *, field)
#define SOME_TEXT(field)             .parse = parse_some, FIELD(const char *, field)
#define FILE_READ(field)             .parse = parse_read, FIELD(const char *, field)
#define FILE_WRITTEN(field)          .parse = parse_written, FIELD(const char *, field)
#define LIMITS(lo, hi, of)           .least = (lo), .most = (hi), .unit = (of)
#define POSITIVE(field)              .parse = parse_length, FIELD(double, field)
#define LENGTH(field, ...)           POSITIVE(field), LIMITS(__VA_ARGS__)
#define NUMBER(field, ...)           .parse = parse_number, FIELD(double, field), LIMITS(__VA_ARGS__)
#define ORIGIN(field)                .parse = parse_origin, FIELD(double, field[0])
#define WHOLE(field, ...)            .parse = parse_whole, SIZED(field), LIMITS(__VA_ARGS__)
#define SEVERAL(kind, field, lo, hi) .parse = (kind), FIELD(depths, field), LIMITS(lo, hi, NULL)
#define WORD(field, among)           .parse = parse_word, SIZED(field), .names = &(among)
#define ROW(field, among)            .parse = parse_row, SIZED(field), .names = &(among)

/* Where it is otherwise: a default spelled out, what holds without, what it does. */
#define BUT(those, spelled, holds, does)                                                                               \
    { .commands = (those), .standard = (spelled), .without = (holds), .help = (does) }

/* clang-format off */
const option_row option_rows[OPTION_COUNT] = {
    [OPTION_NEAR] = {"near", 'n', "Z", PLACED | MAPPED,
        "near plane", .parse = parse_near, FIELD(double, znear),
        LIMITS(1e-12, 1e12, "scene units"), .standard = "0.1",
        .except = {BUT(CMD_SOLVE, NULL, "what is solved for, or 0.1 where --for names another", NULL),
                   BUT(CMD_SHADOW, "0.1", NULL, "near plane of the view")},
        .adds = {{ORTHO, "with --ortho also 0 or negative"}},
        .group = "The camera"},
    [OPTION_FAR] = {"far", 'f', "Z|inf", PLACED | MAPPED,
        "far plane, up to 1e18 scene units and at least 1e-6 of near beyond it, or inf",
        parse_far, .standard = "1000",
        .except = {BUT(CMD_SOLVE, NULL, "inf; solved for where only near is given", NULL),
                   BUT(CMD_WORLD, "inf", NULL, NULL),
                   BUT(CMD_SHADOW, "1000", NULL, "how far the view sees shadows, greater than near and at most 1e12 "
                       "scene units")}},
    [OPTION_FORMAT] = {"format", 'F', "NAME[,NAME...]|all", PLACED | MAPPED,
        "depth formats: @, names as the APIs write them, unormN, floatE.M[bB]; all means those of "
        "'depthprec list formats'", parse_formats, .names = &formats, .standard = "all",
        .except = {BUT(CMD_TEXTURE, NULL, "as the image has it; unorm24 with --synthetic; all with an effect alone",
                       NULL),
                   BUT(CMD_METHODS, NULL, "that of the family's first case", NULL),
                   BUT(CMD_BIAS, "fp32,unorm16,unorm24", "the depth buffers", NULL),
                   BUT(CMD_SHADOW | CMD_SCENE | CMD_WORLD, "fp32", NULL, NULL),
                   BUT(CMD_SOLVE, NULL, "solved for where near and far are given, else all", NULL)}},
    [OPTION_MAPPING] = {"mapping", 'm', "NAME[,NAME...]|all", PLACED | MAPPED,
        "mappings: @; all means d3d and reversed",
        parse_mappings, .names = &mappings, .standard = "all",
        .except = {BUT(CMD_TEXTURE, NULL, "as the image has it; d3d with --synthetic; all with an effect alone", NULL),
                   BUT(CMD_METHODS, NULL, "that of the family's first case", NULL),
                   BUT(CMD_SOLVE, NULL, "solved for where near, far and format are given, else all", NULL),
                   BUT(CMD_SHADOW, "d3d", NULL, "mappings: " DP_MAPPING_NAMES_PERSPECTIVE
                       "; all are d3d and reversed"),
                   BUT(CMD_SCENE, "reversed", NULL, NULL),
                   BUT(CMD_WORLD, "reversed", NULL, "mappings: " DP_MAPPING_NAMES_PERSPECTIVE),
                   BUT(CMD_BUDGET, "all", NULL, "mappings: " DP_MAPPING_NAMES_PERSPECTIVE ", " DP_MAPPING_NAMES_LOG
                       "; all are d3d and reversed"),
                   BUT(CMD_ZFIGHT | CMD_PREPASS, "all", NULL, "mappings: " DP_MAPPING_NAMES_PERSPECTIVE
                       "; all are d3d and reversed")}},
    [OPTION_LOG_C] = {"log-c", 0, "C", MODELLED | TAKEN | CMD_SCENE | CMD_BUDGET,
        "constant C of the logarithmic mappings", NUMBER(log_c, 1e-12, 1e12, NULL), .standard = "1"},
    [OPTION_ORTHO] = {"ortho", 0, NULL, ORTHO,
        "orthographic projection; not with linear and log", FLAG(ortho), .without = "perspective",
        .except = {BUT(CMD_ZFIGHT | CMD_PREPASS | CMD_BUDGET, NULL, "perspective", "orthographic projection")}},
    [OPTION_PRESET] = {"preset", 0, "NAME[,NAME...]", CAMERA | TAKEN,
        "an engine's near, far, mapping and format, for those that are not given: @; see 'depthprec list presets'",
        .parse = parse_presets, .names = &presets,
        .adds = {{CMD_BIAS | CMD_SCENE, "for a bias the API that its users write"},
                 {VIEWED, "with --viewport its field of view and rasterizer"}, {CMD_TABLE, "table compares several"}}},
    [OPTION_PLATFORM] = {"platform", 0, "NAME",
        HOSTED,
        "what a browser stores for a page that asks for 24 bits: formats, mapping, arithmetic, where they are not "
        "given; of presets it replaces all but the mapping: @; see 'depthprec list platforms'",
        ROW(platform, platforms),
        .adds = {{CMD_BIAS | CMD_SCENE, "for a bias the API"}, {VIEWED, "with --viewport the rasterizer"}}},
    [OPTION_UNIT] = {"unit", 0, NULL, PLACED | MAPPED,
        "what a scene unit is; presets are converted to it; any length may carry a unit: 10cm",
        .parse = parse_unit, .names = &units, .without = "that of the preset, or m where a length has a unit",
        .except = {BUT(CMD_METHODS | CMD_SHADOW, NULL, "m where a length has a unit",
                       "what a scene unit is; any length may carry a unit: 10cm")}},
    [OPTION_ROUNDING] = {"rounding", 0, NULL, CAMERA | TAKEN,
        "how a depth between two codes is rounded: ties upwards in unorm formats and to even in floats, as the APIs "
        "demand; ties to even in both; or towards 0", WORD(rounding, roundings), .standard = "nearest",
        .group = "The arithmetic"},
    [OPTION_MODEL] = {"model", 0, NULL, MODELLED | CMD_SOLVE,
        "the arithmetic before the buffer: none, the lattice alone; NDC and window depth each rounded to binary32; "
        "every operation in binary32; or the simplest that is enough", WORD(model, models), .standard = "exact",
        .except = {BUT(CMD_SOLVE, "float", "the guarantee; staged for an error, and for linear and log", NULL),
                   BUT(CMD_PLOT, "exact", "float in figures of its pipeline", NULL),
                   BUT(CMD_TABLE, "exact", "of several set-ups the fullest that each has", NULL)}},
    [OPTION_ARITH] = {"arith", 0, "NAME|FILE", CAMERA | CMD_SOLVE | CMD_BIAS | CMD_SHADOW,
        "the binary32 arithmetic: @; or as 'depthprec probe --json -o FILE' found it", .parse = parse_arith,
        SIZED(arith), .names = &ariths, .standard = "ieee",
        .adds = {{VIEWED, "that of --raster where it is known"}, {HOSTED, "that of --platform where it is known"}}},
    [OPTION_TOLERANCE] = {"tolerance", 0, "SHARE", ASKED | CMD_METHODS | CMD_LIST,
        "the error allowed, 0.05 or 5%: a model is enough if it neglects no more of the separation; and the "
        "cheapest method that claims no more is used", parse_tolerance, .standard = "5%",
        .except = {BUT(CMD_TABLE, NULL, "5% for the model; intervals are exact", NULL),
                   BUT(CMD_PLOT, NULL, "5% for the model; intervals are as exact as the picture shows", NULL),
                   BUT(CMD_BUDGET, "5%", NULL, "a model is enough if it neglects no more of the separation, 0.05 or "
                       "5%"),
                   BUT(CMD_METHODS, NULL, "none", "the cheapest method that claims no more than 0.05, or 5%, is "
                       "marked"),
                   BUT(CMD_LIST, NULL, NULL, "list methods: the cases for which each is the cheapest that claims no "
                       "more than 0.05, or 5%")}},
    [OPTION_AT] = {"at", 0, "Z[,Z...]|LO:HI:log|lin:COUNT", ASKED | TAKEN | CMD_WORLD,
        "the depths asked about, at most 1000000, within [near, far]", parse_at, FIELD(depths, at),
        .without = "nine, log-spaced from near to far, or to 1e6 times near; evenly where near is not above 0",
        .except = {BUT(CMD_SOLVE, NULL, NULL, "the depth asked about"),
                   BUT(CMD_WORLD, NULL, "10 m, or 10", "how far ahead of the camera the surfaces are"),
                   BUT(CMD_PLOT, NULL, NULL, "the depth asked about, in figures of a single one"),
                   BUT(CMD_TABLE, NULL, "nine, log-spaced from near to far, or to 1e6 times near; evenly where near "
                       "is not above 0; of several set-ups round ones", NULL)},
        .group = "The depths"},
    [OPTION_RANGE] = {"range", 0, "LO:HI", MODELLED | COUNTED | CMD_BIAS | CMD_SOLVE | CMD_SHADOW,
        "the depths over which worst cases are taken", parse_range, .without = "near to far",
        .except = {BUT(CMD_SOLVE, NULL, "near to far for a distance, else --at", "the depths at which it must hold"),
                   BUT(CMD_SHADOW, NULL, "all of the box, less 1/256 where units are worth nothing at window depth 0",
                       "with --light-box: how far along the light what is lit lies, from the front of the box"),
                   BUT(CMD_ZFIGHT, NULL, "near to far; needed where far is inf", "the depths that are visited"),
                   BUT(CMD_PREPASS, NULL, "near to far; needed where far is inf", "the eye depths of the vertices"),
                   BUT(CMD_PLOT, NULL, "near to far, or to 1e6 times near", "the depths that are shown")}},
    [OPTION_DEPTH] = {"depth", 0, "D[,D...]", CMD_TABLE,
        "the reverse: the eye depths of these window depths, each with its cell",
        SEVERAL(parse_list, looked_up, 0, 1)},
    [OPTION_CODE] = {"code", 0, "N[,N...]", CMD_TABLE,
        "the same for stored codes, decimal or 0x...; the code of a float is its bits",
        SEVERAL(parse_codes, looked_up, 0, 4294967295)},
    [OPTION_FOR] = {"for", 0, NULL, CMD_SOLVE,
        "what to solve for; distance is the depth up to which --separation or --error holds, frusta the "
        "least number of frusta that keep --separation from near to far", WORD(target, targets),
        .without = "the first of near, far, format and mapping that is not given", .group = "What is wanted"},
    [OPTION_SEPARATION] = {"separation", 0, "S", CMD_SOLVE | CMD_ZFIGHT | CMD_BIAS | SEARCHED | CMD_WORLD,
        "surfaces S scene units apart must be told apart, whatever their alignment",
        .parse = parse_separation, FIELD(double, separation),
        .except = {BUT(CMD_ZFIGHT, NULL, "neighbouring binary32 depths",
                       "where surfaces S scene units apart tie and swap"),
                   BUT(SEARCHED, NULL, "what is not told apart as far as is judged",
                       "surfaces at most S scene units apart; 0: exactly in one plane"),
                   BUT(CMD_WORLD, NULL, "1 cm, or 0.01", "how far apart along the view surfaces are"),
                   BUT(CMD_BIAS, NULL, "told apart", "how much nearer a layer must come, in scene units")}},
    [OPTION_ERROR] = {"error", 0, "E", CMD_SOLVE,
        "instead: the decoded depth may be at most E scene units off: at --at as the codes lie there, or at "
        "every depth of --range", POSITIVE(wanted_error)},
    [OPTION_INTERPOLATION] = {"interpolation", 0, "E", BUDGETED,
        "error of a window depth interpolated across a triangle",
        NUMBER(terms.interpolation, 0, 0x1p24, "units of 2^-24"), .standard = "0", .group = "The budget"},
    [OPTION_FROM_ORIGIN] = {"from-origin", 0, "R", BUDGETED | CMD_SHADOW | CMD_PREPASS | CMD_WORLD,
        "start from world positions; no coordinate of theirs or of the camera exceeds R, at most 1e18 scene units",
        .parse = parse_from_origin, FIELD(double, terms.world), .standard = "0", .without = "eye depth is given",
        .except = {BUT(CMD_SHADOW, "0", "positions about the middle of the light's box",
                       "no coordinate of positions exceeds R, at most 1e18 scene units"),
                   BUT(CMD_PREPASS, "100", NULL, "no coordinate of a camera exceeds R, at most 1e18 "
                       "scene units"),
                   BUT(CMD_WORLD, NULL, "how far each scheme reaches", "how far the camera is from the world's "
                       "origin, at most 1e12 scene units; several: R,R or LO:HI:log|lin:COUNT")}},
    [OPTION_COMPOSITION] = {"composition", 0, NULL, BUDGETED,
        "how they become clip coordinates: by one binary32 matrix of view and projection, multiplied in double and "
        "rounded, or in binary32; or after the camera's position is subtracted in double",
        WORD(terms.composition, compositions), .standard = "once"},
    [OPTION_SCHEME] = {"scheme", 0, "NAME[:SIZE][,NAME...]|all", CMD_WORLD | CMD_BUDGET,
        "how vertices come before the camera: @; the size of a split, tile or cell in scene units; see 'depthprec "
        "list schemes'", parse_schemes, .names = &schemes_or_all, .standard = "all",
        .except = {BUT(CMD_BUDGET, NULL, "absolute: as --composition says", "with --from-origin: how vertices come "
                       "before the camera, one scheme, see 'depthprec list schemes'")}},
    [OPTION_SHARE] = {"share", 0, NULL, CMD_WORLD | CMD_BUDGET,
        "both surfaces are of meshes about one origin, whose rounding they share", FLAG(shared_origin),
        .without = "each has its own",
        .except = {BUT(CMD_BUDGET, NULL, "each has its own", "with --scheme: both surfaces are of meshes about one "
                       "origin")}},
    [OPTION_LINEARIZE] = {"linearize", 0, NULL, BUDGETED,
        "also count the loss of reading eye depth back in a binary32 shader", FLAG(terms.linearize)},
    [OPTION_LOG2] = {"log2", 0, NULL, BUDGETED,
        "what the log2 of a shader may be off by, for logarithmic mappings: 3 units in the last place and 2^-21 from "
        "0.5 to 2, as Vulkan, GLSL and WGSL say; 2^-21, as Direct3D says; or rounded once",
        WORD(terms.log2, log2_rules), .standard = "vulkan"},
    [OPTION_EYE] = {"eye", 0, "X,Y,Z", SEARCHED | CMD_TEXTURE,
        "judge from an eye at this place in the model; needs --look", ORIGIN(eye),
        .without = "from every place at every distance",
        .except = {BUT(CMD_TEXTURE, "0,0,0", NULL, "the camera's place in the world")}, .group = "The view"},
    [OPTION_LOOK] = {"look", 0, "X,Y,Z", SEARCHED | CMD_TEXTURE,
        "the place that --eye looks at, y upwards", ORIGIN(look),
        .except = {BUT(CMD_TEXTURE, NULL, "along world z", NULL)}},
    [OPTION_PATH] = {"path", 0, "FILE", SEARCHED,
        "judge from several eyes: a line for each, its place and the place that it looks at, six numbers",
        FILE_READ(path)},
    [OPTION_CAMERA] = {"camera", 0, "NAME", SEARCHED,
        "judge from a camera of the model, by its name; near, far and field of view are its own where they are not "
        "given", TEXT(model_camera)},
    [OPTION_FOV] = {"fov", 0, "DEG", VIEWED | CMD_TEXTURE | CMD_WORLD,
        "vertical field of view", NUMBER(camera.fov_y, 0.01, 179, "degrees"), .standard = "60"},
    [OPTION_HFOV] = {"hfov", 0, "DEG", VIEWED | CMD_TEXTURE | CMD_WORLD,
        "horizontal field of view, in place of --fov", NUMBER(fov_x, 0.01, 179, "degrees"), .without = "as --fov says"},
    [OPTION_VIEWPORT] = {"viewport", 0, "WxH", VIEWED | CMD_WORLD,
        "count what a rasterizer does to slanted triangles in a viewport of these pixels; z is then the depth of the "
        "farther surface, and the separation is along the normal",
        .parse = parse_viewport, .without = "surfaces face the camera",
        .except = {BUT(CMD_ZFIGHT, NULL, "1920x1080 with --rasterize, else surfaces face the camera",
                       "the pixels of the viewport; without --rasterize what is guaranteed at any slant stands beside "
                       "the census"),
                   BUT(CMD_WORLD, "1920x1080", NULL, "pixels of the view"),
                   BUT(CMD_SCENE, NULL, "1920x1080 from an eye, else surfaces face the camera", NULL),
                   BUT(CMD_SHADOW, "1920x1080", NULL, "pixels of the view, which say how wide it is"),
                   BUT(CMD_PLOT, NULL, "1920x1080 in fight and shadow, else surfaces face the camera",
                       "the pixels of the viewport; budget and interval then count slanted triangles")}},
    [OPTION_RASTER] = {"raster", 0, "NAME|FILE", VIEWED,
        "the rasterizer, its subpixel grid and how it sets up depth: @; of the specifications the worst that they "
        "allow; see 'depthprec list rasterizers'; or as 'depthprec probe --json -o FILE' found it",
        .parse = parse_raster, FIELD(const raster_row *, raster), .names = &rasters,
        .without = "--subpixel, and a plane anchored at a vertex",
        .except = {BUT(CMD_ZFIGHT, "llvmpipe", "with --rasterize", "the rasterizer or specification, as in "
                       "'depthprec list rasterizers'; with --rasterize one that draws: llvmpipe, lavapipe, softpipe "
                       "or swiftshader")}},
    [OPTION_SUBPIXEL] = {"subpixel", 0, "BITS", VIEWED,
        "instead: bits of the grid to which vertices move; Direct3D has 8, Vulkan and OpenGL at least 4; with "
        "spec-vulkan and spec-gl how many more there are",
        WHOLE(triangles.subpixel, 1, 8, "bits"), .standard = "8"},
    [OPTION_SLANT] = {"slant", 0, "LO:HI", SLANTED | CMD_PLOT,
        "angles of the surfaces' normal to the view axis, degrees; 0 faces the camera, 90 is edge-on",
        .parse = parse_slant, .standard = "0:90"},
    [OPTION_PLANE] = {"plane", 0, "SLANT,AZIMUTH", DRAWS,
        "in place of --slant: the angle of the planes' normal to the view axis and where it points on the screen, "
        "degrees, 0 to the right and 90 up",
        .parse = parse_plane, .without = "any azimuth",
        .except = {BUT(CMD_PLOT, "60,45", NULL, "the angle of the planes' normal to the view axis and where it points "
                       "on the screen, degrees, 0 to the right and 90 up")}},
    [OPTION_TRIANGLE_CLASS] = {"triangle-class", 0, "depth=K,pixels=P,slim=Q", VIEWED,
        "the triangles: vertices at depths from z/K to K z, at most P pixels wide and high, no slimmer than 1:Q",
        .parse = parse_triangle, .standard = "depth=2,pixels=512,slim=16"},
    [OPTION_CASCADES] = {"cascades", 0, "N", SHADOWED,
        "shadow maps that share the view from near to far", WHOLE(cascades, 1, 8, NULL), .standard = "4",
        .group = "The shadow map"},
    [OPTION_LAMBDA] = {"lambda", 0, "L", SHADOWED,
        "how they split it: 0 evenly, 1 logarithmically", NUMBER(lambda, 0, 1, NULL), .standard = "0.5"},
    [OPTION_LIGHT_BOX] = {"light-box", 0, "WxHxD", SHADOWED,
        "one shadow map of a box that wide, high and, along the light, deep", .parse = parse_light_box,
        .without = "cascades of the view"},
    [OPTION_CASTERS] = {"casters", 0, "Z", SHADOWED,
        "how far before a cascade, towards the light, things cast shadows on it",
        LENGTH(casters, 0, 1e12, "scene units"), .standard = "100"},
    [OPTION_KERNEL] = {"kernel", 0, "N", SHADOWED,
        "the filter reads NxN texels: 1 nearest, 2 bilinear, 3 and more percentage-closer filtering",
        WHOLE(kernel, 1, 64, "texels"), .standard = "3"},
    [OPTION_ANGLE] = {"angle", 0, "DEG", SHADOWED | CMD_SCENE,
        "receivers up to this angle between their normal and the light are free of acne",
        NUMBER(angle, 0, SHADOW_SLANT_MAX, "degrees"), .standard = "75",
        .except = {BUT(CMD_SCENE, "1", NULL, "surfaces whose planes meet at no more than this angle")}},
    [OPTION_CURVATURE] = {"curvature", 0, "Z", CMD_SHADOW,
        "receivers bend away from the light, with a radius of at least Z",
        LENGTH(curvature, 1e-12, 1e18, "scene units"),
        .without = "planes"},
    [OPTION_FACET] = {"facet", 0, "Z", CMD_SHADOW,
        "with --curvature: they are drawn as triangles that fit into circles of radius Z",
        LENGTH(facet, 0, 1e18, "scene units"), .standard = "0"},
    [OPTION_API] = {"api", 0, "NAME", CMD_BIAS | CMD_SHADOW | CMD_SCENE,
        "the API whose rule applies: @; all compares them, each with the call to write",
        ROW(api, apis), .standard = "d3d11",
        .group = "The bias"},
    [OPTION_UNITS] = {"units", 0, "U", CMD_BIAS,
        "constant bias in units of r, a whole number for d3d11 and webgpu; in window depth for d3d9 and vulkan-float",
        NUMBER(units, -1e12, 1e12, NULL),
        .without = "the units that are enough"},
    [OPTION_FACTOR] = {"factor", 0, "F", CMD_BIAS,
        "bias in units of the window slope", NUMBER(factor, -1e12, 1e12, NULL), .standard = "0"},
    [OPTION_CLAMP] = {"clamp", 0, "C", CMD_BIAS,
        "greatest bias, or least when negative, in window depth", NUMBER(clamp, -1e12, 1e12, NULL), .standard = "0",
        .without = "none"},
    [OPTION_SLOPE] = {"slope", 0, "S", CMD_BIAS,
        "eye depth changes by S from one pixel to the next", LENGTH(slope, 0, 1e12, "scene units per pixel"),
        .standard = "0", .without = "facing the camera"},
    [OPTION_SAMPLE] = {"sample", 0, "N", COUNTED,
        "draw N pairs at random", WHOLE(sample, 1, 1e12, NULL),
        .without = "visit every depth; about 500 pairs of planes with --rasterize",
        .except = {BUT(CMD_PREPASS, "1000000", NULL, "draw N vertices at random")}, .group = "Pairs of surfaces"},
    [OPTION_SEED] = {"seed", 0, "S", COUNTED | CMD_PROBE, /* JSON holds it exactly */
        "seed of --sample: the same pairs for the same seed", WHOLE(seed, 0, 0x1p53, NULL), .standard = "0",
        .except = {BUT(CMD_PROBE, "0", NULL, "seed of the random scene that is predicted"),
                   BUT(CMD_PREPASS, "0", NULL, "seed of the vertices: the same for the same seed")}},
    [OPTION_RASTERIZE] = {"rasterize", 0, NULL, CMD_ZFIGHT,
        "draw pairs of slanted planes as random triangles: how near they come before a pixel is wrong, against what "
        "is guaranteed", FLAG(drawn)},
    [OPTION_AGAINST] = {"against", 0, "PROGRAM[,PROGRAM...]|all", CMD_PREPASS,
        "the vertex programs of the main pass: @", .parse = parse_against, .names = &programs_or_all, .standard = "all",
        .group = "Two vertex programs"},
    [OPTION_PROGRAM] = {"program", 0, "PROGRAM", CMD_PREPASS,
        "the vertex program of the depth prepass", ROW(program, programs), .standard = "once"},
    [OPTION_VERTICES] = {"vertices", 0, NULL, CMD_PREPASS,
        "how vertices are drawn: eye depth log-uniform over --range, in a round view of 90 degrees; or uniform in the "
        "box of --from-origin", WORD(vertices, spreads), .standard = "eye-log"},
    [OPTION_WITHIN] = {"within", 0, "Z", SEARCHED,
        "exit 1 where surfaces can fight nearer than this depth; and the distance that mends it", POSITIVE(within),
        .without = "10 times the model's extent, or as far as the camera tells 1 % of it apart; from eyes, as far as "
                   "the model reaches", .group = "The model"},
    [OPTION_ALSO] = {"also", 0, "NAME[,NAME...]|all", SEARCHED,
        "pairs of triangles that are else left out: @", .parse = parse_also, .names = &filters_or_all},
    [OPTION_TRANSFORMS] = {"transforms", 0, NULL, SEARCHED,
        "how nodes are placed: exactly, or rounded at each step as an engine does",
        WORD(transforms, transforms), .standard = "exact"},
    [OPTION_RENDER] = {"render", 0, "FILE", CMD_SCENE,
        "draw what the camera sees, as --raster draws it, with the pixels in red that show the wrong surface: PNG",
        FILE_WRITTEN(render)},
    [OPTION_EMIT_NEED] = {"emit-need", 0, "FILE", CMD_SCENE,
        "write what the camera must tell apart up to --within as a requirement file of check", FILE_WRITTEN(emit_need)},
    [OPTION_DEVICE] = {"device", 0, "N|NAME|gl", CMD_PROBE,
        "the GPU: its number, or a part of its name, of those that Vulkan has; gl: that of OpenGL, by EGL",
        SOME_TEXT(device),
        .without = "Vulkan's first that is no processor", .group = "The GPU"},
    [OPTION_KEEP] = {"keep", 0, "FILE", CMD_PROBE,
        "write every code that was stored, with what was drawn: CSV", FILE_WRITTEN(keep)},
    [OPTION_HALF_HEIGHT] = {"half-height", 0, "H", CMD_TEXTURE,
        "with --ortho: half the height of the view", LENGTH(camera.half_height, 1e-12, 1e12, "scene units"),
        .standard = "5", .group = "The depth texture"},
    [OPTION_MATRIX] = {"matrix", 0, "FILE", CMD_TEXTURE,
        "a projection matrix, 16 numbers row by row, for column vectors: says the planes and the field of view, which "
        "need not be centred; its near plane may be oblique; NDC depth is as --mapping has it",
        FILE_READ(matrix), .without = "--near, --far and --fov say it"},
    [OPTION_LAST_EYE] = {"last-eye", 0, "X,Y,Z", CMD_TEXTURE,
        "last frame's --eye, for motion blur", ORIGIN(last_eye), .without = "that of this frame"},
    [OPTION_LAST_LOOK] = {"last-look", 0, "X,Y,Z", CMD_TEXTURE,
        "last frame's --look", ORIGIN(last_look), .without = "in the direction of this frame"},
    [OPTION_SYNTHETIC] = {"synthetic", 0, "NAME", CMD_TEXTURE,
        "a synthetic image in place of FILE: @; 'depthprec list synthetic' has their parameters",
        ROW(synthetic, synthetics)},
    [OPTION_SIZE] = {"size", 0, "WxH|N", CMD_TEXTURE | SHADOWED,
        "the image's pixels: with --synthetic, with a raw FILE, and with an effect alone if that needs the position",
        parse_size,
        .standard = "640x360", .except = {BUT(SHADOWED, "2048x2048", NULL, "texels of each shadow map; N is NxN")},
        .instead = "; a figure's size is --width and --height"},
    [OPTION_PARAMETER] = {"parameter", 0, "NAME=VALUE", CMD_TEXTURE,
        "a parameter of the synthetic image or the effect; may be repeated", .parse = parse_parameter},
    [OPTION_SKY] = {"sky", 0, "T", CMD_TEXTURE,
        "window depths within T of the far plane's are sky; with 0 only the plane's own",
        NUMBER(sky, 0, 0.5, NULL), .standard = "0.0001",
        .without = "as in Unity's shaders"},
    [OPTION_METRIC] = {"metric", 0, "SCALE", CMD_TEXTURE,
        "the samples are eye depths in units of SCALE, 0.001 for millimetres; 0, negative numbers, NaN and infinity "
        "are holes",
        LENGTH(metric, METRIC_SCALE_MIN, METRIC_SCALE_MAX, "scene units")},
    [OPTION_LATTICE] = {"lattice", 0, "NAME[:NUMBERS]", CMD_TEXTURE,
        "what metric depth was rounded to before, in place of what the image shows: stereo:FOCAL,BASELINE[,PIXELS] "
        "with the step of disparity in pixels, inverse:A[,B] with steps of 1/A in 1/z, even:STEP[,FROM] in z, "
        "inverse-levels:N or levels:N from the nearest to the farthest depth, binary16, file",
        TEXT(lattice), .without = "as found"},
    [OPTION_PACKING] = {"packing", 0, "NAME", CMD_TEXTURE,
        "the channels of FILE hold the depth together: @; 'depthprec list packings'", ROW(packing, packings)},
    [OPTION_CHANNEL] = {"channel", 0, "NAME", CMD_TEXTURE,
        "the channel of an EXR that is read", TEXT(channel), .without = "Z, R or depth, the first that is there"},
    [OPTION_PIXEL] = {"pixel", 0, "X,Y[;X,Y...]", CMD_TEXTURE,
        "describe single pixels: code, eye depth and its range, neighbours, position, normal; 0,0 is the "
        "top left. With an effect alone: the pixel that sees the depths",
        SEVERAL(parse_pixels, pixels, 0, IMAGE_SIDE_MAX - 1)},
    [OPTION_PRODUCT] = {"product", 0, "KIND[:METHOD]", CMD_TEXTURE,
        "what is made of the depths: @; position:METHOD and normal:METHOD say how, effect:NAME which; see 'depthprec "
        "list products'. An effect without an image: the usable values of its parameter",
        .parse = parse_product, FIELD(const product_row *, product), .names = &products},
    [OPTION_AS] = {"as", 0, "NAME[:NUMBERS]", CMD_TEXTURE,
        "eye depths as another sensor or format would have stored them: the nearest levels of what --lattice has names "
        "for, which begin at 0 where nothing else is said",
        TEXT(as), .without = "not rounded"},
    [OPTION_NORMALS_BY] = {"normals-by", 0, "METHOD", CMD_TEXTURE,
        "the normals that effect:outline compares, and those of --pack depth-normals: @", ROW(normals_by, normals),
        .without = "those that FILE holds or, for effect:outline, the scene has; else projective"},
    [OPTION_NORMAL_FORMAT] = {"normal-format", 0, NULL, CMD_TEXTURE,
        "which way y runs in a PNG of normals: up, or down", WORD(normal_format, normal_formats), .standard = "opengl"},
    [OPTION_PACK] = {"pack", 0, "NAME", CMD_TEXTURE,
        "write the depths to -o FILE, a PNG or NPY of 8 bits, in several channels: @", ROW(pack, packings)},
    [OPTION_ERROR_MAP] = {"error-map", 0, NULL, CMD_TEXTURE,
        "write the error of the product instead; with =FILE, beside the product in the same pass",
        .parse = parse_error_map, SIZED(error_map), .optional = "FILE"},
    [OPTION_FIGURE] = {"figure", 0, "FILE", CMD_TEXTURE,
        "draw the product: SVG, PDF or PNG; up to 256 surfaces of a synthetic image that share a code with what is "
        "behind are marked", FILE_WRITTEN(figure)},
    [OPTION_OVERLAY] = {"overlay", 0, "E", CMD_TEXTURE,
        "with --figure: depth in grey, and in colour where eye depth is, or can be, off by more than E scene units",
        POSITIVE(overlay)},
    [OPTION_HISTOGRAM] = {"histogram", 0, "FILE", CMD_TEXTURE,
        "draw how many pixels lie at which eye depth, and how many codes there are for them: SVG, PDF or PNG",
        FILE_WRITTEN(histogram)},
    [OPTION_TYPE] = {"type", 0, NULL, DRAWN,
        "type of the figure, for stdout or a file name that does not end in one", WORD(type, types),
        .standard = "svg", .group = "The figure"},
    [OPTION_THEME] = {"theme", 0, NULL, DRAWN,
        "colours of the figure", WORD(theme, themes), .standard = "light"},
    [OPTION_WIDTH] = {"width", 0, "PX", DRAWN,
        "width of the figure", WHOLE(width, DRAW_WIDTH_MIN, DRAW_SIZE_MAX, "pixels"), .without = "as suits the figure"},
    [OPTION_HEIGHT] = {"height", 0, "PX", DRAWN,
        "height of the figure", WHOLE(height, DRAW_HEIGHT_MIN, DRAW_SIZE_MAX, "pixels"),
        .without = "as suits the figure"},
    [OPTION_TITLE] = {"title", 0, "TEXT", DRAWN,
        "title of the figure", TEXT(title)},
    [OPTION_LINK] = {"link", 0, NULL, PAGED,
        "print the link that opens this command in the page depthprec.html, or where =URL says the page is",
        .parse = parse_link, FIELD(const char *, link), .optional = "URL", .group = "Output"},
    [OPTION_REPORT] = {"report", 0, NULL, CMD_CHECK | CMD_SCENE,
        "how to write verdicts: text, JSON, or JUnit XML",
        WORD(report, reports), .standard = "text"},
    [OPTION_JSON] = {"json", 0, NULL, WRITTEN,
        "write JSON, one object, schema depthprec/1", parse_form, .least = FORM_JSON},
    [OPTION_CSV] = {"csv", 0, NULL, WRITTEN,
        "write CSV (RFC 4180) with units in the header row", parse_form, .least = FORM_CSV},
    [OPTION_OUTPUT] = {"output", 'o', "FILE", WRITTEN,
        "write to FILE once complete; - is stdout", FILE_WRITTEN(output), .without = "stdout",
        .except = {BUT(CMD_PLOT, NULL, NULL, "draw to FILE: SVG, PDF or PNG by its ending; - is stdout, as --type "
                       "says; the numbers of --json and --csv go to stdout, or to a FILE of another ending"),
                   BUT(CMD_TEXTURE, NULL, "stdout", "write the product to FILE: PNG, PFM or NPY by its ending; else "
                       "what is printed")}},
    [OPTION_THREADS] = {"threads", 0, "N", SPREAD,
        "use at most N threads; results do not change", WHOLE(threads, 1, 1024, NULL), .without = "all cores"},
    [OPTION_QUIET] = {"quiet", 'q', NULL, WRITTEN,
        "no messages and no progress, only data and errors", FLAG(quiet),
        .except = {BUT(CMD_CHECK, NULL, NULL, "print only failures")}},
    [OPTION_VERBOSE] = {"verbose", 'v', NULL, CMD_TABLE | CMD_PLOT | CMD_CHECK | CMD_BIAS,
        "print the cell of each depth", FLAG(verbose),
        .except = {BUT(CMD_PLOT, NULL, NULL, "print how many values were computed"),
                   BUT(CMD_CHECK, NULL, NULL, "print how each verdict was decided"),
                   BUT(CMD_BIAS, NULL, NULL, "print where a biased depth is held at a plane")}},
    [OPTION_FULL] = {"full", 0, NULL, WRITTEN & ~CMD_PLOT,
        "all columns, however wide", FLAG(full),
        .except = {BUT(CMD_TABLE, NULL, NULL, "all columns, however wide; and a table for each set-up in place of a "
                       "comparison"),
                   BUT(CMD_METHODS, NULL, NULL, "all columns, however wide; and the methods to which another is "
                       "faster and more exact")}},
    [OPTION_COLOR] = {"color", 0, NULL, WRITTEN,
        "bold headings and coloured verdicts in text; auto: on a terminal where NO_COLOR is not set",
        WORD(colour, colours), .standard = "auto"},
    [OPTION_HELP] = {"help", 'h', NULL, (unsigned)EVERY,
        "this help", .parse = NULL},
    [OPTION_VERSION] = {"version", 'V', NULL, (unsigned)EVERY,
        "version and licence", .parse = NULL},
};
/* clang-format on */
