/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cameras of a requirement file: its words into keys, and a camera made of them. */
#include <math.h>
#include <string.h>

#include "camera/depth_range.h"
#include "core/append.h"
#include "quantity/quantity.h"
#include "solve/model.h"
#include "solve/reader.h"

enum { KEY_FROM_ORIGIN = CAMERA_KEYS, KEY_SCHEME, KEY_COUNT };

/* The index of a name in any case; that of null where there is none. */
static size_t index_of(const char *text, const char *(*name)(size_t)) {
    size_t i = 0;
    while (name(i) != NULL && strcasecmp(name(i), text) != 0)
        i++;
    return i;
}

static const char *rounding_name(size_t i) {
    return dp_rounding_name((dp_rounding)i);
}

static const char *arith_name(size_t i) {
    return i < dp_arith_count() ? dp_arith_get(i)->name : NULL;
}

/* Names of rows and, behind each, its other spellings. */
static const char *name_of(const char *name, const char *aliases, size_t i) {
    return i % 2 == 0 || aliases == NULL ? name : aliases;
}

static const char *mapping_name(size_t i) {
    const dp_mapping_row *row = i / 2 < DP_MAPPING_COUNT ? dp_mapping_get((dp_mapping)(i / 2)) : NULL;
    return row != NULL ? name_of(row->name, row->aliases, i) : NULL;
}

static const char *format_name(size_t i) {
    const dp_format_row *row = dp_format_get(i / 2);
    return row != NULL ? name_of(row->format.name, row->aliases, i) : NULL;
}

static bool take_mapping(camera_said *c, const char *word) {
    return dp_mapping_parse(word, &c->mappings[0]) == DP_OK;
}

static bool take_format(camera_said *c, const char *word) {
    c->format_count = dp_format_parse(word, c->formats);
    return c->format_count > 0;
}

static bool take_rounding(camera_said *c, const char *word) {
    c->rounding = (dp_rounding)index_of(word, rounding_name);
    return c->rounding < DP_ROUNDING_COUNT;
}

static bool take_model(camera_said *c, const char *word) {
    c->model = (dp_model)index_of(word, model_word);
    return c->model <= DP_MODEL_COUNT;
}

static bool take_arith(camera_said *c, const char *word) {
    return dp_arith_parse(word, &c->arith) == DP_OK;
}

static bool take_raster(camera_said *c, const char *word) {
    c->raster = raster_find(word);
    return c->raster != NULL;
}

static const struct word_key {
    bool (*take)(camera_said *c, const char *word); /* null: read_preset() */
    const char *(*name)(size_t index);              /* null behind the last */
    const named_table *rows;                        /* or their names */
    const char *allowed;                            /* null: the names */
} word_keys[CAMERA_KEYS] = {
    [CAMERA_PRESET] = {NULL, NULL, &preset_table, "a preset as 'depthprec list presets' names them"},
    [CAMERA_MAPPING] = {take_mapping, mapping_name, NULL, "one of " DP_MAPPING_NAMES},
    [CAMERA_FORMAT] = {take_format, format_name, NULL, "a depth format as 'depthprec list formats' names them"},
    [CAMERA_ROUNDING] = {take_rounding, rounding_name, NULL, NULL},
    [CAMERA_MODEL] = {take_model, model_word, NULL, NULL},
    [CAMERA_ARITH] = {take_arith, arith_name, NULL, NULL},
    [CAMERA_RASTER] = {take_raster, NULL, &raster_table, "a rasterizer as 'depthprec list rasterizers' names them"},
};

static const char *name_at(const struct word_key *w, size_t i) {
    const named_row *row = w->rows != NULL ? named_at(w->rows, i / 2) : NULL;
    return w->rows == NULL ? w->name(i) : row != NULL ? name_of(row->name, row->aliases, i) : NULL;
}

/* A preset; *refused: its name is known, and what is said of it was not. */
static bool read_preset(reader *r, const setting *s, const char *text, camera_said *c, bool *refused) {
    char error[PRESET_ERROR_SIZE];
    c->preset_count = 1;
    if (preset_read(text, &c->presets[0], &c->values[0], error))
        return true;
    *refused = *error != '\0' && !reader_fail(r, s, "preset: %s", error);
    return false;
}

static bool read_word(reader *r, const setting *s, camera_key key, camera_said *c) {
    const struct word_key *w = &word_keys[key];
    const char *text;
    bool refused = false;
    char name[PROFILE_NAME_SIZE], all[NEED_TEXT_SIZE / 2] = "one of ";
    if (!reader_string(r, s, &text))
        return false;
    if (profile_is_file(text) && (key == CAMERA_ARITH || key == CAMERA_RASTER))
        return reader_profile(r, s, key, c, name) &&
               (w->take(c, name) ||
                reader_fail(r, s, "%s: '%.120s' names what is not known here, '%.40s'", s->name, text, name));
    if (key == CAMERA_PRESET ? read_preset(r, s, text, c, &refused) : w->take(c, text))
        return true;
    if (refused)
        return false;
    for (size_t i = 0; name_at(w, i) != NULL; i++) {
        reader_known(r, text, name_at(w, i));
        append(all, sizeof all, "%s%s", i > 0 ? ", " : "", name_at(w, i));
    }
    return reader_fail(r, s, "%s: must be %s, got '%.40s'", s->name, w->allowed != NULL ? w->allowed : all, text);
}

static bool read_plane(reader *r, setting *s, camera_said *c) {
    const bool is_far = strcmp(s->name, "far") == 0;
    return reader_length(r, s, s->name, READER_SIGNED | (is_far ? READER_INFINITE : 0), is_far ? &c->zfar : &c->znear);
}

/* A file beside this one, or the numbers. */
static bool read_matrix(reader *r, setting *s, camera_said *c) {
    char path[READER_PATH_SIZE], error[MATRIX_ERROR_SIZE];
    const char *text;
    if (!reader_string(r, s, &text))
        return false;
    const int status =
        camera_matrix_read(&c->matrix, camera_matrix_is_typed(text) ? text : reader_path(r, text, path), error);
    return status > 0 ? reader_unreadable(r, s, status) : status == 0 || reader_fail(r, s, "matrix: %.200s", error);
}

static bool read_ortho(reader *r, setting *s, camera_said *c) {
    if (s->kind != SETTING_WORD)
        return reader_fail(r, s, "ortho: must be true or false, got %s", reader_shown(r, s));
    c->ortho = s->number != 0.0;
    return true;
}

static bool read_log_c(reader *r, setting *s, camera_said *c) {
    if (s->kind == SETTING_STRING)
        return reader_fail(r, s, "log_c: must be a number per scene unit, got %s", reader_shown(r, s));
    return reader_length(r, s, s->name, READER_POSITIVE, &c->log_c);
}

static reader_key *const number_keys[CAMERA_KEYS] = {
    [CAMERA_MATRIX] = read_matrix,       [CAMERA_NEAR] = read_plane,
    [CAMERA_FAR] = read_plane,           [CAMERA_DEPTH_RANGE] = reader_depth_range,
    [CAMERA_ORTHO] = read_ortho,         [CAMERA_LOG_C] = read_log_c,
    [CAMERA_VIEWPORT] = reader_viewport, [CAMERA_FOV] = reader_angle,
    [CAMERA_HFOV] = reader_angle,        [CAMERA_SUBPIXEL] = reader_subpixel,
    [CAMERA_SLANT] = reader_slant,       [CAMERA_TRIANGLE] = reader_class,
};

/* Nothing that the verdict hangs on has a silent default: a camera names it, itself or by a preset or a matrix. */
static bool is_complete(reader *r, const setting *group, setting *const *found, const camera_said *c) {
    const bool viewed = found[CAMERA_VIEWPORT] != NULL;
    const bool planes = c->matrix.count == MATRIX_ENTRIES;
    for (int k = planes ? CAMERA_FORMAT : CAMERA_NEAR; k <= CAMERA_FORMAT; k++)
        if (found[k] == NULL)
            return reader_fail(r, group, "camera '%s': needs %s, or a preset", group->name, camera_keys[k]);
    if (viewed && found[CAMERA_FOV] == NULL && found[CAMERA_HFOV] == NULL && c->matrix.count == 0)
        return reader_fail(r, found[CAMERA_VIEWPORT], "viewport: needs fov, hfov or matrix");
    if (viewed && found[CAMERA_RASTER] == NULL && found[CAMERA_SUBPIXEL] == NULL)
        return reader_fail(r, found[CAMERA_VIEWPORT], "viewport: needs raster or subpixel");
    return true;
}

/* Triangles must be drawn by a pipeline that interpolates linearly, and judged by its guarantee. */
static bool suits(reader *r, const setting *viewport, const camera_said *c) {
    const dp_mapping_row *mapping = dp_mapping_get(c->mappings[0]);
    if (viewport != NULL && mapping->curve != DP_CURVE_PERSPECTIVE)
        return reader_fail(r, viewport, "viewport: needs one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE ", got %s",
                           mapping->name);
    if (viewport != NULL && c->model != DP_MODEL_FLOAT && !c->model_auto)
        return reader_fail(r, viewport, "viewport: needs the model float or auto, got %s", dp_model_name(c->model));
    return true;
}

static bool make_setups(const camera_said *c, need_camera *out, camera_fault *fault) {
    dp_spec spec = camera_to_spec(c);
    out->count = c->format_count;
    for (size_t i = 0; i < c->format_count; i++) {
        spec.format = c->formats[i];
        if (!camera_keeps(c, &spec.format, fault))
            return false;
        const dp_status status = quantity_setup(&spec, &out->setups[i]);
        if (status != DP_OK)
            return !camera_range_refused(&spec, status, fault) && camera_refused(&spec, status, "", fault);
    }
    return camera_serves(c, CAMERA_LOG_C, &spec, sizeof spec, 1, fault) &&
           camera_serves(c, CAMERA_ARITH, &spec, sizeof spec, 1, fault);
}

/* Places far from the origin: both keys, and a pipeline of depths at a point. */
static bool read_world(reader *r, setting *const *found, const camera_said *c, need_camera *out) {
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
    if (c->ortho || dp_mapping_get(c->mappings[0])->curve != DP_CURVE_PERSPECTIVE)
        return reader_fail(r, origin,
                           "from_origin: needs a perspective and one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE);
    if (!c->model_auto && c->model != DP_MODEL_FLOAT)
        return reader_fail(r, origin, "from_origin: needs the model auto or float");
    if (found[CAMERA_DEPTH_RANGE] != NULL)
        return reader_fail(r, origin, "from_origin: is of the depth range 0 to 1, not with depth_range");
    if (found[CAMERA_VIEWPORT] != NULL)
        return reader_fail(r, origin, "from_origin: is of surfaces that face the camera, not with viewport");
    return true;
}

bool reader_camera(reader *r, setting *group, need_camera *out) {
    const char *keys[KEY_COUNT + 1] = {[KEY_FROM_ORIGIN] = "from_origin", "scheme"};
    setting *found[KEY_COUNT];
    camera_said c = {.mapping_count = 1, .log_c = 1.0, .model = DP_MODEL_COUNT, .triangles = dp_triangles_default()};
    camera_fault fault = {.key = NULL};
    c.triangles.width = 0;
    for (camera_key k = 0; k < CAMERA_KEYS; k++)
        keys[k] = camera_keys[k];
    out->line = group->line;
    out->name = group->name;
    if (!reader_name(r, group, out->name) || !reader_keys(r, group, "camera", keys, found))
        return false;
    for (camera_key k = 0; k < CAMERA_KEYS; k++) {
        if (found[k] == NULL)
            continue;
        c.words[k] = found[k]->kind == SETTING_STRING ? found[k]->string : "";
        if (number_keys[k] == NULL ? !read_word(r, found[k], k, &c) : !number_keys[k](r, found[k], &c))
            return false;
    }
    if (found[CAMERA_PRESET] == NULL && !is_complete(r, group, found, &c))
        return false;
    if (!camera_make(&c, r->unit, &fault))
        return reader_fault(r, group, c.preset_count > 0 ? c.presets[0] : NULL, &fault);
    out->automatic = c.model_auto;
    out->raster = c.raster;
    out->gpu = c.gpu;
    out->matrix = c.matrix;
    return read_world(r, found, &c, out) && suits(r, found[CAMERA_VIEWPORT], &c) &&
           (make_setups(&c, out, &fault) || reader_fault(r, group, c.preset_count > 0 ? c.presets[0] : NULL, &fault));
}
