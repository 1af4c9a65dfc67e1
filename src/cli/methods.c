/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/methods.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cli/list.h"
#include "cli/setups.h"
#include "method/choose.h"
#include "report/append.h"
#include "report/number.h"

static const double formula_at = 1e4; /* where a claim that is a formula is shown */

bool list_method(size_t index, list_item *item) {
    const method_row *row = method_get(index);
    if (row == NULL)
        return false;
    const method_family_row *family = method_family_get(row->family);
    *item = (list_item){.name = row->name, .aliases = family->name, .note = row->note, .source = row->source};
    for (size_t i = 0; i < family->case_count; i++) {
        const method_claim *c = &row->claims[i];
        char worst[NUMBER_SIZE] = "nothing", hi[NUMBER_SIZE];
        if (!method_speaks(row, i))
            continue;
        if (!isnan(c->worst))
            number_digits(method_claim_at(c, fmin(formula_at, c->ratio_hi)), 3, worst);
        number_digits(c->ratio_hi, 3, hi);
        append(item->bound, sizeof item->bound, "%s%s %s", *item->bound != '\0' ? "; " : "", family->cases[i].name,
               worst);
        if (c->formula != NULL)
            append(item->bound, sizeof item->bound, " at far/near 10000");
        if (!isnan(c->worst) && c->ratio_hi < METHOD_RATIO_HI)
            append(item->bound, sizeof item->bound, " to far/near %s", hi);
    }
    return true;
}

/* The lattice and the pipeline are two questions, each with its choice. */
void list_method_choice(const options *o, size_t index, char chosen[LIST_TEXT_SIZE]) {
    const method_row *row = method_get(index);
    const method_family_row *family = method_family_get(row->family);
    const double ratio = o->zfar / o->znear;
    const method_wish wish = {.tolerance = o->tolerance,
                              .ratio_lo = ratio,
                              .ratio_hi = ratio,
                              .pipeline = (row->domain & METHOD_PIPELINE) != 0};
    chosen[0] = '\0';
    for (size_t i = 0; i < family->case_count; i++)
        if (method_choose(family, i, &wish) == row)
            append(chosen, LIST_TEXT_SIZE, "%s%s", *chosen != '\0' ? ", " : "", family->cases[i].name);
}

bool list_family(size_t index, list_item *item) {
    const method_family_row *row = method_family_get(index);
    if (row != NULL)
        *item = (list_item){.name = row->name, .note = row->summary, .row = row};
    return row != NULL;
}

static bool wanted(const options *o, const method_case *c) {
    dp_format format[2];
    bool formatted = !option_given(o, OPTION_FORMAT), mapped = !option_given(o, OPTION_MAPPING);
    dp_format_parse(c->format, format);
    for (size_t i = 0; i < o->format_count; i++)
        formatted = formatted || strcmp(o->formats[i].name, format[0].name) == 0;
    for (size_t i = 0; i < o->mapping_count; i++)
        mapped = mapped || o->mappings[i] == c->mapping;
    return formatted && mapped;
}

int methods_resolve(const options *o, const method_family_row *family, methods_asked *out) {
    out->family = family;
    char all[NAMES_SIZE] = "";
    for (size_t i = 0; i < out->family->case_count; i++) {
        if (wanted(o, &out->family->cases[i])) {
            out->which = i;
            dp_status wrong = method_setup(out->family, i, o->znear, o->zfar, false, &out->setup);
            if (wrong != DP_OK)
                return option_error(wrong == DP_ERROR_NEAR ? OPTION_NEAR : OPTION_FAR, "%s", dp_status_text(wrong));
            return EXIT_FINE;
        }
        append(all, sizeof all, "%s%s", i > 0 ? ", " : "", out->family->cases[i].name);
    }
    return option_error(option_given(o, OPTION_FORMAT) ? OPTION_FORMAT : OPTION_MAPPING,
                        "the family %s has %s, and not what was given", out->family->name, all);
}

const char *methods_machine(char *out, size_t size) {
    char line[256], name[128] = "unknown processor";
    FILE *f = fopen("/proc/cpuinfo", "r");
    while (f != NULL && fgets(line, sizeof line, f) != NULL)
        if (strncmp(line, "model name", 10) == 0 && strchr(line, ':') != NULL) {
            snprintf(name, sizeof name, "%s", strchr(line, ':') + 2);
            name[strcspn(name, "\n")] = '\0';
            break;
        }
    if (f != NULL)
        fclose(f);
    const char *epoch = getenv("SOURCE_DATE_EPOCH");
    time_t now = epoch != NULL ? (time_t)strtoll(epoch, NULL, 10) : time(NULL);
    struct tm day;
    char date[32] = "";
    if (gmtime_r(&now, &day) != NULL)
        strftime(date, sizeof date, ", %Y-%m-%d", &day);
    snprintf(out, size, "%s%s", name, date);
    return out;
}

/* ---- Figures ----------------------------------------------------------------------------------------------------- */

/* One block for all arrays; they lie behind one another in it. */
typedef struct arrays {
    const char *names[STABILITY_MAX];
    double ns[STABILITY_MAX], claimed[STABILITY_MAX], breaks[STABILITY_MAX], ratios[STABILITY_STEPS_MAX];
    double errors[STABILITY_MAX * STABILITY_STEPS_MAX];
    bool front[STABILITY_MAX];
    int group[STABILITY_MAX];
    char text[STABILITY_MAX][64];
    bench_result bench[BENCH_METHODS_MAX];
    stability_result walk[STABILITY_MAX];
} arrays;

static size_t fill_bench(const methods_asked *asked, arrays *a) {
    size_t count = bench_run(asked->family, asked->which, &asked->setup, METHODS_REPETITIONS, a->bench);
    for (size_t i = 0; i < count; i++) {
        a->group[i] = (a->bench[i].row->domain & METHOD_PIPELINE) != 0;
        snprintf(a->text[i], sizeof a->text[i], "%s%s", a->bench[i].row->name, a->group[i] ? " (pipeline)" : "");
        a->names[i] = a->text[i];
        a->ns[i] = a->bench[i].ns;
        a->errors[i] = measured_error(asked->family, &a->bench[i].measured);
        a->front[i] = a->bench[i].front;
    }
    return count;
}

/* Case by case, so that what can be compared stands together. */
static size_t fill_walk(const method_family_row *family, arrays *a, size_t *steps) {
    size_t all = stability_run(family, a->walk), count = 0;
    *steps = all > 0 ? (size_t)a->walk[0].steps : 0;
    for (size_t which = 0; which < family->case_count; which++)
        for (size_t i = 0; i < all; i++) {
            const stability_result *r = &a->walk[i];
            if (r->which != which)
                continue;
            const method_claim *c = &r->row->claims[which];
            snprintf(a->text[count], sizeof a->text[count], "%s, %s", r->row->name, family->cases[which].name);
            a->names[count] = a->text[count];
            a->claimed[count] = isnan(c->worst) ? (double)NAN : c->ratio_hi;
            a->breaks[count] = r->breaks;
            for (size_t k = 0; k < *steps; k++) {
                a->ratios[k] = r->ratio[k];
                a->errors[count * *steps + k] = r->error[k];
            }
            count++;
        }
    return count;
}

int methods_figure_make(const options *o, bool times, const char *family, methods_figure *out, char *subtitle,
                        size_t size) {
    methods_asked asked;
    list_item item;
    const name_list families = {.get = list_family};
    int status = check_operand(o->verb, "FAMILY", &families,
                               family != NULL ? family
                               : times        ? "interval"
                                              : "linearize",
                               &item);
    *out = (methods_figure){0};
    if (status == EXIT_FINE)
        status = methods_resolve(o, item.row, &asked);
    if (status != EXIT_FINE)
        return status;
    arrays *a = calloc(1, sizeof *a);
    *out = (methods_figure){.memory = a};
    if (a == NULL)
        return usage_error("no memory for the methods");
    size_t steps = 0, count = times ? fill_bench(&asked, a) : fill_walk(asked.family, a, &steps);
    if (count == 0)
        return usage_error("no memory for the methods");
    out->shown = (figure_methods){.measure = asked.family->measure,
                                  .count = count,
                                  .names = a->names,
                                  .ns = a->ns,
                                  .errors = a->errors,
                                  .group = a->group,
                                  .front = a->front,
                                  .steps = steps,
                                  .ratios = a->ratios,
                                  .claimed = a->claimed,
                                  .breaks = a->breaks};
    char machine[192], znear[NUMBER_SIZE], zfar[NUMBER_SIZE];
    number_shortest(o->znear, znear);
    number_shortest(o->zfar, zfar);
    if (times)
        snprintf(subtitle, size, "%s: %s; %s, near %s, far %s; %s", asked.family->name, asked.family->summary,
                 asked.family->cases[asked.which].name, znear, zfar, methods_machine(machine, sizeof machine));
    else
        snprintf(subtitle, size, "%s: %s; worst %s over near 1e-12, 0.1 and 1e6", asked.family->name,
                 asked.family->summary, asked.family->measure);
    return EXIT_FINE;
}

void methods_figure_free(methods_figure *f) {
    free(f->memory);
    *f = (methods_figure){0};
}
