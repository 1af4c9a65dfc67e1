/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The report of a probe, of findings and devices that are made up: each number differs from all others. */
#include <jansson.h>

#include "probe/cmd_probe/report.h"
#include "support.h"

enum { DEVICES = 3, CHOSEN = 1 };

static probe_result *made(void) {
    static probe_result r;
    static shot shots[1];
    static const probe_finding findings[] = {
        {"rounding", "d16", "to even", PROBE_SURE, 640, 640, "to zero", 17, NAN, NULL},
        {"bias", "d16", "one code; or two", PROBE_OPEN, 100, 91, "two", 33, NAN, NULL},
        {"bias", "d24", "one code; or two", PROBE_OPEN, 100, 90, "two", 32, NAN, NULL},
        {"bias", "d32f", "one code; or two", PROBE_OPEN, 100, 92, "two", 31, NAN, NULL},
        {"bias", "d32f", "nothing known", PROBE_NO_ROW, 100, 5, NULL, 0, NAN, NULL},
        {"slope", NULL, "nothing known", PROBE_NO_ROW, 50, 6, NULL, 0, NAN, NULL},
        {"log2", "d32f", "of x above 2", PROBE_MEASURED, 70, 0, NULL, 0, 1.23456, "ulp"},
    };
    r = (probe_result){.machine = {.count = DEVICES, .chosen = CHOSEN}, .plan = {1, shots}, .arith = "mesa"};
    for (int i = 0; i < DEVICES; i++) {
        shot_device *d = &r.machine.device[i];
        snprintf(d->name, sizeof d->name, "name %d", i);
        snprintf(d->driver, sizeof d->driver, "driver %d", i);
        snprintf(d->api, sizeof d->api, "api %d", i);
        d->subpixel_bits = 4 + i;
    }
    r.count = sizeof findings / sizeof findings[0];
    memcpy(r.finding, findings, sizeof findings);
    return &r;
}

/* What is written, lost with the next call. */
static const char *written(output_form form) {
    static char text[1 << 14];
    char path[] = "/tmp/depthprec-probe-XXXXXX";
    static output out;
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    fclose(fdopen(fd, "w"));
    assert_int_equal(output_open(&out, path), EXIT_FINE);
    probe_report(made(), &out, form);
    assert_int_equal(output_close(&out), EXIT_FINE);
    FILE *file = fopen(path, "r");
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    remove(path);
    return text;
}

static void check_device(const json_t *device, int number) {
    const char *const keys[] = {"name", "driver", "api"};
    char want[16];
    assert_int_equal(json_integer_value(json_object_get(device, "number")), number);
    for (int i = 0; i < 3; i++) {
        snprintf(want, sizeof want, "%s %d", keys[i], number);
        assert_string_equal(json_string_value(json_object_get(device, keys[i])), want);
    }
}

TEST(test_json) {
    json_t *all = json_loads(written(FORM_JSON), JSON_REJECT_DUPLICATES, NULL);
    assert_non_null(all);
    check_device(json_object_get(all, "device"), CHOSEN);
    assert_int_equal(json_array_size(json_object_get(all, "devices")), DEVICES);
    for (size_t i = 0; i < DEVICES; i++)
        check_device(json_array_get(json_object_get(all, "devices"), i), (int)i);
    assert_int_equal(json_integer_value(json_object_get(all, "subpixel_reported")), 4 + CHOSEN);
    assert_string_equal(json_string_value(json_object_get(all, "arith")), "mesa");
    assert_true(json_is_null(json_object_get(all, "raster")));
    const probe_result *r = made();
    for (size_t i = 0; i < r->count; i++) {
        const probe_finding *f = &r->finding[i];
        const json_t *row = json_array_get(json_object_get(all, "findings"), i);
        const json_t *hits = json_object_get(row, "hits"), *next = json_object_get(row, "next_hits");
        assert_string_equal(json_string_value(json_object_get(row, "key")), f->key);
        assert_string_equal(json_string_value(json_object_get(row, "found")), f->words);
        assert_string_equal(json_string_value(json_object_get(row, "sure")), probe_certainty_name(f->sure));
        assert_true(json_integer_value(json_object_get(row, "cases")) == (json_int_t)f->cases);
        assert_true(f->sure == PROBE_MEASURED ? json_is_null(hits) : json_number_value(hits) == (double)f->hits);
        assert_true(f->next == NULL ? json_is_null(next) : json_number_value(next) == (double)f->next_hits);
        assert_true(isnan(f->value) ? json_is_null(json_object_get(row, "value"))
                                    : json_number_value(json_object_get(row, "value")) == f->value);
    }
    assert_int_equal(json_array_size(json_object_get(all, "findings")), r->count);
    json_decref(all);
}

/* Formats of which the same is found share a line, with the fewest hits; a number is rounded upward. */
TEST(test_text) {
    static const char *const lines[] = {
        "name 1\n",
        "  driver      driver 1; api 1\n",
        "  devices     0: name 0\n              1: name 1\n              2: name 2\n",
        "  rows        --arith mesa, --raster (no row)\n",
        "  rounding    d16: to even\n",
        "  bias        d16, d24, d32f: one code; or two (open: 90 of 100)\n",
        "              d32f: nothing known (no row: 5 of 100)\n",
        "  slope       nothing known (no row: 6 of 50)\n",
        "  log2        at most 1.24 ulp off, of x above 2\n",
    };
    const char *text = written(FORM_TEXT);
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        if (strstr(text, lines[i]) == NULL)
            fail_msg("'%s' is not in: %s", lines[i], text);
    assert_non_null(strstr(text, "Not measured: clip z from -w,"));
}

/* A line for each finding, each with the device. */
TEST(test_csv) {
    const char *text = written(FORM_CSV);
    size_t rows = 0;
    for (const char *at = strchr(text, '\n') + 1; *at != '\0'; at = strchr(at, '\n') + 1, rows++)
        assert_int_equal(strncmp(at, "1,name 1,driver 1,api 1,", 24), 0);
    assert_true(rows == made()->count);
}
