/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/suggest.h"

#include <stdio.h>
#include <string.h>

static char lower(char c) {
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static int min(int a, int b) {
    return a < b ? a : b;
}

/*
 * Edits between two names: insertions, deletions, changes and swaps of neighbours (optimal string alignment), three
 * rows of the table at a time. Letter case costs nothing.
 */
static int edits(const char *a, size_t a_length, const char *b, size_t b_length) {
    int rows[3][SUGGEST_NAME_MAX + 1];
    int *before = rows[0];
    int *above = rows[1];
    int *here = rows[2];
    for (size_t j = 0; j <= b_length; j++)
        above[j] = (int)j;
    memcpy(before, above, sizeof rows[0]);
    for (size_t i = 1; i <= a_length; i++) {
        here[0] = (int)i;
        for (size_t j = 1; j <= b_length; j++) {
            int change = lower(a[i - 1]) != lower(b[j - 1]);
            here[j] = min(min(above[j], here[j - 1]) + 1, above[j - 1] + change);
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
                here[j] = min(here[j], before[j - 2] + change);
        }
        int *oldest = before;
        before = above;
        above = here;
        here = oldest;
    }
    return above[b_length];
}

suggestion suggest_start(const char *given) {
    return (suggestion){.given = given, .distance = SUGGEST_NAME_MAX};
}

void suggest_offer(suggestion *s, const char *names) {
    size_t given_length = strlen(s->given);
    if (given_length == 0 || given_length > SUGGEST_NAME_MAX)
        return;
    /* One letter in four may be wrong, and one more: more than that is another word. */
    int limit = min(1 + (int)given_length / 4, s->distance - 1);
    while (*names != '\0') {
        size_t length = strcspn(names, " ");
        if (length > 1 && length <= SUGGEST_NAME_MAX) {
            int distance = edits(s->given, given_length, names, length);
            if (distance <= limit && distance < (int)length) {
                s->distance = distance;
                limit = distance - 1;
                memcpy(s->nearest, names, length);
                s->nearest[length] = '\0';
            }
        }
        names += length;
        names += strspn(names, " ");
    }
}

const char *suggest_text(const suggestion *s, const char *prefix, char out[SUGGEST_TEXT_SIZE]) {
    out[0] = '\0';
    if (s->nearest[0] != '\0')
        snprintf(out, SUGGEST_TEXT_SIZE, "; did you mean '%s%s'?", prefix, s->nearest);
    return out;
}
