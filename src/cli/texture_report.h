/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file texture_report.h  The statistics of a depth image: text, JSON, CSV. */
#ifndef CLI_TEXTURE_REPORT_H
#define CLI_TEXTURE_REPORT_H

#include "cli/texture_source.h"
#include "texture/decode.h"
#include "texture/position.h"
#include "texture/survey.h"

enum { REPORT_ERRORS_MAX = 32, REPORT_NAME_SIZE = 48 };

/** How far a product is off over all pixels; see frame_product. */
typedef struct texture_errors {
    char name[REPORT_NAME_SIZE]; /**< "eye depth", "normal high" */
    const char *unit;
    frame_summary sum;
} texture_errors;

typedef struct texture_report {
    const options *o;
    const texture_source *source;
    survey survey;
    bool has_pairs;
    survey_pairs pairs;
    double condition; /**< of the view-projection matrix, 2-norm; NaN where the mapping has none */
    size_t error_count;
    texture_errors errors[REPORT_ERRORS_MAX];
} texture_report;

/** Makes and writes the statistics. @return an exit status */
int texture_report_write(const options *o, const texture_source *source);

#endif
