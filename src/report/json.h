/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file json.h  A small JSON emitter: shortest round-trip numbers, null for what is not finite.
 *
 *     json j = json_start(&out, "table");         // {"schema":"depthprec/1","command":"table","version":"0.1.0",
 *     json_array(&j, "rows");
 *     json_object(&j, NULL);                      // inside an array the key is null
 *     json_number(&j, "z", 10.0);
 *     json_end(&j);
 *     json_end(&j);
 *     json_finish(&j);                            // closes what is open and adds a newline
 */
#ifndef REPORT_JSON_H
#define REPORT_JSON_H

#include <stdbool.h>
#include <stdint.h>

#include "report/output.h"

enum { JSON_DEPTH_MAX = 16 };

typedef struct json {
    output *out;
    int depth;
    char close[JSON_DEPTH_MAX]; /**< the bracket that ends each open level */
    bool filled[JSON_DEPTH_MAX];
} json;

/** Begins the one object of a command with the schema, the command and the version. */
json json_start(output *out, const char *command);

void json_object(json *j, const char *key);
void json_array(json *j, const char *key); /**< its objects stand on lines of their own */
void json_end(json *j);
void json_number(json *j, const char *key, double value); /**< null when infinite or NaN */
void json_integer(json *j, const char *key, uint64_t value);
void json_string(json *j, const char *key, const char *value); /**< null when value is null */
void json_bool(json *j, const char *key, bool value);
void json_null(json *j, const char *key);
void json_finish(json *j);

#endif
