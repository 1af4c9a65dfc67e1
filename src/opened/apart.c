/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "opened/apart.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { GRACE = 5 /* seconds between the limit of processor time and the end without mercy */ };

_Noreturn static void be_child(bool (*work)(void *, FILE *), void *of, unsigned processor, FILE *out) {
    const struct rlimit most = {processor, processor + GRACE};
    if (processor > 0)
        setrlimit(RLIMIT_CPU, &most);
    const bool quiet = freopen("/dev/null", "w", stderr) != NULL;
    const bool done = quiet && work(of, out) && fflush(out) == 0;
    _exit(done ? 0 : 1);
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Whether the child closed its end of the pipe, as its end does, before so many seconds are over; 0: however long. */
static bool ended(int pipe, unsigned seconds) {
    const double until = now() + (double)seconds;
    for (;;) {
        struct pollfd wait = {.fd = pipe, .events = POLLIN};
        const double left = until - now();
        const int timeout = seconds == 0 ? -1 : left > 0.0 ? (int)(left * 1e3) + 1 : 0;
        const int found = poll(&wait, 1, timeout);
        if (found != 0 && !(found < 0 && errno == EINTR))
            return true;
        if (found == 0)
            return false;
    }
}

/* Not waited for where the kernel cannot end it: a driver may hang in there. */
static int reap(pid_t child, bool killed) {
    int status = 0;
    for (int i = 0; i < 100; i++) {
        const pid_t found = waitpid(child, &status, killed ? WNOHANG : 0);
        if (found == child)
            break;
        if (found == 0)
            nanosleep(&(struct timespec){0, 10000000}, NULL);
    }
    return status;
}

static apart_end wait_for(pid_t child, int pipe, unsigned seconds) {
    const bool in_time = ended(pipe, seconds);
    if (!in_time)
        kill(child, SIGKILL);
    const int status = reap(child, !in_time);
    if (!in_time || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
        return APART_ENDLESS;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? APART_DONE : APART_BROKEN;
}

apart_end apart_run(bool (*work)(void *of, FILE *out), void *of, apart_limits limits, FILE **made) {
    int ends[2];
    *made = tmpfile();
    if (*made == NULL)
        return APART_NO_FILE;
    if (pipe(ends) != 0)
        return APART_NO_PROCESS;
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        be_child(work, of, limits.processor, *made);
    }
    const int error = errno;
    close(ends[1]);
    const apart_end end = child < 0 ? APART_NO_PROCESS : wait_for(child, ends[0], limits.wall);
    close(ends[0]);
    rewind(*made);
    errno = error;
    return end;
}

void apart_close(FILE *made) {
    if (made != NULL)
        fclose(made);
}
