/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A module in place of report/terminal.c, cli/stop.c and texture/strips.c: no terminal, no signals, streams that are
 * never closed, and one thread.
 */
#include "cli/stop.h"
#include "report/output.h"
#include "report/terminal.h"
#include "texture/strips.h"

void output_reserve_streams(void) {}

int terminal_columns(int fd) {
    (void)fd;
    return 0;
}

void stop_watch(void) {}

bool stop_asked(void) {
    return false;
}

void stop_end(output *out) {
    (void)out;
}

int strips_threads(int wanted) {
    return wanted > 0 ? wanted : 1;
}

bool strips_run(const strips *s) {
    for (size_t i = 0; i < s->count; i++) {
        const size_t slot = s->take != NULL ? i % s->slots : 0;
        s->make(s->context, i, slot, 0);
        if (s->take != NULL && !s->take(s->context, i, slot))
            return false;
    }
    return true;
}
