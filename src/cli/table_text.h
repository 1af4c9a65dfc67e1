/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file table_text.h  The table as people read it: about 90 columns, as many digits as tell two depths apart. */
#ifndef CLI_TABLE_TEXT_H
#define CLI_TABLE_TEXT_H

#include "cli/options.h"

/** How the text is dressed: bold and dim on a terminal, plain elsewhere or when NO_COLOR is set. */
typedef struct table_style {
    const char *strong, *soft, *plain;
    bool cells; /**< the cell's two ends as well (--verbose) */
} table_style;

table_style table_style_of(const options *o, const output *out);

void table_text_head(output *out, const table_style *style, const dp_setup *setup);
void table_text_row(output *out, const table_style *style, const dp_sample *sample);
void table_text_worst(output *out, const table_style *style, const dp_worst *worst);

#endif
