/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/stop.h"

#include "report/message.h"
#include <stdio.h>

#include "system/process.h"

static volatile sig_atomic_t interrupted;

static void interrupt(int number) {
    interrupted = number;
}

void stop_watch(void) {
    struct sigaction action = {.sa_handler = interrupt};
    struct sigaction before;
    sigemptyset(&action.sa_mask);
    if (sigaction(SIGINT, NULL, &before) == 0 && before.sa_handler != SIG_IGN)
        sigaction(SIGINT, &action, NULL);
}

bool stop_asked(void) {
    return interrupted != 0;
}

void stop_end(output *out) {
    if (!interrupted)
        return;
    output_abandon(out);
    message("depthprec: interrupted: nothing was written");
    signal(SIGINT, SIG_DFL); /* the shell should see what ended us */
    raise(SIGINT);
}
