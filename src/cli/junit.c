/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/junit.h"

#include <string.h>

#include "draw/notes.h"

static void xml(output *out, const char *text) {
    char clean[1024];
    notes_clean(clean, sizeof clean, text);
    for (const char *c = clean; *c != '\0'; c++) {
        static const char special[] = "&<>\"";
        static const char *const names[] = {"&amp;", "&lt;", "&gt;", "&quot;"};
        const char *found = strchr(special, *c);
        if (found != NULL)
            output_text(out, names[found - special]);
        else
            output_char(out, *c);
    }
}

static void attribute(output *out, const char *name, const char *value) {
    if (value == NULL)
        return;
    output_format(out, " %s=\"", name);
    xml(out, value);
    output_char(out, '"');
}

void junit_begin(output *out, const char *name) {
    output_text(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites");
    attribute(out, "name", name);
    output_text(out, ">\n");
}

void junit_suite(output *out, const char *name, size_t tests, size_t failures) {
    output_text(out, "  <testsuite");
    attribute(out, "name", name);
    output_format(out, " tests=\"%zu\" failures=\"%zu\" errors=\"0\">\n", tests, failures);
}

void junit_case(output *out, const junit_row *row) {
    output_text(out, "    <testcase");
    attribute(out, "classname", row->classname);
    attribute(out, "name", row->name);
    attribute(out, "file", row->file);
    attribute(out, "line", row->line);
    if (row->type == NULL) {
        output_text(out, "/>\n");
        return;
    }
    output_text(out, ">\n      <failure");
    attribute(out, "type", row->type);
    attribute(out, "message", row->message);
    output_char(out, '>');
    xml(out, row->detail);
    output_text(out, "</failure>\n    </testcase>\n");
}

void junit_suite_end(output *out) {
    output_text(out, "  </testsuite>\n");
}

void junit_end(output *out) {
    output_text(out, "</testsuites>\n");
}
