/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The option of a depth range, and how it is said. The page has none. */
#include <stdio.h>
#include <string.h>

#include "camera/cmd/setups.h"
#include "camera/depth_range.h"
#include "core/engine.h"

/* LO may be above HI; camera_make() and range_complete() say what viewports take. */
static int add_depth_range(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    const size_t split = strcspn(value, ":");
    double ends[2];
    (void)line;
    if (value[split] == '\0' || !number_parse_part(value, split, NUMBER_FINITE, &ends[0]) ||
        !number_parse(value + split + 1, NUMBER_FINITE, &ends[1]) || ends[0] == ends[1])
        return option_refuse(row, "must be LO:HI, two window depths from 0 to 1, got '%s'", value);
    for (size_t i = 0; i < c->range_count; i++)
        if (c->ranges[i][0] == ends[0] && c->ranges[i][1] == ends[1])
            return EXIT_FINE;
    if (c->range_count == CAMERA_RANGES_MAX)
        return option_refuse(row, "must be at most %d ranges, got '%s' too", CAMERA_RANGES_MAX, value);
    memcpy(c->ranges[c->range_count++], ends, sizeof ends);
    memcpy(c->depth_range, c->ranges[0], sizeof ends);
    return EXIT_FINE;
}

int parse_depth_ranges(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    c->range_count = 0;
    return parse_names(line, row, value, group, add_depth_range);
}

static int parse_depth_range(asked_line *line, const option_row *row, const char *value, void *group) {
    return strchr(value, ',') == NULL ? parse_depth_ranges(line, row, value, group)
                                      : option_refuse(row, "must be one range for %s, got '%s': table compares several",
                                                      line->command->name, value);
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
    return dp_range_moves(spec->depth_range) ? (const setup_depths *)(const void *)spec->depth_range : NULL;
}

const char *setup_range(const setup_fields *f, char out[SETUP_RANGE_SIZE]) {
    *out = '\0';
    if (f->ends != NULL)
        snprintf(out, SETUP_RANGE_SIZE, ", depth range %s:%s", number_full(f->ends->lo).text,
                 number_full(f->ends->hi).text);
    return out;
}

const char *setup_range_option(const dp_spec *spec, char out[SETUP_RANGE_SIZE]) {
    const setup_depths *ends = setup_ends(spec);
    *out = '\0';
    if (ends != NULL)
        snprintf(out, SETUP_RANGE_SIZE, " --depth-range %s:%s", number_full(ends->lo).text, number_full(ends->hi).text);
    return out;
}

const char *setup_slice(const camera_asked *c, const dp_setup *setup, char out[SETUP_RANGE_SIZE]) {
    const double *ends = setup->spec.depth_range;
    *out = '\0';
    if (c->range_count > 1)
        snprintf(out, SETUP_RANGE_SIZE, " %s:%s", number_full(ends[0]).text, number_full(ends[1]).text);
    return out;
}

bool setup_repeats(const setups *all, size_t i) {
    const dp_spec *spec = &all->items[i].spec, *last = i > 0 ? &all->items[i - 1].spec : NULL;
    return last != NULL && all->cameras[i] == all->cameras[i - 1] && spec->mapping == last->mapping &&
           strcmp(spec->format.name, last->format.name) == 0;
}

/* Those behind the first, which camera_make() checks: what viewports take, and the APIs of presets or a platform. */
static int check_others(const camera_asked *c) {
    camera_fault fault = {.key = NULL};
    for (size_t i = 1; i < c->range_count; i++) {
        bool fine = camera_range_takes(c->platform != NULL ? c->platform->api : NULL, c->ranges[i], &fault);
        for (size_t k = 0; k < c->preset_count && fine && c->platform == NULL; k++)
            fine = camera_range_takes(c->presets[k]->api, c->ranges[i], &fault);
        if (!fine)
            return camera_refuse(&fault);
    }
    return EXIT_FINE;
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
    return check_others(c);
}
