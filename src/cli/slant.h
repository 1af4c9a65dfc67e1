/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file slant.h  How reports name slanted triangles. */
#ifndef CLI_SLANT_H
#define CLI_SLANT_H

#include "depthprec/depthprec.h"
#include "report/report.h"

/** What text says above a set-up: view, grid and class, or why there is no guarantee; nothing of null. */
void slant_title(page *p, const dp_triangles *triangles, const dp_setup *setup);

/** Of a dp_triangles, in JSON. */
extern const column slant_columns[];

#endif
