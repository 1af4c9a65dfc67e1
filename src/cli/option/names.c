/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/option/names.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

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

/* The names nearest to one that is not known. */
enum { NEAREST = 3 };
typedef struct nearest {
    const char *given;
    size_t count, most;
    struct {
        int distance;
        char name[LENGTH_MAX + 1];
    } best[NEAREST];
} nearest;

/* Edits to a name; one where that begins so, the most where it is longer than a name. LENGTH_MAX: another word. */
static int distance_to(const char *given, size_t given_length, const char *name, size_t length) {
    const int limit = 1 + (int)given_length / 4; /* one letter in four may be wrong, and one more */
    const size_t common = given_length < length ? given_length : length;
    const bool begins = common > 2 && strncasecmp(given, name, common) == 0;
    if (length <= 1 || length > LENGTH_MAX)
        return LENGTH_MAX;
    if (begins && given_length < length)
        return 1;
    const int distance = edits(given, given_length, name, length);
    return distance <= limit && distance < (int)length ? distance : begins && given[length] == '-' ? limit : LENGTH_MAX;
}

/* Keeps a name where it is among the nearest; of those as near the first, and of two things of one name one. */
static void keep(nearest *s, int distance, const char *name, size_t length) {
    size_t at = s->count;
    for (size_t i = 0; i < s->count; i++)
        if (s->best[i].distance == distance && strncasecmp(s->best[i].name, name, length) == 0 &&
            s->best[i].name[length] == '\0')
            return;
    while (at > 0 && s->best[at - 1].distance > distance)
        at--;
    if (at == s->most || distance >= LENGTH_MAX)
        return;
    s->count += s->count < s->most;
    memmove(&s->best[at + 1], &s->best[at], (s->count - at - 1) * sizeof s->best[0]);
    s->best[at].distance = distance;
    memcpy(s->best[at].name, name, length);
    s->best[at].name[length] = '\0';
}

/* Offers the nearest name or other spelling of one thing. */
static void offer(nearest *s, const list_item *item) {
    const char *const lists[] = {item->name, item->aliases};
    int least = LENGTH_MAX;
    const char *best = NULL;
    for (size_t i = 0; i < 2; i++)
        for (const char *name = lists[i]; name != NULL && *name != '\0'; name += strspn(name, " ")) {
            const size_t length = strcspn(name, " ");
            const int distance = distance_to(s->given, strlen(s->given), name, length);
            best = distance < least ? name : best;
            least = distance < least ? distance : least;
            name += length;
        }
    if (best != NULL)
        keep(s, least, best, strcspn(best, " "));
}

const char *names_nearest(const name_list *n, const char *prefix, const char *given, size_t most,
                          char out[NAMES_SIZE]) {
    nearest s = {.given = given, .most = most < NEAREST ? most : NEAREST};
    list_item item;
    out[0] = '\0';
    for (size_t i = 0; *given != '\0' && strlen(given) <= LENGTH_MAX && names_get(n, i, &item); i++)
        offer(&s, &item);
    s.count -= most == 2 && s.count == 2 && s.best[1].distance > s.best[0].distance + 1; /* the first is meant */
    for (size_t i = 0; i < s.count; i++)
        append(out, NAMES_SIZE, "%s'%s%s'",
               i == 0            ? "; did you mean "
               : i + 1 < s.count ? ", "
                                 : " or ",
               prefix, s.best[i].name);
    append(out, NAMES_SIZE, "%s", s.count > 0 ? "?" : "");
    return out;
}

const char *names_refuse(const name_list *n, const char *given, char out[NAMES_SIZE]) {
    char list[NAMES_SIZE], near[NAMES_SIZE];
    out[0] = '\0';
    append(out, NAMES_SIZE, "must be %s%s, got '%.64s'%s", names_join(n, ", ", " or ", list),
           n->more != NULL ? n->more : "", given, names_nearest(n, "", given, 2, near));
    return out;
}
