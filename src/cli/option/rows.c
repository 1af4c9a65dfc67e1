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
static const name_list normal_formats = {.words = (const char *const[]){"opengl", "directx", NULL}};
static const name_list samples = {.get = list_samples};
static const name_list stereos = {.get = list_stereo};
static const name_list packings = {.get = list_packing};
/* In the order of their enumerators. */
static const name_list targets = {
    .words = (const char *const[]){"near", "far", "format", "mapping", "separation", "distance", "frusta", NULL}};
static const name_list themes = {.words = (const char *const[]){"light", "dark", "print", NULL}};
static const name_list types = {.words = (const char *const[]){"svg", "pdf", "png", NULL}};
static const name_list colours = {.words = (const char *const[]){"auto", "always", "never", NULL}};
static const name_list languages = {.get = list_language};
static const name_list code_parts = {
    .words = (const char *const[]){"linearize", "projection", "encode", "position", "pack", "normal", NULL}};
static const name_list reports = {.words = (const char *const[]){"text", "json", "junit", NULL}};

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

/* clang-format off */
const option_row option_rows[OPTION_COUNT] = {
    [OPTION_NEAR] = {"near", 'n', "Z",
        "near plane", .parse = parse_near, FIELD(double, camera.znear),
        LIMITS(1e-12, 1e12, "scene units"), .standard = "0.1",
        .group = "The camera"},
    [OPTION_FAR] = {"far", 'f', "Z|inf",
        "far plane, up to 1e28 scene units and at least 1e-6 of near beyond it, or inf",
        parse_far, .standard = "1000"},
    [OPTION_FORMAT] = {"format", 'F', "NAME[,NAME...]|all",
        "depth formats: @, names as the APIs write them, unormN, floatE.M[bB]; all means those of "
        "'depthprec list formats'", parse_formats, .names = &formats, .standard = "all"},
    [OPTION_MAPPING] = {"mapping", 'm', "NAME[,NAME...]|all",
        "mappings: @; all means d3d and reversed",
        parse_mappings, .names = &mappings, .standard = "all"},
    [OPTION_LOG_C] = {"log-c", 0, "C",
        "constant C of the logarithmic mappings", NUMBER(camera.log_c, 1e-12, 1e12, NULL), .standard = "1"},
    [OPTION_ORTHO] = {"ortho", 0, NULL,
        "orthographic projection; not with linear and log", .parse = parse_ortho, SIZED(camera.ortho),
        .without = "perspective"},
    [OPTION_PRESET] = {"preset", 0, "NAME",
        "an engine's near, far, mapping and format, where not given: @; see 'depthprec list presets'",
        .parse = parse_preset, .names = &presets},
    [OPTION_PLATFORM] = {"platform", 0, "NAME",

        "what a browser or API stores when asked for 24 bits: formats, mapping and arithmetic, where not given; "
        "overrides all of a preset but its mapping: @; see 'depthprec list platforms'",
        ROW(camera.platform, platforms)},
    [OPTION_UNIT] = {"unit", 0, NULL,
        "the length of a scene unit; presets are converted to it; any length can have a unit: 10cm",
        .parse = parse_unit, .names = &units, .without = "that of the preset, or m where a length has a unit"},
    [OPTION_ROUNDING] = {"rounding", 0, NULL,
        "how a depth between two codes is rounded: to nearest with ties up in unorm formats and to even in floats, as "
        "the APIs require; to nearest with ties to even in both; or towards 0",
        WORD(camera.rounding, roundings), .standard = "nearest",
        .group = "The arithmetic"},
    [OPTION_MODEL] = {"model", 0, NULL,
        "the arithmetic before the buffer: exact, which leaves the lattice alone; NDC and window depth each rounded to "
        "binary32; every operation in binary32; or the simplest that suffices",
        WORD(camera.model, models), .standard = "exact"},
    [OPTION_ARITH] = {"arith", 0, "NAME|FILE",
        "the binary32 arithmetic: @; or as 'depthprec probe --json -o FILE' found it", .parse = parse_arith,
        SIZED(camera.arith), .names = &ariths, .standard = "ieee"},
    [OPTION_TOLERANCE] = {"tolerance", 0, "SHARE",
        "the relative error allowed, 0.05 or 5%: a model suffices if it neglects no more of the separation, and "
        "the cheapest method whose bound is no larger is used", parse_tolerance, .standard = "5%"},
    [OPTION_AT] = {"at", 0, "Z[,Z...]|LO:HI:log|lin:COUNT",
        "the depths to evaluate, at most 1000000, within [near, far]", parse_at, FIELD(depths, camera.at),
        .without = "nine, log-spaced from near to far, or to 1e6 times near; linear if near is 0 or negative",
        .group = "The depths"},
    [OPTION_RANGE] = {"range", 0, "LO:HI",
        "the depths over which the worst case is taken", parse_range, .without = "near to far"},
    [OPTION_DEPTH] = {"depth", 0, "D[,D...]",
        "the inverse: the eye depth of each of these window depths, and its cell",
        SEVERAL(parse_list, wanted.looked_up, 0, 1)},
    [OPTION_CODE] = {"code", 0, "N[,N...]",
        "the same for stored codes, decimal or 0x...; the code of a float is its bit pattern",
        SEVERAL(parse_codes, wanted.looked_up, 0, 4294967295)},
    [OPTION_CONSTANTS] = {"constants", 0, NULL,
        "instead: what shaders are given of the camera (_ZBufferParams, _ProjectionParams, UNITY_NEAR_CLIP_VALUE, "
        "corner rays), what LinearEyeDepth and its kin make of each depth, and what formulas read that are not right",
        FLAG(wanted.constants)},
    [OPTION_FOR] = {"for", 0, NULL,
        "what to solve for; distance: the depth up to which --separation or --error holds; frusta: the fewest "
        "that resolve --separation from near to far", WORD(wanted.target, targets),
        .without = "the first of near, far, format and mapping that is not given", .group = "What is wanted"},
    [OPTION_SEPARATION] = {"separation", 0, "S",
        "surfaces S scene units apart must be resolved, however they are aligned",
        POSITIVE(wanted.separation)},
    [OPTION_ERROR] = {"error", 0, "E",
        "instead: the largest error of the decoded depth, in scene units: at --at for the codes that lie there, or at "
        "every depth of --range", POSITIVE(wanted.error)},
    [OPTION_INTERPOLATION] = {"interpolation", 0, "E",
        "error of a window depth interpolated across a triangle",
        NUMBER(world.terms.interpolation, 0, 0x1p24, "units of 2^-24"), .standard = "0", .group = "The budget"},
    [OPTION_FROM_ORIGIN] = {"from-origin", 0, "R",
        "start from world positions; no coordinate of a vertex or of the camera exceeds R",
        LENGTH(world.terms.world, 0, 1e18, "scene units"), .standard = "0", .without = "eye depth is given"},
    [OPTION_COMPOSITION] = {"composition", 0, NULL,
        "how they become clip coordinates: by one binary32 view-projection matrix, multiplied in double and rounded, "
        "or multiplied in binary32; or after subtracting the camera's position in double",
        WORD(world.terms.composition, compositions), .standard = "once"},
    [OPTION_SCHEME] = {"scheme", 0, "NAME[:SIZE][,NAME...]|all",
        "world-to-view schemes: @; SIZE of a split, tile or cell in scene units; see 'depthprec "
        "list schemes'", parse_schemes, .names = &schemes_or_all, .standard = "all"},
    [OPTION_SHARE] = {"share", 0, NULL,
        "the meshes of both surfaces have one origin and share its rounding", FLAG(world.shared_origin),
        .without = "each has its own"},
    [OPTION_LINEARIZE] = {"linearize", 0, NULL,
        "include the error of linearizing depth in a binary32 shader", FLAG(world.terms.linearize)},
    [OPTION_LOG2] = {"log2", 0, NULL,
        "error bound of the shader's log2, for logarithmic mappings: 3 ulp, and 2^-21 from 0.5 to 2, as Vulkan, GLSL "
        "and WGSL allow; 2^-21, as Direct3D allows; or correctly rounded",
        WORD(world.terms.log2, log2_rules), .standard = "vulkan"},
    [OPTION_EYE] = {"eye", 0, "X,Y,Z",
        "view the model from this point; needs --look", ORIGIN(view.eye),
        .without = "from every point, at every distance", .group = "The view"},
    [OPTION_LOOK] = {"look", 0, "X,Y,Z",
        "the point that --eye looks at, y up", ORIGIN(view.look)},
    [OPTION_PATH] = {"path", 0, "FILE",
        "view the model from several points: six numbers a line, the eye and the point that it looks at",
        FILE_READ(scene.path)},
    [OPTION_CAMERA] = {"camera", 0, "NAME",
        "view the model from one of its own cameras; near, far and field of view are that camera's where not given",
        TEXT(scene.camera)},
    [OPTION_FOV] = {"fov", 0, "DEG",
        "vertical field of view", NUMBER(view.spec.fov_y, 0.01, 179, "degrees"), .standard = "60"},
    [OPTION_HFOV] = {"hfov", 0, "DEG",
        "horizontal field of view, in place of --fov", NUMBER(camera.fov_x, 0.01, 179, "degrees"),
        .without = "as --fov says"},
    [OPTION_INTRINSICS] = {"intrinsics", 0, "FX,FY,CX,CY",
        "in place of --fov: focal lengths and where the view axis meets the picture, pixels from its left and upper "
        "edge; add 0.5 to CX and CY that count from the middle of the first pixel",
        .parse = parse_intrinsics, FIELD(double, view.intrinsics[0]), .without = "as --fov says"},
    [OPTION_VIEWPORT] = {"viewport", 0, "WxH",
        "include what a rasterizer does to slanted triangles in a viewport of W by H pixels; z is then the depth of "
        "the farther surface, and the separation is along the normal",
        .parse = parse_viewport, .without = "surfaces face the camera"},
    [OPTION_RASTER] = {"raster", 0, "NAME|FILE",
        "the rasterizer, its subpixel grid and how it interpolates depth: @; spec-...: the worst that the "
        "specification allows; see 'depthprec list rasterizers'; or as 'depthprec probe --json -o FILE' found it",
        .parse = parse_raster, FIELD(const raster_row *, camera.raster), .names = &rasters,
        .without = "--subpixel, and a depth plane anchored at a vertex"},
    [OPTION_SUBPIXEL] = {"subpixel", 0, "BITS",
        "instead: bits of the subpixel grid that vertices snap to; Direct3D has 8, Vulkan and OpenGL at least 4; "
        "with spec-vulkan and spec-gl how many, if more",
        WHOLE(camera.triangles.subpixel, 1, 8, "bits"), .standard = "8"},
    [OPTION_SLANT] = {"slant", 0, "LO:HI",
        "angles between surface normal and view axis, degrees; 0 faces the camera, 90 is edge-on",
        .parse = parse_slant, .standard = "0:90"},
    [OPTION_TRIANGLE_CLASS] = {"triangle-class", 0, "depth=K,pixels=P,slim=Q",
        "the triangles covered: vertices at depths from z/K to K z, at most P pixels wide and high, aspect ratio at "
        "most Q:1",
        .parse = parse_triangle, .standard = "depth=2,pixels=512,slim=16"},
    [OPTION_CASCADES] = {"cascades", 0, "N[:LAMBDA]",
        "number of shadow maps, 1 to 8, that cover the view from near to far; LAMBDA 0 splits it uniformly, 1 "
        "logarithmically",
        .parse = parse_cascades, SIZED(shadow.cascades), .standard = "4:0.5", .group = "The shadow map"},
    [OPTION_LIGHT_BOX] = {"light-box", 0, "WxHxD",
        "one shadow map of a box: width, height, and depth along the light", .parse = parse_light_box,
        .without = "cascades of the view"},
    [OPTION_CASTERS] = {"casters", 0, "Z",
        "how far towards the light from a cascade casters are included",
        LENGTH(shadow.casters, 0, 1e12, "scene units"), .standard = "100"},
    [OPTION_KERNEL] = {"kernel", 0, "N",
        "the filter reads NxN texels: 1 nearest, 2 bilinear, 3 and more percentage-closer filtering",
        WHOLE(shadow.kernel, 1, 64, "texels"), .standard = "3"},
    [OPTION_ANGLE] = {"angle", 0, "DEG",
        "receivers stay free of acne up to this angle between their normal and the light",
        NUMBER(angle, 0, SHADOW_SLANT_MAX, "degrees"), .standard = "75"},
    [OPTION_CURVATURE] = {"curvature", 0, "Z[:FACET]",
        "receivers curve away from the light with a radius of at least Z; tessellated into triangles of circumradius "
        "FACET or less, or smooth", .parse = parse_curvature, FIELD(double, shadow.curvature), .without = "flat"},
    [OPTION_CAMERA_DEPTH] = {"camera-depth", 0, "FORMAT:MAPPING[:FAR]",
        "screen-space shadows: receivers are rebuilt from the camera's depth texture in this format and mapping, of "
        "the view's near plane and FAR, else --far", .parse = parse_camera_depth, FIELD(dp_spec, shadow.camera)},
    [OPTION_API] = {"api", 0, "NAME[,NAME...]",
        "the API whose depth-bias rule applies: @; several, or all, are compared, each with its call",
        .parse = parse_apis, FIELD(unsigned, bias.apis), .names = &apis, .standard = "d3d11",
        .group = "The bias"},
    [OPTION_UNITS] = {"units", 0, "U",
        "constant bias in units of r, a whole number for d3d11, d3d12 and webgpu; in window depth for d3d9 and "
        "vulkan-float; inf or -inf as a program sets it that casts it",
        .parse = parse_units, FIELD(double, bias.units), LIMITS(-1e12, 1e12, NULL),
        .without = "the units needed"},
    [OPTION_FACTOR] = {"factor", 0, "F",
        "bias in units of the window slope", NUMBER(bias.factor, -1e12, 1e12, NULL), .standard = "0"},
    [OPTION_CLAMP] = {"clamp", 0, "C",
        "greatest bias, or least when negative, in window depth", NUMBER(bias.clamp, -1e12, 1e12, NULL),
        .standard = "0", .without = "none"},
    [OPTION_SLOPE] = {"slope", 0, "S",
        "change of eye depth from one pixel to the next", LENGTH(bias.slope, 0, 1e12, "scene units per pixel"),
        .standard = "0", .without = "facing the camera"},
    [OPTION_SAMPLE] = {"sample", 0, "N",
        "test N random pairs", WHOLE(census.sample, 1, 1e12, NULL),
        .without = "every depth; about 500 pairs of planes with --rasterize", .group = "Pairs of surfaces"},
    [OPTION_SEED] = {"seed", 0, "S", /* JSON holds it exactly */
        "seed of --sample; the same seed gives the same pairs", WHOLE(census.seed, 0, 0x1p53, NULL), .standard = "0"},
    [OPTION_RASTERIZE] = {"rasterize", 0, NULL,
        "rasterize pairs of slanted planes as random triangles: how close they get before a pixel is wrong, against "
        "the guarantee", FLAG(census.drawn)},
    [OPTION_AGAINST] = {"against", 0, "PROGRAM[,PROGRAM...]|all",
        "the vertex programs of the main pass: @", .parse = parse_against, .names = &programs_or_all, .standard = "all",
        .group = "Two vertex programs"},
    [OPTION_PROGRAM] = {"program", 0, "PROGRAM",
        "the vertex program of the depth prepass", ROW(census.program, programs), .standard = "once"},
    [OPTION_VERTICES] = {"vertices", 0, NULL,
        "distribution of the vertices: eye depth log-uniform over --range, in a round view of 90 degrees; or uniform "
        "in the box of --from-origin", WORD(census.vertices, spreads), .standard = "eye-log"},
    [OPTION_WITHIN] = {"within", 0, "Z",
        "exit 1 if surfaces may z-fight nearer than this depth; and print the separation that fixes it",
        POSITIVE(scene.within),
        .without = "10 times the model's extent, or as far as the camera resolves 1 % of it; from eyes, as far as the "
                   "model reaches", .group = "The model"},
    [OPTION_ALSO] = {"also", 0, "NAME[,NAME...]|all",
        "also judge pairs of triangles that are left out by default: @", .parse = parse_also, .names = &filters_or_all},
    [OPTION_TRANSFORMS] = {"transforms", 0, NULL,
        "how node transforms are applied: exactly, or rounded at each step, as an engine does",
        WORD(scene.transforms, transforms), .standard = "exact"},
    [OPTION_RENDER] = {"render", 0, "FILE",
        "write a PNG of what the camera sees, as --raster draws it; pixels that show the wrong surface are red",
        FILE_WRITTEN(scene.render)},
    [OPTION_EMIT_NEED] = {"emit-need", 0, "FILE",
        "write a requirement file for check: what the camera must resolve up to --within",
        FILE_WRITTEN(scene.emit_need)},
    [OPTION_DEVICE] = {"device", 0, "N|NAME|gl",
        "the GPU: its number among the Vulkan devices, or part of its name; gl: the OpenGL device, through EGL",
        SOME_TEXT(probe.device),
        .without = "the first Vulkan device that is not a CPU", .group = "The GPU"},
    [OPTION_KEEP] = {"keep", 0, "FILE",
        "write a CSV of every stored code beside what was drawn", FILE_WRITTEN(probe.keep)},
    [OPTION_LANGUAGE] = {"language", 0, NULL,
        "the language: @; 'depthprec list languages' has what each promises of its arithmetic",
        ROW(code.language, languages), .standard = "glsl", .group = "The code"},
    [OPTION_WHAT] = {"what", 0, NULL,
        "linearize: eye depths of window depths; projection: the matrix; encode: codes of --format, of a linear or "
        "logarithmic mapping the window depth that a shader writes; position: places of pixels in view space; pack: "
        "depths in channels of a texture, METHOD as 'depthprec list packings'; normal: normals, METHOD as 'depthprec "
        "list encodings'",
        WORD(code.what, code_parts),
        .standard = "linearize"},
    [OPTION_UNIFORMS] = {"uniforms", 0, NULL,
        "constants of the camera are parameters of the function", FLAG(code.uniforms)},
    [OPTION_PAIRS] = {"pairs", 0, "FILE",
        "what went into the function and what came out, two columns: CSV, or npy", FILE_READ(judge.pairs),
        .group = "Code of your own"},
    [OPTION_PAIRS_FOR] = {"pairs-for", 0, "N",
        "print N window depths to put into the function", WHOLE(judge.depths, 8, 1e6, NULL)},
    [OPTION_DEFINE] = {"define", 0, "NAME=VALUE",
        "what a uniform or parameter of the function is: near, far, near_far, z_buffer_params, projection_params, "
        "camera_params, inv_device_z, projection, inverse_projection, either with _lh for a camera that looks along "
        "+z, or a number; of a member of a structure with its name, camera.near=near; of a macro 1 or 0; may be "
        "repeated", .parse = parse_define, .without = "guessed by common names",
        .repeats = true},
    [OPTION_MINE] = {"mine", 0, "FILE:FUNCTION",
        "a function of yours from a window depth to its eye depth, in GLSL, HLSL or FILE.spv, stands beside the "
        "methods of linearize, timed on this machine's GPU as ours are; may be repeated",
        .parse = parse_mine, .repeats = true},
    [OPTION_MATRIX] = {"matrix", 0, "FILE",
        "a projection matrix, 16 numbers in row order, for column vectors: gives the planes and the field of view; may "
        "be off-centre, with an oblique near plane; NDC depth follows --mapping",
        FILE_READ(image.matrix), .without = "as --near, --far and --fov give it", .group = "The depth texture"},
    [OPTION_LAST_EYE] = {"last-eye", 0, "X,Y,Z",
        "last frame's --eye, for motion blur", ORIGIN(view.last_eye), .without = "as in this frame"},
    [OPTION_LAST_LOOK] = {"last-look", 0, "X,Y,Z",
        "last frame's --look", ORIGIN(view.last_look), .without = "as in this frame"},
    [OPTION_SYNTHETIC] = {"synthetic", 0, "NAME",
        "a synthetic image in place of FILE: @; 'depthprec list synthetic' has their parameters",
        ROW(image.synthetic, synthetics)},
    [OPTION_SIZE] = {"size", 0, "WxH",
        "size of the image in pixels: for --synthetic, for a raw FILE, and for an effect alone that needs positions",
        parse_size,
        .standard = "640x360",
        .instead = "; a figure's size is --figure-size"},
    [OPTION_PARAMETER] = {"parameter", 0, "NAME=VALUE",
        "a parameter of the synthetic image or the effect; may be repeated", .parse = parse_parameter, .repeats = true},
    [OPTION_SKY] = {"sky", 0, "T|none",
        "window depths within T of the far plane are sky, which no product has; 0: only the far plane itself; none: "
        "sky lies at the far plane, as shaders read it, and fog covers it",
        .parse = parse_sky, FIELD(double, image.sky), LIMITS(0, 0.5, NULL), .standard = "0.0001",
        .without = "as in Unity's shaders"},
    [OPTION_METRIC] = {"metric", 0, "SCALE|mm|tum|kitti|sun3d|nyu-raw",
        "the samples are eye depths in units of SCALE, 1 of COMPUTE_EYEDEPTH; of TUM there are 5000 to the metre, of "
        "KITTI 256; of SUN3D and NYU's raw files the bits are moved back, of others behind a comma: rotated, swapped, "
        "halves; 0, negative numbers, NaN and infinity are holes",
        .parse = parse_metric, .names = &samples, FIELD(double, image.metric),
        LIMITS(METRIC_SCALE_MIN, METRIC_SCALE_MAX, "scene units")},
    [OPTION_STEREO] = {"stereo", 0, "focal=F,baseline=B[,offset=O][,step=S]|NAME",
        "the samples are disparities: O + S x sample is that in pixels, of a focal length of F pixels and a baseline "
        "B, a length; S may be a quotient, 1/256, and is below 0 where larger samples are farther; NAME is one of "
        "'depthprec list sensors', of which others of these may follow; 0 and what is not finite are holes",
        .parse = parse_stereo, .names = &stereos, FIELD(stereo_spec, image.stereo)},
    [OPTION_LATTICE] = {"lattice", 0, "NAME[:NUMBERS]",
        "what metric depth was rounded to before, in place of what the image shows: stereo:FOCAL,BASELINE[,PIXELS] "
        "with the step of disparity in pixels, inverse:A[,B] with steps of 1/A in 1/z, even:STEP[,FROM] in z, "
        "inverse-levels:N or levels:N from the nearest to the farthest depth, binary16, file, or a name from "
        "'depthprec list sensors'; @STEP behind it if it was rounded to that before it was stored",
        TEXT(image.lattice), .without = "as found"},
    [OPTION_RADIAL] = {"radial", 0, NULL,
        "with --metric: the samples are distances along the rays, which --fov, --hfov or --intrinsics says",
        FLAG(image.radial)},
    [OPTION_PACKING] = {"packing", 0, "NAME",
        "how the channels of FILE together hold the depth: @; see 'depthprec list packings'",
        ROW(image.packing, packings)},
    [OPTION_CHANNEL] = {"channel", 0, "NAME",
        "the EXR channel to read", TEXT(image.channel), .without = "the first there is of Z, depth and R"},
    [OPTION_PIXEL] = {"pixel", 0, "X,Y[;X,Y...]",
        "describe single pixels: code, eye depth and its range, neighbours, position, normal; 0,0 is the "
        "top left. With an effect alone: the pixel that sees the depths",
        SEVERAL(parse_pixels, image.pixels, 0, IMAGE_SIDE_MAX - 1)},
    [OPTION_PRODUCT] = {"product", 0, "KIND[:METHOD[:NORMALS]]",
        "what is made of the depths: @; position:METHOD and normal:METHOD say how, effect:NAME and pack:NAME which; "
        "NORMALS is the method of those that effect:outline compares and pack:depth-normals holds, else those that "
        "FILE holds or, for effect:outline, the scene has, else projective; see 'depthprec list products'. An effect "
        "without an image: the usable values of its parameter",
        .parse = parse_product, FIELD(const product_row *, image.product), .names = &products},
    [OPTION_AS] = {"as", 0, "NAME[:NUMBERS]",
        "eye depths as another sensor or format would have stored them: the nearest levels of what --lattice has names "
        "for, which begin at 0 where nothing else is said", TEXT(image.as), .without = "not rounded"},
    [OPTION_PICTURE] = {"picture", 0, "FILE",
        "a PNG of colours of the same size, onto which --product effect is composed as shaders do; sky then lies at "
        "the far plane unless --sky is given", FILE_READ(image.picture)},
    [OPTION_TINT] = {"tint", 0, "R,G,B[,A]",
        "with --picture: the colour of the fog, line, water, ..., each part from 0 to 1", .parse = parse_tint,
        FIELD(double, image.tint[0]), .without = "that of the effect"},
    [OPTION_HI_Z] = {"hi-z", 0, "LEVEL[:nearest][:FORMAT]",
        "write a level of the conservative pyramid of the farthest depths, or of the nearest, as window depth: 0 is "
        "the image, each further one half as wide and high; in FORMAT rounded to the safe side",
        .parse = parse_hi_z, FIELD(unsigned, image.hi_z)},
    [OPTION_NORMAL_FORMAT] = {"normal-format", 0, NULL,
        "direction of y in a PNG of normals: up, or down", WORD(image.normal_format, normal_formats),
        .standard = "opengl"},
    [OPTION_ERROR_MAP] = {"error-map", 0, NULL,
        "write the error of the product instead; with =FILE, beside the product in the same pass",
        .parse = parse_error_map, SIZED(image.error_map), .optional = "FILE"},
    [OPTION_FIGURE] = {"figure", 0, "FILE",
        "draw the product: SVG, PDF or PNG; up to 256 surfaces of a synthetic image that share a code with what is "
        "behind are marked", FILE_WRITTEN(image.figure)},
    [OPTION_OVERLAY] = {"overlay", 0, "E",
        "with --figure: depth in grey, coloured where the error of eye depth is, or may be, more than E scene units",
        POSITIVE(image.overlay)},
    [OPTION_HISTOGRAM] = {"histogram", 0, "FILE",
        "draw a histogram of eye depth beside the codes available there: SVG, PDF or PNG",
        FILE_WRITTEN(image.histogram)},
    [OPTION_TYPE] = {"type", 0, NULL,
        "type of the figure, for stdout or a file name without such an ending", WORD(figure.type, types),
        .standard = "svg", .group = "The figure"},
    [OPTION_THEME] = {"theme", 0, NULL,
        "colours of the figure", WORD(figure.theme, themes), .standard = "light"},
    [OPTION_FIGURE_SIZE] = {"figure-size", 0, "W[xH]",
        "width and height of the figure, pixels", .parse = parse_figure_size, .without = "depends on the figure"},
    [OPTION_BESIDE] = {"beside", 0, "OPTIONS",
        "also draw another camera in the same figure: its options, all of them, as one word", TEXT(figure.beside)},
    [OPTION_AXES] = {"axes", 0, "LO:HI,LO:HI",
        "the ends of the axes: of depth, and of what is drawn", .parse = parse_axes, .without = "as the curves need"},
    [OPTION_TITLE] = {"title", 0, "TEXT",
        "title of the figure", TEXT(figure.title)},
    [OPTION_LINK] = {"link", 0, NULL,
        "print a link that opens this command in the page depthprec.html, or in the copy of it at URL",
        .parse = parse_link, FIELD(const char *, out.link), .optional = "URL", .group = "Output"},
    [OPTION_REPORT] = {"report", 0, NULL,
        "format of the verdicts: text, JSON, or JUnit XML",
        WORD(out.report, reports), .standard = "text"},
    [OPTION_JSON] = {"json", 0, NULL,
        "write JSON, one object, schema depthprec/1", parse_form, .least = FORM_JSON},
    [OPTION_CSV] = {"csv", 0, NULL,
        "write CSV (RFC 4180) with units in the header row", parse_form, .least = FORM_CSV},
    [OPTION_OUTPUT] = {"output", 'o', "FILE",
        "write to FILE once complete; - is stdout", FILE_WRITTEN(out.file), .without = "stdout"},
    [OPTION_THREADS] = {"threads", 0, "N",
        "use at most N threads; results do not change", WHOLE(out.threads, 1, 1024, NULL), .without = "all cores"},
    [OPTION_QUIET] = {"quiet", 'q', NULL,
        "no messages and no progress, only data and errors", FLAG(out.quiet)},
    [OPTION_FULL] = {"full", 0, NULL,
        "all columns, however wide", FLAG(out.full)},
    [OPTION_COLOR] = {"color", 0, NULL,
        "bold headings and coloured verdicts in text; auto: on a terminal where NO_COLOR is not set",
        WORD(out.colour, colours), .standard = "auto"},
    [OPTION_HELP] = {"help", 'h', NULL,
        "this help", .parse = NULL},
    [OPTION_VERSION] = {"version", 'V', NULL,
        "version and licence", .parse = NULL},
};
/* clang-format on */
