/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/check_report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/setups.h"
#include "plot/notes.h"
#include "report/append.h"
#include "report/csv.h"
#include "report/json.h"
#include "report/number.h"

enum { DIGITS = 6, SENTENCE_SIZE = 512 };

typedef char quantity[NUMBER_SIZE + 8];

/* A number with the unit of the file behind it, "0.001 m"; a share as it is. What is promised is rounded up. */
static const char *put(quantity out, const check_file *f, double value, bool is_length, bool upward) {
    const size_t used = upward ? number_bound(value, DIGITS, true, out) : number_digits(value, DIGITS, out);
    if (is_length && f->file.unit[0] != '\0' && isfinite(value))
        snprintf(out + used, sizeof(quantity) - used, " %s", f->file.unit);
    return out;
}

static bool has_code(const check_verdict *v) {
    return isfinite(v->z);
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

/* "separation 0.00149 m at 50 m (code 123), allowed 0.001 m" */
static const char *sentence(const check_file *f, const check_verdict *v, char out[SENTENCE_SIZE]) {
    const need_kind_row *kind = need_kind_get(v->asked->kind);
    quantity value, limit, z;
    out[0] = '\0';
    append(out, SENTENCE_SIZE, "%s %s", kind->phrase, put(value, f, v->value, kind->is_length, true));
    if (!isnan(v->z))
        append(out, SENTENCE_SIZE, " at %s", put(z, f, v->z, true, false));
    if (has_code(v))
        append(out, SENTENCE_SIZE, " (code %u)", (unsigned)v->code);
    append(out, SENTENCE_SIZE, ", allowed %s", put(limit, f, v->asked->limit, kind->is_length, false));
    return out;
}

static void write_text(const options *o, output *out, const check_file *files, size_t count) {
    char text[SENTENCE_SIZE];
    char label[SETUP_LABEL_SIZE];
    for (size_t i = 0; i < count; i++) {
        const check_file *f = &files[i];
        for (size_t k = 0; k < f->count; k++) {
            const check_verdict *v = &f->verdicts[k];
            if (o->quiet && v->passed)
                continue;
            output_format(out, "%s  %s:%d: %s: camera %s, %s (%s): %s\n", v->passed ? "pass" : "FAIL", f->file.path,
                          v->asked->line, v->asked->name, v->camera->name, setup_label(&v->setup, false, label),
                          dp_model_name(v->setup.spec.model), sentence(f, v, text));
            if (o->verbose)
                output_format(out, "      decided by %s: %s\n", check_method_name(v->method),
                              setup_label(&v->setup, true, label));
        }
        if (!o->quiet)
            output_format(out, "%s: %ld passed, %ld failed\n", f->file.path, (long)f->count - f->failed, f->failed);
    }
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

static void json_verdict(json *j, const check_file *f, const check_verdict *v) {
    json_object(j, NULL);
    json_string(j, "file", f->file.path);
    json_integer(j, "line", (uint64_t)v->asked->line);
    json_string(j, "name", v->asked->name);
    json_string(j, "camera", v->camera->name);
    json_object(j, "setup");
    setup_json(j, &v->setup);
    json_end(j);
    json_string(j, "kind", need_kind_get(v->asked->kind)->name);
    json_string(j, "unit", f->file.unit[0] != '\0' ? f->file.unit : NULL);
    json_number(j, "lo", v->asked->lo);
    json_number(j, "hi", v->asked->hi);
    json_number(j, "limit", v->asked->limit);
    json_number(j, "value", v->value);
    json_number(j, "z", v->z);
    if (has_code(v))
        json_integer(j, "code", v->code);
    else
        json_null(j, "code");
    json_string(j, "method", check_method_name(v->method));
    json_bool(j, "passed", v->passed);
    json_end(j);
}

static void write_json(const options *o, output *out, const check_file *files, size_t count) {
    long failed = 0;
    (void)o;
    for (size_t i = 0; i < count; i++)
        failed += files[i].failed;
    json j = json_start(out, "check");
    json_bool(&j, "passed", failed == 0);
    json_array(&j, "requirements");
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < files[i].count; k++)
            json_verdict(&j, &files[i], &files[i].verdicts[k]);
    json_finish(&j);
}

/* ---- JUnit ------------------------------------------------------------------------------------------------------- */

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

static void xml_attribute(output *out, const char *name, const char *value) {
    output_format(out, " %s=\"", name);
    xml(out, value);
    output_char(out, '"');
}

static void junit_case(output *out, const check_file *f, const check_verdict *v) {
    char text[SENTENCE_SIZE];
    char label[SETUP_LABEL_SIZE];
    char line[16];
    snprintf(line, sizeof line, "%d", v->asked->line);
    snprintf(text, sizeof text, "%s (%s)", v->asked->name, setup_label(&v->setup, false, label));
    output_text(out, "    <testcase");
    xml_attribute(out, "classname", v->camera->name);
    xml_attribute(out, "name", text);
    xml_attribute(out, "file", f->file.path);
    xml_attribute(out, "line", line);
    if (v->passed) {
        output_text(out, "/>\n");
        return;
    }
    output_text(out, ">\n      <failure");
    xml_attribute(out, "type", need_kind_get(v->asked->kind)->name);
    xml_attribute(out, "message", sentence(f, v, text));
    output_char(out, '>');
    xml(out, setup_label(&v->setup, true, label));
    output_text(out, "</failure>\n    </testcase>\n");
}

static void write_junit(const options *o, output *out, const check_file *files, size_t count) {
    (void)o;
    output_text(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"depthprec check\">\n");
    for (size_t i = 0; i < count; i++) {
        output_text(out, "  <testsuite");
        xml_attribute(out, "name", files[i].file.path);
        output_format(out, " tests=\"%zu\" failures=\"%ld\" errors=\"0\">\n", files[i].count, files[i].failed);
        for (size_t k = 0; k < files[i].count; k++)
            junit_case(out, &files[i], &files[i].verdicts[k]);
        output_text(out, "  </testsuite>\n");
    }
    output_text(out, "</testsuites>\n");
}

/* ---- CSV --------------------------------------------------------------------------------------------------------- */

static void write_csv(const options *o, output *out, const check_file *files, size_t count) {
    static const char *const before[] = {"file", "line", "name", "camera"};
    static const char *const after[] = {"kind",  "unit",      "lo [scene]", "hi [scene]", "limit",
                                        "value", "z [scene]", "code",       "method",     "passed"};
    csv c = csv_start(out);
    (void)o;
    for (size_t i = 0; i < sizeof before / sizeof before[0]; i++)
        csv_string(&c, before[i]);
    setup_csv_head(&c);
    for (size_t i = 0; i < sizeof after / sizeof after[0]; i++)
        csv_string(&c, after[i]);
    csv_end(&c);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < files[i].count; k++) {
            const check_verdict *v = &files[i].verdicts[k];
            csv_string(&c, files[i].file.path);
            csv_integer(&c, (uint64_t)v->asked->line);
            csv_string(&c, v->asked->name);
            csv_string(&c, v->camera->name);
            setup_csv(&c, &v->setup);
            csv_string(&c, need_kind_get(v->asked->kind)->name);
            csv_string(&c, files[i].file.unit);
            csv_number(&c, v->asked->lo);
            csv_number(&c, v->asked->hi);
            csv_number(&c, v->asked->limit);
            csv_number(&c, v->value);
            csv_number(&c, v->z);
            csv_number(&c, has_code(v) ? (double)v->code : (double)NAN);
            csv_string(&c, check_method_name(v->method));
            csv_string(&c, v->passed ? "true" : "false");
            csv_end(&c);
        }
}

void check_report(const options *o, output *out, const check_file *files, size_t count) {
    void (*const forms[])(const options *, output *, const check_file *,
                          size_t) = {[FORM_TEXT] = write_text, [FORM_JSON] = write_json, [FORM_CSV] = write_csv};
    void (*const reports[])(const options *, output *, const check_file *, size_t) = {
        [REPORT_TEXT] = forms[o->form], [REPORT_JSON] = write_json, [REPORT_JUNIT] = write_junit};
    reports[o->report](o, out, files, count);
}
