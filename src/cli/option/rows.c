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
static const name_list packings = {.get = list_packing};
/* In the order of their enumerators. */
static const name_list targets = {
    .words = (const char *const[]){"near", "far", "format", "mapping", "separation", "distance", "frusta", NULL}};
static const name_list themes = {.words = (const char *const[]){"light", "dark", "print", NULL}};
static const name_list types = {.words = (const char *const[]){"svg", "pdf", "png", NULL}};
static const name_list colours = {.words = (const char *const[]){"auto", "always", "never", NULL}};
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
        "far plane, up to 1e18 scene units and at least 1e-6 of near beyond it, or inf",
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
        "an engine's near, far, mapping and format, for those that are not given: @; see 'depthprec list presets'",
        .parse = parse_preset, .names = &presets},
    [OPTION_PLATFORM] = {"platform", 0, "NAME",

        "what a browser stores for a page that asks for 24 bits: formats, mapping, arithmetic, where they are not "
        "given; of presets it replaces all but the mapping: @; see 'depthprec list platforms'",
        ROW(camera.platform, platforms)},
    [OPTION_UNIT] = {"unit", 0, NULL,
        "what a scene unit is; presets are converted to it; any length may carry a unit: 10cm",
        .parse = parse_unit, .names = &units, .without = "that of the preset, or m where a length has a unit"},
    [OPTION_ROUNDING] = {"rounding", 0, NULL,
        "how a depth between two codes is rounded: ties upwards in unorm formats and to even in floats, as the APIs "
        "demand; ties to even in both; or towards 0", WORD(camera.rounding, roundings), .standard = "nearest",
        .group = "The arithmetic"},
    [OPTION_MODEL] = {"model", 0, NULL,
        "the arithmetic before the buffer: none, the lattice alone; NDC and window depth each rounded to binary32; "
        "every operation in binary32; or the simplest that is enough", WORD(camera.model, models), .standard = "exact"},
    [OPTION_ARITH] = {"arith", 0, "NAME|FILE",
        "the binary32 arithmetic: @; or as 'depthprec probe --json -o FILE' found it", .parse = parse_arith,
        SIZED(camera.arith), .names = &ariths, .standard = "ieee"},
    [OPTION_TOLERANCE] = {"tolerance", 0, "SHARE",
        "the error allowed, 0.05 or 5%: a model is enough if it neglects no more of the separation; and the "
        "cheapest method that claims no more is used", parse_tolerance, .standard = "5%"},
    [OPTION_AT] = {"at", 0, "Z[,Z...]|LO:HI:log|lin:COUNT",
        "the depths asked about, at most 1000000, within [near, far]", parse_at, FIELD(depths, camera.at),
        .without = "nine, log-spaced from near to far, or to 1e6 times near; evenly where near is not above 0",
        .group = "The depths"},
    [OPTION_RANGE] = {"range", 0, "LO:HI",
        "the depths over which worst cases are taken", parse_range, .without = "near to far"},
    [OPTION_DEPTH] = {"depth", 0, "D[,D...]",
        "the reverse: the eye depths of these window depths, each with its cell",
        SEVERAL(parse_list, wanted.looked_up, 0, 1)},
    [OPTION_CODE] = {"code", 0, "N[,N...]",
        "the same for stored codes, decimal or 0x...; the code of a float is its bits",
        SEVERAL(parse_codes, wanted.looked_up, 0, 4294967295)},
    [OPTION_FOR] = {"for", 0, NULL,
        "what to solve for; distance is the depth up to which --separation or --error holds, frusta the "
        "least number of frusta that keep --separation from near to far", WORD(wanted.target, targets),
        .without = "the first of near, far, format and mapping that is not given", .group = "What is wanted"},
    [OPTION_SEPARATION] = {"separation", 0, "S",
        "surfaces S scene units apart must be told apart, whatever their alignment",
        POSITIVE(wanted.separation)},
    [OPTION_ERROR] = {"error", 0, "E",
        "instead: the decoded depth may be at most E scene units off: at --at as the codes lie there, or at "
        "every depth of --range", POSITIVE(wanted.error)},
    [OPTION_INTERPOLATION] = {"interpolation", 0, "E",
        "error of a window depth interpolated across a triangle",
        NUMBER(world.terms.interpolation, 0, 0x1p24, "units of 2^-24"), .standard = "0", .group = "The budget"},
    [OPTION_FROM_ORIGIN] = {"from-origin", 0, "R",
        "start from world positions; no coordinate of theirs or of the camera exceeds R",
        LENGTH(world.terms.world, 0, 1e18, "scene units"), .standard = "0", .without = "eye depth is given"},
    [OPTION_COMPOSITION] = {"composition", 0, NULL,
        "how they become clip coordinates: by one binary32 matrix of view and projection, multiplied in double and "
        "rounded, or in binary32; or after the camera's position is subtracted in double",
        WORD(world.terms.composition, compositions), .standard = "once"},
    [OPTION_SCHEME] = {"scheme", 0, "NAME[:SIZE][,NAME...]|all",
        "how vertices come before the camera: @; the size of a split, tile or cell in scene units; see 'depthprec "
        "list schemes'", parse_schemes, .names = &schemes_or_all, .standard = "all"},
    [OPTION_SHARE] = {"share", 0, NULL,
        "both surfaces are of meshes about one origin, whose rounding they share", FLAG(world.shared_origin),
        .without = "each has its own"},
    [OPTION_LINEARIZE] = {"linearize", 0, NULL,
        "also count the loss of reading eye depth back in a binary32 shader", FLAG(world.terms.linearize)},
    [OPTION_LOG2] = {"log2", 0, NULL,
        "what the log2 of a shader may be off by, for logarithmic mappings: 3 units in the last place and 2^-21 from "
        "0.5 to 2, as Vulkan, GLSL and WGSL say; 2^-21, as Direct3D says; or rounded once",
        WORD(world.terms.log2, log2_rules), .standard = "vulkan"},
    [OPTION_EYE] = {"eye", 0, "X,Y,Z",
        "judge from an eye at this place in the model; needs --look", ORIGIN(view.eye),
        .without = "from every place at every distance", .group = "The view"},
    [OPTION_LOOK] = {"look", 0, "X,Y,Z",
        "the place that --eye looks at, y upwards", ORIGIN(view.look)},
    [OPTION_PATH] = {"path", 0, "FILE",
        "judge from several eyes: a line for each, its place and the place that it looks at, six numbers",
        FILE_READ(scene.path)},
    [OPTION_CAMERA] = {"camera", 0, "NAME",
        "judge from a camera of the model, by its name; near, far and field of view are its own where they are not "
        "given", TEXT(scene.camera)},
    [OPTION_FOV] = {"fov", 0, "DEG",
        "vertical field of view", NUMBER(view.spec.fov_y, 0.01, 179, "degrees"), .standard = "60"},
    [OPTION_HFOV] = {"hfov", 0, "DEG",
        "horizontal field of view, in place of --fov", NUMBER(camera.fov_x, 0.01, 179, "degrees"),
        .without = "as --fov says"},
    [OPTION_VIEWPORT] = {"viewport", 0, "WxH",
        "count what a rasterizer does to slanted triangles in a viewport of these pixels; z is then the depth of the "
        "farther surface, and the separation is along the normal",
        .parse = parse_viewport, .without = "surfaces face the camera"},
    [OPTION_RASTER] = {"raster", 0, "NAME|FILE",
        "the rasterizer, its subpixel grid and how it sets up depth: @; of the specifications the worst that they "
        "allow; see 'depthprec list rasterizers'; or as 'depthprec probe --json -o FILE' found it",
        .parse = parse_raster, FIELD(const raster_row *, camera.raster), .names = &rasters,
        .without = "--subpixel, and a plane anchored at a vertex"},
    [OPTION_SUBPIXEL] = {"subpixel", 0, "BITS",
        "instead: bits of the grid to which vertices move; Direct3D has 8, Vulkan and OpenGL at least 4; with "
        "spec-vulkan and spec-gl how many more there are",
        WHOLE(camera.triangles.subpixel, 1, 8, "bits"), .standard = "8"},
    [OPTION_SLANT] = {"slant", 0, "LO:HI",
        "angles of the surfaces' normal to the view axis, degrees; 0 faces the camera, 90 is edge-on",
        .parse = parse_slant, .standard = "0:90"},
    [OPTION_TRIANGLE_CLASS] = {"triangle-class", 0, "depth=K,pixels=P,slim=Q",
        "the triangles: vertices at depths from z/K to K z, at most P pixels wide and high, no slimmer than 1:Q",
        .parse = parse_triangle, .standard = "depth=2,pixels=512,slim=16"},
    [OPTION_CASCADES] = {"cascades", 0, "N[:LAMBDA]",
        "shadow maps, 1 to 8, that share the view from near to far, split evenly for LAMBDA 0, logarithmically for 1",
        .parse = parse_cascades, SIZED(shadow.cascades), .standard = "4:0.5", .group = "The shadow map"},
    [OPTION_LIGHT_BOX] = {"light-box", 0, "WxHxD",
        "one shadow map of a box that wide, high and, along the light, deep", .parse = parse_light_box,
        .without = "cascades of the view"},
    [OPTION_CASTERS] = {"casters", 0, "Z",
        "how far before a cascade, towards the light, things cast shadows on it",
        LENGTH(shadow.casters, 0, 1e12, "scene units"), .standard = "100"},
    [OPTION_KERNEL] = {"kernel", 0, "N",
        "the filter reads NxN texels: 1 nearest, 2 bilinear, 3 and more percentage-closer filtering",
        WHOLE(shadow.kernel, 1, 64, "texels"), .standard = "3"},
    [OPTION_ANGLE] = {"angle", 0, "DEG",
        "receivers up to this angle between their normal and the light are free of acne",
        NUMBER(angle, 0, SHADOW_SLANT_MAX, "degrees"), .standard = "75"},
    [OPTION_CURVATURE] = {"curvature", 0, "Z[:FACET]",
        "receivers bend away from the light, with a radius of at least Z; drawn as triangles that fit into circles of "
        "radius FACET, or as they are", .parse = parse_curvature, FIELD(double, shadow.curvature), .without = "planes"},
    [OPTION_API] = {"api", 0, "NAME[,NAME...]",
        "the API whose rule applies: @; several, or all, stand side by side, each with the call to write",
        .parse = parse_apis, FIELD(unsigned, bias.apis), .names = &apis, .standard = "d3d11",
        .group = "The bias"},
    [OPTION_UNITS] = {"units", 0, "U",
        "constant bias in units of r, a whole number for d3d11, d3d12 and webgpu; in window depth for d3d9 and "
        "vulkan-float",
        NUMBER(bias.units, -1e12, 1e12, NULL),
        .without = "the units that are enough"},
    [OPTION_FACTOR] = {"factor", 0, "F",
        "bias in units of the window slope", NUMBER(bias.factor, -1e12, 1e12, NULL), .standard = "0"},
    [OPTION_CLAMP] = {"clamp", 0, "C",
        "greatest bias, or least when negative, in window depth", NUMBER(bias.clamp, -1e12, 1e12, NULL),
        .standard = "0", .without = "none"},
    [OPTION_SLOPE] = {"slope", 0, "S",
        "eye depth changes by S from one pixel to the next", LENGTH(bias.slope, 0, 1e12, "scene units per pixel"),
        .standard = "0", .without = "facing the camera"},
    [OPTION_SAMPLE] = {"sample", 0, "N",
        "draw N pairs at random", WHOLE(census.sample, 1, 1e12, NULL),
        .without = "visit every depth; about 500 pairs of planes with --rasterize", .group = "Pairs of surfaces"},
    [OPTION_SEED] = {"seed", 0, "S", /* JSON holds it exactly */
        "seed of --sample: the same pairs for the same seed", WHOLE(census.seed, 0, 0x1p53, NULL), .standard = "0"},
    [OPTION_RASTERIZE] = {"rasterize", 0, NULL,
        "draw pairs of slanted planes as random triangles: how near they come before a pixel is wrong, against what "
        "is guaranteed", FLAG(census.drawn)},
    [OPTION_AGAINST] = {"against", 0, "PROGRAM[,PROGRAM...]|all",
        "the vertex programs of the main pass: @", .parse = parse_against, .names = &programs_or_all, .standard = "all",
        .group = "Two vertex programs"},
    [OPTION_PROGRAM] = {"program", 0, "PROGRAM",
        "the vertex program of the depth prepass", ROW(census.program, programs), .standard = "once"},
    [OPTION_VERTICES] = {"vertices", 0, NULL,
        "how vertices are drawn: eye depth log-uniform over --range, in a round view of 90 degrees; or uniform in the "
        "box of --from-origin", WORD(census.vertices, spreads), .standard = "eye-log"},
    [OPTION_WITHIN] = {"within", 0, "Z",
        "exit 1 where surfaces can fight nearer than this depth; and the distance that mends it",
        POSITIVE(scene.within),
        .without = "10 times the model's extent, or as far as the camera tells 1 % of it apart; from eyes, as far as "
                   "the model reaches", .group = "The model"},
    [OPTION_ALSO] = {"also", 0, "NAME[,NAME...]|all",
        "pairs of triangles that are else left out: @", .parse = parse_also, .names = &filters_or_all},
    [OPTION_TRANSFORMS] = {"transforms", 0, NULL,
        "how nodes are placed: exactly, or rounded at each step as an engine does",
        WORD(scene.transforms, transforms), .standard = "exact"},
    [OPTION_RENDER] = {"render", 0, "FILE",
        "draw what the camera sees, as --raster draws it, with the pixels in red that show the wrong surface: PNG",
        FILE_WRITTEN(scene.render)},
    [OPTION_EMIT_NEED] = {"emit-need", 0, "FILE",
        "write what the camera must tell apart up to --within as a requirement file of check",
        FILE_WRITTEN(scene.emit_need)},
    [OPTION_DEVICE] = {"device", 0, "N|NAME|gl",
        "the GPU: its number, or a part of its name, of those that Vulkan has; gl: that of OpenGL, by EGL",
        SOME_TEXT(probe.device),
        .without = "Vulkan's first that is no processor", .group = "The GPU"},
    [OPTION_KEEP] = {"keep", 0, "FILE",
        "write every code that was stored, with what was drawn: CSV", FILE_WRITTEN(probe.keep)},
    [OPTION_MATRIX] = {"matrix", 0, "FILE",
        "a projection matrix, 16 numbers row by row, for column vectors: says the planes and the field of view, which "
        "need not be centred; its near plane may be oblique; NDC depth is as --mapping has it",
        FILE_READ(image.matrix), .without = "--near, --far and --fov say it", .group = "The depth texture"},
    [OPTION_LAST_EYE] = {"last-eye", 0, "X,Y,Z",
        "last frame's --eye, for motion blur", ORIGIN(view.last_eye), .without = "that of this frame"},
    [OPTION_LAST_LOOK] = {"last-look", 0, "X,Y,Z",
        "last frame's --look", ORIGIN(view.last_look), .without = "in the direction of this frame"},
    [OPTION_SYNTHETIC] = {"synthetic", 0, "NAME",
        "a synthetic image in place of FILE: @; 'depthprec list synthetic' has their parameters",
        ROW(image.synthetic, synthetics)},
    [OPTION_SIZE] = {"size", 0, "WxH",
        "the image's pixels: with --synthetic, with a raw FILE, and with an effect alone if that needs the position",
        parse_size,
        .standard = "640x360",
        .instead = "; a figure's size is --figure-size"},
    [OPTION_PARAMETER] = {"parameter", 0, "NAME=VALUE",
        "a parameter of the synthetic image or the effect; may be repeated", .parse = parse_parameter},
    [OPTION_SKY] = {"sky", 0, "T",
        "window depths within T of the far plane's are sky; with 0 only the plane's own",
        NUMBER(image.sky, 0, 0.5, NULL), .standard = "0.0001",
        .without = "as in Unity's shaders"},
    [OPTION_METRIC] = {"metric", 0, "SCALE",
        "the samples are eye depths in units of SCALE, 0.001 for millimetres; 0, negative numbers, NaN and infinity "
        "are holes",
        LENGTH(image.metric, METRIC_SCALE_MIN, METRIC_SCALE_MAX, "scene units")},
    [OPTION_LATTICE] = {"lattice", 0, "NAME[:NUMBERS]",
        "what metric depth was rounded to before, in place of what the image shows: stereo:FOCAL,BASELINE[,PIXELS] "
        "with the step of disparity in pixels, inverse:A[,B] with steps of 1/A in 1/z, even:STEP[,FROM] in z, "
        "inverse-levels:N or levels:N from the nearest to the farthest depth, binary16, file",
        TEXT(image.lattice), .without = "as found"},
    [OPTION_PACKING] = {"packing", 0, "NAME",
        "the channels of FILE hold the depth together: @; 'depthprec list packings'", ROW(image.packing, packings)},
    [OPTION_CHANNEL] = {"channel", 0, "NAME",
        "the channel of an EXR that is read", TEXT(image.channel), .without = "Z, R or depth, the first that is there"},
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
    [OPTION_NORMAL_FORMAT] = {"normal-format", 0, NULL,
        "which way y runs in a PNG of normals: up, or down", WORD(image.normal_format, normal_formats),
        .standard = "opengl"},
    [OPTION_ERROR_MAP] = {"error-map", 0, NULL,
        "write the error of the product instead; with =FILE, beside the product in the same pass",
        .parse = parse_error_map, SIZED(image.error_map), .optional = "FILE"},
    [OPTION_FIGURE] = {"figure", 0, "FILE",
        "draw the product: SVG, PDF or PNG; up to 256 surfaces of a synthetic image that share a code with what is "
        "behind are marked", FILE_WRITTEN(image.figure)},
    [OPTION_OVERLAY] = {"overlay", 0, "E",
        "with --figure: depth in grey, and in colour where eye depth is, or can be, off by more than E scene units",
        POSITIVE(image.overlay)},
    [OPTION_HISTOGRAM] = {"histogram", 0, "FILE",
        "draw how many pixels lie at which eye depth, and how many codes there are for them: SVG, PDF or PNG",
        FILE_WRITTEN(image.histogram)},
    [OPTION_TYPE] = {"type", 0, NULL,
        "type of the figure, for stdout or a file name that does not end in one", WORD(figure.type, types),
        .standard = "svg", .group = "The figure"},
    [OPTION_THEME] = {"theme", 0, NULL,
        "colours of the figure", WORD(figure.theme, themes), .standard = "light"},
    [OPTION_FIGURE_SIZE] = {"figure-size", 0, "W[xH]",
        "width and height of the figure, pixels", .parse = parse_figure_size, .without = "as suits the figure"},
    [OPTION_TITLE] = {"title", 0, "TEXT",
        "title of the figure", TEXT(figure.title)},
    [OPTION_LINK] = {"link", 0, NULL,
        "print the link that opens this command in the page depthprec.html, or where =URL says the page is",
        .parse = parse_link, FIELD(const char *, out.link), .optional = "URL", .group = "Output"},
    [OPTION_REPORT] = {"report", 0, NULL,
        "how to write verdicts: text, JSON, or JUnit XML",
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
