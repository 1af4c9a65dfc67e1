/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cameras of a requirement file. */
#include <math.h>
#include <string.h>

#include "camera/unit.h"
#include "core/append.h"
#include "quantity/quantity.h"
#include "raster/raster.h"
#include "solve/model.h"
#include "solve/reader.h"

enum {
    KEY_PRESET,
    KEY_NEAR,
    KEY_FAR,
    KEY_MAPPING,
    KEY_FORMAT,
    KEY_ORTHO,
    KEY_ROUNDING,
    KEY_MODEL,
    KEY_ARITH,
    KEY_LOG_C,
    KEY_FROM_ORIGIN,
    KEY_SCHEME,
    KEY_VIEW,
    KEY_COUNT = KEY_VIEW + VIEW_COUNT
};

static const char *const keys[KEY_COUNT + 1] = {"preset",      "near",     "far",     "mapping", "format",
                                                "ortho",       "rounding", "model",   "arith",   "log_c",
                                                "from_origin", "scheme",   VIEW_KEYS, NULL};

typedef struct draft {
    dp_spec spec;
    dp_format formats[NEED_SETUPS_MAX];
    size_t format_count;
    bool automatic;
    const preset *preset; /* null: none */
} draft;

/* The index of a name, or -1. */
static int index_of(const char *text, const char *(*name)(size_t)) {
    for (size_t i = 0; name(i) != NULL; i++)
        if (strcmp(name(i), text) == 0)
            return (int)i;
    return -1;
}

/* The same after an error that lists the names. */
static int among(reader *r, const setting *s, const char *text, const char *(*name)(size_t)) {
    const int index = index_of(text, name);
    if (index >= 0)
        return index;
    char all[NEED_TEXT_SIZE / 2] = "";
    for (size_t i = 0; name(i) != NULL; i++) {
        reader_known(r, text, name(i));
        append(all, sizeof all, "%s%s", i > 0 ? ", " : "", name(i));
    }
    reader_fail(r, s, "%s: must be one of %s, got '%.40s'", s->name, all, text);
    return -1;
}

static int word_among(reader *r, const setting *s, const char *(*name)(size_t)) {
    const char *text;
    return reader_string(r, s, &text) ? among(r, s, text, name) : -1;
}

static const char *rounding_name(size_t i) {
    return dp_rounding_name((dp_rounding)i);
}

static const char *arith_name(size_t i) {
    return i < dp_arith_count() ? dp_arith_get(i)->name : NULL;
}

static bool has_arith(const char *name) {
    return index_of(name, arith_name) >= 0;
}

static int read_arith(reader *r, const setting *s, need_camera *out) {
    char name[PROFILE_NAME_SIZE];
    return reader_row(r, s, "arith", has_arith, out, name) ? among(r, s, name, arith_name) : -1;
}

static const char *preset_name(size_t i) {
    return preset_get(i) != NULL ? preset_get(i)->name : NULL;
}

static bool read_preset(reader *r, const setting *s, draft *d) {
    const int index = word_among(r, s, preset_name);
    if (index < 0)
        return false;
    const preset *row = preset_get((size_t)index);
    d->preset = row;
    /* Where the file says what its scene unit is, a preset in metres is converted into it. */
    preset_planes(row, r->unit, &d->spec.znear, &d->spec.zfar, &d->spec.log_c);
    d->spec.mapping = row->mapping;
    d->format_count = dp_format_parse(row->format, d->formats);
    return true;
}

static bool read_mapping(reader *r, const setting *s, draft *d) {
    const char *text;
    if (!reader_string(r, s, &text))
        return false;
    if (dp_mapping_parse(text, &d->spec.mapping) == DP_OK)
        return true;
    for (int i = 0; i < DP_MAPPING_COUNT; i++) {
        reader_known(r, text, dp_mapping_get((dp_mapping)i)->name);
        reader_known(r, text, dp_mapping_get((dp_mapping)i)->aliases);
    }
    return reader_fail(r, s, "mapping: must be one of " DP_MAPPING_NAMES ", got '%.40s'", text);
}

static bool read_format(reader *r, const setting *s, draft *d) {
    const char *text;
    if (!reader_string(r, s, &text))
        return false;
    d->format_count = dp_format_parse(text, d->formats);
    if (d->format_count > 0)
        return true;
    for (size_t i = 0; i < dp_format_count(); i++) {
        reader_known(r, text, dp_format_get(i)->format.name);
        reader_known(r, text, dp_format_get(i)->aliases);
    }
    return reader_fail(r, s, "format: must be a depth format as 'depthprec list formats' names them, got '%.40s'",
                       text);
}

static bool read_ortho(reader *r, const setting *s, draft *d) {
    if (s->kind != SETTING_WORD)
        return reader_fail(r, s, "ortho: must be true or false, got %s", reader_shown(r, s));
    d->spec.ortho = s->number != 0.0;
    return true;
}

static bool read_words(reader *r, setting *const *found, draft *d, need_camera *out) {
    const int rounding = found[KEY_ROUNDING] != NULL ? word_among(r, found[KEY_ROUNDING], rounding_name) : 0;
    const int model =
        rounding >= 0 && found[KEY_MODEL] != NULL ? word_among(r, found[KEY_MODEL], model_word) : DP_MODEL_COUNT;
    const int arith =
        rounding >= 0 && model >= 0 && found[KEY_ARITH] != NULL ? read_arith(r, found[KEY_ARITH], out) : 0;
    if (rounding < 0 || model < 0 || arith < 0)
        return false;
    d->automatic = model == DP_MODEL_COUNT;
    d->spec.rounding = (dp_rounding)rounding;
    d->spec.model = d->automatic ? DP_MODEL_EXACT : (dp_model)model;
    d->spec.arith = (dp_arith)arith;
    return true;
}

/* A rasterizer that is known brings its own arithmetic; a GPU's profile in its place has both. */
static bool take_arith(reader *r, setting *const *found, draft *d, need_camera *out) {
    const setting *const named = found[KEY_VIEW + VIEW_RASTER];
    char name[PROFILE_NAME_SIZE];
    if (found[KEY_ARITH] != NULL || out->raster == NULL)
        return true;
    if (named == NULL || !profile_is_file(named->string)) {
        raster_arith(out->raster, false, &d->spec.arith); /* a specification leaves it as it is */
        return true;
    }
    if (!reader_row(r, named, "arith", has_arith, out, name))
        return false;
    d->spec.arith = (dp_arith)index_of(name, arith_name);
    return true;
}

/* A named GPU's profile must store the formats, for nothing is known of others; a rasterizer must draw them within a
 * bound; and each must be a format that the rest of the camera can have. */
static bool make_setups(reader *r, const setting *group, const draft *d, need_camera *out) {
    camera_fault fault = {.key = NULL};
    out->count = d->format_count;
    for (size_t i = 0; i < d->format_count; i++) {
        dp_spec spec = d->spec;
        spec.format = d->formats[i];
        if (!camera_stored(&out->gpu, &spec.format, &fault) || !camera_bounded(out->raster, &spec.format, &fault))
            return reader_fault(r, group, d->preset, &fault);
        const dp_status status = quantity_setup(&spec, &out->setups[i]);
        if (status != DP_OK)
            return camera_refused(&spec, status, "", &fault) || reader_fault(r, group, d->preset, &fault);
    }
    return true;
}

/* Places far from the origin: both keys, and a pipeline of depths at a point. */
static bool read_world(reader *r, setting *const *found, const draft *d, need_camera *out) {
    setting *const origin = found[KEY_FROM_ORIGIN], *const scheme = found[KEY_SCHEME];
    const char *text;
    if (origin == NULL && scheme == NULL)
        return true;
    if (origin == NULL || scheme == NULL)
        return reader_fail(r, origin != NULL ? origin : scheme, "camera '%s': from_origin and scheme need each other",
                           out->name);
    if (!reader_length(r, origin, "from_origin", READER_POSITIVE, &out->world) || !reader_string(r, scheme, &text))
        return false;
    if (!world_parse(text, &out->scheme)) {
        for (size_t i = 0; i < WORLD_ROWS; i++)
            reader_known(r, text, world_get(i)->name);
        return reader_fail(r, scheme,
                           "scheme: must be NAME or NAME:SIZE as 'depthprec list schemes' has them, got '%.40s'", text);
    }
    if (out->scheme.row->metres && strchr(text, ':') == NULL)
        out->scheme.size = unit_convert(out->scheme.size, unit_find("m"), r->unit);
    if (d->spec.ortho || dp_mapping_get(d->spec.mapping)->curve != DP_CURVE_PERSPECTIVE)
        return reader_fail(r, origin,
                           "from_origin: needs a perspective and one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE);
    if (!d->automatic && d->spec.model != DP_MODEL_FLOAT)
        return reader_fail(r, origin, "from_origin: needs the model auto or float");
    if (found[KEY_VIEW] != NULL)
        return reader_fail(r, origin, "from_origin: is of surfaces that face the camera, not with viewport");
    return true;
}

/* An orthographic camera may have planes at its place and behind it. */
static unsigned planes_of(const draft *d) {
    return d->spec.ortho ? READER_SIGNED : READER_POSITIVE;
}

bool reader_camera(reader *r, setting *group, need_camera *out) {
    setting *found[KEY_COUNT];
    draft d = {.spec = dp_spec_default()};
    out->line = group->line;
    out->name = group->name;
    if (!reader_name(r, group, out->name) || !reader_keys(r, group, "camera", keys, found))
        return false;
    for (int k = KEY_NEAR; k <= KEY_FORMAT && found[KEY_PRESET] == NULL; k++)
        if (found[k] == NULL)
            return reader_fail(r, group, "camera '%s': needs %s, or a preset", out->name, keys[k]);
    const bool good =
        (found[KEY_PRESET] == NULL || read_preset(r, found[KEY_PRESET], &d)) &&
        (found[KEY_ORTHO] == NULL || read_ortho(r, found[KEY_ORTHO], &d)) &&
        (found[KEY_NEAR] == NULL || reader_length(r, found[KEY_NEAR], "near", planes_of(&d), &d.spec.znear)) &&
        (found[KEY_FAR] == NULL ||
         reader_length(r, found[KEY_FAR], "far", planes_of(&d) | READER_INFINITE, &d.spec.zfar)) &&
        (found[KEY_MAPPING] == NULL || read_mapping(r, found[KEY_MAPPING], &d)) &&
        (found[KEY_FORMAT] == NULL || read_format(r, found[KEY_FORMAT], &d)) && read_words(r, found, &d, out) &&
        (found[KEY_LOG_C] == NULL || reader_length(r, found[KEY_LOG_C], "log_c", READER_POSITIVE, &d.spec.log_c));
    const dp_mapping_row *row = dp_mapping_get(d.spec.mapping);
    if (good && found[KEY_LOG_C] != NULL && (row->curve != DP_CURVE_LOG || row->log_over_near))
        return reader_fail(r, found[KEY_LOG_C], "log_c: is for the mappings with a constant C only, got %s", row->name);
    if (good && found[KEY_LOG_C] != NULL && found[KEY_LOG_C]->kind == SETTING_STRING)
        return reader_fail(r, found[KEY_LOG_C], "log_c: must be a number per scene unit, got %s",
                           reader_shown(r, found[KEY_LOG_C]));
    out->automatic = d.automatic;
    return good && read_world(r, found, &d, out) && reader_view(r, group, found + KEY_VIEW, d.preset, out, &d.spec) &&
           take_arith(r, found, &d, out) && make_setups(r, group, &d, out);
}
