/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/judge/shader.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "judge/written.h"
#include "probe/compute.h"
#include "system/input.h"

enum { FILE_MOST = 1 << 24, ALL_MOST = 1 << 26 };

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

static int compile(shader *s, const dp_setup *setup, const char *path, const char *function, const char *text) {
    compute_run *run = s->run;
    written w = {0};
    char error[COMPUTE_ERROR_SIZE];
    unsigned line = 0;
    int status = EXIT_FINE;
    const options_judge *j = &s->o->judge;
    if (!written_make(text, function, is_hlsl(path), setup, j->defines, j->define_count, &w, error))
        status = usage_error("%s: %s %s", path, function, error);
    else if (!compute_compile(w.text, is_hlsl(path), run, &line, error) && (line == 0 || line > w.lines + 1))
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

int shader_open(const options *o, const dp_setup *setup, shader *out) {
    const char *operand = o->operands[0], *colon = strrchr(operand, ':');
    const bool spirv = ends_with(operand, ".spv");
    char *text = NULL, *path = strdup(operand), error[COMPUTE_ERROR_SIZE];
    compute_run *run = calloc(1, sizeof *run);
    *out = (shader){.o = o, .run = run, .most = ALL_MOST};
    int status = run != NULL && path != NULL ? EXIT_FINE : EXIT_IO;
    if (status == EXIT_FINE && !spirv && (colon == NULL || colon == operand || colon[1] == '\0'))
        status = usage_error("judge: must be FILE:FUNCTION, or FILE.spv, got '%s'", operand);
    if (status == EXIT_FINE && spirv && o->judge.define_count > 0)
        status = option_error(OPTION_DEFINE, "is not for SPIR-V, which has its constants in it");
    if (status == EXIT_FINE && !spirv)
        path[colon - operand] = '\0';
    if (status == EXIT_FINE)
        status = read_file(path, &text, &run->size);
    if (status == EXIT_FINE && !spirv) {
        status = compile(out, setup, path, colon + 1, text);
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
    compute_run *run = s->run;
    if (run != NULL)
        free(run->code);
    free(run);
}
