/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file message.h  Lines on stderr. */
#ifndef REPORT_MESSAGE_H
#define REPORT_MESSAGE_H

/** One line, which on a terminal is broken between words where that ends; no newline in it. */
void message(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
