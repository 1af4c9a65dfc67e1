/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether the runs of a test program could have noticed an exchange: two fields of an object that were the same in all
 * of them could be exchanged and no test would see it. */
#include "printed.h"

enum { APART_MAX = 4096, NAME_SIZE = 96 };

typedef struct pair {
    char object[NAME_SIZE], a[40], b[40]; /* "table setups[].rows[]", "z", "depth" */
    bool equal, apart;                    /* in some run */
} pair;

static pair *pairs;
static size_t pair_count;

/* "setups[3].rows[12]" is "setups[].rows[]": all rows are one kind of object. */
static void kind_of(const char *command, const char *path, char out[NAME_SIZE]) {
    size_t used = (size_t)snprintf(out, NAME_SIZE, "%s ", command);
    for (bool inside = false; *path != '\0' && used + 1 < NAME_SIZE; path++) {
        inside = inside && *path != ']';
        if (!inside)
            out[used++] = *path;
        inside = inside || *path == '[';
    }
    out[used] = '\0';
}

static pair *pair_of(const char *object, const char *a, const char *b) {
    for (size_t i = 0; i < pair_count; i++)
        if (strcmp(pairs[i].a, a) == 0 && strcmp(pairs[i].b, b) == 0 && strcmp(pairs[i].object, object) == 0)
            return &pairs[i];
    if (pairs == NULL)
        pairs = calloc(APART_MAX, sizeof *pairs);
    assert_true(pairs != NULL && pair_count < APART_MAX);
    pair *p = &pairs[pair_count++];
    snprintf(p->object, sizeof p->object, "%s", object);
    snprintf(p->a, sizeof p->a, "%s", a);
    snprintf(p->b, sizeof p->b, "%s", b);
    return p;
}

static bool same(const json_t *a, const json_t *b) {
    return json_is_number(a) && json_is_number(b) ? json_number_value(a) == json_number_value(b) : json_equal(a, b);
}

void apart_note(const char *command, const char *path, json_t *object) {
    char kind[NAME_SIZE];
    const char *a, *b;
    json_t *x, *y;
    kind_of(command, path, kind);
    json_object_foreach(object, a, x) json_object_foreach(object, b, y) {
        const bool nested = json_is_object(x) || json_is_array(x) || json_is_object(y) || json_is_array(y);
        if (strcmp(a, b) >= 0 || nested)
            continue;
        pair *p = pair_of(kind, a, b);
        p->equal = p->equal || (same(x, y) && !json_is_null(x));
        p->apart = p->apart || !same(x, y);
    }
}

void check_apart(void **state) {
    tally t = {.name = "neighbours"};
    (void)state;
    for (size_t i = 0; i < pair_count; i++) {
        const bool good = pairs[i].apart || !pairs[i].equal;
        TALLY(&t, good, "%s: %s and %s are the same in every run", pairs[i].object, pairs[i].a, pairs[i].b);
        if (!good)
            printf("# %s: %s and %s are the same in every run\n", pairs[i].object, pairs[i].a, pairs[i].b);
    }
    tally_end(&t);
    free(pairs);
    pairs = NULL;
    pair_count = 0;
}
