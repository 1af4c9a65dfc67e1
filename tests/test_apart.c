/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Work in a process of its own: what it wrote comes back; what hangs, spins or crashes is ended and told apart. */
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "opened/apart.h"
#include "support.h"

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

static bool gives_up(void *of, FILE *out) {
    (void)of;
    (void)out;
    return false;
}

static apart_end run(bool (*work)(void *, FILE *), apart_limits limits, char text[32]) {
    FILE *made = NULL;
    const apart_end end = apart_run(work, "a word", limits, &made);
    assert_non_null(made);
    text[fread(text, 1, 31, made)] = '\0';
    apart_close(made);
    return end;
}

static void comes_back(void **state) {
    char text[32];
    (void)state;
    assert_int_equal(run(writes, (apart_limits){0}, text), APART_DONE);
    assert_string_equal(text, "a word");
    assert_int_equal(run(writes, (apart_limits){.processor = 5, .wall = 5}, text), APART_DONE);
    assert_string_equal(text, "a word");
}

static void is_ended(void **state) {
    char text[32];
    struct timespec from, to;
    (void)state;
    clock_gettime(CLOCK_MONOTONIC, &from);
    assert_int_equal(run(sleeps, (apart_limits){.wall = 1}, text), APART_ENDLESS);
    assert_int_equal(run(sleeps_on, (apart_limits){.wall = 1}, text), APART_ENDLESS);
    clock_gettime(CLOCK_MONOTONIC, &to);
    assert_in_range(to.tv_sec - from.tv_sec, 1, 20);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1); /* none is left running */
    assert_int_equal(run(spins, (apart_limits){.processor = 1}, text), APART_ENDLESS);
}

static void is_told(void **state) {
    char text[32];
    (void)state;
    assert_int_equal(run(crashes, (apart_limits){.wall = 30}, text), APART_BROKEN);
    assert_int_equal(run(gives_up, (apart_limits){.wall = 30}, text), APART_BROKEN);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(comes_back),
        cmocka_unit_test(is_ended),
        cmocka_unit_test(is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
