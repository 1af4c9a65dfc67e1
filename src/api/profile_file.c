/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles as files. */
#include <jansson.h>
#include <string.h>

#include "api/profile.h"
#include "core/append.h"

bool profile_is_file(const char *text) {
    return strpbrk(text, "./") != NULL;
}

static const char *word(const json_t *object, const char *key) {
    return json_string_value(json_object_get(object, key));
}

/* Which GPU, once though two keys name it; in one line, whatever the driver says of itself. */
static void add_device(profile *to, const json_t *device) {
    const char *name = word(device, "name"), *driver = word(device, "driver");
    char text[PROFILE_MEASURED_SIZE] = "";
    append(text, sizeof text, "%.200s, driver %.200s", name != NULL ? name : "?", driver != NULL ? driver : "?");
    for (char *c = text; *c != '\0'; c++)
        if ((unsigned char)*c < 0x20 || (unsigned char)*c > 0x7e)
            *c = '?';
    if (strstr(to->measured, text) == NULL)
        append(to->measured, sizeof to->measured, "%s%s", to->measured[0] != '\0' ? "; " : "", text);
}

static bool found_stored(const json_t *root, const dp_format *format) {
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

/* Of the first GPU what it stores; of others what is stored by both. */
static void add_formats(profile *to, const json_t *root) {
    size_t kept = 0;
    for (size_t i = 0; to->measured[0] == '\0' && dp_format_get(i) != NULL && to->stored_count < PROFILE_FORMATS_MAX;
         i++)
        if (dp_format_get(i)->buffer)
            to->stored[to->stored_count++] = dp_format_get(i)->format;
    for (size_t i = 0; i < to->stored_count; i++)
        if (found_stored(root, &to->stored[i]))
            to->stored[kept++] = to->stored[i];
    to->stored_count = kept;
}

static bool add(profile *to, const char *path, const json_t *root, const char *key, char name[PROFILE_NAME_SIZE],
                char error[PROFILE_ERROR_SIZE]) {
    const char *command = word(root, "command"), *row = word(root, key);
    if (command == NULL || strcmp(command, "probe") != 0) {
        snprintf(error, PROFILE_ERROR_SIZE, "must be a profile that 'depthprec probe --json' wrote, got '%s'", path);
        return false;
    }
    if (row == NULL) {
        snprintf(error, PROFILE_ERROR_SIZE, "the GPU of '%s' is none that is known: no row predicts all its codes",
                 path);
        return false;
    }
    snprintf(name, PROFILE_NAME_SIZE, "%s", row);
    add_formats(to, root);
    add_device(to, json_object_get(root, "device"));
    return true;
}

bool profile_add(profile *to, const char *path, const char *key, char name[PROFILE_NAME_SIZE],
                 char error[PROFILE_ERROR_SIZE]) {
    json_error_t why;
    json_t *root = json_load_file(path, 0, &why);
    if (root == NULL) {
        snprintf(error, PROFILE_ERROR_SIZE, "'%s' cannot be read: %s", path, why.text);
        return false;
    }
    const bool good = add(to, path, root, key, name, error);
    json_decref(root);
    return good;
}
