/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file table_text.h  The table as people read it: 100 columns, as many digits as tell two depths apart. */
#ifndef CLI_TABLE_TEXT_H
#define CLI_TABLE_TEXT_H

#include "cli/clipping.h"
#include "cli/options.h"

/** How the text is dressed: bold and dim on a terminal, plain elsewhere or when NO_COLOR is set. */
typedef struct table_style {
    const char *strong, *soft, *plain;
    bool cells; /**< the cell's two ends as well (--verbose) */
} table_style;

table_style table_style_of(const options *o, const output *out);

void table_text_head(output *out, const table_style *style, const dp_setup *setup);

/** @param binary32  the guaranteed separation in binary32 arithmetic; NaN where there is no such pipeline */
void table_text_row(output *out, const table_style *style, const dp_sample *sample, double binary32);

/** The worst case; nothing in a model without cells. */
void table_text_worst(output *out, const table_style *style, const dp_worst *worst);

/** The largest separation over the range, rounded up, and the model that it holds in. */
void table_text_separation(output *out, const table_style *style, dp_model model, const dp_separation_worst *worst);

/** The planes that binary32 clipping leaves; nothing when they are NaN and none is lost. */
void table_text_clipping(output *out, const table_style *style, const clipping *c);

/** By which method the intervals were computed, what it claims and what was allowed; a null name: none is known. */
void table_text_way(output *out, const char *name, double claim, double tolerance);

#endif
