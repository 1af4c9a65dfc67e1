/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The option of a depth range, and how it is said. The page has none. */
#include <stdio.h>
#include <string.h>

#include "camera/cmd/setups.h"
#include "camera/depth_range.h"

/* Of either order; camera_make() says what viewports take. */
static int parse_depth_range(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    const size_t split = strcspn(value, ":");
    (void)line;
    return value[split] != '\0' && number_parse_part(value, split, NUMBER_FINITE, &c->depth_range[0]) &&
                   number_parse(value + split + 1, NUMBER_FINITE, &c->depth_range[1]) &&
                   c->depth_range[0] != c->depth_range[1]
               ? EXIT_FINE
               : option_refuse(row, "must be LO:HI, two window depths from 0 to 1, got '%s'", value);
}

/* clang-format off */
static const option_row range_rows[] = {
    {"depth-range", 0, "LO:HI",
        "the depth range of the viewport, window depths: glDepthRange, minDepth and maxDepth; HI is less where it is "
        "reversed", .parse = parse_depth_range, .standard = "0:1",
        .instead = ": its depths are those of 0 to 1, and others are brought there by (d - LO)/(HI - LO)"},
    END};
/* clang-format on */

const option_table range_options = {.rows = range_rows};

const column setup_end_columns[] = {
    {FIELD(setup_depths, lo, "lo", "")}, {FIELD(setup_depths, hi, "hi", "")}, {.kind = COLUMN_END}};

_Static_assert(sizeof(setup_depths) == sizeof((dp_spec *)0)->depth_range, "both are two numbers");

const setup_depths *setup_ends(const dp_spec *spec) {
    return camera_range_moves(spec->depth_range) ? (const setup_depths *)(const void *)spec->depth_range : NULL;
}

const char *setup_range(const setup_fields *f, char out[SETUP_RANGE_SIZE]) {
    *out = '\0';
    if (f->ends != NULL)
        snprintf(out, SETUP_RANGE_SIZE, ", depth range %s:%s", number_full(f->ends->lo).text,
                 number_full(f->ends->hi).text);
    return out;
}

int range_complete(const camera_asked *c) {
    static const struct {
        const char *option, *why;
    } others[] = {{"from-origin", "what is known of places in a world is of the depth range 0 to 1"},
                  {"remedy", "another means than a bias is judged in the depth range 0 to 1"},
                  {"metric", "metric depth has no range"},
                  {"stereo", "disparities have no range"},
                  {"link", "the page has the depth range 0 to 1 alone"}};
    for (size_t i = 0; i < sizeof others / sizeof others[0] && option_given(c->line, "depth-range"); i++)
        if (option_given(c->line, others[i].option))
            return option_error("depth-range", "conflicts with --%s: %s", others[i].option, others[i].why);
    return EXIT_FINE;
}
