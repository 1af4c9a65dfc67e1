/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/setting.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define DIGITS  "0123456789"
#define LETTERS "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
#define BLANKS  " \t\r\n\f\v"
#define SYNTAX  "syntax error; expected KEY = VALUE; as depthprec(5) describes"

typedef struct parser {
    settings *out;
    const char *at;
    char *words; /* where the next name or string goes */
    int line, depth;
    setting_fault *fault;
} parser;

/* Notes the first fault. @return false */
static bool refuse_at(parser *p, int line, const char *text) {
    if (p->fault->text == NULL)
        *p->fault = (setting_fault){line, text};
    return false;
}

static bool refuse(parser *p, const char *text) {
    return refuse_at(p, p->line, text);
}

/* Goes over so many characters, and counts their lines. */
static void pass(parser *p, size_t length) {
    for (; length > 0; length--)
        p->line += *p->at++ == '\n';
}

/* Goes over blanks and comments. */
static bool skip(parser *p) {
    for (;;) {
        pass(p, strspn(p->at, BLANKS));
        if (*p->at == '#' || strncmp(p->at, "//", 2) == 0) {
            pass(p, strcspn(p->at, "\n"));
        } else if (strncmp(p->at, "/*", 2) == 0) {
            const char *end = strstr(p->at + 2, "*/");
            if (end == NULL)
                return refuse(p, "a comment that nothing ends");
            pass(p, (size_t)(end + 2 - p->at));
        } else {
            return true;
        }
    }
}

/* Takes the next character if it is one of those. */
static bool take(parser *p, const char *one_of) {
    if (!skip(p) || *p->at == '\0' || strchr(one_of, *p->at) == NULL)
        return false;
    p->at++;
    return true;
}

static setting *add(parser *p, setting *parent, setting *before) {
    setting *s = calloc(1, sizeof *s);
    if (s == NULL) {
        refuse(p, "no memory");
        return NULL;
    }
    s->line = p->line;
    s->before = p->out->last;
    p->out->last = s;
    if (before != NULL)
        before->next = s;
    else if (parent != NULL)
        parent->first = s;
    if (parent != NULL)
        parent->count++;
    return s;
}

static bool is_hex(char c) {
    return c != '\0' && strchr(DIGITS "ABCDEFabcdef", c) != NULL;
}

/* The character that a backslash and what follows it mean; before any other it is itself. */
static char escaped(parser *p) {
    static const char letters[] = "\"\\abfnrtv", meant[] = "\"\\\a\b\f\n\r\t\v";
    const char *found = strchr(letters, *p->at);
    if (found != NULL) {
        p->at++;
        return meant[found - letters];
    }
    if (*p->at != 'x' || !is_hex(p->at[1]) || !is_hex(p->at[2]))
        return '\\';
    const char digits[] = {p->at[1], p->at[2], '\0'};
    p->at += sizeof digits;
    return (char)strtol(digits, NULL, 16);
}

/* Strings one behind the other are one. */
static bool read_string(parser *p, setting *s) {
    s->kind = SETTING_STRING;
    s->string = p->words;
    while (take(p, "\"")) {
        const int line = p->line;
        while (*p->at != '"') {
            const bool escape = *p->at == '\\';
            pass(p, escape);
            if (*p->at == '\0')
                return refuse_at(p, line, "a string that nothing ends");
            *p->words++ = escape ? escaped(p) : *p->at;
            pass(p, !escape);
        }
        p->at++;
    }
    *p->words++ = '\0';
    return p->fault->text == NULL;
}

/* The length of digits with a point or an exponent, which have not both to be there; 0 where neither is. */
static size_t real_length(const char *text) {
    const char *at = text + (*text == '+' || *text == '-');
    const size_t whole = strspn(at, DIGITS), point = at[whole] == '.',
                 part = point ? strspn(at + whole + 1, DIGITS) : 0;
    const char *end = at + whole + point + part, *power = end + 1 + (*end != '\0' && (end[1] == '+' || end[1] == '-'));
    const bool raised = (*end == 'e' || *end == 'E') && strspn(power, DIGITS) > 0;
    if (whole + part == 0 || (!point && !raised))
        return 0;
    return (size_t)((raised ? power + strspn(power, DIGITS) : end) - text);
}

static bool read_number(parser *p, setting *s) {
    const bool hex = p->at[0] == '0' && (p->at[1] == 'x' || p->at[1] == 'X') && is_hex(p->at[2]);
    const size_t real = hex ? 0 : real_length(p->at), sign = *p->at == '+' || *p->at == '-';
    if (real > 0) {
        s->kind = SETTING_REAL;
        s->number = strtod(p->at, NULL);
        p->at += real;
        return true;
    }
    if (!hex && strspn(p->at + sign, DIGITS) == 0)
        return refuse(p, SYNTAX);
    char *end;
    s->kind = SETTING_INTEGER;
    s->integer = hex ? (long long)strtoull(p->at, &end, 16) : strtoll(p->at, &end, 10);
    s->number = (double)s->integer;
    p->at = end + (*end == 'L') + (end[0] == 'L' && end[1] == 'L');
    return true;
}

static size_t name_length(const char *text) {
    return *text != '\0' && strchr(LETTERS "*", *text) != NULL ? strspn(text, LETTERS DIGITS "*-_") : 0;
}

static bool read_word(parser *p, setting *s) {
    const size_t length = name_length(p->at);
    s->kind = SETTING_WORD;
    s->number = length == 4 && strncasecmp(p->at, "true", length) == 0;
    if (s->number == 0.0 && !(length == 5 && strncasecmp(p->at, "false", length) == 0))
        return refuse(p, SYNTAX);
    p->at += length;
    return true;
}

static bool read_settings(parser *p, setting *group, const char *end);
static bool read_elements(parser *p, setting *s, const char *end);

static bool read_nested(parser *p, setting *s) {
    const char c = *p->at++;
    if (p->depth == SETTING_DEEPEST)
        return refuse(p, "too many brackets within brackets");
    p->depth++;
    s->kind = c == '{' ? SETTING_GROUP : c == '[' ? SETTING_ARRAY : SETTING_LIST;
    const bool good = c == '{' ? read_settings(p, s, "}") : read_elements(p, s, c == '[' ? "]" : ")");
    p->depth--;
    return good;
}

static bool read_value(parser *p, setting *s) {
    switch (*p->at) {
    case '"':
        return read_string(p, s);
    case '{':
    case '[':
    case '(':
        return read_nested(p, s);
    default:
        return name_length(p->at) > 0 ? read_word(p, s) : read_number(p, s);
    }
}

static bool read_elements(parser *p, setting *s, const char *end) {
    setting *last = NULL;
    while (!take(p, end)) {
        last = p->fault->text == NULL ? add(p, s, last) : NULL;
        if (last == NULL || !read_value(p, last))
            return false;
        if (s->kind == SETTING_ARRAY && (last->kind != s->first->kind || last->kind >= SETTING_GROUP))
            return refuse(p, "mismatched element type in array; expected two numbers of one kind, [0.5, 50.0], or "
                             "(0.5, 50)");
        if (!take(p, ",") && *p->at != *end)
            return refuse(p, SYNTAX);
    }
    return true;
}

static int by_name(const void *a, const void *b) {
    const setting *const *x = a, *const *y = b;
    const int order = strcmp((*x)->name, (*y)->name);
    return order != 0 ? order : ((*x)->name > (*y)->name) - ((*x)->name < (*y)->name);
}

/* A name is given once in a group. */
static bool names_differ(parser *p, const setting *group) {
    const setting **sorted = malloc((group->count + 1) * sizeof *sorted), *twice = NULL;
    if (sorted == NULL)
        return refuse(p, "no memory");
    size_t count = 0;
    for (const setting *s = group->first; s != NULL; s = s->next)
        sorted[count++] = s;
    qsort(sorted, count, sizeof *sorted, by_name);
    for (size_t i = 1; i < count; i++)
        if (strcmp(sorted[i - 1]->name, sorted[i]->name) == 0 && (twice == NULL || sorted[i]->name < twice->name))
            twice = sorted[i];
    free(sorted);
    return twice == NULL || refuse_at(p, twice->line, "duplicate setting name");
}

/* Settings up to `end`, a character or the end of the text. */
static bool read_settings(parser *p, setting *group, const char *end) {
    static const char include[] = "@include"; /* libconfig would read that file */
    for (setting *last = NULL; skip(p) && *p->at != *end;) {
        const size_t length = name_length(p->at);
        if (length == 0)
            return refuse(p, strncmp(p->at, include, sizeof include - 1) == 0
                                 ? "@include is not allowed in requirement files"
                                 : SYNTAX);
        last = add(p, group, last);
        if (last == NULL)
            return false;
        last->name = memcpy(p->words, p->at, length);
        p->words[length] = '\0';
        p->words += length + 1;
        p->at += length;
        if (!take(p, "=:") || !skip(p))
            return refuse(p, SYNTAX);
        if (!read_value(p, last))
            return false;
        take(p, ";,");
    }
    p->at += *end != '\0';
    return p->fault->text == NULL && names_differ(p, group);
}

bool setting_parse(const char *text, settings *out, setting_fault *fault) {
    *out =
        (settings){.words = malloc(strlen(text) + 1)}; /* each name or string is shorter than what it is written in */
    *fault = (setting_fault){0};
    parser p = {.out = out, .at = text, .words = out->words, .line = 1, .fault = fault};
    if (out->words == NULL)
        return refuse(&p, "no memory");
    out->root = add(&p, NULL, NULL);
    if (out->root == NULL)
        return false;
    out->root->kind = SETTING_GROUP;
    return read_settings(&p, out->root, "");
}

void setting_release(settings *s) {
    for (setting *each = s->last, *before; each != NULL; each = before) {
        before = each->before;
        free(each);
    }
    free(s->words);
    *s = (settings){0};
}
