/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/option/names.h"

#include <ctype.h>
#include <string.h>

#include "core/append.h"

enum { LENGTH_MAX = 32 }; /* longer names are no slips */

bool names_get(const name_list *n, size_t index, list_item *item) {
    size_t words = 0;
    for (; n->words != NULL && n->words[words] != NULL; words++)
        if (words == index) {
            *item = (list_item){.name = n->words[index]};
            return true;
        }
    if (n->get != NULL)
        return n->get(index - words, item);
    const named_row *row = n->rows != NULL ? named_at(n->rows, index - words) : NULL;
    if (row == NULL)
        return false;
    *item =
        (list_item){.name = row->name, .aliases = row->aliases, .note = row->note, .source = row->source, .row = row};
    if (n->tell != NULL)
        n->tell(row, item);
    return true;
}

bool names_find(const name_list *n, const char *text, size_t *index, list_item *item) {
    list_item tried;
    for (size_t i = 0; names_get(n, i, &tried); i++)
        if (named_is(tried.name, tried.aliases, text)) {
            if (index != NULL)
                *index = i;
            if (item != NULL)
                *item = tried;
            return true;
        }
    return false;
}

const char *names_join(const name_list *n, const char *between, const char *last, char out[NAMES_SIZE]) {
    list_item item, next;
    out[0] = '\0';
    bool more = names_get(n, 0, &next);
    for (size_t i = 0; more; i++) {
        item = next;
        more = names_get(n, i + 1, &next);
        append(out, NAMES_SIZE, "%s%s", i == 0 ? "" : more ? between : last, item.name);
    }
    return out;
}

/* ---- The nearest ------------------------------------------------------------------------------------------------- */

static int min(int a, int b) {
    return a < b ? a : b;
}

/*
 * Edits between two names: insertions, deletions, changes and swaps of neighbours (optimal string alignment), three
 * rows of the table at a time. Letter case costs nothing.
 */
static int edits(const char *a, size_t a_length, const char *b, size_t b_length) {
    int rows[3][LENGTH_MAX + 1];
    int *before = rows[0];
    int *above = rows[1];
    int *here = rows[2];
    for (size_t j = 0; j <= b_length; j++)
        above[j] = (int)j;
    memcpy(before, above, sizeof rows[0]);
    for (size_t i = 1; i <= a_length; i++) {
        here[0] = (int)i;
        for (size_t j = 1; j <= b_length; j++) {
            int change = tolower(a[i - 1]) != tolower(b[j - 1]);
            here[j] = min(min(above[j], here[j - 1]) + 1, above[j - 1] + change);
            if (i > 1 && j > 1 && tolower(a[i - 1]) == tolower(b[j - 2]) && tolower(a[i - 2]) == tolower(b[j - 1]))
                here[j] = min(here[j], before[j - 2] + change);
        }
        int *oldest = before;
        before = above;
        above = here;
        here = oldest;
    }
    return above[b_length];
}

/* The name nearest to one that is not known. */
typedef struct nearest {
    const char *given;
    int distance; /* edits to it */
    char name[LENGTH_MAX + 1];
} nearest;

/* Offers names that are separated by spaces. */
static void offer(nearest *s, const char *list) {
    const size_t given_length = strlen(s->given);
    /* One letter in four may be wrong, and one more: more than that is another word. */
    int limit = min(1 + (int)given_length / 4, s->distance - 1);
    while (list != NULL && *list != '\0') {
        const size_t length = strcspn(list, " ");
        if (length > 1 && length <= LENGTH_MAX) {
            const int distance = edits(s->given, given_length, list, length);
            if (distance <= limit && distance < (int)length) {
                s->distance = distance;
                limit = distance - 1;
                memcpy(s->name, list, length);
                s->name[length] = '\0';
            }
        }
        list += length;
        list += strspn(list, " ");
    }
}

const char *names_nearest(const name_list *n, const char *prefix, const char *given, char out[NAMES_SIZE]) {
    nearest s = {.given = given, .distance = LENGTH_MAX};
    list_item item;
    out[0] = '\0';
    for (size_t i = 0; *given != '\0' && strlen(given) <= LENGTH_MAX && names_get(n, i, &item); i++) {
        offer(&s, item.name);
        offer(&s, item.aliases);
    }
    if (s.name[0] != '\0')
        append(out, NAMES_SIZE, "; did you mean '%s%s'?", prefix, s.name);
    return out;
}

const char *names_refuse(const name_list *n, const char *given, char out[NAMES_SIZE]) {
    char list[NAMES_SIZE], near[NAMES_SIZE];
    out[0] = '\0';
    append(out, NAMES_SIZE, "must be %s%s, got '%.64s'%s", names_join(n, ", ", " or ", list),
           n->more != NULL ? n->more : "", given, names_nearest(n, "", given, near));
    return out;
}
