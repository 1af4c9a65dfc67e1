/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The command line as anybody might mangle it: arguments are the lines of the input. Whatever is accepted must give
 * set-ups, depths and a range that keep what the headers promise.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/cmd/setups.h"

enum { ARGUMENTS_MAX = 32 };

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerInitialize(int *argc, char ***argv) {
    (void)argc, (void)argv;
    /* Errors are expected, thousands of them a second; descriptor 2 itself stays open for the sanitizers. */
    stderr = fopen("/dev/null", "w");
    return stderr == NULL;
}

static void demand(int truth) {
    if (!truth)
        abort();
}

static void use(const camera_asked *c) {
    setups all;
    depths at;
    double lo;
    double hi;
    if (setups_make(c, &all) != EXIT_FINE)
        return;
    demand(all.count == c->format_count * c->mapping_count);
    if (range_resolve(c, &lo, &hi) == EXIT_FINE)
        demand(c->znear <= lo && lo < hi && hi <= c->zfar);
    if (depths_resolve(c, 9, &at) == EXIT_FINE) {
        demand(at.count >= 1 && at.count <= DEPTHS_MAX);
        size_t step = at.count / 16 + 1;
        for (size_t i = 0; i < at.count; i += step) {
            dp_sample sample;
            demand(dp_sample_at(&all.items[0], depths_get(&at, i), &sample) == DP_OK);
        }
        demand(at.kind == DEPTHS_LIST || depths_get(&at, at.count - 1) == at.hi);
    }
    char label[SETUP_LABEL_SIZE];
    demand(strlen(setup_label(&all.items[all.count - 1], true, label)) < SETUP_LABEL_SIZE - 1);
    setups_release(&all);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = malloc(size + 1);
    char *argv[ARGUMENTS_MAX + 2] = {(char[]){"depthprec"}};
    int argc = 1;
    if (text == NULL)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    for (char *line = text; line != NULL && argc < ARGUMENTS_MAX;) {
        char *end = strchr(line, '\n');
        if (end != NULL)
            *end++ = '\0';
        argv[argc++] = line;
        line = end;
    }
    argv[argc] = NULL;
    asked_line line;
    const camera_asked *c;
    if (options_parse(&line, argc, argv) == EXIT_FINE &&
        (c = option_group(&line, option_find(line.command, "near"))) != NULL)
        use(c);
    options_release(&line);
    free(text);
    return 0;
}
