/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The profile of a GPU in place of a name: what 'depthprec probe --json' wrote. */
#include "camera/cmd/camera.h"
#include "report/output.h"

/* Looks up the name that the profile has of the option, as if the user had given it. */
static int parse_profile(asked_line *line, const option_row *row, const char *value, void *group,
                         option_parser *parse) {
    camera_asked *c = group;
    char name[PROFILE_NAME_SIZE], error[PROFILE_ERROR_SIZE];
    if (names_find(row->names, value, NULL, NULL) || !profile_is_file(value))
        return parse(line, row, value, group);
    if (!profile_add(&c->gpu, value, row->name, name, error))
        return option_refuse(row, "%s", error);
    if (!names_find(row->names, name, NULL, NULL))
        return option_refuse(row, "'%s' names what is not known here, '%.40s'", value, name);
    return parse(line, row, name, group);
}

int parse_arith(asked_line *line, const option_row *row, const char *value, void *group) {
    return parse_profile(line, row, value, group, parse_word);
}

/* A profile names the arithmetic beside the rasterizer: see take_arith() of complete.c. */
int parse_raster(asked_line *line, const option_row *row, const char *value, void *group) {
    camera_asked *c = group;
    char name[PROFILE_NAME_SIZE], error[PROFILE_ERROR_SIZE];
    const int status = parse_profile(line, row, value, group, parse_row);
    if (status == EXIT_FINE && !names_find(row->names, value, NULL, NULL))
        c->has_raster_arith =
            profile_add(&c->gpu, value, "arith", name, error) && dp_arith_parse(name, &c->raster_arith) == DP_OK;
    return status;
}
