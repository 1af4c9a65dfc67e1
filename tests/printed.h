/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file printed.h  What a command prints as JSON, CSV and text, field by field, against values that the test computes.
 *
 *     values v = values_of("table");
 *     values_under(&v, "setups[%d].rows[%d].", 0, 0);
 *     want_number(&v, "z", 10);                           // one for each leaf of the JSON: no more, no fewer
 *     check_json(&v, 0, "table --at 10 -F fp32 -m d3d");
 *     check_csv(&v, 0, "table --at 10 -F fp32 -m d3d", columns, count, &rows);
 *
 * A value is wanted once and then looked for in all three forms. JSON is parsed strictly and must hold every value that
 * is wanted and no other; numbers must be the same double. So a field that no test computes is a failure, too.
 *
 * The program is that of DEPTHPREC, or the one beside the folder of the test program.
 */
#ifndef TESTS_PRINTED_H
#define TESTS_PRINTED_H

#include <stdbool.h>

#include <jansson.h>

#include "depthprec/depthprec.h"
#include "support.h"

/* ---- Running ----------------------------------------------------------------------------------------------------- */

/** What a run left behind; printed_free() when done. */
typedef struct printed {
    int status;         /**< exit status; 128 and more: killed by a signal */
    char *out, *errors; /**< stdout, stderr */
} printed;

/** Runs `depthprec ARGUMENTS` under a shell. */
printed print_of(const char *format, ...) __attribute__((format(printf, 1, 2)));
void printed_free(printed *p);

/** The stdout, to be freed, of `depthprec ARGUMENTS FORM`; fails the test when it ends with another exit status. */
char *output_of(int status, const char *arguments, const char *form);

/** A file in a folder of this run that is removed when the test program ends. @return a static string */
const char *scratch_file(const char *name);

/** The text of a file, to be freed. */
char *text_of_file(const char *path);

/* ---- What is wanted ---------------------------------------------------------------------------------------------- */

enum { PATH_SIZE = 128, WORD_SIZE = 640 };

typedef enum value_kind { VALUE_NUMBER = 0, VALUE_TEXT, VALUE_BOOL } value_kind;

/** A number that is not finite, and a text that is not there, is null in JSON. */
typedef struct wanted {
    char path[PATH_SIZE]; /**< "setups[0].rows[2].z" */
    value_kind kind;
    double number; /**< also 0 or 1 of a BOOL */
    bool is_null;  /**< TEXT: none */
    bool derived;  /**< shown in text or CSV alone */
    char text[WORD_SIZE];
    bool met;
} wanted;

typedef struct values {
    wanted *items;
    size_t count, room;
    char prefix[PATH_SIZE];
    const char *command;
    const char *unit; /**< of the scene, for want_setup(); null: not known */
} values;

/** Nothing but schema, command and version; values_free() when done. */
values values_of(const char *command);
void values_free(values *v);

/** What stands before the fields that follow; "" for the top. */
void values_under(values *v, const char *format, ...) __attribute__((format(printf, 2, 3)));

void want_number(values *v, const char *field, double number);
void want_count(values *v, const char *field, uint64_t count); /**< below 2^53 */
void want_text(values *v, const char *field, const char *text);
void want_bool(values *v, const char *field, bool value);

/** A number that JSON leaves to its reader and text or CSV shows: a percentage, say. */
void want_derived(values *v, const char *field, double number);

/** The fields of a set-up, as commands begin it. */
void want_setup(values *v, const dp_setup *setup);

/** What --model auto says under `under`: the choice, and what share of the separation each simpler model leaves out. */
void want_choice(values *v, const char *under, const dp_setup *setup, const double *z, size_t count, double tolerance);

/** The value of a path; null where there is none. */
wanted *value_find(const values *v, const char *path);

/** The same; fails the test where there is none. */
const wanted *value_at(const values *v, const char *path);

/* ---- Looking for it ---------------------------------------------------------------------------------------------- */

/** Strict JSON; fails the test, with where and why, when it is not. json_decref() when done. */
json_t *json_of(const char *text);

/** Every leaf of a JSON text against the values, both ways. */
void check_json_text(values *v, const char *text);

/**
 * The last test of a program: any two fields of an object differed in some run, so that their exchange would have been
 * noticed. check_json_text() notes what it sees.
 */
void check_apart(void **state);
void apart_note(const char *command, const char *path, json_t *object);

/** Runs `depthprec ARGUMENTS --json`, which must exit with `status`. */
void check_json(values *v, int status, const char *arguments);

/** Where a line of CSV or text finds its values: what stands before the paths of its columns. */
typedef struct line_place {
    char outer[PATH_SIZE]; /**< of a path that begins with ^, the set-up's */
    char inner[PATH_SIZE]; /**< of a path that begins with no sign */
} line_place;

typedef struct line_places {
    line_place *items;
    size_t count;
} line_places;

void place_add(line_places *l, const char *inner, const char *outer_format, ...) __attribute__((format(printf, 3, 4)));
void places_free(line_places *l);

/**
 * A column: its head in CSV, and the path of its values: "z" in the line, "^near" in the set-up, "/family" at the top,
 * "=text" a constant, "?z" as in the line, empty where no such value is wanted.
 */
typedef struct csv_column {
    const char *head, *path;
} csv_column;

/** The columns of a set-up. */
#define SETUP_COLUMNS                                                                                                  \
    {"near [scene]", "^near"}, {"far [scene]", "^far"}, {"projection", "^projection"}, {"mapping", "^mapping"},        \
        {"format", "^format"}, {"rounding", "^rounding"}, {                                                            \
        "model", "^model"                                                                                              \
    }

void check_csv_text(const values *v, const char *text, const csv_column *columns, size_t count,
                    const line_places *lines);

/** Runs `depthprec ARGUMENTS --csv`; RFC 4180, one line for each place, in order. */
void check_csv(const values *v, int status, const char *arguments, const csv_column *columns, size_t count,
               const line_places *lines);

/** A column of a text table: a path as above, and how precisely it is shown. */
typedef struct text_column {
    const char *path;
    int digits; /**< significant ones; from 0 down: minus the decimals */
} text_column;

/** The lines of a text that begin with two numbers, one for each place, in order. A value may be rounded up or down. */
void check_text_table(const values *v, const char *text, const text_column *columns, size_t count,
                      const line_places *lines);

/** The numbers in the first line that begins with `label` (blanks aside), in order; paths end with a null. */
void check_text_numbers(const values *v, const char *text, const char *label, int digits, const char *const *paths);

/* ---- Cameras ----------------------------------------------------------------------------------------------------- */

enum { CAMERA_SETUPS = 16 };

/** Planes, formats and mappings, as a command line and as the set-ups that it stands for. */
typedef struct camera_case {
    double znear, zfar;
    const char *formats[5];
    const char *mappings[4];
    int ortho;
    double half; /* of --ortho=H; 0: not given */
    dp_rounding rounding;
    dp_model model; /**< written as --model where it is not exact, unless `implied` */
    bool implied;
    const char *arith; /**< null: ieee, and then not written */
    double log_c;      /**< 0: 1, and then not written */
    const char *unit;  /**< --unit; null: not written */
} camera_case;

size_t camera_setups(const camera_case *c, dp_setup out[CAMERA_SETUPS]);

/** Its options. @return out */
const char *camera_options(const camera_case *c, char out[512]);

#endif
