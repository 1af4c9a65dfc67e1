/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Work in a process of its own: what it wrote comes back; what hangs, spins or crashes is ended and told apart. */
#include <signal.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "support.h"
#include "system/sandbox.h"

static bool writes(void *of, FILE *out) {
    return fputs(of, out) >= 0;
}

static bool sleeps(void *of, FILE *out) {
    fputs(of, out);
    while (of != NULL)
        pause();
    return true;
}

/* Nothing that it can catch ends it, as in a driver. */
static bool sleeps_on(void *of, FILE *out) {
    signal(SIGTERM, SIG_IGN);
    signal(SIGINT, SIG_IGN);
    return sleeps(of, out);
}

static bool spins(void *of, FILE *out) {
    volatile unsigned turns = 0;
    (void)out;
    while (of != NULL)
        turns++;
    return true;
}

static bool crashes(void *of, FILE *out) {
    (void)of;
    (void)out;
    signal(SIGABRT, SIG_DFL);
    abort();
}

/* As a driver that closes whatever it finds open, and then hangs. */
static bool closes_all(void *of, FILE *out) {
    for (int fd = 0; fd < 64; fd++)
        if (fd != fileno(out))
            close(fd);
    return sleeps(of, out);
}

/* As a driver that leaves a process of its own behind, with all that is open. */
static bool leaves_one(void *of, FILE *out) {
    if (fork() == 0) {
        sleep(20);
        _exit(0);
    }
    return writes(of, out);
}

static bool prints(void *of, FILE *out) {
    const bool said = printf("%s\n", "a driver's words") > 0 && fflush(stdout) == 0;
    fprintf(stderr, "a driver's words\n");
    return said && writes(of, out);
}

static bool gives_up(void *of, FILE *out) {
    (void)of;
    (void)out;
    return false;
}

static sandbox_end run(bool (*work)(void *, FILE *), sandbox_limits limits, char text[32]) {
    FILE *made = NULL;
    const sandbox_end end = sandbox_run(work, "a word", limits, &made);
    assert_non_null(made);
    text[fread(text, 1, 31, made)] = '\0';
    sandbox_close(made);
    return end;
}

TEST(comes_back) {
    char text[32];
    assert_int_equal(run(writes, (sandbox_limits){0}, text), SANDBOX_DONE);
    assert_string_equal(text, "a word");
    assert_int_equal(run(writes, (sandbox_limits){.processor = 5, .wall = 5}, text), SANDBOX_DONE);
    assert_string_equal(text, "a word");
}

TEST(is_ended) {
    char text[32];
    struct timespec from, to;
    clock_gettime(CLOCK_MONOTONIC, &from);
    assert_int_equal(run(sleeps, (sandbox_limits){.wall = 1}, text), SANDBOX_ENDLESS);
    assert_int_equal(run(sleeps_on, (sandbox_limits){.wall = 1}, text), SANDBOX_ENDLESS);
    clock_gettime(CLOCK_MONOTONIC, &to);
    assert_in_range(to.tv_sec - from.tv_sec, 1, 20);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1); /* none is left running */
    assert_int_equal(run(spins, (sandbox_limits){.processor = 1}, text), SANDBOX_ENDLESS);
}

TEST(cannot_hide) {
    char text[32];
    assert_int_equal(run(closes_all, (sandbox_limits){.wall = 1}, text), SANDBOX_ENDLESS);
    const time_t from = time(NULL);
    assert_int_equal(run(leaves_one, (sandbox_limits){.wall = 15}, text), SANDBOX_DONE);
    assert_string_equal(text, "a word");
    assert_true(time(NULL) - from < 10);
}

/* Where SIGCHLD is ignored the kernel would keep no status. */
TEST(signals_ignored) {
    char text[32];
    signal(SIGCHLD, SIG_IGN);
    assert_int_equal(run(crashes, (sandbox_limits){.wall = 30}, text), SANDBOX_BROKEN);
}

TEST(says_nothing) {
    char text[32];
    FILE *said = tmpfile();
    assert_non_null(said);
    fflush(NULL);
    const int streams[2] = {dup(STDOUT_FILENO), dup(STDERR_FILENO)};
    dup2(fileno(said), STDOUT_FILENO);
    dup2(fileno(said), STDERR_FILENO);
    const sandbox_end end = run(prints, (sandbox_limits){.wall = 30}, text);
    dup2(streams[0], STDOUT_FILENO);
    dup2(streams[1], STDERR_FILENO);
    close(streams[0]);
    close(streams[1]);
    assert_int_equal(end, SANDBOX_DONE);
    assert_int_equal(lseek(fileno(said), 0, SEEK_END), 0);
    fclose(said);
}

/* The parent is killed: the child ends by itself, soon after its limit. */
TEST(outlives_nobody) {
    int ends[2];
    char byte;
    assert_int_equal(pipe(ends), 0);
    const pid_t parent = fork();
    if (parent == 0) {
        FILE *made;
        close(ends[0]);
        sandbox_run(sleeps, "a word", (sandbox_limits){.wall = 2}, &made);
        _exit(0);
    }
    close(ends[1]);
    sleep(1);
    kill(parent, SIGKILL);
    waitpid(parent, NULL, 0);
    alarm(60);
    assert_int_equal(read(ends[0], &byte, 1), 0); /* which both held open */
    alarm(0);
    close(ends[0]);
}

TEST(is_told) {
    char text[32];
    assert_int_equal(run(crashes, (sandbox_limits){.wall = 30}, text), SANDBOX_BROKEN);
    assert_int_equal(run(gives_up, (sandbox_limits){.wall = 30}, text), SANDBOX_BROKEN);
}
