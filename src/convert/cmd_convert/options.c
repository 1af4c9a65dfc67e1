/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command convert and its options. */
#include <math.h>

#include "cli/option/kinds.h"
#include "convert/cmd_convert/request.h"

static const name_list reads = {.rows = &convert_read_table};
static const name_list writes = {.rows = &convert_write_table};

/* A whole number that binary32 has, or a power of two. */
static bool read_factor(const char *text, double *out) {
    const bool power = strncmp(text, "2^", 2) == 0;
    if (!number_parse(power ? text + 2 : text, NUMBER_FINITE, out))
        return false;
    if (power)
        *out = *out == rint(*out) && *out >= 0 && *out <= 32 ? ldexp(1, (int)*out) : (double)NAN;
    return *out >= 1 && *out <= 0x1p32 && *out == rint(*out) && *out == (double)(float)*out;
}

/* WAY[:F] */
static int parse_rule(asked_line *line, const option_row *row, const char *value, void *group) {
    convert_rule *rule = option_field(row, group);
    list_item found;
    const char *factor;
    (void)line;
    if (option_read_named(row, value, &found, &factor) != EXIT_FINE)
        return EXIT_USAGE;
    *rule = (convert_rule){.way = found.row};
    if (factor == NULL)
        return EXIT_FINE;
    if (!rule->way->scales)
        return option_refuse(row, "%s takes no factor, got '%s'", rule->way->name, value);
    if (!read_factor(factor, &rule->factor))
        return option_refuse(row, "must have a whole factor from 1 to 2^32 that binary32 has, as in %s:2^24, got '%s'",
                             rule->way->name, value);
    return EXIT_FINE;
}

#define GROUP_TYPE convert_request

/* clang-format off */
static const option_row convert_rows[] = {
    {"read", 0, "WAY[:F]",
        "how integer codes become numbers: @; F is the code of 1, in place of the largest", .parse = parse_rule,
        INTO(convert_rule, read), .names = &reads, .standard = "exact", .group = "Copies"},
    {"write", 0, "WAY[:F]",
        "how numbers become codes, in every format but fp32: @; F as above, cut:2^24", .parse = parse_rule,
        INTO(convert_rule, write), .names = &writes, .standard = "nearest"},
    {"saturate", 0, NULL,
        "a whole number beyond the last code becomes that; without, its low bits are kept", FLAG(saturate)},
    {"flush", 0, NULL,
        "floats have no subnormals: they are 0, as on NV2A", FLAG(flush)},
    {"code", 0, "C[,C...]",
        "the way of these codes alone, decimal or 0x...; the code of a float is its bit pattern",
        SEVERAL(parse_codes, codes, 0, 4294967295)},
    END};
/* clang-format on */

const option_table convert_options = {.rows = convert_rows};

/* clang-format off */
static const option_use uses[] = {ROWS(convert_rows), TAKE("threads"), GROUP_OF(output_written), END};
/* clang-format on */

static const option_place places[] = {
    PLACE(convert_request, out, output_options), OWN_PLACE(convert_options), {.table = NULL}};

/* clang-format off */
const command_row command_convert = {
    .name = "convert", .request = sizeof(convert_request), .places = places, .uses = uses,
    .operand = "FORMAT FORMAT [FORMAT]", .operand_min = 2, .operand_max = CONVERT_FORMATS,
    .summary = "which codes survive a copy to another format, and back",
    .example = "  depthprec convert d24 d32f d24 --write cut:2^24\n"
    "  depthprec convert d24 d32f d24 --write cut:2^24 --code 13884590\n"
    "  depthprec convert d16 d24 d16 --write replicate\n"
    "  depthprec convert d32f float4.20b15 d32f\n"};
/* clang-format on */
