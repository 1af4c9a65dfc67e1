/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "world/cmd/origin.h"
#include "cli/list.h"

#include <stdio.h>
#include <string.h>

#include "cli/option/kinds.h"
#include "report/output.h"

static const name_list log2_rules = {.get = list_log2};
static const name_list compositions = {.get = list_composition};
static const name_list schemes_or_all = {.words = (const char *const[]){"all", NULL}, .rows = &world_table};

/* NAME, or NAME:SIZE. */
static int add_scheme(asked_line *line, const option_row *row, const char *text, void *group) {
    origin_asked *o = group;
    char name[64];
    list_item found;
    const size_t length = strcspn(text, ":");
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    if (!names_find(row->names, name, NULL, &found))
        return option_unknown(row, name);
    if (found.row == NULL && text[length] == '\0') {
        for (size_t i = 0; i < WORLD_ROWS; i++)
            add_scheme(line, row, world_get(i)->name, group);
        return EXIT_FINE;
    }
    world_scheme s = {.row = found.row};
    if (s.row != NULL)
        s.size = s.row->metres ? unit_convert(s.row->standard, unit_find("m"), line->lengths->unit) : s.row->standard;
    if (text[length] != '\0' &&
        (s.row == NULL || !number_parse(text + length + 1, NUMBER_FINITE, &s.size) || !world_size_fits(s.row, s.size)))
        return option_refuse(
            row,
            s.row == NULL || s.row->size == NULL ? "%s has no size, got '%s'"
            : s.row->power2 ? "%s:SIZE must be a power of two from 1e-3 to 1e12 scene units, got '%s'"
                            : "%s:SIZE must be a number of scene units from 1e-3 to 1e12, without a unit, got '%s'",
            name, text);
    for (size_t i = 0; i < o->scheme_count; i++)
        if (o->schemes[i].row == s.row && o->schemes[i].size == s.size)
            return EXIT_FINE;
    if (o->scheme_count == ORIGIN_SCHEMES_MAX)
        return option_refuse(row, "must be at most %d schemes", ORIGIN_SCHEMES_MAX);
    o->schemes[o->scheme_count++] = s;
    return EXIT_FINE;
}

static int parse_schemes(asked_line *line, const option_row *row, const char *value, void *group) {
    origin_asked *o = group;
    o->scheme_count = 0;
    return parse_names(line, row, value, group, add_scheme);
}

#define GROUP_TYPE origin_asked

/* clang-format off */
static const option_row origin_rows[] = {
    {"interpolation", 0, "E",
        "error of a window depth interpolated across a triangle",
        NUMBER(terms.interpolation, 0, 0x1p24, "units of 2^-24"), .standard = "0", .group = "The budget"},
    {"from-origin", 0, "R",
        "start from world positions; no coordinate of a vertex or of the camera exceeds R",
        LENGTH(terms.world, 0, 1e18, "scene units"), .standard = "0", .without = "eye depth is given"},
    {"composition", 0, NULL,
        "how they become clip coordinates: by one binary32 view-projection matrix, multiplied in double and rounded, "
        "or multiplied in binary32; or after subtracting the camera's position in double",
        WORD(terms.composition, compositions), .standard = "once"},
    {"scheme", 0, "NAME[:SIZE][,NAME...]|all",
        "world-to-view schemes: @; SIZE of a split, tile or cell in scene units; see 'depthprec "
        "list schemes'", parse_schemes, .names = &schemes_or_all, .standard = "all"},
    {"share", 0, NULL,
        "the meshes of both surfaces have one origin and share its rounding", FLAG(shared_origin),
        .without = "each has its own"},
    {"linearize", 0, NULL,
        "include the error of linearizing depth in a binary32 shader", FLAG(terms.linearize)},
    {"log2", 0, NULL,
        "error bound of the shader's log2, for logarithmic mappings: 3 ulp, and 2^-21 from 0.5 to 2, as Vulkan, GLSL "
        "and WGSL allow; 2^-21, as Direct3D allows; or correctly rounded",
        WORD(terms.log2, log2_rules), .standard = "vulkan"},
    END};
/* clang-format on */

const option_table origin_options = {.rows = origin_rows};

const option_use origin_terms[] = {TAKE("interpolation"), TAKE("from-origin"), TAKE("composition"),
                                   TAKE("linearize"),     TAKE("log2"),        END};

int origin_complete(asked_line *line, const origin_asked *o) {
    bool has_meshes = !option_given(line, "share");
    if (!option_given(line, "scheme"))
        return option_set(line, "scheme", "all");
    for (size_t i = 0; i < o->scheme_count; i++)
        has_meshes = has_meshes || o->schemes[i].row->meshes;
    return has_meshes ? EXIT_FINE
                      : option_error("share", "needs a scheme whose meshes have origins: local, tile, cell or two-sum");
}
