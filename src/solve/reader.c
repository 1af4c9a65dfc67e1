/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/reader.h"
#include "core/append.h"
#include "system/posix.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

bool reader_fail(reader *r, const setting *s, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(r->error->text, sizeof r->error->text, format, arguments);
    va_end(arguments);
    r->error->unreadable = false;
    if (s != NULL)
        r->error->line = s->line;
    for (char *c = r->error->text; *c != '\0'; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = '?';
    return false;
}

static const setting *key_of(const setting *group, const char *name) {
    const setting *s = group->first;
    while (s != NULL && strcmp(s->name, name) != 0)
        s = s->next;
    return s;
}

bool reader_fault(reader *r, const setting *group, const preset *of, const camera_fault *fault) {
    const setting *given = key_of(group, fault->key), *chosen = of != NULL ? key_of(group, "preset") : NULL;
    char text[CAMERA_FAULT_SIZE];
    camera_fault_text(fault, "", text);
    if (given != NULL || chosen == NULL)
        return reader_fail(r, given != NULL ? given : group, "%s: %s", fault->key, text);
    return reader_fail(r, chosen, "%s: %s; preset %s chose it", fault->key, text, of->name);
}

void reader_known(reader *r, const char *given, const char *name) {
    char *known = r->error->known;
    snprintf(r->error->given, sizeof r->error->given, "%s", given);
    if (strlen(known) + strlen(name) + 2 < NEED_KNOWN_SIZE)
        append(known, NEED_KNOWN_SIZE, "%s%s", *known != '\0' ? " " : "", name);
}

const char *reader_shown(reader *r, const setting *s) {
    switch (s->kind) {
    case SETTING_INTEGER:
        snprintf(r->shown, sizeof r->shown, "%lld", s->integer);
        break;
    case SETTING_REAL:
        snprintf(r->shown, sizeof r->shown, "%.15g", s->number);
        break;
    case SETTING_WORD:
        snprintf(r->shown, sizeof r->shown, "%s", s->number != 0.0 ? "true" : "false");
        break;
    case SETTING_STRING:
        snprintf(r->shown, sizeof r->shown, "'%.60s'", s->string);
        break;
    case SETTING_GROUP:
        return "a group";
    default:
        snprintf(r->shown, sizeof r->shown, "%zu values", s->count);
    }
    return r->shown;
}

bool reader_keys(reader *r, const setting *group, const char *what, const char *const *names, setting **found) {
    for (int k = 0; names[k] != NULL; k++)
        found[k] = NULL;
    for (setting *s = group->first; s != NULL; s = s->next) {
        int k = 0;
        while (names[k] != NULL && strcmp(names[k], s->name) != 0)
            k++;
        if (names[k] == NULL) {
            for (k = 0; names[k] != NULL; k++)
                reader_known(r, s->name, names[k]);
            return reader_fail(r, s, "%s: has no key '%.40s'", what, s->name);
        }
        found[k] = s;
    }
    return true;
}

bool reader_string(reader *r, const setting *s, const char **out) {
    if (s->kind != SETTING_STRING)
        return reader_fail(r, s, "%s: must be a word in quotes, got %s", s->name, reader_shown(r, s));
    *out = s->string;
    return true;
}

bool reader_unreadable(reader *r, const setting *s, int number) {
    reader_fail(r, s, "%s: '%.120s' cannot be read: %s", s->name, s->string, strerror(number));
    r->error->unreadable = true;
    return false;
}

const char *reader_path(const reader *r, const char *name, char out[READER_PATH_SIZE]) {
    const char *here = r->file->path;
    snprintf(out, READER_PATH_SIZE, "%.*s%s", path_is_absolute(name) ? 0 : (int)(path_name(here) - here), here, name);
    return out;
}

bool reader_profile(reader *r, const setting *s, camera_key key, camera_said *c, char name[PROFILE_NAME_SIZE]) {
    char path[READER_PATH_SIZE], error[PROFILE_ERROR_SIZE];
    const int status = camera_profile(c, reader_path(r, s->string, path), key, name, error);
    return status > 0 ? reader_unreadable(r, s, status) : status == 0 || reader_fail(r, s, "%s: %s", s->name, error);
}

bool reader_name(reader *r, const setting *s, const char *name) {
    const size_t length = strlen(name);
    bool good = length >= 1 && length <= 64;
    for (const char *c = name; *c != '\0'; c++)
        good = good && *c > 0x20 && *c < 0x7f;
    return good || reader_fail(r, s, "name: must be 1 to 64 printable ASCII characters, no blanks, got '%.70s'", name);
}

bool reader_unit(reader *r, const setting *s) {
    const char *name = "";
    if (!reader_string(r, s, &name))
        return false;
    r->unit = unit_find(name);
    if (r->unit == NULL)
        return reader_fail(r, s, "unit: must be " UNIT_NAMES ", got '%.40s'", name);
    r->file->unit = r->unit->name;
    return true;
}

/* A decimal number at the beginning of a text; *rest is what follows it and blanks. No sign, no hexadecimal. */
static bool leading_number(const char *text, double *value, const char **rest) {
    if (text[strspn(text, "0123456789.eE+-")] == 'x' || text[strspn(text, "0123456789.eE+-")] == 'X' ||
        !((*text >= '0' && *text <= '9') || *text == '.'))
        return false;
    char *end;
    *value = strtod(text, &end);
    *rest = end + strspn(end, " ");
    return end != text && isfinite(*value);
}

/* A number alone is in scene units; with a unit behind it, it is converted into them. */
static bool length_text(reader *r, const setting *s, const char *key, const char *text, double *out) {
    const char *unit;
    double value;
    if (!leading_number(text, &value, &unit))
        return reader_fail(r, s, "%s: must be a length such as 0.1 or \"10 cm\", got '%.40s'", key, text);
    if (*unit == '\0') {
        *out = value;
        return true;
    }
    const unit_row *row = unit_find(unit);
    if (row == NULL)
        return reader_fail(r, s, "%s: the unit must be " UNIT_NAMES ", got '%.40s'", key, unit);
    if (r->unit == NULL)
        return reader_fail(r, s,
                           "%s: '%.40s' has a unit, but the file does not say what a scene unit is: add "
                           "unit = \"m\"; or the like at its top",
                           key, text);
    *out = unit_convert(value, row, r->unit);
    return true;
}

bool reader_length(reader *r, const setting *s, const char *key, unsigned allowed, double *out) {
    const bool text = s->kind == SETTING_STRING;
    if (text && (allowed & READER_INFINITE) != 0 && strcmp(s->string, "inf") == 0) {
        *out = HUGE_VAL;
        return true;
    }
    if (text) {
        const char *value = s->string;
        const bool negative = (allowed & READER_SIGNED) != 0 && *value == '-';
        if (!length_text(r, s, key, value + negative, out))
            return false;
        *out = negative ? -*out : *out;
    } else if (setting_is_number(s)) {
        *out = s->number;
    } else {
        return reader_fail(r, s, "%s: must be a length such as 0.1 or \"10 cm\", got %s", key, reader_shown(r, s));
    }
    if (isfinite(*out) && (allowed & READER_SIGNED) != 0)
        return true;
    if (!isfinite(*out) || *out < 0.0 || ((allowed & READER_POSITIVE) != 0 && *out == 0.0))
        return reader_fail(r, s, "%s: must be a finite length %s, got %s", key,
                           (allowed & READER_POSITIVE) != 0 ? "above 0" : "not below 0", reader_shown(r, s));
    return true;
}

bool reader_number_within(const setting *s, double least, double most, double *out) {
    if (!setting_is_number(s))
        return false;
    *out = s->number;
    return *out >= least && *out <= most;
}

bool reader_share(reader *r, const setting *s, const char *key, double *out) {
    const char *rest = "";
    bool good = setting_is_number(s);
    if (good)
        *out = s->number;
    else if (s->kind == SETTING_STRING)
        good = leading_number(s->string, out, &rest) && (*rest == '\0' || strcmp(rest, "%") == 0);
    if (good && *rest == '%')
        *out /= 100.0;
    return (good && *out >= 0.0 && *out <= 1.0) ||
           reader_fail(r, s, "%s: must be a share from 0 to 1, such as 0.001 or \"0.1 %%\", got %s", key,
                       reader_shown(r, s));
}
