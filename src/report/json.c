/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/json.h"

#include <math.h>

#include "depthprec/depthprec.h"
#include "report/number.h"

static void quoted(output *out, const char *text) {
    output_char(out, '"');
    for (; *text != '\0'; text++) {
        unsigned char c = (unsigned char)*text;
        if (c < 0x20)
            output_format(out, "\\u%04x", c);
        else {
            if (c == '"' || c == '\\')
                output_char(out, '\\');
            output_char(out, *text);
        }
    }
    output_char(out, '"');
}

/* What stands before a value: a comma, and its key inside an object. */
static void member(json *j, const char *key) {
    if (j->filled[j->depth])
        output_char(j->out, ',');
    j->filled[j->depth] = true;
    if (key != NULL) {
        quoted(j->out, key);
        output_char(j->out, ':');
    }
}

static void open_level(json *j, char bracket, char close) {
    output_char(j->out, bracket);
    j->depth++;
    j->close[j->depth] = close;
    j->filled[j->depth] = false;
}

json json_start(output *out, const char *command) {
    json j = {.out = out, .depth = -1};
    open_level(&j, '{', '}');
    json_string(&j, "schema", "depthprec/1");
    json_string(&j, "command", command);
    json_string(&j, "version", dp_version());
    return j;
}

/* Objects of an array, and the member after them, begin a line: so a diff of two outputs shows rows. */
void json_object(json *j, const char *key) {
    member(j, key);
    if (key == NULL)
        output_char(j->out, '\n');
    open_level(j, '{', '}');
}

void json_array(json *j, const char *key) {
    member(j, key);
    open_level(j, '[', ']');
}

void json_end(json *j) {
    output_char(j->out, j->close[j->depth]);
    j->depth--;
}

void json_number(json *j, const char *key, double value) {
    if (!isfinite(value)) {
        json_null(j, key);
        return;
    }
    char text[NUMBER_SIZE];
    member(j, key);
    output_bytes(j->out, text, number_shortest(value, text));
}

void json_integer(json *j, const char *key, uint64_t value) {
    char digits[20];
    size_t first = sizeof digits;
    do
        digits[--first] = (char)('0' + value % 10);
    while ((value /= 10) > 0);
    member(j, key);
    output_bytes(j->out, digits + first, sizeof digits - first);
}

void json_string(json *j, const char *key, const char *value) {
    if (value == NULL) {
        json_null(j, key);
        return;
    }
    member(j, key);
    quoted(j->out, value);
}

void json_bool(json *j, const char *key, bool value) {
    member(j, key);
    output_text(j->out, value ? "true" : "false");
}

void json_null(json *j, const char *key) {
    member(j, key);
    output_text(j->out, "null");
}

void json_finish(json *j) {
    while (j->depth >= 0)
        json_end(j);
    output_char(j->out, '\n');
}
