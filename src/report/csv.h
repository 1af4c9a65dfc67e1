/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file csv.h  A CSV emitter after RFC 4180: CRLF line ends, quotes where needed, `inf` for an unbounded value.
 *
 *     csv c = csv_start(&out);
 *     csv_string(&c, "z [scene]");
 *     csv_end(&c);
 */
#ifndef REPORT_CSV_H
#define REPORT_CSV_H

#include <stdbool.h>
#include <stdint.h>

#include "report/output.h"

typedef struct csv {
    output *out;
    bool filled; /**< the line has a field already */
} csv;

csv csv_start(output *out);
void csv_string(csv *c, const char *value);
void csv_number(csv *c, double value); /**< empty when NaN */
void csv_integer(csv *c, uint64_t value);
void csv_end(csv *c);

#endif
