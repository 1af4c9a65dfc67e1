/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options of texture that the page lacks. */
#include <stdio.h>
#include <string.h>

#include "cli/list.h"
#include "core/append.h"
#include "report/output.h"
#include "texture/cmd_texture/request.h"

static int add_parameter(const option_row *row, const char *value, texture_asked *o) {
    const size_t length = strcspn(value, "=");
    named_number given = {{0}, 0};
    if (value[length] == '\0' || length == 0 || length >= sizeof given.name ||
        !number_parse(value + length + 1, NUMBER_FINITE, &given.value))
        return option_refuse(row, "must be NAME=NUMBER, got '%s'", value);
    memcpy(given.name, value, length);
    size_t i = 0;
    while (i < o->parameter_count && strcmp(o->parameters[i].name, given.name) != 0)
        i++;
    if (i < o->parameter_count)
        return option_refuse(row, "must not be given twice for '%s', got '%s' too", given.name, value);
    if (i == IMAGE_PARAMETERS_MAX)
        return option_refuse(row, "must not be more than %d, got '%s' too", IMAGE_PARAMETERS_MAX, value);
    o->parameters[o->parameter_count++] = given;
    return EXIT_FINE;
}

int parse_parameter(asked_line *line, const option_row *row, const char *value, void *group) {
    char part[128];
    const char *at = value;
    (void)line;
    do {
        const size_t length = strcspn(at, ",");
        if (length >= sizeof part)
            return option_refuse(row, "must be NAME=NUMBER, got '%s'", at);
        snprintf(part, sizeof part, "%.*s", (int)length, at);
        const int status = add_parameter(row, part, group);
        if (status != EXIT_FINE)
            return status;
        at += length;
    } while (*at++ == ',');
    return EXIT_FINE;
}

/* The method of normals that a product compares or holds, behind a second colon. */
static int read_normals(texture_asked *o, const option_row *row, const char *value) {
    static const name_list normals = {.rows = &normal_table};
    const bool packed = o->pack != NULL && o->pack->encoded != NULL;
    const bool compared = o->effect != NULL && (o->effect->needs & EFFECT_NORMALS) != 0;
    char text[NAMES_SIZE];
    list_item item;
    if (!packed && !compared)
        return option_refuse(row, "takes NORMALS with effect:outline and packings of normals, got '%s'", value);
    if (!names_find(&normals, value, NULL, &item))
        return option_refuse(row, "NORMALS %s", names_refuse(&normals, value, text));
    o->normals_by = item.row;
    return EXIT_FINE;
}

/* KIND, KIND:METHOD or KIND:METHOD:NORMALS. */
int parse_product(asked_line *line, const option_row *row, const char *value, void *group) {
    texture_asked *o = group;
    (void)line;
    char name[64], text[NAMES_SIZE];
    list_item item;
    const size_t length = strcspn(value, ":");
    snprintf(name, sizeof name, "%.*s", (int)length, value);
    if (!names_find(row->names, name, NULL, &item))
        return option_refuse(row, "%s", names_refuse(row->names, name, text));
    const product_row *p = o->product = item.row;
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
    memcpy((char *)group + p->place, &item.row, sizeof item.row);
    return method[end] == '\0' ? EXIT_FINE : read_normals(o, row, method + end + 1);
}

/* A map of errors with a name stands beside the product. */
int parse_error_map(asked_line *line, const option_row *row, const char *value, void *group) {
    texture_asked *o = group;
    (void)line;
    o->error_map = value == NULL;
    o->error_file = value;
    return value == NULL || *value != '\0' ? EXIT_FINE : option_refuse(row, "must be a file name, got ''");
}

/* LEVEL, then nearest and FORMAT in any order. */
int parse_hi_z(asked_line *line, const option_row *row, const char *value, void *group) {
    texture_asked *o = group;
    (void)line;
    char text[64] = "", *rest = NULL;
    uint64_t level;
    bool good = true;
    append(text, sizeof text, "%s", value);
    const char *word = strtok_r(text, ":", &rest);
    good = word != NULL && number_parse_count(word, 16, &level);
    o->hi_z_nearest = false;
    o->hi_z_format = (dp_format){.bits = 0};
    while (good && (word = strtok_r(NULL, ":", &rest)) != NULL) {
        dp_format formats[2];
        if (strcmp(word, "nearest") == 0 || strcmp(word, "farthest") == 0)
            o->hi_z_nearest = *word == 'n';
        else if ((good = dp_format_parse(word, formats) == 1 && formats[0].bits <= 31))
            o->hi_z_format = formats[0];
    }
    if (!good)
        return option_refuse(
            row, "must be LEVEL, 0 to 16, and may have :nearest and :FORMAT, up to 31 bits, behind it, got '%s'",
            value);
    o->hi_z = (unsigned)level;
    return EXIT_FINE;
}
