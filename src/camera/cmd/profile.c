/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The profile of a GPU in place of a name: what 'depthprec probe --json' wrote. */
#include "camera/cmd/camera.h"
#include "report/output.h"

/* Looks up the name that the profile has of the option, as if the user had given it. */
static int parse_profile(asked_line *line, const option_row *row, const char *value, void *group, camera_key key,
                         option_parser *parse) {
    camera_asked *c = group;
    char name[PROFILE_NAME_SIZE], error[PROFILE_ERROR_SIZE];
    if (names_find(row->names, value, NULL, NULL) || !profile_is_file(value))
        return parse(line, row, value, group);
    const int status = camera_profile(&c->said, value, key, name, error);
    if (status != 0)
        return status > 0 ? option_unreadable(row->name, value, status) : option_refuse(row, "%s", error);
    if (!names_find(row->names, name, NULL, NULL))
        return option_refuse(row, "'%s' names what is not known here, '%.40s'", value, name);
    return parse(line, row, name, group);
}

int parse_arith(asked_line *line, const option_row *row, const char *value, void *group) {
    return parse_profile(line, row, value, group, CAMERA_ARITH, parse_word);
}

int parse_raster(asked_line *line, const option_row *row, const char *value, void *group) {
    return parse_profile(line, row, value, group, CAMERA_RASTER, parse_row);
}
