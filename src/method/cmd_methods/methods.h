/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file methods.h  State that methods and its figures share: which family, which case, on which machine. */
#ifndef METHOD_CMD_METHODS_METHODS_H
#define METHOD_CMD_METHODS_METHODS_H

#include <stddef.h>

#include "judge/cmd_judge/request.h"
#include "method/bench.h"
#include "method/stability.h"

/** A family and the cases of it that --format and --mapping name, all when neither is given; and the first of these, at
 *  the planes. */
typedef struct methods_asked {
    const method_family_row *family;
    unsigned cases; /**< bits */
    size_t which;
    dp_setup setup;
} methods_asked;

/** @return EXIT_FINE, or EXIT_USAGE after one line on stderr */
int methods_resolve(const judge_request *o, const method_family_row *family, methods_asked *out);

/** Refuses options that name several cases, for what is of one. @return likewise */
int methods_single(const judge_request *o, methods_asked *asked);

/** The cases for which method `index` is the cheapest within --tolerance, at the default camera's far/near. */
void list_method_choice(size_t index, double tolerance, char chosen[LIST_TEXT_SIZE]);

/** Processor and, unless SOURCE_DATE_EPOCH names another, today's date. @return out */
const char *methods_machine(char *out, size_t size);

#endif
