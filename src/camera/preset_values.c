/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words for a preset, and the camera that follows from them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/presets.h"
#include "core/append.h"

size_t preset_length(const char *text) {
    size_t length = strcspn(text, ",");
    if (memchr(text, ':', length) == NULL)
        return length;
    for (const char *next = text + length; *next == ','; next = text + length) {
        const size_t part = strcspn(next + 1, ",");
        if (memchr(next + 1, '=', part) == NULL || memchr(next + 1, ':', part) != NULL)
            break; /* another preset */
        length += 1 + part;
    }
    return length;
}

static const preset_parameter *parameter_at(const preset *row, int i) {
    return row->function != NULL && i < PRESET_PARAMETERS && row->function->parameters[i].name != NULL
               ? &row->function->parameters[i]
               : NULL;
}

int preset_parameter_of(const preset *row, const char *name) {
    int i = 0;
    while (parameter_at(row, i) != NULL && strcmp(parameter_at(row, i)->name, name) != 0)
        i++;
    return parameter_at(row, i) != NULL ? i : -1;
}

static bool fails(char error[PRESET_ERROR_SIZE], const char *text) {
    snprintf(error, PRESET_ERROR_SIZE, "%s", text);
    return false;
}

/* All numbers that a row takes: "zoom, pitch and height". */
static const char *names_of(const preset *row, char out[PRESET_WORDS_SIZE]) {
    *out = '\0';
    for (int i = 0; parameter_at(row, i) != NULL; i++)
        append(out, PRESET_WORDS_SIZE, "%s%s",
               i == 0                             ? ""
               : parameter_at(row, i + 1) == NULL ? " and "
                                                  : ", ",
               parameter_at(row, i)->name);
    return out;
}

/* One PARAMETER=NUMBER, which is changed. */
static bool read_one(const preset *row, char *text, preset_values *v, char error[PRESET_ERROR_SIZE]) {
    char names[PRESET_WORDS_SIZE], *equals = strchr(text, '='), *end;
    if (equals != NULL)
        *equals = '\0';
    const int i = preset_parameter_of(row, text);
    if (i < 0 || equals == NULL) {
        append(error, PRESET_ERROR_SIZE, "%s is computed from %s, each as NAME=NUMBER, got '%s'", row->name,
               names_of(row, names), text);
        return false;
    }
    const preset_parameter *p = parameter_at(row, i);
    const double number = strtod(equals + 1, &end);
    const bool is_number =
        equals[1] != '\0' && *end == '\0' && equals[1 + strspn(equals + 1, "0123456789.eE+-")] == '\0';
    if (!isnan(v->given[i]))
        append(error, PRESET_ERROR_SIZE, "has %s twice", p->name);
    else if (!is_number || !(number >= p->least && number <= p->most))
        append(error, PRESET_ERROR_SIZE, "must have a %s from %.15g to %.15g%s%s, got '%s'", p->name, p->least, p->most,
               *p->unit != '\0' ? " " : "", p->unit, equals + 1);
    v->given[i] = number;
    return *error == '\0';
}

bool preset_read(const char *text, const preset **row, preset_values *values, char error[PRESET_ERROR_SIZE]) {
    const size_t name = strcspn(text, ":");
    char parts[PRESET_WORDS_SIZE];
    *error = '\0';
    *values = (preset_values){.words = ""};
    for (int i = 0; i < PRESET_PARAMETERS; i++)
        values->given[i] = (double)NAN;
    snprintf(values->words, sizeof values->words, "%.*s", (int)name, text);
    *row = preset_find(values->words);
    if (*row == NULL)
        return false;
    if (strlen((*row)->name) + strlen(text + name) >= sizeof parts)
        return fails(error, "is too long");
    snprintf(parts, sizeof parts, "%s", text + name);
    snprintf(values->words, sizeof values->words, "%s%s", (*row)->name, parts);
    if (text[name] == '\0')
        return true;
    if ((*row)->function == NULL) {
        append(error, PRESET_ERROR_SIZE, "must be %s alone, whose planes are fixed, got '%s'", (*row)->name, text);
        return false;
    }
    for (char *at = parts + 1, *next; at != NULL; at = next) {
        next = strchr(at, ',');
        if (next != NULL)
            *next++ = '\0';
        if (!read_one(*row, at, values, error))
            return false;
    }
    return true;
}

/* The example of a sentence, numbers that were given and samples of those needed: "maplibre:zoom=14,height=800". */
static void append_example(const preset *row, const preset_values *v, char out[PRESET_ERROR_SIZE]) {
    append(out, PRESET_ERROR_SIZE, "%s", row->name);
    const char *between = ":";
    for (int i = 0; parameter_at(row, i) != NULL; i++) {
        const preset_parameter *p = parameter_at(row, i);
        const double number = isnan(v->given[i]) ? p->example : v->given[i];
        if ((isnan(v->given[i]) && !isnan(p->standard)) || (i == 0 && v->sought))
            continue;
        append(out, PRESET_ERROR_SIZE, "%s%s=%.15g", between, p->name, number);
        between = ",";
    }
}

bool preset_make(const preset *row, const preset_values *values, preset_camera *out, char error[PRESET_ERROR_SIZE]) {
    double given[PRESET_PARAMETERS] = {0};
    bool canvas = false;
    *error = '\0';
    *out = (preset_camera){row->znear, row->zfar, row->fov, (double)NAN};
    if (row->function == NULL)
        return true;
    for (int i = 0; parameter_at(row, i) != NULL; i++) {
        const preset_parameter *p = parameter_at(row, i);
        given[i] = isnan(values->given[i]) ? (i == 0 && values->sought ? p->example : p->standard) : values->given[i];
        if (!isnan(given[i]))
            continue;
        append(error, PRESET_ERROR_SIZE, "%s%s", *error == '\0' ? "needs " : " and ", p->name);
        canvas = canvas || strcmp(p->name, "height") == 0;
    }
    if (*error != '\0') {
        append(error, PRESET_ERROR_SIZE, ": ");
        append_example(row, values, error);
        append(error, PRESET_ERROR_SIZE, "%s", canvas ? ", or the height by @viewport 1280x800" : "");
        return false;
    }
    row->function->compute(given, out);
    return out->znear < out->zfar || fails(error, "leaves nothing between near and far");
}

void preset_planes(const preset *p, const preset_camera *camera, const unit_row *unit, double *znear, double *zfar,
                   double *log_c) {
    const unit_row *own = unit_find(p->unit);
    *znear = unit_convert(camera->znear, own, unit);
    *zfar = unit_convert(camera->zfar, own, unit);
    *log_c = 1.0 / unit_convert(1.0, own, unit);
}

double preset_fov_y(const preset *p, double fov, int width, int height) {
    const bool vertical = p->axis == PRESET_VERTICAL || (p->axis == PRESET_LARGER && width <= height);
    return vertical ? fov : dp_fov_vertical(fov, width, height);
}
