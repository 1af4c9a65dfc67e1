/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options of commands that the page has not. */
#include <stdio.h>
#include <string.h>

#include "cli/option/names.h"
#include "cli/option/rows.h"
#include "core/append.h"
#include "judge/written.h"
#include "report/number.h"

int parse_parameter(options *o, const option_row *row, const char *value) {
    const size_t length = strcspn(value, "=");
    named_number given = {{0}, 0};
    if (value[length] == '\0' || length == 0 || length >= sizeof given.name ||
        !number_parse(value + length + 1, NUMBER_FINITE, &given.value))
        return option_refuse(row, "must be NAME=NUMBER, got '%s'", value);
    memcpy(given.name, value, length);
    size_t i = 0;
    while (i < o->image.parameter_count && strcmp(o->image.parameters[i].name, given.name) != 0)
        i++;
    if (i < o->image.parameter_count)
        return option_refuse(row, "must not be given twice for '%s', got '%s' too", given.name, value);
    if (i == OPTIONS_PARAMETERS_MAX)
        return option_refuse(row, "must not be more than %d, got '%s' too", OPTIONS_PARAMETERS_MAX, value);
    o->image.parameters[o->image.parameter_count++] = given;
    return EXIT_FINE;
}

int parse_define(options *o, const option_row *row, const char *value) {
    if (!written_define_known(value))
        return option_refuse(row,
                             "must be NAME=near, far, z_buffer_params, projection or another word of the help, or a "
                             "number, got '%s'",
                             value);
    if (o->judge.define_count == OPTIONS_PARAMETERS_MAX)
        return option_refuse(row, "must not be more than %d, got '%s' too", OPTIONS_PARAMETERS_MAX, value);
    o->judge.defines[o->judge.define_count++] = value;
    return EXIT_FINE;
}

int parse_mine(options *o, const option_row *row, const char *value) {
    if (o->judge.mine_count == OPTIONS_MINE_MAX)
        return option_refuse(row, "must not be more than %d, got '%s' too", OPTIONS_MINE_MAX, value);
    o->judge.mine[o->judge.mine_count++] = value;
    return EXIT_FINE;
}

/* The method of normals that a product compares or holds, behind a second colon. */
static int read_normals(options *o, const option_row *row, const char *value) {
    static const name_list normals = {.get = list_normal};
    const bool packed = o->image.pack != NULL && o->image.pack->encoded != NULL;
    const bool compared = o->image.effect != NULL && (o->image.effect->needs & EFFECT_NORMALS) != 0;
    char text[NAMES_SIZE];
    list_item item;
    if (!packed && !compared)
        return option_refuse(row, "takes NORMALS with effect:outline and packings of normals, got '%s'", value);
    if (!names_find(&normals, value, NULL, &item))
        return option_refuse(row, "NORMALS %s", names_refuse(&normals, value, text));
    o->image.normals_by = item.row;
    return EXIT_FINE;
}

/* KIND, KIND:METHOD or KIND:METHOD:NORMALS. */
int parse_product(options *o, const option_row *row, const char *value) {
    char name[64], text[NAMES_SIZE];
    list_item item;
    const size_t length = strcspn(value, ":");
    snprintf(name, sizeof name, "%.*s", (int)length, value);
    if (!names_find(row->names, name, NULL, &item))
        return option_refuse(row, "%s", names_refuse(row->names, name, text));
    const product_row *p = o->image.product = item.row;
    const char *method = value[length] == ':' ? value + length + 1 : p->standard;
    if (p->methods == NULL)
        return method == NULL ? EXIT_FINE : option_refuse(row, "%s has no methods, got '%s'", p->name, value);
    if (method == NULL)
        return option_refuse(row, "%s needs a name behind a colon: %s", p->name,
                             names_join(p->methods, ", ", " or ", text));
    const size_t end = strcspn(method, ":");
    snprintf(name, sizeof name, "%.*s", (int)end, method);
    if (!names_find(p->methods, name, NULL, &item))
        return option_refuse(row, "%s: %s", p->name, names_refuse(p->methods, name, text));
    memcpy((char *)o + p->place, &item.row, sizeof item.row);
    return method[end] == '\0' ? EXIT_FINE : read_normals(o, row, method + end + 1);
}

/* With a name it stands beside the product. */
int parse_error_map(options *o, const option_row *row, const char *value) {
    o->image.error_map = value == NULL;
    o->image.error_file = value;
    return value == NULL || *value != '\0' ? EXIT_FINE : option_refuse(row, "must be a file name, got ''");
}

/* LEVEL, then nearest and FORMAT in any order. */
int parse_hi_z(options *o, const option_row *row, const char *value) {
    char text[64] = "", *rest = NULL;
    uint64_t level;
    bool good = true;
    append(text, sizeof text, "%s", value);
    const char *word = strtok_r(text, ":", &rest);
    good = word != NULL && number_parse_count(word, 16, &level);
    o->image.hi_z_nearest = false;
    o->image.hi_z_format = (dp_format){.bits = 0};
    while (good && (word = strtok_r(NULL, ":", &rest)) != NULL) {
        dp_format formats[2];
        if (strcmp(word, "nearest") == 0 || strcmp(word, "farthest") == 0)
            o->image.hi_z_nearest = *word == 'n';
        else if ((good = dp_format_parse(word, formats) == 1 && formats[0].bits <= 31))
            o->image.hi_z_format = formats[0];
    }
    if (!good)
        return option_refuse(
            row, "must be LEVEL, 0 to 16, and may have :nearest and :FORMAT, up to 31 bits, behind it, got '%s'",
            value);
    o->image.hi_z = (unsigned)level;
    return EXIT_FINE;
}

/* FORMAT:MAPPING or FORMAT:MAPPING:FAR. */
int parse_camera_depth(options *o, const option_row *row, const char *value) {
    char text[80] = "", *rest = NULL;
    append(text, sizeof text, "%s", value);
    const char *format = strtok_r(text, ":", &rest), *mapping = strtok_r(NULL, ":", &rest);
    const char *far = strtok_r(NULL, "", &rest);
    const double view = o->camera.zfar;
    dp_spec *camera = &o->shadow.camera;
    dp_format formats[2];
    if (mapping == NULL || dp_format_parse(format, formats) != 1 ||
        dp_mapping_parse(mapping, &camera->mapping) != DP_OK ||
        dp_mapping_get(camera->mapping)->curve != DP_CURVE_PERSPECTIVE)
        return option_refuse(
            row, "must be FORMAT:MAPPING[:FAR], MAPPING one of " DP_MAPPING_NAMES_PERSPECTIVE ", got '%s'", value);
    camera->format = formats[0];
    const int status = far != NULL ? parse_far(o, row, far) : EXIT_FINE;
    camera->zfar = far != NULL ? o->camera.zfar : 0.0;
    o->camera.zfar = view;
    return status;
}
