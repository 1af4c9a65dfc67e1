/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file junit.h  Verdicts as JUnit XML, which every CI reads.
 *
 *     junit_begin(out, "depthprec check");
 *     junit_suite(out, "engine.need", 2, 1);
 *     junit_case(out, &(junit_row){.classname = ..., .name = ...});        // as many as the suite said
 *     junit_suite_end(out);
 *     junit_end(out);
 *
 * Texts are UTF-8 as users wrote them: what XML cannot hold is left out.
 */
#ifndef CLI_JUNIT_H
#define CLI_JUNIT_H

#include "report/output.h"

typedef struct junit_row {
    const char *classname, *name;
    const char *file, *line;    /**< null where there is none */
    const char *type, *message; /**< of a failure; a null type passed */
    const char *detail;         /**< of a failure, longer */
} junit_row;

void junit_begin(output *out, const char *name);
void junit_suite(output *out, const char *name, size_t tests, size_t failures);
void junit_case(output *out, const junit_row *row);
void junit_suite_end(output *out);
void junit_end(output *out);

#endif
