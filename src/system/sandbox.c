/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "system/sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { GRACE = 5 /* seconds between the limit of processor time and the end without mercy */ };

/* Neither what a driver prints may be among what we print, nor may it outlive a parent that was killed. */
_Noreturn static void be_child(bool (*work)(void *, FILE *), void *of, sandbox_limits limits, FILE *out) {
    const struct rlimit most = {limits.processor, limits.processor + GRACE};
    if (limits.processor > 0)
        setrlimit(RLIMIT_CPU, &most);
    if (limits.wall > 0)
        alarm(limits.wall + GRACE);
    const int nowhere = open("/dev/null", O_WRONLY);
    const bool quiet = nowhere >= 0 && dup2(nowhere, STDOUT_FILENO) >= 0 && dup2(nowhere, STDERR_FILENO) >= 0;
    const bool done = quiet && work(of, out) && fflush(out) == 0;
    _exit(done ? 0 : 1);
}

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/*
 * Whether the child ended within so many seconds; 0: however long. It is asked for again and again: a pipe that its end
 * closes could be closed before by a driver, or be held open by what a driver starts.
 */
static bool ended(pid_t child, unsigned seconds, int *status) {
    const double until = now() + (double)seconds;
    for (;;) {
        const pid_t found = waitpid(child, status, seconds > 0 ? WNOHANG : 0);
        if (found == child || (found < 0 && errno != EINTR))
            return true;
        if (found == 0 && now() >= until)
            return false;
        if (found == 0)
            nanosleep(&(struct timespec){0, 1000000}, NULL);
    }
}

static sandbox_end wait_for(pid_t child, unsigned seconds) {
    int status = 0;
    const bool in_time = ended(child, seconds, &status);
    if (!in_time) {
        kill(child, SIGKILL);
        ended(child, 1, &status); /* no longer: a driver may hang in the kernel, which cannot end it */
    }
    if (!in_time || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
        return SANDBOX_ENDLESS;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? SANDBOX_DONE : SANDBOX_BROKEN;
}

sandbox_end sandbox_run(bool (*work)(void *of, FILE *out), void *of, sandbox_limits limits, FILE **made) {
    *made = tmpfile();
    if (*made == NULL)
        return SANDBOX_NO_FILE;
    fflush(NULL);
    signal(SIGCHLD, SIG_DFL); /* where a parent had it ignored, nobody could ask how the child ended */
    const pid_t child = fork();
    if (child == 0)
        be_child(work, of, limits, *made);
    const int error = errno;
    const sandbox_end end = child < 0 ? SANDBOX_NO_PROCESS : wait_for(child, limits.wall);
    rewind(*made);
    errno = error;
    return end;
}

void sandbox_close(FILE *made) {
    if (made != NULL)
        fclose(made);
}
