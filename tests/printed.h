/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file printed.h  What a command prints as JSON, CSV and text, field by field, against values that the test computes.
 *
 *     const char *line = "table --at 10 -F fp32 -m d3d";
 *     values v = values_of(line);
 *     setups_of(line, DP_MODEL_EXACT, &setup);             // by the test's own reading of the line
 *     values_under(&v, "setups[%d].rows[%d].", 0, 0);
 *     want(&v, "z=%f code=%u", 10.0, dp_code(&setup, 10)); // one for each leaf of the JSON: no more, no fewer
 *     check_forms(&v, 0, line, "setups[].rows[]", SETUP_CSV "z [scene], code");
 *
 * A value is wanted once and then looked for in all three forms. JSON is parsed strictly and must hold every value that
 * is wanted and no other; numbers must be the same double. So a field that no test computes is a failure, too.
 *
 * The program is that of DEPTHPREC, or the one beside the folder of the test program.
 */
#ifndef TESTS_PRINTED_H
#define TESTS_PRINTED_H

#include <jansson.h>

#include "setups.h"
#include "support.h"

/* ---- Running ----------------------------------------------------------------------------------------------------- */

/** The remains of a run; printed_free() when done. */
typedef struct printed {
    int status;         /**< exit status; 128 and more: killed by a signal */
    char *out, *errors; /**< stdout, stderr */
} printed;

/** Runs `depthprec ARGUMENTS` under a shell. */
printed print_of(const char *format, ...) __attribute__((format(printf, 1, 2)));
void printed_free(printed *p);

/** Puts a text on one line: where it was broken, and how far it was indented, is not asked. */
void printed_unfold(char *text);

/** The stdout, to be freed, of `depthprec ARGUMENTS FORM`; fails the test when it ends with another exit status. */
char *output_of(int status, const char *arguments, const char *form);

/** A file in a folder of this run that is removed when the test program ends. @return a string that stays */
const char *scratch_file(const char *name);

/** The same, holding the text that is given. */
const char *scratch_text(const char *name, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** Finds out in one call that a run says this: it ends with `status`, any where that is -1, having said this on stdout,
 * or where it fails stderr; behind a '!' what it does not say. */
void check_says(int status, const char *said, const char *format, ...) __attribute__((format(printf, 3, 4)));

/** The same of several, in one run: check_says_all(0, "table -q", SAID("this", "!and not that")). */
#define SAID(...) ((const char *const[]){__VA_ARGS__, NULL})
void check_says_all(int status, const char *line, const char *const *said);

/** Words behind a command line, what they are refused with, and the exit status; of a 0 it is 2. */
typedef struct refused_row {
    const char *words, *said;
    int status;
} refused_row;

/** Each of them is refused with its sentence on stderr, and nothing on stdout. */
#define CHECK_REFUSED(line, rows) check_refused(line, rows, sizeof rows / sizeof rows[0])
void check_refused(const char *line, const refused_row *rows, size_t count);

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
    size_t *table; /**< 1 + where the item of a hash is, with room for twice as many */
    char prefix[PATH_SIZE];
    char command[16];
    char unit[16]; /**< of the scene, for want_setup(); "": not known */
    char *told;    /**< the text of the command, its words parted by one blank; null: not known */
} values;

/** Nothing but schema, version and command, which is the line's first word; its unit. values_free() when done. */
values values_of(const char *line);
void values_free(values *v);

/** Runs it as text: each verdict of JSON that is not wanted itself must be a sentence of it. check_json() does so, too.
 */
void values_tell(values *v, int status, const char *arguments);

/** Stands before the fields that follow; "" for the top. */
void values_under(values *v, const char *format, ...) __attribute__((format(printf, 2, 3)));

/**
 * Values with the names of their fields, as a format of printf: "z=%f code=%u state=%s limited=%d"; %f a number, %u,
 * %zu and %lu counts, %s a text or null, %d a bool. Behind a '~' stands what JSON leaves to its reader and text or CSV
 * shows.
 */
void want(values *v, const char *format, ...) __attribute__((format(printf, 2, 3)));

void want_number(values *v, const char *field, double number);
void want_count(values *v, const char *field, uint64_t count); /**< below 2^53 */
void want_text(values *v, const char *field, const char *text);
void want_bool(values *v, const char *field, bool value);
void want_derived(values *v, const char *field, double number);

/** The fields of a set-up, as commands begin it. */
void want_setup(values *v, const dp_setup *setup);

/** The words of --model auto under `under`: the choice, and what share of the separation each simpler model leaves out.
 */
void want_choice(values *v, const char *under, const dp_setup *setup, const double *z, size_t count, double tolerance);

/** The value of a path; null where there is none. */
wanted *value_find(const values *v, const char *path);

/** The same; fails the test where there is none. */
const wanted *value_at(const values *v, const char *path);

/* ---- Looking for it ---------------------------------------------------------------------------------------------- */

/** Strict JSON; fails the test, with where and why, when it is not. json_decref() when done. */
json_t *json_of(const char *text);

/** That of `depthprec LINE --json`, which must exit with `status`; any where that is negative. */
json_t *json_printed(int status, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** The node at a path like "setups[0].rows[2].z"; null where nothing does. */
json_t *node_at(const json_t *root, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** The same of a kind; fails the test where it is another, or nothing. Of null: NaN, and no text. */
double number_at(const json_t *root, const char *format, ...) __attribute__((format(printf, 2, 3)));
const char *text_at(const json_t *root, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool flag_at(const json_t *root, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** Strict JSON against the values, both ways. */
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

/** The lines of "setups[].rows[]": one for each row of each set-up that values are wanted of; with a + at the end one
 * more behind those of each set-up, its own. places_free() when done. */
line_places places_of(const values *v, const char *pattern);

/**
 * Columns as the first line of the CSV has them, "z [scene], code", each with the path of its values behind a = where
 * that is another than its name: "z" in the line, "^near" in the set-up, "/family" at the top. A column that begins
 * with a ? is there where a line has a value; it, and one whose path begins with a ?, is empty in lines that have none.
 */
void check_csv_text(const values *v, const char *text, const char *columns, const line_places *lines);

/** The columns of a set-up, which stands before the paths. */
#define SETUP_CSV_IN(at)                                                                                               \
    "near [scene] = " at "near, far [scene] = " at "far, projection = " at "projection, mapping = " at "mapping, "     \
    "format = " at "format, rounding = " at "rounding, model = " at "model, "
#define SETUP_CSV SETUP_CSV_IN("^")

/** Runs `depthprec ARGUMENTS --csv`; RFC 4180, one line for each place, in order. */
void check_csv(const values *v, int status, const char *arguments, const char *columns, const line_places *lines);

/** check_json() and check_csv(), of the lines of a pattern. */
void check_forms(values *v, int status, const char *arguments, const char *pattern, const char *columns);

/** The lines of a text that begin with two numbers, one for each place of the pattern, in order. Columns are paths,
 * with the digits that are shown, "z:9, share:-3": significant ones; from 0 down minus the decimals. A value may be
 * rounded up or down. */
void check_table(const values *v, const char *text, const char *pattern, const char *columns);

/** The numbers in the first line that begins with `label` (blanks aside), in order; paths, as columns of check_table(),
 * are behind the prefix of values_under(). */
void check_line(const values *v, const char *text, const char *label, const char *columns);

/* ---- Command lines, as the test reads them ----------------------------------------------------------------------- */

enum { SETUPS_MAX = 16 };

/** The word behind an option, or null; one of 16 static strings in turn. */
const char *word_behind(const char *line, const char *option);
bool is_given(const char *line, const char *option);

/** The number behind an option; `missing` where it is not given. */
double number_behind(const char *line, const char *option, double missing);

/** The numbers behind an option, "1,2.5" or "0.5:700". @return how many, none where it is not given */
size_t numbers_behind(const char *line, const char *option, double *out, size_t room);

/** The set-ups by -n, -f, -F, -m, --ortho, --rounding, --model (else the one that is given), --arith and --log-c. */
size_t setups_of(const char *line, dp_model model, dp_setup out[SETUPS_MAX]);

#endif
