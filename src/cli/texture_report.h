/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file texture_report.h  The statistics of a depth image: text, JSON, CSV. */
#ifndef CLI_TEXTURE_REPORT_H
#define CLI_TEXTURE_REPORT_H

#include "cli/texture_source.h"

/** Makes and writes the statistics. @return an exit status */
int texture_report_write(const options *o, const texture_source *source);

#endif
