/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/cmd_methods/families.h"

#include <math.h>
#include <stdio.h>

#include "method/advice.h"
#include "method/cmd_methods/methods.h"
#include "report/report.h"

/* A family in a line: in the first of its cases in which a method keeps what it claims, which to use, and the next. */
typedef struct family_line {
    const char *name, *summary, *measure, *of_case;
    uint64_t methods;
    char label[40];                 /* "linearize fp32 d3d" */
    const char *use, *next;         /* null: there is none */
    double ns, error, slower, gain; /* the next takes so many times the time, for so many times less error */
} family_line;

typedef struct all_families {
    const judge_request *o;
    char machine[192];
    family_line lines[METHOD_FAMILY_COUNT];
} all_families;

/* @return false when out of memory */
static bool advise(const all_families *all, const method_family_row *f, family_line *l) {
    bench_result results[BENCH_METHODS_MAX];
    size_t which;
    *l = (family_line){.name = f->name, .summary = f->summary, .measure = f->measure, .methods = *f->method_count};
    const size_t count = advice_case(f, all->o->camera.znear, all->o->camera.zfar, &which, results);
    if (count == 0)
        return false;
    const bench_result *use = advice_use(f, results, count), *next = advice_next(f, results, count, use);
    l->of_case = f->cases[which].name;
    const double error = use != NULL ? measured_error(f, &use->measured) : (double)NAN;
    l->use = use != NULL ? use->row->name : NULL;
    l->next = next != NULL ? next->row->name : NULL;
    l->ns = use != NULL ? use->ns : (double)NAN;
    l->error = error;
    l->slower = next != NULL ? next->ns / l->ns : (double)NAN;
    l->gain = next != NULL ? error / measured_error(f, &next->measured) : (double)NAN;
    snprintf(l->label, sizeof l->label, "%s %s", l->name, l->of_case != NULL ? l->of_case : "");
    return true;
}

static void *next_family(void *of, size_t i) {
    all_families *all = of;
    return i < METHOD_FAMILY_COUNT ? &all->lines[i] : NULL;
}

static void say_families(page *p, void *of) {
    const all_families *all = of;
    page_title(p, "The method to use of each family");
    page_text(p, "near %s, far %s; %s", number_full(all->o->camera.znear).text, number_full(all->o->camera.zfar).text,
              all->machine);
}

static void say_next(page *p, void *of) {
    const all_families *all = of;
    page_line(p, "use: the fastest that leaves four digits, or the right code or the one beside it; ns: per element; "
                 "then: the next with at most half its error, for so many times the time and by how much less");
    page_line(p, "depthprec methods FAMILY compares all methods of one:");
    for (size_t i = 0; i < METHOD_FAMILY_COUNT; i++)
        page_note(p, all->lines[i].name, "%s (%llu methods)", all->lines[i].summary,
                  (unsigned long long)all->lines[i].methods);
}

static const column family_columns[] = {{FIELD(family_line, name, "name", ""), .only = AS_JSON | AS_CSV},
                                        {FIELD(family_line, summary, "note", ""), .only = AS_JSON | AS_CSV},
                                        {FIELD(family_line, measure, "measure", ""), .only = AS_JSON | AS_CSV},
                                        {FIELD(family_line, methods, "methods", ""), .only = AS_JSON | AS_CSV},
                                        {FIELD(family_line, of_case, "case", ""), .only = AS_JSON | AS_CSV},
                                        {TEXT_FIELD(family_line, label, "family", -22, 0)},
                                        {FIELD(family_line, use, "use", ""), SHOWN("use", -18, 0)},
                                        {FIELD(family_line, ns, "ns", ""), SHOWN("ns", 7, 2)},
                                        {FIELD(family_line, error, "error", ""), SHOWN("error", 8, 2), .upward = true},
                                        {FIELD(family_line, next, "next", ""), SHOWN("then", -11, 0)},
                                        {FIELD(family_line, slower, "slower", ""), SHOWN("x time", 7, 2)},
                                        {FIELD(family_line, gain, "gain", ""), SHOWN("/ error", 8, 2)},
                                        {.kind = COLUMN_END}};

static const column families[] = {{FIELD(all_families, machine, "machine", ""), .only = AS_JSON},
                                  {LIST("families", family_columns, next_family)},
                                  {.kind = COLUMN_END}};

int families_write(const judge_request *o, output *out) {
    all_families all = {.o = o};
    methods_machine(all.machine, sizeof all.machine);
    for (size_t i = 0; i < METHOD_FAMILY_COUNT; i++)
        if (!advise(&all, method_family_get(i), &all.lines[i])) {
            output_abandon(out);
            return usage_error("no memory for the methods");
        }
    report_write(&(report_spec){"methods", families, &all, .label = 12, .head = say_families, .notes = say_next}, out,
                 o->out.form);
    return output_close(out);
}
