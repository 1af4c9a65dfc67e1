/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The findings of probe, in words and as the JSON that is a profile: see profile.h. */
#include "probe/cmd_probe/report.h"

#include <math.h>
#include <string.h>

#include "core/append.h"
#include "report/number.h"
#include "report/report.h"

enum { DIGITS = 3 };

typedef struct finding_row {
    const char *key, *format, *words, *sure, *next, *unit;
    double value, hits, next_hits;
    uint64_t cases;
} finding_row;

typedef struct device_row {
    int number;
    const char *name, *driver, *api;
} device_row;

typedef struct probing {
    const probe_result *result;
    const shot_device *device;
    device_row of; /* the one that was asked */
    int subpixel_bits;
    finding_row finding;
    device_row other;
} probing;

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

static void *next_finding(void *of, size_t i) {
    probing *p = of;
    const probe_finding *f = &p->result->finding[i];
    const bool counted = f->sure != PROBE_MEASURED;
    if (i >= p->result->count)
        return NULL;
    p->finding = (finding_row){.key = f->key,
                               .format = f->format,
                               .words = f->words,
                               .sure = probe_certainty_name(f->sure),
                               .next = f->next,
                               .unit = f->unit,
                               .value = f->value,
                               .hits = counted ? (double)f->hits : (double)NAN,
                               .next_hits = f->next != NULL ? (double)f->next_hits : (double)NAN,
                               .cases = f->cases};
    return &p->finding;
}

static device_row device_of(const probe_result *r, size_t i) {
    const shot_device *d = &r->machine.device[i];
    return (device_row){(int)i, d->name, d->driver, d->api};
}

static void *next_device(void *of, size_t i) {
    probing *p = of;
    if (i >= p->result->machine.count)
        return NULL;
    p->other = device_of(p->result, i);
    return &p->other;
}

static const column device_columns[] = {{FIELD(device_row, number, "number", "")},
                                        {FIELD(device_row, name, "name", "")},
                                        {FIELD(device_row, driver, "driver", "")},
                                        {FIELD(device_row, api, "api", "")},
                                        {.kind = COLUMN_END}};

static const column finding_columns[] = {{FIELD(finding_row, key, "key", "")},
                                         {FIELD(finding_row, format, "format", "")},
                                         {FIELD(finding_row, words, "found", "")},
                                         {FIELD(finding_row, sure, "sure", "")},
                                         {FIELD(finding_row, cases, "cases", "")},
                                         {FIELD(finding_row, hits, "hits", "")},
                                         {FIELD(finding_row, next, "next", "")},
                                         {FIELD(finding_row, next_hits, "next_hits", "")},
                                         {FIELD(finding_row, value, "value", "")},
                                         {FIELD(finding_row, unit, "value_unit", "")},
                                         {.kind = COLUMN_END}};

static const column result_columns[] = {
    {FIELD(probe_result, arith, "arith", "")}, {FIELD(probe_result, raster, "raster", "")}, {.kind = COLUMN_END}};

static const column columns[] = {{PART(probing, of, "device", device_columns)},
                                 {FIELD(probing, subpixel_bits, "subpixel_reported", ""), .only = AS_JSON},
                                 {PART(probing, result, NULL, result_columns), .pointed = true},
                                 {LIST("findings", finding_columns, next_finding)},
                                 {LIST("devices", device_columns, next_device), .only = AS_JSON},
                                 {.kind = COLUMN_END}};

/* ---- Text -------------------------------------------------------------------------------------------------------- */

/* The findings from `first` on that say the same of other formats: how many, and the formats. */
static size_t alike(const probe_result *r, size_t first, char formats[PROBE_WORDS_SIZE]) {
    const probe_finding *a = &r->finding[first];
    size_t i = first;
    formats[0] = '\0';
    for (; i < r->count; i++) {
        const probe_finding *b = &r->finding[i];
        if (strcmp(a->key, b->key) != 0 || strcmp(a->words, b->words) != 0 || a->sure != b->sure)
            break;
        if (b->format != NULL)
            append(formats, PROBE_WORDS_SIZE, "%s%s", formats[0] != '\0' ? ", " : "", b->format);
    }
    return i - first;
}

static uint64_t least_hits(const probe_finding *f, size_t count) {
    uint64_t least = f->hits;
    for (size_t i = 1; i < count; i++)
        least = f[i].hits < least ? f[i].hits : least;
    return least;
}

static void say_finding(page *p, const probe_finding *f, const char *label, const char *formats, size_t count) {
    const char *of = formats[0] != '\0' ? ": " : "";
    if (f->sure == PROBE_MEASURED)
        page_note(p, label, "at most %s%s%s off, %s", number_up(f->value, DIGITS).text, f->unit[0] != '\0' ? " " : "",
                  f->unit, f->words);
    else if (f->sure == PROBE_SURE)
        page_note(p, label, "%s%s%s", formats, of, f->words);
    else
        page_note(p, label, "%s%s%s (%s: %llu of %llu)", formats, of, f->words, probe_certainty_name(f->sure),
                  (unsigned long long)least_hits(f, count), (unsigned long long)f->cases);
}

static void say_devices(page *p, const probing *b) {
    if (b->result->machine.count > 1)
        for (size_t i = 0; i < b->result->machine.count; i++)
            page_note(p, i == 0 ? "devices" : "", "%zu: %s", i, b->result->machine.device[i].name);
}

static void say_probe(page *p, void *item) {
    const probing *b = item;
    const probe_result *r = b->result;
    const char *before = "";
    char formats[PROBE_WORDS_SIZE];
    page_title(p, "%s", b->device->name);
    page_note(p, "driver", "%s; %s", b->device->driver, b->device->api);
    say_devices(p, b);
    page_note(p, "rows", "--arith %s, --raster %s", r->arith != NULL ? r->arith : "(no row)",
              r->raster != NULL ? r->raster : "(no row)");
    for (size_t i = 0, count; i < r->count; i += count) {
        const probe_finding *f = &r->finding[i];
        count = alike(r, i, formats);
        say_finding(p, f, strcmp(before, f->key) != 0 ? f->key : "", formats, count);
        before = f->key;
    }
    page_text(p,
              "Each finding predicts every pixel that was compared, where nothing else that is known does, unless "
              "it says otherwise. Not measured: clip z from %s, several samples a pixel, the clamp of a bias.",
              r->plan.shot[0].ndc_signed ? "0" : "-w");
}

static const column no_columns[] = {{.kind = COLUMN_END}};

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

void probe_report(const probe_result *result, output *out, output_form form) {
    probing p = {.result = result,
                 .device = &result->machine.device[result->machine.chosen],
                 .of = device_of(result, result->machine.chosen)};
    const bool text = form == FORM_TEXT;
    p.subpixel_bits = p.device->subpixel_bits;
    report_write(&(report_spec){"probe", text ? no_columns : columns, &p, .label = 12, .head = text ? say_probe : NULL},
                 out, form);
}
