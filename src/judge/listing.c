/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "judge/listing.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

/* ---- Words of a text --------------------------------------------------------------------------------------------- */

static bool in_word(char c) {
    return isalnum((unsigned char)c) || c == '_';
}

static int brackets(char c) {
    return (c == '(' || c == '{' || c == '[') - (c == ')' || c == '}' || c == ']');
}

bool piece_is(piece p, const char *text) {
    return p.length == strlen(text) && memcmp(p.at, text, p.length) == 0;
}

bool piece_same(piece a, piece b) {
    return a.length == b.length && memcmp(a.at, b.at, a.length) == 0;
}

bool piece_is_any(piece p, const char *const list[]) {
    for (; *list != NULL; list++)
        if (piece_is(p, *list))
            return true;
    return false;
}

bool listing_word(const char **at, const char *end, piece *out, int *open) {
    const char *c = *at;
    for (; c < end; c++) {
        *open += brackets(*c);
        if (!in_word(*c))
            continue;
        const char *from = c;
        while (c < end && (in_word(*c) || (isdigit((unsigned char)*from) && *c == '.')))
            c++;
        if (isdigit((unsigned char)*from)) {
            c--;
            continue;
        }
        *out = (piece){from, (size_t)(c - from)};
        *at = c;
        return true;
    }
    *at = end;
    return false;
}

const char *listing_before(const char *from, const char *at) {
    static const char nothing[] = "";
    do
        at--;
    while (at >= from && isspace((unsigned char)*at));
    return at >= from ? at : nothing;
}

char listing_after(const char *at, const char *end) {
    while (at < end && isspace((unsigned char)*at))
        at++;
    return at < end ? *at : '\0';
}

piece listing_word_before(const char *from, const char *at) {
    const char *last = listing_before(from, at), *first = last;
    if (!in_word(*last))
        return (piece){"", 0};
    while (first > from && in_word(first[-1]))
        first--;
    return (piece){first, (size_t)(last + 1 - first)};
}

/* ---- What stands in a file --------------------------------------------------------------------------------------- */

static void blank(char *from, const char *to) {
    for (; from < to; from++)
        if (*from != '\n' && *from != '\r')
            *from = ' ';
}

static void blank_remarks(char *text) {
    for (char *c = text; *c != '\0'; c++) {
        const bool line = c[0] == '/' && c[1] == '/', block = c[0] == '/' && c[1] == '*';
        const char *end = line ? strchr(c, '\n') : block ? strstr(c + 2, "*/") : NULL;
        if (!line && !block)
            continue;
        end = end == NULL ? c + strlen(c) : end + (block ? 2 : 0);
        blank(c, end);
    }
}

static const char *directive_end(const char *c) {
    while (*c != '\0' && *c != '\n') {
        const bool goes_on = c[0] == '\\' && (c[1] == '\n' || (c[1] == '\r' && c[2] == '\n'));
        c += goes_on ? (c[1] == '\r' ? 3 : 2) : 1;
    }
    return c;
}

static const char *const ifs[] = {"if", "ifdef", "ifndef", NULL};
static const char *const conditions[] = {"else", "elif", "endif", "if", "ifdef", "ifndef", NULL};

static piece directive_word(const char *c) {
    piece word = {c + 1 + strspn(c + 1, " \t"), 0};
    while (in_word(word.at[word.length]))
        word.length++;
    return word;
}

/* How many brackets are open where #if, #else and #endif part the text: each branch begins where the first did. */
typedef struct branches {
    int open[16];
    unsigned depth;
} branches;

static const char *directive(const char *c, branches *b, int *open) {
    const piece word = directive_word(c);
    if (piece_is_any(word, ifs) && b->depth < sizeof b->open / sizeof b->open[0])
        b->open[b->depth++] = *open;
    else if (piece_is(word, "endif"))
        b->depth -= b->depth > 0;
    else if (piece_is_any(word, conditions)) /* perhaps of an #if before the text */
        *open = b->depth > 0 ? b->open[b->depth - 1] : 0;
    return directive_end(c);
}

/* Where a declaration or function ends that begins at c. */
static const char *item_end(const char *c, item *out) {
    static const char *const with_end[] = {"struct", "uniform", "layout", "buffer", NULL};
    branches b = {.depth = 0};
    int open = 0;
    bool value = false;
    piece first = {c, 0};
    while (in_word(c[first.length]))
        first.length++;
    const bool ends = piece_is_any(first, with_end);
    for (; *c != '\0'; c++) {
        if (*c == '#')
            c = directive(c, &b, &open);
        if (*c == '\0')
            break;
        open += brackets(*c);
        value = value || (open == 0 && *c == '=');
        if (open == 1 && *c == '(' && out->name.length == 0 && !value && !ends)
            out->name = listing_word_before(out->from, c);
        if (open == 1 && *c == '{' && out->name.length > 0 && !value)
            out->kind = ITEM_FUNCTION;
        if (open == 0 && (*c == ';' || (*c == '}' && !ends && !value)))
            return c + 1;
    }
    return c;
}

/* HLSL's variables without a value are uniforms, too. */
static item_kind kind_of(const listing *s, const item *i) {
    static const char *const apart[] = {"uniform", "cbuffer", "tbuffer", "ConstantBuffer", "varying",   "attribute",
                                        "in",      "out",     "buffer",  "layout",         "precision", NULL};
    static const char *const left[] = {"version", "include", "pragma", "line", NULL};
    const char *at = i->from;
    int open = 0;
    piece word;
    if (i->kind == ITEM_FUNCTION)
        return ITEM_FUNCTION;
    if (strncmp(i->from, "struct", 6) == 0 && !in_word(i->from[6]))
        return ITEM_STRUCTURE;
    for (int k = 0; listing_word(&at, i->to, &word, &open) && (open == 0 || k == 0); k++)
        if (piece_is_any(word, i->kind == ITEM_DIRECTIVE ? left : apart))
            return ITEM_NONE;
    const bool plain = memchr(i->from, '=', (size_t)(i->to - i->from)) == NULL &&
                       memchr(i->from, '{', (size_t)(i->to - i->from)) == NULL && i->name.length == 0;
    return i->kind == ITEM_CODE && s->hlsl && plain ? ITEM_NONE : i->kind;
}

static bool take_apart(listing *s) {
    size_t room = 0;
    for (const char *c = s->text; *c != '\0';) {
        if (isspace((unsigned char)*c)) {
            c++;
            continue;
        }
        if (s->count == room) {
            room = 2 * room + 64;
            item *more = realloc(s->items, room * sizeof *more);
            if (more == NULL)
                return false;
            s->items = more;
        }
        item *i = &s->items[s->count++];
        *i = (item){.from = c, .kind = *c == '#' ? ITEM_DIRECTIVE : ITEM_CODE};
        i->to = *c == '#' ? directive_end(c) : item_end(c, i);
        i->kind = kind_of(s, i);
        i->kept = i->kind == ITEM_DIRECTIVE;
        c = i->to;
    }
    return true;
}

bool listing_read(const char *file, bool hlsl, listing *out) {
    *out = (listing){.text = strdup(file), .hlsl = hlsl};
    if (out->text != NULL)
        blank_remarks(out->text);
    return out->text != NULL && take_apart(out);
}

void listing_free(listing *s) {
    free(s->items);
    free(s->text);
}

/* #if and its like part the whole file and stay. */
void listing_blank_rest(listing *s) {
    for (size_t k = 0; k < s->count; k++) {
        const item *i = &s->items[k];
        if (i->kept)
            continue;
        for (char *line = s->text + (i->from - s->text), *end; line < i->to; line = end) {
            const char *c = line + strspn(line, " \t\r\n");
            end = s->text + (directive_end(c) - s->text);
            if (i->kind == ITEM_DIRECTIVE || *c != '#' || !piece_is_any(directive_word(c), conditions))
                blank(line, end < i->to ? end : i->to);
        }
    }
}

bool listing_item_declares(const item *i, piece name, bool inside) {
    static const char *const none[] = {"return", "else", "do", "case", NULL};
    const char *at = i->from;
    int open = 0;
    if (i->kind == ITEM_FUNCTION && !inside)
        return piece_same(i->name, name);
    for (piece word; listing_word(&at, i->to, &word, &open);) {
        if (!piece_same(word, name))
            continue;
        const piece prior = listing_word_before(i->from, word.at);
        const char last = *listing_before(i->from, word.at);
        if (i->kind == ITEM_DIRECTIVE           ? piece_is(prior, "define")
            : in_word(listing_after(at, i->to)) ? false
            : inside                            ? prior.length > 0 && !piece_is_any(prior, none)
                     : open == 0 && (prior.length > 0 || last == ',' || last == ']' || last == '}'))
            return true;
    }
    return false;
}

void listing_keep(listing *s, item *i) {
    const char *at = i->from;
    int open = 0;
    i->kept = true;
    for (piece word; listing_word(&at, i->to, &word, &open);)
        for (size_t k = 0; k < s->count; k++)
            if (!s->items[k].kept && s->items[k].kind != ITEM_NONE && listing_item_declares(&s->items[k], word, false))
                listing_keep(s, &s->items[k]);
}

piece listing_type(const listing *s, piece name, bool member) {
    for (size_t k = 0; k < s->count; k++) {
        const item *i = &s->items[k];
        const char *at = i->from;
        int open = 0;
        if (i->kind == ITEM_NONE || (member && i->kind == ITEM_STRUCTURE))
            for (piece word; listing_word(&at, i->to, &word, &open);)
                if (piece_same(word, name))
                    return listing_word_before(i->from, word.at);
    }
    return (piece){"", 0};
}

bool listing_declares(const listing *s, piece name) {
    for (size_t k = 0; k < s->count; k++)
        if (s->items[k].kind != ITEM_NONE && listing_item_declares(&s->items[k], name, false))
            return true;
    return false;
}

bool listing_in_condition(const listing *s, piece word) {
    const char *from = word.at;
    while (from > s->text && from[-1] != '\n')
        from--;
    from += strspn(from, " \t");
    const piece first = *from == '#' ? directive_word(from) : (piece){"", 0};
    return piece_is_any(first, ifs) || piece_is(first, "elif");
}

bool listing_matters(const listing *s, const item *condition) {
    const char *end = condition->to;
    for (int depth = 1; *end != '\0' && depth > 0;) {
        const char *line = end + strspn(end, " \t\r\n");
        const piece word = *line == '#' ? directive_word(line) : (piece){"", 0};
        depth += piece_is_any(word, ifs) - piece_is(word, "endif");
        end = directive_end(line);
    }
    for (const item *i = condition + 1; i < s->items + s->count && i->from < end; i++)
        if (i->kept && (i->kind != ITEM_DIRECTIVE || !piece_is_any(directive_word(i->from), conditions)))
            return true;
    return condition->kind != ITEM_DIRECTIVE;
}

/* ---- Structures -------------------------------------------------------------------------------------------------- */

const item *listing_structure(const listing *s, piece name) {
    for (size_t k = 0; k < s->count; k++)
        if (s->items[k].kind == ITEM_STRUCTURE && listing_item_declares(&s->items[k], name, false))
            return &s->items[k];
    return NULL;
}

bool listing_member(const item *structure, const char **at, int *open, piece *out) {
    while (listing_word(at, structure->to, out, open)) {
        const char next = listing_after(*at, structure->to);
        if (*open == 1 && (next == ';' || next == ',' || next == '[') &&
            *listing_before(structure->from, out->at) != '[')
            return true;
    }
    return false;
}

/* "layout(std140) uniform Camera {...} cam;" and "ConstantBuffer<Camera> cam : register(b0);" in their places. */
const item *listing_release(listing *s, piece name) {
    for (size_t k = 0; k < s->count; k++) {
        item *i = &s->items[k];
        const char *at = i->from;
        int open = 0;
        piece word, outer = {NULL, 0}, type = {NULL, 0};
        char *text = s->text;
        if (i->kind != ITEM_NONE)
            continue;
        while (listing_word(&at, i->to, &word, &open) && !(open == 0 && piece_same(word, name))) {
            if (piece_is(word, "uniform") || piece_is(word, "ConstantBuffer"))
                outer = word;
            else if (open == 0)
                type = word;
        }
        const bool block = *listing_before(i->from, at - name.length) == '}';
        const item *structure = block ? i : type.at != NULL ? listing_structure(s, type) : NULL;
        const char next = listing_after(at, i->to);
        if (outer.at == NULL || structure == NULL || (next != ';' && next != ':'))
            continue;
        if (!block) {
            blank(text + (outer.at - text), type.at);
            blank(text + (type.at + type.length - text), at - name.length);
        }
        blank(text + (i->from - text), outer.at);
        memcpy(text + (outer.at - text), block ? "struct " : s->hlsl ? "static " : "       ", 7);
        blank(text + (at - text), i->to - 1);
        i->kind = block ? ITEM_STRUCTURE : ITEM_CODE;
        listing_keep(s, i);
        return structure;
    }
    return NULL;
}
