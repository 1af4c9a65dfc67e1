/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/requirement.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "solve/biased.h"
#include "solve/model.h"
#include "solve/reader.h"
#include "system/input.h"

/* ---- A requirement, key by key ----------------------------------------------------------------------------------- */

/* Behind its own keys those of the quantities that it may limit. */
enum { KEY_NAME, KEY_CAMERA, KEY_AT, KEY_RANGE, KEY_LIMIT, KEY_COUNT = KEY_LIMIT + QUANTITY_LIMITED };

static bool known_camera(reader *r, const setting *s, size_t *out) {
    const char *name;
    if (!reader_string(r, s, &name))
        return false;
    for (size_t i = 0; i < r->file->camera_count; i++)
        if (strcmp(r->file->cameras[i].name, name) == 0) {
            *out = i;
            return true;
        }
    for (size_t i = 0; i < r->file->camera_count; i++)
        reader_known(r, name, r->file->cameras[i].name);
    return reader_fail(r, s, "camera: must be one of those under 'cameras', got '%s'", name);
}

/* Depths may have any sign where the camera's planes may. */
static unsigned sign_of(const reader *r, const need *n) {
    return r->file->cameras[n->camera].setups[0].spec.znear <= 0.0 ? READER_SIGNED : 0;
}

static bool read_range(reader *r, setting *s, need *n) {
    if ((s->kind != SETTING_ARRAY && s->kind != SETTING_LIST) || s->count != 2)
        return reader_fail(r, s, "range: must be two depths, [LO, HI], got %s", reader_shown(r, s));
    return reader_length(r, s->first, "range", sign_of(r, n), &n->lo) &&
           reader_length(r, s->first->next, "range", sign_of(r, n) | READER_INFINITE, &n->hi) &&
           (n->lo < n->hi || reader_fail(r, s,
                                         "range: its near end must be below its far end, got %g and %g; a single "
                                         "depth is written at = %g",
                                         n->lo, n->hi, n->lo));
}

static bool in_planes(reader *r, const setting *s, const need *n) {
    const need_camera *camera = &r->file->cameras[n->camera];
    const dp_spec *spec = &camera->setups[0].spec;
    if (n->lo >= spec->znear && n->hi <= spec->zfar)
        return true;
    return reader_fail(r, s, "%s: must lie within near and far of the camera '%s', %.15g and %.15g, got %.15g", s->name,
                       camera->name, spec->znear, spec->zfar, n->lo >= spec->znear ? n->hi : n->lo);
}

/* Whether a camera suits a kind of limit. */
static bool suits(reader *r, const setting *s, const need *n) {
    const need_camera *camera = &r->file->cameras[n->camera];
    const dp_spec *spec = &camera->setups[0].spec;
    if (!quantity_has_model(n->kind, spec->model, spec->mapping))
        return reader_fail(r, s, "%s: needs the model exact, staged or auto, and the camera '%s' has %s", s->name,
                           camera->name, model_word(spec->model));
    if (n->kind != QUANTITY_TIES)
        return true;
    if (dp_mapping_get(spec->mapping)->curve != DP_CURVE_PERSPECTIVE)
        return reader_fail(
            r, s, "ties: needs one of the mappings " DP_MAPPING_NAMES_PERSPECTIVE ", and the camera '%s' has %s",
            camera->name, dp_mapping_get(spec->mapping)->name);
    if (spec->model != DP_MODEL_FLOAT && !camera->automatic)
        return reader_fail(r, s, "ties: needs the model float or auto, and the camera '%s' has %s", camera->name,
                           model_word(spec->model));
    if (!(n->lo < n->hi) || isinf(n->hi))
        return reader_fail(r, s, "ties: needs a range with a finite far end");
    if (isinf((float)n->hi))
        return reader_fail(r, s, "ties: needs a range up to 3.4028235e+38, the largest binary32 number, got %.15g",
                           n->hi);
    return true;
}

static bool read_limit(reader *r, setting *s, need *n) {
    const quantity_row *kind = quantity_get(n->kind);
    return kind->unit != NULL ? reader_length(r, s, kind->name, READER_POSITIVE, &n->limit)
                              : reader_share(r, s, kind->name, &n->limit);
}

/* Exactly one of some keys: which, or -1 after an error. */
static int one_of(reader *r, const setting *group, setting *const *found, int first, int last, const char *names) {
    int which = -1;
    for (int k = first; k <= last; k++)
        if (found[k] != NULL) {
            if (which >= 0) {
                reader_fail(r, found[k], "'%s' and '%s' must not both be given", found[which]->name, found[k]->name);
                return -1;
            }
            which = k;
        }
    if (which < 0)
        reader_fail(r, group, "requirement: needs %s", names);
    return which;
}

static bool read_need(reader *r, setting *group, bool listed, need *n) {
    setting *found[KEY_COUNT] = {NULL};
    const char *keys[KEY_COUNT + 1] = {"name", "camera", "at", "range"};
    char limits[NEED_TEXT_SIZE] = "one of "; /* "separation, error, ties and bias" */
    for (size_t q = 0; q < QUANTITY_LIMITED; q++) {
        keys[KEY_LIMIT + q] = quantity_get(q)->name;
        append(limits, sizeof limits, "%s%s",
               q == 0                     ? ""
               : q + 1 < QUANTITY_LIMITED ? ", "
                                          : " and ",
               keys[KEY_LIMIT + q]);
    }
    n->line = group->line;
    n->name = group->name;
    if (!reader_keys(r, group, "requirement", listed ? keys : keys + 1, listed ? found : found + 1))
        return false;
    if (listed && (found[KEY_NAME] == NULL ? !reader_fail(r, group, "requirement: needs a name")
                                           : !reader_string(r, found[KEY_NAME], &n->name)))
        return false;
    if (!reader_name(r, listed ? found[KEY_NAME] : group, n->name))
        return false;
    if (found[KEY_CAMERA] == NULL)
        return reader_fail(r, group, "requirement '%s': needs a camera", n->name);
    if (!known_camera(r, found[KEY_CAMERA], &n->camera))
        return false;
    const int where = one_of(r, group, found, KEY_AT, KEY_RANGE, "at = DEPTH or range = [LO, HI]");
    if (where < 0)
        return false;
    if (where == KEY_RANGE
            ? !read_range(r, found[KEY_RANGE], n)
            : !reader_length(r, found[KEY_AT], "at", sign_of(r, n) != 0 ? READER_SIGNED : READER_POSITIVE, &n->lo))
        return false;
    if (where == KEY_AT)
        n->hi = n->lo;
    if (!in_planes(r, found[where], n))
        return false;
    const int what = one_of(r, group, found, KEY_LIMIT, KEY_COUNT - 1, limits);
    if (what < 0)
        return false;
    n->kind = (quantity_kind)(what - KEY_LIMIT);
    if (n->kind == QUANTITY_BIAS)
        return reader_bias(r, found[what], n);
    return read_limit(r, found[what], n) && suits(r, found[what], n);
}

/* ---- The file ---------------------------------------------------------------------------------------------------- */

static int by_name(const void *a, const void *b) {
    const need *const *x = a;
    const need *const *y = b;
    const int order = strcmp((*x)->name, (*y)->name);
    return order != 0 ? order : ((*x)->line > (*y)->line) - ((*x)->line < (*y)->line);
}

/* The grammar refuses a name given twice in a group, but in a list `name` is only a key like others. */
static bool names_differ(reader *r) {
    const size_t count = r->file->count;
    const need **sorted = malloc(count * sizeof *sorted);
    if (sorted == NULL)
        return reader_fail(r, NULL, "no memory for %zu requirements", count);
    for (size_t i = 0; i < count; i++)
        sorted[i] = &r->file->needs[i];
    if (count > 1) /* none: malloc() may have given no array */
        qsort(sorted, count, sizeof *sorted, by_name);
    bool good = true;
    for (size_t i = 1; i < count && good; i++)
        if (strcmp(sorted[i - 1]->name, sorted[i]->name) == 0) {
            reader_fail(r, NULL, "requirement '%s': is already on line %d", sorted[i]->name, sorted[i - 1]->line);
            r->error->line = sorted[i]->line;
            good = false;
        }
    free(sorted);
    return good;
}

static bool read_needs(reader *r, setting *s) {
    const bool listed = s->kind == SETTING_LIST;
    if (!listed && s->kind != SETTING_GROUP)
        return reader_fail(r, s, "requirements: must be a group { NAME = { ... }; } or a list ( { name = ... }, ... )");
    if (s->count == 0)
        return reader_fail(r, s, "requirements: must hold at least one");
    r->file->needs = calloc(s->count, sizeof *r->file->needs);
    if (r->file->needs == NULL)
        return reader_fail(r, s, "no memory for %zu requirements", s->count);
    for (setting *group = s->first; group != NULL; group = group->next) {
        if (group->kind != SETTING_GROUP)
            return reader_fail(r, group, "requirement: must be a group { ... }, got %s", reader_shown(r, group));
        if (!read_need(r, group, listed, &r->file->needs[r->file->count]))
            return false;
        r->file->count++;
    }
    return names_differ(r);
}

static bool read_cameras(reader *r, setting *s) {
    const size_t count = s->kind == SETTING_GROUP ? s->count : 0;
    if (count == 0)
        return reader_fail(r, s, "cameras: must be a group { NAME = { ... }; } with at least one camera");
    r->file->cameras = calloc(count, sizeof *r->file->cameras);
    if (r->file->cameras == NULL)
        return reader_fail(r, s, "no memory for %zu cameras", count);
    for (setting *group = s->first; group != NULL; group = group->next) {
        if (group->kind != SETTING_GROUP)
            return reader_fail(r, group, "camera: must be a group { ... }, got %s", reader_shown(r, group));
        if (!reader_camera(r, group, &r->file->cameras[r->file->camera_count]))
            return false;
        r->file->camera_count++;
    }
    return true;
}

static bool read_all(reader *r, setting *root) {
    static const char *const names[] = {"unit", "cameras", "requirements", NULL};
    setting *found[3];
    if (!reader_keys(r, root, "file", names, found) || (found[0] != NULL && !reader_unit(r, found[0])))
        return false;
    bool (*const parts[])(reader *, setting *) = {NULL, read_cameras, read_needs};
    for (int k = 1; k < 3; k++) {
        if (found[k] == NULL)
            return reader_fail(r, NULL, "needs a group '%s'", names[k]);
        if (!parts[k](r, found[k]))
            return false;
    }
    return true;
}

/* The line of a null byte, at which the grammar would stop without a word; 0 where there is none. */
static int null_line(const char *text, size_t size) {
    const char *end = memchr(text, '\0', size);
    int line = end != NULL;
    for (const char *at = text; end != NULL && at < end; at++)
        line += *at == '\n';
    return line;
}

bool need_parse(const char *path, const char *text, size_t size, need_file *out, need_error *error) {
    *out = (need_file){.path = path, .unit = ""};
    *error = (need_error){0};
    reader r = {.file = out, .error = error};
    if (size > NEED_BYTES_MAX)
        return reader_fail(&r, NULL, "must be at most %d bytes, got %zu", NEED_BYTES_MAX, size);
    error->line = null_line(text, size);
    if (error->line > 0)
        return reader_fail(&r, NULL, "holds a null byte: not text");
    setting_fault fault;
    bool good = true;
    out->memory = malloc(sizeof *out->memory);
    if (out->memory == NULL)
        return reader_fail(&r, NULL, "no memory");
    if (!setting_parse(text, out->memory, &fault)) {
        error->line = fault.line;
        good = reader_fail(&r, NULL, "%s", fault.text);
    }
    good = good && read_all(&r, out->memory->root);
    if (!good)
        need_release(out);
    return good;
}

static char *slurp(FILE *in, size_t *size) {
    size_t room = 1 << 16;
    char *text = malloc(room);
    *size = 0;
    while (text != NULL && *size <= NEED_BYTES_MAX) {
        *size += fread(text + *size, 1, room - 1 - *size, in);
        if (feof(in) || ferror(in))
            break;
        if (*size < room - 1)
            continue;
        char *more = realloc(text, room *= 2);
        if (more == NULL)
            free(text);
        text = more;
    }
    if (text != NULL)
        text[*size] = '\0';
    return text;
}

bool need_read(const char *path, need_file *out, need_error *error) {
    *out = (need_file){.path = path, .unit = ""};
    *error = (need_error){.unreadable = true};
    errno = 0;
    FILE *in = input_open(path);
    size_t size = 0;
    char *text = in != NULL ? slurp(in, &size) : NULL;
    if (text == NULL || ferror(in)) {
        snprintf(error->text, sizeof error->text, "cannot read: %s", strerror(errno));
        free(text);
        input_close(in);
        return false;
    }
    input_close(in);
    const bool good = need_parse(path, text, size, out, error);
    free(text);
    return good;
}

void need_release(need_file *file) {
    free(file->cameras);
    free(file->needs);
    if (file->memory != NULL)
        setting_release(file->memory);
    free(file->memory);
    *file = (need_file){.path = file->path, .unit = ""};
}
