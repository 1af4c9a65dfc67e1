/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/setups.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "report/number.h"

/* Which option is at fault. */
static const option_id culprits[DP_STATUS_COUNT] = {
    [DP_ERROR_NEAR] = OPTION_NEAR,         [DP_ERROR_FAR] = OPTION_FAR,         [DP_ERROR_PLANES] = OPTION_FAR,
    [DP_ERROR_INFINITE] = OPTION_FAR,      [DP_ERROR_ORTHO] = OPTION_ORTHO,     [DP_ERROR_LOG_C] = OPTION_LOG_C,
    [DP_ERROR_FORMAT] = OPTION_FORMAT,     [DP_ERROR_MAPPING] = OPTION_MAPPING, [DP_ERROR_MODEL] = OPTION_MODEL,
    [DP_ERROR_ROUNDING] = OPTION_ROUNDING,
};

static int refused(const options *o, const dp_spec *spec, dp_status status) {
    char znear[NUMBER_SIZE];
    char zfar[NUMBER_SIZE];
    char log_c[NUMBER_SIZE];
    char got[4 * NUMBER_SIZE];
    number_shortest(spec->znear, znear);
    number_shortest(spec->zfar, zfar);
    number_shortest(spec->log_c, log_c);
    const char *mapping = dp_mapping_get(spec->mapping)->name;
    const char *projection = spec->ortho ? "orthographic" : "perspective";
    option_id id = culprits[status];
    switch (status) {
    case DP_ERROR_NEAR:
        snprintf(got, sizeof got, "%s", znear);
        break;
    case DP_ERROR_FAR:
    case DP_ERROR_PLANES:
        snprintf(got, sizeof got, "near %s, far %s", znear, zfar);
        break;
    case DP_ERROR_LOG_C:
        snprintf(got, sizeof got, "%s", log_c);
        break;
    case DP_ERROR_INFINITE:
    case DP_ERROR_ORTHO:
        snprintf(got, sizeof got, "%s, %s", projection, mapping);
        break;
    case DP_ERROR_MODEL: /* of the models that have a name, fp32 alone is not for all */
        id = option_given(o, OPTION_MODEL) ? OPTION_MODEL : OPTION_MAPPING;
        return option_error(id, "%s needs one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE ", got %s",
                            id == OPTION_MODEL ? "fp32" : "binary32 arithmetic", mapping);
    default:
        snprintf(got, sizeof got, "%s %s", spec->format.name, mapping);
    }
    /* "--near: must be ..." rather than "--near: near must be ...". */
    const char *text = dp_status_text(status);
    size_t length = strlen(option_name(id));
    if (strncmp(text, option_name(id), length) == 0 && text[length] == ' ')
        text += length + 1;
    return option_error(id, "%s, got %s", text, got);
}

int setups_make(const options *o, setups *out) {
    out->count = 0;
    out->items = malloc(o->format_count * o->mapping_count * sizeof *out->items);
    if (out->items == NULL)
        return usage_error("no memory for %zu set-ups", o->format_count * o->mapping_count);
    dp_spec spec = {.znear = o->znear,
                    .zfar = o->zfar,
                    .ortho = o->ortho,
                    .rounding = o->rounding,
                    .model = o->model,
                    .arith = o->arith,
                    .log_c = o->log_c};
    for (size_t f = 0; f < o->format_count; f++)
        for (size_t m = 0; m < o->mapping_count; m++) {
            spec.format = o->formats[f];
            spec.mapping = o->mappings[m];
            dp_status status = dp_setup_init(&out->items[out->count++], &spec);
            if (status != DP_OK) {
                setups_release(out);
                return refused(o, &spec, status);
            }
        }
    return EXIT_FINE;
}

void setups_release(setups *s) {
    free(s->items);
    s->items = NULL;
    s->count = 0;
}

const char *setup_projection(const dp_setup *setup) {
    return setup->spec.ortho ? "orthographic" : "perspective";
}

const column setup_columns[] = {{FIELD(setup_fields, znear, "near", "scene")},
                                {FIELD(setup_fields, zfar, "far", "scene")},
                                {FIELD(setup_fields, projection, "projection", "")},
                                {FIELD(setup_fields, mapping, "mapping", "")},
                                {FIELD(setup_fields, format, "format", "")},
                                {FIELD(setup_fields, rounding, "rounding", "")},
                                {FIELD(setup_fields, model, "model", "")},
                                {FIELD(setup_fields, arith, "arith", ""), .only = AS_JSON, .optional = true},
                                {FIELD(setup_fields, log_c, "log_c", ""), .only = AS_JSON, .optional = true},
                                {.kind = COLUMN_END}};

setup_fields setup_fields_of(const dp_setup *setup) {
    const dp_spec *spec = &setup->spec;
    return (setup_fields){.znear = spec->znear,
                          .zfar = spec->zfar,
                          .log_c = spec->mapping == DP_MAPPING_LOG ? spec->log_c : (double)NAN,
                          .projection = setup_projection(setup),
                          .mapping = dp_mapping_get(spec->mapping)->name,
                          .format = spec->format.name,
                          .rounding = dp_rounding_name(spec->rounding),
                          .model = dp_model_name(spec->model),
                          .arith = spec->model == DP_MODEL_FP32 ? dp_arith_get(spec->arith)->name : NULL};
}

void setup_json(json *j, const dp_setup *setup) {
    const dp_spec *spec = &setup->spec;
    json_number(j, "near", spec->znear);
    json_number(j, "far", spec->zfar);
    json_string(j, "projection", setup_projection(setup));
    json_string(j, "mapping", dp_mapping_get(spec->mapping)->name);
    json_string(j, "format", spec->format.name);
    json_string(j, "rounding", dp_rounding_name(spec->rounding));
    json_string(j, "model", dp_model_name(spec->model));
    if (spec->model == DP_MODEL_FP32)
        json_string(j, "arith", dp_arith_get(spec->arith)->name);
    if (spec->mapping == DP_MAPPING_LOG)
        json_number(j, "log_c", spec->log_c);
}

void setup_csv_head(csv *c) {
    static const char *const heads[] = {"near [scene]", "far [scene]", "projection", "mapping",
                                        "format",       "rounding",    "model"};
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        csv_string(c, heads[i]);
}

void setup_csv(csv *c, const dp_setup *setup) {
    const dp_spec *spec = &setup->spec;
    csv_number(c, spec->znear);
    csv_number(c, spec->zfar);
    csv_string(c, setup_projection(setup));
    csv_string(c, dp_mapping_get(spec->mapping)->name);
    csv_string(c, spec->format.name);
    csv_string(c, dp_rounding_name(spec->rounding));
    csv_string(c, dp_model_name(spec->model));
}

const char *setup_label(const dp_setup *setup, bool full, char out[SETUP_LABEL_SIZE]) {
    const dp_spec *spec = &setup->spec;
    const char *mapping = dp_mapping_get(spec->mapping)->name;
    int length = snprintf(out, SETUP_LABEL_SIZE, "%s %s", spec->format.name, mapping);
    if (!full)
        return out;
    char znear[NUMBER_SIZE];
    char zfar[NUMBER_SIZE];
    char log_c[NUMBER_SIZE + 4] = "";
    number_shortest(spec->znear, znear);
    number_shortest(spec->zfar, zfar);
    if (spec->mapping == DP_MAPPING_LOG)
        number_shortest(spec->log_c, log_c + sprintf(log_c, " C "));
    const bool arith = spec->model == DP_MODEL_FP32;
    snprintf(out + length, SETUP_LABEL_SIZE - (size_t)length, "%s, near %s, far %s, %s, %s, %s%s%s", log_c, znear, zfar,
             setup_projection(setup), dp_rounding_name(spec->rounding), dp_model_name(spec->model), arith ? " " : "",
             arith ? dp_arith_get(spec->arith)->name : "");
    return out;
}
