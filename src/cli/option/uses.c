/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which command takes which rows, and where it puts what they read. */
#include <stdio.h>
#include <string.h>

#include "cli/option/option.h"
#include "core/append.h"

/* Every command takes these; the reader of words knows what they ask for. */
/* clang-format off */
const option_row option_always[] = {
    {"help", 'h', NULL,
        "this help", .parse = NULL},
    {"version", 'V', NULL,
        "version and licence", .parse = NULL},
    END};
/* clang-format on */

static const option_row *row_named(const option_row *rows, const char *name) {
    while (rows->name != NULL && strcmp(rows->name, name) != 0)
        rows++;
    return rows->name != NULL ? rows : NULL;
}

const option_row *option_find(const command_row *v, const char *name) {
    const option_row *found = NULL;
    for (const option_place *p = v->places; p->table != NULL && found == NULL; p++)
        found = row_named(p->table->rows, name);
    return found != NULL ? found : row_named(option_always, name);
}

void *option_group(const asked_line *line, const option_row *row) {
    for (const option_place *p = line->command->places; p->table != NULL; p++)
        for (const option_row *r = p->table->rows; r->name != NULL; r++)
            if (r == row)
                return (char *)line->request + p->at;
    return NULL;
}

int option_set(asked_line *line, const char *name, const char *value) {
    const option_row *row = option_find(line->command, name);
    return row->parse(line, row, value, option_group(line, row));
}

const char *option_written(const asked_line *line, const char *name) {
    const option_row *row = option_find(line->command, name);
    return row != NULL && row->written ? *(const char *const *)option_field(row, option_group(line, row)) : NULL;
}

/* ---- Which command takes what ------------------------------------------------------------------------------------ */

static const option_use *find(const option_use *uses, unsigned parts, const char *name) {
    for (; uses->name != NULL || uses->rows != NULL || uses->group != NULL; uses++) {
        const bool here = uses->name != NULL ? strcmp(uses->name, name) == 0
                                             : uses->rows != NULL && row_named(uses->rows, name) != NULL;
        const option_use *found = uses->group != NULL ? find(uses->group, parts, name) : here ? uses : NULL;
        if (found != NULL && (uses->parts == 0 || (uses->parts & parts) != 0))
            return found;
    }
    return NULL;
}

option_taken option_used(const command_row *v, unsigned parts, const option_row *row) {
    const option_use *found = row != NULL && option_find(v, row->name) == row ? find(v->uses, parts, row->name) : NULL;
    option_taken out = {.row =
                            found != NULL || (row != NULL && row_named(option_always, row->name) == row) ? row : NULL};
    if (found != NULL && found->own != NULL)
        out.own = *found->own;
    if (found != NULL)
        out.parse = out.own.parse != NULL ? out.own.parse : row->parse;
    return out;
}

bool option_part_get(const command_row *v, size_t index, command_part *out) {
    *out = (command_part){NULL, 0};
    if (v->part_get != NULL)
        return v->part_get(index, out);
    if (v->parts != NULL)
        *out = v->parts[index];
    return out->words != NULL;
}

unsigned option_parts(const asked_line *line) {
    const command_row *v = line->command;
    command_part part;
    return v->part != NULL && option_part_get(v, v->part(line->request), &part) ? part.bits : ~0U;
}

enum { OTHERS_NAMED = 6 }; /* more parts are no help */

/* An option that another part takes. */
static int refuse_part(const option_row *row, const command_row *v, const command_part *now) {
    const char *lead = v->part_of != NULL ? v->part_of : "";
    char names[OPTION_TEXT_SIZE] = "";
    const char *last = "", *instead = option_used(v, ~0U, row).own.instead;
    command_part part;
    size_t others = 0;
    if (instead == NULL)
        instead = row->instead != NULL ? row->instead : "";
    for (size_t i = 0; option_part_get(v, i, &part); i++)
        if (option_used(v, part.bits, option_find(v, row->name)).row != NULL &&
            (others == 0 || strncmp(part.words, last, strlen(last)) != 0 ||
             part.words[strlen(last)] != ' ')) { /* "to an effect ... that needs more" */
            append(names, sizeof names, "%s%s", others++ > 0 ? ", " : "", part.words);
            last = part.words;
        }
    if (others == 0)
        return EXIT_FINE;
    if (others > OTHERS_NAMED)
        return option_refuse(row, "does not apply %s%s", lead, now->words);
    return option_refuse(row, "does not apply %s%s, only %s%s%s", lead, now->words, lead, names, instead);
}

int option_check_parts(const asked_line *line, const command_row *v, size_t part) {
    command_part now;
    int status = EXIT_FINE;
    if (!option_part_get(v, part, &now))
        return EXIT_FINE;
    for (size_t i = 0; i < line->given_count && status == EXIT_FINE; i++)
        if (option_used(v, now.bits, option_find(v, line->given[i].name)).row == NULL)
            status = refuse_part(option_find(line->command, line->given[i].name), v, &now);
    return status;
}

/* The first of `names` that is given, or the first, where none is wanted; null. @return out, or null */
static const char *name_among(const asked_line *line, const char *names, bool given, char out[OPTION_TEXT_SIZE]) {
    for (size_t length; *names != '\0'; names += length + (names[length] == ' ')) {
        length = strcspn(names, " ");
        snprintf(out, OPTION_TEXT_SIZE, "%.*s", (int)length, names);
        if (!given || option_given(line, out))
            return out;
    }
    return NULL;
}

static int check_rules(const asked_line *line, const option_rule *rule) {
    char other[OPTION_TEXT_SIZE];
    for (; rule != NULL && rule->option != NULL; rule++) {
        const bool holds = rule->parts == 0 || (rule->parts & line->parts) != 0;
        const char *found = name_among(line, rule->others, true, other);
        const char *more = rule->more != NULL ? rule->more : "";
        if (!holds || !option_given(line, rule->option) || (found != NULL) == (rule->relation == RULE_NEEDS))
            continue;
        if (rule->relation == RULE_CONFLICTS)
            return option_error(rule->option, "conflicts with --%s%s", found, more);
        return option_error(rule->option, "needs --%s%s", name_among(line, rule->others, false, other), more);
    }
    return EXIT_FINE;
}

int option_check_rules(const asked_line *line) {
    int status = check_rules(line, line->command->rules);
    for (const option_place *p = line->command->places; p->table != NULL && status == EXIT_FINE; p++)
        status = check_rules(line, p->table->rules);
    return status;
}

void option_default(const option_taken *use, const char **standard, const char **without) {
    const bool own = use->own.standard != NULL || use->own.without != NULL;
    *standard = own ? use->own.standard : use->row->standard;
    *without = own ? use->own.without : use->row->without;
    if (*without != NULL && **without == '\0')
        *without = NULL;
}

const char *option_use_argument(const option_taken *use, char out[OPTION_TEXT_SIZE]) {
    out[0] = '\0';
    append(out, OPTION_TEXT_SIZE, "%s", use->own.argument != NULL ? use->own.argument : "");
    return use->own.argument != NULL ? out : option_argument(use->row, out);
}

const char *option_use_optional(const option_taken *use) {
    return use->own.optional != NULL ? use->own.optional : use->row->optional;
}
