/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * In place of libconfig, for a module that lives for one command: its own structures, filled from a text and never
 * freed. Without @include, which a requirement file has no use for.
 */
#include <ctype.h>
#include <libconfig.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { DEPTH_MAX = 64 };

typedef struct parser {
    config_t *config;
    const char *at;
    unsigned line;
    int depth;
    const char *fault;
} parser;

static bool refuse(parser *p, const char *fault) {
    p->fault = p->fault != NULL ? p->fault : fault;
    return false;
}

/* Over blanks and comments. */
static void skip(parser *p) {
    for (;; p->at++) {
        if (*p->at == '#' || strncmp(p->at, "//", 2) == 0) {
            p->at += strcspn(p->at, "\n");
        } else if (strncmp(p->at, "/*", 2) == 0) {
            for (p->at += 2; *p->at != '\0' && strncmp(p->at, "*/", 2) != 0; p->at++)
                p->line += *p->at == '\n';
            p->at += *p->at != '\0';
            continue;
        }
        p->line += *p->at == '\n';
        if (*p->at == '\0' || !isspace((unsigned char)*p->at))
            return;
    }
}

static bool take(parser *p, const char *one_of) {
    skip(p);
    if (*p->at == '\0' || strchr(one_of, *p->at) == NULL)
        return false;
    p->at++;
    return true;
}

static config_setting_t *add(parser *p, config_setting_t *parent) {
    config_list_t *list = parent->value.list;
    if (list == NULL)
        list = parent->value.list = calloc(1, sizeof *list);
    config_setting_t *s = calloc(1, sizeof *s),
                     **more = list != NULL ? realloc(list->elements, (list->length + 1) * sizeof s) : NULL;
    if (s == NULL || more == NULL) {
        free(s);
        return NULL;
    }
    *s = (config_setting_t){.parent = parent, .config = p->config, .line = p->line};
    list->elements = more;
    list->elements[list->length++] = s;
    return s;
}

/* The character that a backslash and what follows it mean. */
static char escaped(parser *p) {
    static const char letters[] = "abfnrtv", meant[] = "\a\b\f\n\r\t\v";
    const char c = *p->at++, *found = c != '\0' ? strchr(letters, c) : NULL;
    if (c == 'x' && isxdigit((unsigned char)p->at[0]) && isxdigit((unsigned char)p->at[1])) {
        const char digits[] = {p->at[0], p->at[1], '\0'};
        p->at += 2;
        return (char)strtol(digits, NULL, 16);
    }
    return found != NULL ? meant[found - letters] : c;
}

/* Strings one behind the other are one. */
static bool read_string(parser *p, config_setting_t *s) {
    char *out = s->value.sval = calloc(strlen(p->at) + 1, 1);
    s->type = CONFIG_TYPE_STRING;
    while (out != NULL && take(p, "\"")) {
        while (*p->at != '"' && *p->at != '\0') {
            p->line += *p->at == '\n';
            const char c = *p->at++;
            if (c == '\\' && *p->at == '\0')
                break;
            *out++ = c == '\\' ? escaped(p) : c;
        }
        if (*p->at++ != '"')
            return p->at--, refuse(p, "syntax error");
    }
    return out != NULL;
}

static bool read_number(parser *p, config_setting_t *s) {
    char *end, *whole;
    const double value = strtod(p->at, &end);
    const bool hex = strncasecmp(p->at, "0x", 2) == 0;
    const long long integer = strtoll(p->at, &whole, hex ? 16 : 10);
    if (end == p->at || strspn(p->at, "+-.0123456789") == 0)
        return refuse(p, "syntax error");
    if (whole < end) {
        s->type = CONFIG_TYPE_FLOAT;
        s->value.fval = value;
    } else {
        while (*end == 'L')
            end++;
        s->type = integer == (int)integer && *whole != 'L' ? CONFIG_TYPE_INT : CONFIG_TYPE_INT64;
        if (s->type == CONFIG_TYPE_INT)
            s->value.ival = (int)integer;
        else
            s->value.llval = integer;
    }
    p->at = end;
    return true;
}

static bool read_word(parser *p, config_setting_t *s) {
    const size_t length = strspn(p->at, "TRUEFALSetruefals");
    s->type = CONFIG_TYPE_BOOL;
    s->value.ival = length == 4 && strncasecmp(p->at, "true", 4) == 0;
    if (s->value.ival == 0 && (length != 5 || strncasecmp(p->at, "false", 5) != 0))
        return refuse(p, "syntax error");
    p->at += length;
    return true;
}

static bool read_settings(parser *p, config_setting_t *group, char end);

/* Reads elements; those of an array are scalars of one type. */
static bool read_elements(parser *p, config_setting_t *s, char end);

static bool read_value(parser *p, config_setting_t *s) {
    skip(p);
    const char c = *p->at;
    if (c == '"')
        return read_string(p, s);
    if (c == '{' || c == '[' || c == '(') {
        if (++p->depth > DEPTH_MAX)
            return refuse(p, "syntax error");
        p->at++;
        s->type = c == '{' ? CONFIG_TYPE_GROUP : c == '[' ? CONFIG_TYPE_ARRAY : CONFIG_TYPE_LIST;
        const bool good = c == '{' ? read_settings(p, s, '}') : read_elements(p, s, c == '[' ? ']' : ')');
        p->depth--;
        return good;
    }
    return isalpha((unsigned char)c) ? read_word(p, s) : read_number(p, s);
}

static bool read_elements(parser *p, config_setting_t *s, char end) {
    const char close[] = {end, '\0'};
    while (!take(p, close)) {
        config_setting_t *element = add(p, s);
        if (element == NULL || !read_value(p, element))
            return refuse(p, "syntax error");
        if (end == ']' && (element->type != s->value.list->elements[0]->type || element->type >= CONFIG_TYPE_ARRAY ||
                           element->type == CONFIG_TYPE_GROUP))
            return refuse(p, "mismatched element type in array");
        if (!take(p, ",") && *p->at != end)
            return refuse(p, "syntax error");
    }
    return true;
}

static bool read_settings(parser *p, config_setting_t *group, char end) {
    for (skip(p); *p->at != end; skip(p)) {
        const char *name = p->at;
        while (isalpha((unsigned char)*p->at) || *p->at == '*' ||
               (p->at > name && *p->at != '\0' && strchr("-_0123456789", *p->at) != NULL))
            p->at++;
        char *own = strndup(name, (size_t)(p->at - name));
        for (int i = 0; own != NULL && i < config_setting_length(group); i++)
            if (strcmp(config_setting_get_elem(group, (unsigned)i)->name, own) == 0)
                return refuse(p, "duplicate setting name");
        if (own == NULL || *own == '\0' || !take(p, "=:"))
            return refuse(p, "syntax error");
        skip(p);
        config_setting_t *s = add(p, group);
        if (s == NULL)
            return refuse(p, "out of memory");
        s->name = own;
        if (!read_value(p, s))
            return refuse(p, "syntax error");
        take(p, ";,");
    }
    p->at += end != '\0';
    return true;
}

void config_init(config_t *config) {
    memset(config, 0, sizeof *config);
}

void config_destroy(config_t *config) {
    (void)config;
}

int config_read_string(config_t *config, const char *text) {
    parser p = {.config = config, .at = text, .line = 1};
    config->root = calloc(1, sizeof *config->root);
    if (config->root == NULL)
        return CONFIG_FALSE;
    config->root->type = CONFIG_TYPE_GROUP;
    if (read_settings(&p, config->root, '\0'))
        return CONFIG_TRUE;
    config->error_text = p.fault;
    config->error_line = (int)p.line;
    return CONFIG_FALSE;
}

int config_setting_length(const config_setting_t *s) {
    const bool many = s->type == CONFIG_TYPE_GROUP || s->type == CONFIG_TYPE_ARRAY || s->type == CONFIG_TYPE_LIST;
    return many && s->value.list != NULL ? (int)s->value.list->length : 0;
}

config_setting_t *config_setting_get_elem(const config_setting_t *s, unsigned index) {
    return index < (unsigned)config_setting_length(s) ? s->value.list->elements[index] : NULL;
}

const char *config_setting_get_string(const config_setting_t *s) {
    return s->value.sval;
}

int config_setting_get_bool(const config_setting_t *s) {
    return s->value.ival;
}

long long config_setting_get_int64(const config_setting_t *s) {
    return s->type == CONFIG_TYPE_INT64 ? s->value.llval : s->value.ival;
}

double config_setting_get_float(const config_setting_t *s) {
    return s->value.fval;
}
