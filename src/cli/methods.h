/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file methods.h  What bench, stability and their figures share: which family, which case, on which machine. */
#ifndef CLI_METHODS_H
#define CLI_METHODS_H

#include <stddef.h>

#include "cli/options.h"
#include "method/bench.h"
#include "method/stability.h"
#include "plot/figure.h"

/** A family and the case of it that --format and --mapping name (the first when neither is given), at the planes. */
typedef struct methods_asked {
    const method_family_row *family;
    size_t which;
    dp_setup setup;
} methods_asked;

/** @return EXIT_FINE, or EXIT_USAGE after one line on stderr */
int methods_resolve(const options *o, const method_family_row *family, methods_asked *out);

/** Processor and, unless SOURCE_DATE_EPOCH names another, today's date. @return out */
const char *methods_machine(char *out, size_t size);

/** The numbers of a figure of methods; methods_figure_free() when it is drawn. */
typedef struct methods_figure {
    figure_methods shown;
    void *memory;
} methods_figure;

/**
 * Measures what a figure of methods shows.
 * @param family    null for the figure's own default
 * @param subtitle  of `size`: says what was measured, for times also on which machine and day
 */
int methods_figure_make(const options *o, bool times, const char *family, methods_figure *out, char *subtitle,
                        size_t size);
void methods_figure_free(methods_figure *f);

enum { METHODS_REPETITIONS = 25 };

#endif
