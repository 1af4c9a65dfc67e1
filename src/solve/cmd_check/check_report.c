/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/cmd_check/check_report.h"
#include "solve/cmd_check/request.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "bias/cmd_bias/call.h"
#include "camera/cmd/setups.h"
#include "camera/cmd/slant.h"
#include "cli/junit.h"
#include "core/append.h"
#include "report/sentence.h"

enum { DIGITS = 6 };

/* A bias that is judged. */
typedef struct biased {
    const char *answer;         /* "not enough" */
    char given[BIAS_CALL_SIZE]; /* as programs write it */
    char least[BIAS_CALL_SIZE]; /* the least that is enough; "" where none is */
} biased;

static const column biased_columns[] = {{FIELD(biased, answer, "answer", "")},
                                        {FIELD(biased, given, "given", "")},
                                        {FIELD(biased, least, "least", "")},
                                        {.kind = COLUMN_END}};

/* A verdict, and what of it is named elsewhere. */
typedef struct verdict {
    const char *file, *name, *camera, *kind, *unit, *method; /* unit: null where the file does not say */
    const char *measured;                                    /* null without a profile */
    const char *said;                                        /* as text and JUnit have it; null: not asked for */
    need asked;
    check_verdict found;
    setup_fields setup;
    slant_fields slant;
    const slant_fields *triangles; /* null where surfaces face the camera */
    surfaces_text surfaces;
    double code;                /* NaN where there is none */
    const char *phrase, *among; /* in a sentence: "separation" ", facing" */
    number_text shown, allowed;
    biased of_bias;
    const biased *biased; /* null where no bias is judged */
} verdict;

static const column verdict_columns[] = {
    {FIELD(verdict, file, "file", "")},
    {FIELD(verdict, asked.line, "line", "")},
    {FIELD(verdict, name, "name", "")},
    {FIELD(verdict, camera, "camera", "")},
    {PART(verdict, setup, "setup", setup_columns)},
    {FIELD(verdict, kind, "kind", "")},
    {FIELD(verdict, unit, "unit", "")},
    {FIELD(verdict, asked.lo, "lo", "scene"), .digits = DIGITS},
    {FIELD(verdict, asked.hi, "hi", "scene"), .digits = DIGITS},
    {FIELD(verdict, asked.limit, "limit", "")},
    {FIELD(verdict, found.value, "value", "")},
    {FIELD(verdict, found.z, "z", "scene"), .digits = DIGITS},
    {FIELD(verdict, code, "code", "")},
    {FIELD(verdict, method, "method", "")},
    {FIELD(verdict, found.passed, "passed", "")},
    {FIELD(verdict, said, "verdict", ""), .only = AS_JSON},
    {PART(verdict, biased, "bias", biased_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {FIELD(verdict, surfaces.text, "surfaces", "")},
    {FIELD(verdict, measured, "measured", ""), .only = AS_JSON, .optional = true},
    {PART(verdict, triangles, "triangles", slant_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {.kind = COLUMN_END}};

static bool is_facing(const check_verdict *v) {
    return !v->sloped && !check_is_slanted(v);
}

static surfaces_text surfaces(const check_verdict *v) {
    if (v->sloped)
        return (surfaces_text){"at the slope"};
    if (v->asked->kind == QUANTITY_BIAS && check_is_slanted(v)) /* whatever the class is, see bias/need.c */
        return (surfaces_text){"any slant"};
    return check_is_slanted(v) ? surfaces_words(&v->setup.spec.triangles) : (surfaces_text){"facing"};
}

static biased biased_of(const check_verdict *v) {
    biased b = {.answer = bias_answer_name(v->answer)};
    if (v->asked->kind != QUANTITY_BIAS)
        return b;
    append(b.given, sizeof b.given, "%s",
           bias_call(v->asked->bias.api, v->asked->bias.units, v->asked->bias.factor).text);
    if (!isnan(v->value))
        append(b.least, sizeof b.least, "%s", bias_call(v->asked->bias.api, v->value, v->factor).text);
    return b;
}

static verdict verdict_of(const check_file *f, const check_verdict *v) {
    const quantity_row *kind = quantity_get(v->asked->kind);
    const char *const unit = f->file.unit[0] != '\0' ? f->file.unit : NULL;
    const number_two compared = number_compared(v->value, v->asked->limit, DIGITS);
    return (verdict){.file = f->file.path,
                     .name = v->asked->name,
                     .camera = v->camera->name,
                     .kind = kind->name,
                     .unit = unit,
                     .method = check_method_name(v->method),
                     .measured = v->camera->gpu.measured[0] != '\0' ? v->camera->gpu.measured : NULL,
                     .asked = *v->asked,
                     .setup = setup_fields_of(&v->setup, unit),
                     .found = *v,
                     .slant = {v->setup.spec.triangles, v->camera->raster != NULL ? v->camera->raster->name : NULL,
                               dp_arith_get(v->setup.spec.arith)->name},
                     .surfaces = surfaces(v),
                     .code = isfinite(v->z) ? v->code : (double)NAN,
                     .of_bias = biased_of(v),
                     .phrase = kind->note,
                     .shown = number_in(compared.value, kind->unit != NULL ? unit : NULL),
                     .allowed = number_in(compared.limit, kind->unit != NULL ? unit : NULL)};
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static const column said_columns[] = {{GROUP(NULL, verdict_columns)},
                                      {PART(verdict, of_bias, NULL, biased_columns)},
                                      WORD(verdict, phrase),
                                      WORD(verdict, among),
                                      NUMBER(verdict, shown),
                                      NUMBER(verdict, allowed),
                                      {.kind = COLUMN_END}};

enum { OF_RANGE = 1, OF_BIAS = 2, WITNESS = 4, LEAST = 8 };

static const sentence said[] = {
    PROSE("bias {given} {answer}: at {z} (code {code}){among}; the least that is enough: {least}",
          OF_BIAS | WITNESS | LEAST),
    ELSE("bias {given} {answer}: at {z} (code {code}){among}; no bias is", OF_BIAS | WITNESS),
    ELSE("bias {given} {answer} from {lo} to {hi}{among}; the least that is enough: {least}", OF_BIAS | LEAST),
    ELSE("bias {given} {answer} from {lo} to {hi}{among}; no bias is", OF_BIAS),
    ELSE("{phrase} {shown} from {lo} to {hi}, allowed {allowed}", OF_RANGE),
    ELSE("{phrase} {shown} at {z} (code {code}){among}, allowed {allowed}", 0),
    ELSE("{phrase} {shown} at {z}{among}, allowed {allowed}", 0),
    ELSE("{phrase} {shown}{among}, allowed {allowed}", 0),
    SENTENCE_END};

/* "separation 0.00149 m at 50 m (code 123), facing, allowed 0.001 m"; what is promised is rounded up */
static const char *sentence_of(const check_file *f, const check_verdict *v, char out[SENTENCE_SIZE]) {
    const page p = {.unit = f->file.unit[0] != '\0' ? f->file.unit : NULL};
    char among[sizeof(surfaces_text) + 2] = "";
    verdict x = verdict_of(f, v);
    if (quantity_get(v->asked->kind)->of_surfaces)
        snprintf(among, sizeof among, ", %s", surfaces(v).text);
    x.among = among;
    const bool bias = v->asked->kind == QUANTITY_BIAS;
    const unsigned when = v->asked->kind == QUANTITY_TIES ? OF_RANGE : bias ? OF_BIAS : 0;
    return sentence_first(&p, said, said_columns, &x,
                          when | (bias && isfinite(v->z) ? WITNESS : 0) | (x.of_bias.least[0] != '\0' ? LEAST : 0),
                          out);
}

/* Which GPU the promises for a camera are for. */
static void say_measured(page *p, const check_file *f) {
    for (size_t i = 0; i < f->file.camera_count; i++) {
        const need_camera *camera = &f->file.cameras[i];
        if (camera->gpu.measured[0] != '\0')
            page_text(p, "%s: camera %s: measured on %s", f->file.path, camera->name, camera->gpu.measured);
    }
}

static void write_text(const checks_request *o, bool failures, output *out, const check_file *files, size_t count) {
    char text[SENTENCE_SIZE], label[SETUP_LABEL_SIZE];
    page p = page_start(out, 4); /* where what decided is indented to */
    for (const check_file *f = files; f < files + count; f++) {
        for (size_t k = 0; k < f->count; k++) {
            const check_verdict *v = &f->verdicts[k];
            if (failures && v->passed)
                continue;
            page_text(&p, "%s%s%s  %s:%d: %s: camera %s, %s (%s): %s", v->passed ? p.good : p.bad,
                      v->passed ? "pass" : "FAIL", p.plain, f->file.path, v->asked->line, v->asked->name,
                      v->camera->name, setup_label(&v->setup, false, label),
                      option_word("model", setup_model(&v->setup)), sentence_of(f, v, text));
            if (o->out.full)
                page_note(&p, "", "decided by %s: %s", check_method_name(v->method),
                          setup_label(&v->setup, true, label));
        }
        if (!failures)
            say_measured(&p, f);
        if (!failures)
            page_text(&p, "%s: %ld passed, %ld failed", f->file.path, (long)f->count - f->failed, f->failed);
    }
}

/* ---- JUnit ------------------------------------------------------------------------------------------------------- */

static void say_case(output *out, const check_file *f, const check_verdict *v) {
    char text[SENTENCE_SIZE], name[SENTENCE_SIZE], label[SETUP_LABEL_SIZE], line[16];
    char full[SETUP_LABEL_SIZE], detail[SETUP_LABEL_SIZE + PROFILE_MEASURED_SIZE + 16];
    const char *const measured = v->camera->gpu.measured;
    snprintf(line, sizeof line, "%d", v->asked->line);
    snprintf(name, sizeof name, "%s (%s%s%s)", v->asked->name, setup_label(&v->setup, false, label),
             is_facing(v) ? "" : ", ", is_facing(v) ? "" : surfaces(v).text);
    snprintf(detail, sizeof detail, "%s%s%s", setup_label(&v->setup, true, full),
             measured[0] != '\0' ? ", measured on " : "", measured);
    junit_case(out, &(junit_row){.classname = v->camera->name,
                                 .name = name,
                                 .file = f->file.path,
                                 .line = line,
                                 .type = v->passed ? NULL : quantity_get(v->asked->kind)->name,
                                 .message = v->passed ? NULL : sentence_of(f, v, text),
                                 .detail = detail});
}

static void write_junit(output *out, const check_file *files, size_t count) {
    junit_begin(out, "depthprec check");
    for (size_t i = 0; i < count; i++) {
        junit_suite(out, files[i].file.path, files[i].count, (size_t)files[i].failed);
        for (size_t k = 0; k < files[i].count; k++)
            say_case(out, &files[i], &files[i].verdicts[k]);
        junit_suite_end(out);
    }
    junit_end(out);
}

/* ---- JSON and CSV ------------------------------------------------------------------------------------------------ */

typedef struct verdicts {
    const check_file *files;
    size_t count;
    bool passed;
    verdict verdict;
    char said[SENTENCE_SIZE];
} verdicts;

static void *next_verdict(void *of, size_t i) {
    verdicts *all = of;
    const check_file *f = all->files;
    for (; f < all->files + all->count && i >= f->count; f++)
        i -= f->count;
    if (f == all->files + all->count)
        return NULL;
    all->verdict = verdict_of(f, &f->verdicts[i]);
    all->verdict.said = sentence_of(f, &f->verdicts[i], all->said);
    all->verdict.setup.planes = camera_matrix_left_open(&f->verdicts[i].camera->matrix);
    all->verdict.biased = f->verdicts[i].asked->kind == QUANTITY_BIAS ? &all->verdict.of_bias : NULL;
    all->verdict.triangles = check_is_slanted(&f->verdicts[i]) ? &all->verdict.slant : NULL;
    return &all->verdict;
}

static const column columns[] = {{FIELD(verdicts, passed, "passed", ""), .only = AS_JSON},
                                 {LIST("requirements", verdict_columns, next_verdict)},
                                 {.kind = COLUMN_END}};

void check_say_failures(const checks_request *o, const check_file *files, size_t count) {
    output errors = {.fd = STDERR_FILENO, .colour = (output_colour)o->out.colour};
    write_text(o, true, &errors, files, count);
    output_flush(&errors);
}

void check_report(const checks_request *o, output *out, const check_file *files, size_t count, bool passed) {
    verdicts all = {.files = files, .count = count, .passed = passed};
    const output_form form = o->out.report == REPORT_JSON ? FORM_JSON : o->out.form;
    if (o->out.report == REPORT_JUNIT)
        write_junit(out, files, count);
    else if (form == FORM_TEXT)
        write_text(o, o->out.quiet, out, files, count);
    else
        report_write(&(report_spec){.command = "check", .columns = columns, .item = &all}, out, form);
}
