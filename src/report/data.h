/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file data.h  A report as data, for programs: JSON, and CSV after RFC 4180, with all digits of its numbers. */
#ifndef REPORT_DATA_H
#define REPORT_DATA_H

#include "report/report.h"

void report_json(const report_spec *spec, output *out);
void report_csv(const report_spec *spec, output *out);

#endif
