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

int pager_start(void) {
    const char *asked = getenv("PAGER");
    int ends[2];
    if (!isatty(STDOUT_FILENO) || (asked != NULL && (*asked == '\0' || strcmp(asked, "cat") == 0)) || pipe(ends) != 0)
        return -1;
    pager = fork();
    if (pager == 0)
        be_pager(ends, asked != NULL ? asked : usual);
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
