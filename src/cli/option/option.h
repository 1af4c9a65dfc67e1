/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file option.h  Options: one row each, in a table beside what consumes it, from which reading, refusals, help and
 * completion are made.
 *
 * A command's request is a struct that begins with `asked_line *line`. It contains the structs that tables of rows
 * fill: its own, and those that several commands share, as the camera's and the output's. The row of the command says
 * where each of them lies in the request, and which rows it takes, with words or a default of its own where it has any.
 *
 *     static const option_row rows[] = {
 *         {"digits", 0, "N", "so many significant digits", WHOLE(digits, 1, 17, NULL), .standard = "6"}, END};
 *
 * A command receives a request that is already checked option by option: numbers are whole numbers or finite values in
 * their own range, names are known. What needs several options is the command's to complete.
 */
#ifndef CLI_OPTION_OPTION_H
#define CLI_OPTION_OPTION_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "camera/unit.h"
#include "cli/commands.h"
#include "cli/errors.h"
#include "cli/option/names.h"
#include "report/number.h"
#include "report/output.h"

/* ---- The command line -------------------------------------------------------------------------------------------- */

enum { LENGTHS_TYPED_MAX = 16, OPTIONS_GIVEN_MAX = 128, OPTIONS_MAX = 256, OPTION_TEXT_SIZE = NAMES_SIZE };

/** A length that was typed with a unit. */
typedef struct typed_length {
    double value;  /**< scene units */
    double number; /**< of `unit` */
    const unit_row *unit;
} typed_length;

/** The unit of a line's lengths. */
typedef struct lengths {
    const unit_row *unit; /**< what a scene unit is; null where nothing says it: lengths are converted already */
    typed_length typed[LENGTHS_TYPED_MAX]; /**< the first that were */
    size_t typed_count;
} lengths;

/** The command line as it was read: every request begins with a pointer to it. */
typedef struct asked_line {
    const command_row *command;
    void *request;
    char **argv;     /**< the whole command line, for metadata */
    char **operands; /**< what is neither option nor command; operand_count is within the command's bounds */
    int operand_count;
    const void *operand_row; /**< the row that the first operand names where the command has a table of them */
    unsigned parts;          /**< the part of the command that is asked for: option_parts() */
    bool version;            /**< in place of help */
    struct {
        const char *name, *text; /**< the argument as the user gave it, "" of none */
    } given[OPTIONS_GIVEN_MAX];
    size_t given_count;
    lengths *lengths; /**< those of the camera where the request has one, else its own */
    lengths own_lengths;
    void *kept; /**< what asked_allocate() gave */
} asked_line;

/**
 * Reads a command line. argv[0] is the program; the command is the first word that belongs to no option, `table`
 * where there is none. --help and --version anywhere make the command `help`. No order of the options matters.
 *
 * @return EXIT_FINE, or EXIT_USAGE after one line on stderr
 */
int options_parse(asked_line *line, int argc, char **argv);

/** Frees what options_parse() allocated, whatever it returned. */
void options_release(asked_line *line);

/** Memory for what rows are read into, until options_release(). @return null where there is none */
void *asked_allocate(asked_line *line, size_t size);

/** The argument of an option, "" of none; null where the user did not give it. */
const char *option_text(const asked_line *line, const char *name);

/** Did the user give this option? */
static inline bool option_given(const asked_line *line, const char *name) {
    return option_text(line, name) != NULL;
}

/** Is this its name? */
static inline bool option_is(const char *name, const char *other) {
    return strcmp(name, other) == 0;
}

/** Counts an option, from here on, as given by the user. */
void option_give(asked_line *line, const char *name, const char *text);

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

struct option_row;

/** Reads an argument of the option of that row into the struct that its table fills.
 * @return EXIT_FINE, or EXIT_USAGE after one line on stderr */
typedef int option_parser(asked_line *line, const struct option_row *row, const char *value, void *group);

typedef struct option_row {
    const char *name;       /**< long name without dashes; null behind the last row */
    char letter;            /**< short name, 0 when there is none */
    const char *argument;   /**< how help writes the argument, "Z"; null when there is none, or one of `names` */
    const char *help;       /**< what it does; @ stands for the names, limits and default follow */
    option_parser *parse;   /**< null for --help and --version */
    size_t place, size;     /**< of the field in the struct that the table fills */
    double least, most;     /**< of a number; least alone is the form of a parse_form */
    const char *unit;       /**< of a number; null when it has none */
    const name_list *names; /**< what it may be; null when it is no name */
    const char *standard;   /**< the default, as a user would write it; null when there is none */
    const char *without;    /**< what the default means, or holds without the option; or null */
    const char *instead;    /**< what a command that does not take it may be meant to have; or null */
    const char *optional;   /**< an argument that may be left out, and is written behind "=": "FILE"; else null */
    bool repeats;           /**< it may be given several times */
    bool written;           /**< the field is the name of a file that is written */
    bool early;             /**< what lengths mean depends on it, so that it is read before the others */
    const char *also;       /**< other names that are read, separated by one space; null: none */
    const char *group;      /**< the heading above this row and those behind it; null where the one before goes on */
} option_row;

/** A relation of two options, whatever their values. */
typedef struct option_rule {
    const char *option; /**< who is refused; null behind the last rule */
    enum { RULE_NEEDS, RULE_CONFLICTS } relation;
    const char *others; /**< one space between: it needs one of these, or conflicts with each */
    const char *more;   /**< how the sentence goes on behind the other's name: ": a picture has one eye"; or null */
    unsigned parts;     /**< of the command, in which it holds; 0: in all */
} option_rule;

#define NEEDS(name, names, why)                                                                                        \
    { .option = (name), .relation = RULE_NEEDS, .others = (names), .more = (why) }
#define CONFLICTS(name, names, why)                                                                                    \
    { .option = (name), .relation = RULE_CONFLICTS, .others = (names), .more = (why) }

/** Rows that fill one struct. */
typedef struct option_table {
    const option_row *rows;
    void (*begin)(asked_line *line, void *group); /**< gives fields values that no row says; or null */
    void (*early)(asked_line *line, void *group); /**< once the early ones are read; or null */
    const option_rule *rules;                     /**< between them; or null */
} option_table;

/** Where the struct of a table lies in a request. */
typedef struct option_place {
    const option_table *table; /**< null behind the last */
    size_t at;
} option_place;

#define PLACE(request, member, rows)                                                                                   \
    { .table = &(rows), .at = offsetof(request, member) }
#define OWN_PLACE(rows)                                                                                                \
    { .table = &(rows) } /* the request itself */

/** How help writes the argument, with the names where there is no other; "" when there is none. @return out */
const char *option_argument(const option_row *row, char out[OPTION_TEXT_SIZE]);

/** "LEAST to MOST UNIT". @return out */
const char *option_limits(const option_row *row, char out[OPTION_TEXT_SIZE]);

/** The field of a row. */
static inline void *option_field(const option_row *row, void *group) {
    return (char *)group + row->place;
}

/** The options of every command: --help and --version. */
extern const option_row option_always[];

/** Tables in the order in which help shows them, null behind the last. */
extern const option_table *const option_order[];

/** All rows of all commands in the order of help, those of one name side by side; null behind the last. */
void options_all(const option_row *out[OPTIONS_MAX + 1]);

/** The struct in the request that is filled by the table of a row; null where the command has it not. */
void *option_group(const asked_line *line, const option_row *row);

/** Reads a value as if it had been typed, into the request. @return as the row's parser does */
int option_set(asked_line *line, const char *name, const char *value);

/* ---- Which command takes what ------------------------------------------------------------------------------------ */

/** A command's own texts for an option that others take, too; null where the row's holds. */
typedef struct option_own {
    const char *argument; /**< how help writes the argument */
    const char *optional; /**< an argument that may be left out, and is written behind "=" */
    const char *help;     /**< what it does */
    const char *also;     /**< what it does beside that */
    const char *standard; /**< the default, which is read as if it were typed, */
    const char *without;  /**< and what it means, or holds without the option; "": nothing is said of it */
    const char *instead;  /**< what is meant where another part of the command does not take it */
    option_parser *parse; /**< another language than the row's */
} option_own;

/** Options that a command takes; where one is found twice the first is meant, so its own stand first. */
typedef struct option_use {
    const char *name;               /**< of an option; or null */
    const option_row *rows;         /**< or all of these */
    const struct option_use *group; /**< or what these say; null in all three: the end */
    unsigned parts;                 /**< the parts of the command that take it, see commands.h; 0: all of them */
    const option_own *own;          /**< null where all is as the row has it */
} option_use;

/** An option as its row has it, or with a command's own words; rows, a group, or a group for some parts alone. */
/** Stands behind the last row, and the last use. */
#define END                                                                                                            \
    { .name = NULL }

#define TAKE(option)                                                                                                   \
    { .name = (option) }
#define OWN(option, ...)                                                                                               \
    {                                                                                                                  \
        .name = (option), .own = &(const option_own) {                                                                 \
            __VA_ARGS__                                                                                                \
        }                                                                                                              \
    }
#define ROWS(of)                                                                                                       \
    { .rows = (of) }
#define GROUP_OF(of)                                                                                                   \
    { .group = (of) }
#define FOR(these, of)                                                                                                 \
    { .group = (of), .parts = (these) }
#define HELP(words)    .help = (words)
#define ALSO(words)    .also = (words)
#define DEFAULT(typed) .standard = (typed)
#define WITHOUT(words) .without = (words)
#define INSTEAD(words) .instead = (words)

/** A row as a command takes it. */
typedef struct option_taken {
    const option_row *row; /**< null: it does not */
    option_own own;        /**< all null where it has nothing of its own */
    option_parser *parse;
} option_taken;

/** How those parts of a command take a row, ~0u for any. */
option_taken option_used(const command_row *v, unsigned parts, const option_row *row);

/** The row of that name in the tables of a command; null where they have none. */
const option_row *option_find(const command_row *v, const char *name);

/** "table, plot, budget": the commands that take an option of that name. @return out */
const char *option_takers(const char *name, char out[OPTION_TEXT_SIZE]);

/** Part `index` of a command; false behind the last. */
bool option_part_get(const command_row *v, size_t index, command_part *out);

/** The bits of the part that is asked for, ~0u where the command has none. Operands are known. */
unsigned option_parts(const asked_line *line);

/** Refuses an option of that command which the part of it that is asked for does not take. @return EXIT_FINE, or
 * EXIT_USAGE after one line on stderr */
int option_check_parts(const asked_line *line, const command_row *v, size_t part);

/** Refuses an option by the rules of its command and of the tables that it has. @return as option_check_parts() */
int option_check_rules(const asked_line *line);

/** The default of an option for a command, and what holds without it, each null where there is none. */
void option_default(const option_taken *use, const char **standard, const char **without);

/** The argument that may be left out; null where there is none. */
const char *option_use_optional(const option_taken *use);

/** How help writes the argument for a command, with the names where there is no other; "" when there is none.
 * @return out */
const char *option_use_argument(const option_taken *use, char out[OPTION_TEXT_SIZE]);

/* ---- Refusals ---------------------------------------------------------------------------------------------------- */

/**
 * Prints "depthprec: --NAME: " and the rest, one line, on stderr. The rest says what is allowed and what was given:
 *     return option_error("format", "must be one format, got %zu", count);
 * Who did not name what is refused is told where it comes from.
 * @return EXIT_USAGE
 */
int option_error(const char *name, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** The same of what was typed. @return EXIT_USAGE */
int option_refuse(const option_row *row, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** The same of a file that cannot be read, by a number of errno. @return EXIT_IO after one line on stderr */
int option_unreadable(const char *name, const char *path, int number);

/** Presets and platforms choose what the user did not give: option_error() says so of these, until all is forgotten. */
void option_chosen(const asked_line *line, const char *by, const char *name, const char *const names[]);
void option_forget_choosers(void);

/** Word `index` of an option that takes one of a few. */
const char *option_word(const char *name, size_t index);

/** The file that an option has written, "-" for stdout; null where it has none. */
const char *option_written(const asked_line *line, const char *name);

/** Looks up an operand, which help calls `what`. @return EXIT_FINE and *found, or EXIT_USAGE after one line on stderr
 */
int check_operand(const command_row *v, const char *what, const name_list *n, const char *given, list_item *found);

/* ---- Lengths ----------------------------------------------------------------------------------------------------- */

/** "0.01 mm": a length as it was typed, with the unit that it had there; of another one so many significant digits, 0
 * for as many as it takes, in scene units. */
number_text lengths_text(const lengths *l, double value, int digits);

/** "m": what a scene unit is; null where nothing says it. */
static inline const char *lengths_unit(const lengths *l) {
    return l->unit != NULL ? l->unit->name : NULL;
}

/** The unit behind the argument of an option that is one length; that of the scene where there is none, null where
 * nothing says that. */
const unit_row *option_unit(const asked_line *line, const char *name);

/* ---- Kinds ------------------------------------------------------------------------------------------------------- */

option_parser parse_flag;        /**< bool, no argument */
option_parser parse_text;        /**< const char * */
option_parser parse_some;        /**< the same, not empty */
option_parser parse_read;        /**< the name of a file that is read */
option_parser parse_written;     /**< the name of a file that is written */
option_parser parse_number;      /**< double, finite, from least to most */
option_parser parse_length;      /**< double: scene units, or with a unit behind; from least to most, or positive */
option_parser parse_length_or_0; /**< the same; 0 without limits */
option_parser parse_whole;       /**< unsigned or 64 bits wide, from least to most */
option_parser parse_word;        /**< the same: the index of one of `names` */
option_parser parse_row;         /**< a pointer to the row of one of `names` */
option_parser parse_list;        /**< depths: numbers from least to most, separated by commas */
option_parser parse_codes;       /**< the same, whole ones */
option_parser parse_pixels;      /**< the same, pairs of them with a semicolon in between */
option_parser parse_depths;      /**< depths: lengths, separated by commas or spaced */
option_parser parse_share;       /**< double, a share or a percentage */
option_parser parse_origin;      /**< double[3]: a place */
option_parser parse_box;         /**< double[3]: three lengths with x between them */
option_parser parse_size;        /**< uint32_t[2]: pixels */
option_parser parse_size_or_n;   /**< the same, or one number for both */

/** NAME[,NAME...]: one after the other to `add`. */
int parse_names(asked_line *line, const option_row *row, const char *value, void *group, option_parser *add);

/** Reads NAME, or NAME:X. @param found  what is called so @param x  what stands behind the colon; null without one
 * @return an exit status, after one line on stderr */
int option_read_named(const option_row *row, const char *value, list_item *found, const char **x);

/** Refuses a name that is none of the row's. @return EXIT_USAGE */
int option_unknown(const option_row *row, const char *name);

/** Reads WIDTHxHEIGHT, each from 1 to `most`, or N for both where `square`. @return an exit status, after one line on
 *  stderr */
int option_read_sides(const option_row *row, const char *value, unsigned most, bool square, uint64_t sides[2]);

/** Reads LO:HI, lengths, from so many characters. @return as above */
int option_read_range(asked_line *line, const option_row *row, const char *value, size_t length, double out[2]);

/** Reads so many numbers with commas between them, each within its limits. @return how many, 0 where one is wrong */
int option_read_numbers(const char *text, int most, const double limits[][2], double *out);

/** Lengths of one argument: whether some have a unit, and some, other than 0, none. */
typedef struct length_reader {
    lengths *in;
    bool named, bare;
} length_reader;

/** A length of so many characters. */
bool length_read(length_reader *seen, const char *text, size_t length, number_kind kind, double *out);

/** The words that a refusal adds where letters behind digits make one expect a unit. */
const char *length_hint(const char *text, size_t length);

/** Refuses lengths of which some have a unit and others none. @return EXIT_FINE, or EXIT_USAGE after one line */
int length_check_mixed(const length_reader *seen, const option_row *row, const char *value);

#endif
