/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * glslangValidator, in a process that is ended if it is not: from one file without a name into another, so that nothing
 * is left behind, whatever happens.
 */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "probe/compute.h"
#include "system/posix.h"
#include "system/sandbox.h"

enum {
    SECONDS = 20,
    NAME_SIZE = 32,
    LINE_SIZE = 480,
    MAGIC = 0x07230203,
    ENTRY_POINT = 15,
    MODE = 16,
    LOCAL_SIZE = 17
};

typedef struct compiling {
    FILE *text, *code;
    bool hlsl;
} compiling;

static bool fail(char error[COMPUTE_ERROR_SIZE], const char *text, const char *why) {
    snprintf(error, COMPUTE_ERROR_SIZE, "%s%s", text, why);
    return false;
}

/* Comes back only where there is no such program: then nothing is written. */
static bool work(void *of, FILE *out) {
    const compiling *c = of;
    char made[NAME_SIZE];
    snprintf(made, sizeof made, "/dev/fd/%d", fileno(c->code));
    if (dup2(fileno(c->text), STDIN_FILENO) >= 0 && dup2(fileno(out), STDOUT_FILENO) >= 0)
        execlp("glslangValidator", "glslangValidator", "--stdin", "-V", "-S", "comp", "-e", "main", "-o", made,
               c->hlsl ? "-D" : NULL, (char *)NULL);
    return false;
}

/* "ERROR: stdin:12: 'x' : undeclared identifier" */
static bool first_error(FILE *said, unsigned *line, char error[COMPUTE_ERROR_SIZE]) {
    static const char mark[] = "ERROR: ", where[] = "stdin:";
    char text[LINE_SIZE];
    bool any = false;
    while (fgets(text, sizeof text, said) != NULL) {
        const char *at = strncmp(text, mark, sizeof mark - 1) == 0 ? text + sizeof mark - 1 : NULL;
        any = true;
        if (at == NULL)
            continue;
        for (size_t end = strlen(text); end > 0 && strchr(" \r\n", text[end - 1]) != NULL;)
            text[--end] = '\0';
        if (strncmp(at, where, sizeof where - 1) == 0) {
            char *end;
            *line = (unsigned)strtoul(at + sizeof where - 1, &end, 10);
            at = end + strspn(end, ": ");
        }
        return fail(error, at, "");
    }
    return fail(error,
                any ? "glslangValidator refuses it, and does not say why"
                    : "needs glslangValidator, which is not there: Debian's package glslang-tools has it",
                "");
}

static bool read_code(compute_run *run, FILE *in, char error[COMPUTE_ERROR_SIZE]) {
    const long size = fseek(in, 0, SEEK_END) == 0 ? ftell(in) : 0;
    rewind(in);
    run->code = size > 0 ? malloc((size_t)size) : NULL;
    run->size = (size_t)size;
    if (run->code == NULL || fread(run->code, 1, run->size, in) != run->size)
        return fail(error, "the shader that glslangValidator made cannot be read", "");
    return compute_look(run, error);
}

bool compute_compile(const char *text, bool hlsl, compute_run *run, unsigned *line, char error[COMPUTE_ERROR_SIZE]) {
    compiling c = {tmpfile(), tmpfile(), hlsl};
    FILE *said = NULL;
    bool good = c.text != NULL && c.code != NULL && fputs(text, c.text) >= 0 && fflush(c.text) == 0;
    *line = 0;
    if (!good)
        fail(error, "needs a file for a while, which cannot be made: ", strerror(errno));
    if (good) {
        rewind(c.text);
        const sandbox_end end = sandbox_run(work, &c, (sandbox_limits){SECONDS, 6 * SECONDS}, &said);
        good = end == SANDBOX_DONE && read_code(run, c.code, error);
        if (end == SANDBOX_BROKEN)
            first_error(said, line, error);
        else if (end != SANDBOX_DONE)
            fail(error, "glslangValidator does not come to an end, or cannot be started", "");
    }
    sandbox_close(said);
    sandbox_close(c.text);
    sandbox_close(c.code);
    return good;
}

bool compute_look(compute_run *run, char error[COMPUTE_ERROR_SIZE]) {
    const size_t words = run->size / sizeof *run->code;
    if (words < 5 || run->size % sizeof *run->code != 0 || run->code[0] != MAGIC)
        return fail(error, "is no SPIR-V of this machine's order of bytes", "");
    run->entry[0] = '\0';
    run->group = 1;
    for (size_t i = 5, length; i < words; i += length) {
        const uint32_t *w = &run->code[i], op = w[0] & 0xFFFF;
        length = w[0] >> 16;
        if (length == 0 || length > words - i)
            return fail(error, "is damaged SPIR-V", "");
        if (op == ENTRY_POINT && length > 3 && w[1] == 5 /* GLCompute */ && run->entry[0] == '\0')
            snprintf(run->entry, sizeof run->entry, "%.*s", (int)(4 * (length - 3)), (const char *)&w[3]);
        if (op == MODE && length > 3 && w[2] == LOCAL_SIZE && w[3] > 0)
            run->group = w[3];
    }
    return run->entry[0] != '\0' ||
           fail(error, "has no compute entry point: depths stand at binding 0, values at binding 1", "");
}
