/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "method/cmd_methods/methods.h"
#include "judge/cmd_judge/request.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cli/list.h"
#include "core/append.h"
#include "method/choose.h"
#include "report/number.h"

/* The lattice and the pipeline are two questions, each with its choice. */
void list_method_choice(size_t index, double tolerance, char chosen[LIST_TEXT_SIZE]) {
    const method_row *row = method_get(index);
    const method_family_row *family = method_family_get(row->family);
    const double ratio = 1000.0 / 0.1;
    const method_wish wish = {
        .tolerance = tolerance, .ratio_lo = ratio, .ratio_hi = ratio, .pipeline = (row->domain & METHOD_PIPELINE) != 0};
    chosen[0] = '\0';
    for (size_t i = 0; i < family->case_count; i++)
        if (method_choose(family, i, &wish) == row)
            append(chosen, LIST_TEXT_SIZE, "%s%s", *chosen != '\0' ? ", " : "", family->cases[i].name);
}

/* A code does not depend on the mapping; eye depth not on the NDC that window depth has left behind. */
static bool is_of_mapping(const method_family_row *family, const method_case *c, dp_mapping mapping) {
    const dp_mapping_row *row = dp_mapping_get(mapping), *own = dp_mapping_get(c->mapping);
    const bool twin = c->gl && row->curve == own->curve && row->reversed == own->reversed;
    return family->magnitudes || twin || mapping == c->mapping;
}

static bool wanted(const judge_request *o, const method_family_row *family, const method_case *c) {
    dp_format format[2];
    bool formatted = !option_given(o->line, "format"), mapped = !option_given(o->line, "mapping");
    dp_format_parse(c->format, format);
    for (size_t i = 0; i < o->camera.format_count; i++)
        formatted = formatted || strcmp(o->camera.formats[i].name, format[0].name) == 0;
    for (size_t i = 0; i < o->camera.mapping_count; i++)
        mapped = mapped || is_of_mapping(family, c, o->camera.mappings[i]);
    return formatted && mapped;
}

/* Whether a device has a method of a case: one of floating-point operations, from which code is printed. */
static bool is_on_device(const judge_request *o, const method_family_row *family, size_t which) {
    bool has = o->judge.device == NULL || family != &encode_family;
    for (size_t i = 0; i < *family->method_count && !has; i++)
        has = method_speaks(&family->methods[i], which) && family->methods[i].bound != NULL;
    return has;
}

/* Why a camera is none of a family's; the option at fault. */
static int refuse(const judge_request *o, dp_status wrong) {
    const bool ortho = wrong == DP_ERROR_ORTHO || wrong == DP_ERROR_ORTHO_NEAR || wrong == DP_ERROR_INFINITE;
    return option_error(wrong == DP_ERROR_NEAR     ? "near"
                        : o->camera.ortho && ortho ? "ortho"
                                                   : "far",
                        "%s", dp_status_text(wrong));
}

/* An orthographic camera where it makes a difference; claims are of far/near. */
static int check_ortho(const judge_request *o, const method_family_row *family) {
    if (!o->camera.ortho)
        return EXIT_FINE;
    if ((family->besides & METHOD_BESIDE_ORTHO) == 0)
        return option_error("ortho",
                            family->magnitudes ? "has no effect on codes, the family %s"
                                               : "is not for the family %s, whose cameras are perspective",
                            family->name);
    return o->camera.znear > 0
               ? EXIT_FINE
               : option_error("near", "must be greater than 0, got '%s'", number_full(o->camera.znear).text);
}

int methods_resolve(const judge_request *o, const method_family_row *family, methods_asked *out) {
    if (o->judge.mine_count > 0 && family != &linearize_family)
        return option_error("mine", "is for the family linearize, got %s", family->name);
    if (o->judge.device != NULL && family != &linearize_family && family != &encode_family)
        return option_error("device", "is for the families linearize and encode, whose methods GLSL has, got %s",
                            family->name);
    const int status = check_ortho(o, family);
    if (status != EXIT_FINE)
        return status;
    *out = (methods_asked){.family = family};
    char all[NAMES_SIZE] = "";
    bool some = false;
    for (size_t i = family->case_count; i-- > 0;)
        if (wanted(o, family, &family->cases[i])) {
            some = true;
            if (!is_on_device(o, family, i))
                continue;
            out->cases |= 1U << i;
            out->which = i;
        }
    if (some && out->cases == 0)
        return option_error("device", "is for unorm16 and unorm24 of the family encode: GLSL has no method of others");
    for (size_t i = 0; i < family->case_count; i++)
        append(all, sizeof all, "%s%s", i > 0 ? ", " : "", family->cases[i].name);
    if (out->cases == 0)
        return option_error(option_given(o->line, "format") ? "format" : "mapping", "the family %s covers only %s",
                            family->name, all);
    const dp_status wrong =
        method_setup(family, out->which, o->camera.znear, o->camera.zfar, o->camera.ortho, &out->setup);
    return wrong != DP_OK ? refuse(o, wrong) : EXIT_FINE;
}

int methods_single(const judge_request *o, methods_asked *asked) {
    const bool formatted = option_given(o->line, "format"), mapped = option_given(o->line, "mapping");
    char all[NAMES_SIZE] = "";
    size_t count = 0;
    for (size_t i = 0; i < asked->family->case_count; i++)
        if ((asked->cases >> i & 1) != 0)
            append(all, sizeof all, "%s%s", count++ > 0 ? ", " : "", asked->family->cases[i].name);
    if (count > 1 && (formatted || mapped))
        return option_error(formatted ? "format" : "mapping", "must be one of %s; 'plot pareto %s' compares them", all,
                            asked->family->name);
    asked->cases = 1U << asked->which;
    return EXIT_FINE;
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
