/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "probe/brief.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "depthprec/arith.h"
#include "probe/hypotheses.h"

enum { FIELDS = 7, FIELD_SIZE = BRIEF_SIZE, SUBPIXEL_MOST = 99 };
enum { NAME = 0, DRIVER, API, SUBPIXEL, ARITH, RASTER, FINDINGS };

static const char certainties[] = "sonm"; /* in the order of probe_certainty */
static const char places[] = "0123456789abcdefghijklmnopqrstuvwxyz";

static bool is_plain(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           (c != '\0' && strchr(" ().,:;/+-?_", c) != NULL);
}

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

static void add_name(char out[BRIEF_SIZE], const char *name) {
    for (; *name != '\0'; name++)
        append(out, BRIEF_SIZE, "%c", is_plain(*name) ? *name : '?');
    append(out, BRIEF_SIZE, "~");
}

static probe_key key_of(const char *name) {
    probe_key key = KEY_STORED;
    while (key < PROBE_KEYS && strcmp(probe_key_name(key), name) != 0)
        key++;
    return key;
}

/* The hypothesis at `at`, of so many letters; of what is stored words begin with what a device calls its format. */
static void add_place(char out[BRIEF_SIZE], probe_key key, const char *at, size_t length, bool cut) {
    const char *is;
    for (size_t i = 0; (is = probe_hypothesis(key, i)) != NULL; i++) {
        const size_t all = strlen(is);
        const size_t before = key == KEY_STORED && length > all ? length - all : 0;
        if (strncmp(is, at + before, length - before) == 0 && (all == length - before || cut)) {
            append(out, BRIEF_SIZE, "%c", places[i]);
            return;
        }
    }
}

/* All that words name; those at the end of a full buffer may be cut. */
static void add_places(char out[BRIEF_SIZE], probe_key key, const char *words) {
    const bool full = strlen(words) == PROBE_WORDS_SIZE - 1, nearest = strstr(words, PROBE_NEAREST) == words;
    for (const char *at = nearest ? words + strlen(PROBE_NEAREST) : words, *end; at != NULL;
         at = end != NULL ? end + strlen(PROBE_OR) : NULL) {
        end = strstr(at, PROBE_OR);
        add_place(out, key, at, end != NULL ? (size_t)(end - at) : strlen(at), end == NULL && full);
    }
}

static void add_finding(char out[BRIEF_SIZE], const probe_finding *f) {
    const probe_key key = key_of(f->key);
    char format = '-';
    for (int i = 0; f->format != NULL && i < SHOT_FORMATS; i++)
        format = strcmp(f->format, probe_format_name((shot_format)i)) == 0 ? places[i] : format;
    append(out, BRIEF_SIZE, "%c%c%c", 'a' + (int)key, format, certainties[f->sure]);
    add_places(out, key, f->words);
    if (f->sure == PROBE_MEASURED)
        append(out, BRIEF_SIZE, "*%.6g", f->value);
    else if (f->sure != PROBE_SURE)
        append(out, BRIEF_SIZE, "*%llu*%llu", (unsigned long long)f->hits, (unsigned long long)f->cases);
}

void brief_write(const probe_result *r, char out[BRIEF_SIZE]) {
    const shot_device *d = &r->machine.device[r->machine.chosen];
    out[0] = '\0';
    add_name(out, d->name);
    add_name(out, d->driver);
    add_name(out, d->api);
    append(out, BRIEF_SIZE, "%d%s~%s~%s~", d->subpixel_bits, r->plan.shot[0].ndc_signed ? "w" : "",
           r->arith != NULL ? r->arith : "", r->raster != NULL ? r->raster : "");
    for (size_t i = 0; i < r->count; i++) {
        append(out, BRIEF_SIZE, "%s", i > 0 ? "_" : "");
        add_finding(out, &r->finding[i]);
    }
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static bool fail(char error[SHOT_ERROR_SIZE], const char *what, const char *got) {
    snprintf(error, SHOT_ERROR_SIZE, "the profile of a GPU is damaged: %s, got '%.40s'", what, got);
    return false;
}

static bool copy_name(char *out, size_t size, const char *from) {
    const size_t length = strlen(from);
    for (size_t i = 0; i < length; i++)
        if (!is_plain(from[i]))
            return false;
    snprintf(out, size, "%s", from);
    return length > 0 && length < size;
}

/* A whole number at *at, which is moved behind it; false where there is none that is small. */
static bool whole(const char **at, double *out) {
    char *end;
    if (**at < '0' || **at > '9')
        return false;
    *out = (double)strtoull(*at, &end, 10);
    *at = end;
    return *out <= (double)SHOT_PIXELS;
}

/* The words of the places at *at, as judges put them together. */
static bool read_places(const char **at, probe_key key, const char *prefix, probe_finding *f) {
    const bool nearest = f->sure == PROBE_NO_ROW && probe_key_counts(key);
    size_t count = 0;
    f->words[0] = '\0';
    append(f->words, sizeof f->words, "%s", nearest ? PROBE_NEAREST : prefix);
    for (const char *place; **at != '\0' && (place = strchr(places, **at)) != NULL; ++*at, count++) {
        const char *is = probe_hypothesis(key, (size_t)(place - places));
        if (is == NULL)
            return false;
        append(f->words, sizeof f->words, "%s%s", count > 0 ? PROBE_OR : "", is);
        f->unit = f->sure == PROBE_MEASURED ? probe_unit(key, (size_t)(place - places)) : NULL;
    }
    return f->sure == PROBE_OPEN ? count >= 1 : count == 1;
}

static bool read_numbers(const char *at, probe_finding *f) {
    double hits = 0, cases = 0;
    char *end;
    f->value = (double)NAN;
    if (f->sure == PROBE_SURE)
        return *at == '\0';
    if (*at++ != '*')
        return false;
    if (f->sure == PROBE_MEASURED) {
        f->value = strtod(at, &end);
        return *at >= '0' && *at <= '9' && *end == '\0' && isfinite(f->value);
    }
    if (!whole(&at, &hits) || *at++ != '*' || !whole(&at, &cases) || *at != '\0' || hits > cases)
        return false;
    f->hits = (uint64_t)hits;
    f->cases = (uint64_t)cases;
    return true;
}

static bool read_finding(const char *at, const char *prefix, probe_finding *f) {
    const char *sure;
    if (strlen(at) < 4 || at[0] < 'a' || at[0] >= 'a' + PROBE_KEYS || (sure = strchr(certainties, at[2])) == NULL ||
        (at[1] != '-' && (at[1] < '0' || at[1] >= '0' + SHOT_FORMATS)))
        return false;
    const probe_key key = (probe_key)(at[0] - 'a');
    *f = (probe_finding){.key = probe_key_name(key),
                         .format = at[1] == '-' ? NULL : probe_format_name((shot_format)(at[1] - '0')),
                         .sure = (probe_certainty)(sure - certainties)};
    const bool measured = key == KEY_LOG2 || key == KEY_QUOTIENT;
    at += 3;
    return (f->sure == PROBE_MEASURED) == measured && read_places(&at, key, prefix, f) && read_numbers(at, f);
}

static bool read_findings(char *text, const char *const formats[SHOT_FORMATS], probe_result *r,
                          char error[SHOT_ERROR_SIZE]) {
    char prefix[SHOT_NAME_SIZE + 2] = "";
    int stored = 0;
    for (char *at = text, *end; at != NULL; at = end != NULL ? end + 1 : NULL) {
        end = strchr(at, '_');
        if (end != NULL)
            *end = '\0';
        if (formats != NULL && *at == 'a' + (int)KEY_STORED && stored < SHOT_FORMATS)
            snprintf(prefix, sizeof prefix, "%s: ", formats[stored++]);
        if (r->count == PROBE_FINDINGS_MAX || !read_finding(at, prefix, &r->finding[r->count++]))
            return fail(error, "it must be a finding", at);
        prefix[0] = '\0';
    }
    return true;
}

static bool read_rows(char *const field[FIELDS], probe_result *r, char error[SHOT_ERROR_SIZE]) {
    const char *end = field[SUBPIXEL], *row;
    double bits;
    dp_arith arith;
    if (!whole(&end, &bits) || bits > SUBPIXEL_MOST || (strcmp(end, "") != 0 && strcmp(end, "w") != 0))
        return fail(error, "it must be the bits of a pixel", field[SUBPIXEL]);
    r->machine.device[0].subpixel_bits = (int)bits;
    r->plan.shot[0].ndc_signed = *end == 'w';
    if (field[ARITH][0] != '\0') {
        if (dp_arith_parse(field[ARITH], &arith) != DP_OK)
            return fail(error, "it must be an arithmetic", field[ARITH]);
        r->arith = dp_arith_get(arith)->name;
    }
    if (field[RASTER][0] != '\0') {
        for (size_t i = 0; (row = probe_hypothesis(KEY_RASTERIZER, i)) != NULL && strcmp(row, field[RASTER]) != 0;)
            i++;
        if (row == NULL)
            return fail(error, "it must be a rasterizer that draws", field[RASTER]);
        r->raster = row;
    }
    return true;
}

bool brief_read(const char *text, const char *const formats[SHOT_FORMATS], probe_result *r,
                char error[SHOT_ERROR_SIZE]) {
    static char copy[FIELD_SIZE];
    char *field[FIELDS] = {copy};
    shot_device *d = &r->machine.device[0];
    *r = (probe_result){.machine = {.count = 1}, .plan = {0, calloc(1, sizeof(shot))}};
    if (r->plan.shot == NULL)
        return fail(error, "there is no memory for it", "");
    if (strlen(text) >= sizeof copy)
        return fail(error, "it is too long", text);
    snprintf(copy, sizeof copy, "%s", text);
    for (int i = 1; i < FIELDS; i++) {
        field[i] = strchr(field[i - 1], '~');
        if (field[i] == NULL)
            return fail(error, "it must have 7 parts between ~", text);
        *field[i]++ = '\0';
    }
    if (!copy_name(d->name, sizeof d->name, field[NAME]) || !copy_name(d->driver, sizeof d->driver, field[DRIVER]) ||
        !copy_name(d->api, sizeof d->api, field[API]))
        return fail(error, "it must be the name of a GPU, a driver and an API, in plain letters", text);
    return read_rows(field, r, error) && read_findings(field[FINDINGS], formats, r, error);
}
