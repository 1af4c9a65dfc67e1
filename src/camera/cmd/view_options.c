/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options of a view, and of slanted triangles in it. */
#include <string.h>

#include "camera/cmd/camera.h"
#include "cli/option/kinds.h"
#include "report/output.h"

static const name_list rasters = {.rows = &raster_table};

static int parse_intrinsics(asked_line *line, const option_row *row, const char *value, void *group) {
    (void)line;
    static const double limits[][2] = {{1, 1e9}, {1, 1e9}, {-1e6, 1e6}, {-1e6, 1e6}};
    return option_read_numbers(value, 4, limits, option_field(row, group)) == 4
               ? EXIT_FINE
               : option_refuse(row, "must be %s, the first two from 1 to 1e9, the others from -1e6 to 1e6, got '%s'",
                               row->argument, value);
}

static int parse_viewport(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    (void)line;
    uint64_t sides[2];
    const int status = option_read_sides(row, value, CAMERA_SIDE_MOST, false, sides);
    if (status != EXIT_FINE)
        return status;
    c->triangles.width = (int)sides[0];
    c->triangles.height = (int)sides[1];
    return EXIT_FINE;
}

static int parse_slant(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    (void)line;
    const size_t split = strcspn(value, ":");
    double lo, hi;
    if (value[split] == '\0' || !number_parse_part(value, split, NUMBER_FINITE, &lo) ||
        !number_parse(value + split + 1, NUMBER_FINITE, &hi) || !(lo >= 0.0 && lo <= hi && hi <= 90.0))
        return option_refuse(row, "must be LO:HI, from 0 to 90 degrees, got '%s'", value);
    c->triangles.slant_lo = lo;
    c->triangles.slant_hi = hi;
    return EXIT_FINE;
}

/* A range, or one plane. */
int parse_slant_or_plane(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    const size_t split = strcspn(value, ",");
    double slant, azimuth;
    if (value[split] == '\0')
        return parse_slant(line, row, value, group);
    if (!number_parse_part(value, split, NUMBER_FINITE, &slant) ||
        !number_parse(value + split + 1, NUMBER_FINITE, &azimuth) || !(slant >= 0.0 && slant <= 90.0) ||
        !(azimuth >= -360.0 && azimuth <= 360.0))
        return option_refuse(row, "must be SLANT,AZIMUTH, from 0 to 90 and from -360 to 360 degrees, got '%s'", value);
    c->triangles.slant_lo = c->triangles.slant_hi = slant;
    c->azimuth = azimuth;
    return EXIT_FINE;
}

static const struct {
    const char *name;
    size_t place;
} class_rows[] = {{"depth", offsetof(dp_triangles, depth)},
                  {"pixels", offsetof(dp_triangles, pixels)},
                  {"slim", offsetof(dp_triangles, slim)}};

enum { CLASS_ROWS = sizeof class_rows / sizeof class_rows[0] };

/* One NAME=NUMBER, of `length`, in the range that the library gives it, of a name that is not yet among `seen`. */
static bool read_class(dp_triangles *t, const char *text, size_t length, bool seen[CLASS_ROWS]) {
    for (size_t i = 0; i < CLASS_ROWS; i++) {
        const size_t name = strlen(class_rows[i].name);
        double number;
        if (length <= name || strncmp(text, class_rows[i].name, name) != 0 || text[name] != '=')
            continue;
        if (seen[i] || !number_parse_part(text + name + 1, length - name - 1, NUMBER_FINITE, &number))
            return false;
        seen[i] = true;
        memcpy((char *)t + class_rows[i].place, &number, sizeof number);
        return dp_triangles_check(t) == DP_OK;
    }
    return false;
}

static int parse_triangle(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    (void)line;
    bool seen[CLASS_ROWS] = {false};
    for (const char *at = value;; at++) {
        const size_t length = strcspn(at, ",");
        if (!read_class(&c->triangles, at, length, seen))
            return option_refuse(row,
                                 "must be depth=K from 1 to 1e6, pixels=P from 1 to 65536 and slim=Q from 2 to 1024, "
                                 "each at most once, separated by commas, got '%s'",
                                 value);
        at += length;
        if (*at == '\0')
            return EXIT_FINE;
    }
}

#define GROUP_TYPE camera_asked

/* clang-format off */
static const option_row view_rows[] = {
    {"fov", 0, "DEG",
        "vertical field of view", NUMBER(spec.fov_y, CAMERA_FOV_LEAST, CAMERA_FOV_MOST, "degrees"), .standard = "60"},
    {"hfov", 0, "DEG",
        "horizontal field of view, in place of --fov", NUMBER(fov_x, CAMERA_FOV_LEAST, CAMERA_FOV_MOST, "degrees"),
        .without = "as --fov says"},
    {"intrinsics", 0, "FX,FY,CX,CY",
        "in place of --fov: focal lengths and where the view axis meets the picture, pixels from its left and upper "
        "edge; add 0.5 to CX and CY that count from the middle of the first pixel",
        .parse = parse_intrinsics, INTO(double, intrinsics[0]), .without = "as --fov says"},
    {"viewport", 0, "WxH",
        "include what a rasterizer does to slanted triangles in a viewport of W by H pixels; z is then the depth of "
        "the farther surface, and the separation is along the normal",
        .parse = parse_viewport, .without = "surfaces face the camera"},
    {"raster", 0, "NAME|FILE",
        "the rasterizer, its subpixel grid and how it interpolates depth: @; spec-...: the worst that the "
        "specification allows; see 'depthprec list rasterizers'; or as 'depthprec probe --json -o FILE' found it",
        .parse = parse_raster, INTO(const raster_row *, raster), .names = &rasters,
        .without = "--subpixel, and a depth plane anchored at a vertex"},
    {"subpixel", 0, "BITS",
        "instead: bits of the subpixel grid that vertices snap to; Direct3D has 8, Vulkan and OpenGL at least 4; "
        "with spec-vulkan and spec-gl how many, if more",
        WHOLE(triangles.subpixel, 1, CAMERA_SUBPIXEL_MOST, "bits"), .standard = "8"},
    {"slant", 0, "LO:HI",
        "angles between surface normal and view axis, degrees; 0 faces the camera, 90 is edge-on",
        .parse = parse_slant, .standard = "0:90"},
    {"triangle-class", 0, "depth=K,pixels=P,slim=Q",
        "the triangles covered: vertices at depths from z/K to K z, at most P pixels wide and high, aspect ratio at "
        "most Q:1",
        .parse = parse_triangle, .standard = "depth=2,pixels=512,slim=16"},
    END};
/* clang-format on */

static const option_rule rules[] = {CONFLICTS("hfov", "fov", NULL), {.option = NULL}};

const option_table view_options = {.rows = view_rows, .rules = rules};
