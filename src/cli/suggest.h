/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file suggest.h  The nearest known name to one that is not known, for "did you mean 'reversed'?".
 *
 *     suggestion s = suggest_start("reverzed");
 *     for each name: suggest_offer(&s, name);
 *     printf("...%s\n", suggest_text(&s, "", buffer));
 */
#ifndef CLI_SUGGEST_H
#define CLI_SUGGEST_H

#include <stddef.h>

enum { SUGGEST_NAME_MAX = 32, SUGGEST_TEXT_SIZE = 96 };

typedef struct suggestion {
    const char *given;
    int distance; /**< edits to the nearest name so far */
    char nearest[SUGGEST_NAME_MAX + 1];
} suggestion;

suggestion suggest_start(const char *given);

/** Offers one candidate name, or several separated by spaces. Names too long to be a slip are passed over. */
void suggest_offer(suggestion *s, const char *names);

/** "; did you mean 'PREFIXname'?", or "" when nothing is near. @return out */
const char *suggest_text(const suggestion *s, const char *prefix, char out[SUGGEST_TEXT_SIZE]);

#endif
