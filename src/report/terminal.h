/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file terminal.h  How wide a terminal is. */
#ifndef REPORT_TERMINAL_H
#define REPORT_TERMINAL_H

/** Characters in a line of the terminal behind a file descriptor; 0 where there is none or it does not say. */
int terminal_columns(int fd);

#endif
