/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/terminal.h"

#include "system/process.h"

int terminal_columns(int fd) {
    struct winsize size;
    return ioctl(fd, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}
