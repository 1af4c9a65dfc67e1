/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/cmd/setups.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/depth_range.h"
#include "core/engine.h"
#include "report/message.h"
#include "report/number.h"

int setup_refused(const camera_asked *c, const dp_spec *spec, dp_status status) {
    const dp_mapping_row *row = dp_mapping_get(spec->mapping);
    const bool counted = c->use.counted && row->curve == DP_CURVE_LOG;
    camera_fault fault = {.key = NULL};
    if (camera_range_refused(spec, status, &fault))
        return camera_refuse(&fault);
    if (status == DP_ERROR_MODEL && !option_given(c->line, "model"))
        return option_error("mapping",
                            "must be one of " DP_MAPPING_NAMES_PERSPECTIVE
                            ", which have a pipeline's arithmetic, got %s, whose depth a shader writes",
                            row->name);
    /* Where table is asked, what is counted of that shader is said. */
    camera_refused(spec, status, counted ? " ('guaranteed' counts that shader's log2)" : "", &fault);
    return camera_refuse(&fault);
}

int setup_kept(const camera_asked *c, const dp_format *format) {
    camera_fault fault = {.key = NULL};
    return camera_keeps(&c->said, format, &fault) ? EXIT_FINE : camera_refuse(&fault);
}

/* Refuses what has no budget: terms that the shader of a logarithmic mapping does not have. */
static int check_budget(const camera_asked *c, const dp_spec *spec) {
    static const struct {
        const char *id;
        const char *why;
    } others[] = {{"from-origin", "budget begins with eye depth"},
                  {"linearize", "budget ends with the code"},
                  {"viewport", "budget is of surfaces that face the camera"}};
    static const char leave[] = "leave it out, or take one of " DP_MAPPING_NAMES_PERSPECTIVE;
    const dp_mapping_row *row = dp_mapping_get(spec->mapping);
    if (row->curve == DP_CURVE_LINEAR)
        return option_error("mapping",
                            "a budget needs one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE ", " DP_MAPPING_NAMES_LOG
                            ", got %s",
                            row->name);
    for (size_t i = 0; i < sizeof others / sizeof others[0] && row->curve == DP_CURVE_LOG; i++)
        if (option_given(c->line, others[i].id))
            return option_error(others[i].id, "does not apply to the logarithmic mapping %s, whose %s: %s", row->name,
                                others[i].why, leave);
    return EXIT_FINE;
}

int setup_decided(const camera_asked *c) {
    if (c->platform == NULL || option_given(c->line, "format") || c->format_count < 2)
        return EXIT_FINE;
    return option_error("platform", "stores unorm24 or fp32 on %s, as the device has it: -F says for which",
                        c->platform->name);
}

/* In each depth range. */
static int add_setup(const camera_asked *c, dp_spec *spec, size_t camera, setups *out) {
    dp_status status = DP_OK;
    for (size_t i = 0; status == DP_OK && (i == 0 || i < c->range_count); i++) {
        if (i > 0)
            memcpy(spec->depth_range, c->ranges[i], sizeof spec->depth_range);
        out->cameras[out->count] = camera;
        status = dp_setup_init(&out->items[out->count++], spec);
    }
    if (status != DP_OK)
        return setup_refused(c, spec, status);
    memcpy(spec->depth_range, c->depth_range, sizeof spec->depth_range);
    return EXIT_FINE;
}

static int add_setups(const camera_asked *c, size_t camera, setups *out) {
    dp_spec spec = camera_to_spec(&c->said);
    for (size_t f = 0; f < c->format_count; f++)
        for (size_t m = 0; m < c->mapping_count; m++) {
            const bool rg = dp_format_is_rg(&c->formats[f]); /* linear, whatever the camera's buffer is */
            if (rg && m > 0)
                break;
            spec.format = c->formats[f];
            spec.mapping = rg ? DP_MAPPING_LINEAR : c->mappings[m];
            const bool shader = dp_mapping_get(spec.mapping)->curve == DP_CURVE_LOG;
            spec.model = c->budgeted && shader ? DP_MODEL_EXACT : c->model;
            if (c->budgeted && check_budget(c, &spec) != EXIT_FINE)
                return EXIT_USAGE;
            if (setup_kept(c, &spec.format) != EXIT_FINE || add_setup(c, &spec, camera, out) != EXIT_FINE)
                return EXIT_USAGE;
        }
    return EXIT_FINE;
}

bool setups_have_log(const setups *all) {
    for (size_t i = 0; i < all->count; i++)
        if (all->items[i].curve == DP_CURVE_LOG)
            return true;
    return false;
}

int setups_make(const camera_asked *c, setups *out) {
    const size_t cameras = camera_count(c), ranges = c->range_count > 0 ? c->range_count : 1,
                 most = cameras * CAMERA_FORMATS_MAX * DP_MAPPING_COUNT * ranges;
    int status = EXIT_FINE;
    camera_fault fault = {.key = NULL};
    *out = (setups){.items = malloc(most * sizeof *out->items), .cameras = malloc(most * sizeof *out->cameras)};
    if (out->items == NULL || out->cameras == NULL)
        status = usage_error("no memory for %zu set-ups", most);
    for (size_t i = 0; i < cameras && status == EXIT_FINE; i++)
        status = add_setups(camera_of(c, i), i, out);
    if (status == EXIT_FINE && c->budgeted && option_given(c->line, "log2") && !setups_have_log(out))
        status = option_error("log2", "needs one of the mappings " DP_MAPPING_NAMES_LOG);
    for (camera_key k = CAMERA_ARITH; k <= CAMERA_LOG_C && status == EXIT_FINE; k++)
        if (!camera_serves(&c->said, k, &out->items[0].spec, sizeof out->items[0], out->count, &fault))
            status = camera_refuse(&fault);
    if (status != EXIT_FINE)
        setups_release(out);
    return status;
}

int setups_make_float(const camera_asked *c, setups *out) {
    camera_asked in_float = *c;
    in_float.model = DP_MODEL_FLOAT;
    return setups_make(&in_float, out);
}

void setups_release(setups *s) {
    free(s->items);
    free(s->cameras);
    *s = (setups){0};
}

static const column plane_columns[] = {{FIELD(dp_planes, near_least, "near_least", "scene")},
                                       {FIELD(dp_planes, near_most, "near_most", "scene")},
                                       {FIELD(dp_planes, far_least, "far_least", "scene")},
                                       {FIELD(dp_planes, far_most, "far_most", "scene")},
                                       {.kind = COLUMN_END}};

const column setup_columns[] = {
    {FIELD(setup_fields, znear, "near", "scene")},
    {FIELD(setup_fields, zfar, "far", "scene")},
    {FIELD(setup_fields, projection, "projection", "")},
    {FIELD(setup_fields, mapping, "mapping", "")},
    {FIELD(setup_fields, format, "format", "")},
    {FIELD(setup_fields, rounding, "rounding", "")},
    {FIELD(setup_fields, model, "model", "")},
    {FIELD(setup_fields, arith, "arith", ""), .only = AS_JSON, .optional = true},
    {FIELD(setup_fields, log_c, "log_c", ""), .only = AS_JSON, .optional = true},
    {PART(setup_fields, ends, "depth_range", setup_end_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {FIELD(setup_fields, unit, "unit", ""), .only = AS_JSON},
    {FIELD(setup_fields, preset, "preset", ""), .only = AS_JSON, .optional = true},
    {PART(setup_fields, planes, "planes", plane_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {.kind = COLUMN_END}};

dp_model setup_model(const dp_setup *setup) {
    return dp_is_computed(setup) ? DP_MODEL_FLOAT : setup->spec.model;
}

void setup_fields_budget(const dp_setup *setup, setup_fields *fields) {
    fields->model = dp_model_name(DP_MODEL_FLOAT);
    fields->arith = dp_arith_get(setup->spec.arith)->name;
}

setup_fields setup_fields_of(const dp_setup *setup, const char *unit) {
    const dp_spec *spec = &setup->spec;
    setup_fields f = {.znear = spec->znear,
                      .zfar = spec->zfar,
                      .log_c = camera_has(spec, CAMERA_LOG_C) ? spec->log_c : (double)NAN,
                      .projection = spec->ortho ? "orthographic" : "perspective",
                      .mapping = dp_mapping_get(spec->mapping)->name,
                      .format = spec->format.name,
                      .rounding = dp_rounding_name(spec->rounding),
                      .model = dp_model_name(spec->model),
                      .ends = setup_ends(spec),
                      .unit = unit};
    if (setup_model(setup) == DP_MODEL_FLOAT)
        setup_fields_budget(setup, &f);
    return f;
}

setup_fields setup_fields_asked(const dp_setup *setup, const camera_asked *c) {
    setup_fields f = setup_fields_of(setup, camera_unit(c));
    if (setup->spec.znear == c->matrix.taken.znear && setup->spec.zfar == c->matrix.taken.zfar)
        f.planes = camera_matrix_left_open(&c->matrix);
    return f;
}

number_text setup_near(const setup_fields *f) {
    return f->planes == NULL ? number_full(f->znear) : number_brief(number_of(f->znear, f->planes->near_digits));
}

number_text setup_far(const setup_fields *f) {
    return f->planes == NULL ? number_full(f->zfar) : number_brief(number_of(f->zfar, f->planes->far_digits));
}

const char *setup_label_as(const dp_setup *setup, const setup_fields *f, char out[SETUP_LABEL_SIZE]) {
    const bool has_log_c = !isnan(f->log_c), has_arith = f->arith != NULL; /* only the model float has one */
    char range[SETUP_RANGE_SIZE];
    snprintf(out, SETUP_LABEL_SIZE, "%s %s%s%s, near %s, far %s, %s%s, %s, %s%s%s", f->format, f->mapping,
             has_log_c ? " C " : "", has_log_c ? number_full(f->log_c).text : "", setup_near(f).text, setup_far(f).text,
             f->projection, setup_range(f, range), f->rounding,
             option_word("model", has_arith ? DP_MODEL_FLOAT : setup->spec.model), has_arith ? " " : "",
             has_arith ? f->arith : "");
    return out;
}

const char *setup_label(const dp_setup *setup, bool full, char out[SETUP_LABEL_SIZE]) {
    const setup_fields f = setup_fields_of(setup, NULL);
    if (full)
        return setup_label_as(setup, &f, out);
    snprintf(out, SETUP_LABEL_SIZE, "%s %s", f.format, f.mapping);
    return out;
}

static number_text as_given(const void *of, double value, int digits) {
    return lengths_text(of, value, digits);
}

void camera_page(page *p, const camera_asked *c) {
    p->unit = camera_unit(c);
    p->as_given = as_given;
    p->lengths = &c->lengths;
}

double camera_focus(const camera_asked *c) {
    char error[PRESET_ERROR_SIZE];
    preset_camera made;
    if (c->preset_count != 1 || !preset_make(c->presets[0], &c->values[0], &made, error))
        return (double)NAN;
    return unit_convert(made.focus, unit_find(c->presets[0]->unit), c->lengths.unit);
}

void camera_say_focus(page *p, const camera_asked *c) {
    const double focus = camera_focus(c);
    if (!isnan(focus))
        page_title(p, "%s looks at z = %s", c->values[0].words, camera_length(c, focus, 6).text);
}

void setup_title(page *p, const dp_setup *setup, const setup_fields *fields) {
    char label[SETUP_LABEL_SIZE];
    const char *engine = fields->preset, *unit = fields->unit;
    p->unit = unit;
    page_title(p, "%s%s%s%s%s", engine != NULL ? engine : "", engine != NULL ? ": " : "",
               setup_label_as(setup, fields, label), unit != NULL ? ", lengths in " : "", unit != NULL ? unit : "");
    setup_say_planes(p, fields);
}

void setup_say_planes(page *p, const setup_fields *fields) {
    const dp_planes *at = fields->planes;
    char far[2 * NUMBER_SIZE + 16] = "";
    if (at == NULL)
        return;
    if (at->far_least < at->far_most)
        snprintf(far, sizeof far, ", far %s to %s", number_down(at->far_least, 6).text,
                 number_up(at->far_most, 6).text);
    page_note(
        p, "planes",
        "near is %s to %s%s: the entries of --matrix carry no more digits; the numbers here take them as they are",
        number_down(at->near_least, 9).text, number_up(at->near_most, 9).text, far);
}

void setup_say_code(page *p, const dp_spec *spec) {
    const dp_mapping_row *mapping = dp_mapping_get(spec->mapping);
    char range[SETUP_RANGE_SIZE];
    if (mapping->curve == DP_CURVE_PERSPECTIVE && !spec->ortho)
        page_note(p, "code", "depthprec code%s -n %s -f %s -m %s", setup_range_option(spec, range),
                  number_full(spec->znear).text, number_full(spec->zfar).text, mapping->name);
}

clipping clipping_of(const dp_setup *setup) {
    dp_pipeline p;
    float znear;
    float zfar;
    if (setup->spec.model != DP_MODEL_FLOAT || dp_pipeline_init(&p, setup) != DP_OK)
        return (clipping){(double)NAN, (double)NAN, false};
    dp_pipeline_planes(&p, &znear, &zfar);
    return (clipping){(double)znear, (double)zfar, !(znear == p.znear && zfar == p.zfar)};
}

void clipping_say(const dp_setup *setup, double znear, double zfar, const char *rest) {
    char label[SETUP_LABEL_SIZE];
    setup_label(setup, false, label);
    if (isnan(znear))
        message("depthprec: warning: %s: clipping in binary32 removes everything", label);
    else
        message("depthprec: warning: %s: clipping in binary32 keeps only %s to %s%s", label, number_up(znear, 9).text,
                number_down(zfar, 9).text, rest);
}

void clipping_warn(const setups *all) {
    for (size_t i = 0; i < all->count; i++) {
        const clipping c = clipping_of(&all->items[i]);
        if (c.loses && !setup_repeats(all, i)) /* a depth range comes after clipping */
            clipping_say(&all->items[i], c.znear, c.zfar, "");
    }
}
