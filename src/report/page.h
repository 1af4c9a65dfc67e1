/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file page.h  The text of a report around its tables: headings, labelled notes, sentences. How wide a page is, and
 * how it is dressed on a terminal, is known here alone.
 */
#ifndef REPORT_PAGE_H
#define REPORT_PAGE_H

#include "report/output.h"

typedef struct page {
    output *out;
    int label;                         /**< characters that the labels of notes take */
    const char *strong, *soft, *plain; /**< bold and dim on a terminal; "" elsewhere, and where NO_COLOR is set */
} page;

page page_start(output *out, int label);

/** A heading on a line of its own. */
void page_title(page *p, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** "  label     words"; without a label, a sentence by itself. */
void page_note(page *p, const char *label, const char *format, ...) __attribute__((format(printf, 3, 4)));
void page_line(page *p, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** A note broken between words where the page ends, its lines below each other, and below a label that is too long;
 *  nothing where the text is empty. */
void page_wrapped(page *p, const char *label, const char *text);

#endif
