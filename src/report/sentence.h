/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file sentence.h  Sentences as data: rows over the same item as the columns of JSON, whose values they name.
 *
 *     static const sentence worst_words[] = {
 *         NOTE("worst error", "unbounded, code {error_code}", ENDLESS),
 *         ELSE("{error} at z = {error_z:9}, code {error_code}", 0),
 *         LINE("blind from {blind_from} on", 0), SENTENCE_END};
 *     page_say(p, worst_words, worst_columns, &worst, isinf(worst.error) ? ENDLESS : 0);
 *
 * A name in braces is the key of a column, within a keyed part "part.key"; its text is that of a table: digits and
 * direction of rounding are the column's, ":9" asks for other digits, ":0" for all. Behind a length stands the page's
 * unit. A sentence is said where its conditions hold and all its values exist.
 */
#ifndef REPORT_SENTENCE_H
#define REPORT_SENTENCE_H

#include "report/page.h"
#include "report/report.h"

typedef enum sentence_form {
    SENTENCE_NONE = 0,
    SENTENCE_NOTE, /**< page_note() */
    SENTENCE_LINE, /**< page_line() */
    SENTENCE_TEXT, /**< page_text() */
    SENTENCE_ELSE  /**< in place of the one above, where that is not said */
} sentence_form;

typedef struct sentence {
    sentence_form form;
    const char *label; /**< of a note; names in braces are filled in, too */
    const char *words;
    unsigned when; /**< conditions, bits that must all be set */
} sentence;

#define NOTE(its_label, its_words, its_when)                                                                           \
    { SENTENCE_NOTE, its_label, its_words, its_when }
#define LINE(its_words, its_when)                                                                                      \
    { SENTENCE_LINE, NULL, its_words, its_when }
#define PROSE(its_words, its_when)                                                                                     \
    { SENTENCE_TEXT, NULL, its_words, its_when }
#define ELSE(its_words, its_when)                                                                                      \
    { SENTENCE_ELSE, NULL, its_words, its_when }
#define SENTENCE_END                                                                                                   \
    { .form = SENTENCE_NONE }

/* Columns that sentences alone name, by the member. */
#define WORD(type, member)                                                                                             \
    { FIELD(type, member, #member, "") }
#define LENGTH(type, member, its_digits)                                                                               \
    { FIELD(type, member, #member, "scene"), .digits = (its_digits), .given = true }
#define NUMBER(type, member) /* a number_text, which is as it is told */                                               \
    { FIELD(type, member.text, #member, "") }

/** Says them in order. A name that no column has is left in its braces. */
void page_say(page *p, const sentence *rows, const column *columns, void *item, unsigned when);

enum { SENTENCE_SIZE = 1024 };

/** The first of them that is said, without label and form; "" where none is. The page tells units, or is null.
 * @return out */
const char *sentence_first(const page *p, const sentence *rows, const column *columns, void *item, unsigned when,
                           char out[SENTENCE_SIZE]);

#endif
