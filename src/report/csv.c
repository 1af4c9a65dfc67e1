/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/csv.h"

#include <math.h>
#include <string.h>

#include "report/number.h"

csv csv_start(output *out) {
    return (csv){.out = out};
}

static void separate(csv *c) {
    if (c->filled)
        output_char(c->out, ',');
    c->filled = true;
}

void csv_string(csv *c, const char *value) {
    separate(c);
    if (strpbrk(value, ",\"\r\n") == NULL) {
        output_text(c->out, value);
        return;
    }
    output_char(c->out, '"');
    for (; *value != '\0'; value++) {
        if (*value == '"')
            output_char(c->out, '"');
        output_char(c->out, *value);
    }
    output_char(c->out, '"');
}

void csv_number(csv *c, double value) {
    separate(c);
    if (isnan(value))
        return;
    char text[NUMBER_SIZE];
    output_bytes(c->out, text, number_shortest(value, text));
}

void csv_integer(csv *c, uint64_t value) {
    char digits[20];
    size_t first = sizeof digits;
    do
        digits[--first] = (char)('0' + value % 10);
    while ((value /= 10) > 0);
    separate(c);
    output_bytes(c->out, digits + first, sizeof digits - first);
}

void csv_end(csv *c) {
    output_text(c->out, "\r\n");
    c->filled = false;
}
