/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/output/output.h"

#include <string.h>
#include <strings.h>

#include "cli/option/kinds.h"

static const name_list colours = {.words = (const char *const[]){"auto", "always", "never", NULL}};
static const name_list reports = {.words = (const char *const[]){"text", "json", "junit", NULL}};

static int parse_link(asked_line *line, const option_row *row, const char *value, void *group) {
    output_asked *o = group;
    (void)line;
    o->link = value != NULL ? value : "depthprec.html";
    if (*o->link == '\0' || o->link[strcspn(o->link, "# \n")] != '\0')
        return option_refuse(row, "must be a URL without '#' and blanks, got '%s'", value);
    return EXIT_FINE;
}

static int parse_form(asked_line *line, const option_row *row, const char *value, void *group) {
    output_asked *o = group;
    (void)line;
    const output_form form = (output_form)row->least;
    (void)value;
    if (o->form != FORM_TEXT && o->form != form)
        return option_refuse(row, "conflicts with --%s", form == FORM_JSON ? "csv" : "json");
    o->form = form;
    return EXIT_FINE;
}

#define GROUP_TYPE output_asked

/* clang-format off */
static const option_row output_rows[] = {
    {"link", 0, NULL,
        "print a link that opens this command in the page depthprec.html, or in the copy of it at URL",
        .parse = parse_link, INTO(const char *, link), .optional = "URL", .group = "Output"},
    {"report", 0, NULL,
        "format of the verdicts: text, JSON, or JUnit XML",
        WORD(report, reports), .standard = "text"},
    {"json", 0, NULL,
        "write JSON, one object, schema depthprec/1", parse_form, .least = FORM_JSON},
    {"csv", 0, NULL,
        "write CSV (RFC 4180) with units in the header row", parse_form, .least = FORM_CSV},
    {"output", 'o', "FILE",
        "write to FILE once complete; - is stdout", FILE_WRITTEN(file), .without = "stdout"},
    {"threads", 0, "N",
        "use at most N threads; results do not change", WHOLE(threads, 1, 1024, NULL), .without = "all cores"},
    {"quiet", 'q', NULL,
        "no messages and no progress, only data and errors", FLAG(quiet)},
    {"full", 0, NULL,
        "all columns, however wide", FLAG(full)},
    {"color", 0, NULL,
        "bold headings and coloured verdicts in text; auto: on a terminal where NO_COLOR is not set",
        WORD(colour, colours), .standard = "auto"},
    END};
/* clang-format on */

const option_table output_options = {.rows = output_rows};

const option_use output_written[] = {TAKE("json"),  TAKE("csv"), TAKE("output"), TAKE("quiet"), TAKE("full"),
                                     TAKE("color"), END};

/* The ending of a file that holds a picture or a model, which no text is written into; null of others. */
static const char *ending_of_picture(const char *path) {
    static const char *const endings[] = {".svg", ".pdf", ".png", ".pfm", ".npy", ".exr", ".glb"};
    const size_t length = strlen(path);
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++)
        if (length > 4 && strcasecmp(path + length - 4, endings[i]) == 0)
            return endings[i];
    return NULL;
}

static int refuse_picture(const output_asked *o) {
    const char *ending = o->file != NULL ? ending_of_picture(o->file) : NULL;
    return ending == NULL
               ? EXIT_FINE
               : option_error("output", "must not end in %s where no picture is written, got '%s'", ending, o->file);
}

int output_ready(const output_asked *o) {
    const int status = refuse_picture(o);
    return status == EXIT_FINE && o->file != NULL && strcmp(o->file, "-") != 0 ? output_check(o->file) : status;
}

int output_start(const output_asked *o, const camera_asked *camera, output *out) {
    int status = refuse_picture(o);
    if (status != EXIT_FINE)
        return status;
    status = output_open(out, o->file);
    out->width = o->full ? OUTPUT_UNLIMITED : 0;
    out->colour = (output_colour)o->colour;
    out->measured = camera != NULL && camera->gpu.measured[0] != '\0' ? camera->gpu.measured : NULL;
    return status;
}

int camera_request_complete(void *request) {
    struct {
        CAMERA_REQUEST;
    } *o = request;
    return camera_complete(&o->camera, &(camera_use){0});
}
