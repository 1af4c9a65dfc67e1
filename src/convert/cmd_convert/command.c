/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * convert: depths copied to another format, and perhaps back, by what a shader or program computes. How many codes come
 * back, the first that does not, whether EQUAL and the order survive, and what other ways to write would do.
 */
#include <math.h>
#include <stdio.h>

#include "cli/list.h"
#include "convert/cmd_convert/request.h"
#include "report/number.h"
#include "report/report.h"

enum { NAME_SIZE = 32 };

/* The outcome of a way to write. Numbers that do not exist are NaN. */
typedef struct outcome {
    char write[NAME_SIZE];
    convert_found found;
    double first, becomes; /* the first code that changes */
    double by, at;         /* the most codes that one changes by */
    bool equal;            /* none changes */
} outcome;

/* The way of a code. Numbers that do not exist are NaN. */
typedef struct one_code {
    uint32_t code;
    double number, through, becomes, beyond;
    bool changed;
} one_code;

typedef struct conversion {
    const convert_request *o;
    convert_chain chain;
    const char *from, *through, *to; /* through: null of two formats */
    char read[NAME_SIZE];
    outcome asked, other;
    convert_rule others[2 * CONVERT_WAYS]; /* that are tried beside it */
    size_t other_count;
    one_code one;
} conversion;

/* ---- What is asked ----------------------------------------------------------------------------------------------- */

/* Whether integers are written, or, from 0 on, read. */
static bool has_integers(const convert_chain *c, int first) {
    bool has = false;
    for (int i = first; i < c->count - (first == 0); i++)
        has = has || c->format[i].kind == DP_FORMAT_UNORM;
    return has;
}

static bool has_floats(const convert_chain *c) {
    for (int i = 0; i < c->count; i++)
        if (c->format[i].kind == DP_FORMAT_FLOAT)
            return true;
    return false;
}

static bool moves_bits(const convert_chain *c) {
    return c->format[0].kind == DP_FORMAT_UNORM && c->format[1].kind == DP_FORMAT_UNORM;
}

/* Into another format of floats than fp32. */
static bool narrows(const convert_chain *c) {
    for (int i = 1; i < c->count; i++)
        if (c->format[i].kind == DP_FORMAT_FLOAT && strcmp(c->format[i].name, "fp32") != 0)
            return true;
    return false;
}

static int read_formats(conversion *a) {
    static const name_list formats = {.get = list_format,
                                      .more = " (or a name from 'depthprec list formats'), unormN or floatE.M[bB]"};
    const asked_line *line = a->o->line;
    for (int i = 0; i < line->operand_count; i++) {
        dp_format found[2];
        const size_t count = dp_format_parse(line->operands[i], found);
        if (count == 0)
            return check_operand(line->command, "FORMAT", &formats, line->operands[i], &(list_item){0});
        if (count > 1 || strcmp(found[0].name, "rg") == 0)
            return usage_error("FORMAT must be one format of one channel, got '%s'", line->operands[i]);
        a->chain.format[a->chain.count++] = found[0];
    }
    a->from = a->chain.format[0].name;
    a->through = a->chain.count > 2 ? a->chain.format[1].name : NULL;
    a->to = a->chain.format[a->chain.count - 1].name;
    return EXIT_FINE;
}

/* Options without effect are refused. */
static int check(const conversion *a) {
    const convert_request *o = a->o;
    const convert_chain *c = &a->chain;
    const convert_way *write = o->write.way;
    if (option_given(o->line, "read") && (!has_integers(c, 0) || (write->moves && moves_bits(c) && !has_floats(c))))
        return option_error("read", "needs a code of integers that is read as a number");
    if (write->moves && !moves_bits(c))
        return option_error("write", "%s needs two formats of integers side by side", write->name);
    if (write->write != NULL && !has_integers(c, 1) && !(write->cuts && o->write.factor == 0 && narrows(c)))
        return option_error("write", "%s needs a format to write that is none of floats", write->name);
    if (o->saturate && (write->write == NULL || !has_integers(c, 1)))
        return option_error("saturate", "needs a --write that computes whole numbers, cut, half or round");
    if (o->flush && !has_floats(c))
        return option_error("flush", "needs a format of floats");
    for (size_t i = 0; i < o->codes.count; i++)
        if (o->codes.list[i] > (double)c->format[0].code_max)
            return option_error("code", "must be codes of %s, 0 to %u, got %.0f", a->from, c->format[0].code_max,
                                o->codes.list[i]);
    return EXIT_FINE;
}

/* ---- What comes of it -------------------------------------------------------------------------------------------- */

static void name_rule(const convert_rule *rule, char out[NAME_SIZE]) {
    if (rule->factor > 0)
        snprintf(out, NAME_SIZE, "%s:%.0f", rule->way->name, rule->factor);
    else
        snprintf(out, NAME_SIZE, "%s", rule->way->name);
}

static double last_code(const convert_chain *c, const convert_path *p) {
    return (double)p->code[c->count - 1];
}

static outcome try(const conversion *a, convert_rule write) {
    convert_chain c = a->chain;
    c.write = write;
    outcome out = {.found = convert_all(&c, a->o->out.threads)};
    const convert_found *f = &out.found;
    const double none = (double)NAN;
    name_rule(&write, out.write);
    out.equal = f->changed == 0;
    out.first = f->changed > 0 ? (double)f->first.code[0] : none;
    out.becomes = f->changed > 0 ? last_code(&c, &f->first) : none;
    out.by = f->by > 0 ? (double)f->by : none;
    out.at = f->by > 0 ? (double)f->most.code[0] : none;
    return out;
}

/* Other ways to write where integers come back: each way, by the largest code and by the number of codes. */
static void find_others(conversion *a) {
    enum { FASTEST = 1 << 25 };
    const dp_format *to = &a->chain.format[a->chain.count - 1];
    if (a->chain.count < CONVERT_FORMATS || strcmp(a->from, a->to) != 0 || to->kind != DP_FORMAT_UNORM ||
        to->code_max >= FASTEST)
        return;
    for (size_t i = 0; convert_write_get(i) != NULL; i++) {
        const convert_way *way = convert_write_get(i);
        if (way->moves && !moves_bits(&a->chain))
            continue;
        a->others[a->other_count++] = (convert_rule){way, 0};
        if (way->scales && !moves_bits(&a->chain))
            a->others[a->other_count++] = (convert_rule){way, (double)to->code_max + 1};
    }
}

static void *next_other(void *of, size_t i) {
    conversion *a = of;
    if (i >= a->other_count)
        return NULL;
    const bool known = a->others[i].way == a->o->write.way && a->others[i].factor == a->o->write.factor;
    a->other = known ? a->asked : try(a, a->others[i]);
    return &a->other;
}

static void *next_code(void *of, size_t i) {
    conversion *a = of;
    const convert_chain *c = &a->chain;
    if (i >= a->o->codes.count)
        return NULL;
    const convert_path p = convert_code(c, (uint32_t)a->o->codes.list[i]);
    a->one = (one_code){.code = p.code[0],
                        .number = p.number,
                        .through = c->count > 2 ? (double)p.code[1] : (double)NAN,
                        .becomes = last_code(c, &p),
                        .beyond = isnan(p.beyond[1]) ? p.beyond[2] : p.beyond[1],
                        .changed = p.changed};
    return &a->one;
}

/* ---- What is reported -------------------------------------------------------------------------------------------- */

static void say_title(page *p, const conversion *a) {
    if (a->through != NULL && strcmp(a->from, a->to) == 0)
        page_title(p, "%s to %s and back: read %s, write %s", a->from, a->through, a->read, a->asked.write);
    else
        page_title(p, "%s to %s%s%s: read %s, write %s", a->from, a->through != NULL ? a->through : "",
                   a->through != NULL ? " to " : "", a->to, a->read, a->asked.write);
}

static void say_order(page *p, const convert_found *f) {
    const char *order = f->swapped == 0 ? "kept" : "broken: a code falls below its neighbour";
    if (f->merged == 0)
        page_note(p, "order", "%s; no two codes become one", order);
    else
        page_note(p, "order", "%s; %llu pair%s of neighbours become%s one code", order, (unsigned long long)f->merged,
                  f->merged == 1 ? "" : "s", f->merged == 1 ? "s" : "");
}

static void say_all(page *p, void *item) {
    const conversion *a = item;
    const outcome *t = &a->asked;
    const bool back = strcmp(a->from, a->to) == 0;
    say_title(p, a);
    if (a->o->codes.count > 0)
        return;
    page_note(p, back ? "changed" : "rounded", "%llu of %llu %s", (unsigned long long)t->found.changed,
              (unsigned long long)t->found.codes, back ? "codes" : "numbers");
    if (!t->equal)
        page_note(p, "first", "%s%.0f becomes %.0f", back ? "" : "code ", t->first, t->becomes);
    if (t->by > 1)
        page_note(p, "most", "by %.0f codes, at %.0f", t->by, t->at);
    if (back)
        page_note(p, "EQUAL", "%s",
                  t->equal ? "holds: a depth drawn again meets its own code"
                           : "fails: a depth drawn again meets another code");
    say_order(p, &t->found);
    if (t->found.beyond > 0)
        page_note(p, "beyond", "%llu number%s no code of %s: %s", (unsigned long long)t->found.beyond,
                  t->found.beyond == 1 ? " has" : "s have", a->to,
                  a->o->saturate ? "stored as the last" : "the low bits are stored; --saturate stores the last");
}

static const column asked_columns[] = {{FIELD(outcome, write, "write", "")},
                                       {FIELD(outcome, found.codes, "codes", "")},
                                       {FIELD(outcome, found.changed, "changed", "")},
                                       {FIELD(outcome, first, "first", "")},
                                       {FIELD(outcome, becomes, "becomes", "")},
                                       {FIELD(outcome, by, "most", "")},
                                       {FIELD(outcome, at, "most_at", "")},
                                       {FIELD(outcome, equal, "equal", "")},
                                       {FIELD(outcome, found.merged, "merged", "")},
                                       {FIELD(outcome, found.swapped, "swapped", "")},
                                       {FIELD(outcome, found.beyond, "beyond", "")},
                                       {.kind = COLUMN_END}};
static const column other_columns[] = {{FIELD(outcome, write, "write", ""), SHOWN("write", -16, 0)},
                                       {FIELD(outcome, found.changed, "changed", ""), SHOWN("changed", 11, 0)},
                                       {FIELD(outcome, first, "first", ""), SHOWN("first", 11, 0)},
                                       {FIELD(outcome, becomes, "becomes", ""), SHOWN("becomes", 11, 0), .spare = 2},
                                       {FIELD(outcome, found.beyond, "beyond", ""), SHOWN("beyond", 8, 0), .spare = 3},
                                       {.kind = COLUMN_END}};
static const column code_columns[] = {{FIELD(one_code, code, "code", ""), SHOWN("code", 11, 0)},
                                      {FIELD(one_code, number, "number", ""), SHOWN("is read as", 22, 0), .spare = 3},
                                      {FIELD(one_code, through, "through", ""), SHOWN("through", 11, 0), .spare = 2},
                                      {FIELD(one_code, becomes, "becomes", ""), SHOWN("becomes", 11, 0)},
                                      {FIELD(one_code, beyond, "beyond", ""), .only = AS_JSON | AS_CSV},
                                      {FIELD(one_code, changed, "changed", ""), SHOWN("changed", 9, 0), .spare = 1},
                                      {.kind = COLUMN_END}};
enum { WITH_ALL = 1, WITH_CODES = 2 };
static const column columns[] = {
    {FIELD(conversion, from, "from", "")},
    {FIELD(conversion, through, "through", "")},
    {FIELD(conversion, to, "to", "")},
    {FIELD(conversion, read, "read", "")},
    {FIELD(conversion, asked.write, "write", ""), .when = WITH_CODES},
    {PART(conversion, asked, NULL, asked_columns), .only = AS_JSON | AS_CSV, .when = WITH_ALL},
    {LIST("ways", other_columns, next_other), .only = AS_TEXT | AS_JSON, .when = WITH_ALL, .indent = 2},
    {LIST("codes", code_columns, next_code), .when = WITH_CODES, .indent = 2},
    {.kind = COLUMN_END}};

int cmd_convert(void *request) {
    const convert_request *o = request;
    conversion a = {.o = o, .chain = {.read = o->read, .write = o->write, .saturate = o->saturate, .flush = o->flush}};
    output out;
    int status = read_formats(&a);
    if (status == EXIT_FINE)
        status = check(&a);
    if (status == EXIT_FINE)
        status = output_start(&o->out, NULL, &out);
    if (status != EXIT_FINE)
        return status;
    name_rule(&o->read, a.read);
    name_rule(&o->write, a.asked.write);
    const bool all = o->codes.count == 0;
    if (all) {
        a.asked = try(&a, o->write);
        find_others(&a);
    }
    report_write(
        &(report_spec){"convert", columns, &a, .when = all ? WITH_ALL : WITH_CODES, .label = 10, .head = say_all}, &out,
        o->out.form);
    return output_close(&out);
}
