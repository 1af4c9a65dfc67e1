/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file check_report.h  Verdicts as text, JSON, JUnit XML or CSV. */
#ifndef SOLVE_CMD_CHECK_CHECK_REPORT_H
#define SOLVE_CMD_CHECK_CHECK_REPORT_H

#include "solve/check.h"
#include "solve/cmd_check/request.h"

typedef struct check_file {
    need_file file;
    size_t count;
    check_verdict *verdicts;
    long failed;
} check_file;

/** Writes the report that the options ask for; `passed`: nothing failed. */
void check_report(const checks_request *o, output *out, const check_file *files, size_t count, bool passed);

/** Writes what failed on stderr, for where the report goes to a file. */
void check_say_failures(const checks_request *o, const check_file *files, size_t count);

/** Reads a requirement file. @return EXIT_FINE, EXIT_USAGE or EXIT_IO after one line on stderr that names the line */
int check_read(const char *path, need_file *file);

#endif
