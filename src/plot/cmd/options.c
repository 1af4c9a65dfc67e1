/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a figure looks. */
#include <stdio.h>
#include <string.h>

#include "cli/option/kinds.h"
#include "draw/draw.h"
#include "plot/cmd/request.h"
#include "report/output.h"

static const name_list themes = {.words = (const char *const[]){"light", "dark", "print", NULL}};
static const name_list types = {.words = (const char *const[]){"svg", "pdf", "png", NULL}};

/* The width alone, or both. */
static int parse_figure_size(asked_line *line, const option_row *row, const char *value, void *group) {
    figure_asked *o = group;
    (void)line;
    const size_t length = strcspn(value, "x");
    char width[8];
    uint64_t sides[2] = {0};
    snprintf(width, sizeof width, "%.*s", (int)length, value);
    if (length >= sizeof width || !number_parse_count(width, DRAW_SIZE_MAX, &sides[0]) || sides[0] < DRAW_WIDTH_MIN ||
        (value[length] != '\0' &&
         (!number_parse_count(value + length + 1, DRAW_SIZE_MAX, &sides[1]) || sides[1] < DRAW_HEIGHT_MIN)))
        return option_refuse(row, "must be W or WxH, W from %d to %d and H from %d to %d pixels, got '%s'",
                             DRAW_WIDTH_MIN, DRAW_SIZE_MAX, DRAW_HEIGHT_MIN, DRAW_SIZE_MAX, value);
    o->width = (int)sides[0];
    o->height = (int)sides[1];
    return EXIT_FINE;
}

static int parse_axes(asked_line *line, const option_row *row, const char *value, void *group) {
    figure_asked *o = group;
    const size_t split = strcspn(value, ",");
    if (value[split] == '\0')
        return option_refuse(row, "must be %s, got '%s'", row->argument, value);
    const int status = option_read_range(line, row, value, split, o->axes);
    return status != EXIT_FINE
               ? status
               : option_read_range(line, row, value + split + 1, strlen(value + split + 1), o->axes + 2);
}

#define GROUP_TYPE figure_asked

/* clang-format off */
static const option_row figure_rows[] = {
    {"type", 0, NULL,
        "type of the figure, for stdout or a file name without such an ending", WORD(type, types),
        .standard = "svg", .group = "The figure"},
    {"theme", 0, NULL,
        "colours of the figure", WORD(theme, themes), .standard = "light"},
    {"figure-size", 0, "W[xH]",
        "width and height of the figure, pixels", .parse = parse_figure_size, .without = "depends on the figure"},
    {"beside", 0, "OPTIONS",
        "also draw another camera in the same figure: its options, all of them, as one word", TEXT(beside)},
    {"axes", 0, "LO:HI,LO:HI",
        "the ends of the axes: of depth, and of what is drawn", .parse = parse_axes, .without = "as the curves need"},
    {"title", 0, "TEXT",
        "title of the figure", TEXT(title)},
    END};
/* clang-format on */

const option_table figure_options = {.rows = figure_rows};

/* clang-format off */
const option_use figure_picture[] = {
    TAKE("type"), TAKE("theme"), TAKE("figure-size"), TAKE("title"), END};
/* clang-format on */
