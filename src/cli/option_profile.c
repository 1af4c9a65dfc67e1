/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The profile of a GPU in place of a name: what 'depthprec probe --json' wrote. */
#include <jansson.h>
#include <string.h>

#include "cli/option_rows.h"
#include "core/append.h"

/* Beside the names a file: they have neither a point nor a slash. */
static bool is_file(const option_row *row, const char *value) {
    return !names_find(row->names, value, NULL, NULL) && strpbrk(value, "./") != NULL;
}

/* A word of it that is printed: one line, whatever the driver says of itself. */
static const char *word(const json_t *object, const char *key) {
    return json_string_value(json_object_get(object, key));
}

/* Which GPU, once though both options name it. */
static void remember(options *o, const json_t *device) {
    const char *name = word(device, "name"), *driver = word(device, "driver");
    char text[OPTIONS_MEASURED_SIZE] = "";
    append(text, sizeof text, "%.200s, driver %.200s", name != NULL ? name : "?", driver != NULL ? driver : "?");
    for (char *c = text; *c != '\0'; c++)
        if ((unsigned char)*c < 0x20 || (unsigned char)*c > 0x7e)
            *c = '?';
    if (strstr(o->measured, text) == NULL)
        append(o->measured, sizeof o->measured, "%s%s", o->measured[0] != '\0' ? "; " : "", text);
}

static bool stores(const json_t *root, const dp_format *format) {
    size_t i;
    json_t *finding;
    json_array_foreach(json_object_get(root, "findings"), i, finding) {
        const char *key = word(finding, "key"), *name = word(finding, "format");
        dp_format is[2];
        if (key != NULL && strcmp(key, "stored") == 0 && name != NULL && dp_format_parse(name, is) == 1 &&
            strcmp(is[0].name, format->name) == 0)
            return true;
    }
    return false;
}

/* Which of its depth formats were measured; of two GPUs those of both. */
static void remember_formats(options *o, const json_t *root, bool first) {
    size_t kept = 0;
    for (size_t i = 0; first && dp_format_get(i) != NULL && o->stored_count < OPTIONS_STORED_MAX; i++)
        if (dp_format_get(i)->buffer)
            o->stored[o->stored_count++] = dp_format_get(i)->format;
    for (size_t i = 0; i < o->stored_count; i++)
        if (stores(root, &o->stored[i]))
            o->stored[kept++] = o->stored[i];
    o->stored_count = kept;
}

/* Looks up the name that the profile has of the option, as if the user had given it. */
static int take(options *o, const option_row *row, const char *path, const json_t *root, option_parser *parse) {
    const char *command = word(root, "command"), *name = word(root, row->name);
    if (command == NULL || strcmp(command, "probe") != 0)
        return option_refuse(row, "must be a profile that 'depthprec probe --json' wrote, got '%s'", path);
    if (name == NULL)
        return option_refuse(row, "the GPU of '%s' is none that is known: no row predicts all its codes", path);
    if (!names_find(row->names, name, NULL, NULL))
        return option_refuse(row, "'%s' names what is not known here, '%.40s'", path, name);
    remember_formats(o, root, o->measured[0] == '\0');
    remember(o, json_object_get(root, "device"));
    return parse(o, row, name);
}

static int parse_profile(options *o, const option_row *row, const char *value, option_parser *parse) {
    json_error_t why;
    if (!is_file(row, value))
        return parse(o, row, value);
    json_t *root = json_load_file(value, 0, &why);
    if (root == NULL)
        return option_refuse(row, "'%s' cannot be read: %s", value, why.text);
    const int status = take(o, row, value, root, parse);
    json_decref(root);
    return status;
}

int parse_arith(options *o, const option_row *row, const char *value) {
    return parse_profile(o, row, value, parse_word);
}

int parse_raster(options *o, const option_row *row, const char *value) {
    return parse_profile(o, row, value, parse_row);
}
