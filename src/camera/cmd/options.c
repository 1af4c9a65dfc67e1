/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options of a camera, of its arithmetic and of depths before it. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "camera/cmd/camera.h"
#include "cli/list.h"
#include "cli/option/kinds.h"
#include "report/output.h"

static const name_list formats = {.words = (const char *const[]){"all", "depth24plus", NULL},
                                  .get = list_format,
                                  .more = " (or a name from 'depthprec list formats'), unormN or floatE.M[bB]"};
static const name_list mappings = {.get = list_mapping, .more = " (or a name from 'depthprec list mappings')"};
static const name_list presets = {.rows = &preset_table};
static const name_list platforms = {.rows = &platform_table};
static const name_list units = {.rows = &unit_table};
static const name_list roundings = {.get = list_rounding};
static const name_list models = {.get = list_model};
static const name_list ariths = {.get = list_arith};

static int parse_unit(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    (void)line;
    c->lengths.unit = unit_find(value);
    return c->lengths.unit != NULL ? EXIT_FINE : option_refuse(row, "must be " UNIT_NAMES ", got '%s'", value);
}

static int add_one_format(camera_asked *c, const option_row *row, const dp_format *format) {
    for (size_t i = 0; i < c->format_count; i++)
        if (strcmp(c->formats[i].name, format->name) == 0)
            return EXIT_FINE;
    if (c->format_count == CAMERA_FORMATS_MAX)
        return option_refuse(row, "must be at most %d formats, got '%s' too", CAMERA_FORMATS_MAX, format->name);
    c->formats[c->format_count++] = *format;
    return EXIT_FINE;
}

static int add_format(asked_line *line, const option_row *row, const char *name, void *group) {
    dp_format found[2];
    const size_t count = dp_format_parse(name, found);
    const bool all = strcmp(name, "all") == 0;
    (void)line;
    int status = count > 0 || all ? EXIT_FINE : option_unknown(row, name);
    for (size_t i = 0; i < (all ? dp_format_count() : count) && status == EXIT_FINE; i++)
        status = add_one_format(group, row, all ? &dp_format_get(i)->format : &found[i]);
    return status;
}

static int parse_formats(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    c->format_count = 0;
    return parse_names(line, row, value, group, add_format);
}

static int add_mapping(asked_line *line, const option_row *row, const char *name, void *group) {
    camera_asked *c = group;
    dp_mapping mapping;
    (void)line;
    if (strcmp(name, "all") == 0) /* ten, of which no camera has all */
        return option_refuse(row, "must name mappings, as d3d,reversed for both directions, got 'all'");
    if (dp_mapping_parse(name, &mapping) != DP_OK)
        return option_unknown(row, name);
    for (size_t i = 0; i < c->mapping_count; i++)
        if (c->mappings[i] == mapping)
            return EXIT_FINE;
    c->mappings[c->mapping_count++] = mapping;
    return EXIT_FINE;
}

static int parse_mappings(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    c->mapping_count = 0;
    return parse_names(line, row, value, group, add_mapping);
}

/* One that is near no name may be of an engine that is not among them. */
static int unknown_preset(const option_row *row, const char *name) {
    char text[NAMES_SIZE];
    const char *refusal = names_refuse(row->names, name, text);
    const bool near = strstr(refusal, "did you mean") != NULL;
    return option_refuse(row, "%s%s", refusal, near ? "" : "; of another engine say --near, --far and --mapping");
}

static int add_preset(asked_line *line, const option_row *row, const char *text, void *group) {
    camera_asked *c = group;
    (void)line;
    if (c->preset_count == CAMERA_PRESETS_MAX)
        return option_refuse(row, "must be at most %d presets, got '%s' too", CAMERA_PRESETS_MAX, text);
    const size_t at = c->preset_count;
    char error[PRESET_ERROR_SIZE];
    if (!preset_read(text, &c->presets[at], &c->values[at], error))
        return *error == '\0' ? unknown_preset(row, c->values[at].words) : option_refuse(row, "%s", error);
    for (size_t i = 0; i < at; i++)
        if (c->presets[i] == c->presets[at] && strcmp(c->values[i].words, c->values[at].words) == 0)
            return EXIT_FINE;
    c->preset_count++;
    return EXIT_FINE;
}

static int parse_preset(asked_line *line, const option_row *row, const char *value, void *group) {
    return value[preset_length(value)] == '\0'
               ? add_preset(line, row, value, group)
               : option_refuse(row, "must be one preset for %s, got '%s'", line->command->name, value);
}

int parse_presets(asked_line *line, const option_row *row, const char *value, void *group) {
    char text[PRESET_WORDS_SIZE];
    for (const char *at = value;; at++) {
        const size_t length = preset_length(at);
        snprintf(text, sizeof text, "%.*s", (int)length, at);
        if (length == 0)
            return option_refuse(row, "must be %s, got '%s'", row->argument, value);
        const int status = length < sizeof text ? add_preset(line, row, text, group) : option_unknown(row, at);
        at += length;
        if (status != EXIT_FINE || *at == '\0')
            return status;
    }
}

/* The tangents of four edges are of use where an angle is. */
static int parse_matrix(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    char error[MATRIX_ERROR_SIZE];
    const int status = *value != '\0' ? camera_matrix_read(&c->matrix, value, error) : ENOENT;
    if (status > 0)
        return option_unreadable(row->name, value, status);
    if (status < 0)
        return option_refuse(row, "%s", error);
    return c->matrix.count == MATRIX_ENTRIES || option_used(line->command, ~0u, option_find(line->command, "fov")).row
               ? EXIT_FINE
               : option_refuse(row, "must hold 16 numbers for %s, which has no view, got 4", line->command->name);
}

/* A near plane that is not positive needs --ortho, which may come later: camera_make(). */
static int parse_near(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    if (!length_read(&(length_reader){.in = line->lengths}, value, strlen(value), NUMBER_FINITE, &c->znear) ||
        c->znear > 0.0)
        return parse_length(line, row, value, group);
    c->znear += 0.0; /* -0 is 0 */
    return EXIT_FINE;
}

int camera_read_far(asked_line *line, const option_row *row, const char *value, double *out) {
    if (!length_read(&(length_reader){.in = line->lengths}, value, strlen(value), NUMBER_FAR, out))
        return option_refuse(row, "must be a number greater than near and at most 1e28, or inf, got '%s'%s", value,
                             length_hint(value, strlen(value)));
    return EXIT_FINE;
}

static int parse_far(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    return camera_read_far(line, row, value, &c->zfar);
}

static int add_far(asked_line *line, const option_row *row, const char *name, void *group) {
    camera_asked *c = group;
    const int status = parse_far(line, row, name, group);
    if (c->far_count == CAMERA_FARS_MAX)
        return option_refuse(row, "must be at most %d far planes, got '%s' too", CAMERA_FARS_MAX, name);
    c->fars[c->far_count++] = c->zfar;
    return status;
}

int parse_fars(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    c->far_count = 0;
    const int status = parse_names(line, row, value, group, add_far);
    for (size_t i = 0; i < c->far_count; i++)
        if (c->fars[i] > c->zfar)
            c->zfar = c->fars[i];
    return status;
}

static int parse_range(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    double range[2] = {0};
    const int status = option_read_range(line, row, value, strlen(value), range);
    c->range_lo = range[0];
    c->range_hi = range[1];
    return status;
}

/* Half the height of what an image shows stands behind "=". */
static int parse_ortho(asked_line *line, const option_row *row, const char *value, void *group) {
    option_row half = *row;
    half.place = offsetof(camera_asked, spec.half_height);
    half.least = 1e-12;
    half.most = 1e12;
    half.unit = "scene units";
    const int status = value != NULL ? parse_length(line, &half, value, group) : EXIT_FINE;
    return status == EXIT_FINE ? parse_flag(line, row, NULL, group) : status;
}

static void begin(asked_line *line, void *group) {
    camera_asked *c = group;
    c->line = line;
    line->lengths = &c->lengths;
    c->triangles = dp_triangles_default();
    c->azimuth = (double)NAN;
    c->spec.half_height = 5.0;
}

/* Lengths are in the unit of the first preset that has one. */
static void early(asked_line *line, void *group) {
    camera_asked *c = group;
    (void)line;
    for (size_t i = 0; i < c->preset_count && c->lengths.unit == NULL; i++)
        c->lengths.unit = unit_find(c->presets[i]->unit);
}

#define GROUP_TYPE camera_asked

/* clang-format off */
static const option_row camera_rows[] = {
    {"near", 'n', "Z",
        "near plane", .parse = parse_near, INTO(double, znear),
        LIMITS(CAMERA_NEAR_LEAST, CAMERA_NEAR_MOST, "scene units"), .standard = "0.1",
        .group = "The camera"},
    {"far", 'f', "Z|inf",
        "far plane, up to 1e28 scene units and at least 1e-6 of near beyond it, or inf",
        parse_far, .standard = "1000"},
    {"matrix", 0, "FILE|NUMBERS",
        "the planes and the mapping of a projection matrix, and its view: 16 numbers, by rows or columns, looking "
        "along z or -z; where two mappings fit, --mapping says which", .parse = parse_matrix,
        .without = "as --near, --far and the like say"},
    {"format", 'F', "NAME[,NAME...]|all",
        "depth formats: @, names as the APIs write them, unormN, floatE.M[bB]; all means those of "
        "'depthprec list formats'", parse_formats, .names = &formats, .standard = "all"},
    {"mapping", 'm', "NAME[,NAME...]",
        "mappings: @", parse_mappings, .names = &mappings, .standard = "d3d,reversed"},
    {"log-c", 0, "C",
        "constant C of the logarithmic mappings", NUMBER(log_c, 1e-12, 1e12, NULL), .standard = "1"},
    {"ortho", 0, NULL,
        "orthographic projection; not with linear and log", .parse = parse_ortho, SIZED(ortho),
        .without = "perspective"},
    {"preset", 0, "NAME[:PARAMETER=NUMBER,...]",
        "an engine's near, far, mapping and format, where not given: @; see 'depthprec list presets', which also says "
        "from what some are computed",
        .parse = parse_preset, .names = &presets, .early = true},
    {"platform", 0, "NAME",
        "what a browser or API stores when asked for 24 bits: formats, mapping and arithmetic, where not given; "
        "overrides all of a preset but its mapping: @; see 'depthprec list platforms'",
        ROW(platform, platforms)},
    {"unit", 0, NULL,
        "the length of a scene unit; presets are converted to it; any length can have a unit: 10cm",
        .parse = parse_unit, .early = true, .names = &units,
        .without = "that of the preset, or m where a length has a unit"},
    {"rounding", 0, NULL,
        "how a depth between two codes is rounded: to nearest with ties up in unorm formats and to even in floats, as "
        "the APIs require; to nearest with ties to even in both; or towards 0",
        WORD(rounding, roundings), .standard = "nearest",
        .group = "The arithmetic"},
    {"model", 0, NULL,
        "the arithmetic before the buffer: exact, which leaves the lattice alone; NDC and window depth each rounded to "
        "binary32; every operation in binary32; or the simplest that suffices",
        WORD(model, models), .standard = "exact"},
    {"arith", 0, "NAME|FILE",
        "the binary32 arithmetic: @; or as 'depthprec probe --json -o FILE' found it", .parse = parse_arith,
        SIZED(arith), .names = &ariths, .standard = "ieee"},
    {"tolerance", 0, "SHARE",
        "the relative error allowed, 0.05 or 5%: a model suffices if it neglects no more of the separation, and "
        "the cheapest method whose bound is no larger is used", parse_share, INTO(double, tolerance),
        .standard = "5%"},
    {"at", 0, "Z[,Z...]|LO:HI:log|lin:COUNT",
        "the depths to evaluate, at most 1000000, within [near, far]; @FILE: those of a file",
        parse_depths, INTO(depths, at),
        .without = "nine, log-spaced from near to far, or to 1e6 times near; linear if near is 0 or negative",
        .group = "The depths"},
    {"range", 0, "LO:HI",
        "the depths over which the worst case is taken", parse_range, .without = "near to far"},
    END};
/* clang-format on */

const option_table camera_options = {.rows = camera_rows, .begin = begin, .early = early};

/* clang-format off */
const option_use camera_planes[] = {
    TAKE("near"), TAKE("far"), TAKE("matrix"), TAKE("format"), TAKE("mapping"), TAKE("unit"), END};

const option_use camera_uses[] = {GROUP_OF(camera_planes), TAKE("preset"), TAKE("rounding"), END};

/* Options of cameras of either projection. */
const option_use camera_projected[] = {
    OWN("near", ALSO("with --ortho also 0 or negative")), TAKE("ortho"), TAKE("platform"), GROUP_OF(camera_uses),
        END};

const option_use camera_beside_viewport[] = {
    TAKE("fov"), TAKE("hfov"), TAKE("raster"), TAKE("subpixel"), TAKE("triangle-class"), END};

const option_use camera_slanted[] = {
    OWN("matrix", ALSO(CAMERA_OF_TANGENTS)),
    OWN("preset", ALSO(CAMERA_OF_VIEW)),
    OWN("platform", ALSO("with --viewport also its rasterizer")),
    OWN("arith", ALSO("by default that of --raster or --platform where known")),
    TAKE("slant"), GROUP_OF(camera_beside_viewport), END};
/* clang-format on */
