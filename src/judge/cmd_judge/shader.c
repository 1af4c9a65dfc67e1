/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "judge/cmd_judge/shader.h"
#include "judge/cmd_judge/request.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "judge/written.h"
#include "probe/compute.h"
#include "report/number.h"
#include "system/input.h"

int parse_define(asked_line *line, const option_row *row, const char *value, void *group) {
    judge_asked *o = group;
    (void)line;
    if (!written_define_known(value))
        return option_refuse(row,
                             "must be NAME=near, far, z_buffer_params, projection or another word of the help, or a "
                             "number, got '%s'",
                             value);
    if (o->define_count == JUDGE_DEFINES_MAX)
        return option_refuse(row, "must not be more than %d, got '%s' too", JUDGE_DEFINES_MAX, value);
    o->defines[o->define_count++] = value;
    return EXIT_FINE;
}

enum { FILE_MOST = 1 << 24, ALL_MOST = 1 << 26, TURNS = 8 };

/* ---- The file ---------------------------------------------------------------------------------------------------- */

/* Its bytes, and a 0 behind them. */
static int read_file(const char *path, char **out, size_t *size) {
    FILE *in = input_open(path);
    *out = in != NULL ? malloc(FILE_MOST + 1) : NULL;
    *size = *out != NULL ? fread(*out, 1, FILE_MOST, in) : 0;
    const bool good = *out != NULL && ferror(in) == 0 && feof(in) != 0;
    if (*out != NULL)
        (*out)[*size] = '\0';
    if (!good)
        usage_error("%s: %s", path, in == NULL || ferror(in) != 0 ? strerror(errno) : "does not fit into memory");
    if (in != NULL)
        input_close(in);
    return good ? EXIT_FINE : EXIT_IO;
}

static bool ends_with(const char *text, const char *ending) {
    const size_t length = strlen(text), end = strlen(ending);
    return length > end && strcmp(text + length - end, ending) == 0;
}

static bool is_hlsl(const char *path) {
    static const char *const endings[] = {".hlsl", ".hlsli", ".fx", ".cginc", ".usf", ".ush"};
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++)
        if (ends_with(path, endings[i]))
            return true;
    return false;
}

/* Once for its values, and where it is timed once more. */
static int compile(shader *s, const dp_setup *setup, const char *path, unsigned turns) {
    compute_run *run = turns > 0 ? s->timed : s->run;
    const char *function = s->function;
    written w = {0};
    char error[COMPUTE_ERROR_SIZE];
    unsigned line = 0;
    int status = EXIT_FINE;
    const judge_asked *j = &s->o->judge;
    const size_t defines = s->given ? j->define_count : 0;
    s->hlsl = is_hlsl(path);
    run->turns = turns * WRITTEN_CALLS;
    if (!written_make(s->text, function, s->hlsl, setup, j->defines, defines, turns, &w, error))
        status = usage_error("%s: %s %s", path, function, error);
    else if (!compute_compile(w.text, s->hlsl, run, &line, error) && (line == 0 || line > w.lines + 1))
        status = usage_error("%s: %s: %s", path, function, error);
    else if (run->code == NULL)
        status = usage_error("%s:%u: %s%s", path, line, error,
                             strstr(error, "undeclared") != NULL ? " (--define gives a uniform its value)" : "");
    memcpy(run->constants, w.constants, sizeof run->constants);
    snprintf(s->defines, sizeof s->defines, "%s", w.defines);
    if (w.open[0] != '\0')
        snprintf(s->open, sizeof s->open, "a condition asks for %s: --define %s=1 defines it, %s=0 does not", w.open,
                 w.open, w.open);
    s->camera = w.camera;
    free(w.text);
    return status;
}

int shader_write(const judge_request *o, const dp_setup *setup, const char *text, const char *function, bool asked,
                 shader *out) {
    *out = (shader){.o = o,
                    .run = calloc(1, sizeof(compute_run)),
                    .timed = calloc(1, sizeof(compute_run)),
                    .text = strdup(text),
                    .function = function};
    if (out->run == NULL || out->timed == NULL || out->text == NULL)
        return EXIT_IO;
    const int status = asked ? compile(out, setup, function, 0) : EXIT_FINE;
    return status == EXIT_FINE ? compile(out, setup, function, TURNS) : status;
}

int shader_open(const judge_request *o, const dp_setup *setup, const char *operand, bool timed, shader *out) {
    const char *colon = strrchr(operand, ':');
    const bool spirv = ends_with(operand, ".spv");
    char *text = NULL, *path = strdup(operand), error[COMPUTE_ERROR_SIZE];
    compute_run *run = calloc(1, sizeof *run);
    *out = (shader){.o = o, .run = run, .timed = calloc(1, sizeof *run), .given = true, .most = ALL_MOST};
    int status = run != NULL && out->timed != NULL && path != NULL ? EXIT_FINE : EXIT_IO;
    if (colon != NULL && strpbrk(colon, "/\\.") != NULL)
        colon = NULL; /* of a path, as C:\\depth.hlsl */
    const char *asker = o->judge.mine_count > 0 ? "--mine" : "judge";
    const bool whole = !spirv && colon == NULL; /* the only function of FILE */
    if (status == EXIT_FINE && !spirv && !whole && (colon == operand || colon[1] == '\0'))
        status = usage_error("%s: must be FILE, FILE:FUNCTION or FILE.spv, got '%s'", asker, operand);
    if (status == EXIT_FINE && spirv && o->judge.define_count > 0)
        status = option_error("define", "is not for SPIR-V, which has its constants in it");
    if (status == EXIT_FINE && !spirv && !whole)
        path[colon - operand] = '\0';
    if (status == EXIT_FINE)
        status = read_file(path, &text, &run->size);
    if (status == EXIT_FINE && !spirv) {
        out->text = text;
        out->function = whole ? written_only(text, is_hlsl(path), out->own, error) : colon + 1;
        if (out->function == NULL)
            status = usage_error("%s: %s: %s", asker, path, error);
        else
            status = compile(out, setup, path, 0);
        if (status == EXIT_FINE && timed)
            status = compile(out, setup, path, TURNS);
        text = NULL;
    } else if (status == EXIT_FINE) {
        run->code = (uint32_t *)(void *)text;
        text = NULL;
        status = compute_look(run, error) ? EXIT_FINE : usage_error("%s: %s", path, error);
    }
    free(text);
    free(path);
    return status;
}

void shader_close(shader *s) {
    compute_run *both[] = {s->run, s->timed};
    for (int i = 0; i < 2; i++) {
        if (both[i] != NULL)
            free(both[i]->code);
        free(both[i]);
    }
    free(s->text);
}
