/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "system/pager.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* F: ends where all fits on the screen; R: colours pass; X: what was read stays there. */
static const char usual[] = "if command -v less >/dev/null; then exec less -FRX; else exec cat; fi";

static pid_t pager;

/* PAGER is a command of the shell, as it is of git and man. */
_Noreturn static void be_pager(const int ends[2], const char *command) {
    signal(SIGPIPE, SIG_DFL);
    if (dup2(ends[0], STDIN_FILENO) >= 0) {
        close(ends[0]);
        close(ends[1]);
        execl("/bin/sh", "sh", "-c", command, (char *)NULL);
    }
    _exit(127);
}

/* On a terminal that cannot move its cursor less complains and waits. */
static const char *command_of(const char *asked, const char *terminal) {
    if (asked != NULL)
        return *asked != '\0' && strcmp(asked, "cat") != 0 ? asked : NULL;
    return terminal != NULL && strcmp(terminal, "dumb") != 0 ? usual : NULL;
}

int pager_start(void) {
    const char *command = command_of(getenv("PAGER"), getenv("TERM"));
    int ends[2];
    if (!isatty(STDOUT_FILENO) || command == NULL || pipe(ends) != 0)
        return -1;
    pager = fork();
    if (pager == 0)
        be_pager(ends, command);
    close(ends[0]);
    if (pager < 0) {
        close(ends[1]);
        return -1;
    }
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    signal(SIGPIPE, SIG_IGN); /* a pager that is left is a failed write */
    signal(SIGINT, SIG_IGN);
    return ends[1];
}

void pager_wait(void) {
    while (waitpid(pager, NULL, 0) < 0 && errno == EINTR)
        continue;
}
