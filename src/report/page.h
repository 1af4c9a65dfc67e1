/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file page.h  The text of a report around its tables: headings, labelled notes, sentences. How wide a page is, and
 * how it is dressed on a terminal, is known here alone.
 */
#ifndef REPORT_PAGE_H
#define REPORT_PAGE_H

#include "report/number.h"
#include "report/output.h"

typedef struct page {
    output *out;
    int label;        /**< characters that the labels of notes take */
    int width;        /**< characters in a line: those of a terminal, else 80; output.width if set */
    bool fitted;      /**< a terminal's: nothing is wider */
    const char *unit; /**< of lengths, for number_in(); null where nothing says it */
    /** A length as it was asked for, "10 cm", where it is one of those; null: with the unit above. */
    number_text (*as_given)(const void *lengths, double value, int digits);
    const void *lengths;
    const char *strong, *soft, *plain; /**< bold and dim on a terminal; "" elsewhere, see output.colour */
    const char *good, *bad;            /**< of verdicts: green, and bold red */
} page;

page page_start(output *out, int label);

/* All of these break lines between words where the page ends. */

/** A sentence from the margin on. */
void page_text(page *p, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** Whether a line that ends in a newline is no wider than the page. */
bool page_fits(const page *p, const char *line, size_t length);

/** A heading on a line of its own. */
void page_title(page *p, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** A command to be typed, indented; where it is broken, it goes on behind a backslash. */
void page_command(page *p, const char *command);

/** A sentence, indented. */
void page_line(page *p, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** "  label     words", the words below each other, and below a label that is too long; nothing without words. */
void page_note(page *p, const char *label, const char *format, ...) __attribute__((format(printf, 3, 4)));
void page_wrapped(page *p, const char *label, const char *text);

#endif
