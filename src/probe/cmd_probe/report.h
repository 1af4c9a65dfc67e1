/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file report.h  What probe found, as text, JSON and CSV. */
#ifndef PROBE_CMD_PROBE_REPORT_H
#define PROBE_CMD_PROBE_REPORT_H

#include "probe/probe.h"
#include "report/output.h"

/** Writes the findings of the chosen device. In text those of one key that say the same share a line, which has the
 * fewest hits among them. */
void probe_report(const probe_result *result, output *out, output_form form);

#endif
