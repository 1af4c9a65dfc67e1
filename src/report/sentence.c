/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/sentence.h"

#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "report/number.h"

/* A name in braces. */
typedef struct place {
    const char *name;
    size_t length;
    const char *digits; /* behind the colon; null without */
    const char *end;    /* behind the brace */
} place;

static place place_at(const char *brace) {
    const char *const name = brace + 1, *const end = name + strcspn(name, "}");
    const size_t length = strcspn(name, ":}");
    return (place){name, length, name[length] == ':' ? name + length + 1 : NULL, end + (*end != '\0')};
}

/* The column of that key; *item becomes the one that has it, null where it does not exist. */
static const column *find(const column *c, const char *name, size_t length, void **item) {
    for (; c->kind != COLUMN_END; c++) {
        const size_t own = c->key != NULL ? strlen(c->key) : 0;
        void *inner = c->kind == COLUMN_PART ? column_part(c, *item) : NULL;
        const bool within = own > 0 && own < length && strncmp(name, c->key, own) == 0 && name[own] == '.';
        const column *found = NULL;
        if (c->kind == COLUMN_PART && c->key == NULL)
            found = find(c->columns, name, length, &inner);
        else if (c->kind == COLUMN_PART && within)
            found = find(c->columns, name + own + 1, length - own - 1, &inner);
        else if (c->kind != COLUMN_LIST && c->kind != COLUMN_PART && own == length &&
                 strncmp(name, c->key, length) == 0)
            return c;
        if (found != NULL) {
            *item = inner;
            return found;
        }
    }
    return NULL;
}

/* @return false where the value does not exist */
static bool put_value(const place *at, const column *columns, void *item, const page *p, char *out, size_t size) {
    const column *found = find(columns, at->name, at->length, &item);
    if (found == NULL) {
        append(out, size, "{%.*s}", (int)at->length, at->name);
        return true;
    }
    column c = *found;
    number_text number;
    if (at->digits != NULL) {
        c.digits = atoi(at->digits);
        c.digits_at = 0;
    }
    if (item == NULL || !column_has(&c, item))
        return false;
    const char *const text = column_text(&c, item, &number);
    const void *const value = (const char *)item + c.offset;
    if (c.unit == NULL || strcmp(c.unit, "scene") != 0)
        append(out, size, "%s", text);
    else if (c.given && p->as_given != NULL)
        append(out, size, "%s", p->as_given(p->lengths, *(const double *)value, c.digits).text);
    else
        append(out, size, "%s", number_in(number, p->unit).text);
    return true;
}

/* @return false where a value does not exist */
static bool fill(const char *words, const column *columns, void *item, const page *p, char *out, size_t size) {
    out[0] = '\0';
    while (*words != '\0') {
        const size_t plain = strcspn(words, "{");
        append(out, size, "%.*s", (int)plain, words);
        words += plain;
        if (*words == '\0')
            break;
        const place at = place_at(words);
        if (!put_value(&at, columns, item, p, out, size))
            return false;
        words = at.end;
    }
    return true;
}

void page_say(page *p, const sentence *rows, const column *columns, void *item, unsigned when) {
    char label[SENTENCE_SIZE], text[SENTENCE_SIZE];
    const sentence *begun = rows; /* the first of some of which one is said */
    bool said = false;
    for (const sentence *s = rows; s->form != SENTENCE_NONE; s++) {
        if (s->form != SENTENCE_ELSE) {
            begun = s;
            said = false;
        }
        if (said || (s->when & ~when) != 0 || !fill(s->words, columns, item, p, text, sizeof text))
            continue;
        said = true;
        if (begun->form == SENTENCE_NOTE && fill(begun->label, columns, item, p, label, sizeof label))
            page_wrapped(p, label, text);
        else
            (begun->form == SENTENCE_LINE ? page_line : page_text)(p, "%s", text);
    }
}

const char *sentence_first(const page *p, const sentence *rows, const column *columns, void *item, unsigned when,
                           char out[SENTENCE_SIZE]) {
    const page bare = {.unit = NULL};
    for (; rows->form != SENTENCE_NONE; rows++)
        if ((rows->when & ~when) == 0 && fill(rows->words, columns, item, p != NULL ? p : &bare, out, SENTENCE_SIZE))
            return out;
    out[0] = '\0';
    return out;
}
