/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Profiles as files. */
#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <string.h>

#include "camera/profile.h"
#include "core/append.h"
#include "system/input.h"

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

static bool is(const json_t *object, const char *key, const char *text) {
    const char *found = word(object, key);
    return found != NULL && strcmp(found, text) == 0;
}

/* The finding of that key and format, or null. */
static const json_t *finding_of(const json_t *root, const char *key, const dp_format *format) {
    size_t i;
    json_t *finding;
    json_array_foreach(json_object_get(root, "findings"), i, finding) {
        const char *name = word(finding, "format");
        dp_format read[2];
        if (is(finding, "key", key) && name != NULL && dp_format_parse(name, read) == 1 &&
            strcmp(read[0].name, format->name) == 0)
            return finding;
    }
    return NULL;
}

#define N_OF(what) ", 2^n the power of two at or below " what

/*
 * The r that a probe finds, by the exponent n of the depth at a pixel: that of the largest depth is no less. Where
 * it is that of the anchor's depth a and the others' differences from it, these are at least g - a of the largest
 * depth g, and max(a, g - a) >= g/2.
 */
static const struct {
    const char *found;
    double least, most;
} worths[] = {
    {"r = one code", 1.0, 1.0},
    {"r = two codes", 2.0, 2.0},
    {"r = half a code", 0.5, 0.5},
    {"r = 2^(n-23)" N_OF("the largest depth of the triangle"), 1.0, 1.0},
    {"r = 2^(n-22)" N_OF("the largest depth of the triangle"), 2.0, 2.0},
    {"r = 2^(n-24)" N_OF("the largest depth of the triangle"), 0.5, 0.5},
    {"r = 2^(n-23)" N_OF("the depth of the pixel"), 1.0, 1.0},
    {"r = 2^(n-22)" N_OF("the depth of the pixel"), 2.0, 2.0},
    {"r = 2^(n-24)" N_OF("the depth of the pixel"), 0.5, 0.5},
    {"r = 2^(n-23)" N_OF("the anchor's depth and the others' differences from it"), 0.5, 1.0},
};

static bool cuts_fractions(const json_t *root) {
    size_t i;
    json_t *finding;
    json_array_foreach(json_object_get(root, "findings"), i,
                       finding) if (is(finding, "key", "fraction") && is(finding, "sure", "sure") &&
                                    is(finding, "found", "fractions of a constant are cut")) return true;
    return false;
}

/* A code is 1/(2^N - 1), which drivers write as 2^-N, too: both are within what is measured. */
static profile_format measured_in(const json_t *root, const dp_format *format) {
    const json_t *finding = finding_of(root, "bias", format);
    const double code = format->kind == DP_FORMAT_UNORM ? 1.0 + 1.0 / (double)format->code_max : 1.0;
    for (size_t i = 0; i < sizeof worths / sizeof worths[0] && is(finding, "sure", "sure"); i++)
        if (is(finding, "found", worths[i].found))
            return (profile_format){*format, worths[i].least, worths[i].most * code, cuts_fractions(root)};
    return (profile_format){.format = *format};
}

static profile_format either(profile_format a, profile_format b) {
    if (a.least == 0.0 || b.least == 0.0)
        return (profile_format){.format = a.format};
    return (profile_format){a.format, fmin(a.least, b.least), fmax(a.most, b.most), a.cuts || b.cuts};
}

/* The formats that the first GPU stores; a further GPU leaves those that both store. */
static void add_formats(profile *to, const json_t *root) {
    const bool first = to->measured[0] == '\0';
    size_t kept = 0;
    for (size_t i = 0; first && dp_format_get(i) != NULL && to->stored_count < PROFILE_FORMATS_MAX; i++)
        if (dp_format_get(i)->buffer)
            to->stored[to->stored_count++] = measured_in(root, &dp_format_get(i)->format);
    for (size_t i = 0; i < to->stored_count; i++)
        if (finding_of(root, "stored", &to->stored[i].format) != NULL)
            to->stored[kept++] = either(to->stored[i], measured_in(root, &to->stored[i].format));
    to->stored_count = kept;
}

/* By which API it was drawn: another one's rules may be others on the same GPU. */
static void add_api(profile *to, const json_t *root) {
    const char *name = word(json_object_get(root, "device"), "api");
    const char *api = name == NULL                                                        ? NULL
                      : strncmp(name, "Vulkan", 6) == 0                                   ? "vulkan"
                      : strncmp(name, "OpenGL", 6) == 0 || strncmp(name, "WebGL", 5) == 0 ? "gl"
                                                                                          : NULL;
    if (to->measured[0] == '\0')
        to->api = api;
    else if (api == NULL || to->api == NULL || strcmp(api, to->api) != 0)
        to->api = NULL;
}

static bool add_row(profile *to, const char *path, const json_t *root, const char *key, char name[PROFILE_NAME_SIZE],
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
    add_api(to, root);
    add_device(to, json_object_get(root, "device"));
    return true;
}

int profile_add(profile *to, const char *path, const char *key, char name[PROFILE_NAME_SIZE],
                char error[PROFILE_ERROR_SIZE]) {
    json_error_t why;
    errno = 0;
    FILE *in = input_open(path);
    json_t *root = in != NULL ? json_loadf(in, 0, &why) : NULL;
    const int number = in == NULL || ferror(in) ? errno : 0;
    const char *reason = number == 0 ? why.text : strerror(number);
    input_close(in);
    if (root == NULL) {
        snprintf(error, PROFILE_ERROR_SIZE, "'%s' cannot be read: %s", path, reason);
        return number != 0 ? number : -1;
    }
    const bool good = add_row(to, path, root, key, name, error);
    json_decref(root);
    return good ? 0 : -1;
}
