/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file language.h  Languages that code is printed in, a row each: how they write a function, and what they promise.
 */
#ifndef CODE_LANGUAGE_H
#define CODE_LANGUAGE_H

#include <stddef.h>

#include "core/named.h"
#include "method/bound.h"

/** How operations are written: between their operands, in parentheses before them, or as lines for Gappa. */
typedef enum code_form { CODE_INFIX = 0, CODE_PREFIX, CODE_PROOF } code_form;

/** The result of a function: a number, a whole number, several numbers. */
typedef enum code_type { CODE_REAL = 0, CODE_COUNT, CODE_VECTOR, CODE_TYPES } code_type;

/** '@' and '$' stand for what is filled in. Pairs are for binary32, then for binary64; a null is what the language
 * lacks. */
typedef struct code_language {
    NAMED_FIELDS;
    code_form form;
    const char *comment;          /**< what a line of comment begins with */
    const char *advice;           /**< how it is compiled, or null */
    const char *import;           /**< what stands above all, or null */
    const char *type[CODE_TYPES]; /**< of a vector the number of members */
    const char *define;           /**< what stands before a function that returns one: that number, its type; or null */
    const char *function;         /**< name, parameters, type */
    const char *parameter[2];     /**< a name */
    const char *input[2];         /**< a parameter's name, twice: what is made of it first, or null */
    const char *constant[2];      /**< name, value */
    const char *step[2];          /**< the same */
    const char *result[2];        /**< a name */
    const char *members;          /**< several, the type */
    const char *literal[2];       /**< digits */
    const char *whole, *even;     /**< to an unsigned integer; to the nearest whole number, ties to even */
    const char *fused, *magic;    /**< fma(a, b, c); the first estimate of 1/x from its bits */
    const char *sign;             /**< a number, what it has the sign of */
    const char *before, *behind;  /**< of the name of a function of mathematics */
    const char *matrix, *end;     /**< what stands before and behind 16 numbers */
    bool by_rows;                 /**< the order of those */
    bound_arithmetic how;
    const char *powers; /**< what it promises of exp2 and log2, or null */
    const char *rules;  /**< who says so */
} code_language;

NAMED_ROWS(code_language, code_language);

/** "sums and products within 1 ulp, quotients within 2.5" @return out */
enum { CODE_RULES_SIZE = 80 };
const char *code_language_rules(const code_language *l, char out[CODE_RULES_SIZE]);

#endif
