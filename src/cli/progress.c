/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

#include "report/terminal.h"

enum { BAR_WIDTH = 30, BAR_LEAST = 80 /* columns of a terminal that shows it */ };
static const double first_after = 0.5; /* seconds; shorter work shows nothing */
static const double redraw_every = 0.1;

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

progress progress_start(const char *what, uint64_t total, bool quiet) {
    progress p = {.what = what, .total = total, .next = UINT64_MAX, .stride = total / 1000 + 1};
    if (!quiet && total > 1 && isatty(STDERR_FILENO)) {
        p.next = p.stride;
        p.start = now();
        p.shown = p.start + first_after - redraw_every;
    }
    return p;
}

static void print_rate(double rate) {
    static const char *const units[] = {" ", " k", " M", " G"};
    size_t unit = 0;
    for (; rate >= 1000.0 && unit < 3; unit++)
        rate /= 1000.0;
    fprintf(stderr, "%.3g%s", rate, units[unit]);
}

void progress_draw(progress *p, uint64_t done) {
    p->next = done + p->stride;
    double t = now();
    if (t < p->shown + redraw_every)
        return;
    p->shown = t;
    p->drawn = true;
    double share = (double)done / (double)p->total;
    double rate = (double)done / (t - p->start);
    double left = (double)(p->total - done) / rate;
    if (terminal_columns(STDERR_FILENO) < BAR_LEAST) {
        fprintf(stderr, "\r%3.0f %%, %.0f s left \033[K", 100.0 * share, left);
        return;
    }
    char bar[BAR_WIDTH + 1];
    for (int i = 0; i < BAR_WIDTH; i++)
        bar[i] = i < (int)(share * BAR_WIDTH) ? '#' : '.';
    bar[BAR_WIDTH] = '\0';
    fprintf(stderr, "\r[%s] %3.0f %%  ", bar, 100.0 * share);
    print_rate(rate);
    fprintf(stderr, "%s/s, %.0f s left \033[K", p->what, left);
}

void progress_end(progress *p) {
    if (p->drawn)
        fputs("\r\033[K", stderr);
    p->drawn = false;
}
