/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options of prepass that say what is stored. */
#include <stdio.h>

#include "camera/make.h"
#include "cli/option/kinds.h"
#include "convert/again.h"
#include "core/engine.h"
#include "zfight/cmd_prepass/stored.h"

enum { SAMPLES_USUAL = 4 };

static const char *const all_of[] = {"all", NULL};
static const name_list sampled = {.words = all_of, .rows = &resolve_sampled_table};
static const name_list halved = {.words = all_of, .rows = &resolve_halved_table};

/* The same twice is one. */
static int add_case(stored_asked *o, const option_row *row, const stored_case *new) {
    for (size_t i = 0; i < o->count; i++)
        if (strcmp(o->cases[i].name, new->name) == 0)
            return EXIT_FINE;
    if (o->count == STORED_MOST)
        return option_refuse(row, "must be at most %d, got '%s' too", STORED_MOST, new->name);
    o->cases[o->count++] = *new;
    return EXIT_FINE;
}

static int add_format(asked_line *line, const option_row *row, const char *name, void *group) {
    dp_format found[2];
    const size_t count = dp_format_parse(name, found);
    (void)line;
    int status = count > 0 ? EXIT_FINE
                           : option_refuse(row,
                                           "must be a name from 'depthprec list formats', unormN or floatE.M[bB], "
                                           "got '%s'",
                                           name);
    for (size_t i = 0; i < count && status == EXIT_FINE; i++) {
        stored_case one = {.format = found[i]};
        snprintf(one.name, sizeof one.name, "%.*s", DP_FORMAT_NAME_SIZE, found[i].name);
        if (dp_format_is_rg(&found[i]))
            return option_refuse(row, "must hold window depth, got '%s', which holds eye depth over far", name);
        status = again_fits(&found[i])
                     ? add_case(group, row, &one)
                     : option_refuse(row, "must be fp32 or have at most 2^24 codes, which are all looked at, got '%s'",
                                     name);
    }
    return status;
}

static int parse_formats(asked_line *line, const option_row *row, const char *value, void *group) {
    ((stored_asked *)group)->count = 0;
    return parse_names(line, row, value, group, add_format);
}

/* A way, or where none is named all of them. */
static int add_ways(stored_asked *o, const option_row *row, const resolve_way *way, int samples) {
    int status = EXIT_FINE;
    for (size_t i = 0; i < row->names->rows->count && status == EXIT_FINE; i++) {
        const resolve_way *each = named_at(row->names->rows, i);
        stored_case one = {.way = each, .samples = samples};
        snprintf(one.name, sizeof one.name, samples > 0 ? "%s:%d" : "%s", each->name, samples);
        if (way == NULL || way == each)
            status = add_case(o, row, &one);
    }
    return status;
}

/* WAY[:N] */
static int add_resolved(asked_line *line, const option_row *row, const char *text, void *group) {
    list_item found;
    const char *number;
    uint64_t samples = SAMPLES_USUAL;
    (void)line;
    if (option_read_named(row, text, &found, &number) != EXIT_FINE)
        return EXIT_USAGE;
    if (number != NULL &&
        (!number_parse_count(number, RESOLVE_SAMPLES_MOST, &samples) || samples < 2 || (samples & (samples - 1)) != 0))
        return option_refuse(row, "must have 2, 4, 8 or 16 samples, as in min:4, got '%s'", text);
    return add_ways(group, row, found.row, (int)samples);
}

static int parse_resolved(asked_line *line, const option_row *row, const char *value, void *group) {
    ((stored_asked *)group)->count = 0;
    return parse_names(line, row, value, group, add_resolved);
}

static int add_halved(asked_line *line, const option_row *row, const char *name, void *group) {
    list_item found;
    (void)line;
    return names_find(row->names, name, NULL, &found) ? add_ways(group, row, found.row, 0) : option_unknown(row, name);
}

static int parse_halved(asked_line *line, const option_row *row, const char *value, void *group) {
    ((stored_asked *)group)->count = 0;
    return parse_names(line, row, value, group, add_halved);
}

#define GROUP_TYPE stored_asked

/* clang-format off */
static const option_row rows[] = {
    {"prepass-format", 0, "NAME[,NAME...]",
        "formats of the prepass, whose depths are copied to that of --format: fp32 or of at most 2^24 codes, which are "
        "all looked at", .parse = parse_formats, INTO(size_t, count), .without = "that of --format",
        .group = "What else a prepass may store"},
    {"resolve", 0, "WAY[:N][,WAY[:N]...]|all[:N]",
        "the prepass has N samples a pixel, 2, 4, 8 or 16, without N 4, of which one depth is made: @",
        .parse = parse_resolved, INTO(size_t, count), .names = &sampled, .without = "one sample a pixel"},
    {"half", 0, "WAY[,WAY...]|all",
        "the prepass has half the width and height, each depth read for two by two pixels: @",
        .parse = parse_halved, INTO(size_t, count), .names = &halved, .without = "the size of the pass"},
    END};

#define ONE ": one of them is asked about at a time"
#define NO_VERTEX ", which is of two vertex programs: here both passes run one"
#define OF_ANOTHER "against program vertices sample seed from-origin arith"
static const option_rule rules[] = {
    CONFLICTS("prepass-format", "resolve half", ONE), CONFLICTS("resolve", "half", ONE),
    CONFLICTS("prepass-format", OF_ANOTHER, NO_VERTEX), CONFLICTS("resolve", OF_ANOTHER, NO_VERTEX),
    CONFLICTS("half", OF_ANOTHER, NO_VERTEX), {.option = NULL}};
/* clang-format on */

const option_table stored_options = {.rows = rows, .rules = rules};
const option_use stored_uses[] = {ROWS(rows), END};
