/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file pager.h  A program that shows text page by page on the terminal of stdout: that of PAGER, else less, which ends
 * by itself where all fits on the screen.
 */
#ifndef SYSTEM_PAGER_H
#define SYSTEM_PAGER_H

/** Starts it. From then on Ctrl-C is the pager's. @return what is to be written to; -1: stdout is no terminal, PAGER is
 * empty or cat, TERM is dumb or not set and PAGER is not, or there is none */
int pager_start(void);

/** Waits until whoever reads has seen enough; what was written to is closed before. */
void pager_wait(void);

#endif
