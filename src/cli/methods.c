/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/methods.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cli/list.h"
#include "cli/setups.h"
#include "cli/suggest.h"
#include "method/choose.h"
#include "report/number.h"

static const double formula_at = 1e4; /* where a claim that is a formula is shown */

bool list_method(size_t index, list_item *item) {
    const method_row *row = method_get(index);
    if (row == NULL)
        return false;
    const method_family_row *family = method_family_get(row->family);
    *item = (list_item){.name = row->name, .aliases = family->name, .note = row->note, .source = row->source};
    size_t used = 0;
    for (size_t i = 0; i < family->case_count && used < sizeof item->bound; i++) {
        const method_claim *c = &row->claims[i];
        char worst[NUMBER_SIZE] = "nothing", hi[NUMBER_SIZE];
        if (!method_speaks(row, i))
            continue;
        if (!isnan(c->worst))
            number_digits(method_claim_at(c, fmin(formula_at, c->ratio_hi)), 3, worst);
        number_digits(c->ratio_hi, 3, hi);
        const char *between = used > 0 ? "; " : "";
        used += (size_t)snprintf(item->bound + used, sizeof item->bound - used, "%s%s %s", between,
                                 family->cases[i].name, worst);
        if (c->formula != NULL && used < sizeof item->bound)
            used += (size_t)snprintf(item->bound + used, sizeof item->bound - used, " at far/near 10000");
        if (!isnan(c->worst) && c->ratio_hi < METHOD_RATIO_HI && used < sizeof item->bound)
            used += (size_t)snprintf(item->bound + used, sizeof item->bound - used, " to far/near %s", hi);
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
    size_t used = 0;
    chosen[0] = '\0';
    for (size_t i = 0; i < family->case_count; i++)
        if (method_choose(family, i, &wish) == row)
            used += (size_t)snprintf(chosen + used, LIST_TEXT_SIZE - used, "%s%s", used > 0 ? ", " : "",
                                     family->cases[i].name);
}

int methods_family(const options *o, const char *name, const method_family_row **out) {
    suggestion s = suggest_start(name);
    char text[SUGGEST_TEXT_SIZE], all[128] = "";
    *out = method_family_find(name);
    for (size_t i = 0; method_family_get(i) != NULL && *out == NULL; i++) {
        suggest_offer(&s, method_family_get(i)->name);
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", i > 0 ? ", " : "", method_family_get(i)->name);
    }
    if (*out == NULL)
        return usage_error("%s: FAMILY must be one of %s, got '%s'%s", o->verb->name, all, name,
                           suggest_text(&s, "", text));
    return EXIT_FINE;
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

int methods_resolve(const options *o, const char *name, methods_asked *out) {
    int status = methods_family(o, name, &out->family);
    if (status != EXIT_FINE)
        return status;
    char all[128] = "";
    for (size_t i = 0; i < out->family->case_count; i++) {
        if (wanted(o, &out->family->cases[i])) {
            out->which = i;
            dp_status wrong = method_setup(out->family, i, o->znear, o->zfar, false, &out->setup);
            if (wrong != DP_OK)
                return option_error(wrong == DP_ERROR_NEAR ? OPTION_NEAR : OPTION_FAR, "%s", dp_status_text(wrong));
            return EXIT_FINE;
        }
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", i > 0 ? ", " : "", out->family->cases[i].name);
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
