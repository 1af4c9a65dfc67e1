/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The profile of a GPU in place of a name: what 'depthprec probe --json' wrote. */
#include "cli/option/rows.h"

/* Looks up the name that the profile has of the option, as if the user had given it. */
static int parse_profile(options *o, const option_row *row, const char *value, option_parser *parse) {
    char name[PROFILE_NAME_SIZE], error[PROFILE_ERROR_SIZE];
    if (names_find(row->names, value, NULL, NULL) || !profile_is_file(value))
        return parse(o, row, value);
    if (!profile_add(&o->camera.gpu, value, row->name, name, error))
        return option_refuse(row, "%s", error);
    if (!names_find(row->names, name, NULL, NULL))
        return option_refuse(row, "'%s' names what is not known here, '%.40s'", value, name);
    return parse(o, row, name);
}

int parse_arith(options *o, const option_row *row, const char *value) {
    return parse_profile(o, row, value, parse_word);
}

/* A profile names the arithmetic beside the rasterizer: see take_arith() of options.c. */
int parse_raster(options *o, const option_row *row, const char *value) {
    char name[PROFILE_NAME_SIZE], error[PROFILE_ERROR_SIZE];
    const int status = parse_profile(o, row, value, parse_row);
    if (status == EXIT_FINE && !names_find(row->names, value, NULL, NULL))
        o->camera.has_raster_arith = profile_add(&o->camera.gpu, value, "arith", name, error) &&
                                     dp_arith_parse(name, &o->camera.raster_arith) == DP_OK;
    return status;
}
