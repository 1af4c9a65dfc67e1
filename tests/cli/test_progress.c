/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The line of progress, as a terminal gets it: of work that began some seconds ago, how much is done and is left. */

#define _XOPEN_SOURCE 700 /* terminals */
#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli/progress.h"
#include "support.h"

static int host = -1, terminal = -1, own = -1;

static bool open_terminal(void) {
    host = posix_openpt(O_RDWR | O_NOCTTY);
    if (host < 0 || grantpt(host) != 0 || unlockpt(host) != 0)
        return false;
    terminal = open(ptsname(host), O_RDWR | O_NOCTTY);
    return terminal >= 0 && fcntl(host, F_SETFL, O_NONBLOCK) == 0;
}

/* What stands on it since it was last read. */
static const char *shown(void) {
    static char text[4096];
    const ssize_t size = read(host, text, sizeof text - 1);
    text[size > 0 ? size : 0] = '\0';
    return text;
}

static void in_terminal(int columns) {
    const struct winsize size = {.ws_row = 24, .ws_col = (unsigned short)columns};
    assert_int_equal(ioctl(terminal, TIOCSWINSZ, &size), 0);
    fflush(stderr);
    own = dup(STDERR_FILENO);
    assert_true(own >= 0 && dup2(terminal, STDERR_FILENO) >= 0);
}

static void back(void) {
    fflush(stderr);
    dup2(own, STDERR_FILENO);
    close(own);
}

static const char *drawn(int columns, uint64_t total, double seconds, uint64_t done, bool quiet) {
    in_terminal(columns);
    progress p = progress_start(" codes", total, quiet);
    p.start -= seconds;
    p.shown -= seconds;
    progress_step(&p, done);
    back();
    return shown();
}

TEST(what_is_left) {
    if (!open_terminal())
        skip();
    static const struct {
        int columns;
        uint64_t total;
        double seconds;
        uint64_t done;
        const char *want;
    } cases[] = {{80, 400, 10, 100, "\r[#######.......................]  25 %  10  codes/s, 30 s left \033[K"},
                 {80, 4000000, 10, 3000000, "\r[######################........]  75 %  300 k codes/s, 3 s left \033[K"},
                 {80, 1000000000000, 100, 500000000000,
                  "\r[###############...............]  50 %  5 G codes/s, 100 s left \033[K"},
                 {79, 400, 10, 300, "\r 75 %, 3 s left \033[K"},
                 {40, 1000, 60, 100, "\r 10 %, 540 s left \033[K"},
                 {80, 400, 0.3, 100, ""}, /* work that began just now */
                 {80, 1, 10, 1, ""}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *got = drawn(cases[i].columns, cases[i].total, cases[i].seconds, cases[i].done, false);
        assert_string_equal(got, cases[i].want);
        assert_string_equal(drawn(cases[i].columns, cases[i].total, cases[i].seconds, cases[i].done, true), "");
    }
}

/* Nobody asks for it where stderr is no terminal; and it goes when the work ends, if it was there. */
TEST(where_it_is_not) {
    if (host < 0 && !open_terminal())
        skip();
    const int nowhere = open("/dev/null", O_WRONLY);
    own = dup(STDERR_FILENO);
    dup2(nowhere, STDERR_FILENO);
    progress p = progress_start("", 400, false);
    back();
    assert_true(p.next == UINT64_MAX);
    in_terminal(80);
    p = progress_start("", 400, false);
    progress_end(&p);
    back();
    assert_string_equal(shown(), "");
    in_terminal(80);
    p.shown = 0;
    progress_draw(&p, 200);
    progress_end(&p);
    progress_end(&p);
    back();
    const char *text = shown(), *end = strstr(text, "left \033[K");
    assert_true(end != NULL && strcmp(end + strlen("left \033[K"), "\r\033[K") == 0);
    close(nowhere);
}
