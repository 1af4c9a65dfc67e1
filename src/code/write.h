/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file write.h  A function, as a language writes it, from texts of steps.h. */
#ifndef CODE_WRITE_H
#define CODE_WRITE_H

#include "code/language.h"
#include "method/steps.h"
#include "report/output.h"

enum { CODE_TEXT_SIZE = 1024, CODE_INPUTS = 4 };

/** Digits that read back as the same binary32 or binary64 number, with a point or an exponent. @return out */
const char *code_number(double value, bool wide, char out[CODE_TEXT_SIZE]);

/** The same as the language writes it, added to a text. */
void code_literal(char *out, const code_language *l, double value, bool wide);

/** A template with each '@' in turn replaced, the third and what is behind it alike, as every '$' is. */
void code_put(output *out, const char *template, const char *a, const char *b, const char *c);

/** A comment, in lines that a terminal holds. */
void code_say(output *out, const code_language *l, const char *format, ...) __attribute__((format(printf, 3, 4)));

/** Steps of a row to be written in a language; without one a formula for people, in near and far, or the same steps
 * in exact arithmetic for Gappa. */
typedef struct code_writer {
    const code_language *l;
    const steps *steps;
    bool wide;
    enum { AS_COMPUTED = 0, EXACT, EXACT_INFINITE } exact;
    const char *span; /* see steps_given, in words */
} code_writer;

/** A node, in parentheses where it binds less than `outer`; added to a text. */
void code_expression(const code_writer *w, int node, int outer, char *out);

/** A function that is written. */
typedef struct code_body {
    const code_language *l;
    const char *name, *inputs[CODE_INPUTS]; /**< null behind the last */
    steps_given given;                      /**< what its constants are formed of */
    const char *span;
    steps constants, steps;
    code_type type;
    int results; /**< of a vector: how many of the last steps are its members */
    bool wide, uniforms;
} code_body;

/** "float", "vec3" @return out */
const char *code_type_name(const code_language *l, code_type type, int members, char out[CODE_TEXT_SIZE]);

/** In comments: the camera, behind what it is of; what its depth is cleared to and compared by. */
void code_say_camera(output *out, const code_language *l, const dp_setup *setup, const char *what);
void code_say_depth(output *out, const code_language *l, const dp_setup *setup);

/** Write the first lines of a file and, in comments, the language's promises about its operations. */
void code_import(output *out, const code_language *l);
void code_say_rules(output *out, const code_language *l, bool powers);

void code_constant(const code_body *f, int i, char value[CODE_TEXT_SIZE], char formula[CODE_TEXT_SIZE]);
void code_infix(output *out, const code_body *f);
/** The same behind how it is compiled; as a script of an eye depth between these planes. */
void code_function_of(output *out, const code_body *f, const dp_setup *setup);
/** Writes what separates two functions. */
void code_part(output *out, const code_language *l);

#endif
